#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "MeshTree.h"
#include "petrous/Core/TriangleMesh.h"

namespace petrous::volume
{

/// Where a closed mesh is inside, by counting how lines along x cross it.
///
/// Corners are moved onto a lattice of 2^-23 of the mesh's size, and lines run between its points,
/// so that the side of an edge on which a line passes is a whole number and all triangles agree on
/// it: the count is exact for every closed mesh, whatever its shape. Immutable and thread-safe.
class MeshInside
{
public:
  /// Throws InvalidParameter for vertices that are not there or not finite.
  explicit MeshInside(const core::TriangleMesh& mesh);

  /// Edges at which an odd number of triangles meets, 0 for a closed mesh. A triangle two of whose
  /// corners coincide counts for nothing.
  std::size_t openEdges() const noexcept { return m_openEdges; }

  /// Smallest length that the lattice tells apart, mm.
  double unit() const noexcept { return m_unit; }

  /// Places along the line at (y, z), in ascending order, at which it enters the mesh or leaves
  /// it: the first is an entry, and so on in turn. `crossings` is overwritten.
  void crossings(double y, double z, std::vector<double>& crossings) const;

  bool contains(const Eigen::Vector3d& point) const;

  /// The triangles that bound the inside, without those that lie in it or bound nothing (a wall
  /// between two shells), corners counter-clockwise seen from outside. Triangles of which only a
  /// part does are cut into smaller ones, down to edges of `resolution` mm. What lies outside `box`
  /// is cut off.
  std::vector<Triangle> surface(double resolution, const Eigen::AlignedBox3d& box) const;

private:
  using Lattice = std::array<std::int64_t, 2>; // of y and z
  struct Crossing
  {
    double x;
    int turn; // of the winding number: +1 in, -1 out
  };

  int facing(const Triangle& triangle, const Eigen::Vector3d& point) const;
  void addSurface(const Triangle& triangle, double resolution, std::vector<Triangle>& result) const;
  void fillCells();
  void measureEdges(const std::vector<std::array<std::int64_t, 3>>& corners);
  Lattice latticeOf(double y, double z) const;
  int turnAt(const std::array<Lattice, 3>& triangle, const Lattice& line,
             std::array<double, 3>& weights) const;

  Eigen::Vector3d m_base{0.0, 0.0, 0.0};
  double m_unit = 1.0;
  std::vector<Triangle> m_triangles;
  std::vector<std::array<Lattice, 3>> m_lattice; // the triangles' corners, even numbers
  // Which triangles may cross a line: those of its cell, a square of 2^m_shift steps of the
  // lattice. The triangles of cell c are m_ofCell[m_cellStart[c]] to m_ofCell[m_cellStart[c + 1]].
  int m_shift = 0;
  Lattice m_cells{0, 0};
  std::vector<std::uint32_t> m_cellStart;
  std::vector<std::uint32_t> m_ofCell;
  std::size_t m_openEdges = 0;
  bool m_facesAlike = true; // as many triangles run along each edge one way as the other
};

} // namespace petrous::volume
