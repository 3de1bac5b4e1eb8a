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
  /// mm^3, of a closed mesh only: by the divergence theorem, so that shells that overlap count
  /// twice where they do. If the triangles are not consistently oriented, of what they enclose.
  std::optional<double> volume;
};

/// Coincident vertices count as one. Throws InvalidParameter for vertices that do not exist or are
/// not finite.
MeshMeasure measure(const core::TriangleMesh& mesh);

} // namespace petrous::volume
