#pragma once

#include <cstddef>
#include <memory>

#include "petrous/Core/Progress.h"
#include "petrous/Volume/Volume.h"

namespace petrous::volume
{

constexpr std::size_t kMaxFieldVoxels = 3'000'000; ///< 12 MB

/// Signed distance to a structure's surface around it, mm, negative inside, on a grid of cubic
/// voxels for trilinear interpolation. The surface is the 1/2 level of the trilinear occupancy
/// (SmoothedUnion.h).
///
/// Values are valid up to `reach` mm outside; farther outside, and deeper inside than `reach`, they
/// are only lower bounds of the magnitude. Beyond the grid's hull the distance exceeds `reach`. The
/// voxel edge is half the minimum spacing of the occupancy, larger where there would be more than
/// `maxVoxels`.
///
/// Returns nullptr if no voxel is inside. Throws CancelledError, and InvalidParameter unless reach
/// > 0.
std::shared_ptr<const Volume<float>> makeDistanceField(const Volume<float>& occupancy, double reach,
                                                       const core::Progress& progress = {},
                                                       std::size_t maxVoxels = kMaxFieldVoxels);

} // namespace petrous::volume
