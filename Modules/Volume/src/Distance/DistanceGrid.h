#pragma once

#include <cstddef>

#include "petrous/Volume/Volume.h"

namespace petrous::volume
{

/// A grid of cubes round a structure, along the axes of its occupancy.
struct DistanceGrid
{
  Eigen::Vector3d origin; ///< of the first node, mm along the occupancy's axes from its first voxel
  double edge;            ///< mm
  core::Index3 dims;
};

/// The voxels that lie inside; empty where none does.
core::IndexBox insideBox(const Volume<float>& occupancy);

/// Reaches `beyond` mm past the voxels of `box`, and a cube more. The cubes are half the occupancy's
/// least spacing in edge, larger where there would be more than `maxVoxels`.
DistanceGrid gridFor(const core::GridGeometry& occupancy, const core::IndexBox& box, double beyond,
                     std::size_t maxVoxels);

core::GridGeometry geometryOf(const DistanceGrid& grid, const core::GridGeometry& occupancy);

} // namespace petrous::volume
