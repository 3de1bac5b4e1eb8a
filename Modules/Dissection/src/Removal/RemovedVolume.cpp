#include "petrous/Dissection/RemovedVolume.h"

#include <algorithm>
#include <cmath>
#include <set>

#include <tbb/parallel_for.h>

#include "QuadratureSums.h"

namespace petrous::dissection
{

namespace
{

using volume::CutMask;
using Corners = std::array<std::uint16_t, 8>;

Corners cornersOf(const CutMask& mask, int i, int j, int k)
{
  Corners corners{};
  for (int c = 0; c < 8; ++c)
    corners[static_cast<std::size_t>(c)] = mask.at(i + (c & 1), j + (c >> 1 & 1), k + (c >> 2));
  return corners;
}

// Removed points, in total and in each structure, weighted by the occupancy of their sub-cells.
struct Count
{
  double total = 0.0;
  std::vector<double> structures;
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
    , m_sums(before.geometry())
  {
  }

  /// The cell whose lowest corner is the voxel (i, j, k).
  void addCell(int i, int j, int k, Count& count) const
  {
    const Corners after = cornersOf(m_after, i, j, k);
    const Corners before = cornersOf(m_before, i, j, k);
    CellValues tissue, left, had;
    if (before == after || *std::min_element(after.begin(), after.end()) >= m_sums.high() ||
        *std::max_element(before.begin(), before.end()) <= m_sums.low() ||
        !cellOccupancies(m_tissue, i, j, k, tissue))
      return;
    m_sums.left(before, tissue, had);
    m_sums.left(after, tissue, left);
    std::size_t point = 0;
    for (int c = 0; c < kCellPoints; ++c)
      for (int b = 0; b < kCellPoints; ++b)
        for (int a = 0; a < kCellPoints; ++a, ++point)
          if (const auto gone = static_cast<double>(had[point] - left[point]); gone != 0.0)
          {
            count.total += gone;
            if (!m_structures.empty())
              addToStructures(cellPoint(m_before.geometry(), i, j, k, a, b, c), gone, count);
          }
  }

  double pointVolume() const noexcept { return m_sums.partVolume(); } ///< mm^3

private:
  void addToStructures(const Eigen::Vector3d& p, double gone, Count& count) const
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
        count.structures[s] += gone;
    }
  }

  const volume::TissueField& m_tissue;
  const CutMask& m_before;
  const CutMask& m_after;
  const std::vector<NamedStructure>& m_structures;
  QuadratureSums m_sums;
};

// Cells of adjacent bricks share the changed voxels: include one voxel around each brick.
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
  const core::Index3& dims = after.geometry().dims();
  std::vector<Count> counts(all.size());
  tbb::parallel_for(std::size_t{0}, all.size(),
                    [&](std::size_t n)
                    {
                      counts[n].structures.resize(structures.size());
                      const core::IndexBox box = after.brickBox(all[n]);
                      for (int k = box.lower[2]; k < std::min(box.upper[2], dims[2] - 1); ++k)
                        for (int j = box.lower[1]; j < std::min(box.upper[1], dims[1] - 1); ++j)
                          for (int i = box.lower[0]; i < std::min(box.upper[0], dims[0] - 1); ++i)
                            quadrature.addCell(i, j, k, counts[n]);
                    });

  // Summed in brick order, for a result independent of thread scheduling.
  Count sum;
  sum.structures.resize(structures.size());
  for (const Count& count : counts)
  {
    sum.total += count.total;
    for (std::size_t s = 0; s < structures.size(); ++s)
      sum.structures[s] += count.structures[s];
  }
  RemovedVolume result;
  result.total = sum.total * quadrature.pointVolume();
  for (std::size_t s = 0; s < structures.size(); ++s)
    if (sum.structures[s] > 0.0)
      result.structures.push_back(
          {structures[s].name, sum.structures[s] * quadrature.pointVolume()});
  return result;
}

} // namespace petrous::dissection
