#pragma once

#include "petrous/Rendering/Picture.h"

class vtkRenderWindow;
class vtkUnsignedCharArray;

namespace petrous::rendering
{

/// What a window shows; without pixels where it gives none back.
Picture readWindow(vtkRenderWindow* window);

/// From a window's pixels, RGB with rows from the bottom as OpenGL has them; without pixels where
/// their number is another.
Picture fromBottomRow(int width, int height, vtkUnsignedCharArray* rgb);

} // namespace petrous::rendering
