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
/// NaN if the pixel lies outside the image (the hull of its voxel centres; half a voxel beyond
/// along an axis with a single voxel); minus infinity where the image itself is NaN.
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
/// imageFromSlice  maps patient points of the slice (LPS mm) to those of the image
PlaneSamples samplePlane(const volume::IntensityVolume& image, const SliceGeometry& slice,
                         const core::RigidTransform& imageFromSlice = {});

/// A contour segment, in pixels; integers are pixel centres.
struct ContourSegment
{
  Eigen::Vector2f a;
  Eigen::Vector2f b;
};

/// Isolines at `level`: marching squares, linear between pixel centres. Ambiguous cells are decided
/// by the mean of their four corners. No contour where a corner is not finite, or where the samples
/// change by less than `minSlope` per pixel: there it would follow noise.
std::vector<ContourSegment> contours(const PlaneSamples& samples, float level, float minSlope);

/// Antialiased coverage of each pixel by the contours drawn `width` pixels wide, 0 to 1; pixels as
/// in the samples.
std::vector<float> coverage(const std::vector<ContourSegment>& segments, int columns, int rows,
                            float width);

} // namespace petrous::presenters
