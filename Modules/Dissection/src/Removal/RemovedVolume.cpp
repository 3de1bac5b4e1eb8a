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

// The mask at the corners of the cells that begin in a brick: its voxels and the first ones of the
// bricks above it. Voxels beyond the grid count as untouched.
class BrickCorners
{
public:
  BrickCorners(const CutMask& mask, const core::IndexBox& brick)
  {
    m_values.fill(CutMask::kUntouched);
    const core::IndexBox voxels{
        brick.lower, {brick.lower[0] + kEdge, brick.lower[1] + kEdge, brick.lower[2] + kEdge}};
    const core::IndexBox bricks = mask.bricksCovering(voxels);
    for (int bk = bricks.lower[2]; bk < bricks.upper[2]; ++bk)
      for (int bj = bricks.lower[1]; bj < bricks.upper[1]; ++bj)
        for (int bi = bricks.lower[0]; bi < bricks.upper[0]; ++bi)
        {
          const std::size_t index = mask.brickIndex({bi, bj, bk});
          if (!mask.brick(index))
            continue;
          const core::IndexBox part = mask.brickBox(index).intersected(voxels);
          for (int k = part.lower[2]; k < part.upper[2]; ++k)
            for (int j = part.lower[1]; j < part.upper[1]; ++j)
              for (int i = part.lower[0]; i < part.upper[0]; ++i)
                m_values[at(i - brick.lower[0], j - brick.lower[1], k - brick.lower[2])] =
                    mask.at(i, j, k);
        }
  }

  /// Of the cell at (i, j, k) from the brick's first voxel.
  Corners of(int i, int j, int k) const noexcept
  {
    const std::uint16_t* first = m_values.data() + at(i, j, k);
    return {first[0],
            first[1],
            first[kEdge],
            first[kEdge + 1],
            first[kEdge * kEdge],
            first[kEdge * kEdge + 1],
            first[kEdge * kEdge + kEdge],
            first[kEdge * kEdge + kEdge + 1]};
  }

private:
  static constexpr int kEdge = CutMask::kBrickEdge + 1;
  static std::size_t at(int i, int j, int k) noexcept
  {
    return static_cast<std::size_t>(i + kEdge * (j + kEdge * k));
  }

  std::array<std::uint16_t, kEdge * kEdge * kEdge> m_values;
};

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

  /// The cells whose lowest corner is in this brick.
  void addBrick(std::size_t brick, Count& count) const
  {
    const core::IndexBox box = m_after.brickBox(brick);
    if (!differ(box))
      return;
    const core::Index3& dims = m_after.geometry().dims();
    const BrickCorners before(m_before, box);
    const BrickCorners after(m_after, box);
    const core::Index3& first = box.lower;
    for (int k = first[2]; k < std::min(box.upper[2], dims[2] - 1); ++k)
      for (int j = first[1]; j < std::min(box.upper[1], dims[1] - 1); ++j)
        for (int i = first[0]; i < std::min(box.upper[0], dims[0] - 1); ++i)
          addCell({i, j, k}, before.of(i - first[0], j - first[1], k - first[2]),
                  after.of(i - first[0], j - first[1], k - first[2]), count);
  }

  double pointVolume() const noexcept { return m_sums.partVolume(); } ///< mm^3

private:
  // Whether the brick of these voxels, or one above it whose voxels its cells reach, has changed.
  bool differ(const core::IndexBox& box) const
  {
    const core::IndexBox bricks =
        m_after.bricksCovering({box.lower, {box.upper[0] + 1, box.upper[1] + 1, box.upper[2] + 1}});
    for (int k = bricks.lower[2]; k < bricks.upper[2]; ++k)
      for (int j = bricks.lower[1]; j < bricks.upper[1]; ++j)
        for (int i = bricks.lower[0]; i < bricks.upper[0]; ++i)
        {
          const std::size_t brick = m_after.brickIndex({i, j, k});
          if (m_before.brick(brick) != m_after.brick(brick))
            return true;
        }
    return false;
  }

  // The cell whose lowest corner is `voxel`.
  void addCell(const core::Index3& voxel, const Corners& before, const Corners& after,
               Count& count) const
  {
    const auto [i, j, k] = voxel;
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

std::vector<std::size_t> changedBricks(const CutMask& before, const CutMask& after)
{
  std::vector<std::size_t> bricks;
  for (std::size_t n = 0; n < after.brickCount(); ++n)
    if (after.brick(n) != before.brick(n))
      bricks.push_back(n);
  return bricks;
}

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
                      quadrature.addBrick(all[n], counts[n]);
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
