#include "petrous/Dissection/ToolPath.h"

#include <array>
#include <charconv>
#include <cmath>
#include <map>
#include <optional>
#include <sstream>

#include "petrous/Core/Error.h"

namespace petrous::dissection
{

namespace
{

constexpr std::array<const char*, 9> kColumns{"t_s", "x_mm", "y_mm", "z_mm", "qw",
                                              "qx",  "qy",   "qz",   "drill"};

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
  double value = 0.0;
  const char* end = text.data() + text.size();
  const auto [rest, error] = std::from_chars(text.data(), end, value);
  if (error != std::errc{} || rest != end || !std::isfinite(value))
    return std::nullopt;
  return value;
}

[[noreturn]] void wrong(const std::string& name, std::size_t line, const std::string& what)
{
  throw core::InvalidParameter(name + ", line " + std::to_string(line) + ": " + what);
}

} // namespace

ToolPath ToolPath::read(std::istream& csv, const std::string& name)
{
  std::string line;
  if (!std::getline(csv, line))
    throw core::InvalidParameter(name + ": empty; a tool path starts with the header "
                                        "t_s,x_mm,y_mm,z_mm,qw,qx,qy,qz,drill");
  std::map<std::string, std::size_t> columns;
  const auto header = split(line);
  for (std::size_t c = 0; c < header.size(); ++c)
    columns[header[c]] = c;
  for (const char* column : kColumns)
    if (columns.count(column) == 0)
      wrong(name, 1, std::string("column '") + column +
                       "' is missing; the header is t_s,x_mm,y_mm,z_mm,qw,qx,qy,qz,drill");

  ToolPath path;
  for (std::size_t row = 2; std::getline(csv, line); ++row)
  {
    if (line.find_first_not_of(" \t\r") == std::string::npos)
      continue;
    const auto fields = split(line);
    std::array<double, kColumns.size()> v{};
    for (std::size_t c = 0; c < kColumns.size(); ++c)
    {
      const std::size_t at = columns[kColumns[c]];
      const auto value = at < fields.size() ? number(fields[at]) : std::nullopt;
      if (!value)
        wrong(name, row, std::string("'") + kColumns[c] + "' is no finite number");
      v[c] = *value;
    }
    const Eigen::Quaterniond rotation(v[4], v[5], v[6], v[7]);
    if (!(rotation.norm() > 1e-6))
      wrong(name, row, "the quaternion qw,qx,qy,qz is zero");
    if (v[8] != 0.0 && v[8] != 1.0)
      wrong(name, row, "drill must be 0 or 1");
    if (!path.m_samples.empty() && v[0] <= path.m_samples.back().time)
      wrong(name, row, "time must rise from row to row");
    path.m_samples.push_back({v[0], {rotation, {v[1], v[2], v[3]}}, v[8] == 1.0});
  }
  if (path.m_samples.empty())
    throw core::InvalidParameter(name + ": no row after the header; at least one pose is needed");
  return path;
}

void ToolPath::play(double rate, const std::function<void(const ToolSample&)>& tick) const
{
  if (!(rate > 0.0) || !std::isfinite(rate))
    throw core::InvalidParameter("tool path: the tick rate must be above 0 Hz");
  const double start = m_samples.front().time;
  const double end = m_samples.back().time;
  // The slack keeps a last tick that rounding would push beyond the end.
  const auto count = static_cast<std::uint64_t>(std::floor((end - start) * rate + 1e-9));
  std::size_t segment = 0;
  const auto at = [&](double time) {
    while (segment + 1 < m_samples.size() && m_samples[segment + 1].time <= time)
      ++segment;
    const ToolSample& a = m_samples[segment];
    if (segment + 1 == m_samples.size())
      return ToolSample{time, a.pose, a.drill};
    const ToolSample& b = m_samples[segment + 1];
    const double w = (time - a.time) / (b.time - a.time);
    return ToolSample{time,
                      {a.pose.rotation().slerp(w, b.pose.rotation()),
                       a.pose.translation() + w * (b.pose.translation() - a.pose.translation())},
                      a.drill};
  };
  for (std::uint64_t n = 0; n <= count; ++n)
    tick(at(std::min(start + static_cast<double>(n) / rate, end)));
  if (start + static_cast<double>(count) / rate < end - 1e-12)
    tick(at(end));
}

} // namespace petrous::dissection
