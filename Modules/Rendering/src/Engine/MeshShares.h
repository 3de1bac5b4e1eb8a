#pragma once

#include <cstdint>
#include <vector>

#include "petrous/Core/GridGeometry.h"
#include "petrous/Core/TriangleMesh.h"

namespace petrous::rendering
{

/// How much of each texel of an OpacityPyramid's first level lies in a closed mesh.
struct MeshShares
{
  core::IndexBox box;               ///< of texels; empty: not closed, or nowhere in the CT
  std::vector<std::uint8_t> shares; ///< of 255, first axis fastest
};

/// By the lengths of lines along the CT's first axis that lie in the mesh, 16 a texel, of a large
/// mesh 4. `factor`: voxels of a texel. Throws InvalidParameter for vertices that do not exist or
/// are not finite.
MeshShares meshShares(const core::TriangleMesh& mesh, const core::GridGeometry& ct,
                      const core::Index3& factor);

} // namespace petrous::rendering
