#pragma once

#include <functional>
#include <istream>
#include <string>
#include <vector>

namespace petrous::core
{

/// Reads a CSV of numbers: a header that names the columns (in any order, others are ignored), then
/// a row a line; empty lines are passed over. `row` gets the line number, counted from 1, and the
/// values in the order of `columns`.
///
/// Throws InvalidParameter "NAME, line N: ..." where the header lacks a column or a value is no
/// finite number, and for a file without a row. What `row` throws passes through.
void readCsv(std::istream& csv, const std::string& name, const std::vector<std::string>& columns,
             const std::function<void(std::size_t line, const std::vector<double>& values)>& row);

} // namespace petrous::core
