#pragma once

#include <memory>
#include <string>

#include "petrous/Rendering/Picture.h"
#include "petrous/Rendering/ScenePicture.h"

namespace petrous::rendering
{

/// Draws scenes without a display in its own EGL context, which is current only during its calls.
/// If a window's context is current on the calling thread, release it first.
class OffscreenView
{
public:
  /// Throws RenderingError NoOpenGL (the message says what to install) or BadSize.
  OffscreenView(int width, int height);
  ~OffscreenView();
  OffscreenView(const OffscreenView&) = delete;
  OffscreenView& operator=(const OffscreenView&) = delete;

  /// Draws the scene in its current state. The scene stays attached until another one is drawn or
  /// the view is destroyed; either may be destroyed first. Deterministic: the same scene and camera
  /// give the same pixels, in another process too.
  Picture render(ScenePicture& scene);

  double milliseconds() const;           ///< of the last render
  double firstFrameMilliseconds() const; ///< of the scene's first frame, with uploads and shaders
  std::string glRenderer() const;        ///< GL_RENDERER

private:
  class Implementation;
  std::unique_ptr<Implementation> m_implementation;
};

} // namespace petrous::rendering
