#pragma once

#include <algorithm>
#include <cstddef>
#include <string>

#include "petrous/Core/Progress.h"
#include "petrous/Core/TriangleMesh.h"

namespace petrous::volume
{

struct DecimatedMesh
{
  core::TriangleMesh mesh;
  /// mm: the largest distance of a vertex of the given mesh from this one.
  double fromGiven = 0.0;
  /// mm: the largest and the mean distance of a point of this mesh from the given one, sampled at
  /// its vertices and on its triangles at the given mesh's mean edge length; the mean is by area.
  double toGiven = 0.0;
  double mean = 0.0;
  std::size_t pieces = 1; ///< that share no edge, each of 4 triangles or more
  /// Pairs of triangles that pass through each other.
  std::size_t selfIntersections = 0;
  std::string limit; ///< why there are more triangles than asked for; empty if there are not

  /// Hausdorff distance, sampled as above, mm.
  double hausdorff() const { return std::max(fromGiven, toGiven); }
};

/// A closed mesh with `triangles` triangles, one less, or all of them if there are no more. Edges
/// are collapsed in the order of their quadric error:
///
///   minimize   x^T A x + 2 b^T x + c      over the vertex x that replaces the edge
///   subject to sum over the faces of both ends of det(p1, p2, p3) unchanged
///
/// A, b, c  sum of the squared distances from the planes of the faces that the vertex stands for,
///          weighted by area [Garland and Heckbert, SIGGRAPH 1997, doi 10.1145/258734.258849]
/// det      six times the face's part of the signed volume, which is linear in x
///          [Lindstrom and Turk, IEEE Visualization 1998, doi 10.1109/VISUAL.1998.745314]
///
/// The enclosed volume stays but for rounding. An edge is collapsed only where its ends' neighbors
/// in common are the two opposite vertices (link condition [Dey et al., Publ. Inst. Math. 1999]),
/// so that pieces, genus and closedness stay, and where no face turns by more than 78 degrees.
/// A vertex where surfaces touch becomes one for each of them. Self-intersections are not prevented
/// but counted.
///
/// Deterministic. Throws InvalidParameter if the mesh is not closed, or if fewer than 4 triangles
/// are asked for, or for each of its pieces; CancelledError.
DecimatedMesh decimated(const core::TriangleMesh& mesh, std::size_t triangles,
                        const core::Progress& progress = {});

} // namespace petrous::volume
