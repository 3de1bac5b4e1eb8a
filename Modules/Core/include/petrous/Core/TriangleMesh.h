#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include <Eigen/Core>

namespace petrous::core
{

/// Triangle mesh in patient LPS mm, counter-clockwise seen from outside.
struct TriangleMesh
{
  std::vector<Eigen::Vector3f> vertices;
  std::vector<std::array<std::uint32_t, 3>> triangles;

  /// Volume by the divergence theorem, mm^3; meaningful for closed meshes, negative if the
  /// triangles face inwards.
  double signedVolume() const;

  /// Every edge is shared by exactly two triangles that traverse it in opposite directions.
  bool isClosed() const;

  /// Corners of the axis-aligned bounding box, mm; both zero for an empty mesh.
  std::array<Eigen::Vector3f, 2> bounds() const;

  /// Throws InvalidParameter if a triangle refers to a vertex that does not exist or a vertex is
  /// not finite.
  void validate() const;
};

} // namespace petrous::core
