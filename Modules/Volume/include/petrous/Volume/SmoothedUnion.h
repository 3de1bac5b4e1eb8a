#pragma once

#include <functional>
#include <memory>

#include "petrous/Volume/LabelMap.h"

namespace petrous::volume
{

/// Occupancy of "inside a wanted structure" round each voxel of a label map, 0 to 1, whose 0.5 level is
/// a surface without voxel steps [Chan2013, 2.1]: 1/2 + d / (2 sqrt(3)) at a voxel centre, d the
/// signed distance in voxels from the union's border, relaxed as src/Labels/SurfaceNet.h says, in steps of
/// 1/65535.
///
/// A voxel of the structure stays above 1/2 and one outside below, and nothing shrinks: a structure
/// one voxel thin stays whole, and about one voxel thick (Documentation/adr/0001).
/// `wanted(index)` chooses the segments. Only the box around them is held, two voxels wider;
/// null when no voxel is wanted.
std::shared_ptr<const Volume<float>>
makeSmoothedUnion(const LabelMap& labels, const std::function<bool(std::uint16_t)>& wanted);

/// The same, for who knows a box of voxels that holds all that is wanted (boxesOf): not every voxel
/// of the map is looked at.
std::shared_ptr<const Volume<float>>
makeSmoothedUnion(const LabelMap& labels, const std::function<bool(std::uint16_t)>& wanted,
                  const core::IndexBox& within);

/// What a voxel has that is given to a structure too thin for its grid (LabelField.h).
constexpr float kInsideFloor = 0.55F;

} // namespace petrous::volume
