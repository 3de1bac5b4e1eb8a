#pragma once

#include <vector>

#include "TouchBenchmark.h"

namespace petrous::haptics
{

/// Bumpy bone containing a union of structures and a cut groove, with start positions above it.
TouchScene bumpyBone();

/// Tick times of a burr of 2000 points pressed with 1 to 2 N and sliding over the tissue, for each
/// device speed.
std::vector<core::BenchmarkPoint> touchTicks(const TouchScene& scene, bool quick,
                                             const core::Progress& progress);

} // namespace petrous::haptics
