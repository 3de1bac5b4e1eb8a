#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <utility>
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

/// What a slice shows of the layer around it.
enum class Projection
{
  Maximum,
  Minimum,
  Mean
};
const char* nameOf(Projection projection); ///< "mip", "minip", "mean"
std::optional<Projection> parseProjection(const std::string& name);

/// A layer centred on a slice; of thickness 0 the slice itself.
struct Slab
{
  double thickness = 0.0; ///< mm
  Projection projection = Projection::Maximum;

  bool operator==(const Slab& other) const
  {
    return thickness == other.thickness && projection == other.projection;
  }
  bool operator!=(const Slab& other) const { return !(*this == other); }
};

/// Distances from the slice at which a slab is sampled, mm along the normal, and their weights in
/// the mean (trapezoidal rule; their sum is 1).
///
/// Along an axis of the image the trilinear field is linear between voxels: the samples are the
/// slab's two ends and the voxels between them, and all three projections are exact. Along any
/// other direction they are at most half a voxel apart.
struct SlabNode
{
  double offset;
  double weight;
};
std::vector<SlabNode> slabNodes(const core::GridGeometry& image, const SliceGeometry& slice,
                                const core::RigidTransform& imageFromSlice, double thickness);

/// Samples a slab row by row, so that a large one can be drawn in parts.
///
/// Of the nodes of a pixel those outside the image, and where the image is NaN, do not count; the
/// samples' special values are as of samplePlane.
class SlabSampling
{
public:
  SlabSampling(std::shared_ptr<const volume::IntensityVolume> image, const SliceGeometry& slice,
               const Slab& slab, const core::RigidTransform& imageFromSlice = {});

  double samplesPerRow() const; ///< trilinear ones
  bool isDone() const noexcept { return m_row == m_samples.height; }
  void advance(int rows); ///< the next ones, in parallel
  const PlaneSamples& samples() const noexcept { return m_samples; }
  PlaneSamples take() { return std::move(m_samples); }

private:
  std::shared_ptr<const volume::IntensityVolume> m_image;
  SliceGeometry m_slice;
  Slab m_slab;
  core::RigidTransform m_imageFromSlice;
  std::vector<SlabNode> m_nodes;
  PlaneSamples m_samples;
  int m_row = 0;
};

/// All of a slab at once.
PlaneSamples sampleSlab(const volume::IntensityVolume& image, const SliceGeometry& slice,
                        const Slab& slab, const core::RigidTransform& imageFromSlice = {});

/// How far from the slice, mm along the normal, that lies which a slab shows at a pixel: the sample
/// with the largest or least value, of several the nearest. 0 where the mean or nothing is shown.
double shownDepth(const volume::IntensityVolume& image, const SliceGeometry& slice,
                  const Slab& slab, const Eigen::Vector2d& pixel,
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
