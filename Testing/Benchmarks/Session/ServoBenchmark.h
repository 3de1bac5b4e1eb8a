#pragma once

#include <filesystem>

#include "petrous/Core/BenchmarkReport.h"
#include "petrous/Core/Progress.h"

namespace petrous::session
{

/// A complete servo tick (device, guard, mapping, constrained tool, limits) and its recording: a
/// device with tremor drills a block of bone. The error is the difference between the recording and
/// its replay.
core::BenchmarkReport runServoBenchmark(const std::filesystem::path& work, bool quick,
                                        const core::Progress& progress);

} // namespace petrous::session
