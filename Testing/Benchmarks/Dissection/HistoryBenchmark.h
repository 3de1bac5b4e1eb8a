#pragma once

#include "petrous/Core/BenchmarkReport.h"
#include "petrous/Core/Progress.h"

namespace petrous::dissection
{

/// Bytes of the history and time of an undo against the number of strokes, beside a copy of the
/// whole mask for each stroke. Its error: voxels that differ after undo and redo.
core::BenchmarkReport runHistoryBenchmark(bool quick, const core::Progress& progress);

} // namespace petrous::dissection
