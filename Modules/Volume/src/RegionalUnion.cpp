#include "petrous/Volume/RegionalUnion.h"

#include <algorithm>

#include <tbb/parallel_for.h>

#include "LabelShare.h"
#include "SurfaceNet.h"

namespace petrous::volume
{

namespace
{

constexpr int kEdge = LabelTiles::kEdge;

// Points of a net: where regions asked for more, the whole of a head's structures is cheaper.
constexpr std::size_t kMostPoints = 2'000'000;

std::size_t tileAt(const core::Index3& dims, int i, int j, int k)
{
  return static_cast<std::size_t>(i) +
         static_cast<std::size_t>(dims[0]) *
             (static_cast<std::size_t>(j) +
              static_cast<std::size_t>(dims[1]) * static_cast<std::size_t>(k));
}

} // namespace

std::shared_ptr<RegionalUnion> RegionalUnion::make(const std::vector<LabelSource>& sources,
                                                   const core::Progress& progress)
{
  std::vector<LabelSource> solid = sources;
  for (LabelSource& source : solid)
    source.solid = true;
  LabelOrder{solid}; // throws what is wrong with them
  std::shared_ptr<RegionalUnion> result(new RegionalUnion);
  if (!onOneGrid(solid))
  {
    result->m_share = makeSolidShare(solid, progress);
    if (!result->m_share)
      return nullptr;
  }
  else
  {
    const std::shared_ptr<const Volume<std::uint8_t>> inside = insideOf(solid, progress);
    if (!inside)
      return nullptr;
    result->m_inside = inside;
    result->m_share = makeZeroVolume<float>(inside->geometry());
    const LabelTiles tiles(inside->geometry().dims());
    result->m_tileDims = tiles.dims();
    result->m_prepared.resize(core::IndexBox{{0, 0, 0}, tiles.dims()}.count(), false);
  }
  result->m_readable = result->m_share;
  return result;
}

void RegionalUnion::prepare(const core::PatientBox& patient, const core::Progress& progress)
{
  if (!m_inside || patient.isEmpty())
    return;
  const core::IndexBox box = m_share->geometry().boxCovering(patient.min(), patient.max());
  if (!box.empty())
    prepare(grown(box, 1), progress); // a position on a voxel may come out beside it
}

void RegionalUnion::prepare(const core::IndexBox& voxels, const core::Progress& progress)
{
  if (!m_inside)
    return;
  const core::IndexBox full = m_share->geometry().fullBox();
  const core::IndexBox box = voxels.intersected(full);
  if (box.empty())
    return;
  std::vector<core::IndexBox> missing;
  std::vector<std::size_t> numbers;
  for (int k = box.lower[2] / kEdge; k <= (box.upper[2] - 1) / kEdge; ++k)
    for (int j = box.lower[1] / kEdge; j <= (box.upper[1] - 1) / kEdge; ++j)
      for (int i = box.lower[0] / kEdge; i <= (box.upper[0] - 1) / kEdge; ++i)
        if (const std::size_t tile = tileAt(m_tileDims, i, j, k); !m_prepared[tile])
        {
          missing.push_back(core::IndexBox{
              {i * kEdge, j * kEdge, k * kEdge},
              {(i + 1) * kEdge, (j + 1) * kEdge,
               (k + 1) * kEdge}}.intersected(full));
          numbers.push_back(tile);
        }
  if (missing.empty())
    return;
  if (2 * missing.size() > m_prepared.size())
  {
    prepareAll(progress);
    return;
  }
  SurfaceNet net(*m_inside, missing, progress);
  m_pointsRelaxed += net.points();
  if (m_pointsRelaxed > kMostPoints)
  {
    prepareAll(progress);
    return;
  }
  net.relax(progress);
  tbb::parallel_for(std::size_t{0}, missing.size(),
                    [&](std::size_t n) { net.writeShareIn(missing[n], *m_share); });
  for (const std::size_t tile : numbers)
    m_prepared[tile] = true;
  m_preparedTiles += numbers.size();
}

void RegionalUnion::prepareAll(const core::Progress& progress)
{
  if (!m_inside)
    return;
  const auto whole = smoothedShare(*m_inside, progress);
  // Into the memory that others read already.
  const core::IndexBox full = whole->geometry().fullBox();
  tbb::parallel_for(0, full.upper[2],
                    [&](int k)
                    {
                      for (int j = 0; j < full.upper[1]; ++j)
                      {
                        const float* from = &whole->at(0, j, k);
                        float* to = &m_share->at(0, j, k);
                        for (int i = 0; i < full.upper[0]; ++i)
                          if (from[i] > 0.0F && to[i] != from[i]) // memory is taken where needed
                            to[i] = from[i];
                      }
                    });
  m_prepared.assign(m_prepared.size(), true);
  m_preparedTiles = m_prepared.size();
  m_inside = nullptr;
}

} // namespace petrous::volume
