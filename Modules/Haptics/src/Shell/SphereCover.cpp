#include "SphereCover.h"

#include <algorithm>
#include <cmath>
#include <functional>

#include <Eigen/Geometry>

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include "PointGrid.h"

namespace petrous::haptics
{

namespace
{

constexpr double kPi = 3.14159265358979323846;
// Extra points that a relaxed set needs over the ideal lattice, whose cell is s^2 sqrt(3)/2.
constexpr double kExcess = 1.15;
constexpr std::size_t kEffort = 200000; // cells computed in total: 1 to 2 s

double area(double rim)
{
  return 2.0 * kPi * (1.0 + std::sqrt(std::max(0.0, 1.0 - rim * rim)));
}

// Voronoi cell of a point on the unit sphere, in gnomonic projection onto the tangent plane at the
// point: great circles are lines there, so each neighbour clips a half plane.
class Cell
{
public:
  void make(const std::vector<Eigen::Vector3d>& points, const PointGrid& grid, std::size_t index,
            double reach)
  {
    m_centre = points[index];
    m_right = m_centre.unitOrthogonal();
    m_up = m_centre.cross(m_right);
    const double half = std::min(2.0, reach);
    m_corners = {{-half, -half}, {half, -half}, {half, half}, {-half, half}};
    m_neighbours.clear();
    grid.near(m_centre, reach,
              [&](std::size_t other)
              {
                if (other != index)
                  m_neighbours.emplace_back((points[other] - m_centre).squaredNorm(), other);
              });
    // Nearest first; a heap, because only the nearest few are needed.
    std::make_heap(m_neighbours.begin(), m_neighbours.end(), std::greater<>());
    for (; !m_neighbours.empty(); m_neighbours.pop_back())
    {
      std::pop_heap(m_neighbours.begin(), m_neighbours.end(), std::greater<>());
      const auto [squared, other] = m_neighbours.back();
      double far = 0.0;
      for (const auto& corner : m_corners)
        far = std::max(far, corner.norm());
      // A neighbour beyond twice the farthest corner's angle clips nothing.
      if (squared > 2.0 - 2.0 * std::cos(std::min(2.0 * std::atan(far), kPi)))
        break;
      cut(m_centre - points[other]);
    }
  }

  const std::vector<Eigen::Vector2d>& corners() const { return m_corners; }
  Eigen::Vector3d onSphere(const Eigen::Vector2d& p) const
  {
    return (m_centre + p.x() * m_right + p.y() * m_up).normalized();
  }

  Eigen::Vector2d centroid() const
  {
    double twice = 0.0;
    Eigen::Vector2d sum(0.0, 0.0);
    for (std::size_t k = 0; k < m_corners.size(); ++k)
    {
      const Eigen::Vector2d& a = m_corners[k];
      const Eigen::Vector2d& b = m_corners[(k + 1) % m_corners.size()];
      const double cross = a.x() * b.y() - a.y() * b.x();
      twice += cross;
      sum += cross * (a + b) / 3.0;
    }
    return twice > 0.0 ? Eigen::Vector2d(sum / twice) : Eigen::Vector2d(0.0, 0.0);
  }

  // Centre of the smallest circle around the corners: steps 1/n towards the farthest (Badoiu,
  // Clarkson).
  Eigen::Vector2d middle() const
  {
    Eigen::Vector2d centre(0.0, 0.0);
    for (int n = 2; n < 60; ++n)
    {
      const auto farthest =
          std::max_element(m_corners.begin(), m_corners.end(),
                           [&](const auto& a, const auto& b)
                           { return (a - centre).squaredNorm() < (b - centre).squaredNorm(); });
      centre += (*farthest - centre) / n;
    }
    return centre;
  }

private:
  void cut(const Eigen::Vector3d& inward)
  {
    const double offset = inward.dot(m_centre);
    const Eigen::Vector2d slope(inward.dot(m_right), inward.dot(m_up));
    m_kept.clear();
    for (std::size_t k = 0; k < m_corners.size(); ++k)
    {
      const Eigen::Vector2d& a = m_corners[k];
      const Eigen::Vector2d& b = m_corners[(k + 1) % m_corners.size()];
      const double atA = offset + slope.dot(a);
      const double atB = offset + slope.dot(b);
      if (atA >= 0.0)
        m_kept.push_back(a);
      if ((atA >= 0.0) != (atB >= 0.0))
        m_kept.push_back(a + (b - a) * (atA / (atA - atB)));
    }
    m_corners.swap(m_kept);
  }

