#pragma once

#include <string>

#include "petrous/Rendering/Picture.h"

namespace petrous::rendering
{

/// Draws the legend of the thickness colours into the picture's upper left corner: the scale from 0
/// to `farthest` mm and the structure's name, UTF-8. It takes at most half of the picture's edge.
/// Pictures less than 120 pixels wide are left unchanged.
void drawThicknessLegend(Picture& picture, const std::string& structure, double farthest);

} // namespace petrous::rendering
