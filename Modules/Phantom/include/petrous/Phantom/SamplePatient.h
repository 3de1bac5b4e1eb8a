#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>

#include "petrous/Core/GridGeometry.h"
#include "petrous/Core/NumberText.h"
#include "petrous/Core/Progress.h"

namespace petrous::phantom
{

struct SampleOptions
{
  static constexpr core::NumberRange kSpacings{0.05, 5.0, "mm"};
  static constexpr core::NumberRange kDims{16.0, 1024.0};
  static constexpr core::NumberRange kNoises{0.0, 500.0, "HU"};
  static constexpr core::NumberRange kTilts{-35.0, 35.0, "degrees"};

  std::optional<double> spacing;    ///< mm; default 0.3, or to fit dims
  std::optional<core::Index3> dims; ///< default: to cover the ear
  double noise = 20.0;              ///< HU
  double tilt = 0.0;                ///< degrees about x
  std::uint64_t seed = 1;
};

/// The untilted grid of the CT for these options, centred on the ear. With a tilt this is the grid
/// of the labels, relative to which the slices are sheared. Throws InvalidParameter naming the
/// first invalid value.
core::GridGeometry sampleGrid(const SampleOptions& options);

/// Writes the phantom patient: out/ct and out/mr (DICOM series, each with its own frame of
/// reference), out/labels/NAME.nii.gz (one structure each, on the CT's grid), out/labels.seg.nrrd,
/// out/meshes/NAME.obj (patient LPS mm), out/truth.json. Deterministic to the byte.
///
/// `out` may exist if it is an empty folder. Everything is written beside it and renamed at the
/// end: an error or cancellation leaves nothing behind.
///
/// Throws InvalidParameter for invalid options, Error (Refused) if out is not empty, Error
/// (Internal) if it cannot be written, CancelledError.
void writeSamplePatient(const std::filesystem::path& out, const SampleOptions& options,
                        const core::Progress& progress = {});

} // namespace petrous::phantom
