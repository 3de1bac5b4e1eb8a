#pragma once

#include <vector>

#include "petrous/Rendering/Picture.h"

namespace petrous::rendering
{

/// Error of a picture against the reference of the same size.
struct PictureError
{
  double rms = 0.0;         ///< of the colour, 1/255, over all channels of agreeing pixels
  std::size_t agreeing = 0; ///< pixels hit in both, first hits within kDepthAgreement
  std::size_t hit = 0;      ///< pixels hit in either
  std::size_t pixels = 0;
  double depthMedian = 0.0; ///< |difference of first hits|, voxels, of the pixels hit in both
  double depthP95 = 0.0;

  /// Hit/miss mismatches and first hits too far apart, % of all pixels.
  double mismatchPercent() const
  {
    return pixels ? 100.0 * static_cast<double>(hit - agreeing) / static_cast<double>(pixels) : 0.0;
  }
};

constexpr double kDepthAgreement = 0.5; ///< voxels

/// trueRgb     red, green, blue of each pixel, 0 to 1, rows from the top
/// depth, trueDepth  first hits along each pixel's ray, mm; NaN: no hit
/// voxel       unit of length for depths, mm
/// Throws InvalidParameter if the sizes differ.
PictureError comparePictures(const Picture& picture, const DepthImage& depth,
                             const std::vector<float>& trueRgb, const DepthImage& trueDepth,
                             double voxel);

} // namespace petrous::rendering
