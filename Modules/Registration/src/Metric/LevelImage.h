#pragma once

#include <cstddef>

#include "petrous/Core/GridGeometry.h"
#include "petrous/Core/Progress.h"
#include "petrous/Volume/IntensityVolume.h"

namespace petrous::registration
{

/// An image at one resolution of the pyramid: means over blocks of voxels, then Gaussian smoothing.
///
/// NaN where the image holds nothing: padding, NaN and infinities of the file. The ends of the
/// range leave out the outermost 0.1 % of values, so that a metal implant or a hot pixel does not
/// take the bins of the histogram.
struct LevelImage
{
  volume::Volume<float> voxels;
  float low = 0.0f;
  float high = 0.0f;
  std::size_t valid = 0; ///< voxels that are not NaN

  const core::GridGeometry& grid() const noexcept { return voxels.geometry(); }
};

/// The image at about `scale` mm a voxel: each axis is reduced by a whole number of voxels, never
/// enlarged, and blurred to a standard deviation of scale / 2 (the block's own included).
LevelImage makeLevel(const volume::IntensityVolume& image, double scale,
                     const core::Progress& progress = {});

/// The same from a finer level.
LevelImage makeLevel(const LevelImage& finer, double scale);

/// The part of a level in a box, with a range of its own. The box must hold a voxel.
LevelImage croppedLevel(const LevelImage& level, const core::IndexBox& box);

/// Smallest voxel box around what is not background (Otsu's threshold, 1 % of voxels left out at
/// each end), widened by `margin` mm; the whole grid where that finds nothing.
core::IndexBox contentBox(const LevelImage& level, double margin);

} // namespace petrous::registration
