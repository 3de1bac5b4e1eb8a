#pragma once

#include <cstddef>
#include <optional>

#include "petrous/Core/TriangleMesh.h"

namespace petrous::volume
{

struct MeshMeasure
{
  /// Edges at which an odd number of triangles meets; 0 for a closed mesh (MeshSolid.h).
  std::size_t openEdges = 0;
  /// mm^3 of what is inside (MeshInside.h), of a closed mesh only. Exact by the divergence theorem
  /// and the winding number of each part, unless parts pass through each other (by
  /// more than 1 % of the smaller) or more
  /// than two triangles of one meet at an edge: then integrated along 2^20 lines, to about 0.3 %.
  /// One part that passes through itself elsewhere counts twice where it does.
  std::optional<double> volume;
  /// Of a closed mesh: surfaces that are closed by themselves.
  std::size_t parts = 0;
  /// Parts outside all others that are wound the other way than most of the volume is.
  std::size_t reversedParts = 0;
  /// Parts that are the wall of a cavity in another.
  std::size_t cavities = 0;
  /// Parts inside another that bound nothing, as they face as it does.
  std::size_t innerParts = 0;
  /// Triangles that do not count as they are there already.
  std::size_t doubled = 0;
  /// Parts pass through each other, by more than 1 % of what is inside.
  bool isOverlapping = false;
  /// The same, and some are wound the other way: what two of them enclose is not inside.
  bool isOverlapHollow = false;
  /// Triangles of one part face both ways.
  bool isMixed = false;
};

/// Coincident vertices count as one. Throws InvalidParameter for vertices that do not exist or are
/// not finite.
MeshMeasure measure(const core::TriangleMesh& mesh);

/// The mesh with the same inside, its outer parts facing outwards and without doubled triangles.
/// One that is not closed, or of which triangles of one part face both ways, only without the
/// latter.
core::TriangleMesh oriented(const core::TriangleMesh& mesh);

} // namespace petrous::volume
