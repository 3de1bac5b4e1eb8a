#include "Numbers.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <limits>
#include <sstream>

#include "Context.h"

namespace petrous::cli
{

CLI::Validator within(const core::NumberRange& range)
{
  return {[range](std::string& text)
          {
            const auto value = core::parseDouble(text);
            return !value                   ? "'" + text + "' is no number"
                   : range.contains(*value) ? std::string()
                                            : range.refusal(*value);
          },
          range.text()};
}

CLI::Validator oneOf(std::vector<std::string> names)
{
  return {[names = std::move(names)](std::string& name)
          {
            if (std::find(names.begin(), names.end(), name) != names.end())
              return std::string();
            return "one of " + CLI::detail::join(names, ", ") + ", not '" + name + "'";
          },
          ""};
}

CLI::Validator endsIn(const std::string& suffix)
{
  return {[suffix](std::string& path)
          {
            const std::filesystem::path file(path);
            if (CLI::detail::to_lower(file.extension().string()) == suffix)
              return std::string();
            return "the file's name must end in " + suffix + ", not '" + file.filename().string() +
                   "'";
          },
          ""};
}

std::vector<double> parseNumbers(const std::string& text, std::size_t count,
                                 const std::string& option)
{
  std::vector<double> numbers;
  std::istringstream stream(text);
  for (std::string field; std::getline(stream, field, ',');)
  {
    const auto value = core::parseDouble(field);
    if (!value || !std::isfinite(*value))
      throw UsageError(option + ": '" + field + "' is no number");
    numbers.push_back(*value);
  }
  if (numbers.size() != count)
    throw UsageError(option + ": " + std::to_string(count) + " numbers are needed, not " +
                     std::to_string(numbers.size()));
  return numbers;
}

core::PatientBox parseBox(const std::string& text, const std::string& option)
{
  const std::string name = option + " x0,x1,y0,y1,z0,z1";
  const std::vector<double> n = parseNumbers(text, 6, name);
  for (std::size_t axis = 0; axis < 3; ++axis)
    if (n[2 * axis] >= n[2 * axis + 1])
      throw UsageError(name + ": each first number must be the smaller one");
  return {Eigen::Vector3d(n[0], n[2], n[4]), Eigen::Vector3d(n[1], n[3], n[5])};
}

int toInt(double value, const std::string& option)
{
  if (value != std::floor(value) || std::abs(value) > std::numeric_limits<int>::max())
    throw UsageError(option + ": a whole number is needed");
  return static_cast<int>(value);
}

std::pair<int, int> parseSize(const std::string& text)
{
  int width = 0;
  int height = 0;
  char rest = 0;
  if (std::sscanf(text.c_str(), "%dx%d%c", &width, &height, &rest) != 2 || width < 8 ||
      height < 8 || width > 8192 || height > 8192)
    throw UsageError("--size: WIDTHxHEIGHT with 8 to 8192 pixels each, not '" + text + "'");
  return {width, height};
}

std::string fixed(double value, int digits)
{
  return core::fixedText(value, digits);
}

} // namespace petrous::cli
