#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <cstddef>
#include <cstdint>
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

} // namespace

volume::LabelMap labelTube(const Tube& tube, const core::GridGeometry& geometry,
                           const volume::Segment& segment, double scale,
                           const core::Progress& progress)
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
  volume::LabelMap map;
  map.voxels = std::move(voxels);
  map.segments = {segment};
  map.segments.front().voxels = count;
  map.extent = extent;
  return map;
}

} // namespace petrous::segmentation
