#pragma once

#include <memory>
#include <optional>

#include "ShadedMesh.h"
#include "petrous/Volume/CutMask.h"
#include "petrous/Volume/MeshInside.h"
#include "petrous/Volume/MeshTree.h"

namespace petrous::rendering
{

/// The part of triangles where the mask exceeds one half, as DrilledMesh cuts its own.
ShadedMesh leftOf(const core::TriangleMesh& triangles, const volume::CutMask& mask);

/// What the drill leaves of a closed mesh, patient LPS mm: its surface where the mask exceeds one
/// half, and the wall of the cut, the mask's level one half, inside it. So it is drawn as it is
/// felt (Volume/TissueField.h).
///
/// The mesh's own triangles are exact but for the line along which they are cut; there, and on the
/// wall, edges are no longer than half of the smallest voxel edge, and linear between vertices that
/// lie on the level. Immutable.
class DrilledMesh
{
public:
  /// Throws InvalidParameter for vertices that do not exist or are not finite.
  explicit DrilledMesh(std::shared_ptr<const core::TriangleMesh> mesh);

  bool closed() const noexcept { return m_inside.openEdges() == 0; }

  /// nullopt: it is not cut, or not closed.
  std::optional<ShadedMesh> surface(const volume::CutMask& mask) const;

private:
  std::shared_ptr<const core::TriangleMesh> m_mesh;
  volume::MeshTree m_tree;
  volume::MeshInside m_inside;
};

} // namespace petrous::rendering
