#include <numeric>
#include <vector>

#include "MaskBuilding.h"
#include "petrous/Segmentation/MaskOperations.h"

// Components connected by faces, from runs of voxels along the first axis and a union-find.
namespace petrous::segmentation
{

namespace
{

struct Run
{
  int first = 0;
  int last = 0; ///< inclusive
};

/// The runs of a mask's voxels of one value within a box, and their components.
class Components
{
public:
  Components(const Mask& mask, const core::IndexBox& box, std::uint8_t value,
             const core::Progress& progress)
    : m_box(box)
    , m_rows(static_cast<std::size_t>(box.size()[1]) * static_cast<std::size_t>(box.size()[2]))
  {
    std::vector<std::vector<Run>> runs(m_rows);
    forEachRow(box, progress, "islands",
               [&](int j, int k)
               {
                 const std::uint8_t* row = &mask.voxels->at(0, j, k);
                 auto& own = runs[rowOf(j, k)];
                 for (int i = box.lower[0]; i < box.upper[0];)
                 {
                   if (row[i] != value)
                   {
                     ++i;
                     continue;
                   }
                   const int first = i;
                   while (i < box.upper[0] && row[i] == value)
                     ++i;
                   own.push_back({first, i - 1});
                 }
               });
    m_starts.resize(m_rows + 1, 0);
    for (std::size_t row = 0; row < m_rows; ++row)
      m_starts[row + 1] = m_starts[row] + runs[row].size();
    m_runs.reserve(m_starts.back());
    for (const auto& own : runs)
      m_runs.insert(m_runs.end(), own.begin(), own.end());
    m_parents.resize(m_runs.size());
    std::iota(m_parents.begin(), m_parents.end(), std::size_t{0});
    for (int k = box.lower[2]; k < box.upper[2]; ++k)
    {
      progress.check("islands");
      for (int j = box.lower[1]; j < box.upper[1]; ++j)
      {
        if (j > box.lower[1])
          join(rowOf(j, k), rowOf(j - 1, k));
        if (k > box.lower[2])
          join(rowOf(j, k), rowOf(j, k - 1));
      }
    }
    m_sizes.resize(m_runs.size(), 0);
    for (std::size_t n = 0; n < m_runs.size(); ++n)
      m_sizes[root(n)] += static_cast<std::uint64_t>(m_runs[n].last - m_runs[n].first + 1);
  }

  std::size_t count() const noexcept { return m_runs.size(); }
  std::uint64_t sizeOf(std::size_t component) const { return m_sizes[component]; }

  std::size_t root(std::size_t n)
  {
    while (m_parents[n] != n)
      n = m_parents[n] = m_parents[m_parents[n]];
    return n;
  }

  /// The component of a voxel, or count().
  std::size_t at(const core::Index3& index)
  {
    if (!m_box.contains(index))
      return count();
    const std::size_t row = rowOf(index[1], index[2]);
    for (std::size_t n = m_starts[row]; n < m_starts[row + 1]; ++n)
      if (index[0] >= m_runs[n].first && index[0] <= m_runs[n].last)
        return root(n);
    return count();
  }

  /// Sets the voxels of the components that `keeps` says to `value`.
  template <class Keeps>
  void write(Voxels& voxels, std::uint8_t value, const Keeps& keeps)
  {
    for (std::size_t row = 0; row < m_rows; ++row)
    {
      const auto height = static_cast<std::size_t>(m_box.size()[1]);
      const int j = m_box.lower[1] + static_cast<int>(row % height);
      const int k = m_box.lower[2] + static_cast<int>(row / height);
      for (std::size_t n = m_starts[row]; n < m_starts[row + 1]; ++n)
        if (keeps(root(n)))
          std::fill(&voxels.at(m_runs[n].first, j, k), &voxels.at(m_runs[n].last, j, k) + 1, value);
    }
  }

  /// Whether a run of each component touches a face of `grid`.
  std::vector<bool> reachingBorder(const core::IndexBox& grid)
  {
    std::vector<bool> reaches(count(), false);
    for (std::size_t row = 0; row < m_rows; ++row)
    {
      const auto height = static_cast<std::size_t>(m_box.size()[1]);
      const int j = m_box.lower[1] + static_cast<int>(row % height);
      const int k = m_box.lower[2] + static_cast<int>(row / height);
      const bool border = j == grid.lower[1] || j == grid.upper[1] - 1 || k == grid.lower[2] ||
                          k == grid.upper[2] - 1;
      for (std::size_t n = m_starts[row]; n < m_starts[row + 1]; ++n)
        if (border || m_runs[n].first == grid.lower[0] || m_runs[n].last == grid.upper[0] - 1)
          reaches[root(n)] = true;
    }
    return reaches;
  }

private:
  std::size_t rowOf(int j, int k) const noexcept
  {
    return static_cast<std::size_t>(k - m_box.lower[2]) *
               static_cast<std::size_t>(m_box.size()[1]) +
           static_cast<std::size_t>(j - m_box.lower[1]);
  }

