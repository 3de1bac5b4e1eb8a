#pragma once

#include <functional>
#include <istream>
#include <string>
#include <string_view>
#include <vector>

namespace petrous::core
{

/// Reads a CSV table of numbers, delimited by commas, semicolons or tabs (csvDelimiter): a header
/// with the column names (in any order; other columns are ignored), then one row per line; empty
/// lines, and empty fields at the end of a line, are skipped. `row` receives the line number,
/// counted from 1, and the values in the order of `columns`.
///
/// Throws InvalidParameter "NAME, line N: ..." if the header lacks a column or has it twice, a row
/// has another number of fields than the header or a value is not a finite number, and if the file
/// has no row. Exceptions from `row` propagate.
void readCsv(std::istream& csv, const std::string& name, const std::vector<std::string>& columns,
             const std::function<void(std::size_t line, const std::vector<double>& values)>& row);

/// A row of a table of text [RFC 4180].
struct CsvRow
{
  std::size_t line = 0;           ///< where it begins
  std::vector<std::string> cells; ///< without blanks at their ends
};

/// The comma, semicolon or tab that the first row has most of.
char csvDelimiter(std::string_view text) noexcept;

/// Cells may be quoted, and then hold the delimiter, line ends and, doubled, quotes. `line` is the
/// number of the first. Throws InvalidParameter "NAME, line N: ..." for a quote that stays open.
std::vector<CsvRow> csvRows(std::string_view text, const std::string& name, char delimiter,
                            std::size_t line = 1);

/// Rows of cells as CSV, each quoted where it has to be.
std::string csvText(const std::vector<std::vector<std::string>>& rows, char delimiter);

} // namespace petrous::core
