#include "RegistrationPlots.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include <nlohmann/json.hpp>

#include "BenchPlot.h"
#include "Numbers.h"
#include "SvgParts.h"

namespace petrous::cli
{

namespace
{

using Points = std::vector<core::BenchmarkPoint>;

constexpr double kLeft = 90.0, kTop = 60.0, kSize = 460.0; // px

template <class Take>
Points taken(const core::BenchmarkReport& report, const Take& take)
{
  Points points;
  std::copy_if(report.points.begin(), report.points.end(), std::back_inserter(points), take);
  return points;
}

bool startsWith(const std::string& text, const std::string& beginning)
{
  return text.rfind(beginning, 0) == 0;
}

std::string upwards(double x, double y, const std::string& words)
{
  return "<g transform=\"translate(" + fixed(x, 1) + "," + fixed(y, 1) + ") rotate(-90)\">" +
         svg::text(0, 0, words, "text-anchor=\"middle\"") + "</g>\n";
}

std::string calibrationSvg(const Points& points)
{
  const std::vector<std::string> verdicts{"good", "doubtful", "failed"};
  std::vector<double> both;
  std::map<std::string, std::pair<int, int>> covered; // and out of how many
  for (const auto& point : points)
  {
    both.push_back(point.extra.at("p95_mm"));
    both.push_back(point.error);
    auto& count = covered[point.setting.at("verdict")];
    count.first += point.extra.at("covered") > 0.5 ? 1 : 0;
    ++count.second;
  }
  const svg::LogAxis axis(both); // common axis, so that equal values are on the diagonal
  const auto px = [&](double value) { return kLeft + kSize * axis.share(value); };
  const auto py = [&](double value) { return kTop + kSize * (1.0 - axis.share(value)); };
  std::string result = svg::start(kLeft + kSize + 260.0, kTop + kSize + 60.0,
                                  "Stated p95 against true error, simulated pairs of known motion");
  for (const auto& tick : axis.ticks())
    result += svg::line(px(tick.value), kTop, px(tick.value), kTop + kSize) +
              svg::line(kLeft, py(tick.value), kLeft + kSize, py(tick.value)) +
              svg::text(px(tick.value), kTop + kSize + 18, tick.label, "text-anchor=\"middle\"") +
              svg::text(kLeft - 8, py(tick.value) + 4, tick.label, "text-anchor=\"end\"");
  result += svg::line(kLeft, kTop + kSize, kLeft + kSize, kTop, "#888");
  for (const auto& point : points)
  {
    const std::string& verdict = point.setting.at("verdict");
    const auto at = std::find(verdicts.begin(), verdicts.end(), verdict) - verdicts.begin();
    result += svg::dot(px(point.extra.at("p95_mm")), py(point.error),
                       svg::color(static_cast<std::size_t>(at)),
                       point.setting.at("images") + ", pair " + point.setting.at("pair") +
                           ": stated " + fixed(point.extra.at("p95_mm"), 2) + ", true " +
                           fixed(point.error, 2) + " mm, " + verdict);
  }
  double row = kTop + 16.0;
  for (std::size_t n = 0; n < verdicts.size(); ++n)
    if (const auto found = covered.find(verdicts[n]); found != covered.end())
    {
      const auto [inside, all] = found->second;
      result +=
          svg::dot(kLeft + kSize + 24, row - 4, svg::color(n), verdicts[n]) +
          svg::text(kLeft + kSize + 36, row,
                    verdicts[n] + ": " + std::to_string(inside) + " of " + std::to_string(all) +
                        " within, " + fixed(100.0 * inside / all, 1) + " %");
      row += 20.0;
    }
  return result +
         svg::text(kLeft + kSize + 20, row + 8, "below the line: covered", "fill=\"#666\"") +
         svg::text(kLeft + 0.5 * kSize, kTop + kSize + 44, "stated p95, mm",
                   "text-anchor=\"middle\"") +
         upwards(26, kTop + 0.5 * kSize, "true error at the ear, mm") + "</svg>\n";
}

// One panel: x the condition, equally spaced; y the median and the worst true error and the stated
// p95.
std::string conditionPanel(const Points& points, const std::string& name, double left,
                           const svg::LogAxis& axis)
{
  constexpr double wide = 300.0, high = 300.0;
  std::vector<std::string> values;
  for (const auto& point : points)
    values.push_back(point.setting.at(name));
  const auto px = [&](std::size_t n)
  { return left + wide * (static_cast<double>(n) + 0.5) / static_cast<double>(values.size()); };
  const auto py = [&](double value) { return kTop + high * (1.0 - axis.share(value)); };
  std::string result =
      svg::text(left + 0.5 * wide, kTop - 8, name, "text-anchor=\"middle\" font-weight=\"bold\"");
  for (const auto& tick : axis.ticks())
    result += svg::line(left, py(tick.value), left + wide, py(tick.value)) +
              svg::text(left - 8, py(tick.value) + 4, tick.label, "text-anchor=\"end\"");
  for (std::size_t n = 0; n < values.size(); ++n)
    result += svg::text(px(n), kTop + high + 18, values[n], "text-anchor=\"middle\"") +
              svg::text(px(n), kTop + high + 36,
                        fixed(points[n].extra.at("good"), 0) + "/" +
                            fixed(points[n].extra.at("pairs"), 0),
                        "text-anchor=\"middle\" font-size=\"10\" fill=\"#666\"");
  const auto curve = [&](std::size_t color, const auto& get)
  {
    for (std::size_t n = 0; n < points.size(); ++n)
    {
      if (n > 0)
        result += svg::line(px(n - 1), py(get(points[n - 1])), px(n), py(get(points[n])),
                            svg::color(color));
      result +=
          svg::dot(px(n), py(get(points[n])), svg::color(color), fixed(get(points[n]), 3) + " mm");
    }
  };
  curve(0, [](const auto& point) { return point.error; });
  curve(1, [](const auto& point) { return point.extra.at("worst_mm"); });
  curve(2, [](const auto& point) { return point.extra.at("stated_p95_mm"); });
  return result;
}

std::string conditionsSvg(const Points& points)
{
  std::vector<std::string> names;
  std::vector<double> values;
  for (const auto& point : points)
  {
    const std::string name = point.scene.substr(point.scene.find(' ') + 1);
    if (std::find(names.begin(), names.end(), name) == names.end())
      names.push_back(name);
    for (const double value :
         {point.error, point.extra.at("worst_mm"), point.extra.at("stated_p95_mm")})
      values.push_back(value);
  }
  const svg::LogAxis axis(values);
  const double width = kLeft + 360.0 * static_cast<double>(names.size());
  std::string result = svg::start(width, 470.0, "True error at the ear, mm, of simulated pairs");
  for (std::size_t n = 0; n < names.size(); ++n)
  {
    Points part;
    for (const auto& point : points)
      if (point.scene == "conditions: " + names[n])
        part.push_back(point);
    result += conditionPanel(part, names[n], kLeft + 360.0 * static_cast<double>(n), axis);
  }
  const char* words[] = {"median of the true error", "the worst true error",
                         "median of the stated p95"};
  for (std::size_t n = 0; n < 3; ++n)
    result += svg::dot(kLeft + 220.0 * static_cast<double>(n), 440, svg::color(n), words[n]) +
              svg::text(kLeft + 12 + 220.0 * static_cast<double>(n), 444, words[n]);
  return result +
         svg::text(kLeft + 670, 444, "below the values: how many were called good",
                   "fill=\"#666\"") +
         "</svg>\n";
}

struct Tally
{
  int trials = 0, wrong = 0;
  std::map<std::string, int> verdicts;
  double worst = 0.0; // true error of those rated good, mm

