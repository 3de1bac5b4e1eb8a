#pragma once

#include <vector>

#include "petrous/Core/BenchmarkReport.h"
#include "petrous/Core/Progress.h"

namespace petrous::haptics
{

/// Errors and times on planes, balls, rings and valleys over the voxel size, with the order of
/// convergence.
std::vector<core::BenchmarkPoint> touchSurfaces(bool quick, const core::Progress& progress);

/// Error over time for shell points, sweep step, bisections and rounds, with a fast device.
std::vector<core::BenchmarkPoint> touchParameters(bool quick, const core::Progress& progress);

} // namespace petrous::haptics
