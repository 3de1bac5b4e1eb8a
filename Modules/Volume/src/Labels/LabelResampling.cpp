#include "LabelResampling.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "ThinStructures.h"
#include "petrous/Core/NumberText.h"
#include "petrous/Volume/SmoothedUnion.h"

namespace petrous::volume
{

namespace
{

using Eigen::Vector3d;

constexpr double kHalf = 0.5 - 1e-6; // a tie counts as inside
constexpr double kAligned = 5e-3;    // voxels
constexpr int kMaxSamples = 8;       // per axis, in a common voxel

// ---- the common grid

const core::GridGeometry& finestGrid(const std::vector<LabelPriority>& grids)
{
  // Solids decide, so that haptics, which ignores lumens, has the same lattice as the renderer.
  const bool solids =
      std::any_of(grids.begin(), grids.end(), [](const auto& g) { return g.hasSolid; });
  const core::GridGeometry* finest = nullptr;
  for (const LabelPriority& grid : grids)
    if (!solids || grid.hasSolid)
      if (!finest || grid.geometry().voxelVolume() < (1.0 - 1e-6) * finest->voxelVolume())
        finest = &grid.geometry();
  return *finest;
}

core::GridGeometry commonGrid(const std::vector<LabelPriority>& grids, std::size_t maxVoxels,
                              std::vector<std::string>& notes)
{
  const core::GridGeometry& finest = finestGrid(grids);
  Vector3d lower = Vector3d::Constant(1e300);
  Vector3d upper = -lower;
  for (const LabelPriority& grid : grids)
  {
    const core::IndexBox box = grown(grid.box, kLabelMargin);
    for (int corner = 0; corner < 8; ++corner)
    {
      core::Index3 voxel = box.lower;
      for (std::size_t a = 0; a < 3; ++a)
        if ((corner >> a & 1) != 0)
          voxel[a] = box.upper[a] - 1;
      const Vector3d p = finest.voxelFromPatient(grid.geometry().patientFromVoxel(toVector(voxel)));
      lower = lower.cwiseMin(p);
      upper = upper.cwiseMax(p);
    }
  }
  // The corners of the finest grid's own box are integers up to rounding.
  const auto slack = Vector3d::Constant(kAligned);
  lower = (lower + slack).array().floor();
  upper = (upper - slack).array().ceil();
  const Vector3d length = (upper - lower).cwiseProduct(finest.spacing());
  const auto dimsAt = [&length](const Vector3d& spacing)
  { return Vector3d(length.cwiseQuotient(spacing).array().ceil() + 1.0); };

  Vector3d spacing = finest.spacing();
  Vector3d dims = upper - lower + Vector3d::Ones();
  const double wanted = dims.prod();
  constexpr double kGrowth = 1.01;
  for (double least = spacing.minCoeff(); dims.prod() > static_cast<double>(maxVoxels);
       least *= kGrowth)
  {
    spacing = finest.spacing().cwiseMax(least);
    dims = dimsAt(spacing);
  }
  if (dims.prod() < wanted)
  {
    const auto rough = [](double value) { return core::plainText(value, 3); };
    const auto toString = [&rough](const Vector3d& s)
    { return rough(s[0]) + " x " + rough(s[1]) + " x " + rough(s[2]) + " mm"; };
    notes.push_back("structures: their common grid of " + toString(finest.spacing()) +
                    " would take " + rough(wanted / 1e6) +
                    " million voxels; drawn and felt on one of " + toString(spacing));
  }
  const core::Index3 size{static_cast<int>(dims[0]), static_cast<int>(dims[1]),
                          static_cast<int>(dims[2])};
  return {size, spacing, finest.patientFromVoxel(lower), finest.direction()};
}

// ---- one grid, sampled on the common one

struct Sample
{
  double occupancy = 0.0;
  LabelRank rank = 0;
};

// Accumulated samples of a common voxel. Reused between voxels to avoid allocation.
struct Tally
{
  double occupancy = 0.0;
  double solid = 0.0;
  double lumen = 0.0;
  std::vector<std::pair<LabelRank, double>> parts;

  void clear()
  {
    occupancy = solid = lumen = 0.0;
    parts.clear();
  }

