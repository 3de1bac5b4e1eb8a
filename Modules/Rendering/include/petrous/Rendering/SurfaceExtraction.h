#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

#include "petrous/Core/Progress.h"
#include "petrous/Core/TriangleMesh.h"
#include "petrous/Volume/TissueField.h"
#include "petrous/Volume/Volume.h"

namespace petrous::rendering
{

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

struct DecimatedMesh
{
  core::TriangleMesh mesh;
  /// mm: the largest distance of a vertex of the given mesh from the decimated one, and of a vertex
  /// or triangle's centre of the decimated mesh from the given one; a sampled Hausdorff distance.
  double error = 0.0;
  std::size_t pieces = 1; ///< that are not connected, each of 4 triangles or more
  std::string limit;      ///< why there are more triangles than asked for; empty if there are not
};

/// A closed mesh with about `triangles` triangles, or with all of them if there are no more; closed
/// too. By collapse of edges with the least quadric error (Garland and Heckbert, SIGGRAPH 1997),
/// weighted to keep the volume; where that would not stay closed, after removal of vertices that
/// preserves the topology (Schroeder et al., SIGGRAPH 1992), down to the fewest found that are
/// closed and within 1 % of the volume. Throws InvalidParameter if the mesh is not closed, or if
/// fewer than 4 triangles are asked for, or for each of its pieces; CancelledError.
DecimatedMesh decimated(const core::TriangleMesh& mesh, std::size_t triangles,
                        const core::Progress& progress = {});

} // namespace petrous::rendering
