#pragma once

#include <vector>

#include "petrous/Core/TriangleMesh.h"

namespace petrous::rendering
{

/// Triangles with vertex normals.
struct ShadedMesh
{
  core::TriangleMesh mesh;
  std::vector<Eigen::Vector3f> normals;
};

/// The part where `values` (per vertex, interpolated linearly) is not negative. Unused vertices are
/// kept.
ShadedMesh clip(const ShadedMesh& whole, const std::vector<double>& values);

void append(ShadedMesh& first, const ShadedMesh& second);

} // namespace petrous::rendering
