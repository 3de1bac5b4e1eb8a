#pragma once

#include "petrous/Core/Progress.h"
#include "petrous/Core/TriangleMesh.h"
#include "petrous/Volume/TissueField.h"

namespace petrous::rendering
{

/// Isosurface f = 0 in a box of CT voxels, patient LPS mm; triangles are counter-clockwise seen
/// from air. f is sampled at the voxel centres; tissue is capped at the border of box and grid, so
/// the mesh is closed. Throws CancelledError.
core::TriangleMesh extractSurface(const volume::TissueField& field, const core::IndexBox& box,
                                  const core::Progress& progress = {});

} // namespace petrous::rendering
