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
  std::optional<double> spacing;    ///< mm, 0.05 to 5; default 0.3, or what fits dims
  std::optional<core::Index3> dims; ///< 16 to 1024 each; default what covers the ear
  double noise = 20.0;              ///< HU, 0 to 500
  double tilt = 0.0;                ///< degrees about x, -35 to 35
  std::uint64_t seed = 1;
};

/// The upright grid of the CT for these options, centred on the ear. With a tilt it is the grid
/// of the labels; the slices are sheared against it.
/// Throws InvalidParameter naming the first bad value.
core::GridGeometry sampleGrid(const SampleOptions& options);

/// Writes the phantom patient: out/ct and out/mr (DICOM series in frames of reference of their
/// own), out/labels/NAME.nii.gz (one structure each, on the CT's grid), out/labels.seg.nrrd,
/// out/meshes/NAME.obj (patient LPS mm), out/truth.json. Same options, same bytes.
///
/// `out` may exist when it is an empty folder. All is written beside it first and renamed at the
/// end: a fault or a cancel leaves nothing behind.
///
/// Throws InvalidParameter for bad options, Error (Refused) when out is not empty, Error
/// (Internal) when it cannot be written, CancelledError.
void writeSamplePatient(const std::filesystem::path& out, const SampleOptions& options,
                        const core::Progress& progress = {});

} // namespace petrous::phantom
