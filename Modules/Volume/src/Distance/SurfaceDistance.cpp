#include "petrous/Volume/SurfaceDistance.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <tbb/parallel_sort.h>

#include "OccupancySurface.h"

namespace petrous::volume
{

namespace
{

constexpr std::size_t kBranches = 8; // children of a box of the tree
constexpr int kParts = 2;            // initial sample intervals per cell edge
// Fraction of a cell's diagonal: no part of its surface is farther than that from a sample point.
constexpr double kGap = 0.5;

// Morton code (1966) of the three numbers.
std::uint64_t curve(const std::array<std::uint16_t, 3>& cell)
{
  const auto spread = [](std::uint64_t x)
  {
    x = (x | (x << 32U)) & 0x1f00000000ffffU;
    x = (x | (x << 16U)) & 0x1f0000ff0000ffU;
    x = (x | (x << 8U)) & 0x100f00f00f00f00fU;
    x = (x | (x << 4U)) & 0x10c30c30c30c30c3U;
    return (x | (x << 2U)) & 0x1249249249249249U;
  };
  return spread(cell[0]) | spread(cell[1]) << 1U | spread(cell[2]) << 2U;
}

std::size_t boxesFor(std::size_t count)
{
  return (count + kBranches - 1) / kBranches;
}

} // namespace

struct SurfaceDistance::Search
{
  OccupancySurface surface;
  Eigen::Vector3d position; // mm along the occupancy's axes
  double best;              // mm
};

SurfaceDistance::SurfaceDistance(std::shared_ptr<const Volume<float>> occupancy,
                                 const core::Progress& progress)
  : m_occupancy(std::move(occupancy))
{
  if (!m_occupancy)
    throw core::InvalidParameter("surface distance: no occupancy given");
  for (const int n : m_occupancy->geometry().dims())
    if (n > std::numeric_limits<std::uint16_t>::max())
      throw core::InvalidParameter(
          "surface distance: an occupancy of more than 65535 voxels along one "
          "axis");
  for (const core::Index3& cell : OccupancySurface(*m_occupancy).crossedCells(progress))
    m_cells.push_back({static_cast<std::uint16_t>(cell[0]), static_cast<std::uint16_t>(cell[1]),
                       static_cast<std::uint16_t>(cell[2])});
  tbb::parallel_sort(m_cells.begin(), m_cells.end(),
                     [](const Cell& a, const Cell& b) { return curve(a) < curve(b); });
  if (m_cells.empty())
    return;
  std::vector<Box> boxes(boxesFor(m_cells.size()));
  for (std::size_t n = 0; n < m_cells.size(); ++n)
  {
    Cell upper = m_cells[n];
    for (std::uint16_t& corner : upper)
      ++corner;
    Box& box = boxes[n / kBranches];
    if (n % kBranches == 0)
      box = {m_cells[n], upper};
    for (std::size_t a = 0; a < 3; ++a)
    {
      box.lower[a] = std::min(box.lower[a], m_cells[n][a]);
      box.upper[a] = std::max(box.upper[a], upper[a]);
    }
  }
  m_levels.push_back(std::move(boxes));
  while (m_levels.back().size() > 1)
  {
    const std::vector<Box>& below = m_levels.back();
    std::vector<Box> level(boxesFor(below.size()));
    for (std::size_t n = 0; n < below.size(); ++n)
    {
      Box& box = level[n / kBranches];
      if (n % kBranches == 0)
        box = below[n];
      for (std::size_t a = 0; a < 3; ++a)
      {
        box.lower[a] = std::min(box.lower[a], below[n].lower[a]);
        box.upper[a] = std::max(box.upper[a], below[n].upper[a]);
      }
    }
    m_levels.push_back(std::move(level));
  }
}

std::size_t SurfaceDistance::bytes() const noexcept
{
  std::size_t bytes = m_occupancy->bytes() + m_cells.size() * sizeof(Cell);
  for (const std::vector<Box>& level : m_levels)
    bytes += level.size() * sizeof(Box);
  return bytes;
}

double SurfaceDistance::squareTo(const Box& box, const Eigen::Vector3d& position) const noexcept
{
  double square = 0.0;
  for (std::size_t a = 0; a < 3; ++a)
  {
    const auto axis = static_cast<Eigen::Index>(a);
    const double h = geometry().spacing()[axis];
    const double beyond =
        std::max({box.lower[a] * h - position[axis], position[axis] - box.upper[a] * h, 0.0});
    square += beyond * beyond;
  }
  return square;
}

// Nearest sample point of the cell, refined on the surface if it may be the overall minimum.
void SurfaceDistance::look(Search& search, const Cell& cell) const
{
  double best = std::numeric_limits<double>::max();
  Eigen::Vector3d nearest = Eigen::Vector3d::Zero();
  search.surface.forEachCrossing({cell[0], cell[1], cell[2]}, kParts,
                                 [&](const OccupancySurface::Crossing& crossing)
                                 {
                                   const double square =
                                       (crossing.point - search.position).squaredNorm();
                                   if (square >= best)
                                     return;
                                   best = square;
                                   nearest = crossing.point;
                                 });
  const double gap = kGap * geometry().spacing().norm();
  // The nearest point of the surface is the foot of a perpendicular, so Pythagoras bounds the gap.
  if (best < search.best * search.best + gap * gap)
    search.best =
        std::min(search.best, search.surface.refined(search.position, nearest.cast<float>()));
}

// `look(cell, square)` for cells that may be nearer, `square` is that to their box.
template <class Look>
void SurfaceDistance::visit(Search& search, std::size_t level, std::size_t box,
                            const Look& look) const
{
  const std::size_t first = box * kBranches;
  const std::size_t count = level == 0 ? m_cells.size() : m_levels[level - 1].size();
  const std::size_t last = std::min(first + kBranches, count);
  std::array<std::pair<double, std::size_t>, kBranches> near;
  std::size_t n = 0;
  for (std::size_t part = first; part < last; ++part)
  {
    double square = 0.0;
    if (level == 0)
    {
      Cell upper = m_cells[part];
      for (std::uint16_t& corner : upper)
        ++corner;
      square = squareTo({m_cells[part], upper}, search.position);
    }
    else
      square = squareTo(m_levels[level - 1][part], search.position);
    if (!(square < search.best * search.best))
      continue;
    std::size_t at = n++; // sorted insertion, nearest first
    for (; at > 0 && near[at - 1].first > square; --at)
      near[at] = near[at - 1];
    near[at] = {square, part};
  }
  for (std::size_t i = 0; i < n && near[i].first < search.best * search.best; ++i)
    if (level == 0)
      look(m_cells[near[i].second], near[i].first);
    else
      visit(search, level - 1, near[i].second, look);
}

double SurfaceDistance::at(const Eigen::Vector3d& patient, double most) const
{
  const Eigen::Vector3d voxel = geometry().voxelFromPatient(patient);
  Search search{OccupancySurface(*m_occupancy), voxel.cwiseProduct(geometry().spacing()), most};
  if (!m_levels.empty())
    visit(search, m_levels.size() - 1, 0,
          [&](const Cell& cell, double /*square*/) { look(search, cell); });
  return isInside(voxel, search.position) ? -search.best : search.best;
}

double SurfaceDistance::bound(const Eigen::Vector3d& patient, double most) const
{
  const Eigen::Vector3d voxel = geometry().voxelFromPatient(patient);
  Search search{OccupancySurface(*m_occupancy), voxel.cwiseProduct(geometry().spacing()), most};
  if (isInside(voxel, search.position))
    return -most;
  if (!m_levels.empty())
    visit(search, m_levels.size() - 1, 0,
          [&](const Cell& /*cell*/, double square) { search.best = std::sqrt(square); });
  return search.best;
}

bool SurfaceDistance::isInside(const Eigen::Vector3d& voxel, const Eigen::Vector3d& position) const
{
  return geometry().hullContains(voxel) && OccupancySurface(*m_occupancy).at(position).value > 0.0;
}

} // namespace petrous::volume
