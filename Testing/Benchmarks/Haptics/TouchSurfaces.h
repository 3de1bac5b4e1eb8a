#pragma once

#include <vector>

#include "petrous/Core/BenchmarkReport.h"
#include "petrous/Core/Progress.h"

namespace petrous::haptics
{

/// Errors and times on planes, balls, rings and valleys over the voxel size, with the order at
/// which the error falls.
std::vector<core::BenchmarkPoint> touchSurfaces(bool quick, const core::Progress& progress);

/// Error against time over shell points, sweep step, bisections and rounds, by a fast hand.
std::vector<core::BenchmarkPoint> touchParameters(bool quick, const core::Progress& progress);

} // namespace petrous::haptics
