#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>

#include "petrous/Core/GridGeometry.h"
#include "petrous/Core/Progress.h"

namespace petrous::phantom
{

struct SampleOptions
{
  std::optional<double> spacing;    ///< mm, 0.05 to 5; default 0.3, or to fit dims
  std::optional<core::Index3> dims; ///< 16 to 1024 each; default: to cover the ear
  double noise = 20.0;              ///< HU, 0 to 500
  double tilt = 0.0;                ///< degrees about x, -35 to 35
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
