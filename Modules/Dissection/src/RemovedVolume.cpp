#include "petrous/Dissection/RemovedVolume.h"

#include <algorithm>
#include <cmath>
#include <set>

#include <tbb/parallel_for.h>

namespace petrous::dissection
{

namespace
{

using volume::CutMask;

constexpr int kPointsPerAxis = 4;
constexpr std::uint16_t kHalf = CutMask::kUntouched / 2;

// Range of the mask over a voxel and its neighbours: all that interpolation in it can see.
struct MaskRange
{
  std::uint16_t low = CutMask::kUntouched;
  std::uint16_t high = 0;
};

MaskRange rangeAround(const CutMask& mask, const core::Index3& v)
{
  const core::Index3& dims = mask.geometry().dims();
  MaskRange range;
  for (int k = std::max(v[2] - 1, 0); k <= std::min(v[2] + 1, dims[2] - 1); ++k)
    for (int j = std::max(v[1] - 1, 0); j <= std::min(v[1] + 1, dims[1] - 1); ++j)
      for (int i = std::max(v[0] - 1, 0); i <= std::min(v[0] + 1, dims[0] - 1); ++i)
      {
        const std::uint16_t value = mask.at(i, j, k);
        range.low = std::min(range.low, value);
        range.high = std::max(range.high, value);
      }
  return range;
}

// Counts of removed sub-points: all, and those in each structure.
struct Count
{
  std::uint64_t total = 0;
  std::vector<std::uint64_t> structures;
};

class Quadrature
{
public:
  Quadrature(const volume::TissueField& tissue, const CutMask& before, const CutMask& after,
             const std::vector<NamedStructure>& structures)
    : m_tissue(tissue)
    , m_before(before)
    , m_after(after)
    , m_structures(structures)
  {
  }

  void addVoxel(const core::Index3& v, Count& count) const
  {
    const MaskRange after = rangeAround(m_after, v);
    if (after.low > kHalf)
      return; // nothing of it is gone
    const MaskRange before = rangeAround(m_before, v);
    if (before.high <= kHalf)
      return; // all of it was gone already
    const core::GridGeometry& grid = m_before.geometry();
    for (int c = 0; c < kPointsPerAxis; ++c)
      for (int b = 0; b < kPointsPerAxis; ++b)
        for (int a = 0; a < kPointsPerAxis; ++a)
        {
          const auto offset = [](int n) { return (n + 0.5) / kPointsPerAxis - 0.5; };
          const Eigen::Vector3d voxel(v[0] + offset(a), v[1] + offset(b), v[2] + offset(c));
          if (!grid.hullContains(voxel) || m_after.sample(voxel) > 0.5 ||
              m_before.sample(voxel) <= 0.5)
            continue;
          const Eigen::Vector3d p = grid.patientFromVoxel(voxel);
          if (!(m_tissue.uncut(p) > 0.0))
            continue;
          ++count.total;
          addToStructures(p, count);
        }
  }

private:
  void addToStructures(const Eigen::Vector3d& p, Count& count) const
  {
    for (std::size_t s = 0; s < m_structures.size(); ++s)
    {
      const auto& voxels = *m_structures[s].labels->voxels;
      const Eigen::Vector3d v = voxels.geometry().voxelFromPatient(p);
      const core::Index3 nearest{static_cast<int>(std::lround(v[0])),
                                 static_cast<int>(std::lround(v[1])),
                                 static_cast<int>(std::lround(v[2]))};
      if (voxels.geometry().fullBox().contains(nearest) &&
          voxels.at(nearest[0], nearest[1], nearest[2]) == m_structures[s].index)
        ++count.structures[s];
    }
  }

  const volume::TissueField& m_tissue;
  const CutMask& m_before;
  const CutMask& m_after;
  const std::vector<NamedStructure>& m_structures;
};

// A changed voxel is seen from its neighbours too: one voxel round each brick belongs to it.
std::vector<std::size_t> withNeighbours(const CutMask& mask, const std::vector<std::size_t>& bricks)
{
  std::set<std::size_t> all;
  for (const std::size_t brick : bricks)
  {
    const core::IndexBox around = mask.bricksCovering(mask.boxOf({brick}));
    for (int k = around.lower[2]; k < around.upper[2]; ++k)
      for (int j = around.lower[1]; j < around.upper[1]; ++j)
        for (int i = around.lower[0]; i < around.upper[0]; ++i)
          all.insert(mask.brickIndex({i, j, k}));
  }
  return {all.begin(), all.end()};
}

} // namespace

RemovedVolume measureRemoved(const volume::TissueField& tissue, const CutMask& before,
                             const CutMask& after, const std::vector<std::size_t>& bricks,
                             const std::vector<NamedStructure>& structures)
{
  const auto all = withNeighbours(after, bricks);
  const Quadrature quadrature(tissue, before, after, structures);
  std::vector<Count> counts(all.size());
  tbb::parallel_for(std::size_t{0}, all.size(),
                    [&](std::size_t n)
                    {
                      counts[n].structures.resize(structures.size());
                      const core::IndexBox box = after.brickBox(all[n]);
                      for (int k = box.lower[2]; k < box.upper[2]; ++k)
                        for (int j = box.lower[1]; j < box.upper[1]; ++j)
                          for (int i = box.lower[0]; i < box.upper[0]; ++i)
                            quadrature.addVoxel({i, j, k}, counts[n]);
                    });

  // Summed as whole numbers in brick order: the same result whatever the threads did.
  Count sum;
  sum.structures.resize(structures.size());
  for (const Count& count : counts)
  {
    sum.total += count.total;
    for (std::size_t s = 0; s < structures.size(); ++s)
      sum.structures[s] += count.structures[s];
  }
  const double point = after.geometry().voxelVolume() / std::pow(kPointsPerAxis, 3);
  RemovedVolume result;
  result.total = static_cast<double>(sum.total) * point;
  for (std::size_t s = 0; s < structures.size(); ++s)
    if (sum.structures[s] > 0)
      result.structures.push_back(
          {structures[s].name, static_cast<double>(sum.structures[s]) * point});
  return result;
}

} // namespace petrous::dissection
