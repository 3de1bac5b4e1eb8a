#include "MeshCaps.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <map>
#include <utility>

#include <Eigen/Geometry>

#include "petrous/Volume/MeshCut.h"

namespace petrous::rendering
{

namespace
{

double heightOver(const ClippingPlane& plane, const Eigen::Vector3d& point)
{
  return plane.normal.dot(point - plane.point);
}

ShadedMesh keptBy(const ShadedMesh& surface, const ClippingPlane& plane)
{
  std::vector<double> heights;
  heights.reserve(surface.mesh.vertices.size());
  for (const Eigen::Vector3f& vertex : surface.mesh.vertices)
    heights.push_back(heightOver(plane, vertex.cast<double>()));
  return clip(surface, heights);
}

/// Fills closed contours in a plane by trapezoids between two of their sides, from the place on a
/// sweep at which the two become neighbours to that at which they cease to be. Whatever ends or
/// begins on a line of the sweep has the same vertices there, so that no pixel is missed between.
class ContourFill
{
public:
  ContourFill(const std::vector<volume::CutSegment>& segments, const ClippingPlane& plane,
              bool facesAlike)
    : m_plane(plane)
    , m_u(plane.normal.unitOrthogonal())
    , m_v(plane.normal.cross(m_u))
    , m_facesAlike(facesAlike)
  {
    for (const volume::CutSegment& segment : segments)
      addSide(inPlane(segment.from), inPlane(segment.to));
    sweep();
    m_result.normals.assign(m_result.mesh.vertices.size(), (-plane.normal).cast<float>());
  }

  ShadedMesh take() { return std::move(m_result); }

private:
  struct Side
  {
    Eigen::Vector2d lower;
    Eigen::Vector2d upper;
    int turn;

    // Exact at its ends.
    double at(double v) const
    {
      if (v <= lower[1])
        return lower[0];
      if (v >= upper[1])
        return upper[0];
      const double share = (v - lower[1]) / (upper[1] - lower[1]);
      return lower[0] + share * (upper[0] - lower[0]);
    }
  };
  using Pair = std::pair<std::size_t, std::size_t>; // sides, the left one first
  using Line = std::map<double, std::uint32_t>;     // vertices by u

  Eigen::Vector2d inPlane(const Eigen::Vector3d& point) const
  {
    return {m_u.dot(point - m_plane.point), m_v.dot(point - m_plane.point)};
  }

  void addSide(const Eigen::Vector2d& from, const Eigen::Vector2d& to)
  {
    if (from[1] < to[1])
      m_sides.push_back({from, to, 1});
    else if (to[1] < from[1])
      m_sides.push_back({to, from, -1});
  }

  // The insides of contours above a line, from left to right.
  std::vector<Pair> spansBelow(double middle)
  {
    std::vector<std::pair<double, std::size_t>> order;
    for (const std::size_t side : m_active)
      order.emplace_back(m_sides[side].at(middle), side);
    std::sort(order.begin(), order.end());
    std::vector<Pair> spans;
    int winding = 0;
    std::size_t begin = 0;
    for (const auto& [u, side] : order)
    {
      const bool wasInside = winding != 0;
      if (m_facesAlike)
        winding += m_sides[side].turn;
      else
        winding = 1 - winding;
      if (!wasInside)
        begin = side;
      else if (winding == 0)
        spans.emplace_back(begin, side);
    }
    return spans;
  }

  void sweep()
  {
    std::sort(m_sides.begin(), m_sides.end(),
              [](const Side& a, const Side& b) { return a.lower[1] < b.lower[1]; });
    std::vector<double> lines;
    for (const Side& side : m_sides)
      lines.insert(lines.end(), {side.lower[1], side.upper[1]});
    std::sort(lines.begin(), lines.end());
    lines.erase(std::unique(lines.begin(), lines.end()), lines.end());
    std::size_t next = 0;
    for (std::size_t n = 0; n < lines.size(); ++n)
    {
      const double v = lines[n];
      m_active.erase(std::remove_if(m_active.begin(), m_active.end(),
                                    [&](std::size_t side) { return m_sides[side].upper[1] <= v; }),
                     m_active.end());
      for (; next < m_sides.size() && m_sides[next].lower[1] <= v; ++next)
        m_active.push_back(next);
      const bool isLast = n + 1 == lines.size();
      changeAt(v, isLast ? std::vector<Pair>() : spansBelow(0.5 * (v + lines[n + 1])));
    }
  }

