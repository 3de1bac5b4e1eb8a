#pragma once

#include <cstdint>
#include <vector>

#include "petrous/Volume/Volume.h"

namespace petrous::rendering
{

/// Occupancy above which a brick of the CT's grid counts as solid: the surface threshold of
/// structures in pictures, minus a margin (OpticalModel.h, kOccupancyThreshold).
constexpr float kSolidOccupancy = 0.5F - 1e-3F;

/// 1 for every brick of `edge` cells, first axis fastest, that may contain a solid structure,
/// otherwise 0. An occupancy voxel counts for all bricks that its support (one label voxel to all
/// sides, mapped to the CT's grid) overlaps; for rotated grids the support's bounding box is used.
std::vector<std::uint8_t> solidBricks(const volume::Volume<float>& occupancy,
                                      const core::GridGeometry& ct, const core::Index3& bricks,
                                      int edge);

} // namespace petrous::rendering
