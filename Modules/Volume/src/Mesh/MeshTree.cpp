#include "petrous/Volume/MeshTree.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

namespace petrous::volume
{

namespace
{

constexpr std::uint32_t kLeaf = 4; // triangles

double squaredDistanceToEdge(const Eigen::Vector3d& a, const Eigen::Vector3d& b,
                             const Eigen::Vector3d& point) noexcept
{
  const Eigen::Vector3d run = b - a;
  const double length = run.squaredNorm();
  const double t = length > 0.0 ? std::clamp((point - a).dot(run) / length, 0.0, 1.0) : 0.0;
  return (point - a - t * run).squaredNorm();
}

// Möller-Trumbore intersection, anywhere on the ray's line.
std::optional<MeshTree::Hit> meeting(const Triangle& triangle, const Eigen::Vector3d& origin,
                                     const Eigen::Vector3d& direction, double slack)
{
  const Eigen::Vector3d ab = triangle[1] - triangle[0];
  const Eigen::Vector3d ac = triangle[2] - triangle[0];
  const Eigen::Vector3d p = direction.cross(ac);
  const double determinant = ab.dot(p);
  if (determinant == 0.0)
    return std::nullopt;
  const Eigen::Vector3d s = origin - triangle[0];
  const double u = s.dot(p) / determinant;
  const Eigen::Vector3d q = s.cross(ab);
  const double v = direction.dot(q) / determinant;
  if (!(u >= -slack && v >= -slack && u + v <= 1.0 + slack))
    return std::nullopt;
  return MeshTree::Hit{ac.dot(q) / determinant, 0, u, v};
}

std::vector<Triangle> trianglesOf(const core::TriangleMesh& mesh)
{
  mesh.validate();
  std::vector<Triangle> triangles;
  triangles.reserve(mesh.triangles.size());
  for (const auto& corners : mesh.triangles)
    triangles.push_back({mesh.vertices[corners[0]].cast<double>(),
                         mesh.vertices[corners[1]].cast<double>(),
                         mesh.vertices[corners[2]].cast<double>()});
  return triangles;
}

} // namespace

double squaredDistance(const Triangle& triangle, const Eigen::Vector3d& point) noexcept
{
  const auto& [a, b, c] = triangle;
  const Eigen::Vector3d ab = b - a;
  const Eigen::Vector3d ac = c - a;
  const Eigen::Vector3d ap = point - a;
  const Eigen::Vector3d normal = ab.cross(ac);
  const double area = normal.squaredNorm();
  const double toC = ab.cross(ap).dot(normal);
  const double toB = ap.cross(ac).dot(normal);
  if (area > 0.0 && toC >= 0.0 && toB >= 0.0 && toB + toC <= area)
  {
    const double height = ap.dot(normal);
    return height * height / area;
  }
  return std::min({squaredDistanceToEdge(a, b, point), squaredDistanceToEdge(b, c, point),
                   squaredDistanceToEdge(c, a, point)});
}

MeshTree::MeshTree(std::vector<Triangle> triangles)
  : m_triangles(std::move(triangles))
  , m_order(m_triangles.size())
{
  std::iota(m_order.begin(), m_order.end(), std::uint32_t{0});
  if (!m_order.empty())
    build(0, static_cast<std::uint32_t>(m_order.size()));
}

MeshTree::MeshTree(const core::TriangleMesh& mesh)
  : MeshTree(trianglesOf(mesh))
{
}

std::uint32_t MeshTree::build(std::uint32_t first, std::uint32_t last)
{
  const auto self = static_cast<std::uint32_t>(m_nodes.size());
  m_nodes.emplace_back();
  Eigen::AlignedBox3d box;
  for (std::uint32_t i = first; i < last; ++i)
    for (const Eigen::Vector3d& corner : m_triangles[m_order[i]])
      box.extend(corner);
  m_nodes[self].box = box;
  if (last - first <= kLeaf)
  {
    m_nodes[self].first = first;
    m_nodes[self].count = last - first;
    return self;
  }
  Eigen::Index axis = 0;
  box.sizes().maxCoeff(&axis);
  const auto middleOf = [this, axis](std::uint32_t triangle)
  {
    const Triangle& t = m_triangles[triangle];
    return t[0][axis] + t[1][axis] + t[2][axis];
  };
  const std::uint32_t half = first + (last - first) / 2;
  std::nth_element(m_order.begin() + first, m_order.begin() + half, m_order.begin() + last,
                   [&](std::uint32_t a, std::uint32_t b) { return middleOf(a) < middleOf(b); });
  build(first, half);
  const std::uint32_t right = build(half, last);
  m_nodes[self].right = right;
  return self;
}

double MeshTree::distance(const Eigen::Vector3d& point, double limit) const
{
  struct Pending
  {
    std::uint32_t node;
    double squared; // lower bound
  };
  const auto boundOf = [&](std::uint32_t node)
  { return m_nodes[node].box.squaredExteriorDistance(point); };
  double best = limit * limit;
  std::array<Pending, 64> pending;
  std::size_t count = 0;
  if (!m_nodes.empty())
    pending[count++] = {0, boundOf(0)};
  while (count > 0)
  {
    const Pending next = pending[--count];
    if (next.squared >= best)
      continue;
    const Node& node = m_nodes[next.node];
    for (std::uint32_t i = 0; i < node.count; ++i)
      best = std::min(best, squaredDistance(m_triangles[m_order[node.first + i]], point));
    if (node.count > 0)
      continue;
    Pending near{next.node + 1, boundOf(next.node + 1)};
    Pending far{node.right, boundOf(node.right)};
    if (far.squared < near.squared)
      std::swap(near, far);
    pending[count++] = far;
    pending[count++] = near;
  }
  return std::sqrt(best);
}

std::optional<MeshTree::Hit> MeshTree::firstAlong(const Eigen::Vector3d& origin,
                                                  const Eigen::Vector3d& direction, double start,
                                                  double slack) const
{
  std::optional<Hit> first;
  const auto meets = [&](const Eigen::AlignedBox3d& box)
  {
    double from = start;
    double to = first ? first->distance : std::numeric_limits<double>::infinity();
    for (Eigen::Index axis = 0; axis < 3; ++axis)
    {
      const double lower = box.min()[axis] - origin[axis];
      const double upper = box.max()[axis] - origin[axis];
      if (direction[axis] == 0.0)
      {
        if (lower > 0.0 || upper < 0.0)
          return false;
        continue;
      }
      const double a = lower / direction[axis];
      const double b = upper / direction[axis];
      from = std::max(from, std::min(a, b));
      to = std::min(to, std::max(a, b));
    }
    return from <= to + 1e-9 * (1.0 + std::abs(to)); // tolerance for flat boxes
  };
  std::array<std::uint32_t, 64> pending; // a tree of 2^32 triangles is 31 deep
  std::size_t count = 0;
  if (!m_nodes.empty())
    pending[count++] = 0;
  while (count > 0)
  {
    const std::uint32_t index = pending[--count];
    const Node& node = m_nodes[index];
    if (!meets(node.box))
      continue;
    for (std::uint32_t i = node.first; i < node.first + node.count; ++i)
    {
      const auto hit = meeting(m_triangles[m_order[i]], origin, direction, slack);
      if (!hit || !(hit->distance > start) || (first && hit->distance >= first->distance))
        continue;
      first = hit;
      first->triangle = m_order[i];
    }
    if (node.count == 0)
    {
      pending[count++] = node.right;
      pending[count++] = index + 1;
    }
  }
  return first;
}

std::vector<std::uint32_t> MeshTree::overlapping(const Eigen::AlignedBox3d& box) const
{
  std::vector<std::uint32_t> found;
  std::array<std::uint32_t, 64> pending;
  std::size_t count = 0;
  if (!m_nodes.empty())
    pending[count++] = 0;
  while (count > 0)
  {
    const std::uint32_t index = pending[--count];
    const Node& node = m_nodes[index];
    if (!node.box.intersects(box))
      continue;
    for (std::uint32_t i = 0; i < node.count; ++i)
      found.push_back(m_order[node.first + i]);
    if (node.count == 0)
    {
      pending[count++] = node.right;
      pending[count++] = index + 1;
    }
  }
  return found;
}

} // namespace petrous::volume
