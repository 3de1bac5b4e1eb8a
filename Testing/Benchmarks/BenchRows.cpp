#include <algorithm>
#include <cmath>
#include <vector>

#include "BenchPlot.h"
#include "Numbers.h"
#include "SvgParts.h"

namespace petrous::cli
{

namespace
{

constexpr double kPlot = 610.0; // px
constexpr double kMin = 400.0;  // px, of the column of names
constexpr double kLetter = 6.2; // px, approximate letter width
constexpr double kRight = 30.0;
constexpr double kTop = 110.0;
constexpr double kRow = 24.0;

std::size_t placeOf(std::vector<std::string>& names, const std::string& name)
{
  const auto found = std::find(names.begin(), names.end(), name);
  const auto place = static_cast<std::size_t>(found - names.begin());
  if (found == names.end())
    names.push_back(name);
  return place;
}

std::string toString(double seconds)
{
  if (seconds < 1e-3)
    return fixed(1e6 * seconds, seconds < 1e-5 ? 1 : 0) + " \u00b5s";
  return fixed(1e3 * seconds, seconds < 0.01 ? 2 : 0) + " ms";
}

} // namespace

std::string rowsSvg(const core::BenchmarkReport& report)
{
  std::vector<std::string> scenes, programs{"petrous"};
  std::vector<double> seconds;
  for (const auto& point : report.points)
    if (point.series.empty())
    {
      placeOf(scenes, point.scene);
      placeOf(programs, point.peer.empty() ? "petrous" : point.peer);
      seconds.push_back(point.seconds);
    }
  double left = kMin;
  for (const std::string& scene : scenes)
    left = std::max(left, 20.0 + kLetter * static_cast<double>(scene.size()));
  const double width = left + kPlot + kRight;
  const svg::LogAxis axis(seconds);
  const double bottom = kTop + kRow * static_cast<double>(scenes.size());
  const auto px = [&](double share) { return left + share * kPlot; };
  std::string result = svg::start(width, bottom + 50.0, "Median time, s");
  for (std::size_t n = 0; n < programs.size(); ++n)
  {
    const double x = 30.0 + 330.0 * static_cast<double>(n % 3);
    const double y = 52.0 + 20.0 * static_cast<double>(n / 3);
    result += svg::dot(x, y - 4, svg::color(n), programs[n]) + svg::text(x + 12, y, programs[n]);
  }
  for (const auto& tick : axis.ticks())
    result += svg::line(px(tick.share), kTop, px(tick.share), bottom) +
              svg::text(px(tick.share), bottom + 18, tick.label, "text-anchor=\"middle\"");
  for (std::size_t n = 0; n < scenes.size(); ++n)
    result += svg::text(left - 12, kTop + kRow * (static_cast<double>(n) + 0.5) + 4, scenes[n],
                        "text-anchor=\"end\" font-size=\"11\"");
  for (const auto& point : report.points)
  {
    if (!point.series.empty())
      continue;
    const double x = px(axis.share(point.seconds));
    const double y = kTop + kRow * (static_cast<double>(placeOf(scenes, point.scene)) + 0.5);
    const std::string program = point.peer.empty() ? "petrous" : point.peer;
    const std::string words = toString(point.seconds);
    result += svg::dot(x, y, svg::color(placeOf(programs, program)),
                       program + ", " + point.scene + ": " + words);
    if (point.peer.empty())
      result += svg::text(x, y - 8, words, "text-anchor=\"middle\" font-size=\"9\"");
  }
  return result + "</svg>\n";
}

std::map<std::string, std::string> plotsOf(const core::BenchmarkReport& report)
{
  std::vector<std::string> scenes;
  for (const auto& point : report.points)
    if (!point.series.empty())
      placeOf(scenes, point.scene);
  if (scenes.empty())
    return {{"", plotSvg(report)}};
  std::map<std::string, std::string> plots;
  for (std::size_t n = 0; n < scenes.size(); ++n)
  {
    core::BenchmarkReport part{report.name, report.title + ": " + scenes[n], {}};
    for (const auto& point : report.points)
      if (point.scene == scenes[n] &&
          (!point.series.empty() || std::isnan(point.error) || point.isDefault))
        part.points.push_back(point);
    plots[n == 0 ? "" : "-" + std::to_string(n + 1)] = seriesSvg(part);
  }
  if (std::any_of(report.points.begin(), report.points.end(),
                  [](const auto& point) { return point.series.empty(); }))
    plots["-frames"] = rowsSvg(report);
  return plots;
}

} // namespace petrous::cli
