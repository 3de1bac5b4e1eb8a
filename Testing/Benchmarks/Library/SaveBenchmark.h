#pragma once

#include <filesystem>

#include "petrous/Core/BenchmarkReport.h"
#include "petrous/Core/Progress.h"

namespace petrous::library
{

/// Saving a case of 512^3 voxels (128^3 when quick) after each of several strokes: median time and
/// bytes written; the error is the number of mask voxels that differ after reopening. Compared with
/// writing the whole mask.
core::BenchmarkReport runSaveBenchmark(const std::filesystem::path& work, bool quick,
                                       const core::Progress& progress);

} // namespace petrous::library
