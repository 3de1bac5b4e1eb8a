#include "petrous/Core/CsvTable.h"

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

/// The fields of a line; a comma in quotes separates none.
std::vector<std::string> split(const std::string& line)
{
  std::vector<std::string> fields(1);
  bool isQuoted = false;
  for (const char c : line)
  {
    isQuoted = isQuoted != (c == '"');
    if (c == ',' && !isQuoted)
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

Header readHeader(const std::string& line, const std::string& name,
                  const std::vector<std::string>& columns)
{
  constexpr const char* kByteOrderMark = "\xEF\xBB\xBF";
  const bool marked = line.rfind(kByteOrderMark, 0) == 0;
  std::map<std::string, std::size_t> there;
  const auto names = split(marked ? line.substr(3) : line);
  for (std::size_t c = 0; c < names.size(); ++c)
    there.emplace(names[c], c);
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
  const Header header = readHeader(line, name, columns);
  std::vector<double> values(columns.size());
  bool any = false;
  for (std::size_t at = 2; std::getline(csv, line); ++at)
  {
    if (line.find_first_not_of(" \t\r") == std::string::npos)
      continue;
    const auto fields = split(line);
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
                               "' is not a finite number");
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

} // namespace petrous::core
