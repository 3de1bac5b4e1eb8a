#pragma once

#include "petrous/Core/BenchmarkReport.h"
#include "petrous/Core/Progress.h"

namespace petrous::volume
{

/// Distance of a point to the surfaces of twelve structures (tubes and balls of several sizes on
/// the voxels of a CT of 256^3 and of 512^3), against their analytic distances; at 512^3 also by
/// the search on the field that `petrous probe` uses for a point.
core::BenchmarkReport runDistanceBenchmark(bool quick, const core::Progress& progress);

} // namespace petrous::volume
