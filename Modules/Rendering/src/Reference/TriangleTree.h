#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "petrous/Core/TriangleMesh.h"
#include "petrous/Rendering/PixelRays.h"

namespace petrous::rendering
{

/// Ray-mesh intersection with a binary tree of bounding boxes, split at the median.
class TriangleTree
{
public:
  struct Hit
  {
    double distance = 0.0;  ///< mm along the ray
    Eigen::Vector3d normal; ///< unit, interpolated between the vertices; orientation unspecified
  };

  /// Throws InvalidParameter for a mesh with vertex indices out of range.
  explicit TriangleTree(std::shared_ptr<const core::TriangleMesh> mesh);

  /// The first triangle in front of the ray's origin, front or back face.
  std::optional<Hit> first(const PixelRay& ray) const;

private:
  struct Node
  {
    Eigen::Vector3d lower;
    Eigen::Vector3d upper;
    std::size_t first = 0; // index into m_order
    std::size_t count = 0; // 0: inner node; its left child is the next node
    std::size_t right = 0;
  };

  std::size_t build(std::size_t first, std::size_t last);
  void intersect(std::size_t triangle, const PixelRay& ray, std::optional<Hit>& nearest) const;

  std::shared_ptr<const core::TriangleMesh> m_mesh;
  std::vector<Eigen::Vector3f> m_normals; // per vertex
  std::vector<std::size_t> m_order;
  std::vector<Node> m_nodes;
};

} // namespace petrous::rendering
