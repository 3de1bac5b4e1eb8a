#include "ClosestPoints.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace petrous::volume
{

namespace
{

constexpr int kMaxRounds = 1; // remaining errors are corrected on the surface itself

} // namespace

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
  for (int round = 0; round < kMaxRounds; ++round)
  {
    bool changed = false;
    for (int n = 0; n < 8; ++n)
    {
      progress.report((round + n / 8.0) / kMaxRounds, "measuring structures");
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
        // The neighbours that this sweep has already visited.
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
