#pragma once

#include <array>
#include <string>

#include "petrous/Rendering/Picture.h"

namespace petrous::rendering
{

/// Where a line of text goes.
struct TextPlace
{
  double column = 0.0; ///< pixels
  double row = 0.0;
  double across = 0.0; ///< which part of the text's box lies there: 0 its left edge, 1 its right
  double down = 0.0;   ///< 0 its top edge, 1 its bottom
};

/// Writes a line (UTF-8) into a picture, with a dark border, so that it can be read on bone and on
/// air alike. What does not fit is left out. size: of the font, points at 72 dpi.
void writeText(Picture& picture, const std::string& text, const TextPlace& place, int size,
               const std::array<std::uint8_t, 3>& color);

} // namespace petrous::rendering
