#pragma once

#include <functional>
#include <memory>

#include "petrous/Volume/LabelMap.h"

namespace petrous::volume
{

/// Share of "inside a wanted structure" round each voxel of a label map, 0 to 1: the binary union
/// low-pass filtered by the 3x3x3 binomial kernel [1 2 1]/4, so that its 0.5 level is a surface
/// without voxel steps [Chan2013, 2.1].
///
/// A voxel of the structure itself never falls below kInsideFloor and one outside never rises
/// above 1 - kInsideFloor, so a structure one voxel thin stays whole (Documentation/adr/0001).
/// `wanted(index)` chooses the segments. Only the box around them is held, two voxels wider;
/// null when no voxel is wanted.
std::shared_ptr<const Volume<float>>
makeSmoothedUnion(const LabelMap& labels, const std::function<bool(std::uint16_t)>& wanted);

/// The same, for who knows a box of voxels that holds all that is wanted (boxesOf): not every voxel
/// of the map is looked at.
std::shared_ptr<const Volume<float>>
makeSmoothedUnion(const LabelMap& labels, const std::function<bool(std::uint16_t)>& wanted,
                  const core::IndexBox& within);

constexpr float kInsideFloor = 0.55F;

} // namespace petrous::volume