  void add(LabelRank rank, double weight)
  {
    const auto found = std::find_if(parts.begin(), parts.end(),
                                    [rank](const auto& part) { return part.first == rank; });
    if (found == parts.end())
      parts.emplace_back(rank, weight);
    else
      found->second += weight;
  }
};

class View
{
public:
  View(const LabelPriority& ranks, const LabelOrder& order, const core::GridGeometry& common,
       const core::Progress& progress)
    : m_ranks(ranks)
    , m_order(order)
    , m_occupancy(smoothRanks(ranks, order, progress))
    , m_box(grown(ranks.box, kLabelMargin))
    , m_linear(ranks.geometry().voxelFromPatientLinear() * common.patientFromVoxelLinear())
    , m_offset(ranks.geometry().voxelFromPatient(common.origin()))
  {
    for (std::size_t a = 0; a < 3; ++a)
    {
      const double extent = m_linear.col(static_cast<Eigen::Index>(a)).norm();
      m_samples[a] = std::clamp(static_cast<int>(std::ceil(extent - 1e-3)), 1, kMaxSamples);
    }
    m_shift = nearestVoxel(m_offset);
    m_aligned = true;
    for (int corner = 0; corner < 8; ++corner)
    {
      Vector3d p = Vector3d::Zero();
      for (int a = 0; a < 3; ++a)
        if ((corner >> a & 1) != 0)
          p[a] = common.dims()[static_cast<std::size_t>(a)] - 1.0;
      const Vector3d off = m_linear * p + m_offset - p - toVector(m_shift);
      m_aligned = m_aligned && off.cwiseAbs().maxCoeff() < kAligned;
    }
  }

  bool aligned() const noexcept { return m_aligned; }
  const LabelPriority& ranks() const noexcept { return m_ranks; }

  // Whether a box of common voxels may contain any structure.
  bool reaches(const core::IndexBox& voxels) const
  {
    const Vector3d low = toVector(voxels.lower);
    const Vector3d high = toVector(voxels.upper) - Vector3d::Ones();
    const Vector3d center = m_linear * (0.5 * (low + high)) + m_offset;
    // Half a common voxel for its samples, two voxels of this grid for filter and interpolation.
    const Vector3d half = m_linear.cwiseAbs() * (0.5 * (high - low) + Vector3d::Constant(0.5)) +
                          Vector3d::Constant(2.0);
    const core::IndexBox box{flooredVoxel(center - half),
                             nearestVoxel(center + half + Vector3d::Ones())};
    return m_ranks.tiles.any(box);
  }

  Sample at(const core::Index3& voxel, Tally& tally) const
  {
    if (m_aligned)
    {
      const core::Index3 own{voxel[0] + m_shift[0], voxel[1] + m_shift[1], voxel[2] + m_shift[2]};
      return {occupancyAt(own), rankAt(own)};
    }
    tally.clear();
    const core::Index3 n = m_samples;
    for (int k = 0; k < n[2]; ++k)
      for (int j = 0; j < n[1]; ++j)
        for (int i = 0; i < n[0]; ++i)
        {
          const Vector3d inVoxel((i + 0.5) / n[0], (j + 0.5) / n[1], (k + 0.5) / n[2]);
          add(m_linear * (toVector(voxel) + inVoxel - Vector3d::Constant(0.5)) + m_offset, tally);
        }
    return judge(tally, 1.0 / (n[0] * n[1] * n[2]));
  }

private:
  LabelRank rankAt(const core::Index3& own) const
  {
    return m_ranks.box.contains(own) ? m_ranks.voxels->at(own[0], own[1], own[2]) : LabelRank{0};
  }

  double occupancyAt(const core::Index3& own) const
  {
    const core::Index3& o = m_box.lower;
    return m_box.contains(own)
               ? static_cast<double>(m_occupancy->at(own[0] - o[0], own[1] - o[1], own[2] - o[2]))
               : 0.0;
  }

  // Adds the eight voxels of this grid around a position.
  void add(const Vector3d& position, Tally& tally) const
  {
    const core::Index3 lower = flooredVoxel(position);
    if (grown({lower, lower}, 1).intersected(m_box).empty())
      return;
    const Vector3d w = position - toVector(lower);
    for (int corner = 0; corner < 8; ++corner)
    {
      core::Index3 own = lower;
      double weight = 1.0;
      for (std::size_t a = 0; a < 3; ++a)
      {
        const bool up = (corner >> a & 1) != 0;
        own[a] += up ? 1 : 0;
        const double along = w[static_cast<Eigen::Index>(a)];
        weight *= up ? along : 1.0 - along;
      }
      tally.occupancy += weight * occupancyAt(own);
      const LabelRank rank = rankAt(own);
      if (rank == 0)
        continue;
      (m_order.isSolid(rank) ? tally.solid : tally.lumen) += weight;
      tally.add(rank, weight);
    }
  }

