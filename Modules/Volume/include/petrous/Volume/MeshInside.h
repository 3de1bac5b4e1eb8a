#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "petrous/Core/TriangleMesh.h"
#include "petrous/Volume/MeshTree.h"

namespace petrous::volume
{

/// Interior of a closed mesh, by counting its crossings with lines along x.
///
/// Vertices are snapped to a lattice of 2^-23 of the mesh's size, and lines run between its points,
/// so that the side of an edge on which a line passes is an integer and all triangles agree on it:
/// the count is exact for every closed mesh, whatever its shape. Inside is what the winding number
/// about is not 0, so a part wound the other way is as solid as the others; where the triangles of
/// a part do not face alike, what an odd number of walls encloses. A surface whose triangles are
/// all there repeatedly counts once. Immutable and thread-safe.
class MeshInside
{
public:
  /// Throws InvalidParameter for vertices that do not exist or are not finite.
  explicit MeshInside(const core::TriangleMesh& mesh);

  /// Number of edges at which an odd number of triangles meets, 0 for a closed mesh. Degenerate
  /// triangles (two coincident vertices) are ignored.
  std::size_t openEdges() const noexcept { return m_openEdges; }

  /// Each edge is traversed equally often in both directions.
  bool facesAlike() const noexcept { return m_facesAlike; }

  /// Resolution of the lattice, mm.
  double unit() const noexcept { return m_unit; }

  /// Positions along the line at (y, z), in ascending order, at which it enters and leaves the mesh
  /// alternately; the first is an entry. `crossings` is overwritten.
  void crossings(double y, double z, std::vector<double>& crossings) const;

  bool contains(const Eigen::Vector3d& point) const;

  /// The triangles that bound the interior, without those inside it or bounding nothing (a wall
  /// between two shells), vertices counter-clockwise seen from outside. Triangles that do so only
  /// in part are subdivided, down to edges of `resolution` mm. Clipped to `box`.
  std::vector<Triangle> surface(double resolution, const Eigen::AlignedBox3d& box) const;

private:
  using Lattice = std::array<std::int64_t, 2>; // of y and z
  struct Crossing
  {
    double x;
    int turn; // change of the winding number: +1 in, -1 out
  };

  int facing(const Triangle& triangle, const Eigen::Vector3d& point) const;
  void addSurface(const Triangle& triangle, double resolution, std::vector<Triangle>& result) const;
  void fillCells();
  Lattice latticeOf(double y, double z) const;
  int turnAt(const std::array<Lattice, 3>& triangle, const Lattice& line,
             std::array<double, 3>& weights) const;

  Eigen::Vector3d m_base{0.0, 0.0, 0.0};
  double m_unit = 1.0;
  std::vector<Triangle> m_triangles;
  std::vector<std::array<Lattice, 3>> m_lattice; // vertices of the triangles, even numbers
  // Triangles that may cross a line, by cell: a square of 2^m_shift lattice steps. The triangles of
  // cell c are m_ofCell[m_cellStart[c]] to m_ofCell[m_cellStart[c + 1]].
  int m_shift = 0;
  Lattice m_cells{0, 0};
  std::vector<std::uint32_t> m_cellStart;
  std::vector<std::uint32_t> m_ofCell;
  std::size_t m_openEdges = 0;
  bool m_facesAlike = true; // each edge is traversed equally often in both directions
};

} // namespace petrous::volume
