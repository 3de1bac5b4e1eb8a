#pragma once

#include <functional>
#include <istream>
#include <string>
#include <vector>

namespace petrous::core
{

/// Reads a CSV table of numbers: a header with the column names (in any order; other columns are
/// ignored), then one row per line; empty lines, and empty fields at the end of a line, are
/// skipped. `row` receives the line number, counted from 1, and the values in the order of
/// `columns`.
///
/// Throws InvalidParameter "NAME, line N: ..." if the header lacks a column, a row has another
/// number of fields than the header or a value is not a finite number, and if the file has no row.
/// Exceptions from `row` propagate.
void readCsv(std::istream& csv, const std::string& name, const std::vector<std::string>& columns,
             const std::function<void(std::size_t line, const std::vector<double>& values)>& row);

} // namespace petrous::core
