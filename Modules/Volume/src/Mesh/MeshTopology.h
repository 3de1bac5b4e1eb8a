#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "petrous/Core/TriangleMesh.h"

namespace petrous::volume
{

constexpr double kMeshLatticeSteps = 1 << 23; // products of differences stay far below 2^63

/// The vertices of a mesh on a lattice of 2^-23 of its size, coincident ones as one.
struct MeshLattice
{
  /// Throws InvalidParameter for vertices that do not exist or are not finite.
  explicit MeshLattice(const core::TriangleMesh& mesh);

  Eigen::Vector3d base{0.0, 0.0, 0.0};
  double unit = 1.0;                                ///< mm
  std::vector<std::array<std::int64_t, 3>> corners; ///< of each vertex, even numbers
  std::vector<std::uint32_t> ids;                   ///< of each vertex; equal where it coincides
};

/// Which triangles of a mesh count, and how they are connected.
///
/// Degenerate triangles do not count. Of a triangle that is there repeatedly one counts, if all of
/// its part are, or if the part is less open so: a wall that two touching shells share stays
/// double.
struct MeshTopology
{
  MeshTopology(const core::TriangleMesh& mesh, const MeshLattice& lattice);

  std::vector<std::uint32_t> triangles; ///< that count, in the mesh's order
  std::vector<std::uint32_t> part;      ///< of each of these, from 0: closed surfaces by themselves
  std::size_t parts = 0;
  std::vector<char> isTangled; ///< of each part: more than two of its triangles meet at an edge
  std::size_t doubled = 0;     ///< triangles that do not count as they are there already
  std::size_t openEdges = 0;   ///< at which an odd number of triangles meets
  bool facesAlike = true;      ///< each edge is traversed equally often in both directions
};

} // namespace petrous::volume
