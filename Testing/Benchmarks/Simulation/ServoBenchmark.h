#pragma once

#include <filesystem>

#include "petrous/Core/BenchmarkReport.h"
#include "petrous/Core/Progress.h"

namespace petrous::simulation
{

/// A whole servo tick (device, guard, mapping, constrained tool, limits) and the recording of it: a
/// hand with tremor drills a block of bone. The error is what a replay of the recording differs by.
core::BenchmarkReport runServoBenchmark(const std::filesystem::path& work, bool quick,
                                        const core::Progress& progress);

} // namespace petrous::simulation
