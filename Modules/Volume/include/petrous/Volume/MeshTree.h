#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include <Eigen/Geometry>

#include "petrous/Core/TriangleMesh.h"

namespace petrous::volume
{

using Triangle = std::array<Eigen::Vector3d, 3>; // corners, patient LPS mm

/// Squared distance of a point from a triangle; a degenerate triangle is treated as its edges.
double squaredDistance(const Triangle& triangle, const Eigen::Vector3d& point) noexcept;

/// Binary bounding-box tree of triangles, split at the median: the one for all that looks for
/// triangles near points or along rays. Immutable and thread-safe.
class MeshTree
{
public:
  explicit MeshTree(std::vector<Triangle> triangles);

  /// Throws InvalidParameter for vertex indices out of range.
  explicit MeshTree(const core::TriangleMesh& mesh);

  const std::vector<Triangle>& triangles() const noexcept { return m_triangles; }

  /// Distance to the nearest triangle, mm; `limit` if none is nearer.
  double distance(const Eigen::Vector3d& point, double limit) const;

  struct Hit
  {
    double distance; ///< mm along the ray
    std::size_t triangle;
    double u, v; ///< weights of the triangle's second and third corner
  };

  /// The first triangle, front or back face, hit by the ray (unit direction) farther than `start`
  /// mm from its origin. Triangles count as larger by `slack` of their weights; with some 1e-9 no
  /// ray passes between two that share an edge.
  std::optional<Hit> firstAlong(const Eigen::Vector3d& origin, const Eigen::Vector3d& direction,
                                double start, double slack = 0.0) const;

  /// The triangles of the leaves whose boxes meet this one: all that meet it, and some beside it.
  std::vector<std::uint32_t> overlapping(const Eigen::AlignedBox3d& box) const;

private:
  struct Node
  {
    Eigen::AlignedBox3d box;
    std::uint32_t first = 0; // in m_order
    std::uint32_t count = 0; // 0: an inner node; its left child is the next one
    std::uint32_t right = 0;
  };

  std::uint32_t build(std::uint32_t first, std::uint32_t last);

  std::vector<Triangle> m_triangles;
  std::vector<std::uint32_t> m_order;
  std::vector<Node> m_nodes;
};

} // namespace petrous::volume
