#pragma once

#include <vector>

#include <Eigen/Core>

#include "petrous/Core/TriangleMesh.h"

namespace petrous::volume
{

/// Where a plane cuts a triangle, patient LPS mm, in the direction in which the triangle faces.
struct CutSegment
{
  Eigen::Vector3d from;
  Eigen::Vector3d to;
};

/// The exact section of a mesh by the plane normal . x = offset, one segment a triangle, in the
/// order of the triangles.
///
/// Vertices on the plane count as beyond it, on the side of the normal, and an edge is cut at one
/// point whichever triangle asks, also where triangles share no vertices. So the section of a
/// closed mesh is closed contours, whatever its shape. Linear in the number of triangles.
std::vector<CutSegment> cutByPlane(const core::TriangleMesh& mesh, const Eigen::Vector3d& normal,
                                   double offset);

} // namespace petrous::volume
