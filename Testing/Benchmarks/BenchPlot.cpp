#include "BenchPlot.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <vector>

#include "Numbers.h"
#include "SvgParts.h"
#include "petrous/Core/NumberText.h"

namespace petrous::cli
{

namespace
{

using Points = std::vector<core::BenchmarkPoint>;

constexpr double kLeft = 90.0;
constexpr double kTop = 50.0;
constexpr double kDigit = 7.5; // px, approximate width of a digit in axis labels
constexpr std::size_t kPeerColor = 7;

std::string programOf(const core::BenchmarkPoint& point)
{
  return point.peer.empty() ? "petrous" : point.peer;
}

std::string hintOf(const core::BenchmarkPoint& point)
{
  std::string words = programOf(point) + ", " + point.scene;
  for (const auto& [name, value] : point.setting)
    words += ", " + name + " " + value;
  words += ": " + fixed(1e3 * point.seconds, 2) + " ms";
  if (std::isnan(point.error))
    return words;
  return words + ", " + core::generalText(point.error, 3) + " " + point.errorUnit;
}

template <class Get>
std::vector<double> valuesOf(const Points& points, const Get& get)
{
  std::vector<double> result;
  for (const auto& point : points)
    result.push_back(get(point));
  return result;
}

std::vector<double> secondsOf(const Points& points)
{
  return valuesOf(points, [](const auto& point) { return point.seconds; });
}

// A panel with time on the x axis and error on the y axis.
class Panel
{
public:
  Panel(const Points& all, double left, double top, double width, double height)
    : m_x(secondsOf(all))
    , m_y(valuesOf(all, [](const auto& point) { return point.error; }))
    , m_hasZero(std::any_of(all.begin(), all.end(), [](const auto& p) { return p.error <= 0.0; }))
    , m_left(left)
    , m_top(top)
    , m_width(width)
    , m_height(height)
  {
  }

  double px(double share) const { return m_left + share * m_width; }
  double py(double share) const { return m_top + (1.0 - share) * m_height; }
  double x(const core::BenchmarkPoint& point) const { return px(m_x.share(point.seconds)); }
  double y(const core::BenchmarkPoint& point) const { return py(m_y.share(point.error)); }

