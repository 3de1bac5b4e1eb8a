#include "petrous/Volume/LabelField.h"

#include <algorithm>
#include <array>
#include <utility>

#include "LabelResampling.h"
#include "SurfaceNet.h"
#include "petrous/Volume/LabelBorders.h"

namespace petrous::volume
{

namespace
{

constexpr auto kThreshold = static_cast<float>(kInsideOccupancy);

// Offset to another voxel, and its squared length.
struct Step
{
  core::Index3 by;
  double distance; // mm^2
};

// All offsets within `reach` voxels on each axis, nearest first.
std::vector<Step> stepsWithin(int reach, const Eigen::Vector3d& spacing)
{
  std::vector<Step> steps;
  for (int k = -reach; k <= reach; ++k)
    for (int j = -reach; j <= reach; ++j)
      for (int i = -reach; i <= reach; ++i)
        if (i != 0 || j != 0 || k != 0)
          steps.push_back(
              {{i, j, k}, Eigen::Vector3d(i, j, k).cwiseProduct(spacing).squaredNorm()});
  std::sort(steps.begin(), steps.end(),
            [](const Step& a, const Step& b) { return a.distance < b.distance; });
  return steps;
}

// The voxels of a tile with an apron as wide as an index is dilated.
template <class T>
class TileCopy
{
public:
  TileCopy(const Volume<T>& volume, const core::IndexBox& tile)
    : m_box(grown(tile, kLabelMargin))
    , m_size(m_box.size())
    , m_values(m_box.count(), T{0})
  {
    const core::IndexBox source = m_box.intersected(volume.geometry().fullBox());
    for (int k = source.lower[2]; k < source.upper[2]; ++k)
      for (int j = source.lower[1]; j < source.upper[1]; ++j)
        std::copy_n(&volume.at(source.lower[0], j, k), source.size()[0],
                    m_values.begin() + at(source.lower[0] - m_box.lower[0], j - m_box.lower[1],
                                          k - m_box.lower[2]));
  }

  // Relative to the tile's first voxel (0, 0, 0).
  std::ptrdiff_t offsetOf(int i, int j, int k) const
  {
    return at(i + kLabelMargin, j + kLabelMargin, k + kLabelMargin);
  }
  std::ptrdiff_t stride(const core::Index3& by) const { return at(by[0], by[1], by[2]); }
  const T* data() const { return m_values.data(); }
  std::size_t size() const { return m_values.size(); }

private:
  std::ptrdiff_t at(int i, int j, int k) const
  {
    return i + std::ptrdiff_t{m_size[0]} * (j + std::ptrdiff_t{m_size[1]} * k);
  }

  core::IndexBox m_box;
  core::Index3 m_size;
  std::vector<T> m_values;
};

class IndexTile
{
public:
  IndexTile(const Volume<LabelRank>& ranks, const core::IndexBox& ranksTile,
            const Volume<float>& occupancy, const core::IndexBox& occupancyTile,
            const LabelOrder& order, const std::vector<Step>& near, const std::vector<Step>& far)
    : m_ranks(ranks, ranksTile)
    , m_occupancy(occupancy, occupancyTile)
    , m_order(order)
    , m_near(withStrides(near))
    , m_far(withStrides(far))
  {
    findKinds();
  }

  std::uint8_t indexOf(int i, int j, int k) const
  {
    const std::ptrdiff_t at = m_ranks.offsetOf(i, j, k);
    const LabelRank own = m_ranks.data()[at];
    if (m_order.isSolid(own))
      return m_order.materialOfRank[own];
    const std::uint8_t kinds = m_kinds[static_cast<std::size_t>(at)];
    if (kinds == 0)
      return 0;
    if (kinds == kSolid)
      return m_order.materialOfRank[nearest(at, m_far, true)];
    if ((kinds & kSolid) != 0 && reachesThreshold(at))
      if (const LabelRank solid = nearest(at, m_far, true))
        return m_order.materialOfRank[solid];
    if (own != 0)
      return m_order.materialOfRank[own];
    if (const LabelRank lumen = nearest(at, m_near, false))
      return m_order.materialOfRank[lumen];
    return m_order.materialOfRank[nearest(at, m_far, true)];
  }

private:
  using Strides = std::vector<std::pair<std::ptrdiff_t, double>>;
  enum Kind : std::uint8_t
  {
    kSolid = 1,
    kLumen = 2
  };

