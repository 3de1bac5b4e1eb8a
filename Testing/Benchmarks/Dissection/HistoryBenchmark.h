#pragma once

#include "petrous/Core/BenchmarkReport.h"
#include "petrous/Core/Progress.h"

namespace petrous::dissection
{

/// Memory of the history and time of an undo over the number of strokes, compared with a full mask
/// copy per stroke. Error: voxels that differ after undo and redo.
core::BenchmarkReport runHistoryBenchmark(bool quick, const core::Progress& progress);

} // namespace petrous::dissection
