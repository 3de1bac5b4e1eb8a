#pragma once

#include <filesystem>

#include "petrous/Core/BenchmarkReport.h"
#include "petrous/Core/Progress.h"

namespace petrous::dissection
{

/// Volume error of a 4 mm sphere cut out of solid bone against 4/3 pi r^3, over the voxel size, at
/// many places of the sphere between the voxels; beside it the rule that deletes whole voxels whose
/// centre lies in the burr.
core::BenchmarkReport runCutBenchmark(const std::filesystem::path& work, bool quick,
                                      const core::Progress& progress);

} // namespace petrous::dissection
