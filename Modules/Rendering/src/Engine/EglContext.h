#pragma once

#include <memory>
#include <string>

namespace petrous::rendering
{

/// An OpenGL core context without a display or a surface.
///
/// Tried in this order: EGL devices that are hardware, Mesa's surfaceless platform, EGL devices in
/// software; the first that gives OpenGL 3.2 or later is taken. libEGL is opened when first used.
class EglContext
{
public:
  /// Throws RenderingError NoOpenGL saying what to install.
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
