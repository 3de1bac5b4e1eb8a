#pragma once

#include <functional>

#include "petrous/Core/Progress.h"
#include "petrous/Volume/Volume.h"

namespace petrous::volume
{

/// Area of that part of a structure's surface for which `counts` holds, mm^2.
///
/// The surface is where the trilinear occupancy (SmoothedUnion.h) is 1/2. It is met by the lines of a
/// lattice of half a voxel along the three axes; a point on a line along axis a stands for the area
/// that the line has to itself, times |n_a|, n the unit normal: the squares of n's components add
/// up to 1, so the sum of all three tends to the area itself.
///
/// counts  asked from several threads with a point of the surface and the unit normal there, out of
///         the structure, both in patient LPS mm. The same answers give the same area to the bit.
/// Throws CancelledError.
double surfaceArea(
    const Volume<float>& occupancy,
    const std::function<bool(const Eigen::Vector3d& point, const Eigen::Vector3d& outward)>& counts,
    const core::Progress& progress = {});

} // namespace petrous::volume
