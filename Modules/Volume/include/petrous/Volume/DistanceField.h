#pragma once

#include <cstddef>
#include <memory>

#include "petrous/Core/Progress.h"
#include "petrous/Volume/Volume.h"

namespace petrous::volume
{

constexpr std::size_t kMaxFieldVoxels = 3'000'000; ///< 12 MB

/// How far the places round a structure are from its surface, mm, negative within, on a grid of
/// cubes to be read by trilinear interpolation. The surface is where the trilinear occupancy
/// (SmoothedUnion.h) is 1/2.
///
/// Values hold up to `reach` mm outside; beyond that, and within deeper than `reach`, they only
/// tell that it is farther. Beyond the grid's hull it is farther than `reach`. The cubes are half
/// the occupancy's least spacing in edge, larger where there would be more than `maxVoxels`.
///
/// Null where no voxel lies inside. Throws CancelledError, InvalidParameter unless reach > 0.
std::shared_ptr<const Volume<float>> makeDistanceField(const Volume<float>& occupancy, double reach,
                                                       const core::Progress& progress = {},
                                                       std::size_t maxVoxels = kMaxFieldVoxels);

} // namespace petrous::volume
