#pragma once

#include <cstdint>

#include "petrous/Core/Progress.h"
#include "petrous/Core/TriangleMesh.h"
#include "petrous/Volume/TissueField.h"
#include "petrous/Volume/Volume.h"

namespace petrous::rendering
{

/// Isosurface 0 of a field by flying edges, patient LPS mm, counter-clockwise seen from the
/// negative side, on left-handed grids too; open at the grid's border.
core::TriangleMesh isoTriangles(const volume::Volume<float>& field);

/// Isosurface f = 0 in a box of CT voxels, patient LPS mm; triangles are counter-clockwise seen
/// from air. f is sampled at the voxel centres; tissue is capped at the border of box and grid, so
/// the mesh is closed. Throws CancelledError.
core::TriangleMesh extractSurface(const volume::TissueField& field, const core::IndexBox& box,
                                  const core::Progress& progress = {});

/// Surface of the voxels of one label, patient LPS mm, closed and counter-clockwise seen from
/// outside; empty if no voxel has the label. It runs between the centres of inner and outer voxels,
/// at the one depth at which it encloses the voxels' volume (to 1e-4 of it): half way, a convex
/// structure would lose its edges, a nerve some 20 % of its volume. Not decimated. Throws
/// CancelledError.
core::TriangleMesh extractLabel(const volume::Volume<std::uint16_t>& labels, std::uint16_t label,
                                const core::Progress& progress = {});

} // namespace petrous::rendering
