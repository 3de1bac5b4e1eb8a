#pragma once

#include "petrous/Core/BenchmarkReport.h"
#include "petrous/Core/Progress.h"

namespace petrous::haptics
{

/// The contact problem of a tick over its number of rows: median time to add the rows and solve,
/// and worst violation of the optimality conditions; compared with projected Gauss-Seidel on the
/// dual, to 1e-9 or 1000 sweeps. Also the number of problems, out of a million of all families
/// including degenerate ones, that are not solved to ProxyQp's specified precision.
core::BenchmarkReport runQpBenchmark(bool quick, const core::Progress& progress);

} // namespace petrous::haptics
