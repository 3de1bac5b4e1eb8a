#include "BenchPlot.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <vector>

#include "Numbers.h"

namespace petrous::cli
{

namespace
{

constexpr double kWidth = 760.0;
constexpr double kHeight = 460.0;
constexpr double kLeft = 90.0;
constexpr double kRight = 230.0;
constexpr double kTop = 50.0;
constexpr double kBottom = 60.0;
constexpr std::array<const char*, 6> kColors{"#1b6ca8", "#c8553d", "#588157",
                                             "#7b4b94", "#b08900", "#555555"};

std::string escaped(const std::string& text)
{
  std::string result;
  for (const char c : text)
    result += c == '<' ? "&lt;" : c == '>' ? "&gt;" : c == '&' ? "&amp;" : std::string(1, c);
  return result;
}

// Whole decades around positive values.
struct LogAxis
{
  double low = 0.0;
  double high = 1.0;

  explicit LogAxis(const std::vector<double>& values)
  {
    double least = 1e300;
    double most = 0.0;
    for (const double v : values)
      if (v > 0.0)
      {
        least = std::min(least, v);
        most = std::max(most, v);
      }
    if (most <= 0.0)
      least = most = 1.0;
    low = std::floor(std::log10(least) - 0.05);
    high = std::max(std::ceil(std::log10(most) + 0.05), low + 1.0);
  }
  double share(double value) const
  {
    return value > 0.0 ? (std::log10(value) - low) / (high - low) : 0.0;
  }
};

std::string text(double x, double y, const std::string& words, const std::string& style)
{
  return "<text x=\"" + fixed(x, 1) + "\" y=\"" + fixed(y, 1) + "\" " + style + ">" +
         escaped(words) + "</text>\n";
}

std::string line(double x0, double y0, double x1, double y1)
{
  return "<line x1=\"" + fixed(x0, 1) + "\" y1=\"" + fixed(y0, 1) + "\" x2=\"" + fixed(x1, 1) +
         "\" y2=\"" + fixed(y1, 1) + "\" stroke=\"#ddd\"/>\n";
}

std::string power(int exponent)
{
  char words[16];
  std::snprintf(words, sizeof words, "1e%d", exponent);
  return words;
}

} // namespace

std::string plotSvg(const core::BenchmarkReport& report)
{
  std::vector<double> seconds, errors;
  std::vector<std::string> programs;
  for (const auto& point : report.points)
  {
    seconds.push_back(point.seconds);
    errors.push_back(point.error);
    const std::string program = point.peer.empty() ? "petrous" : point.peer;
    if (std::find(programs.begin(), programs.end(), program) == programs.end())
      programs.push_back(program);
  }
  const bool hasZero = std::any_of(errors.begin(), errors.end(), [](double e) { return e <= 0.0; });
  const LogAxis xAxis(seconds);
  const LogAxis yAxis(errors);
  const double plotWidth = kWidth - kLeft - kRight;
  const double plotHeight = kHeight - kTop - kBottom;
  const auto px = [&](double share) { return kLeft + share * plotWidth; };
  const auto py = [&](double share) { return kHeight - kBottom - share * plotHeight; };

  std::string svg = "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"" + fixed(kWidth, 0) +
                    "\" height=\"" + fixed(kHeight, 0) +
                    "\" font-family=\"sans-serif\" font-size=\"12\">\n"
                    "<rect width=\"100%\" height=\"100%\" fill=\"white\"/>\n";
  svg += text(kLeft, 28, report.title, "font-size=\"15\"");
  for (int e = static_cast<int>(xAxis.low); e <= static_cast<int>(xAxis.high); ++e)
  {
    const double x = px((e - xAxis.low) / (xAxis.high - xAxis.low));
    svg += line(x, py(0), x, py(1)) + text(x, py(0) + 18, power(e), "text-anchor=\"middle\"");
  }
  for (int e = static_cast<int>(yAxis.low); e <= static_cast<int>(yAxis.high); ++e)
  {
    const double y = py((e - yAxis.low) / (yAxis.high - yAxis.low));
    const bool isFloor = e == static_cast<int>(yAxis.low) && hasZero;
    svg += line(px(0), y, px(1), y) +
           text(px(0) - 8, y + 4, isFloor ? "0" : power(e), "text-anchor=\"end\"");
  }
  svg += text(px(0.5), kHeight - 16, "time, s", "text-anchor=\"middle\"");
  const std::string unit = report.points.empty() ? "" : report.points.front().errorUnit;
  svg += "<g transform=\"translate(22," + fixed(py(0.5), 1) + ") rotate(-90)\">" +
         text(0, 0, "error, " + unit, "text-anchor=\"middle\"") + "</g>\n";

  for (const auto& point : report.points)
  {
    const std::string program = point.peer.empty() ? "petrous" : point.peer;
    const auto at = std::find(programs.begin(), programs.end(), program) - programs.begin();
    const std::string color = kColors[static_cast<std::size_t>(at) % kColors.size()];
    std::string words = program + ", " + point.scene;
    for (const auto& [name, value] : point.setting)
      words += ", " + name + " " + value;
    char error[32];
    std::snprintf(error, sizeof error, "%.3g", point.error);
    words += ": " + fixed(1e3 * point.seconds, 2) + " ms, " + error + " " + point.errorUnit;
    const std::string x = fixed(px(xAxis.share(point.seconds)), 1);
    const std::string y = fixed(py(yAxis.share(point.error)), 1);
    if (point.isDefault)
      svg += "<circle cx=\"" + x + "\" cy=\"" + y + "\" r=\"9\" fill=\"none\" stroke=\"" + color +
             "\"/>\n";
    svg += "<circle cx=\"" + x + "\" cy=\"" + y + "\" r=\"5\" fill=\"" + color + "\"><title>" +
           escaped(words) + "</title></circle>\n";
  }
  for (std::size_t n = 0; n < programs.size(); ++n)
  {
    const double y = kTop + 16.0 + 20.0 * static_cast<double>(n);
    svg += "<circle cx=\"" + fixed(kWidth - kRight + 20, 1) + "\" cy=\"" + fixed(y - 4, 1) +
           "\" r=\"5\" fill=\"" + kColors[n % kColors.size()] + "\"/>\n";
    svg += text(kWidth - kRight + 32, y, programs[n], "");
  }
  svg += text(kWidth - kRight + 12, kTop + 24.0 + 20.0 * static_cast<double>(programs.size()),
              "ringed: the default", "fill=\"#666\"");
  return svg + "</svg>\n";
}

} // namespace petrous::cli
