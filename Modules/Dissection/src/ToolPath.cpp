#include "petrous/Dissection/ToolPath.h"

#include <cmath>

#include "petrous/Core/CsvTable.h"
#include "petrous/Core/Error.h"

namespace petrous::dissection
{

ToolPath ToolPath::read(std::istream& csv, const std::string& name)
{
  ToolPath path;
  const auto wrong = [&name](std::size_t line, const std::string& what)
  { throw core::InvalidParameter(name + ", line " + std::to_string(line) + ": " + what); };
  core::readCsv(csv, name, {"t_s", "x_mm", "y_mm", "z_mm", "qw", "qx", "qy", "qz", "drill"},
                [&](std::size_t line, const std::vector<double>& v)
                {
                  const Eigen::Quaterniond rotation(v[4], v[5], v[6], v[7]);
                  if (!(rotation.norm() > 1e-6))
                    wrong(line, "the quaternion qw,qx,qy,qz is zero");
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
  // The slack keeps a last tick that rounding would push beyond the end.
  const auto count = static_cast<std::uint64_t>(std::floor((end - start) * rate + 1e-9));
  std::size_t segment = 0;
  const auto at = [&](double time)
  {
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
