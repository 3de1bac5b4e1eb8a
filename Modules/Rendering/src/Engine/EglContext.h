#pragma once

#include <memory>
#include <string>

namespace petrous::rendering
{

/// An OpenGL core context without a display or a surface.
///
/// Tries in order: hardware EGL devices, Mesa's surfaceless platform, software EGL devices; the
/// first that provides OpenGL 3.2 or later is used. libEGL is loaded on first use.
class EglContext
{
public:
  /// Throws RenderingError NoOpenGL; the message says what to install.
  EglContext();
  ~EglContext();
  EglContext(const EglContext&) = delete;
  EglContext& operator=(const EglContext&) = delete;

  void makeCurrent();
  void releaseCurrent();
  bool isCurrent() const;
  void* handle() const;

private:
  struct State;
  std::unique_ptr<State> m_state;
};

} // namespace petrous::rendering
