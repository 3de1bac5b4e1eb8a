#pragma once

#include <array>

#include "GlTexture.h"
#include "petrous/Rendering/Picture.h"

namespace petrous::rendering
{

/// Render target of the ray caster: premultiplied colour, distance to the first surface, and counts
/// if requested. Belongs to the context in which it was prepared; must be released explicitly.
class RayTarget
{
public:
  /// Binds it for drawing at the given size. Throws RenderingError NoOpenGL.
  void prepare(int width, int height, bool count);
  void release();

  const GlTexture& color() const noexcept { return m_color; }

  /// Distance to the first surface, mm along each pixel's ray, top row first; NaN: none.
  DepthImage readDepth() const;
  /// Depth at one pixel when shown as a picture of width x height, rows from the top.
  float readDepth(double column, double row, int width, int height) const;

  /// Fetches and samples, averaged over the pixels. The target must be bound.
  std::array<double, 2> meanCounts() const;

private:
  GlTexture m_color;
  GlTexture m_depth;
  GlTexture m_count;
  GLuint m_framebuffer = 0;
  bool m_counting = false;
};

} // namespace petrous::rendering