  Sample judge(const Tally& tally, double scale) const
  {
    const double inside = scale * tally.solid;
    Sample sample;
    sample.occupancy = scale * tally.occupancy;
    const bool solid = inside >= kHalf || sample.occupancy > kInsideOccupancy;
    if (!solid && inside + scale * tally.lumen < kHalf)
      return sample;
    double largest = 0.0;
    for (const auto& [rank, weight] : tally.parts)
      if (m_order.isSolid(rank) == solid &&
          (weight > largest || (weight == largest && rank < sample.rank)))
      {
        sample.rank = rank;
        largest = weight;
      }
    return sample;
  }

  const LabelPriority& m_ranks;
  const LabelOrder& m_order;
  std::shared_ptr<const Volume<float>> m_occupancy;
  core::IndexBox m_box; // of m_occupancy, in voxels of the ranks
  Eigen::Matrix3d m_linear;
  Vector3d m_offset;
  core::Index3 m_samples{1, 1, 1};
  core::Index3 m_shift{};
  bool m_aligned = false;
};

void give(ResampledLabels& labels, const LabelOrder& order, const core::Index3& v, LabelRank rank)
{
  LabelRank& own = labels.ranks.voxels->at(v[0], v[1], v[2]);
  own = own == 0 ? rank : std::min(own, rank);
  if (order.isSolid(rank))
  {
    float& occupancy = labels.occupancy->at(v[0], v[1], v[2]);
    occupancy = std::max(occupancy, quantizedOccupancy(double{kInsideFloor}));
  }
  labels.ranks.tiles.row(v[1] / LabelTiles::kEdge,
                         v[2] / LabelTiles::kEdge)[v[0] / LabelTiles::kEdge] = 1;
}

} // namespace

ResampledLabels resampleLabels(const std::vector<LabelPriority>& grids, const LabelOrder& order,
                               std::size_t maxVoxels, const core::Progress& progress)
{
  ResampledLabels result;
  const core::GridGeometry common = commonGrid(grids, maxVoxels, result.notes);
  const core::Index3 dims = common.dims();
  result.occupancy = makeZeroVolume<float>(common);
  result.ranks.voxels = makeZeroVolume<LabelRank>(common);
  result.ranks.tiles = LabelTiles(dims);
  result.ranks.box = common.fullBox();
  std::vector<View> views;
  views.reserve(grids.size());
  for (const LabelPriority& grid : grids)
  {
    views.emplace_back(grid, order, common, progress.part(0.0, 0.2));
    result.ranks.hasSolid = result.ranks.hasSolid || grid.hasSolid;
    result.ranks.hasLumen = result.ranks.hasLumen || grid.hasLumen;
  }

  const auto sampleTile = [&](const core::Index3& tile, const core::IndexBox& voxels)
  {
    std::vector<const View*> near;
    for (const View& view : views)
      if (view.reaches(voxels))
        near.push_back(&view);
    if (near.empty())
      return;
    bool any = false;
    Tally tally;
    for (int k = voxels.lower[2]; k < voxels.upper[2]; ++k)
      for (int j = voxels.lower[1]; j < voxels.upper[1]; ++j)
        for (int i = voxels.lower[0]; i < voxels.upper[0]; ++i)
        {
          Sample best;
          for (const View* view : near)
          {
            const Sample sample = view->at({i, j, k}, tally);
            best.occupancy = std::max(best.occupancy, sample.occupancy);
            if (sample.rank != 0 && (best.rank == 0 || sample.rank < best.rank))
              best.rank = sample.rank;
          }
          if (best.occupancy > 0.0)
            result.occupancy->at(i, j, k) = quantizedOccupancy(best.occupancy);
          if (best.rank != 0)
            result.ranks.voxels->at(i, j, k) = best.rank;
          any = any || best.rank != 0;
        }
    if (any)
      result.ranks.tiles.row(tile[1], tile[2])[tile[0]] = 1;
  };
  forEachTile(dims, progress.part(0.2, 0.8), "bringing structures onto one grid", sampleTile);

  for (const View& view : views)
    if (!view.aligned())
      for (const ThinVoxel& lift :
           findThin(view.ranks(), result.ranks, *result.occupancy, order, progress.part(0.8, 1.0)))
        give(result, order, lift.voxel, lift.rank);
  return result;
}

} // namespace petrous::volume
