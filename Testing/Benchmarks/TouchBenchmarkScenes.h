#pragma once

#include <filesystem>
#include <vector>

#include "TouchBenchmark.h"

namespace petrous::cli
{

/// Patients with bone, structures and an opened mastoid for touch benchmarks: the phantom of 256^3
/// voxels (96^3 when quick), and the largest readable CT below `data`, if any. The tool is lowered
/// into the cavity, onto its rim and onto the cortex around it.
std::vector<haptics::TouchScene> touchBenchmarkScenes(bool quick, const std::filesystem::path& data,
                                                      const core::Progress& progress);

} // namespace petrous::cli
