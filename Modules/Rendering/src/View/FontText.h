#pragma once

#include <string>

class vtkImageData;
class vtkTextProperty;

namespace petrous::rendering
{

/// Draws a line of text (UTF-8) with VTK's own fonts at 72 dpi, so that a point is a pixel. What
/// the font has no glyph for, which VTK leaves out without a word, is drawn as '?'; so is a byte
/// that is not UTF-8. Blanks of any kind and line ends are spaces.
///
/// size: of the text, pixels; the image may be larger, and its extent need not start at 0.
/// Returns false, and leaves image and size as they are, if there is nothing to draw.
bool drawText(vtkTextProperty* style, const std::string& text, vtkImageData* image, int size[2]);

} // namespace petrous::rendering
