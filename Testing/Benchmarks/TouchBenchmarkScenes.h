#pragma once

#include <filesystem>
#include <vector>

#include "TouchBenchmark.h"

namespace petrous::cli
{

/// Patients to touch with bone, structures and an opened mastoid: the phantom of 256^3 voxels (96^3
/// when quick), and the largest readable CT below `data` where there is one. The tool comes down
/// in the cavity, on its rim and on the cortex around it.
std::vector<haptics::TouchScene> touchBenchmarkScenes(bool quick, const std::filesystem::path& data,
                                                      const core::Progress& progress);

} // namespace petrous::cli
