#include "LabelPriority.h"

#include <algorithm>
#include <array>
#include <limits>
#include <mutex>
#include <string>
#include <utility>

#include <tbb/parallel_for.h>

namespace petrous::volume
{

namespace
{

using RankTable = std::vector<LabelRank>; // by voxel value

// The sources on one grid: each array of voxels once, with the box outside which they are 0, and
// the ranks of its values.
struct Map
{
  const Volume<std::uint16_t>* voxels;
  core::IndexBox extent;
  RankTable ranks;
};
struct Group
{
  std::vector<Map> maps;
};

std::vector<Group> groupByGrid(const std::vector<LabelSource>& sources, const LabelOrder& order)
{
  std::vector<Group> groups;
  for (std::size_t s = 0; s < sources.size(); ++s)
  {
    const Volume<std::uint16_t>* voxels = sources[s].labels->voxels.get();
    auto group =
        std::find_if(groups.begin(), groups.end(),
                     [voxels](const Group& g) {
                       return core::sameGrid(g.maps.front().voxels->geometry(), voxels->geometry());
                     });
    if (group == groups.end())
      group = groups.emplace(groups.end());
    auto map = std::find_if(group->maps.begin(), group->maps.end(),
                            [voxels](const Map& m) { return m.voxels == voxels; });
    if (map == group->maps.end())
      map = group->maps.insert(
          group->maps.end(),
          {voxels, extentOf(*sources[s].labels),
           RankTable(std::size_t{std::numeric_limits<std::uint16_t>::max()} + 1, LabelRank{0})});
    LabelRank& rank = map->ranks[sources[s].segment];
    rank = rank == 0 ? order.rankOf[s] : std::min(rank, order.rankOf[s]);
  }
  return groups;
}

// Ranks along the voxels [from, to) of one row; marks `tiles` that contain one. Returns the range
// [first, last) of voxels that have a rank, and whether there are solids and lumens.
struct RowRanks
{
  int first = std::numeric_limits<int>::max();
  int last = 0;
  bool solid = false;
  bool lumen = false;
};

RowRanks rankRow(const std::uint16_t* labels, int from, int to, const RankTable& table,
                 LabelRank lastSolid, LabelRank* ranks, std::uint8_t* tiles)
{
  RowRanks row;
  forEachLabel(labels + from, to - from,
               [&](int n, std::uint16_t label)
               {
                 const LabelRank rank = table[label];
                 if (rank == 0)
                   return;
                 const int i = from + n;
                 ranks[i] = ranks[i] == 0 ? rank : std::min(ranks[i], rank);
                 tiles[i / LabelTiles::kEdge] = 1;
                 row.first = std::min(row.first, i);
                 row.last = i + 1;
                 (rank <= lastSolid ? row.solid : row.lumen) = true;
               });
  return row;
}

LabelPriority rankGroup(const Group& group, const LabelOrder& order, const core::Progress& progress)
{
  const core::GridGeometry& grid = group.maps.front().voxels->geometry();
  const core::Index3 dims = grid.dims();
  LabelPriority result;
  result.voxels = makeZeroVolume<LabelRank>(grid);
  result.tiles = LabelTiles(dims);
  std::mutex mutex;
  for (std::size_t m = 0; m < group.maps.size(); ++m)
  {
    progress.report(static_cast<double>(m) / static_cast<double>(group.maps.size()),
                    "reading structures");
    const Map& map = group.maps[m];
    const core::IndexBox& extent = map.extent;
    const auto rankTiles = [&](int tile)
    {
      progress.check("reading structures");
      LabelPriority part;
      for (int k = std::max(tile * LabelTiles::kEdge, extent.lower[2]);
           k < std::min((tile + 1) * LabelTiles::kEdge, extent.upper[2]); ++k)
        for (int j = extent.lower[1]; j < extent.upper[1]; ++j)
        {
          const RowRanks row = rankRow(&map.voxels->at(0, j, k), extent.lower[0], extent.upper[0],
                                       map.ranks, order.lastSolid, &result.voxels->at(0, j, k),
                                       result.tiles.row(j / LabelTiles::kEdge, tile));
          if (row.last > 0)
            part.box = part.box.united({{row.first, j, k}, {row.last, j + 1, k + 1}});
          part.hasSolid = part.hasSolid || row.solid;
          part.hasLumen = part.hasLumen || row.lumen;
        }
      const std::lock_guard<std::mutex> lock(mutex);
      result.box = result.box.united(part.box);
      result.hasSolid = result.hasSolid || part.hasSolid;
      result.hasLumen = result.hasLumen || part.hasLumen;
    };
    tbb::parallel_for(0, result.tiles.dims()[2], rankTiles);
  }
  return result;
}

[[noreturn]] void refuse(std::size_t source, const std::string& what)
{
  throw core::InvalidParameter("label field: source " + std::to_string(source + 1) + " " + what);
}

} // namespace

LabelOrder::LabelOrder(const std::vector<LabelSource>& sources)
  : rankOf(sources.size(), 0)
  , materialOfRank(1, 0)
{
  constexpr std::size_t most = std::numeric_limits<LabelRank>::max();
  if (sources.size() > most)
    throw core::InvalidParameter("label field: " + std::to_string(sources.size()) +
                                 " sources; at most " + std::to_string(most) + " are taken");
  for (std::size_t s = 0; s < sources.size(); ++s)
  {
    if (!sources[s].labels || !sources[s].labels->voxels)
      refuse(s, "has no label map");
    if (sources[s].segment == 0)
      refuse(s, "asks for segment 0, which means nothing");
    if (sources[s].material == 0)
      refuse(s, "has material 0, which means nothing; give 1 to 255");
  }
  for (const bool solid : {true, false})
  {
    for (std::size_t s = 0; s < sources.size(); ++s)
      if (sources[s].solid == solid)
      {
        rankOf[s] = static_cast<LabelRank>(materialOfRank.size());
        materialOfRank.push_back(sources[s].material);
      }
    if (solid)
      lastSolid = static_cast<LabelRank>(materialOfRank.size() - 1);
  }
}

LabelTiles::LabelTiles(const core::Index3& voxels)
  : m_voxels(voxels)
{
  for (std::size_t a = 0; a < 3; ++a)
    m_dims[a] = (voxels[a] + kEdge - 1) / kEdge;
  m_occupied.assign(core::IndexBox{{0, 0, 0}, m_dims}.count(), 0);
}

core::IndexBox LabelTiles::voxelsOf(int i, int j, int k) const noexcept
{
  const core::IndexBox tile{{i * kEdge, j * kEdge, k * kEdge},
                            {(i + 1) * kEdge, (j + 1) * kEdge, (k + 1) * kEdge}};
  return tile.intersected({{0, 0, 0}, m_voxels});
}

std::size_t LabelTiles::offset(int j, int k) const noexcept
{
  return static_cast<std::size_t>(m_dims[0]) *
         (static_cast<std::size_t>(j) +
          static_cast<std::size_t>(m_dims[1]) * static_cast<std::size_t>(k));
}

bool LabelTiles::any(const core::IndexBox& voxels) const noexcept
{
  const core::IndexBox box = voxels.intersected({{0, 0, 0}, m_voxels});
  if (box.empty())
    return false;
  for (int k = box.lower[2] / kEdge; k <= (box.upper[2] - 1) / kEdge; ++k)
    for (int j = box.lower[1] / kEdge; j <= (box.upper[1] - 1) / kEdge; ++j)
    {
      const std::uint8_t* flags = m_occupied.data() + offset(j, k);
      for (int i = box.lower[0] / kEdge; i <= (box.upper[0] - 1) / kEdge; ++i)
        if (flags[i] != 0)
          return true;
    }
  return false;
}

std::vector<LabelPriority> rankLabels(const std::vector<LabelSource>& sources,
                                      const LabelOrder& order, const core::Progress& progress)
{
  const std::vector<Group> groups = groupByGrid(sources, order);
  std::vector<LabelPriority> result;
  for (std::size_t g = 0; g < groups.size(); ++g)
  {
    const auto count = static_cast<double>(groups.size());
    LabelPriority ranks = rankGroup(
        groups[g], order,
        progress.part(static_cast<double>(g) / count, static_cast<double>(g + 1) / count));
    if (!ranks.box.empty())
      result.push_back(std::move(ranks));
  }
  return result;
}

} // namespace petrous::volume
