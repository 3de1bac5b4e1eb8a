#pragma once

#include "GlTexture.h"

class vtkRenderer;

namespace petrous::rendering
{

/// A copy of the depth of opaque polygons in the bound frame buffer, at which rays end.
class OpaqueDepth
{
public:
  /// 0 if nothing opaque is drawn or the depth is not available.
  GLuint capture(vtkRenderer* renderer, int x, int y, int width, int height);
  void release();

private:
  GLuint m_texture = 0;
  GLuint m_framebuffer = 0;
  int m_width = 0;
  int m_height = 0;
  GLint m_format = 0;
};

} // namespace petrous::rendering
