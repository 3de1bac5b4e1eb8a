#include "petrous/Volume/RegionalUnion.h"

#include <map>

#include <tbb/parallel_for.h>

#include "LabelOccupancy.h"
#include "SurfaceNet.h"

namespace petrous::volume
{

namespace
{

constexpr int kEdge = LabelTiles::kEdge;

// Edge, in tiles, of the blocks that are computed at once. The net around a tile is far larger than
// that inside it, and neighbouring tiles are usually requested next.
constexpr int kBlock = 4;

// Points of a net: beyond this the whole of a head's structures is cheaper.
constexpr std::size_t kMaxPoints = 2'000'000;

/// The units of `edge` that a box intersects.
core::IndexBox inUnits(const core::IndexBox& box, int edge)
{
  core::IndexBox units;
  for (std::size_t a = 0; a < 3; ++a)
  {
    units.lower[a] = box.lower[a] / edge;
    units.upper[a] = (box.upper[a] - 1) / edge + 1;
  }
  return units;
}

core::IndexBox times(const core::IndexBox& units, int edge)
{
  core::IndexBox box;
  for (std::size_t a = 0; a < 3; ++a)
  {
    box.lower[a] = units.lower[a] * edge;
    box.upper[a] = units.upper[a] * edge;
  }
  return box;
}

// Calls visit(tile index, its number).
template <class Visit>
void forEachTile(const core::Index3& dims, const core::IndexBox& tiles, const Visit& visit)
{
  for (int k = tiles.lower[2]; k < tiles.upper[2]; ++k)
    for (int j = tiles.lower[1]; j < tiles.upper[1]; ++j)
      for (int i = tiles.lower[0]; i < tiles.upper[0]; ++i)
        visit(core::Index3{i, j, k},
              static_cast<std::size_t>(i) +
                  static_cast<std::size_t>(dims[0]) *
                      (static_cast<std::size_t>(j) +
                       static_cast<std::size_t>(dims[1]) * static_cast<std::size_t>(k)));
}

} // namespace

std::shared_ptr<RegionalUnion> RegionalUnion::make(const std::vector<LabelSource>& sources,
                                                   const core::Progress& progress)
{
  std::vector<LabelSource> solid = sources;
  for (LabelSource& source : solid)
    source.solid = true;
  LabelOrder{solid}; // throws if they are invalid
  std::shared_ptr<RegionalUnion> result(new RegionalUnion);
  if (!onOneGrid(solid))
  {
    result->m_occupancy = makeSolidOccupancy(solid, progress);
    if (!result->m_occupancy)
      return nullptr;
  }
  else
  {
    const std::shared_ptr<const Volume<std::uint8_t>> inside = insideOf(solid, progress);
    if (!inside)
      return nullptr;
    result->m_inside = inside;
    result->m_occupancy = makeZeroVolume<float>(inside->geometry());
    const LabelTiles tiles(inside->geometry().dims());
    result->m_tileDims = tiles.dims();
    result->m_prepared.resize(core::IndexBox{{0, 0, 0}, tiles.dims()}.count(), false);
  }
  result->m_readable = result->m_occupancy;
  return result;
}

void RegionalUnion::prepare(const std::vector<core::PatientBox>& boxes,
                            const core::Progress& progress)
{
  if (!m_inside)
    return;
  std::vector<core::IndexBox> voxels;
  for (const core::PatientBox& patient : boxes)
  {
    if (patient.isEmpty())
      continue;
    const core::IndexBox box = m_occupancy->geometry().boxCovering(patient.min(), patient.max());
    if (!box.empty())
      voxels.push_back(grown(box, 1)); // rounding may move a position on a voxel into the next cell
  }
  prepareVoxels(voxels, progress);
}

void RegionalUnion::prepare(const core::IndexBox& voxels, const core::Progress& progress)
{
  if (m_inside)
    prepareVoxels({voxels}, progress);
}

void RegionalUnion::prepareVoxels(const std::vector<core::IndexBox>& boxes,
                                  const core::Progress& progress)
{
  const core::IndexBox full = m_occupancy->geometry().fullBox();
  const core::IndexBox grid{{0, 0, 0}, m_tileDims};
  std::map<std::size_t, core::IndexBox> missing; // voxels by tile
  for (const core::IndexBox& asked : boxes)
  {
    const core::IndexBox box = asked.intersected(full);
    if (box.empty())
      continue;
    const core::IndexBox tiles = inUnits(box, kEdge);
    bool known = true;
    forEachTile(m_tileDims, tiles,
                [&](const core::Index3&, std::size_t tile) { known = known && m_prepared[tile]; });
    if (known)
      continue;
    const core::IndexBox blocks = inUnits(tiles, kBlock);
    forEachTile(m_tileDims, times(blocks, kBlock).intersected(grid),
                [&](const core::Index3& at, std::size_t tile)
                {
                  if (!m_prepared[tile])
                    missing.emplace(
                        tile,
                        times({at, {at[0] + 1, at[1] + 1, at[2] + 1}}, kEdge).intersected(full));
                });
  }
  if (missing.empty())
    return;
  std::vector<core::IndexBox> targets;
  for (const auto& [tile, voxels] : missing)
    targets.push_back(voxels);
  if (2 * targets.size() > m_prepared.size())
    return prepareAll(progress);
  SurfaceNet net(*m_inside, targets, progress);
  if (m_pointsRelaxed + net.points() > kMaxPoints)
    return prepareAll(progress);
  net.relax(progress);
  m_pointsRelaxed += net.points();
  tbb::parallel_for(std::size_t{0}, targets.size(),
                    [&](std::size_t n) { net.writeOccupancyIn(targets[n], *m_occupancy); });
  for (const auto& [tile, voxels] : missing)
    m_prepared[tile] = true;
  m_preparedTiles += missing.size();
}

void RegionalUnion::prepareAll(const core::Progress& progress)
{
  if (!m_inside)
    return;
  const auto whole = smoothedOccupancy(*m_inside, progress);
  // Into the memory that others already read.
  const core::IndexBox full = whole->geometry().fullBox();
  tbb::parallel_for(0, full.upper[2],
                    [&](int k)
                    {
                      for (int j = 0; j < full.upper[1]; ++j)
                      {
                        const float* from = &whole->at(0, j, k);
                        float* to = &m_occupancy->at(0, j, k);
                        for (int i = 0; i < full.upper[0]; ++i)
                          if (from[i] > 0.0F && to[i] != from[i]) // commit memory only if needed
                            to[i] = from[i];
                      }
                    });
  m_prepared.assign(m_prepared.size(), true);
  m_preparedTiles = m_prepared.size();
  m_inside = nullptr;
}

} // namespace petrous::volume
