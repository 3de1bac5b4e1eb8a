#pragma once

#include <string>

#include "petrous/Core/BenchmarkReport.h"

namespace petrous::cli
{

/// Run time against error as an SVG: seconds to the right, error upwards, both logarithmic (an
/// error of 0 stands on the floor of the plot); a colour for each program, the default ringed.
std::string plotSvg(const core::BenchmarkReport& report);

} // namespace petrous::cli
