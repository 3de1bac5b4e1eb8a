#include "Numbers.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <limits>
#include <optional>
#include <sstream>
#include <string_view>

#include "Context.h"
#include "petrous/Core/CsvTable.h"
#include "petrous/Core/InputFile.h"

namespace petrous::cli
{

CLI::Validator within(const core::NumberRange& range)
{
  return {[range](std::string& text)
          {
            const auto value = core::parseDouble(text);
            return !value                   ? "'" + text + "' is not a number"
                   : range.contains(*value) ? std::string()
                                            : range.refusal(*value);
          },
          range.text()};
}

namespace
{

// Digits alone, without sign; nullopt for anything else, and beyond 64 bits.
std::optional<std::uint64_t> parseWhole(std::string_view text)
{
  std::uint64_t value = 0;
  const auto end = std::from_chars(text.data(), text.data() + text.size(), value);
  if (end.ec != std::errc() || end.ptr != text.data() + text.size())
    return std::nullopt;
  return value;
}

} // namespace

CLI::Validator wholeNumber(std::uint64_t lower, std::uint64_t upper)
{
  const std::string range = std::to_string(lower) + " to " + std::to_string(upper);
  return {[lower, upper, range](std::string& text)
          {
            const auto value = parseWhole(text);
            if (!value || *value < lower || *value > upper)
              return "must be a whole number within " + range + ", not '" + text + "'";
            text = std::to_string(*value); // without leading zeros
            return std::string();
          },
          range};
}

CLI::Validator oneOf(std::vector<std::string> names)
{
  const std::string choices = CLI::detail::join(names, std::string(1, kBetweenChoices));
  return {[names = std::move(names)](std::string& name)
          {
            if (std::find(names.begin(), names.end(), name) != names.end())
              return std::string();
            return "one of " + CLI::detail::join(names, ", ") + ", not '" + name + "'";
          },
          "", choices};
}

CLI::Validator offers(const std::vector<std::string>& names)
{
  return {[](std::string&) { return std::string(); }, "",
          CLI::detail::join(names, std::string(1, kBetweenChoices))};
}

CLI::Validator endsIn(const std::vector<std::string>& suffixes)
{
  return {[suffixes](std::string& path)
          {
            const std::filesystem::path file(path);
            const std::string suffix = CLI::detail::to_lower(file.extension().string());
            if (std::find(suffixes.begin(), suffixes.end(), suffix) != suffixes.end())
              return std::string();
            return "the file's name must end in " + CLI::detail::join(suffixes, " or ") +
                   ", not '" + file.filename().string() + "'";
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
      throw UsageError(option + ": '" + field + "' is not a number");
    numbers.push_back(*value);
  }
  if (numbers.size() != count)
    throw UsageError(option + ": " + std::to_string(count) + " numbers are needed, not " +
                     std::to_string(numbers.size()) +
                     (numbers.size() > count ? " (a decimal number has a point)" : ""));
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

core::AxesCorrection parseAxes(const std::string& text, const std::string& option)
{
  try
  {
    return core::AxesCorrection::parse(text);
  }
  catch (const core::InvalidParameter& error)
  {
    throw UsageError(option + ": " + error.what());
  }
}

std::vector<Eigen::Vector3d> readPoints(const std::filesystem::path& path)
{
  std::ifstream file = core::openInput(path, kLargestInput);
  std::vector<Eigen::Vector3d> points;
  core::readCsv(file, path.string(), {"x_mm", "y_mm", "z_mm"},
                [&points](std::size_t, const std::vector<double>& row)
                { points.emplace_back(row[0], row[1], row[2]); });
  return points;
}

int toInt(double value, const std::string& option)
{
  if (value != std::floor(value) || std::abs(value) > std::numeric_limits<int>::max())
    throw UsageError(option + ": a whole number is needed");
  return static_cast<int>(value);
}

std::pair<int, int> parseSize(const std::string& text)
{
  constexpr std::uint64_t kMin = 8;
  constexpr std::uint64_t kMax = 8192;
  const std::size_t x = std::min(text.find('x'), text.size());
  const auto width = parseWhole(std::string_view(text).substr(0, x));
  const auto height = parseWhole(std::string_view(text).substr(std::min(x + 1, text.size())));
  const auto fits = [](const auto& n) { return n && *n >= kMin && *n <= kMax; };
  if (!fits(width) || !fits(height))
    throw UsageError("--size: WIDTHxHEIGHT with 8 to 8192 pixels each, not '" + text + "'");
  return {static_cast<int>(*width), static_cast<int>(*height)};
}

std::string fixed(double value, int digits)
{
  return core::fixedText(value, digits);
}

double millimetresOf(const std::string& unit)
{
  return unit == "nm"     ? 1e-6
         : unit == "um"   ? 0.001
         : unit == "cm"   ? 10.0
         : unit == "m"    ? 1000.0
         : unit == "inch" ? 25.4
                          : 1.0;
}

dissection::BurrModel burrNamed(const std::string& name, const dissection::BurrCatalogue& burrs)
{
  try
  {
    return burrs.model(name);
  }
  catch (const core::InvalidParameter& error)
  {
    throw UsageError(std::string("--burr: ") + error.what());
  }
}

std::vector<std::string> builtInBurrs()
{
  std::vector<std::string> names;
  const dissection::BurrCatalogue burrs = dissection::BurrCatalogue::builtIn();
  for (const dissection::BurrModel& one : burrs.all())
    names.push_back(one.name);
  return names;
}

imaging::UndeclaredBits undeclaredBitsOf(const std::string& bits)
{
  return bits == "stored"      ? imaging::UndeclaredBits::LeaveOut
         : bits == "allocated" ? imaging::UndeclaredBits::Keep
                               : imaging::UndeclaredBits::Refuse;
}

} // namespace petrous::cli
