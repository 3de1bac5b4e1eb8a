#pragma once

#include <algorithm>
#include <cmath>
#include <memory>

#include "AnalyticFields.h"

namespace petrous::haptics::testing
{

/// Lowers the mask to what a burr at `centre` leaves, with an edge one voxel wide, or restores it
/// there to untouched; publishes it as the dissection does.
inline void cutBall(Scene& scene, const Eigen::Vector3d& centre, double radius, bool raise = false)
{
  volume::CutMask& mask = *scene.mask;
  const core::GridGeometry& grid = mask.geometry();
  const double h = grid.minSpacing();
  const Eigen::Vector3d reach = Eigen::Vector3d::Constant(radius + h);
  const core::IndexBox box = grid.boxCovering(centre - reach, centre + reach);
  const core::IndexBox bricks = mask.bricksCovering(box);
  for (int bk = bricks.lower[2]; bk < bricks.upper[2]; ++bk)
    for (int bj = bricks.lower[1]; bj < bricks.upper[1]; ++bj)
      for (int bi = bricks.lower[0]; bi < bricks.upper[0]; ++bi)
      {
        const std::size_t index = mask.brickIndex({bi, bj, bk});
        auto brick = std::make_shared<volume::CutMask::Brick>();
        brick->fill(volume::CutMask::kUntouched);
        if (mask.brick(index))
          *brick = *mask.brick(index);
        const core::IndexBox voxels = mask.brickBox(index);
        for (int k = voxels.lower[2]; k < voxels.upper[2]; ++k)
          for (int j = voxels.lower[1]; j < voxels.upper[1]; ++j)
            for (int i = voxels.lower[0]; i < voxels.upper[0]; ++i)
            {
              const double d =
                  (grid.patientFromVoxel({double(i), double(j), double(k)}) - centre).norm();
              const auto left = static_cast<std::uint16_t>(std::lround(
                  volume::CutMask::kUntouched * std::clamp(0.5 + (d - radius) / h, 0.0, 1.0)));
              constexpr int edge = volume::CutMask::kBrickEdge;
              std::uint16_t& voxel = (*brick)[static_cast<std::size_t>(
                  i % edge + edge * (j % edge + edge * (k % edge)))];
              if (raise && left < volume::CutMask::kUntouched)
                voxel = volume::CutMask::kUntouched;
              else if (!raise)
                voxel = std::min(voxel, left);
            }
        mask.setBrick(index, brick);
      }
  scene.published->publish(mask, mask.takeDirty(), raise);
}

} // namespace petrous::haptics::testing
