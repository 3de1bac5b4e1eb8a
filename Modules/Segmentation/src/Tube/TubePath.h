#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <vector>

#include <Eigen/Core>

#include "petrous/Core/GridGeometry.h"
#include "petrous/Core/Progress.h"
#include "petrous/Segmentation/TubeTrace.h"
#include "petrous/Volume/IntensityVolume.h"

namespace petrous::segmentation
{

/// The value in the middle, the upper one of two; of at least one value.
template <class T>
double medianOf(std::vector<T> values)
{
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return static_cast<double>(*middle);
}

/// The part of an image around the points, as float. Voxels without a valid value (padding, NaN)
/// have the median of the valid ones.
class TubeImage
{
public:
  /// Throws InvalidParameter if the box has no valid voxels or all of them are equal.
  TubeImage(const volume::IntensityVolume& image, const core::IndexBox& box);

  const core::GridGeometry& geometry() const noexcept { return m_voxels.geometry(); }
  double noise() const noexcept { return m_noise; } ///< standard deviation, image units

  Eigen::Vector3f voxelOf(const Eigen::Vector3d& patient) const noexcept
  {
    return geometry().voxelFromPatient(patient).cast<float>();
  }

  /// Trilinear, at a continuous voxel position; clamped to the hull of the voxel centres.
  float sample(const Eigen::Vector3f& voxel) const noexcept;

  float atPatient(const Eigen::Vector3d& patient) const noexcept
  {
    return sample(voxelOf(patient));
  }

private:
  double estimateNoise() const;

  volume::Volume<float> m_voxels;
  std::array<std::ptrdiff_t, 3> m_stride{};
  double m_noise = 0.0;
};

/// Optimally oriented flux of an image for tubes of a few radii, discretised as differences across
/// a sphere:
///   Q = 3/N sum_j d_j n_j n_j^T,  d_j = s (I(x + (r + e) n_j) - I(x + (r - i) n_j))
/// [Law and Chung 2008, Eq. 3, 6]. d_j is limited to the tube's contrast, so that a stronger border
/// behind a thin wall does not outweigh the tube's own.
class TubeFlux
{
public:
  TubeFlux(const TubeImage& image, bool isBright, const std::vector<double>& radii,
           double contrastCap);

  struct Response
  {
    double value = 0.0; ///< image units: about the contrast on the axis of a tube
    double radius = 0.0;
  };

  /// The best over the radii at a patient position.
  Response at(const Eigen::Vector3d& patient) const;

  /// Standard deviation of the values inside the tube of the first radius: large where the tube
  /// is none.
  double unevenness(const Eigen::Vector3d& patient) const;

private:
  struct Scale
  {
    double radius;
    std::vector<Eigen::Vector3f> inner; ///< offsets in voxels, of directions n_j, then -n_j
    std::vector<Eigen::Vector3f> outer;
  };

  const TubeImage& m_image;
  float m_sign;
  float m_cap;
  std::vector<Scale> m_scales;
};

/// Where a point's axis is.
struct SnappedPoint
{
  Eigen::Vector3d position;
  bool held = false; ///< no axis within reach: the point itself
};

TubeModel estimateModel(const TubeImage& image, const std::vector<Eigen::Vector3d>& points,
                        const TubeOptions& options, const core::Progress& progress);

std::vector<SnappedPoint> snapPoints(const TubeImage& image,
                                     const std::vector<Eigen::Vector3d>& points,
                                     const TubeModel& model, const TubeOptions& options);

/// How far the path between two points may leave the straight line, mm.
double legReach(double legLength, double radius) noexcept;

/// The path of least cost between two positions, both included.
std::vector<Eigen::Vector3d> findLeg(const TubeImage& image, const Eigen::Vector3d& from,
                                     const Eigen::Vector3d& to, const TubeModel& model,
                                     const core::Progress& progress);

} // namespace petrous::segmentation
