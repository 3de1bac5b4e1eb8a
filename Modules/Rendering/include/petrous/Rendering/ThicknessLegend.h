#pragma once

#include <string>

#include "petrous/Rendering/Picture.h"

namespace petrous::rendering
{

/// Draws into the upper left corner of a picture what the colours of bone's thickness mean: the
/// scale from 0 to `farthest` mm and the structure's name, UTF-8. It takes at most half of the
/// picture's edge; one that is less than 120 pixels wide has no room for it and stays as it is.
void drawThicknessLegend(Picture& picture, const std::string& structure, double farthest);

} // namespace petrous::rendering
