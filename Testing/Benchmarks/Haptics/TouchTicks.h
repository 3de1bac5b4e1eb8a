#pragma once

#include <vector>

#include "TouchBenchmark.h"

namespace petrous::haptics
{

/// Bumpy bone with a structure's union in it and a groove cut into it, and places above it.
TouchScene bumpyBone();

/// Times of ticks of a burr of 2000 points that is pressed on with 1 to 2 N and slides over the
/// tissue, at each speed of the hand.
std::vector<core::BenchmarkPoint> touchTicks(const TouchScene& scene, bool quick,
                                             const core::Progress& progress);

} // namespace petrous::haptics