  std::string axes() const
  {
    std::string result;
    double free = -1.0; // where there is space for the next label
    for (const auto& tick : m_x.ticks())
    {
      const double half = 0.5 * kDigit * static_cast<double>(tick.label.size());
      result += svg::line(px(tick.share), py(0), px(tick.share), py(1));
      if (px(tick.share) - half < free)
        continue;
      result += svg::text(px(tick.share), py(0) + 18, tick.label, "text-anchor=\"middle\"");
      free = px(tick.share) + half + kDigit;
    }
    for (const auto& tick : m_y.ticks())
      result += svg::line(px(0), py(tick.share), px(1), py(tick.share)) +
                svg::text(px(0) - 8, py(tick.share) + 4,
                          tick.share <= 0.0 && m_hasZero ? "0" : tick.label, "text-anchor=\"end\"");
    return result;
  }

private:
  svg::LogAxis m_x;
  svg::LogAxis m_y;
  bool m_hasZero;
  double m_left, m_top, m_width, m_height;
};

std::string upwards(double x, double y, const std::string& words)
{
  return "<g transform=\"translate(" + fixed(x, 1) + "," + fixed(y, 1) + ") rotate(-90)\">" +
         svg::text(0, 0, words, "text-anchor=\"middle\"") + "</g>\n";
}

Points chosen(const core::BenchmarkReport& report, const std::string& series)
{
  Points points;
  for (const auto& point : report.points)
    if (point.series == series && !std::isnan(point.error))
      points.push_back(point);
  return points;
}

// Value of the varied parameter.
const std::string& valueOf(const core::BenchmarkPoint& point)
{
  return point.setting.at(point.series.substr(0, point.series.find(',')));
}

// Joins the varied values of each program separately.
std::string joined(const Points& points, const Panel& panel, const std::string& color)
{
  const auto colorOf = [&color](const core::BenchmarkPoint& point)
  { return point.peer.empty() ? color : svg::color(kPeerColor); };
  std::string result;
  std::map<std::string, const core::BenchmarkPoint*> last;
  for (const auto& point : points)
  {
    const core::BenchmarkPoint*& before = last[point.peer];
    if (before)
      result += svg::line(panel.x(*before), panel.y(*before), panel.x(point), panel.y(point),
                          colorOf(point));
    before = &point;
  }
  svg::Labels labels(panel.px(0), panel.py(1), panel.px(1), panel.py(0));
  for (const auto& point : points)
    labels.keepClear(panel.x(point), panel.y(point), point.isDefault ? 9.0 : 5.0);
  for (const bool ringed : {true, false}) // the default's label is placed first
    for (const auto& point : points)
      if (point.isDefault == ringed)
        result += labels.beside(panel.x(point), panel.y(point), valueOf(point));
  for (const auto& point : points)
    result +=
        svg::dot(panel.x(point), panel.y(point), colorOf(point), hintOf(point), point.isDefault);
  return result;
}

// Times of other programs compared with our default's.
std::string strip(const Points& points, double top, double width)
{
  const svg::LogAxis axis(secondsOf(points));
  const double bottom = top + 20.0 * static_cast<double>(points.size());
  const auto px = [&](double share) { return kLeft + share * width; };
  std::string result;
  for (const auto& tick : axis.ticks())
    result += svg::line(px(tick.share), top, px(tick.share), bottom) +
              svg::text(px(tick.share), bottom + 18, tick.label, "text-anchor=\"middle\"");
  double row = top + 10.0;
  for (const auto& point : points)
  {
    const double x = px(axis.share(point.seconds));
    const bool right = axis.share(point.seconds) > 0.5;
    const std::string words = programOf(point) + ": " + fixed(1e3 * point.seconds, 0) + " ms";
    result += svg::dot(x, row, point.peer.empty() ? svg::color(0) : svg::color(kPeerColor), words) +
              svg::text(x + (right ? -10 : 10), row + 4, words,
                        right ? "text-anchor=\"end\" font-size=\"11\"" : "font-size=\"11\"");
    row += 20.0;
  }
  return result;
}

} // namespace

std::string plotSvg(const core::BenchmarkReport& report)
{
  constexpr double width = 760.0;
  constexpr double height = 460.0;
  constexpr double right = 230.0;
  const Panel panel(report.points, kLeft, kTop, width - kLeft - right, height - kTop - 60.0);
  const std::string unit = report.points.empty() ? "" : report.points.front().errorUnit;
  std::string result = svg::start(width, height, report.title) + panel.axes() +
                       svg::text(panel.px(0.5), height - 16, "time, s", "text-anchor=\"middle\"") +
                       upwards(22, panel.py(0.5), "error, " + unit);
  std::vector<std::string> programs;
  for (const auto& point : report.points)
    if (std::find(programs.begin(), programs.end(), programOf(point)) == programs.end())
      programs.push_back(programOf(point));
  for (const auto& point : report.points)
  {
    const auto at = std::find(programs.begin(), programs.end(), programOf(point));
    result += svg::dot(panel.x(point), panel.y(point),
                       svg::color(static_cast<std::size_t>(at - programs.begin())), hintOf(point),
                       point.isDefault);
  }
  double row = kTop + 16.0;
  for (std::size_t n = 0; n < programs.size(); ++n, row += 20.0)
    result += svg::dot(width - right + 20, row - 4, svg::color(n), programs[n]) +
              svg::text(width - right + 32, row, programs[n]);
  return result + svg::text(width - right + 12, row + 8, "ringed: the default", "fill=\"#666\"") +
         "</svg>\n";
}

std::string seriesSvg(const core::BenchmarkReport& report)
{
  constexpr std::size_t columns = 3;
  constexpr double wide = 290.0;
  constexpr double high = 210.0;
  constexpr double stepX = wide + 60.0;
  constexpr double stepY = high + 70.0;
  std::vector<std::string> names;
  Points all, others;
  for (const auto& point : report.points)
    if (point.series.empty())
      others.push_back(point);
    else if (!std::isnan(point.error))
    {
      all.push_back(point);
      if (std::find(names.begin(), names.end(), point.series) == names.end())
        names.push_back(point.series);
    }
  const std::size_t rows = (names.size() + columns - 1) / columns;
  const double stripTop = kTop + 30.0 + stepY * static_cast<double>(rows);
  const double height = stripTop + 20.0 * static_cast<double>(others.size()) + 60.0;
  const double width = kLeft + stepX * columns;
  std::string result = svg::start(width, height, report.title);
  for (std::size_t n = 0; n < names.size(); ++n)
  {
    const Panel panel(all, kLeft + stepX * static_cast<double>(n % columns),
                      kTop + 24.0 + stepY * static_cast<double>(n / columns), wide, high);
    result += panel.axes() + svg::text(panel.px(0.5), panel.py(1) - 8, names[n],
                                       "text-anchor=\"middle\" font-weight=\"bold\"");
    result += joined(chosen(report, names[n]), panel, svg::color(n));
  }
  const std::string unit = all.empty() ? "" : all.front().errorUnit;
  result += upwards(22, kTop + 0.5 * stepY * static_cast<double>(rows), "error, " + unit);
  if (!others.empty())
    result += svg::text(kLeft, stripTop - 8,
                        "The same scene by other programs, which draw other "
                        "optics: time alone") +
              strip(others, stripTop, stepX * columns - 60.0);
  const auto peer =
      std::find_if(all.begin(), all.end(), [](const auto& point) { return !point.peer.empty(); });
  if (peer != all.end())
    result += svg::dot(kLeft, height - 14, svg::color(kPeerColor), peer->peer) +
              svg::text(kLeft + 12, height - 10, peer->peer);
  return result +
         svg::text(width - 60, height - 10, "time, s; ringed: the default",
                   "text-anchor=\"end\" fill=\"#666\"") +
         "</svg>\n";
}

} // namespace petrous::cli
