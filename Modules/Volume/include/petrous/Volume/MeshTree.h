#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <optional>
#include <vector>

#include <Eigen/Geometry>

namespace petrous::volume
{

using Triangle = std::array<Eigen::Vector3d, 3>; // corners, patient LPS mm

/// Squared distance of a point from a triangle; a degenerate triangle is treated as its edges.
double squaredDistance(const Triangle& triangle, const Eigen::Vector3d& point) noexcept;

/// Binary bounding-box tree of triangles, split at the median. Immutable and thread-safe.
class MeshTree
{
public:
  explicit MeshTree(std::vector<Triangle> triangles);

  const std::vector<Triangle>& triangles() const noexcept { return m_triangles; }

  /// Distance to the nearest triangle, mm; `limit` if none is nearer.
  double distance(const Eigen::Vector3d& point, double limit) const;

  struct Hit
  {
    double distance;
    std::size_t triangle;
  };

  /// The first triangle hit by the ray (unit direction) farther than `start` mm from its origin.
  std::optional<Hit> firstAlong(const Eigen::Vector3d& origin, const Eigen::Vector3d& direction,
                                double start) const;

private:
  struct Node
  {
    Eigen::AlignedBox3d box;
    std::uint32_t first = 0; // in m_order
    std::uint32_t count = 0; // 0: an inner node; its left child is the next one
    std::uint32_t right = 0;
  };

  std::uint32_t build(std::uint32_t first, std::uint32_t last);

  template <class Meets, class Visit>
  void walk(const Meets& meets, const Visit& visit) const
  {
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
      for (std::uint32_t i = 0; i < node.count; ++i)
        visit(std::size_t{m_order[node.first + i]});
      if (node.count == 0)
      {
        pending[count++] = node.right;
        pending[count++] = index + 1;
      }
    }
  }

  std::vector<Triangle> m_triangles;
  std::vector<std::uint32_t> m_order;
  std::vector<Node> m_nodes;
};

} // namespace petrous::volume
