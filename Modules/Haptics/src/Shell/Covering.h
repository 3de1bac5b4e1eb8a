#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <vector>

#include <Eigen/Core>

#include "PointGrid.h"

namespace petrous::haptics
{

using TriangleCorners = std::array<Eigen::Vector3d, 3>; // of a triangle

/// The ball about a triangle's centroid that contains it.
struct TriangleBall
{
  explicit TriangleBall(const TriangleCorners& t)
    : centre((t[0] + t[1] + t[2]) / 3.0)
    , radius(std::max({(t[0] - centre).norm(), (t[1] - centre).norm(), (t[2] - centre).norm()}))
  {
  }
  Eigen::Vector3d centre;
  double radius;
};

/// Appends its halves, bisected at the longest side, so that slivers converge as fast as others.
inline void bisect(const TriangleCorners& t, std::vector<TriangleCorners>& halves)
{
  std::size_t k = 0;
  for (const std::size_t side : {1, 2})
    if ((t[side] - t[(side + 1) % 3]).squaredNorm() > (t[k] - t[(k + 1) % 3]).squaredNorm())
      k = side;
  const Eigen::Vector3d middle = 0.5 * (t[k] + t[(k + 1) % 3]);
  halves.push_back({t[k], middle, t[(k + 2) % 3]});
  halves.push_back({middle, t[(k + 1) % 3], t[(k + 2) % 3]});
}

/// Covering radius of a set of points on a surface: the largest distance of any surface point to
/// the nearest of the set, by branch and bound over triangles.
///
/// A triangle may be in a parameter plane; `map` takes it to the surface and must not expand
/// (|map(a) - map(b)| <= |a - b|). The distance of any of its points to the set is then at most
/// that of its centroid plus the centroid's distance to the farthest corner.
class Covering
{
public:
  using Triangle = TriangleCorners;

  explicit Covering(const PointGrid& grid)
    : m_grid(grid)
  {
  }

  /// A point of the surface: the search is shorter where a large distance is known before.
  void see(const Eigen::Vector3d& point) { m_worst = std::max(m_worst, m_grid.distance(point)); }

  template <typename Map>
  void add(const Triangle& triangle, Map map)
  {
    m_open.assign(1, triangle);
    while (!m_open.empty())
    {
      const Triangle t = m_open.back();
      m_open.pop_back();
      const auto [centre, radius] = TriangleBall(t);
      const double distance = m_grid.distance(map(centre));
      m_worst = std::max(m_worst, distance);
      if (distance + radius > kSlack * m_worst)
        bisect(t, m_open);
    }
  }

  /// A rectangle of the parameter plane, from (0, 0) to (width, height).
  template <typename Map>
  void addRectangle(double width, double height, Map map)
  {
    add({Eigen::Vector3d(0, 0, 0), Eigen::Vector3d(width, 0, 0), Eigen::Vector3d(width, height, 0)},
        map);
    add({Eigen::Vector3d(0, 0, 0), Eigen::Vector3d(width, height, 0),
         Eigen::Vector3d(0, height, 0)},
        map);
  }

  /// Upper bound, at most 1 % above the true value.
  double bound() const { return kSlack * m_worst; }

private:
  static constexpr double kSlack = 1.01;

  const PointGrid& m_grid; ///< owned by the caller
  double m_worst = 1e-9;   ///< above 0, so that the search terminates if points are everywhere
  std::vector<Triangle> m_open;
};

} // namespace petrous::haptics