  void add(const core::BenchmarkPoint& point)
  {
    ++trials;
    wrong += point.extra.at("wrong") > 0.5 ? 1 : 0;
    const std::string& verdict = point.setting.at("verdict");
    ++verdicts[verdict];
    if (verdict == "good" && !std::isnan(point.error))
      worst = std::max(worst, point.error);
  }
  int count(const std::string& verdict) const
  {
    const auto found = verdicts.find(verdict);
    return found == verdicts.end() ? 0 : found->second;
  }
  std::string row(const std::string& name) const
  {
    return "| " + name + " | " + std::to_string(trials) + " | " + std::to_string(count("good")) +
           " | " + std::to_string(count("doubtful")) + " | " + std::to_string(count("failed")) +
           " | " + std::to_string(count("refused")) + " | " +
           (count("good") > 0 && worst > 0.0 ? fixed(worst, 2) : std::string("")) + " | " +
           std::to_string(wrong) + " |\n";
  }
};

std::string kindOf(const core::BenchmarkPoint& point)
{
  return point.scene.substr(std::string("stress: ").size());
}

std::string stressTable(const Points& points)
{
  std::vector<std::string> kinds;
  std::map<std::string, Tally> tallies;
  Tally all;
  std::string wrong;
  for (const auto& point : points)
  {
    const std::string kind = kindOf(point);
    if (std::find(kinds.begin(), kinds.end(), kind) == kinds.end())
      kinds.push_back(kind);
    tallies[kind].add(point);
    all.add(point);
    if (point.extra.at("wrong") > 0.5)
      wrong += "- " + kind + " (" + point.setting.at("trial") + "): " +
               (std::isnan(point.error) ? std::string("no truth exists")
                                        : "true error " + fixed(point.error, 2) + " mm") +
               ", stated p95 " + fixed(point.extra.at("p95_mm"), 2) + ", max " +
               fixed(point.extra.at("max_mm"), 2) + " mm: \"" + point.setting.at("text") + "\"\n";
  }
  std::string table = "| trial | of them | good | doubtful | failed | refused by the reader | true "
                      "error of a good one, worst, mm | confidently wrong |\n"
                      "|---|---|---|---|---|---|---|---|\n";
  for (const std::string& kind : kinds)
    table += tallies[kind].row(kind);
  table += all.row("**all**");
  return "# Stress trials of the registration\n\nConfidently wrong: the verdict good, and a true "
         "error over 2 mm or over 3 times the stated maximum, or no truth at all.\n\n" +
         table + (wrong.empty() ? "" : "\nConfidently wrong:\n\n" + wrong);
}

std::string stressJson(const Points& points)
{
  nlohmann::json trials = nlohmann::json::array();
  int wrong = 0;
  for (const auto& point : points)
  {
    wrong += point.extra.at("wrong") > 0.5 ? 1 : 0;
    nlohmann::json trial{{"kind", kindOf(point)},
                         {"trial", point.setting.at("trial")},
                         {"verdict", point.setting.at("verdict")},
                         {"outcome", point.setting.at("outcome")},
                         {"text", point.setting.at("text")},
                         {"truth", point.setting.at("truth")}};
    if (!std::isnan(point.error))
      trial["true_error_mm"] = point.error;
    for (const char* name : {"median_mm", "p95_mm", "max_mm"})
      if (const auto found = point.extra.find(name); found != point.extra.end())
        trial["stated_" + std::string(name)] = found->second;
    trials.push_back(std::move(trial));
  }
  return nlohmann::json{{"trials", points.size()}, {"confidently_wrong", wrong}, {"list", trials}}
             .dump(1) +
         "\n";
}

} // namespace

std::map<std::string, std::string> registrationPlots(const core::BenchmarkReport& report)
{
  std::map<std::string, std::string> plots;
  const auto what = [](const core::BenchmarkPoint& point, const char* beginning)
  {
    const auto found = point.setting.find("what");
    return found != point.setting.end() && startsWith(found->second, beginning);
  };
  if (const Points pairs =
          taken(report, [&](const auto& p) { return what(p, "fit") && !std::isnan(p.error); });
      !pairs.empty())
    plots[""] =
        plotSvg({report.name, "Fit, and fit with error estimate: time against error", pairs});
  if (const Points schedule = taken(report, [](const auto& p) { return p.scene == "schedule"; });
      !schedule.empty())
    plots["-schedule"] = seriesSvg(
        {report.name, "Time against mean error at the target, one setting varied at a time",
         schedule});
  if (const Points conditions =
          taken(report, [](const auto& p) { return startsWith(p.scene, "conditions: "); });
      !conditions.empty())
    plots["-conditions"] = conditionsSvg(conditions);
  if (const Points calibration =
          taken(report, [](const auto& p) { return p.scene == "calibration"; });
      !calibration.empty())
    plots["-calibration"] = calibrationSvg(calibration);
  if (const Points stress =
          taken(report, [](const auto& p) { return startsWith(p.scene, "stress: "); });
      !stress.empty())
  {
    plots["-stress.md"] = stressTable(stress);
    plots["-stress.json"] = stressJson(stress);
  }
  return plots;
}

} // namespace petrous::cli
