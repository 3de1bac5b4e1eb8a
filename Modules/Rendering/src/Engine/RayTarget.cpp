#include "RayTarget.h"

#include <algorithm>
#include <limits>
#include <string>
#include <vector>

#include "petrous/Rendering/RenderingError.h"

namespace petrous::rendering
{

void RayTarget::prepare(int width, int height, bool count)
{
  if (m_framebuffer && m_color.dims()[0] == width && m_color.dims()[1] == height &&
      m_counting == count)
  {
    glBindFramebuffer(GL_FRAMEBUFFER, m_framebuffer);
    return;
  }
  m_color.create(texel::kColor, width, height, nullptr, GL_LINEAR);
  m_depth.create(texel::kFloat, width, height, nullptr, GL_NEAREST);
  if (count)
    m_count.create(texel::kFloat2, width, height, nullptr, GL_NEAREST);
  else
    m_count.release();
  m_counting = count;
  if (!m_framebuffer)
    glGenFramebuffers(1, &m_framebuffer);
  glBindFramebuffer(GL_FRAMEBUFFER, m_framebuffer);
  glFramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, m_color.name(), 0);
  glFramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT1, GL_TEXTURE_2D, m_depth.name(), 0);
  glFramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT2, GL_TEXTURE_2D,
                         count ? m_count.name() : 0, 0);
  const std::array<GLenum, 3> buffers{GL_COLOR_ATTACHMENT0, GL_COLOR_ATTACHMENT1,
                                      GL_COLOR_ATTACHMENT2};
  glDrawBuffers(count ? 3 : 2, buffers.data());
  if (glCheckFramebufferStatus(GL_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE)
    throw RenderingError(RenderingError::Reason::NoOpenGL,
                         "the graphics driver draws no picture of " + std::to_string(width) +
                             " x " + std::to_string(height) + " in 16-bit colour");
}

std::array<double, 2> RayTarget::meanCounts() const
{
  const core::Index3& size = m_count.dims();
  const std::size_t pixels = static_cast<std::size_t>(size[0]) * static_cast<std::size_t>(size[1]);
  std::vector<float> counts(2 * pixels);
  glReadBuffer(GL_COLOR_ATTACHMENT2);
  glReadPixels(0, 0, size[0], size[1], GL_RG, GL_FLOAT, counts.data());
  glReadBuffer(GL_COLOR_ATTACHMENT0);
  double fetches = 0.0;
  double samples = 0.0;
  for (std::size_t i = 0; i < pixels; ++i)
  {
    fetches += static_cast<double>(counts[2 * i]);
    samples += static_cast<double>(counts[2 * i + 1]);
  }
  return {fetches / static_cast<double>(pixels), samples / static_cast<double>(pixels)};
}

DepthImage RayTarget::readDepth() const
{
  DepthImage image;
  image.width = m_depth.dims()[0];
  image.height = m_depth.dims()[1];
  const auto width = static_cast<std::size_t>(image.width);
  const auto height = static_cast<std::size_t>(image.height);
  std::vector<float> rows(width * height);
  if (!rows.empty())
  {
    glActiveTexture(GL_TEXTURE0);
    m_depth.bind(0);
    glGetTexImage(GL_TEXTURE_2D, 0, GL_RED, GL_FLOAT, rows.data());
    glBindTexture(GL_TEXTURE_2D, 0);
  }
  image.millimetres.resize(rows.size());
  for (std::size_t y = 0; y < height; ++y) // OpenGL stores rows bottom up
    std::transform(rows.begin() + static_cast<std::ptrdiff_t>((height - 1 - y) * width),
                   rows.begin() + static_cast<std::ptrdiff_t>((height - y) * width),
                   image.millimetres.begin() + static_cast<std::ptrdiff_t>(y * width),
                   [](float d) { return d < 0.0F ? std::numeric_limits<float>::quiet_NaN() : d; });
  return image;
}

float RayTarget::readDepth(double column, double row, int width, int height) const
{
  const core::Index3& size = m_depth.dims();
  if (!m_framebuffer || size[0] < 1 || column < 0.0 || row < 0.0 || column >= width ||
      row >= height)
    return std::numeric_limits<float>::quiet_NaN();
  const int x = std::min(static_cast<int>((column + 0.5) * size[0] / width), size[0] - 1);
  const int y =
      size[1] - 1 - std::min(static_cast<int>((row + 0.5) * size[1] / height), size[1] - 1);
  GLint bound = 0;
  glGetIntegerv(GL_READ_FRAMEBUFFER_BINDING, &bound);
  glBindFramebuffer(GL_READ_FRAMEBUFFER, m_framebuffer);
  glReadBuffer(GL_COLOR_ATTACHMENT1);
  float depth = -1.0F;
  glReadPixels(x, y, 1, 1, GL_RED, GL_FLOAT, &depth);
  glReadBuffer(GL_COLOR_ATTACHMENT0);
  glBindFramebuffer(GL_READ_FRAMEBUFFER, static_cast<GLuint>(bound));
  return depth < 0.0F ? std::numeric_limits<float>::quiet_NaN() : depth;
}

void RayTarget::release()
{
  m_color.release();
  m_depth.release();
  m_count.release();
  if (m_framebuffer)
    glDeleteFramebuffers(1, &m_framebuffer);
  m_framebuffer = 0;
}

} // namespace petrous::rendering
