#pragma once

#include "GlTexture.h"

class vtkRenderer;

namespace petrous::rendering
{

/// A copy of the depth that opaque polygons left in the bound frame buffer, for rays to end at.
class OpaqueDepth
{
public:
  /// 0 where nothing opaque is drawn, or where the depth cannot be had.
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
