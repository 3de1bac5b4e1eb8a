#pragma once

#include <map>
#include <string>

#include "petrous/Core/BenchmarkReport.h"

namespace petrous::cli
{

/// The files that `petrous bench registration` writes beside its JSON, depending on the parts run:
/// "" error over time of the pairs, with other programs; "-schedule" the same for each setting;
/// "-conditions" error over noise, slice thickness and overlap; "-calibration" stated p95 against
/// true error, with the coverage; "-stress.md" and "-stress.json" the stress trials, by kind,
/// followed by each confidently wrong one.
std::map<std::string, std::string> registrationPlots(const core::BenchmarkReport& report);

} // namespace petrous::cli
