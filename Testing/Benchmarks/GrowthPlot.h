#pragma once

#include <string>

#include "petrous/Core/BenchmarkReport.h"

namespace petrous::cli
{

/// SVG of a scaling benchmark: x is the setting `by` (points with a non-numeric value are omitted),
/// the left y axis the time, the right one the additional figure `extra`; all logarithmic, one
/// colour per program and scene.
std::string growthSvg(const core::BenchmarkReport& report, const std::string& by,
                      const std::string& extra);

} // namespace petrous::cli
