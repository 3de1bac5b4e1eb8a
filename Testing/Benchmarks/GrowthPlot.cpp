#include "GrowthPlot.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <vector>

#include "Numbers.h"
#include "SvgParts.h"
#include "petrous/Core/NumberText.h"

namespace petrous::cli
{

namespace
{

using Point = core::BenchmarkPoint;
using Value = std::function<double(const Point&)>;

constexpr double kLeft = 70.0, kTop = 60.0, kWide = 340.0, kHigh = 280.0, kBetween = 100.0;

bool isNumber(const std::string& text)
{
  return core::parseDouble(text).has_value();
}

std::string nameOf(const Point& point)
{
  return point.peer.empty() ? point.scene : point.peer;
}

std::string panel(const std::vector<Point>& points, const std::vector<std::string>& names,
                  double left, const std::string& title, const Value& right, const Value& up)
{
  std::vector<double> xs, ys;
  for (const Point& point : points)
  {
    xs.push_back(right(point));
    ys.push_back(up(point));
  }
  const svg::LogAxis x(xs), y(ys);
  const auto px = [&](double value) { return left + kWide * x.share(value); };
  const auto py = [&](double value) { return kTop + kHigh * (1.0 - y.share(value)); };
  std::string result = svg::text(left, kTop - 12, title, "font-size=\"12\"");
  for (const auto& tick : x.ticks())
  {
    const double decade = std::log10(tick.value);
    const bool labelled = std::abs(decade - std::round(decade)) < 1e-9; // no space for all labels
    result += svg::line(px(tick.value), kTop, px(tick.value), kTop + kHigh) +
              svg::text(px(tick.value), kTop + kHigh + 18, labelled ? fixed(tick.value, 0) : "",
                        "text-anchor=\"middle\"");
  }
  for (const auto& tick : y.ticks())
    result += svg::line(left, py(tick.value), left + kWide, py(tick.value)) +
              svg::text(left - 8, py(tick.value) + 4, tick.label, "text-anchor=\"end\"");
  std::map<std::string, const Point*> last;
  for (const Point& point : points)
  {
    const auto place = std::find(names.begin(), names.end(), nameOf(point)) - names.begin();
    const std::string color = svg::color(static_cast<std::size_t>(place));
    const Point*& before = last[nameOf(point)];
    if (before)
      result +=
          svg::line(px(right(*before)), py(up(*before)), px(right(point)), py(up(point)), color);
    result += svg::dot(px(right(point)), py(up(point)), color,
                       nameOf(point) + ": " + fixed(up(point), 3), point.isDefault);
    before = &point;
  }
  return result;
}

} // namespace

std::string growthSvg(const core::BenchmarkReport& report, const std::string& by,
                      const std::string& extra)
{
  std::vector<Point> points;
  std::vector<std::string> names;
  for (const Point& point : report.points)
  {
    const auto value = point.setting.find(by);
    if (value == point.setting.end() || !isNumber(value->second) || point.extra.count(extra) == 0)
      continue;
    points.push_back(point);
    if (std::find(names.begin(), names.end(), nameOf(point)) == names.end())
      names.push_back(nameOf(point));
  }
  const Value right = [&by](const Point& point)
  { return *core::parseDouble(point.setting.at(by)); };
  std::string result =
      svg::start(kLeft + 2.0 * kWide + kBetween + 40.0,
                 kTop + kHigh + 60.0 + 20.0 * static_cast<double>(names.size()), report.title);
  result += panel(points, names, kLeft, "time, ms, against " + by, right,
                  [](const Point& point) { return 1e3 * point.seconds; });
  result += panel(points, names, kLeft + kWide + kBetween, extra + " against " + by, right,
                  [&extra](const Point& point) { return point.extra.at(extra); });
  double row = kTop + kHigh + 50.0;
  for (std::size_t n = 0; n < names.size(); ++n, row += 20.0)
    result += svg::dot(kLeft + 4.0, row - 4.0, svg::color(n), names[n]) +
              svg::text(kLeft + 16.0, row, names[n]);
  return result + "</svg>\n";
}

} // namespace petrous::cli
