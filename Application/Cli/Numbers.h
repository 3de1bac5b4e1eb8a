#pragma once

#include <string>
#include <utility>
#include <vector>

#include "petrous/Core/PatientBox.h"

namespace petrous::cli
{

/// Exactly `count` finite numbers separated by commas; otherwise throws UsageError naming `option`.
std::vector<double> parseNumbers(const std::string& text, std::size_t count,
                                 const std::string& option);

/// "x0,x1,y0,y1,z0,z1", minimum before maximum; otherwise throws UsageError naming `option`.
core::PatientBox parseBox(const std::string& text, const std::string& option);

/// An integer within the range of int; otherwise throws UsageError naming `option`.
int toInt(double value, const std::string& option);

/// "800x600": 8 to 8192 pixels each; otherwise throws UsageError.
std::pair<int, int> parseSize(const std::string& text);

/// A number as text with `digits` decimals.
std::string fixed(double value, int digits);

} // namespace petrous::cli