  void changeAt(double v, const std::vector<Pair>& spans)
  {
    std::vector<Pair> begun;
    for (const Pair& span : spans)
      if (m_open.count(span) == 0)
        begun.push_back(span);
    std::vector<Pair> sorted = spans;
    std::sort(sorted.begin(), sorted.end());
    std::vector<Pair> ended;
    for (const auto& [span, chain] : m_open)
      if (!std::binary_search(sorted.begin(), sorted.end(), span))
        ended.push_back(span);
    Line line;
    for (const std::vector<Pair>* list : {&begun, &ended})
      for (const Pair& span : *list)
        for (const std::size_t side : {span.first, span.second})
          addVertex(m_sides[side].at(v), v, line);
    for (const Pair& span : ended)
    {
      join(m_open[span], between(span, v, line));
      m_open.erase(span);
    }
    for (const Pair& span : begun)
      m_open[span] = between(span, v, line);
  }

  void addVertex(double u, double v, Line& line)
  {
    const auto [entry, isNew] = line.try_emplace(u, 0U);
    if (!isNew)
      return;
    std::vector<Eigen::Vector3f>& vertices = m_result.mesh.vertices;
    entry->second = static_cast<std::uint32_t>(vertices.size());
    vertices.push_back((m_plane.point + u * m_u + v * m_v).cast<float>());
    m_us.push_back(u);
  }

  std::vector<std::uint32_t> between(const Pair& span, double v, const Line& line) const
  {
    const double first = m_sides[span.first].at(v);
    const double last = std::max(first, m_sides[span.second].at(v));
    std::vector<std::uint32_t> chain;
    for (auto at = line.lower_bound(first); at != line.end() && at->first <= last; ++at)
      chain.push_back(at->second);
    return chain;
  }

  // Triangles between the vertices of a trapezoid's lower and upper side.
  void join(const std::vector<std::uint32_t>& low, const std::vector<std::uint32_t>& high)
  {
    const auto shareOf = [this](const std::vector<std::uint32_t>& chain, std::size_t n)
    {
      const double first = m_us[chain.front()];
      const double length = m_us[chain.back()] - first;
      return length > 0.0 ? (m_us[chain[n]] - first) / length : 0.0;
    };
    std::size_t a = 0;
    std::size_t b = 0;
    while (a + 1 < low.size() || b + 1 < high.size())
    {
      const bool isLow = b + 1 == high.size() ||
                         (a + 1 < low.size() && shareOf(low, a + 1) <= shareOf(high, b + 1));
      if (isLow)
        m_result.mesh.triangles.push_back({low[a], high[b], low[a + 1]});
      else
        m_result.mesh.triangles.push_back({low[a], high[b], high[b + 1]});
      ++(isLow ? a : b);
    }
  }

  ClippingPlane m_plane;
  Eigen::Vector3d m_u;
  Eigen::Vector3d m_v;
  bool m_facesAlike;
  std::vector<Side> m_sides;
  std::vector<std::size_t> m_active;
  std::map<Pair, std::vector<std::uint32_t>> m_open; // trapezoids, with their lower vertices
  std::vector<double> m_us;                          // of the vertices
  ShadedMesh m_result;
};

// Of the crop box and a clipping plane at the same place: a cap in one is not cut by the other.
bool isTheSame(const ClippingPlane& one, const ClippingPlane& other)
{
  constexpr double kTurned = 1e-6;
  constexpr double kApart = 1e-3; // mm
  return (one.normal - other.normal).norm() < kTurned &&
         std::abs(heightOver(one, other.point)) < kApart;
}

} // namespace

bool meets(const core::TriangleMesh& mesh, const ClippingPlane& plane)
{
  const auto [lower, upper] = mesh.bounds();
  const Eigen::Vector3d middle = 0.5 * (lower + upper).cast<double>();
  const Eigen::Vector3d half = 0.5 * (upper - lower).cast<double>();
  return heightOver(plane, middle) < plane.normal.cwiseAbs().dot(half);
}

ShadedMesh keptBy(ShadedMesh surface, const std::vector<ClippingPlane>& planes)
{
  for (const ClippingPlane& plane : planes)
    surface = keptBy(surface, plane);
  return surface;
}

ShadedMesh capsOf(const core::TriangleMesh& mesh, const std::vector<ClippingPlane>& planes,
                  bool facesAlike)
{
  ShadedMesh caps;
  for (std::size_t n = 0; n < planes.size(); ++n)
  {
    const ClippingPlane& plane = planes[n];
    const auto segments = volume::cutByPlane(mesh, plane.normal, plane.normal.dot(plane.point));
    ShadedMesh cap = ContourFill(segments, plane, facesAlike).take();
    for (std::size_t other = 0; other < planes.size(); ++other)
      if (other != n && !isTheSame(plane, planes[other]))
        cap = keptBy(cap, planes[other]);
    append(caps, cap);
  }
  return caps;
}

} // namespace petrous::rendering
