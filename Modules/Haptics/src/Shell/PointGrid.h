#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

#include <Eigen/Core>

namespace petrous::haptics
{

/// Points binned into cubes, for fast neighbour search. For building shells; allocates. Lengths in
/// the points' own unit.
class PointGrid
{
public:
  /// `cell` is the desired edge of a cube; increased if the box would hold too many cubes.
  PointGrid(const std::vector<Eigen::Vector3d>& points, double cell)
    : m_points(points)
  {
    Eigen::Vector3d high = Eigen::Vector3d::Zero();
    if (!points.empty())
      m_low = high = points.front();
    for (const auto& p : points)
    {
      m_low = m_low.cwiseMin(p);
      high = high.cwiseMax(p);
    }
    const Eigen::Vector3d extent = high - m_low;
    const double most = 8.0 * static_cast<double>(points.size()) + 64.0;
    m_cell = std::max({cell, extent.maxCoeff() / 1000.0, 1e-12});
    const auto cubes = [&] { return ((extent / m_cell).array().floor() + 1.0).prod(); };
    while (cubes() > most)
      m_cell *= 1.25;
    for (int k = 0; k < 3; ++k)
      m_count[k] = static_cast<int>(extent[k] / m_cell) + 1;

    std::vector<std::size_t> home(points.size());
    m_first.assign(static_cast<std::size_t>(m_count[0]) * m_count[1] * m_count[2] + 1, 0);
    for (std::size_t i = 0; i < points.size(); ++i)
    {
      home[i] = cube(place(points[i]));
      ++m_first[home[i] + 1];
    }
    for (std::size_t c = 1; c < m_first.size(); ++c)
      m_first[c] += m_first[c - 1];
    std::vector<std::size_t> next(m_first.begin(), m_first.end() - 1);
    m_order.resize(points.size());
    for (std::size_t i = 0; i < points.size(); ++i)
      m_order[next[home[i]]++] = i;
  }

  /// Calls visit(index) for every point of the cubes that a ball reaches; a few are outside the
  /// ball.
  template <typename Visit>
  void near(const Eigen::Vector3d& centre, double radius, Visit visit) const
  {
    const Cube low = place(centre - Eigen::Vector3d::Constant(radius));
    const Cube high = place(centre + Eigen::Vector3d::Constant(radius));
    for (int z = low[2]; z <= high[2]; ++z)
      for (int y = low[1]; y <= high[1]; ++y)
        for (int x = low[0]; x <= high[0]; ++x)
        {
          const std::size_t c = cube({x, y, z});
          for (std::size_t k = m_first[c]; k < m_first[c + 1]; ++k)
            visit(m_order[k]);
        }
  }

  /// Distance to the nearest point; infinite without points.
  double distance(const Eigen::Vector3d& place) const
  {
    // A ball that contains a point contains the nearest one; doubled until it does or contains all.
    const double all = (m_cell * Eigen::Vector3d(m_count[0], m_count[1], m_count[2])).norm() +
                       2.0 * (place - m_low).norm();
    for (double radius = m_cell;; radius *= 2.0)
    {
      double least = std::numeric_limits<double>::infinity();
      near(place, radius,
           [&](std::size_t i) { least = std::min(least, (m_points[i] - place).norm()); });
      if (least <= radius || radius > all)
        return least;
    }
  }

private:
  using Cube = std::array<int, 3>;

  Cube place(const Eigen::Vector3d& p) const
  {
    Cube c{};
    for (int k = 0; k < 3; ++k)
      c[k] = static_cast<int>(
          std::clamp(std::floor((p[k] - m_low[k]) / m_cell), 0.0, m_count[k] - 1.0));
    return c;
  }
  std::size_t cube(const Cube& c) const
  {
    return (static_cast<std::size_t>(c[2]) * m_count[1] + c[1]) * m_count[0] + c[0];
  }

  const std::vector<Eigen::Vector3d>& m_points; ///< owned by the caller
  Eigen::Vector3d m_low = Eigen::Vector3d::Zero();
  double m_cell = 1.0;
  Cube m_count{};
  std::vector<std::size_t> m_first; ///< of each cube, in m_order
  std::vector<std::size_t> m_order;
};

} // namespace petrous::haptics
