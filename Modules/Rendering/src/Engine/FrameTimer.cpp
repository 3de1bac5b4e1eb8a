#include "FrameTimer.h"

#include <string>

#include <vtk_glew.h>

namespace petrous::rendering
{

namespace
{

bool waitsForFrames()
{
  const auto* name = reinterpret_cast<const char*>(glGetString(GL_RENDERER));
  const std::string renderer = name ? name : "";
  for (const char* software : {"llvmpipe", "softpipe", "SWR", "Software"})
    if (renderer.find(software) != std::string::npos)
      return true;
  return !GLEW_ARB_timer_query;
}

} // namespace

void FrameTimer::begin()
{
  if (!m_software)
    m_software = waitsForFrames();
  m_begun = std::chrono::steady_clock::now();
  if (*m_software)
    return;
  read();
  m_open = !m_pending;
  if (!m_open)
    return;
  if (m_queries[Begin] == 0)
    glGenQueries(MarkCount, m_queries.data());
  glQueryCounter(m_queries[Begin], GL_TIMESTAMP);
}

void FrameTimer::end(const RenderQuality& quality)
{
  if (m_software.value_or(true))
  {
    glFinish();
    m_known =
        Frame{std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - m_begun)
                  .count(),
              quality};
    return;
  }
  if (!m_open)
    return;
  glQueryCounter(m_queries[End], GL_TIMESTAMP);
  m_quality = quality;
  m_open = false;
  m_pending = true;
}

void FrameTimer::read()
{
  if (!m_pending)
    return;
  GLint done = 0;
  glGetQueryObjectiv(m_queries[End], GL_QUERY_RESULT_AVAILABLE, &done);
  if (done == 0)
    return;
  GLuint64 begun = 0;
  GLuint64 ended = 0;
  glGetQueryObjectui64v(m_queries[Begin], GL_QUERY_RESULT, &begun);
  glGetQueryObjectui64v(m_queries[End], GL_QUERY_RESULT, &ended);
  m_pending = false;
  if (ended > begun) // the clock may have wrapped around
    m_known = Frame{1e-6 * static_cast<double>(ended - begun), m_quality};
}

void FrameTimer::release()
{
  if (m_queries[Begin] != 0)
    glDeleteQueries(MarkCount, m_queries.data());
  *this = FrameTimer();
}

std::optional<FrameTimer::Frame> FrameTimer::take()
{
  std::optional<Frame> frame;
  frame.swap(m_known);
  return frame;
}

} // namespace petrous::rendering