  // Kinds present within kLabelMargin of each voxel of the tile; most have nothing to search.
  void findKinds()
  {
    static_assert(kLabelMargin == 2, "the sums below reach over two voxels");
    m_kinds.resize(m_ranks.size());
    for (std::size_t n = 0; n < m_kinds.size(); ++n)
    {
      const LabelRank rank = m_ranks.data()[n];
      m_kinds[n] = rank == 0 ? 0 : m_order.isSolid(rank) ? kSolid : kLumen;
    }
    std::vector<std::uint8_t> before;
    for (const core::Index3& axis : {core::Index3{1, 0, 0}, {0, 1, 0}, {0, 0, 1}})
    {
      // Sums run across line ends; this affects only the apron, which is not read.
      before = m_kinds;
      const auto stride = static_cast<std::size_t>(m_ranks.stride(axis));
      const std::uint8_t* from = before.data();
      for (std::size_t n = 2 * stride; n + 2 * stride < before.size(); ++n)
        m_kinds[n] = static_cast<std::uint8_t>(from[n - 2 * stride] | from[n - stride] | from[n] |
                                               from[n + stride] | from[n + 2 * stride]);
    }
  }

  Strides withStrides(const std::vector<Step>& steps) const
  {
    Strides result;
    for (const Step& step : steps)
      result.emplace_back(m_ranks.stride(step.by), step.distance);
    return result;
  }

  // The nearest structure of a kind; the first in rank among equidistant ones.
  LabelRank nearest(std::ptrdiff_t at, const Strides& steps, bool solid) const
  {
    constexpr double kTie = 1e-6;
    LabelRank best = 0;
    double reach = 0.0;
    for (const auto& [stride, distance] : steps)
    {
      if (best != 0 && distance > reach)
        break;
      const LabelRank rank = m_ranks.data()[at + stride];
      if (rank == 0 || m_order.isSolid(rank) != solid || (best != 0 && rank >= best))
        continue;
      best = rank;
      reach = distance * (1.0 + kTie);
    }
    return best;
  }

  // Whether the occupancy exceeds the threshold anywhere nearer to this voxel than to another. It
  // is linear along each axis between voxel centres and the planes halfway, so its maximum is at
  // one of those 27 points.
  bool reachesThreshold(std::ptrdiff_t at) const
  {
    const float* occupancy = m_occupancy.data();
    float largest = 0.0F;
    for (const auto& step : m_near)
      largest = std::max(largest, occupancy[at + step.first]);
    if (std::max(largest, occupancy[at]) <= kThreshold)
      return false;
    for (int corner = 0; corner < 27; ++corner)
    {
      const core::Index3 to{corner % 3 - 1, corner / 3 % 3 - 1, corner / 9 - 1};
      float sum = 0.0F;
      for (int end = 0; end < 8; ++end)
        sum += occupancy[at +
                         m_occupancy.stride({(end & 1) != 0 ? to[0] : 0, (end & 2) != 0 ? to[1] : 0,
                                             (end & 4) != 0 ? to[2] : 0})];
      if (sum > 8.0F * kThreshold)
        return true;
    }
    return false;
  }

