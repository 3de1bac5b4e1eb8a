#pragma once

#include <limits>
#include <memory>
#include <string>

#include "petrous/Rendering/Picture.h"

class vtkRenderer;

namespace petrous::rendering
{

/// A window without a display for timing our picture and its peers alike: the same EGL context,
/// size and renderer settings; every frame is waited for until its last pixel is complete.
class TimedView
{
public:
  struct Timing
  {
    double first = 0.0;  ///< s, including uploads and shader compilation
    double median = 0.0; ///< s, of the frames after the first
    int frames = 0;      ///< number of frames in the median; 0: `median` is `first`
  };

  /// Throws RenderingError NoOpenGL or BadSize.
  TimedView(int width, int height);
  ~TimedView();
  TimedView(const TimedView&) = delete;
  TimedView& operator=(const TimedView&) = delete;

  /// Attaches a picture (ScenePicture, PeerPicture) in place of the previous one, which may have
  /// been destroyed.
  template <class Attachable>
  void show(Attachable& picture)
  {
    picture.attach(takeRenderer());
  }

  /// Draws once and returns the seconds taken. readBack: transfers the pixels to the CPU, as for a
  /// picture file; otherwise only waits for the drawing to finish.
  double frame(bool readBack = true);

  /// Times the first frame and the median of `frames` more: fast ones are repeated until half a
  /// second has passed, slow ones stop after `enough` seconds. 0: only the first.
  Timing time(int frames, double enough = std::numeric_limits<double>::infinity());

  Picture picture() const; ///< the last frame read back

  std::string glRenderer() const; ///< GL_RENDERER
  std::string glVersion() const;

private:
  vtkRenderer* takeRenderer();

  class Implementation;
  std::unique_ptr<Implementation> m_implementation;
};

} // namespace petrous::rendering
