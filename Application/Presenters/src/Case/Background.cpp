#include "petrous/Presenters/Background.h"

#include <cmath>

namespace petrous::presenters
{

namespace
{

// Relative luminance of sRGB, IEC 61966-2-1.
double luminanceOf(const rendering::BackgroundColor& color)
{
  const auto linear = [](double value)
  { return value <= 0.04045 ? value / 12.92 : std::pow((value + 0.055) / 1.055, 2.4); };
  return 0.2126 * linear(color[0]) + 0.7152 * linear(color[1]) + 0.0722 * linear(color[2]);
}

} // namespace

std::optional<std::array<double, 3>> parseHexColor(const std::string& text)
{
  if (text.size() != 7 || text.front() != '#' ||
      text.find_first_not_of("0123456789abcdefABCDEF", 1) != text.npos)
    return std::nullopt;
  std::array<double, 3> color{};
  for (std::size_t c = 0; c < 3; ++c)
    color[c] = std::stoi(text.substr(1 + 2 * c, 2), nullptr, 16) / 255.0;
  return color;
}

std::optional<rendering::BackgroundColor> parseBackground(const std::string& text)
{
  for (const NamedBackground& one : kBackgrounds)
    if (text == one.name)
      return one.color;
  return parseHexColor(text);
}

std::string backgroundText(const rendering::BackgroundColor& color)
{
  constexpr const char* kDigits = "0123456789abcdef";
  for (const NamedBackground& one : kBackgrounds)
    if (color == one.color)
      return one.name;
  std::string text = "#";
  for (const double value : color)
  {
    const auto byte = static_cast<unsigned>(std::lround(255.0 * value));
    text += kDigits[byte / 16 % 16];
    text += kDigits[byte % 16];
  }
  return text;
}

Backdrop backdropOf(const rendering::BackgroundColor& color)
{
  constexpr double kFlare = 0.05; // of both luminances of a contrast ratio
  const double ground = luminanceOf(color) + kFlare;
  const double onBlack = ground / kFlare;
  const double onWhite = (1.0 + kFlare) / ground;
  return onBlack > onWhite ? Backdrop::Light : Backdrop::Dark;
}

} // namespace petrous::presenters
