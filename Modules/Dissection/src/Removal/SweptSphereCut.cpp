#include "petrous/Dissection/SweptSphereCut.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "BurrCoverage.h"
#include "Protection.h"

namespace petrous::dissection
{

namespace
{

using volume::CutMask;

// Returns nullptr if no voxel of the brick is lowered.
CutMask::BrickVersion cutBrick(const CutMask& mask, std::size_t index, const core::IndexBox& box,
                               const BurrCoverage& burr, const ProtectedTissue& keep)
{
  constexpr int edge = CutMask::kBrickEdge;
  const CutMask::BrickVersion old = mask.brick(index);
  std::shared_ptr<CutMask::Brick> changed;
  const core::IndexBox whole = mask.brickBox(index);
  const core::IndexBox part = whole.intersected(box);
  const core::GridGeometry& grid = mask.geometry();
  std::array<std::uint16_t, edge> left{};
  for (int k = part.lower[2]; k < part.upper[2]; ++k)
    for (int j = part.lower[1]; j < part.upper[1]; ++j)
    {
      const auto span = burr.span(j, k, part.lower[0], part.upper[0]);
      const int count = span.end - span.begin;
      if (count <= 0)
        continue;
      const auto first = static_cast<std::size_t>(
          span.begin - whole.lower[0] + edge * (j - whole.lower[1] + edge * (k - whole.lower[2])));
      // Most of what a burr covers in its own cavity is already removed.
      int begin = 0;
      int end = count;
      while (old && begin < end && (*old)[first + static_cast<std::size_t>(begin)] == 0)
        ++begin;
      while (old && begin < end && (*old)[first + static_cast<std::size_t>(end - 1)] == 0)
        --end;
      if (begin == end)
        continue;
      burr.row(span.begin + begin, j, k, end - begin, left.data() + begin);
      for (int n = begin; n < end; ++n)
      {
        const std::size_t at = first + static_cast<std::size_t>(n);
        const std::uint16_t present = changed ? (*changed)[at]
                                      : old   ? (*old)[at]
                                              : CutMask::kUntouched;
        std::uint16_t value = left[static_cast<std::size_t>(n)];
        if (value >= present)
          continue;
        if (!keep.empty())
          value = std::max(value, leastLeft(keep, grid.patientFromVoxel(
                                                      {1.0 * (span.begin + n), 1.0 * j, 1.0 * k})));
        if (value >= present)
          continue;
        if (!changed)
        {
          changed = std::make_shared<CutMask::Brick>();
          if (old)
            *changed = *old;
          else
            changed->fill(CutMask::kUntouched);
        }
        (*changed)[at] = value;
      }
    }
  return changed;
}

// Whether the burr's path is close enough to the box to affect one of its voxels.
bool reaches(const SweptSphere& burr, double reach, const core::GridGeometry& grid,
             const core::IndexBox& box)
{
  Eigen::Vector3d center, half;
  for (int a = 0; a < 3; ++a)
  {
    const auto axis = static_cast<std::size_t>(a);
    center[a] = 0.5 * (box.lower[axis] + box.upper[axis] - 1);
    half[a] = 0.5 * (box.upper[axis] - 1 - box.lower[axis]) * grid.spacing()[a];
  }
  const Eigen::Vector3d p = grid.patientFromVoxel(center);
  const Eigen::Vector3d way = burr.to - burr.from;
  const double square = way.squaredNorm();
  const double t = square > 0.0 ? std::clamp((p - burr.from).dot(way) / square, 0.0, 1.0) : 0.0;
  return (p - burr.from - t * way).norm() <= reach + half.norm();
}

} // namespace

std::vector<std::size_t> cut(CutMask& mask, const SweptSphere& burr, const ProtectedTissue& keep)
{
  if (!(burr.radius > 0.0) || !std::isfinite(burr.radius))
    throw core::InvalidParameter("cut: the burr's radius must be above 0 mm");
  if (!burr.from.allFinite() || !burr.to.allFinite())
    throw core::InvalidParameter("cut: the burr's position is not finite");

  const BurrCoverage coverage(burr, mask.geometry());
  const Eigen::Vector3d margin = Eigen::Vector3d::Constant(coverage.reach());
  const core::IndexBox box = mask.geometry().boxCovering(burr.from.cwiseMin(burr.to) - margin,
                                                         burr.from.cwiseMax(burr.to) + margin);
  if (!box.empty())
    prepare(keep, burr, coverage.reach(), mask.geometry());
  std::vector<std::size_t> changed;
  const core::IndexBox bricks = mask.bricksCovering(box);
  for (int k = bricks.lower[2]; k < bricks.upper[2]; ++k)
    for (int j = bricks.lower[1]; j < bricks.upper[1]; ++j)
      for (int i = bricks.lower[0]; i < bricks.upper[0]; ++i)
      {
        const std::size_t index = mask.brickIndex({i, j, k});
        if (!reaches(burr, coverage.reach(), mask.geometry(), mask.brickBox(index)))
          continue;
        if (auto version = cutBrick(mask, index, box, coverage, keep))
        {
          mask.setBrick(index, std::move(version));
          changed.push_back(index);
        }
      }
  return changed;
}

} // namespace petrous::dissection
