#pragma once

#include <array>

#include "GlTexture.h"
#include "petrous/Rendering/Picture.h"

namespace petrous::rendering
{

/// What rays are cast into: premultiplied colour, distance to the first surface, and counts where
/// they are asked for. Of the context in which it was prepared; released explicitly.
class RayTarget
{
public:
  /// Binds it for drawing at this size. Throws RenderingError NoOpenGL.
  void prepare(int width, int height, bool count);
  void release();

  const GlTexture& color() const noexcept { return m_color; }

  /// Distance to the first surface, mm along each pixel's ray, rows from the top; NaN: none.
  DepthImage readDepth() const;
  /// At one pixel of a picture of width x height that shows it, rows from the top.
  float readDepth(double column, double row, int width, int height) const;

  /// Fetches and samples, means over the pixels. While it is bound.
  std::array<double, 2> meanCounts() const;

private:
  GlTexture m_color;
  GlTexture m_depth;
  GlTexture m_count;
  GLuint m_framebuffer = 0;
  bool m_counting = false;
};

} // namespace petrous::rendering
