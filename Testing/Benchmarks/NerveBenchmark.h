#pragma once

#include "petrous/Core/BenchmarkReport.h"
#include "petrous/Core/Progress.h"

namespace petrous::cli
{

/// Time of tracing the phantom's facial nerve through six points that lie up to 1 mm off its axis,
/// against the mean distance between the line found and the axis, for voxels of 0.15 to 0.6 mm and
/// noise of 0 to 100 HU; and of a canal as narrow as the chorda's, through five points up to 0.3 mm
/// off. Each figure is of several phantoms and sets of points: errors are the mean and the largest
/// of all. The peer is a smooth curve through the same points.
core::BenchmarkReport runNerveBenchmark(bool quick, const core::Progress& progress);

} // namespace petrous::cli
