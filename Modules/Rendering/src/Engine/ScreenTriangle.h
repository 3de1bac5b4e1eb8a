#pragma once

#include <vtkOpenGLState.h>
#include <vtk_glew.h>

class vtkOpenGLRenderWindow;

namespace petrous::rendering
{

/// The triangle over the whole viewport that RayCast.vert.glsl makes without buffers. Of the
/// context in which it was first drawn; released explicitly, as GlTexture.
class ScreenTriangle
{
public:
  void draw();
  void release();

private:
  GLuint m_vertexArray = 0;
};

/// While it lives what is drawn reaches the frame buffer as it is: no depth test, blending, culling
/// or scissor, and no shader of VTK's in use. VTK has its state again when it ends, the viewport
/// included; texture units other than the first are left as they are.
class PlainDrawing
{
public:
  explicit PlainDrawing(vtkOpenGLRenderWindow* window);
  ~PlainDrawing();
  PlainDrawing(const PlainDrawing&) = delete;
  PlainDrawing& operator=(const PlainDrawing&) = delete;

private:
  vtkOpenGLState* m_state;
  vtkOpenGLState::ScopedglEnableDisable m_depthTest, m_blend, m_cull, m_scissor;
  vtkOpenGLState::ScopedglViewport m_viewport;
};

} // namespace petrous::rendering
