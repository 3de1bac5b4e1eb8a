#include "OccupancySurface.h"

#include <algorithm>
#include <cmath>

#include "petrous/Volume/Sampling.h"

namespace petrous::volume
{

namespace
{

constexpr std::size_t kMaxPoints = 20'000'000;
constexpr int kFinestParts = 2; // of a cell's edge, between points
constexpr int kTurns = 6;
constexpr double kSettled = 0.002;   // voxels: a smaller step is convergence
constexpr double kOnSurface = 0.005; // voxels: tolerance for a point on the surface

} // namespace

OccupancySurface::OccupancySurface(const Volume<float>& occupancy)
  : m_occupancy(occupancy)
  , m_spacing(occupancy.geometry().spacing())
{
  for (Eigen::Index a = 0; a < 3; ++a)
    m_last[a] = occupancy.geometry().dims()[static_cast<std::size_t>(a)] - 1.0;
}

// The first axis runs fastest.
std::array<double, 8> OccupancySurface::corners(const core::Index3& lower,
                                                const core::Index3& upper) const noexcept
{
  std::array<double, 8> values{};
  for (int n = 0; n < 8; ++n)
    values[static_cast<std::size_t>(n)] = double{m_occupancy.at(
        n & 1 ? upper[0] : lower[0], n & 2 ? upper[1] : lower[1], n & 4 ? upper[2] : lower[2])};
  return values;
}

OccupancySurface::Sample OccupancySurface::at(const Eigen::Vector3d& position) const noexcept
{
  const TrilinearCell cell(position.cwiseQuotient(m_spacing), m_occupancy.geometry().dims());
  const std::array<double, 8> c = corners(cell.lower, cell.upper);
  const Eigen::Vector3d& w = cell.weight;
  return {interpolateCell(c, w.x(), w.y(), w.z()) - 0.5,
          gradientInCell(c, w.x(), w.y(), w.z()).cwiseQuotient(m_spacing)};
}

std::vector<core::Index3> OccupancySurface::crossedCells(const core::Progress& progress) const
{
  std::vector<core::Index3> cells;
  const core::Index3& dims = m_occupancy.geometry().dims();
  for (int k = 0; k + 1 < dims[2]; ++k)
  {
    progress.check("measuring structures");
    for (int j = 0; j + 1 < dims[1]; ++j)
    {
      // Number of inside voxels among the four at each end of a cell.
      const auto insideAt = [&](int i)
      {
        return int{m_occupancy.at(i, j, k) > 0.5F} + int{m_occupancy.at(i, j + 1, k) > 0.5F} +
               int{m_occupancy.at(i, j, k + 1) > 0.5F} +
               int{m_occupancy.at(i, j + 1, k + 1) > 0.5F};
      };
      int before = insideAt(0);
      for (int i = 0; i + 1 < dims[0]; ++i)
      {
        const int after = insideAt(i + 1);
        if (before + after != 0 && before + after != 8)
          cells.push_back({i, j, k});
        before = after;
      }
    }
  }
  return cells;
}

std::vector<Eigen::Vector3f> OccupancySurface::points(const core::Progress& progress) const
{
  const std::vector<core::Index3> cells = crossedCells(progress);
  const auto most = [&](int parts)
  { return cells.size() * static_cast<std::size_t>(4 * (parts + 1) * (parts + 1)); };
  int parts = kFinestParts;
  while (parts > 1 && most(parts) > kMaxPoints)
    --parts;
  std::vector<Eigen::Vector3f> points;
  for (std::size_t n = 0; n < cells.size(); ++n)
  {
    if (n % 65536 == 0)
      progress.check("measuring structures");
    forEachCrossing(cells[n], parts,
                    [&points](const Crossing& crossing)
                    { points.push_back(crossing.point.cast<float>()); });
  }
  return points;
}

// Alternately projects onto the surface and slides along it towards the foot of the perpendicular.
// Every point on the surface is an upper bound of the distance, so the minimum is kept.
double OccupancySurface::refined(const Eigen::Vector3d& position,
                                 const Eigen::Vector3f& near) const noexcept
{
  const double h = m_spacing.minCoeff();
  Eigen::Vector3d point = near.cast<double>();
  double best = (position - point).norm();
  for (int turn = 0; turn < kTurns; ++turn)
  {
    const Sample here = at(point);
    const double slope = here.gradient.norm();
    if (!(slope * h > 1e-3))
      break;
    const Eigen::Vector3d normal = here.gradient / slope;
    point -= here.value / slope * normal;
    const Eigen::Vector3d way = position - point;
    const Eigen::Vector3d across = way - way.dot(normal) * normal;
    const bool inside = (point.array() >= 0.0).all() &&
                        (point.array() <= m_last.cwiseProduct(m_spacing).array()).all();
    if (inside && std::abs(at(point).value) < kOnSurface * h * slope)
      best = std::min(best, way.norm());
    if (across.norm() < kSettled * h)
      break;
    point += across;
  }
  return best;
}

} // namespace petrous::volume
