#include "petrous/Core/CsvTable.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <optional>
#include <sstream>

#include "petrous/Core/Error.h"
#include "petrous/Core/NumberText.h"

namespace petrous::core
{

namespace
{

std::string trimmed(const std::string& text)
{
  constexpr const char* kBlank = " \t\r\n";
  const std::size_t first = text.find_first_not_of(kBlank);
  return first == text.npos ? std::string()
                            : text.substr(first, text.find_last_not_of(kBlank) + 1 - first);
}

/// The fields of a line; a delimiter in quotes separates none.
std::vector<std::string> split(const std::string& line, char delimiter)
{
  std::vector<std::string> fields(1);
  bool isQuoted = false;
  for (const char c : line)
  {
    isQuoted = isQuoted != (c == '"');
    if (c == delimiter && !isQuoted)
      fields.emplace_back();
    else
      fields.back() += c;
  }
  for (std::string& field : fields)
  {
    const auto first = field.find_first_not_of(" \t\r\"");
    const auto last = field.find_last_not_of(" \t\r\"");
    field = first == std::string::npos ? "" : field.substr(first, last - first + 1);
  }
  return fields;
}

/// How many there are without the empty ones at the end, as spreadsheets write them.
std::size_t countOf(const std::vector<std::string>& fields)
{
  std::size_t count = fields.size();
  while (count > 0 && fields[count - 1].empty())
    --count;
  return count;
}

std::optional<double> number(const std::string& text)
{
  const auto value = parseDouble(text);
  return value && std::isfinite(*value) ? value : std::nullopt;
}

struct Header
{
  std::size_t fields = 0;
  std::vector<std::size_t> positions; ///< of the requested columns
};

Header readHeader(const std::string& line, const std::string& name, char delimiter,
                  const std::vector<std::string>& columns)
{
  constexpr const char* kByteOrderMark = "\xEF\xBB\xBF";
  const bool marked = line.rfind(kByteOrderMark, 0) == 0;
  std::map<std::string, std::size_t> there;
  const auto names = split(marked ? line.substr(3) : line, delimiter);
  for (std::size_t c = 0; c < names.size(); ++c)
    if (!there.emplace(names[c], c).second &&
        std::find(columns.begin(), columns.end(), names[c]) != columns.end())
      throw InvalidParameter(name + ", line 1: column '" + names[c] + "' is there twice");
  Header header{countOf(names), {}};
  for (const std::string& column : columns)
  {
    const auto found = there.find(column);
    if (found == there.end())
      throw InvalidParameter(name + ", line 1: there is no column '" + column +
                             "'; the first line must name the columns");
    header.positions.push_back(found->second);
  }
  return header;
}

} // namespace

void readCsv(std::istream& csv, const std::string& name, const std::vector<std::string>& columns,
             const std::function<void(std::size_t, const std::vector<double>&)>& row)
{
  std::string line;
  std::getline(csv, line);
  const char delimiter = csvDelimiter(line);
  const Header header = readHeader(line, name, delimiter, columns);
  std::vector<double> values(columns.size());
  bool any = false;
  for (std::size_t at = 2; std::getline(csv, line); ++at)
  {
    if (line.find_first_not_of(" \t\r") == std::string::npos)
      continue;
    const auto fields = split(line, delimiter);
    const auto refuse = [&](std::size_t count)
    {
      throw InvalidParameter(name + ", line " + std::to_string(at) + ": " + std::to_string(count) +
                             (count == 1 ? " field" : " fields") + ", and " +
                             std::to_string(header.fields) +
                             " columns in the first line; numbers need a decimal point, and each "
                             "column a field");
    };
    // A decimal comma makes more fields, whose first ones are numbers too.
    if (countOf(fields) > header.fields)
      refuse(countOf(fields));
    for (std::size_t c = 0; c < columns.size(); ++c)
    {
      const std::size_t position = header.positions[c];
      const auto value = position < fields.size() ? number(fields[position]) : std::nullopt;
      if (!value)
        throw InvalidParameter(name + ", line " + std::to_string(at) + ": '" + columns[c] +
                               "' is not a finite number; numbers need a decimal point");
      values[c] = *value;
    }
    if (fields.size() < header.fields)
      refuse(fields.size());
    row(at, values);
    any = true;
  }
  if (!any)
    throw InvalidParameter(name + ": there is no row after the header");
}

char csvDelimiter(std::string_view text) noexcept
{
  std::array<std::size_t, 3> counts{};
  constexpr std::string_view kDelimiters = ",;\t";
  bool isQuoted = false;
  for (const char c : text)
  {
    if (c == '"')
      isQuoted = !isQuoted;
    else if (c == '\n' && !isQuoted)
      break;
    else if (const std::size_t n = kDelimiters.find(c); n != kDelimiters.npos && !isQuoted)
      ++counts[n];
  }
  return kDelimiters[static_cast<std::size_t>(std::max_element(counts.begin(), counts.end()) -
                                              counts.begin())];
}

std::vector<CsvRow> csvRows(std::string_view text, const std::string& name, char delimiter,
                            std::size_t line)
{
  std::vector<CsvRow> rows;
  CsvRow row{line, {std::string()}};
  bool isQuoted = false;
  std::size_t quoteLine = 0;
  const auto end = [&]
  {
    for (std::string& cell : row.cells)
      cell = trimmed(cell);
    rows.push_back(std::move(row));
    row = {line, {std::string()}};
  };
  for (std::size_t n = 0; n < text.size(); ++n)
  {
    const char c = text[n];
    std::string& cell = row.cells.back();
    if (c == '\n')
      ++line;
    if (isQuoted && c == '"' && n + 1 < text.size() && text[n + 1] == '"')
    {
      cell += c;
      ++n;
    }
    else if (c == '"' && (isQuoted || trimmed(cell).empty()))
    {
      isQuoted = !isQuoted;
      quoteLine = line;
    }
    else if (isQuoted)
      cell += c;
    else if (c == delimiter)
      row.cells.emplace_back();
    else if (c == '\n')
      end();
    else
      cell += c;
  }
  if (isQuoted)
    throw InvalidParameter(name + ", line " + std::to_string(quoteLine) +
                           ": a quote is opened and not closed");
  end();
  return rows;
}

std::string csvText(const std::vector<std::vector<std::string>>& rows, char delimiter)
{
  std::string text;
  for (const auto& row : rows)
  {
    for (std::size_t n = 0; n < row.size(); ++n)
    {
      if (n > 0)
        text += delimiter;
      if (row[n].find_first_of(std::string("\"\r\n,;\t") + delimiter) == std::string::npos)
      {
        text += row[n];
        continue;
      }
      text += '"';
      for (const char c : row[n])
        text += c == '"' ? std::string("\"\"") : std::string(1, c);
      text += '"';
    }
    text += "\r\n";
  }
  return text;
}

} // namespace petrous::core
