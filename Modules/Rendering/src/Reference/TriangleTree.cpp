#include "TriangleTree.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include <Eigen/Geometry>

#include "SurfaceActor.h"

namespace petrous::rendering
{

namespace
{

constexpr std::size_t kLeaf = 4; // triangles

// Whether the ray intersects the box before `end`.
bool meets(const Eigen::Vector3d& lower, const Eigen::Vector3d& upper, const PixelRay& ray,
           double end)
{
  double first = 0.0;
  double last = end;
  for (int axis = 0; axis < 3; ++axis)
  {
    const double run = ray.direction[axis];
    if (run == 0.0)
    {
      if (ray.origin[axis] < lower[axis] || ray.origin[axis] > upper[axis])
        return false;
      continue;
    }
    const double a = (lower[axis] - ray.origin[axis]) / run;
    const double b = (upper[axis] - ray.origin[axis]) / run;
    first = std::max(first, std::min(a, b));
    last = std::min(last, std::max(a, b));
  }
  // For flat boxes: rounding must not lose the triangle inside.
  return first <= last + 1e-9 * (1.0 + std::abs(last));
}

} // namespace

TriangleTree::TriangleTree(std::shared_ptr<const core::TriangleMesh> mesh)
  : m_mesh(std::move(mesh))
{
  m_mesh->validate();
  m_normals = vertexNormals(*m_mesh);
  m_order.resize(m_mesh->triangles.size());
  std::iota(m_order.begin(), m_order.end(), std::size_t{0});
  if (!m_order.empty())
    build(0, m_order.size());
}

std::size_t TriangleTree::build(std::size_t first, std::size_t last)
{
  const std::size_t self = m_nodes.size();
  m_nodes.emplace_back();
  Eigen::AlignedBox3d box;
  for (std::size_t i = first; i < last; ++i)
    for (const std::uint32_t vertex : m_mesh->triangles[m_order[i]])
      box.extend(m_mesh->vertices[vertex].cast<double>());
  m_nodes[self].lower = box.min();
  m_nodes[self].upper = box.max();
  if (last - first <= kLeaf)
  {
    m_nodes[self].first = first;
    m_nodes[self].count = last - first;
    return self;
  }
  Eigen::Index axis = 0;
  box.sizes().maxCoeff(&axis);
  const auto middleOf = [this, axis](std::size_t triangle)
  {
    float sum = 0.0F;
    for (const std::uint32_t vertex : m_mesh->triangles[triangle])
      sum += m_mesh->vertices[vertex][axis];
    return sum;
  };
  const std::size_t half = first + (last - first) / 2;
  std::nth_element(m_order.begin() + static_cast<std::ptrdiff_t>(first),
                   m_order.begin() + static_cast<std::ptrdiff_t>(half),
                   m_order.begin() + static_cast<std::ptrdiff_t>(last),
                   [&](std::size_t a, std::size_t b) { return middleOf(a) < middleOf(b); });
  build(first, half);
  const std::size_t right = build(half, last);
  m_nodes[self].right = right;
  return self;
}

// Möller-Trumbore intersection, front and back faces.
void TriangleTree::intersect(std::size_t triangle, const PixelRay& ray,
                             std::optional<Hit>& nearest) const
{
  const auto& corner = m_mesh->triangles[triangle];
  const Eigen::Vector3d a = m_mesh->vertices[corner[0]].cast<double>();
  const Eigen::Vector3d ab = m_mesh->vertices[corner[1]].cast<double>() - a;
  const Eigen::Vector3d ac = m_mesh->vertices[corner[2]].cast<double>() - a;
  const Eigen::Vector3d p = ray.direction.cross(ac);
  const double determinant = ab.dot(p);
  if (determinant == 0.0)
    return;
  const Eigen::Vector3d s = ray.origin - a;
  const double u = s.dot(p) / determinant;
  const Eigen::Vector3d q = s.cross(ab);
  const double v = ray.direction.dot(q) / determinant;
  const double distance = ac.dot(q) / determinant;
  if (!(u >= 0.0 && v >= 0.0 && u + v <= 1.0 && distance > 0.0) ||
      (nearest && distance >= nearest->distance))
    return;
  const Eigen::Vector3d normal = (1.0 - u - v) * m_normals[corner[0]].cast<double>() +
                                 u * m_normals[corner[1]].cast<double>() +
                                 v * m_normals[corner[2]].cast<double>();
  nearest = Hit{distance, normal.norm() > 0.0 ? normal.normalized() : ab.cross(ac).normalized()};
}

std::optional<TriangleTree::Hit> TriangleTree::first(const PixelRay& ray) const
{
  std::optional<Hit> nearest;
  std::size_t pending[64]; // a tree of 2^32 triangles has depth 31
  std::size_t count = 0;
  if (!m_nodes.empty())
    pending[count++] = 0;
  while (count > 0)
  {
    const std::size_t index = pending[--count];
    const Node& node = m_nodes[index];
    if (!meets(node.lower, node.upper, ray,
               nearest ? nearest->distance : std::numeric_limits<double>::infinity()))
      continue;
    for (std::size_t i = 0; i < node.count; ++i)
      intersect(m_order[node.first + i], ray, nearest);
    if (node.count == 0)
    {
      pending[count++] = node.right;
      pending[count++] = index + 1;
    }
  }
  return nearest;
}

} // namespace petrous::rendering
