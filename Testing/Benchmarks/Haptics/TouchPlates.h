#pragma once

#include <vector>

#include "petrous/Core/BenchmarkReport.h"
#include "petrous/Core/Progress.h"

namespace petrous::haptics
{

/// Crossings of plates one to two voxels thick by a randomly moving device, at up to 1 m/s and 10
/// rad/s: 10^6 ticks in total, 10^4 when quick; and those of the peer.
std::vector<core::BenchmarkPoint> touchPlates(bool quick, const core::Progress& progress);

} // namespace petrous::haptics
