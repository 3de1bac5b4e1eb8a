#pragma once

#include <cstddef>

#include "petrous/Core/GridGeometry.h"
#include "petrous/Core/Progress.h"
#include "petrous/Volume/IntensityVolume.h"

namespace petrous::registration
{

/// One resolution level of an image: block averaging, then Gaussian smoothing.
///
/// NaN marks voxels without a value: padding, NaN and infinities of the file. The range excludes
/// the outermost 0.1 % of the values at each end, so that a metal implant or hot pixel does not use
/// up the bins of the histogram.
struct LevelImage
{
  volume::Volume<float> voxels;
  float low = 0.0f;
  float high = 0.0f;
  std::size_t valid = 0; ///< number of voxels that are not NaN

  const core::GridGeometry& grid() const noexcept { return voxels.geometry(); }
};

/// The image at a voxel size of about `scale` mm: each axis is downsampled by an integer factor,
/// never upsampled, and blurred to a standard deviation of scale / 2 (including that of the
/// averaging) if downsampled.
LevelImage makeLevel(const volume::IntensityVolume& image, double scale,
                     const core::Progress& progress = {});

/// The same, from a finer level.
LevelImage makeLevel(const LevelImage& finer, double scale);

/// The part of a level within a box, with its own range. The box must contain a voxel.
LevelImage croppedLevel(const LevelImage& level, const core::IndexBox& box);

/// Smallest voxel box around the foreground (Otsu's threshold, ignoring 1 % of the voxels at each
/// end), extended by `margin` mm; the whole grid if there is no foreground.
core::IndexBox contentBox(const LevelImage& level, double margin);

} // namespace petrous::registration
