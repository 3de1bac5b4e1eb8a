#pragma once

#include <memory>

#include "petrous/Rendering/ScenePicture.h"
#include "petrous/Rendering/Stereo.h"

namespace petrous::rendering
{

/// Shows a ScenePicture to two eyes in the window where it is attached, composed on the graphics
/// card as composeStereo does it. Both eyes share the scene's textures.
///
/// A second renderer draws the right eye; the scene's own renderer draws the left one, and has the
/// head's camera again when it is done, so ScenePicture::camera and the rays of a pointer stay
/// those of the middle. ScenePicture::depth and pick are the right eye's while a mode is on.
///
/// QuadBuffer needs a window whose driver has two buffers; that window's StereoRender is turned on
/// and off here.
///
/// Main thread only. Ends (or shows None) while the window's context exists and before the picture
/// is detached.
class StereoPicture
{
public:
  /// The picture must be attached, and outlive this.
  explicit StereoPicture(ScenePicture& picture);
  ~StereoPicture();
  StereoPicture(const StereoPicture&) = delete;
  StereoPicture& operator=(const StereoPicture&) = delete;

  /// From the next frame on. The rig is brought into range for each frame's camera
  /// (fittedStereoGeometry).
  void show(StereoMode mode, const StereoRig& rig);
  StereoMode mode() const noexcept;
  const StereoRig& rig() const noexcept;

  /// The screen's row of the picture's first row: even rows of the *screen* are the left eye's.
  void setFirstRow(int row) noexcept;

private:
  class Implementation;
  std::unique_ptr<Implementation> m_implementation;
};

} // namespace petrous::rendering
