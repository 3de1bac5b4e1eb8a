#pragma once

#include <array>
#include <optional>
#include <string>

#include "petrous/Rendering/SceneContents.h"

namespace petrous::presenters
{

struct NamedBackground
{
  const char* name; ///< as the command and the window's settings have it
  rendering::BackgroundColor color;
};

/// From dark to light; the second one is the usual one.
inline constexpr std::array<NamedBackground, 4> kBackgrounds{
    {{"black", {0.0, 0.0, 0.0}},
     {"dark-grey", rendering::kDefaultBackground},
     {"light-grey", {0.82, 0.84, 0.86}},
     {"white", {1.0, 1.0, 1.0}}}};

/// Red, green and blue of "#rrggbb", 0 to 1; nullopt: it is none.
std::optional<std::array<double, 3>> parseHexColor(const std::string& text);

/// The colour of a name of kBackgrounds, or of "#rrggbb"; nullopt: of neither.
std::optional<rendering::BackgroundColor> parseBackground(const std::string& text);

/// The name, else "#rrggbb".
std::string backgroundText(const rendering::BackgroundColor& color);

/// What letters stand on: white ones have more contrast on a dark one, black ones on a light one.
enum class Backdrop
{
  Dark,
  Light
};

/// By the relative luminance of sRGB and the contrast ratio of WCAG 2.1.
Backdrop backdropOf(const rendering::BackgroundColor& color);

} // namespace petrous::presenters
