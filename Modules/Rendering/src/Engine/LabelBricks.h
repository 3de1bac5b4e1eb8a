#pragma once

#include <cstdint>
#include <vector>

#include "petrous/Volume/Volume.h"

namespace petrous::rendering
{

/// A brick of the CT's grid counts as solid where an occupancy above this can be met: what the picture
/// takes for a structure's surface, and a little less (OpticalModel.h, kOccupancyThreshold).
constexpr float kSolidOccupancy = 0.5F - 1e-3F;

/// 1 for every brick of `edge` cells, first axis fastest, that may hold a solid structure, else 0.
/// A voxel of the occupancy counts for all bricks that its support (one label voxel to all sides,
/// turned into the CT's grid) reaches; where the grids are turned against each other the support is
/// taken as the box around it.
std::vector<std::uint8_t> solidBricks(const volume::Volume<float>& occupancy,
                                      const core::GridGeometry& ct, const core::Index3& bricks,
                                      int edge);

} // namespace petrous::rendering
