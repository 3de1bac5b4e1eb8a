#pragma once

#include <Eigen/Geometry>

namespace petrous::core
{

/// A box along the axes of patient space, LPS mm: min() and max() are its corners.
using PatientBox = Eigen::AlignedBox3d;

} // namespace petrous::core
