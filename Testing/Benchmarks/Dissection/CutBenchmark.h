#pragma once

#include <filesystem>

#include "petrous/Core/BenchmarkReport.h"
#include "petrous/Core/Progress.h"

namespace petrous::dissection
{

/// Volume error of a 4 mm sphere cut out of solid bone against 4/3 pi r^3, over the voxel size, for
/// many sub-voxel positions of the sphere; for comparison, the method that deletes whole voxels
/// whose centre is inside the burr.
core::BenchmarkReport runCutBenchmark(const std::filesystem::path& work, bool quick,
                                      const core::Progress& progress);

} // namespace petrous::dissection
