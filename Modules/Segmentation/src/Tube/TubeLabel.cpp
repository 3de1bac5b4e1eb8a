#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <set>
#include <utility>
#include <vector>

#include <tbb/parallel_for.h>

#include "petrous/Core/Error.h"
#include "petrous/Segmentation/TubeTrace.h"

namespace petrous::segmentation
{
namespace
{

using Eigen::Vector3d;

/// A cone with rounded ends between neighbouring vertices.
struct Piece
{
  Vector3d start;
  Vector3d along;
  double inverseLength2;
  double radius;
  double widening;

  double distance(const Vector3d& p) const ///< to its surface, negative inside
  {
    const double t = std::clamp((p - start).dot(along) * inverseLength2, 0.0, 1.0);
    return (p - start - t * along).norm() - (radius + t * widening);
  }
};

// Appends the voxels that the line from `a` to `b` crosses (voxel coordinates), each sharing a face
// with the one before it, but for one that is listed already as the last (Amanatides and Woo,
// Eurographics 1987).
void appendCrossed(const Vector3d& a, const Vector3d& b, std::vector<core::Index3>& cells)
{
  core::Index3 cell{}, last{}, step{};
  Vector3d next, stride;
  for (int axis = 0; axis < 3; ++axis)
  {
    const auto n = static_cast<std::size_t>(axis);
    const double from = a[axis] + 0.5;
    const double way = b[axis] - a[axis];
    cell[n] = static_cast<int>(std::floor(from));
    last[n] = static_cast<int>(std::floor(b[axis] + 0.5));
    step[n] = last[n] < cell[n] ? -1 : 1;
    stride[axis] = 1.0 / std::abs(way); // infinite where it does not move: no step is left there
    next[axis] = (step[n] > 0 ? cell[n] + 1 - from : from - cell[n]) * stride[axis];
  }
  if (cells.empty() || cells.back() != cell)
    cells.push_back(cell);
  while (cell != last)
  {
    std::size_t nearest = 3;
    for (std::size_t n = 0; n < 3; ++n)
      if (cell[n] != last[n] &&
          (nearest == 3 || next[static_cast<int>(n)] < next[static_cast<int>(nearest)]))
        nearest = n;
    cell[nearest] += step[nearest];
    next[static_cast<int>(nearest)] += stride[static_cast<int>(nearest)];
    cells.push_back(cell);
  }
}

using Cells = std::vector<core::Index3>;
using Cell = Cells::const_iterator;

// Whether the segment's voxels connect the two cells, through faces, within a voxel of the way.
bool areConnected(const volume::Volume<std::uint16_t>& voxels, std::uint16_t index, Cell first,
                  Cell last)
{
  core::Index3 lower = *first;
  core::Index3 upper = *first;
  for (Cell cell = first; cell <= last; ++cell)
    for (std::size_t n = 0; n < 3; ++n)
    {
      lower[n] = std::max(0, std::min(lower[n], (*cell)[n] - 1));
      upper[n] = std::min(voxels.geometry().dims()[n] - 1, std::max(upper[n], (*cell)[n] + 1));
    }
  std::set<core::Index3> seen{*first};
  std::vector<core::Index3> open{*first};
  while (!open.empty())
  {
    const core::Index3 cell = open.back();
    open.pop_back();
    if (cell == *last)
      return true;
    for (std::size_t n = 0; n < 3; ++n)
      for (const int side : {-1, 1})
      {
        core::Index3 beside = cell;
        beside[n] += side;
        if (beside[n] >= lower[n] && beside[n] <= upper[n] &&
            voxels.at(beside[0], beside[1], beside[2]) == index && seen.insert(beside).second)
          open.push_back(beside);
      }
  }
  return false;
}

// Closes the gaps along a run of voxels within the grid, each sharing a face with the next; returns
// how many voxels were set.
std::uint64_t bridge(volume::Volume<std::uint16_t>& voxels, std::uint16_t index, Cell first,
                     Cell last)
{
  const auto isSet = [&](const core::Index3& cell)
  { return voxels.at(cell[0], cell[1], cell[2]) == index; };
  std::uint64_t count = 0;
  for (Cell gap = first; gap != last;)
  {
    gap = std::find_if_not(gap, last, isSet);
    const Cell end = std::find_if(gap, last, isSet);
    if (gap == first || end == last || !areConnected(voxels, index, gap - 1, end))
      for (Cell cell = gap; cell != end; ++cell)
        if (!isSet(*cell)) // the line may cross it twice
        {
          voxels.at((*cell)[0], (*cell)[1], (*cell)[2]) = index;
          ++count;
        }
    gap = end;
  }
  return count;
}

} // namespace

TubeLabel labelTube(const Tube& tube, const core::GridGeometry& geometry,
                    const volume::Segment& segment, double scale, const core::Progress& progress)
{
  if (tube.line.size() < 2 || tube.radii.size() != tube.line.size())
    throw core::InvalidParameter("tube: there is no line to label; trace one first");
  if (segment.index == 0)
    throw core::InvalidParameter("tube: label 0 is the background; give 1 to 65535");
  if (!(scale > 0.0) || !std::isfinite(scale))
    throw core::InvalidParameter("tube: the radii's scale must be above 0");
  auto voxels = volume::makeZeroVolume<std::uint16_t>(geometry);

  // A voxel whose centre is farther from the surface than half of its diagonal is all in or out.
  // Subsamples decide about the others.
  const double margin = 0.5 * geometry.spacing().norm();
  constexpr int kSub = 5;
  std::vector<Vector3d> inVoxel;
  for (int k = 0; k < kSub; ++k)
    for (int j = 0; j < kSub; ++j)
      for (int i = 0; i < kSub; ++i)
        inVoxel.emplace_back(geometry.patientFromVoxelLinear() *
                             ((Vector3d(i, j, k).array() + 0.5) / kSub - 0.5).matrix());

  std::vector<Piece> pieces;
  for (std::size_t i = 0; i + 1 < tube.line.size(); ++i)
  {
    const Vector3d along = tube.line[i + 1] - tube.line[i];
    const double length2 = along.squaredNorm();
    pieces.push_back({tube.line[i], along, length2 > 0.0 ? 1.0 / length2 : 0.0,
                      scale * tube.radii[i], scale * (tube.radii[i + 1] - tube.radii[i])});
  }
  // Runs of pieces; each voxel is decided by all pieces of its run and of the neighbouring runs
  // that reach it, so that joints leave no seams.
  const auto boxOf = [&](std::size_t first, std::size_t last)
  {
    Vector3d lower = tube.line[first];
    Vector3d upper = lower;
    double widest = 0.0;
    for (std::size_t i = first; i <= last; ++i)
    {
      lower = lower.cwiseMin(tube.line[i]);
      upper = upper.cwiseMax(tube.line[i]);
      widest = std::max(widest, scale * tube.radii[i]);
    }
    const double reach = widest + margin;
    return geometry.boxCovering((lower.array() - reach).matrix(), (upper.array() + reach).matrix());
  };
  core::IndexBox extent;
  std::uint64_t count = 0;
  constexpr std::size_t kRun = 16;
  for (std::size_t first = 0; first < pieces.size(); first += kRun)
  {
    progress.report(static_cast<double>(first) / static_cast<double>(pieces.size()), "label tube");
    const std::size_t last = std::min(first + kRun, pieces.size());
    const core::IndexBox box = boxOf(first, last);
    if (box.empty())
      continue;
    extent = extent.united(box);
    const std::size_t wideFirst = first > kRun ? first - kRun : 0;
    const std::size_t wideLast = std::min(last + kRun, pieces.size());
    std::atomic<std::uint64_t> added{0};
    tbb::parallel_for(box.lower[2], box.upper[2],
                      [&](int k)
                      {
                        std::uint64_t here = 0;
                        for (int j = box.lower[1]; j < box.upper[1]; ++j)
                          for (int i = box.lower[0]; i < box.upper[0]; ++i)
                          {
                            std::uint16_t& voxel = voxels->at(i, j, k);
                            if (voxel != 0)
                              continue;
                            const Vector3d center = geometry.patientFromVoxel(Vector3d(i, j, k));
                            const auto distanceAt = [&](const Vector3d& p)
                            {
                              double best = pieces[wideFirst].distance(p);
                              for (std::size_t n = wideFirst + 1; n < wideLast; ++n)
                                best = std::min(best, pieces[n].distance(p));
                              return best;
                            };
                            const double d = distanceAt(center);
                            if (d >= margin)
                              continue;
                            int covered = 0;
                            if (d > -margin)
                              for (const Vector3d& offset : inVoxel)
                                covered += distanceAt(center + offset) <= 0.0 ? 1 : 0;
                            if (d <= -margin || 2 * covered >= kSub * kSub * kSub)
                            {
                              voxel = segment.index;
                              ++here;
                            }
                          }
                        added += here;
                      });
    count += added;
  }
  TubeLabel label;
  Cells crossed;
  for (std::size_t i = 0; i + 1 < tube.line.size(); ++i)
    appendCrossed(geometry.voxelFromPatient(tube.line[i]),
                  geometry.voxelFromPatient(tube.line[i + 1]), crossed);
  const auto isWithin = [&](const core::Index3& cell) { return geometry.fullBox().contains(cell); };
  for (Cell first = crossed.begin(); first != crossed.end();)
  {
    first = std::find_if(first, crossed.cend(), isWithin);
    const Cell last = std::find_if_not(first, crossed.cend(), isWithin);
    label.bridging += bridge(*voxels, segment.index, first, last);
    first = last;
  }
  label.map.voxels = std::move(voxels);
  label.map.segments = {segment};
  label.map.segments.front().voxels = count + label.bridging;
  label.map.extent = extent;
  return label;
}

} // namespace petrous::segmentation