  TileCopy<LabelRank> m_ranks;
  TileCopy<float> m_occupancy;
  const LabelOrder& m_order;
  Strides m_near;
  Strides m_far;
  std::vector<std::uint8_t> m_kinds;
};

// Writes the index of voxels in solid structures. Returns whether others remain.
bool fillInside(const LabelPriority& ranks, const core::Index3& offset, const core::IndexBox& tile,
                const LabelOrder& order, Volume<std::uint8_t>& index)
{
  const core::IndexBox source = moved(tile, offset).intersected(ranks.geometry().fullBox());
  const int width = source.size()[0];
  std::size_t filled = 0;
  for (int k = source.lower[2]; k < source.upper[2]; ++k)
    for (int j = source.lower[1]; j < source.upper[1]; ++j)
    {
      const LabelRank* from = &ranks.voxels->at(source.lower[0], j, k);
      std::uint8_t* row = &index.at(source.lower[0] - offset[0], j - offset[1], k - offset[2]);
      for (int i = 0; i < width; ++i)
        if (order.isSolid(from[i]))
        {
          row[i] = order.materialOfRank[from[i]];
          ++filled;
        }
    }
  return filled < tile.count();
}

// `offset` maps voxels of the occupancy to those of the ranks.
std::shared_ptr<Volume<std::uint8_t>>
makeIndex(const LabelPriority& ranks, const core::Index3& offset, const Volume<float>& occupancy,
          const LabelOrder& order, const core::Progress& progress)
{
  const auto index = makeZeroVolume<std::uint8_t>(occupancy.geometry());
  const std::vector<Step> near = stepsWithin(1, occupancy.geometry().spacing());
  const std::vector<Step> far = stepsWithin(kLabelMargin, occupancy.geometry().spacing());
  const auto fillTile = [&](const core::Index3&, const core::IndexBox& tile)
  {
    const core::IndexBox ranksTile = moved(tile, offset);
    if (!ranks.tiles.any(grown(ranksTile, kLabelMargin)))
      return;
    const core::Index3 size = tile.size();
    if (!fillInside(ranks, offset, tile, order, *index))
      return;
    const IndexTile source(*ranks.voxels, ranksTile, occupancy, tile, order, near, far);
    for (int k = 0; k < size[2]; ++k)
      for (int j = 0; j < size[1]; ++j)
      {
        std::uint8_t* row = &index->at(tile.lower[0], tile.lower[1] + j, tile.lower[2] + k);
        for (int i = 0; i < size[0]; ++i)
          if (row[i] == 0)
            row[i] = source.indexOf(i, j, k);
      }
  };
  forEachTile(occupancy.geometry().dims(), progress, "growing structures", fillTile);
  return index;
}

} // namespace

std::shared_ptr<const LabelField> makeLabelField(const std::vector<LabelSource>& sources,
                                                 const core::Progress& progress,
                                                 std::size_t maxVoxels)
{
  const LabelOrder order(sources);
  std::vector<LabelPriority> grids = rankLabels(sources, order, progress.part(0.0, 0.3));
  if (grids.empty())
    return nullptr;
  auto field = std::make_shared<LabelField>();
  LabelPriority ranks;
  core::Index3 offset{0, 0, 0};
  if (grids.size() == 1)
  {
    ranks = std::move(grids.front());
    offset = grown(ranks.box, kLabelMargin).lower;
    field->occupancy = smoothRanks(ranks, order, progress.part(0.3, 0.6));
  }
  else
  {
    ResampledLabels common = resampleLabels(grids, order, maxVoxels, progress.part(0.3, 0.7));
    ranks = std::move(common.ranks);
    field->occupancy = std::move(common.occupancy);
    field->notes = std::move(common.notes);
  }
  field->index = makeIndex(ranks, offset, *field->occupancy, order, progress.part(0.7, 0.8));
  std::array<bool, 256> solid{};
  for (LabelRank rank = 1; rank <= order.lastSolid; ++rank)
    solid[order.materialOfRank[rank]] = true;
  field->borders =
      makeLabelBorders(*field->occupancy, *field->index, solid, progress.part(0.8, 1.0));
  field->hasSolid = ranks.hasSolid;
  field->hasLumen = ranks.hasLumen;
  progress.report(1.0, "structures");
  return field;
}

std::shared_ptr<Volume<float>> makeSolidOccupancy(const std::vector<LabelSource>& sources,
                                                  const core::Progress& progress,
                                                  std::size_t maxVoxels)
{
  std::vector<LabelSource> solid = sources;
  for (LabelSource& source : solid)
    source.solid = true;
  const LabelOrder order(solid);
  if (onOneGrid(solid))
  {
    const auto inside = insideOf(solid, progress.part(0.0, 0.2));
    return inside ? smoothedOccupancy(*inside, progress.part(0.2, 1.0)) : nullptr;
  }
  std::vector<LabelPriority> grids = rankLabels(solid, order, progress.part(0.0, 0.3));
  if (grids.empty())
    return nullptr;
  if (grids.size() == 1)
    return smoothRanks(grids.front(), order, progress.part(0.3, 1.0));
  return resampleLabels(grids, order, maxVoxels, progress.part(0.3, 1.0)).occupancy;
}

} // namespace petrous::volume
