#pragma once

#include <string_view>
#include <unordered_map>

#include <Eigen/Core>
#include <vtk_glew.h>

namespace petrous::rendering
{

/// A linked vertex and fragment shader of the current context, with uniforms set by name. Names
/// that a variant does not use are ignored. Must be released explicitly, as GlTexture.
class GlProgram
{
public:
  GlProgram() = default;
  GlProgram(const GlProgram&) = delete;
  GlProgram& operator=(const GlProgram&) = delete;

  /// Sources: GLSL 3.30 without #version. Throws RenderingError NoOpenGL with the driver's log.
  void build(std::string_view vertex, std::string_view fragment);
  void use() const { glUseProgram(m_name); }
  void release();
  explicit operator bool() const noexcept { return m_name != 0; }

  // While in use:
  void set(const char* name, int value);
  void set(const char* name, double value);
  void set(const char* name, const Eigen::Vector3d& value);
  void set(const char* name, const Eigen::Vector4d& value);
  void set(const char* name, const Eigen::Matrix3d& value);
  void setArray(const char* name, const float* vectors4, int count);

private:
  GLint location(const char* name);

  GLuint m_name = 0;
  std::unordered_map<std::string, GLint> m_locations;
};

} // namespace petrous::rendering
