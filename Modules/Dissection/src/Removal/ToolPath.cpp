#include "petrous/Dissection/ToolPath.h"

#include <cmath>

#include "petrous/Core/CsvTable.h"
#include "petrous/Core/Error.h"
#include "petrous/Core/NumberText.h"

namespace petrous::dissection
{

namespace
{
constexpr double kFarthest = 1e6;  // mm
constexpr double kMaxTicks = 1e8;  // more than a day at 1 kHz
constexpr double kSameTick = 1e-6; // fraction of a tick
} // namespace

ToolPath ToolPath::read(std::istream& csv, const std::string& name)
{
  ToolPath path;
  const auto wrong = [&name](std::size_t line, const std::string& what)
  { throw core::InvalidParameter(name + ", line " + std::to_string(line) + ": " + what); };
  core::readCsv(csv, name, {"t_s", "x_mm", "y_mm", "z_mm", "qw", "qx", "qy", "qz", "drill"},
                [&](std::size_t line, const std::vector<double>& v)
                {
                  for (const std::size_t column : {1, 2, 3})
                    if (std::abs(v[column]) > kFarthest)
                      wrong(line, "a position must lie within 1e6 mm");
                  const Eigen::Quaterniond rotation(v[4], v[5], v[6], v[7]);
                  if (!(rotation.norm() > 1e-6 && rotation.norm() < 1e6))
                    wrong(line,
                          "the quaternion qw,qx,qy,qz is zero or huge; it should have length 1");
                  if (v[8] != 0.0 && v[8] != 1.0)
                    wrong(line, "drill must be 0 or 1");
                  if (!path.m_samples.empty() && v[0] <= path.m_samples.back().time)
                    wrong(line, "time must rise from row to row");
                  path.m_samples.push_back({v[0], {rotation, {v[1], v[2], v[3]}}, v[8] == 1.0});
                });
  return path;
}

void ToolPath::play(double rate, const std::function<void(const ToolSample&)>& tick) const
{
  if (!(rate > 0.0) || !std::isfinite(rate))
    throw core::InvalidParameter("tool path: the tick rate must be above 0 Hz");
  const double start = m_samples.front().time;
  const double end = m_samples.back().time;
  if (!((end - start) * rate <= kMaxTicks))
    throw core::InvalidParameter("tool path: lasts " + core::plainText(end - start) +
                                 " s, which is more than 1e8 ticks; cut it into parts");

  std::size_t segment = 0;
  const auto emit = [&](double time)
  {
    while (segment + 1 < m_samples.size() && m_samples[segment + 1].time <= time)
      ++segment;
    const ToolSample& a = m_samples[segment];
    if (segment + 1 == m_samples.size())
      return tick({time, a.pose, a.drill});
    const ToolSample& b = m_samples[segment + 1];
    const double w = (time - a.time) / (b.time - a.time);
    tick({time,
          {a.pose.rotation().slerp(w, b.pose.rotation()),
           a.pose.translation() + w * (b.pose.translation() - a.pose.translation())},
          a.drill});
  };

  // The drill switches at its row's own pose and time, also between two ticks.
  std::size_t row = 0;
  const auto emitSwitchesBefore = [&](double time)
  {
    for (; row < m_samples.size() && m_samples[row].time < time; ++row)
      if (row > 0 && m_samples[row].drill != m_samples[row - 1].drill)
        emit(m_samples[row].time);
  };
  const double slack = kSameTick / rate;
  const auto count = static_cast<std::uint64_t>(std::floor((end - start) * rate + kSameTick));
  for (std::uint64_t n = 0; n <= count; ++n)
  {
    double time = std::min(start + static_cast<double>(n) / rate, end);
    emitSwitchesBefore(time - slack);
    // A row that coincides with a tick defines its exact time.
    if (row < m_samples.size() && std::abs(m_samples[row].time - time) <= slack)
      time = m_samples[row++].time;
    emit(time);
  }
  emitSwitchesBefore(end - slack);
  if (start + static_cast<double>(count) / rate < end - slack)
    emit(end);
}

} // namespace petrous::dissection
