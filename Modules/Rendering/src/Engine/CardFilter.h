#pragma once

#include "GlProgram.h"

namespace petrous::rendering
{

/// Bits to which the current context's card rounds the weights of its linear filter of volumes, as
/// measured: 8 on most cards, RenderQuality::kExactFilterBits where no rounding is seen. Leaves the
/// frame buffer unbound and the viewport changed. Throws RenderingError NoOpenGL.
int measureFilterBits(ScreenTriangle& triangle);

} // namespace petrous::rendering
