#pragma once

#include <algorithm>
#include <array>
#include <cmath>

#include <Eigen/Core>

#include "petrous/Volume/Volume.h"

namespace petrous::volume
{

/// Trilinear interpolation in a cell at the weights x, y, z in [0, 1] of the upper corners: the one
/// place of its arithmetic; each sampler finds its cell by itself. The corners come first axis
/// fastest: number n is the upper one along axis a where bit a of n is set. Always inline, the
/// corners one by one: the servo samples the field thousands of times in a tick, and GCC 12 calls a
/// function where they are an array.
template <class T>
[[gnu::always_inline]] inline T interpolateCell(T c0, T c1, T c2, T c3, T c4, T c5, T c6, T c7, T x,
                                                T y, T z) noexcept
{
  const auto mix = [](T a, T b, T w) { return a + (b - a) * w; };
  return mix(mix(mix(c0, c1, x), mix(c2, c3, x), y), mix(mix(c4, c5, x), mix(c6, c7, x), y), z);
}

template <class T>
using CellCorners = std::array<T, 8>;

template <class T>
T interpolateCell(const CellCorners<T>& c, T x, T y, T z) noexcept
{
  return interpolateCell(c[0], c[1], c[2], c[3], c[4], c[5], c[6], c[7], x, y, z);
}

/// Gradient of `interpolateCell` there, per cell.
template <class T>
Eigen::Matrix<T, 3, 1> gradientInCell(const CellCorners<T>& c, T x, T y, T z) noexcept
{
  const auto mix = [](T a, T b, T w) { return a + (b - a) * w; };
  const T low[2] = {mix(c[0], c[1], x), mix(c[2], c[3], x)};
  const T high[2] = {mix(c[4], c[5], x), mix(c[6], c[7], x)};
  return {mix(mix(c[1] - c[0], c[3] - c[2], y), mix(c[5] - c[4], c[7] - c[6], y), z),
          mix(low[1] - low[0], high[1] - high[0], z),
          mix(high[0], high[1], y) - mix(low[0], low[1], y)};
}

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
    return interpolateCell<double>(
        value(lower[0], lower[1], lower[2]), value(upper[0], lower[1], lower[2]),
        value(lower[0], upper[1], lower[2]), value(upper[0], upper[1], lower[2]),
        value(lower[0], lower[1], upper[2]), value(upper[0], lower[1], upper[2]),
        value(lower[0], upper[1], upper[2]), value(upper[0], upper[1], upper[2]), weight[0],
        weight[1], weight[2]);
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
