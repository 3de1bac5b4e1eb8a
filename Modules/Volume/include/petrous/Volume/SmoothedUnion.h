#pragma once

#include <functional>
#include <memory>

#include "petrous/Volume/LabelMap.h"

namespace petrous::volume
{

/// Occupancy of "inside a wanted structure" around each voxel of a label map, 0 to 1, whose 0.5
/// level is a surface without voxel steps [Chan2013, 2.1]: 1/2 + d / (2 sqrt(3)) at a voxel centre,
/// d the signed distance in voxels from the union's border, relaxed as described in
/// src/Labels/SurfaceNet.h, in steps of 1/65535.
///
/// A voxel of the structure stays above 1/2 and one outside below, and nothing shrinks: a structure
/// one voxel thin stays connected, and about one voxel thick (Documentation/adr/0001).
/// `wanted(index)` selects the segments. The result covers only their bounding box, grown by two
/// voxels; nullptr if no voxel is wanted.
std::shared_ptr<const Volume<float>>
makeSmoothedUnion(const LabelMap& labels, const std::function<bool(std::uint16_t)>& wanted);

/// As above, for a known box of voxels that contains everything wanted (boxesOf): only this box is
/// read.
std::shared_ptr<const Volume<float>>
makeSmoothedUnion(const LabelMap& labels, const std::function<bool(std::uint16_t)>& wanted,
                  const core::IndexBox& within);

/// Occupancy of a voxel assigned to a structure too thin for its grid (LabelField.h).
constexpr float kInsideFloor = 0.55F;

} // namespace petrous::volume