  Eigen::Vector3d m_centre, m_right, m_up;
  std::vector<Eigen::Vector2d> m_corners, m_kept;
  std::vector<std::pair<double, std::size_t>> m_neighbours;
};

std::vector<Eigen::Vector3d> firstGuess(double rim, std::size_t count, double side,
                                        std::size_t onRim)
{
  const double top = std::sqrt(std::max(0.0, 1.0 - rim * rim));
  std::vector<Eigen::Vector3d> points;
  for (std::size_t k = 0; k < onRim; ++k)
  {
    const double angle = 2.0 * kPi * static_cast<double>(k) / static_cast<double>(onRim);
    points.emplace_back(rim * std::cos(angle), rim * std::sin(angle), top);
  }
  // The rim's own points cover half a row below it.
  const double run = top - 0.45 * side * rim + 1.0;
  const double golden = kPi * (3.0 - std::sqrt(5.0));
  for (std::size_t k = 0; k < count - onRim; ++k)
  {
    const double n = static_cast<double>(k);
    const double z = -1.0 + run * (n + 0.5) / static_cast<double>(count - onRim);
    const double r = std::sqrt(1.0 - z * z);
    points.emplace_back(r * std::cos(golden * n), r * std::sin(golden * n), z);
  }
  return points;
}

} // namespace

std::size_t pointsToCover(double rim, double spacing)
{
  const double side = std::sqrt(3.0) * spacing;
  // Points on the rim have half a cell.
  return static_cast<std::size_t>(
      std::ceil(kExcess * area(rim) * 2.0 / std::sqrt(3.0) / (side * side) + kPi * rim / side));
}

SphereCover coverSphere(double rim, std::size_t count)
{
  // Inverse of pointsToCover.
  const double a = kExcess * area(rim) * 2.0 / std::sqrt(3.0);
  const double b = kPi * rim;
  const double side = 2.0 * a / (std::sqrt(b * b + 4.0 * a * static_cast<double>(count)) - b);
  const std::size_t onRim = std::clamp<std::size_t>(
      static_cast<std::size_t>(std::ceil(2.0 * kPi * rim / side)), 3, count / 2);
  const double reach = 4.0 * side;

  SphereCover cover;
  cover.points = firstGuess(rim, count, side, onRim);
  std::vector<Eigen::Vector3d> next = cover.points;
  const std::size_t rounds = std::clamp<std::size_t>(kEffort / count, 10, 60);
  for (std::size_t round = 0; round < rounds; ++round)
  {
    const PointGrid grid(cover.points, side);
    const bool even = round < rounds / 2;
    tbb::parallel_for(tbb::blocked_range<std::size_t>(onRim, count, 64),
                      [&](const tbb::blocked_range<std::size_t>& range)
                      {
                        Cell cell;
                        for (std::size_t i = range.begin(); i < range.end(); ++i)
                        {
                          cell.make(cover.points, grid, i, reach);
                          // Over-relaxation: Lloyd's method is slow, and stable up to twice the
                          // step.
                          next[i] = cell.onSphere(even ? Eigen::Vector2d(1.6 * cell.centroid())
                                                       : cell.middle());
                        }
                      });
    cover.points.swap(next);
    std::copy_n(cover.points.begin(), onRim, next.begin());
  }

  // The farthest point is a corner of a cell, or on the rim between two of its points.
  const double top = cover.points.front().z();
  cover.spacing = 2.0 * rim * std::sin(kPi / (2.0 * static_cast<double>(onRim)));
  const PointGrid grid(cover.points, side);
  Cell cell;
  for (std::size_t i = 0; i < count; ++i)
  {
    cell.make(cover.points, grid, i, reach);
    for (const auto& corner : cell.corners())
    {
      const Eigen::Vector3d place = cell.onSphere(corner);
      if (place.z() <= top)
        cover.spacing = std::max(cover.spacing, (place - cover.points[i]).norm());
    }
  }
  return cover;
}

} // namespace petrous::haptics
