#include "ThinStructures.h"

#include <algorithm>
#include <cmath>

#include <tbb/enumerable_thread_specific.h>

#include "petrous/Volume/Sampling.h"
#include "petrous/Volume/SmoothedUnion.h"

namespace petrous::volume
{

namespace
{

using Eigen::Vector3d;

constexpr int kMaxTouchTests = 16; // per axis, in a voxel of the source
constexpr double kWhole = 0.52;    // minimum occupancy halfway between voxels of a thin structure

class ThinStructures
{
public:
  ThinStructures(const LabelPriority& source, const LabelOrder& order, const LabelPriority& ranks,
                 const Volume<float>& occupancy)
    : m_source(source)
    , m_order(order)
    , m_ranks(ranks)
    , m_occupancy(occupancy)
    , m_linear(ranks.geometry().voxelFromPatientLinear() *
               source.geometry().patientFromVoxelLinear())
    , m_offset(ranks.geometry().voxelFromPatient(source.geometry().origin()))
  {
    for (std::size_t a = 0; a < 3; ++a)
    {
      const double extent = m_linear.col(static_cast<Eigen::Index>(a)).norm();
      m_tests[a] = std::clamp(static_cast<int>(std::ceil(2.0 * extent)), 1, kMaxTouchTests);
    }
  }

  std::vector<ThinVoxel> find(const core::Progress& progress) const
  {
    tbb::enumerable_thread_specific<std::vector<ThinVoxel>> found;
    forEachTile(m_source.geometry().dims(), progress, "keeping thin structures",
                [&](const core::Index3&, const core::IndexBox& tile)
                {
                  if (m_source.tiles.any(tile))
                    findInTile(tile, found.local());
                });
    std::vector<ThinVoxel> all;
    for (const std::vector<ThinVoxel>& part : found)
      all.insert(all.end(), part.begin(), part.end());
    return all;
  }

private:
  void findInTile(const core::IndexBox& tile, std::vector<ThinVoxel>& lifts) const
  {
    for (int k = tile.lower[2]; k < tile.upper[2]; ++k)
      for (int j = tile.lower[1]; j < tile.upper[1]; ++j)
        for (int i = tile.lower[0]; i < tile.upper[0]; ++i)
        {
          const LabelRank rank = m_source.voxels->at(i, j, k);
          if (rank == 0 || !bounds({i, j, k}, rank))
            continue;
          const bool thin = m_order.isSolid(rank) && isThin({i, j, k});
          if (thin && !isWhole({i, j, k}))
            lift({i, j, k}, rank, lifts);
          else if (!showsAt(Vector3d(i, j, k), rank))
            liftUnlessShown({i, j, k}, rank, lifts);
        }
  }

  bool solidAt(const core::Index3& voxel) const
  {
    return m_source.box.contains(voxel) &&
           m_order.isSolid(m_source.voxels->at(voxel[0], voxel[1], voxel[2]));
  }

  // Whether a solid voxel would fall to 1/2 or below with the filter [1 2 1]/4 alone.
  bool isThin(const core::Index3& voxel) const
  {
    int sum = 0;
    forEachNeighbour(
        [&](const core::Index3& step)
        {
          if (!solidAt({voxel[0] + step[0], voxel[1] + step[1], voxel[2] + step[2]}))
            return;
          sum += (2 - std::abs(step[0])) * (2 - std::abs(step[1])) * (2 - std::abs(step[2]));
        });
    constexpr int kHalfWeight = 32; // of 64
    return sum <= kHalfWeight;
  }

  // Whether a thin voxel, and its connections to its neighbours, are inside on the common grid too.
  bool isWhole(const core::Index3& voxel) const
  {
    bool whole = true;
    forEachNeighbour(
        [&](const core::Index3& step)
        {
          for (int corner = 0; corner < 8; ++corner)
          {
            core::Index3 next = voxel;
            for (std::size_t a = 0; a < 3; ++a)
              next[a] += (corner >> a & 1) != 0 ? step[a] : 0;
            if (!solidAt(next))
              return;
          }
          const Vector3d between = toVector(voxel) + 0.5 * toVector(step);
          whole = whole && sampleTrilinear(m_occupancy, m_linear * between + m_offset) > kWhole;
        });
    return whole;
  }

  template <class Visit>
  static void forEachNeighbour(const Visit& visit)
  {
    for (int k = -1; k <= 1; ++k)
      for (int j = -1; j <= 1; ++j)
        for (int i = -1; i <= 1; ++i)
          visit(core::Index3{i, j, k});
  }

  bool bounds(const core::Index3& voxel, LabelRank rank) const
  {
    const core::IndexBox full = m_source.geometry().fullBox();
    for (std::size_t a = 0; a < 3; ++a)
      for (const int step : {-1, 1})
      {
        core::Index3 next = voxel;
        next[a] += step;
        if (!full.contains(next) || m_source.voxels->at(next[0], next[1], next[2]) != rank)
          return true;
      }
    return false;
  }

  // A voxel shows a structure if it carries its rank, or a prior one.
  bool shows(const core::Index3& v, LabelRank rank) const
  {
    const LabelRank own = m_ranks.voxels->at(v[0], v[1], v[2]);
    return own != 0 && own <= rank &&
           (!m_order.isSolid(rank) || m_occupancy.at(v[0], v[1], v[2]) > 0.5F);
  }

  bool showsAt(const Vector3d& position, LabelRank rank) const
  {
    return shows(nearestVoxel(m_linear * position + m_offset), rank);
  }

  // Calls visit(common voxel) for those that a voxel of the source overlaps by a tenth or more.
  template <class Visit>
  void forEachTouched(const core::Index3& voxel, const Visit& visit) const
  {
    constexpr double kReach = 0.4;
    const core::Index3& n = m_tests;
    const auto at = [](int i, int count) { return kReach * (2.0 * i / count - 1.0); };
    for (int k = 0; k <= n[2]; ++k)
      for (int j = 0; j <= n[1]; ++j)
        for (int i = 0; i <= n[0]; ++i)
          visit(nearestVoxel(
              m_linear * (toVector(voxel) + Vector3d(at(i, n[0]), at(j, n[1]), at(k, n[2]))) +
              m_offset));
  }

  void lift(const core::Index3& voxel, LabelRank rank, std::vector<ThinVoxel>& lifts) const
  {
    const std::size_t before = lifts.size();
    forEachTouched(voxel,
                   [&](const core::Index3& touched)
                   {
                     if (lifts.size() == before || lifts.back().voxel != touched)
                       lifts.push_back({touched, rank});
                   });
  }

  void liftUnlessShown(const core::Index3& voxel, LabelRank rank,
                       std::vector<ThinVoxel>& lifts) const
  {
    bool shown = false;
    forEachTouched(voxel,
                   [&](const core::Index3& touched) { shown = shown || shows(touched, rank); });
    if (!shown)
      lift(voxel, rank, lifts);
  }

  const LabelPriority& m_source;
  const LabelOrder& m_order;
  const LabelPriority& m_ranks; // the common grid
  const Volume<float>& m_occupancy;
  Eigen::Matrix3d m_linear; // common voxels per voxel of the source
  Vector3d m_offset;
  core::Index3 m_tests{1, 1, 1};
};

} // namespace

std::vector<ThinVoxel> findThin(const LabelPriority& source, const LabelPriority& common,
                                const Volume<float>& occupancy, const LabelOrder& order,
                                const core::Progress& progress)
{
  return ThinStructures(source, order, common, occupancy).find(progress);
}

} // namespace petrous::volume
