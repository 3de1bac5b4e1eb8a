#pragma once

#include <string>

#include "petrous/Core/BenchmarkReport.h"

namespace petrous::cli
{

/// A benchmark of something that grows, as an SVG: to the right the setting `by` (points whose
/// value is no number are left out), upwards on the left the time, on the right the further figure
/// `extra`; all logarithmic, a colour for each program and scene.
std::string growthSvg(const core::BenchmarkReport& report, const std::string& by,
                      const std::string& extra);

} // namespace petrous::cli
