#include "ClosestPoints.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "petrous/Volume/Sampling.h"

namespace petrous::volume
{

namespace
{

constexpr std::size_t kMostPoints = 20'000'000;
constexpr int kFinestParts = 2; // of a cell's edge, between points
constexpr int kTurns = 6;
constexpr double kSettled = 0.002;   // voxels: a step that is none
constexpr double kOnSurface = 0.005; // voxels: a point that counts as lying on the surface
constexpr int kMostRounds = 1;       // what is left is put right on the surface itself

} // namespace

ShareSurface::ShareSurface(const Volume<float>& share)
  : m_share(share)
  , m_spacing(share.geometry().spacing())
{
  for (Eigen::Index a = 0; a < 3; ++a)
    m_last[a] = share.geometry().dims()[static_cast<std::size_t>(a)] - 1.0;
}

ShareSurface::Sample ShareSurface::at(const Eigen::Vector3d& position) const noexcept
{
  const TrilinearCell cell(position.cwiseQuotient(m_spacing), m_share.geometry().dims());
  std::array<double, 8> c{}; // x first
  for (int n = 0; n < 8; ++n)
    c[static_cast<std::size_t>(n)] = double{m_share.at(n & 1 ? cell.upper[0] : cell.lower[0],
                                                       n & 2 ? cell.upper[1] : cell.lower[1],
                                                       n & 4 ? cell.upper[2] : cell.lower[2])};
  const auto mix = [](double a, double b, double w) { return a + (b - a) * w; };
  const double x = cell.weight.x();
  const double y = cell.weight.y();
  const double z = cell.weight.z();
  const double x00 = mix(c[0], c[1], x);
  const double x10 = mix(c[2], c[3], x);
  const double x01 = mix(c[4], c[5], x);
  const double x11 = mix(c[6], c[7], x);
  const double low = mix(x00, x10, y);
  const double high = mix(x01, x11, y);
  const Eigen::Vector3d slope(
      mix(mix(c[1] - c[0], c[3] - c[2], y), mix(c[5] - c[4], c[7] - c[6], y), z),
      mix(x10 - x00, x11 - x01, z), high - low);
  return {mix(low, high, z) - 0.5, slope.cwiseQuotient(m_spacing)};
}

std::vector<core::Index3> ShareSurface::crossedCells(const core::Progress& progress) const
{
  std::vector<core::Index3> cells;
  const core::Index3& dims = m_share.geometry().dims();
  for (int k = 0; k + 1 < dims[2]; ++k)
  {
    progress.check("measuring structures");
    for (int j = 0; j + 1 < dims[1]; ++j)
    {
      // How many of the four voxels at each end of a cell are inside.
      const auto insideAt = [&](int i)
      {
        return int{m_share.at(i, j, k) > 0.5F} + int{m_share.at(i, j + 1, k) > 0.5F} +
               int{m_share.at(i, j, k + 1) > 0.5F} + int{m_share.at(i, j + 1, k + 1) > 0.5F};
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

// Where the edges of a finer lattice cross the surface. Along the axes trilinear shares are linear,
// so these points lie on it.
void ShareSurface::addPoints(const core::Index3& cell, int parts,
                             std::vector<Eigen::Vector3f>& points) const
{
  std::array<double, 27> lattice{};
  const auto value = [&](int i, int j, int k) -> double&
  { return lattice[static_cast<std::size_t>(i + 3 * (j + 3 * k))]; };
  const Eigen::Vector3d corner = Eigen::Vector3d(cell[0], cell[1], cell[2]);
  for (int k = 0; k <= parts; ++k)
    for (int j = 0; j <= parts; ++j)
      for (int i = 0; i <= parts; ++i)
        value(i, j, k) = sampleTrilinear(m_share, corner + Eigen::Vector3d(i, j, k) / parts) - 0.5;
  for (int k = 0; k <= parts; ++k)
    for (int j = 0; j <= parts; ++j)
      for (int i = 0; i <= parts; ++i)
      {
        const double here = value(i, j, k);
        const core::Index3 at{i, j, k};
        for (std::size_t a = 0; a < 3; ++a)
        {
          if (at[a] == parts)
            continue;
          core::Index3 to = at;
          ++to[a];
          const double there = value(to[0], to[1], to[2]);
          if ((here > 0.0) == (there > 0.0))
            continue;
          Eigen::Vector3d point(i, j, k);
          point[static_cast<Eigen::Index>(a)] += here / (here - there);
          points.push_back((corner + point / parts).cwiseProduct(m_spacing).cast<float>());
        }
      }
}

std::vector<Eigen::Vector3f> ShareSurface::points(const core::Progress& progress) const
{
  const std::vector<core::Index3> cells = crossedCells(progress);
  const auto most = [&](int parts)
  { return cells.size() * static_cast<std::size_t>(4 * (parts + 1) * (parts + 1)); };
  int parts = kFinestParts;
  while (parts > 1 && most(parts) > kMostPoints)
    --parts;
  std::vector<Eigen::Vector3f> points;
  for (std::size_t n = 0; n < cells.size(); ++n)
  {
    if (n % 65536 == 0)
      progress.check("measuring structures");
    addPoints(cells[n], parts, points);
  }
  return points;
}

// Down onto the surface, along it to below the position, and again. Every point that lies on the
// surface bounds the distance from above, so the least is kept.
double ShareSurface::refined(const Eigen::Vector3d& position,
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

ClosestPoints::ClosestPoints(std::vector<Eigen::Vector3f> points, const core::Index3& dims,
                             const Eigen::Vector3d& origin, double edge,
                             const core::Progress& progress)
  : m_points(std::move(points))
  , m_dims(dims)
  , m_origin(origin.cast<float>())
  , m_edge(static_cast<float>(edge))
{
  const std::size_t count = core::IndexBox{{0, 0, 0}, dims}.count();
  m_closest.assign(count, kNone);
  m_square.assign(count, std::numeric_limits<float>::max());
  if (m_points.empty())
    return;
  start();
  for (int round = 0; round < kMostRounds; ++round)
  {
    bool changed = false;
    for (int n = 0; n < 8; ++n)
    {
      progress.report((round + n / 8.0) / kMostRounds, "measuring structures");
      progress.check("measuring structures");
      changed |= sweep({n & 1 ? -1 : 1, n & 2 ? -1 : 1, n & 4 ? -1 : 1});
    }
    if (!changed)
      break;
  }
}

Eigen::Vector3f ClosestPoints::positionOf(int i, int j, int k) const noexcept
{
  return m_origin + m_edge * Eigen::Vector3i(i, j, k).cast<float>();
}

bool ClosestPoints::relax(std::size_t node, const Eigen::Vector3f& at, std::int32_t point) noexcept
{
  const float square = (m_points[static_cast<std::size_t>(point)] - at).squaredNorm();
  if (!(square < m_square[node]))
    return false;
  m_square[node] = square;
  m_closest[node] = point;
  return true;
}

void ClosestPoints::start()
{
  for (std::size_t n = 0; n < m_points.size(); ++n)
  {
    core::Index3 low;
    core::Index3 high;
    for (std::size_t a = 0; a < 3; ++a)
    {
      const auto axis = static_cast<Eigen::Index>(a);
      const int below = static_cast<int>(std::floor((m_points[n][axis] - m_origin[axis]) / m_edge));
      low[a] = std::max(below - 1, 0);
      high[a] = std::min(below + 2, m_dims[a] - 1);
    }
    for (int k = low[2]; k <= high[2]; ++k)
      for (int j = low[1]; j <= high[1]; ++j)
        for (int i = low[0]; i <= high[0]; ++i)
          relax(static_cast<std::size_t>(i) +
                    static_cast<std::size_t>(m_dims[0]) *
                        (static_cast<std::size_t>(j) +
                         static_cast<std::size_t>(m_dims[1]) * static_cast<std::size_t>(k)),
                positionOf(i, j, k), static_cast<std::int32_t>(n));
  }
}

bool ClosestPoints::sweep(const core::Index3& way)
{
  const auto row = static_cast<std::ptrdiff_t>(m_dims[0]);
  const std::ptrdiff_t plane = row * m_dims[1];
  const auto first = [&](std::size_t a) { return way[a] > 0 ? 0 : m_dims[a] - 1; };
  bool changed = false;
  for (int c = 0, k = first(2); c < m_dims[2]; ++c, k += way[2])
    for (int b = 0, j = first(1); b < m_dims[1]; ++b, j += way[1])
      for (int a = 0, i = first(0); a < m_dims[0]; ++a, i += way[0])
      {
        const std::ptrdiff_t node = i + row * j + plane * k;
        const Eigen::Vector3f at = positionOf(i, j, k);
        // The neighbours along the axes that this sweep has passed.
        for (const int n : {1, 2, 4})
        {
          const int x = n & 1;
          const int y = n >> 1 & 1;
          const int z = n >> 2;
          if (a < x || b < y || c < z)
            continue;
          const std::ptrdiff_t from = node - x * way[0] - y * way[1] * row - z * way[2] * plane;
          const std::int32_t point = m_closest[static_cast<std::size_t>(from)];
          const auto here = static_cast<std::size_t>(node);
          if (point != kNone && point != m_closest[here])
            changed |= relax(here, at, point);
        }
      }
  return changed;
}

} // namespace petrous::volume
