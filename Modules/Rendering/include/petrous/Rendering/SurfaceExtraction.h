#pragma once

#include "petrous/Core/Progress.h"
#include "petrous/Core/TriangleMesh.h"
#include "petrous/Volume/TissueField.h"

namespace petrous::rendering
{

/// The surface f = 0 in a box of CT voxels, patient LPS mm, triangles counter-clockwise seen
/// from the air. f is sampled at the voxel centres; tissue that the box or the grid cuts off is
/// closed there, so the mesh has no open border.
/// Throws CancelledError.
core::TriangleMesh extractSurface(const volume::TissueField& field, const core::IndexBox& box,
                                  const core::Progress& progress = {});

} // namespace petrous::rendering
