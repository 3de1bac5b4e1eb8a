#pragma once

#include <array>
#include <string>

#include "petrous/Rendering/Picture.h"

namespace petrous::rendering
{

/// Position of a line of text.
struct TextPlace
{
  double column = 0.0; ///< pixels
  double row = 0.0;
  double across = 0.0; ///< point of the text box placed there: 0 left edge, 1 right edge
  double down = 0.0;   ///< 0 top edge, 1 bottom edge
};

/// Draws a line of text (UTF-8) with an outline, dark unless another is given, so that it is
/// legible on bone and on air alike. Text is clipped at the picture's border. size: of the font,
/// points at 72 dpi.
void writeText(Picture& picture, const std::string& text, const TextPlace& place, int size,
               const std::array<std::uint8_t, 3>& color,
               const std::array<std::uint8_t, 3>& outline = {0, 0, 0});

} // namespace petrous::rendering
