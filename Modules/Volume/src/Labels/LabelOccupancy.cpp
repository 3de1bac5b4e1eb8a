#include "LabelOccupancy.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "SurfaceNet.h"

namespace petrous::volume
{

namespace
{

constexpr double kSteps = 65535.0;

} // namespace

core::IndexBox grown(const core::IndexBox& box, int voxels) noexcept
{
  core::IndexBox result = box;
  for (std::size_t a = 0; a < 3; ++a)
  {
    result.lower[a] -= voxels;
    result.upper[a] += voxels;
  }
  return result;
}

core::IndexBox moved(const core::IndexBox& box, const core::Index3& by) noexcept
{
  core::IndexBox result = box;
  for (std::size_t a = 0; a < 3; ++a)
  {
    result.lower[a] += by[a];
    result.upper[a] += by[a];
  }
  return result;
}

Eigen::Vector3d toVector(const core::Index3& index) noexcept
{
  return {1.0 * index[0], 1.0 * index[1], 1.0 * index[2]};
}

core::Index3 nearestVoxel(const Eigen::Vector3d& position) noexcept
{
  return flooredVoxel(position + Eigen::Vector3d::Constant(0.5));
}

core::Index3 flooredVoxel(const Eigen::Vector3d& position) noexcept
{
  return {static_cast<int>(std::floor(position[0])), static_cast<int>(std::floor(position[1])),
          static_cast<int>(std::floor(position[2]))};
}

core::GridGeometry gridOf(const core::GridGeometry& grid, const core::IndexBox& box)
{
  return {box.size(), grid.spacing(), grid.patientFromVoxel(toVector(box.lower)), grid.direction()};
}

float quantizedOccupancy(double occupancy) noexcept
{
  return static_cast<float>(std::round(occupancy * kSteps) / kSteps);
}

namespace
{

// A map's voxels, the box outside which they are 0, and the values that are wanted.
struct WantedVoxels
{
  const Volume<std::uint16_t>* voxels;
  core::IndexBox extent;
  std::vector<std::uint8_t> table;
};

std::vector<WantedVoxels> wantedIn(const std::vector<LabelSource>& sources)
{
  std::vector<WantedVoxels> maps;
  for (const LabelSource& source : sources)
  {
    const Volume<std::uint16_t>* voxels = source.labels->voxels.get();
    auto map = std::find_if(maps.begin(), maps.end(),
                            [voxels](const WantedVoxels& m) { return m.voxels == voxels; });
    if (map == maps.end())
      map = maps.insert(maps.end(),
                        {voxels, extentOf(*source.labels),
                         std::vector<std::uint8_t>(
                             std::size_t{std::numeric_limits<std::uint16_t>::max()} + 1, 0)});
    map->table[source.segment] = 1;
  }
  return maps;
}

// Calls visit(i, j) for the wanted voxels of a slice, row by row.
template <class Visit>
void forEachWanted(const WantedVoxels& map, int k, const Visit& visit)
{
  if (k < map.extent.lower[2] || k >= map.extent.upper[2])
    return;
  const int from = map.extent.lower[0];
  for (int j = map.extent.lower[1]; j < map.extent.upper[1]; ++j)
    forEachLabel(&map.voxels->at(from, j, k), map.extent.size()[0],
                 [&](int i, std::uint16_t label)
                 {
                   if (map.table[label] != 0)
                     visit(from + i, j);
                 });
}

} // namespace

bool onOneGrid(const std::vector<LabelSource>& sources)
{
  return std::all_of(sources.begin(), sources.end(),
                     [&sources](const LabelSource& source)
                     {
                       return core::sameGrid(source.labels->voxels->geometry(),
                                             sources.front().labels->voxels->geometry());
                     });
}

std::shared_ptr<const Volume<std::uint8_t>> insideOf(const std::vector<LabelSource>& sources,
                                                     const core::Progress& progress)
{
  if (sources.empty())
    return nullptr;
  const std::vector<WantedVoxels> maps = wantedIn(sources);
  const core::GridGeometry& grid = maps.front().voxels->geometry();
  const core::Index3& dims = grid.dims();
  std::vector<core::IndexBox> slices(static_cast<std::size_t>(dims[2]));
  const auto look = [&](int k)
  {
    progress.check("reading structures");
    core::Index3 low = dims;
    core::Index3 high{-1, -1, k};
    for (const WantedVoxels& map : maps)
      forEachWanted(map, k,
                    [&](int i, int j)
                    {
                      low = {std::min(low[0], i), std::min(low[1], j), k};
                      high = {std::max(high[0], i), std::max(high[1], j), k};
                    });
    if (high[0] >= 0)
      slices[static_cast<std::size_t>(k)] = {low, {high[0] + 1, high[1] + 1, k + 1}};
  };
  tbb::parallel_for(0, dims[2], look);
  core::IndexBox box;
  for (const core::IndexBox& slice : slices)
    box = box.united(slice);
  if (box.empty())
    return nullptr;
  auto inside = makeZeroVolume<std::uint8_t>(gridOf(grid, grown(box, kLabelMargin)));
  const core::IndexBox own = grown(box, kLabelMargin);
  const auto fill = [&](int k)
  {
    progress.check("reading structures");
    for (const WantedVoxels& map : maps)
      forEachWanted(map, k,
                    [&](int i, int j)
                    { inside->at(i - own.lower[0], j - own.lower[1], k - own.lower[2]) = 1; });
  };
  tbb::parallel_for(box.lower[2], box.upper[2], fill);
  return inside;
}

std::shared_ptr<Volume<float>> smoothRanks(const LabelPriority& ranks, const LabelOrder& order,
                                           const core::Progress& progress)
{
  const core::IndexBox box = grown(ranks.box, kLabelMargin);
  const core::GridGeometry geometry = gridOf(ranks.geometry(), box);
  if (!ranks.hasSolid)
    return makeZeroVolume<float>(geometry);
  const auto inside = makeZeroVolume<std::uint8_t>(geometry);
  const core::IndexBox full = ranks.geometry().fullBox();
  const auto fillTile = [&](const core::Index3&, const core::IndexBox& tile)
  {
    const core::IndexBox source = moved(tile, box.lower).intersected(full);
    if (source.empty() || !ranks.tiles.any(source))
      return;
    for (int k = source.lower[2]; k < source.upper[2]; ++k)
      for (int j = source.lower[1]; j < source.upper[1]; ++j)
      {
        const LabelRank* from = &ranks.voxels->at(source.lower[0], j, k);
        std::uint8_t* row =
            &inside->at(source.lower[0] - box.lower[0], j - box.lower[1], k - box.lower[2]);
        for (int i = 0; i < source.size()[0]; ++i)
          row[i] = order.isSolid(from[i]) ? 1 : 0;
      }
  };
  forEachTile(geometry.dims(), progress.part(0.0, 0.1), "smoothing structures", fillTile);
  return smoothedOccupancy(*inside, progress.part(0.1, 1.0));
}

} // namespace petrous::volume
