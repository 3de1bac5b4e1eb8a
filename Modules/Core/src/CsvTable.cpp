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

std::vector<std::string> split(const std::string& line)
{
  std::vector<std::string> fields;
  std::istringstream stream(line);
  for (std::string field; std::getline(stream, field, ',');)
  {
    const auto first = field.find_first_not_of(" \t\r\"");
    const auto last = field.find_last_not_of(" \t\r\"");
    fields.push_back(first == std::string::npos ? "" : field.substr(first, last - first + 1));
  }
  return fields;
}

std::optional<double> number(const std::string& text)
{
  const auto value = parseDouble(text);
  return value && std::isfinite(*value) ? value : std::nullopt;
}

// Positions of the requested columns in the header line.
std::vector<std::size_t> findColumns(const std::string& line, const std::string& name,
                                     const std::vector<std::string>& columns)
{
  constexpr const char* kByteOrderMark = "\xEF\xBB\xBF";
  const bool marked = line.rfind(kByteOrderMark, 0) == 0;
  std::map<std::string, std::size_t> there;
  const auto header = split(marked ? line.substr(3) : line);
  for (std::size_t c = 0; c < header.size(); ++c)
    there.emplace(header[c], c);
  std::vector<std::size_t> positions;
  for (const std::string& column : columns)
  {
    const auto found = there.find(column);
    if (found == there.end())
      throw InvalidParameter(name + ", line 1: there is no column '" + column +
                             "'; the first line must name the columns");
    positions.push_back(found->second);
  }
  return positions;
}

} // namespace

void readCsv(std::istream& csv, const std::string& name, const std::vector<std::string>& columns,
             const std::function<void(std::size_t, const std::vector<double>&)>& row)
{
  std::string line;
  std::getline(csv, line);
  const auto positions = findColumns(line, name, columns);
  std::vector<double> values(columns.size());
  bool any = false;
  for (std::size_t at = 2; std::getline(csv, line); ++at)
  {
    if (line.find_first_not_of(" \t\r") == std::string::npos)
      continue;
    const auto fields = split(line);
    for (std::size_t c = 0; c < columns.size(); ++c)
    {
      const auto value = positions[c] < fields.size() ? number(fields[positions[c]]) : std::nullopt;
      if (!value)
        throw InvalidParameter(name + ", line " + std::to_string(at) + ": '" + columns[c] +
                               "' is not a finite number");
      values[c] = *value;
    }
    row(at, values);
    any = true;
  }
  if (!any)
    throw InvalidParameter(name + ": there is no row after the header");
}

} // namespace petrous::core
