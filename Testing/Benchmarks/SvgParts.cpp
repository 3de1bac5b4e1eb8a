#include "SvgParts.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "Numbers.h"
#include "petrous/Core/NumberText.h"

namespace petrous::cli::svg
{

namespace
{

constexpr std::array<const char*, 8> kColors{"#1b6ca8", "#c8553d", "#588157", "#7b4b94",
                                             "#b08900", "#2a9d8f", "#a23b72", "#555555"};
constexpr std::array<double, 3> kMarks{1.0, 2.0, 5.0};

std::string escaped(const std::string& text)
{
  std::string result;
  for (const char c : text)
    result += c == '<' ? "&lt;" : c == '>' ? "&gt;" : c == '&' ? "&amp;" : std::string(1, c);
  return result;
}

} // namespace

LogAxis::LogAxis(const std::vector<double>& values)
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
  // Margin, so that no point is on the frame.
  least *= 0.93;
  most *= 1.07;
  const int first = static_cast<int>(std::floor(std::log10(least)));
  const int last = static_cast<int>(std::ceil(std::log10(most)));
  for (int e = first; e <= last; ++e)
    for (const double mark : kMarks)
      m_marks.push_back(mark * std::pow(10.0, e));
  while (m_marks.size() > 2 && m_marks[1] <= least)
    m_marks.erase(m_marks.begin());
  while (m_marks.size() > 2 && m_marks[m_marks.size() - 2] >= most)
    m_marks.pop_back();
}

double LogAxis::share(double value) const
{
  const double low = std::log10(m_marks.front());
  const double high = std::log10(m_marks.back());
  return value > 0.0 ? std::clamp((std::log10(value) - low) / (high - low), 0.0, 1.0) : 0.0;
}

std::vector<LogAxis::Tick> LogAxis::ticks() const
{
  // Over many decades there is space for powers of ten only.
  const bool wide = m_marks.size() > 13;
  std::vector<Tick> ticks;
  for (const double mark : m_marks)
  {
    const double exponent = std::log10(mark);
    if (wide && std::abs(exponent - std::round(exponent)) > 0.01)
      continue;
    ticks.push_back({mark, share(mark), core::generalText(mark, 3)});
  }
  return ticks;
}

std::string color(std::size_t n)
{
  return kColors[n % kColors.size()];
}

std::string text(double x, double y, const std::string& words, const std::string& style)
{
  return "<text x=\"" + fixed(x, 1) + "\" y=\"" + fixed(y, 1) + "\" " + style + ">" +
         escaped(words) + "</text>\n";
}

std::string line(double x0, double y0, double x1, double y1, const std::string& stroke)
{
  return "<line x1=\"" + fixed(x0, 1) + "\" y1=\"" + fixed(y0, 1) + "\" x2=\"" + fixed(x1, 1) +
         "\" y2=\"" + fixed(y1, 1) + "\" stroke=\"" + stroke + "\"/>\n";
}

std::string dot(double x, double y, const std::string& fill, const std::string& hint, bool ringed)
{
  const std::string at = "<circle cx=\"" + fixed(x, 1) + "\" cy=\"" + fixed(y, 1) + "\" r=\"";
  std::string result;
  if (ringed)
    result = at + "9\" fill=\"none\" stroke=\"" + fill + "\"/>\n";
  return result + at + "5\" fill=\"" + fill + "\"><title>" + escaped(hint) + "</title></circle>\n";
}

Labels::Labels(double left, double top, double right, double bottom)
  : m_within{left, top, right, bottom}
{
}

void Labels::keepClear(double x, double y, double radius)
{
  m_taken.push_back({x - radius, y - radius, x + radius, y + radius});
}

bool Labels::free(const Box& box) const
{
  return box.left >= m_within.left && box.right <= m_within.right && box.top >= m_within.top &&
         box.bottom <= m_within.bottom &&
         std::none_of(m_taken.begin(), m_taken.end(),
                      [&box](const Box& other)
                      {
                        return box.left < other.right && other.left < box.right &&
                               box.top < other.bottom && other.top < box.bottom;
                      });
}

std::string Labels::beside(double x, double y, const std::string& words)
{
  constexpr double digit = 6.5; // width in the fonts of common viewers
  constexpr double half = 5.5;  // half height
  constexpr double ring = 14.0;
  constexpr int rings = 5;
  // Upper right first: curves of error over time fall.
  constexpr std::array<std::array<double, 2>, 8> ways{
      {{1, -1}, {-1, 1}, {-1, -1}, {1, 1}, {1, 0}, {-1, 0}, {0, -1}, {0, 1}}};
  const double wide = 0.5 * digit * static_cast<double>(words.size());
  for (int n = 0; n < rings; ++n)
    for (const auto& way : ways)
    {
      const double centerX = x + way[0] * (8.0 + wide + ring * n);
      const double centerY = y + way[1] * (11.0 + ring * n);
      const Box box{centerX - wide, centerY - half, centerX + wide, centerY + half};
      if (!free(box))
        continue;
      m_taken.push_back(box);
      const std::string words10 =
          text(centerX, centerY + 3.5, words, "text-anchor=\"middle\" font-size=\"10\"");
      return n == 0
                 ? words10
                 : line(x, y, centerX - way[0] * wide, centerY - way[1] * half, "#aaa") + words10;
    }
  return {};
}

std::string start(double width, double height, const std::string& title)
{
  return "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"" + fixed(width, 0) + "\" height=\"" +
         fixed(height, 0) +
         "\" font-family=\"sans-serif\" font-size=\"12\">\n"
         "<rect width=\"100%\" height=\"100%\" fill=\"white\"/>\n" +
         text(24, 28, title, "font-size=\"15\"");
}

} // namespace petrous::cli::svg
