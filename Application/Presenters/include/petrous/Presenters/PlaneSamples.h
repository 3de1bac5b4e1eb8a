#pragma once

#include <cstddef>
#include <vector>

#include "petrous/Core/RigidTransform.h"
#include "petrous/Presenters/SliceGeometry.h"
#include "petrous/Volume/IntensityVolume.h"

namespace petrous::presenters
{

/// An image's values at the pixel centres of a slice, rows from the top.
///
/// NaN where the pixel lies outside the image (the hull of its voxel centres; half a voxel further
/// along an axis that has one voxel only); minus infinity where the image itself holds NaN.
struct PlaneSamples
{
  int width = 0;
  int height = 0;
  std::vector<float> values;

  float at(int column, int row) const noexcept
  {
    return values[static_cast<std::size_t>(row) * static_cast<std::size_t>(width) +
                  static_cast<std::size_t>(column)];
  }
};

/// Trilinear samples, in parallel.
///
/// imageFromSlice  takes patient points of the slice (LPS mm) to those of the image
PlaneSamples samplePlane(const volume::IntensityVolume& image, const SliceGeometry& slice,
                         const core::RigidTransform& imageFromSlice = {});

/// A piece of a contour, in pixels; whole numbers are pixel centres.
struct ContourSegment
{
  Eigen::Vector2f a;
  Eigen::Vector2f b;
};

/// Where the samples cross `level`: marching squares, linear between pixel centres. The middle of
/// four pixels decides where their corners allow two ways. Nothing where a corner is not finite, or
/// where the samples change by less than `leastSlope` a pixel: there noise would draw a contour.
std::vector<ContourSegment> contours(const PlaneSamples& samples, float level, float minSlope);

/// How much of each pixel the contours cover when drawn `width` pixels wide, 0 to 1, with smooth
/// edges; pixels as in the samples.
std::vector<float> coverage(const std::vector<ContourSegment>& segments, int columns, int rows,
                            float width);

} // namespace petrous::presenters
