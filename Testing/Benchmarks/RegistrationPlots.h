#pragma once

#include <map>
#include <string>

#include "petrous/Core/BenchmarkReport.h"

namespace petrous::cli
{

/// What `petrous bench registration` writes beside its JSON, by the parts that were run:
/// "" time against error of the pairs, beside other programs; "-schedule" the same over each
/// setting; "-conditions" error against noise, slices and overlap; "-calibration" stated p95
/// against true error, with the coverage; "-stress.md" and "-stress.json" the stress trials, by
/// kind and then each that was confidently wrong.
std::map<std::string, std::string> registrationPlots(const core::BenchmarkReport& report);

} // namespace petrous::cli
