#pragma once

#include <map>
#include <string>

#include "petrous/Core/BenchmarkReport.h"

namespace petrous::cli
{

/// Run time against error as an SVG: seconds to the right, error upwards, both logarithmic (an
/// error of 0 stands on the floor of the plot); a colour for each program, the default ringed.
std::string plotSvg(const core::BenchmarkReport& report);

/// The same for the points of series, a panel each on the same axes, joined and labelled with the
/// value that was varied; below them the times of other programs, which have no error.
std::string seriesSvg(const core::BenchmarkReport& report);

/// Times alone: one row a scene, one dot a program; the number is ours, in milliseconds.
std::string rowsSvg(const core::BenchmarkReport& report);

/// What `petrous bench` writes: file name's end -> SVG. A report without series is one plot ("");
/// else there is a plot for each scene of a series ("", "-2", ...) and,
/// for the points without, the rows ("-frames").
std::map<std::string, std::string> plotsOf(const core::BenchmarkReport& report);

} // namespace petrous::cli
