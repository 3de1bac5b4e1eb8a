#pragma once

#include <cstddef>

#include "petrous/Volume/Volume.h"

namespace petrous::volume
{

/// A cubic grid around a structure, aligned with the axes of its occupancy.
struct DistanceGrid
{
  Eigen::Vector3d origin; ///< of the first node, mm along the occupancy's axes from its first voxel
  double edge;            ///< mm
  core::Index3 dims;
};

/// Bounding box of the inside voxels; empty if there are none.
core::IndexBox insideBox(const Volume<float>& occupancy);

/// Extends `beyond` mm past the voxels of `box`, plus one cell. The edge is half the occupancy's
/// minimum spacing, larger where there would be more than `maxVoxels`.
DistanceGrid gridFor(const core::GridGeometry& occupancy, const core::IndexBox& box, double beyond,
                     std::size_t maxVoxels);

core::GridGeometry geometryOf(const DistanceGrid& grid, const core::GridGeometry& occupancy);

} // namespace petrous::volume
