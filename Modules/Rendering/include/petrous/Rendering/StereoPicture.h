#pragma once

#include <memory>

#include "petrous/Rendering/ScenePicture.h"
#include "petrous/Rendering/Stereo.h"

namespace petrous::rendering
{

/// Shows a ScenePicture in stereo in the window it is attached to, composed on the GPU as by
/// composeStereo. Both eyes share the scene's textures.
///
/// A second renderer draws the right eye. The scene's own renderer draws the left one and then gets
/// the centre camera back, so ScenePicture::camera and pick rays refer to the centre view.
/// ScenePicture::depth and pick refer to the right eye while a mode is on.
///
/// QuadBuffer needs a window whose driver provides stereo buffers; this class sets that window's
/// StereoRender.
///
/// Main thread only. Destroy it (or show None) while the window's context exists and before the
/// picture is detached.
class StereoPicture
{
public:
  /// The picture must be attached and outlive this object.
  explicit StereoPicture(ScenePicture& picture);
  ~StereoPicture();
  StereoPicture(const StereoPicture&) = delete;
  StereoPicture& operator=(const StereoPicture&) = delete;

  /// Takes effect with the next frame. The rig is clamped for each frame's camera
  /// (fittedStereoGeometry).
  void show(StereoMode mode, const StereoRig& rig);
  StereoMode mode() const noexcept;
  const StereoRig& rig() const noexcept;

  /// Screen row of the picture's first row: even *screen* rows show the left eye.
  void setFirstRow(int row) noexcept;

private:
  class Implementation;
  std::unique_ptr<Implementation> m_implementation;
};

} // namespace petrous::rendering
