#pragma once

#include <functional>

#include "petrous/Core/Progress.h"
#include "petrous/Volume/Volume.h"

namespace petrous::volume
{

/// Area of that part of a structure's surface for which `counts` is true, mm^2.
///
/// The surface is the 1/2 level of the trilinear occupancy (SmoothedUnion.h). It is intersected
/// with the lines of a lattice of half a voxel along the three axes; an intersection with a line
/// along axis a contributes the cross-section that the line represents, times |n_a|, n the unit
/// normal: the squares of n's components add up to 1, so the sum over all three converges to the
/// area.
///
/// counts  called from several threads with a point of the surface and the outward unit normal
///         there, both in patient LPS mm. Deterministic to the bit if `counts` is.
/// Throws CancelledError.
double surfaceArea(
    const Volume<float>& occupancy,
    const std::function<bool(const Eigen::Vector3d& point, const Eigen::Vector3d& outward)>& counts,
    const core::Progress& progress = {});

} // namespace petrous::volume
