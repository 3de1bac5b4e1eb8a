#pragma once

#include <string>
#include <utility>
#include <vector>

#include "petrous/Core/PatientBox.h"

namespace petrous::cli
{

/// Exactly `count` finite numbers with commas between them; UsageError naming `option` otherwise.
std::vector<double> parseNumbers(const std::string& text, std::size_t count,
                                 const std::string& option);

/// "x0,x1,y0,y1,z0,z1", each first number the smaller one; UsageError naming `option` otherwise.
core::PatientBox parseBox(const std::string& text, const std::string& option);

/// A whole number that fits an int; UsageError naming `option` otherwise.
int toInt(double value, const std::string& option);

/// "800x600": 8 to 8192 pixels each; UsageError otherwise.
std::pair<int, int> parseSize(const std::string& text);

/// A number for people: `digits` after the point.
std::string fixed(double value, int digits);

} // namespace petrous::cli
