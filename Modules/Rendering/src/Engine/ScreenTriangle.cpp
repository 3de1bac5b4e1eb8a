#include "ScreenTriangle.h"

#include <vtkOpenGLRenderWindow.h>
#include <vtkOpenGLShaderCache.h>

namespace petrous::rendering
{

void ScreenTriangle::draw()
{
  if (!m_vertexArray)
    glGenVertexArrays(1, &m_vertexArray);
  glBindVertexArray(m_vertexArray);
  glDrawArrays(GL_TRIANGLES, 0, 3);
  glBindVertexArray(0);
}

void ScreenTriangle::release()
{
  if (m_vertexArray)
    glDeleteVertexArrays(1, &m_vertexArray);
  m_vertexArray = 0;
}

PlainDrawing::PlainDrawing(vtkOpenGLRenderWindow* window)
  : m_state(window->GetState())
  , m_depthTest(m_state, GL_DEPTH_TEST)
  , m_blend(m_state, GL_BLEND)
  , m_cull(m_state, GL_CULL_FACE)
  , m_scissor(m_state, GL_SCISSOR_TEST)
  , m_viewport(m_state)
{
  window->GetShaderCache()->ReleaseCurrentShader();
  for (const unsigned test : {GL_DEPTH_TEST, GL_BLEND, GL_CULL_FACE, GL_SCISSOR_TEST})
    m_state->vtkglDisable(test);
}

PlainDrawing::~PlainDrawing()
{
  glUseProgram(0);
  glActiveTexture(GL_TEXTURE0);
  m_state->ResetGLActiveTexture();
}

} // namespace petrous::rendering