  void join(std::size_t row, std::size_t other)
  {
    std::size_t a = m_starts[row];
    std::size_t b = m_starts[other];
    while (a < m_starts[row + 1] && b < m_starts[other + 1])
    {
      if (m_runs[a].first <= m_runs[b].last && m_runs[b].first <= m_runs[a].last)
      {
        const std::size_t from = root(a);
        const std::size_t to = root(b);
        m_parents[std::max(from, to)] = std::min(from, to);
      }
      ++(m_runs[a].last < m_runs[b].last ? a : b);
    }
  }

  core::IndexBox m_box;
  std::size_t m_rows;
  std::vector<std::size_t> m_starts; ///< of a row's runs
  std::vector<Run> m_runs;
  std::vector<std::size_t> m_parents;
  std::vector<std::uint64_t> m_sizes;
};

template <class Keeps>
Mask kept(const Mask& mask, Components& components, const Keeps& keeps)
{
  auto voxels = volume::makeZeroVolume<std::uint8_t>(mask.geometry());
  components.write(*voxels, 1, keeps);
  return makeMask(std::move(voxels), mask.extent);
}

} // namespace

Islands islandsOf(const Mask& mask, const core::Progress& progress)
{
  Islands islands;
  if (mask.count == 0)
    return islands;
  Components components(mask, mask.extent, 1, progress);
  for (std::size_t n = 0; n < components.count(); ++n)
    if (components.sizeOf(n) > 0) // else a run of another one
    {
      ++islands.count;
      islands.largest = std::max<std::uint64_t>(islands.largest, components.sizeOf(n));
    }
  return islands;
}

Mask largestIsland(const Mask& mask, const core::Progress& progress)
{
  Components components(mask, mask.extent, 1, progress);
  std::size_t largest = 0;
  for (std::size_t n = 1; n < components.count(); ++n)
    if (components.sizeOf(n) > components.sizeOf(largest))
      largest = n;
  return kept(mask, components, [largest](std::size_t n) { return n == largest; });
}

Mask withoutSmallIslands(const Mask& mask, double volume, const core::Progress& progress)
{
  if (!(volume >= 0.0))
    throw core::InvalidParameter("islands: give a volume of 0 mm3 or more");
  Components components(mask, mask.extent, 1, progress);
  const double voxel = mask.geometry().voxelVolume();
  return kept(mask, components,
              [&](std::size_t n) {
                return static_cast<double>(components.sizeOf(n)) * voxel >= volume * (1.0 - 1e-12);
              });
}

Mask islandsAt(const Mask& mask, const std::vector<Eigen::Vector3d>& points,
               const core::Progress& progress)
{
  Components components(mask, mask.extent, 1, progress);
  std::vector<std::size_t> wanted;
  for (const Eigen::Vector3d& point : points)
  {
    const Eigen::Vector3d voxel = mask.geometry().voxelFromPatient(point);
    if (!voxel.allFinite() || !mask.geometry().hullContains(voxel))
      continue;
    core::Index3 index;
    for (int a = 0; a < 3; ++a)
      index[static_cast<std::size_t>(a)] =
          std::clamp(static_cast<int>(std::lround(voxel[a])), 0,
                     mask.geometry().dims()[static_cast<std::size_t>(a)] - 1);
    wanted.push_back(components.at(index));
  }
  return kept(mask, components,
              [&](std::size_t n)
              { return std::find(wanted.begin(), wanted.end(), n) != wanted.end(); });
}

Mask islandsWith(const Mask& mask, const Mask& marks, const core::Progress& progress)
{
  Components components(mask, mask.extent, 1, progress);
  std::vector<bool> isWanted(components.count(), false);
  const core::IndexBox& box = marks.extent;
  for (int k = box.lower[2]; k < box.upper[2]; ++k)
    for (int j = box.lower[1]; j < box.upper[1]; ++j)
      for (int i = box.lower[0]; i < box.upper[0]; ++i)
        if (marks.voxels->at(i, j, k) != 0)
        {
          const std::size_t found = components.at({i, j, k});
          if (found < isWanted.size())
            isWanted[found] = true;
        }
  return kept(mask, components, [&](std::size_t n) { return isWanted[n]; });
}

Mask filled(const Mask& mask, const core::Progress& progress)
{
  const core::IndexBox box = padded(mask.extent, {1, 1, 1}, mask.geometry());
  auto voxels = volume::makeZeroVolume<std::uint8_t>(mask.geometry());
  forEachRow(mask.extent, progress, "filling",
             [&](int j, int k)
             {
               std::copy_n(&mask.voxels->at(mask.extent.lower[0], j, k), mask.extent.size()[0],
                           &voxels->at(mask.extent.lower[0], j, k));
             });
  if (!box.empty())
  {
    Components holes(mask, box, 0, progress);
    const std::vector<bool> outside = holes.reachingBorder(box);
    holes.write(*voxels, 1, [&](std::size_t n) { return !outside[n]; });
  }
  return makeMask(std::move(voxels), mask.extent);
}

} // namespace petrous::segmentation
