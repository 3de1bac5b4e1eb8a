#pragma once

#include <map>
#include <string>

#include "petrous/Core/BenchmarkReport.h"

namespace petrous::cli
{

/// SVG of error over run time: x in seconds, y the error, both logarithmic (an error of 0 is drawn
/// at the bottom of the plot); one colour per program, the default setting ringed.
std::string plotSvg(const core::BenchmarkReport& report);

/// The same for the points of series: one panel each with common axes, joined and labelled with the
/// varied value; below them the times of other programs, which have no error.
std::string seriesSvg(const core::BenchmarkReport& report);

/// Times only: one row per scene, one dot per program; the number is ours, in milliseconds.
std::string rowsSvg(const core::BenchmarkReport& report);

/// The plots written by `petrous bench`: file name suffix -> SVG. A report without series gives one
/// plot (""); otherwise one plot per scene of a series ("", "-2", ...) and, for the points without
/// series, the rows ("-frames").
std::map<std::string, std::string> plotsOf(const core::BenchmarkReport& report);

} // namespace petrous::cli
