#pragma once

#include "petrous/Core/BenchmarkReport.h"
#include "petrous/Core/Progress.h"

namespace petrous::haptics
{

/// The contact problem of a tick over the number of its rows: the median time to add the rows and
/// solve, and the worst violation of the optimality conditions; beside it projected Gauss-Seidel on
/// the dual, to 1e-9 or 1000 sweeps. And how many of a million problems of all families, degenerate
/// ones among them, are not solved to the precision that ContactQp promises.
core::BenchmarkReport runQpBenchmark(bool quick, const core::Progress& progress);

} // namespace petrous::haptics
