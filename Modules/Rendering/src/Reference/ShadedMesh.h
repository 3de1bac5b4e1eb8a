#pragma once

#include <vector>

#include "petrous/Core/TriangleMesh.h"

namespace petrous::rendering
{

/// Triangles with a normal at each vertex.
struct ShadedMesh
{
  core::TriangleMesh mesh;
  std::vector<Eigen::Vector3f> normals;
};

/// The part where `values` (one a vertex, linear between them) is not negative. Vertices that are
/// not used any more stay.
ShadedMesh clip(const ShadedMesh& whole, const std::vector<double>& values);

void append(ShadedMesh& first, const ShadedMesh& second);

} // namespace petrous::rendering
