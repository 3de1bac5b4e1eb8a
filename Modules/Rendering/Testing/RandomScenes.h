#pragma once

#include <algorithm>
#include <cstdint>
#include <memory>
#include <random>

#include <Eigen/Geometry>

#include "petrous/Volume/CutMask.h"
#include "petrous/Volume/IntensityVolume.h"
#include "petrous/Volume/LabelField.h"

/// Random volumes, labels and cuts, small enough for voxel-wise checks.
namespace petrous::rendering::testing
{

using Random = std::mt19937;

inline int below(Random& random, int limit)
{
  return std::uniform_int_distribution<int>(0, limit - 1)(random);
}

inline double between(Random& random, double low, double high)
{
  return std::uniform_real_distribution<double>(low, high)(random);
}

template <class Visit>
void forEach(const core::IndexBox& box, const Visit& visit)
{
  for (int k = box.lower[2]; k < box.upper[2]; ++k)
    for (int j = box.lower[1]; j < box.upper[1]; ++j)
      for (int i = box.lower[0]; i < box.upper[0]; ++i)
        visit(i, j, k);
}

inline core::GridGeometry obliqueGrid(const core::Index3& dims)
{
  const Eigen::Matrix3d turn =
      Eigen::AngleAxisd(0.4, Eigen::Vector3d(1, 2, -1).normalized()).toRotationMatrix();
  return {dims, {0.3, 0.4, 0.9}, {12, -40, 7}, turn};
}

// Air with a few blobs of bone, each of a few voxels.
template <class T>
std::shared_ptr<volume::Volume<T>> blobs(const core::GridGeometry& grid, Random& random, int count)
{
  auto v = std::make_shared<volume::Volume<T>>(grid, static_cast<T>(0));
  for (int n = 0; n < count; ++n)
  {
    core::IndexBox box;
    for (std::size_t a = 0; a < 3; ++a)
    {
      box.lower[a] = below(random, grid.dims()[a]);
      box.upper[a] = std::min(box.lower[a] + 1 + below(random, 12), grid.dims()[a]);
    }
    const T value = static_cast<T>(below(random, 3000));
    forEach(box, [&](int i, int j, int k) { v->at(i, j, k) = value; });
  }
  return v;
}

template <class T>
std::shared_ptr<const volume::IntensityVolume> image(std::shared_ptr<volume::Volume<T>> voxels)
{
  return std::make_shared<const volume::IntensityVolume>(
      std::shared_ptr<const volume::Volume<T>>(std::move(voxels)));
}

// Random occupancies in a few small boxes, most of them just below the surface threshold, so that a
// single voxel above it affects its neighbourhood widely.
inline volume::LabelField sparseLabels(const core::GridGeometry& grid, Random& random)
{
  auto share = std::make_shared<volume::Volume<float>>(grid, 0.0F);
  for (int n = 0; n < 12; ++n)
  {
    core::IndexBox box;
    for (std::size_t a = 0; a < 3; ++a)
    {
      box.lower[a] = below(random, grid.dims()[a]);
      box.upper[a] = std::min(box.lower[a] + 1 + below(random, a == 0 ? 9 : 4), grid.dims()[a]);
    }
    forEach(box,
            [&](int i, int j, int k)
            {
              const bool high = below(random, 8) == 0;
              share->at(i, j, k) =
                  static_cast<float>(high ? between(random, 0.6, 1.0) : between(random, 0.4, 0.49));
            });
  }
  volume::LabelField labels;
  labels.occupancy = share;
  labels.hasSolid = true;
  return labels;
}

// Removes or restores a ball of voxels.
inline core::IndexBox brush(volume::CutMask& mask, const core::Index3& center, double radius,
                            bool giveBack)
{
  const core::Index3& dims = mask.geometry().dims();
  core::IndexBox box;
  for (std::size_t a = 0; a < 3; ++a)
  {
    const int r = static_cast<int>(radius);
    box.lower[a] = std::max(center[a] - r, 0);
    box.upper[a] = std::min(center[a] + r + 1, dims[a]);
  }
  const core::IndexBox bricks = mask.bricksCovering(box);
  forEach(
      bricks,
      [&](int bi, int bj, int bk)
      {
        const std::size_t index = mask.brickIndex({bi, bj, bk});
        auto brick = std::make_shared<volume::CutMask::Brick>();
        if (mask.brick(index))
          *brick = *mask.brick(index);
        else
          brick->fill(volume::CutMask::kUntouched);
        forEach(mask.brickBox(index).intersected(box),
                [&](int i, int j, int k)
                {
                  const double d =
                      Eigen::Vector3d(i - center[0], j - center[1], k - center[2]).norm() - radius;
                  if (d >= 0.0)
                    return;
                  std::uint16_t& left =
                      (*brick)[static_cast<std::size_t>(i % 16 + 16 * (j % 16 + 16 * (k % 16)))];
                  const double share = std::min(-d, 1.0) * volume::CutMask::kUntouched;
                  left = static_cast<std::uint16_t>(giveBack ? std::min(65535.0, left + share)
                                                             : std::max(0.0, left - share));
                });
        const bool whole =
            std::all_of(brick->begin(), brick->end(), [](std::uint16_t v) { return v == 65535; });
        mask.setBrick(index, whole ? nullptr : volume::CutMask::BrickVersion(brick));
      });
  return box;
}

} // namespace petrous::rendering::testing
