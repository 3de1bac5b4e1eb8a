#pragma once

#include "petrous/Rendering/Picture.h"

class vtkRenderWindow;
class vtkUnsignedCharArray;

namespace petrous::rendering
{

/// Reads back a window's pixels; empty if the window returns none.
Picture readWindow(vtkRenderWindow* window);

/// From a window's pixels, RGB, bottom row first as in OpenGL; empty if their number does not
/// match.
Picture fromBottomRow(int width, int height, vtkUnsignedCharArray* rgb);

} // namespace petrous::rendering
