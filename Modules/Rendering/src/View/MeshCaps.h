#pragma once

#include <vector>

#include "ShadedMesh.h"
#include "petrous/Rendering/SceneContents.h"

namespace petrous::rendering
{

/// Whether a plane cuts anything of a mesh: not all of its box lies on the side that is kept.
bool meets(const core::TriangleMesh& mesh, const ClippingPlane& plane);

/// The part of a surface on the kept sides of all planes, open at its cuts.
ShadedMesh keptBy(ShadedMesh surface, const std::vector<ClippingPlane>& planes);

/// What is inside a closed mesh in each of the planes, on the kept sides of the others, with the
/// planes' normals, away from what is kept. Inside is where the winding number is not 0, or, unless
/// `facesAlike`, odd, as in Volume/MeshInside.h.
ShadedMesh capsOf(const core::TriangleMesh& mesh, const std::vector<ClippingPlane>& planes,
                  bool facesAlike);

} // namespace petrous::rendering
