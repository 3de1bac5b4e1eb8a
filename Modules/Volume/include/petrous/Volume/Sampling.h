#pragma once

#include <algorithm>
#include <cmath>

#include <Eigen/Core>

#include "petrous/Volume/Volume.h"

namespace petrous::volume
{

/// Cell and weights of a continuous voxel position inside the hull of the voxel centres.
struct TrilinearCell
{
  core::Index3 lower;
  core::Index3 upper; ///< lower + 1, or lower on the last sample of an axis
  Eigen::Vector3d weight;

  TrilinearCell(const Eigen::Vector3d& voxel, const core::Index3& dims) noexcept
  {
    for (std::size_t a = 0; a < 3; ++a)
    {
      const auto axis = static_cast<Eigen::Index>(a);
      const double last = dims[a] - 1.0;
      const double x = std::clamp(voxel[axis], 0.0, last);
      lower[a] = std::min(static_cast<int>(x), std::max(dims[a] - 2, 0));
      upper[a] = std::min(lower[a] + 1, dims[a] - 1);
      weight[axis] = x - lower[a];
    }
  }

  /// value(i, j, k) -> double returns the value at each of the eight corners.
  template <class Corner>
  double interpolate(const Corner& value) const
  {
    const auto mix = [](double a, double b, double w) { return a + (b - a) * w; };
    const auto row = [&](int j, int k)
    { return mix(value(lower[0], j, k), value(upper[0], j, k), weight[0]); };
    return mix(mix(row(lower[1], lower[2]), row(upper[1], lower[2]), weight[1]),
               mix(row(lower[1], upper[2]), row(upper[1], upper[2]), weight[1]), weight[2]);
  }
};

/// Trilinear interpolation at a continuous voxel position; positions outside the hull of the
/// voxel centres are clamped to it. Pure and thread-safe.
template <class T>
double sampleTrilinear(const Volume<T>& volume, const Eigen::Vector3d& voxel) noexcept
{
  const TrilinearCell cell(voxel, volume.geometry().dims());
  return cell.interpolate([&volume](int i, int j, int k)
                          { return static_cast<double>(volume.at(i, j, k)); });
}

/// Gradient by central differences of `sample(voxel) -> double` over +-step voxels, in patient
/// axes: units of the sample per mm. One-sided at the border.
template <class Sample>
Eigen::Vector3d gradientInPatient(const core::GridGeometry& geometry, const Eigen::Vector3d& voxel,
                                  double step, const Sample& sample)
{
  Eigen::Vector3d slope; // per voxel
  for (int axis = 0; axis < 3; ++axis)
  {
    const double last = geometry.dims()[static_cast<std::size_t>(axis)] - 1.0;
    Eigen::Vector3d low = voxel;
    Eigen::Vector3d high = voxel;
    low[axis] = std::clamp(voxel[axis] - step, 0.0, last);
    high[axis] = std::clamp(voxel[axis] + step, 0.0, last);
    const double run = high[axis] - low[axis];
    slope[axis] = run > 0.0 ? (sample(high) - sample(low)) / run : 0.0;
  }
  return geometry.voxelFromPatientLinear().transpose() * slope;
}

/// Gradient from differences between the twelve points at +-1 voxel on two axes at once. Each
/// difference is averaged over the other axes, so that all three are equally blurred: on CT the
/// normal follows the tissue border, where differences over +-1 voxel on single axes follow its
/// voxel steps.
template <class Sample>
Eigen::Vector3d edgeGradientInPatient(const core::GridGeometry& geometry,
                                      const Eigen::Vector3d& voxel, const Sample& sample)
{
  const core::Index3& dims = geometry.dims();
  const Eigen::Vector3d last(dims[0] - 1.0, dims[1] - 1.0, dims[2] - 1.0);
  const Eigen::Vector3d ends[2] = {(voxel - Eigen::Vector3d::Ones()).cwiseMax(0.0).cwiseMin(last),
                                   (voxel + Eigen::Vector3d::Ones()).cwiseMax(0.0).cwiseMin(last)};
  Eigen::Vector3d slope = Eigen::Vector3d::Zero(); // per voxel
  for (int pair = 0; pair < 12; ++pair)
  {
    const int a = pair / 4;
    const int b = (a + 1) % 3;
    const int endA = pair & 1;
    const int endB = pair >> 1 & 1;
    Eigen::Vector3d at = voxel;
    at[a] = ends[endA][a];
    at[b] = ends[endB][b];
    const double value = sample(at);
    slope[a] += endA != 0 ? value : -value;
    slope[b] += endB != 0 ? value : -value;
  }
  for (int axis = 0; axis < 3; ++axis)
  {
    const double run = 4.0 * (ends[1][axis] - ends[0][axis]);
    slope[axis] = run > 0.0 ? slope[axis] / run : 0.0;
  }
  return geometry.voxelFromPatientLinear().transpose() * slope;
}

/// Gradient of a volume at a continuous voxel position, per mm in patient axes.
template <class T>
Eigen::Vector3d sampleGradient(const Volume<T>& volume, const Eigen::Vector3d& voxel,
                               double step = 0.5)
{
  return gradientInPatient(volume.geometry(), voxel, step,
                           [&](const Eigen::Vector3d& v) { return sampleTrilinear(volume, v); });
}

} // namespace petrous::volume
