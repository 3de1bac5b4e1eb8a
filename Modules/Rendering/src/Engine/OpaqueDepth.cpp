#include "OpaqueDepth.h"

#include <vtkProp.h>
#include <vtkPropCollection.h>
#include <vtkRenderer.h>

namespace petrous::rendering
{

namespace
{

bool hasOpaqueProps(vtkRenderer* renderer)
{
  vtkPropCollection* props = renderer->GetViewProps();
  vtkCollectionSimpleIterator it;
  props->InitTraversal(it);
  while (vtkProp* prop = props->GetNextProp(it))
    if (prop->GetVisibility() && prop->HasOpaqueGeometry())
      return true;
  return false;
}

// A depth blit requires identical source and destination formats.
GLint depthFormat()
{
  GLint bound = 0;
  glGetIntegerv(GL_DRAW_FRAMEBUFFER_BINDING, &bound);
  const auto ask = [bound](GLenum attachment, GLenum what)
  {
    GLint answer = 0;
    glGetFramebufferAttachmentParameteriv(
        GL_DRAW_FRAMEBUFFER,
        bound ? attachment : (attachment == GL_STENCIL_ATTACHMENT ? GL_STENCIL : GL_DEPTH), what,
        &answer);
    return answer;
  };
  if (ask(GL_DEPTH_ATTACHMENT, GL_FRAMEBUFFER_ATTACHMENT_OBJECT_TYPE) == GL_NONE)
    return 0;
  const GLint bits = ask(GL_DEPTH_ATTACHMENT, GL_FRAMEBUFFER_ATTACHMENT_DEPTH_SIZE);
  const bool stencil =
      ask(GL_STENCIL_ATTACHMENT, GL_FRAMEBUFFER_ATTACHMENT_OBJECT_TYPE) != GL_NONE &&
      ask(GL_STENCIL_ATTACHMENT, GL_FRAMEBUFFER_ATTACHMENT_STENCIL_SIZE) > 0;
  if (ask(GL_DEPTH_ATTACHMENT, GL_FRAMEBUFFER_ATTACHMENT_COMPONENT_TYPE) == GL_FLOAT)
    return stencil ? GL_DEPTH32F_STENCIL8 : GL_DEPTH_COMPONENT32F;
  if (stencil)
    return GL_DEPTH24_STENCIL8;
  return bits == 16 ? GL_DEPTH_COMPONENT16
                    : (bits == 32 ? GL_DEPTH_COMPONENT32 : GL_DEPTH_COMPONENT24);
}

} // namespace

GLuint OpaqueDepth::capture(vtkRenderer* renderer, int x, int y, int width, int height)
{
  if (!hasOpaqueProps(renderer))
    return 0;
  while (glGetError() != GL_NO_ERROR)
  {
  }
  const GLint format = depthFormat();
  if (format == 0 || glGetError() != GL_NO_ERROR)
    return 0;
  GLint draw = 0;
  GLint read = 0;
  glGetIntegerv(GL_DRAW_FRAMEBUFFER_BINDING, &draw);
  glGetIntegerv(GL_READ_FRAMEBUFFER_BINDING, &read);
  if (width != m_width || height != m_height || format != m_format)
  {
    release();
    m_width = width;
    m_height = height;
    m_format = format;
    const bool stencil = format == GL_DEPTH24_STENCIL8 || format == GL_DEPTH32F_STENCIL8;
    glGenTextures(1, &m_texture);
    glBindTexture(GL_TEXTURE_2D, m_texture);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
    const GLenum type = format == GL_DEPTH24_STENCIL8    ? GL_UNSIGNED_INT_24_8
                        : format == GL_DEPTH32F_STENCIL8 ? GL_FLOAT_32_UNSIGNED_INT_24_8_REV
                                                         : GL_FLOAT;
    glTexImage2D(GL_TEXTURE_2D, 0, format, width, height, 0,
                 stencil ? GL_DEPTH_STENCIL : GL_DEPTH_COMPONENT, type, nullptr);
    glBindTexture(GL_TEXTURE_2D, 0);
    glGenFramebuffers(1, &m_framebuffer);
    glBindFramebuffer(GL_DRAW_FRAMEBUFFER, m_framebuffer);
    glFramebufferTexture2D(GL_DRAW_FRAMEBUFFER,
                           stencil ? GL_DEPTH_STENCIL_ATTACHMENT : GL_DEPTH_ATTACHMENT,
                           GL_TEXTURE_2D, m_texture, 0);
    glDrawBuffer(GL_NONE);
  }
  glBindFramebuffer(GL_READ_FRAMEBUFFER, static_cast<GLuint>(draw));
  glBindFramebuffer(GL_DRAW_FRAMEBUFFER, m_framebuffer);
  glBlitFramebuffer(x, y, x + width, y + height, 0, 0, width, height, GL_DEPTH_BUFFER_BIT,
                    GL_NEAREST);
  glBindFramebuffer(GL_DRAW_FRAMEBUFFER, static_cast<GLuint>(draw));
  glBindFramebuffer(GL_READ_FRAMEBUFFER, static_cast<GLuint>(read));
  return glGetError() == GL_NO_ERROR ? m_texture : 0;
}

void OpaqueDepth::release()
{
  if (m_texture)
    glDeleteTextures(1, &m_texture);
  if (m_framebuffer)
    glDeleteFramebuffers(1, &m_framebuffer);
  m_texture = m_framebuffer = 0;
  m_width = m_height = 0;
}

} // namespace petrous::rendering
