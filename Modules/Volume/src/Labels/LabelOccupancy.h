#pragma once

#include <atomic>
#include <string>

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include "LabelPriority.h"

namespace petrous::volume
{

/// Two voxels beyond a structure its occupancy is certainly 0, and its index has ended.
constexpr int kLabelMargin = 2;

/// The renderer treats an occupancy above this as inside (OpticalModel.h, kOccupancyThreshold).
constexpr double kInsideOccupancy = 0.5 - 1e-3;

core::IndexBox grown(const core::IndexBox& box, int voxels) noexcept;
core::IndexBox moved(const core::IndexBox& box, const core::Index3& by) noexcept;

Eigen::Vector3d toVector(const core::Index3& index) noexcept;
core::Index3 nearestVoxel(const Eigen::Vector3d& position) noexcept;
core::Index3 flooredVoxel(const Eigen::Vector3d& position) noexcept;

/// The grid of a box of voxels that may extend beyond `grid`.
core::GridGeometry gridOf(const core::GridGeometry& grid, const core::IndexBox& box);

/// Rounds to a multiple of 1/65535.
float quantizedOccupancy(double occupancy) noexcept;

/// Smoothed union (SmoothedUnion.h) of the solid voxels on their bounding box, grown by
/// kLabelMargin.
std::shared_ptr<Volume<float>> smoothRanks(const LabelPriority& ranks, const LabelOrder& order,
                                           const core::Progress& progress);

/// Whether the sources share one grid.
bool onOneGrid(const std::vector<LabelSource>& sources);

/// Inside voxels of sources on one grid, 1 in any of them and 0 elsewhere, on their bounding box
/// grown by kLabelMargin; nullptr if there are none.
std::shared_ptr<const Volume<std::uint8_t>> insideOf(const std::vector<LabelSource>& sources,
                                                     const core::Progress& progress);

/// Calls body(tile indices, its voxels) for every tile of LabelTiles' size, in parallel.
template <class Body>
void forEachTile(const core::Index3& voxels, const core::Progress& progress,
                 const std::string& text, const Body& body)
{
  const LabelTiles tiles(voxels);
  const core::Index3 n = tiles.dims();
  const int count = static_cast<int>(core::IndexBox{{0, 0, 0}, n}.count());
  constexpr int kReports = 20;
  const int stride = std::max(1, count / kReports);
  std::atomic<int> done{0};
  progress.report(0.0, text);
  tbb::parallel_for(0, count,
                    [&](int t)
                    {
                      progress.check(text);
                      const core::Index3 tile{t % n[0], t / n[0] % n[1], t / n[0] / n[1]};
                      body(tile, tiles.voxelsOf(tile[0], tile[1], tile[2]));
                      const int now = ++done;
                      if (now % stride == 0)
                        progress.report(static_cast<double>(now) / count, text);
                    });
}

} // namespace petrous::volume
