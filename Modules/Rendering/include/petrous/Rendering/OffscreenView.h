#pragma once

#include <memory>
#include <string>

#include "petrous/Rendering/Picture.h"
#include "petrous/Rendering/ScenePicture.h"

namespace petrous::rendering
{

/// Draws scenes without a display, on an EGL context of its own, which is current only during its
/// calls. On a thread where a window's context is current, release that one first.
class OffscreenView
{
public:
  /// Throws RenderingError NoOpenGL (saying what to install) or BadSize.
  OffscreenView(int width, int height);
  ~OffscreenView();
  OffscreenView(const OffscreenView&) = delete;
  OffscreenView& operator=(const OffscreenView&) = delete;

  /// Draws the scene as it stands. The scene stays attached until another one is drawn or the
  /// view ends; either may end first. The same scene and camera give the same pixels, also in a
  /// fresh process.
  Picture render(ScenePicture& scene);

  double milliseconds() const;           ///< of the last render
  double firstFrameMilliseconds() const; ///< of the scene's first, with uploads and shaders
  std::string glRenderer() const;        ///< what the driver calls itself

private:
  class Implementation;
  std::unique_ptr<Implementation> m_implementation;
};

} // namespace petrous::rendering
