#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include <Eigen/Core>

namespace petrous::core
{

/// A surface of triangles in patient LPS mm, counter-clockwise seen from outside.
struct TriangleMesh
{
  std::vector<Eigen::Vector3f> vertices;
  std::vector<std::array<std::uint32_t, 3>> triangles;

  /// Volume by the divergence theorem, mm^3; meaningful for closed meshes, negative when the
  /// triangles face inwards.
  double signedVolume() const;

  /// Every edge is shared by exactly two triangles that run along it in opposite directions.
  bool isClosed() const;

  /// Corners of the axis-aligned box, mm; both zero for an empty mesh.
  std::array<Eigen::Vector3f, 2> bounds() const;

  /// Throws InvalidParameter when a triangle names a vertex that is not there or a vertex is not
  /// finite.
  void validate() const;
};

} // namespace petrous::core
