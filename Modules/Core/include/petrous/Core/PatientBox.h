#pragma once

#include <Eigen/Geometry>

namespace petrous::core
{

/// Axis-aligned box in patient space, LPS mm.
using PatientBox = Eigen::AlignedBox3d;

} // namespace petrous::core
