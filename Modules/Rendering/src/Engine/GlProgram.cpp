#include "GlProgram.h"

#include <vtkOpenGLRenderWindow.h>
#include <vtkOpenGLShaderCache.h>

#include "petrous/Rendering/RenderingError.h"

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

namespace
{

[[noreturn]] void refuse(const std::string& what, const std::string& log)
{
  throw RenderingError(RenderingError::Reason::NoOpenGL,
                       "the graphics driver refuses " + what + ": " + log);
}

GLuint compile(GLenum kind, std::string_view source)
{
  constexpr std::string_view version = "#version 330 core\n";
  const GLuint shader = glCreateShader(kind);
  const char* texts[] = {version.data(), source.data()};
  const GLint lengths[] = {static_cast<GLint>(version.size()), static_cast<GLint>(source.size())};
  glShaderSource(shader, 2, texts, lengths);
  glCompileShader(shader);
  GLint done = 0;
  glGetShaderiv(shader, GL_COMPILE_STATUS, &done);
  if (done)
    return shader;
  std::string log(4096, '\0');
  GLsizei length = 0;
  glGetShaderInfoLog(shader, static_cast<GLsizei>(log.size()), &length, log.data());
  log.resize(static_cast<std::size_t>(length));
  glDeleteShader(shader);
  refuse("the renderer's shader", log);
}

} // namespace

void GlProgram::build(std::string_view vertex, std::string_view fragment)
{
  release();
  const GLuint first = compile(GL_VERTEX_SHADER, vertex);
  const GLuint second = compile(GL_FRAGMENT_SHADER, fragment);
  m_name = glCreateProgram();
  glAttachShader(m_name, first);
  glAttachShader(m_name, second);
  glLinkProgram(m_name);
  glDeleteShader(first);
  glDeleteShader(second);
  GLint done = 0;
  glGetProgramiv(m_name, GL_LINK_STATUS, &done);
  if (done)
    return;
  std::string log(4096, '\0');
  GLsizei length = 0;
  glGetProgramInfoLog(m_name, static_cast<GLsizei>(log.size()), &length, log.data());
  log.resize(static_cast<std::size_t>(length));
  release();
  refuse("to link the renderer's shaders", log);
}

void GlProgram::release()
{
  if (m_name)
    glDeleteProgram(m_name);
  m_name = 0;
  m_locations.clear();
}

GLint GlUniforms::location(const char* name)
{
  const auto found = m_locations.find(name);
  if (found != m_locations.end())
    return found->second;
  return m_locations.emplace(name, glGetUniformLocation(m_name, name)).first->second;
}

void GlUniforms::set(const char* name, int value)
{
  glUniform1i(location(name), value);
}

void GlUniforms::set(const char* name, double value)
{
  glUniform1f(location(name), static_cast<float>(value));
}

void GlUniforms::set(const char* name, const Eigen::Vector2d& value)
{
  const Eigen::Vector2f single = value.cast<float>();
  glUniform2fv(location(name), 1, single.data());
}

void GlUniforms::set(const char* name, const Eigen::Vector3d& value)
{
  const Eigen::Vector3f single = value.cast<float>();
  glUniform3fv(location(name), 1, single.data());
}

void GlUniforms::set(const char* name, const Eigen::Vector4d& value)
{
  const Eigen::Vector4f single = value.cast<float>();
  glUniform4fv(location(name), 1, single.data());
}

void GlUniforms::set(const char* name, const Eigen::Matrix3d& value)
{
  const Eigen::Matrix3f single = value.cast<float>();
  glUniformMatrix3fv(location(name), 1, GL_FALSE, single.data());
}

void GlUniforms::setArray(const char* name, const float* vectors4, int count)
{
  glUniform4fv(location(name), count, vectors4);
}

} // namespace petrous::rendering
