#pragma once

#include <vector>

#include "petrous/Core/BenchmarkReport.h"
#include "petrous/Core/Progress.h"

namespace petrous::haptics
{

/// Crossings of plates one to two voxels thick by a hand that moves at random, at up to 1 m/s and
/// 10 rad/s: 10^6 ticks in all, 10^4 when quick. Beside them the peer's.
std::vector<core::BenchmarkPoint> touchPlates(bool quick, const core::Progress& progress);

} // namespace petrous::haptics
