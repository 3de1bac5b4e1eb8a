#pragma once

#include <utility>

#include "petrous/Core/GridGeometry.h"

namespace petrous::core
{

/// The part of [first, last] in which start + t * run, in voxel coordinates, lies in the hull of
/// the voxel centres; second < first if there is none.
std::pair<double, double> clipToHull(const GridGeometry& grid, const Eigen::Vector3d& start,
                                     const Eigen::Vector3d& run, double first,
                                     double last) noexcept;

} // namespace petrous::core
