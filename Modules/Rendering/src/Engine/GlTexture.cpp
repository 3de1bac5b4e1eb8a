#include "GlTexture.h"

#include <algorithm>
#include <string>
#include <vector>

#include "petrous/Rendering/RenderingError.h"

namespace petrous::rendering
{

namespace
{

// Uploads from client memory independently of the application's pixel-store state, and restores
// OpenGL's defaults.
class PlainUpload
{
public:
  PlainUpload()
  {
    glGetIntegerv(GL_UNPACK_ALIGNMENT, &m_alignment);
    glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
    glBindBuffer(GL_PIXEL_UNPACK_BUFFER, 0);
  }
  ~PlainUpload() { glPixelStorei(GL_UNPACK_ALIGNMENT, m_alignment); }
  PlainUpload(const PlainUpload&) = delete;
  PlainUpload& operator=(const PlainUpload&) = delete;

private:
  GLint m_alignment = 4;
};

std::size_t count(const core::Index3& dims)
{
  return static_cast<std::size_t>(dims[0]) * static_cast<std::size_t>(dims[1]) *
         static_cast<std::size_t>(dims[2]);
}

[[noreturn]] void noRoom(const core::Index3& dims, GLenum error)
{
  throw RenderingError(RenderingError::Reason::NoOpenGL,
                       "the graphics driver has no room for a texture of " +
                           std::to_string(dims[0]) + " x " + std::to_string(dims[1]) + " x " +
                           std::to_string(dims[2]) + " (OpenGL error " + std::to_string(error) +
                           ")");
}

} // namespace

bool GlTexture::fits(const TexelFormat& format, const core::Index3& dims)
{
  glTexImage3D(GL_PROXY_TEXTURE_3D, 0, format.internal, dims[0], dims[1], dims[2], 0, format.layout,
               format.type, nullptr);
  GLint width = 0;
  glGetTexLevelParameteriv(GL_PROXY_TEXTURE_3D, 0, GL_TEXTURE_WIDTH, &width);
  while (glGetError() != GL_NO_ERROR)
    width = 0;
  return width == dims[0];
}

void GlTexture::create(const TexelFormat& format, const core::Index3& dims, const void* data,
                       GLint filter)
{
  make(GL_TEXTURE_3D, format, dims, data, filter);
}

void GlTexture::create(const TexelFormat& format, int width, int height, const void* data,
                       GLint filter)
{
  make(GL_TEXTURE_2D, format, {width, height, 1}, data, filter);
}

void GlTexture::createPyramid(const TexelFormat& format, const core::Index3& dims, int levels)
{
  make(GL_TEXTURE_3D, format, dims, nullptr, GL_LINEAR);
  glBindTexture(m_target, m_name);
  glTexParameteri(m_target, GL_TEXTURE_MIN_FILTER, GL_LINEAR_MIPMAP_NEAREST);
  glTexParameteri(m_target, GL_TEXTURE_MAX_LEVEL, levels - 1);
  const PlainUpload plain;
  core::Index3 size = dims;
  for (int level = 1; level < levels; ++level)
  {
    for (int& edge : size)
      edge = std::max(edge / 2, 1);
    glTexImage3D(m_target, level, format.internal, size[0], size[1], size[2], 0, format.layout,
                 format.type, nullptr);
    m_bytes += count(size) * format.bytes;
  }
  const GLenum error = glGetError();
  glBindTexture(m_target, 0);
  if (error != GL_NO_ERROR)
  {
    release();
    noRoom(dims, error);
  }
}

void GlTexture::make(GLenum target, const TexelFormat& format, const core::Index3& dims,
                     const void* data, GLint filter)
{
  release();
  m_target = target;
  m_format = format;
  m_dims = dims;
  m_bytes = count(dims) * format.bytes;
  while (glGetError() != GL_NO_ERROR)
  {
  } // clear errors of earlier calls
  const PlainUpload plain;
  glGenTextures(1, &m_name);
  glBindTexture(target, m_name);
  glTexParameteri(target, GL_TEXTURE_MIN_FILTER, filter);
  glTexParameteri(target, GL_TEXTURE_MAG_FILTER, filter);
  glTexParameteri(target, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
  glTexParameteri(target, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
  glTexParameteri(target, GL_TEXTURE_WRAP_R, GL_CLAMP_TO_EDGE);
  glTexParameteri(target, GL_TEXTURE_MAX_LEVEL, 0);
  if (target == GL_TEXTURE_3D)
    glTexImage3D(target, 0, format.internal, dims[0], dims[1], dims[2], 0, format.layout,
                 format.type, data);
  else
    glTexImage2D(target, 0, format.internal, dims[0], dims[1], 0, format.layout, format.type, data);
  const GLenum error = glGetError();
  glBindTexture(target, 0);
  if (error != GL_NO_ERROR)
  {
    release();
    noRoom(dims, error);
  }
}

void GlTexture::update(const core::IndexBox& box, const void* data, int level)
{
  const core::Index3 size = box.size();
  const PlainUpload plain;
  glBindTexture(m_target, m_name);
  glTexSubImage3D(m_target, level, box.lower[0], box.lower[1], box.lower[2], size[0], size[1],
                  size[2], m_format.layout, m_format.type, data);
  glBindTexture(m_target, 0);
}

void GlTexture::fill(const void* texel)
{
  if (GLEW_ARB_clear_texture)
  {
    glClearTexImage(m_name, 0, m_format.layout, m_format.type, texel);
    return;
  }
  const std::size_t slice =
      static_cast<std::size_t>(m_dims[0]) * static_cast<std::size_t>(m_dims[1]);
  std::vector<unsigned char> plane(slice * m_format.bytes);
  const auto* bytes = static_cast<const unsigned char*>(texel);
  for (std::size_t i = 0; i < plane.size(); ++i)
    plane[i] = bytes[i % m_format.bytes];
  for (int k = 0; k < m_dims[2]; ++k)
    update({{0, 0, k}, {m_dims[0], m_dims[1], k + 1}}, plane.data());
}

void GlTexture::bind(int unit) const
{
  glActiveTexture(GL_TEXTURE0 + static_cast<GLenum>(unit));
  glBindTexture(m_target, m_name);
}

void GlTexture::release()
{
  if (m_name)
    glDeleteTextures(1, &m_name);
  m_name = 0;
  m_bytes = 0;
  m_dims = {0, 0, 0};
}

} // namespace petrous::rendering
