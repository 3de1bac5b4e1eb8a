#pragma once

#include <limits>
#include <memory>
#include <string>

#include "petrous/Rendering/Picture.h"

class vtkRenderer;

namespace petrous::rendering
{

/// A window without a display in which our picture and its peers are timed alike: the same EGL
/// context, size and renderer settings, and every frame waited for until its last pixel is there.
class TimedView
{
public:
  struct Timing
  {
    double first = 0.0;  ///< s, with uploads and shaders
    double median = 0.0; ///< s, of the frames after the first
    int frames = 0;      ///< how many the median is of; 0: `median` is `first`
  };

  /// Throws RenderingError NoOpenGL or BadSize.
  TimedView(int width, int height);
  ~TimedView();
  TimedView(const TimedView&) = delete;
  TimedView& operator=(const TimedView&) = delete;

  /// Attaches a picture (ScenePicture, PeerPicture) in place of the one before, which may be gone.
  template <class Attachable>
  void show(Attachable& picture)
  {
    picture.attach(takeRenderer());
  }

  /// Draws once. readBack: the pixels come to the processor, as a picture file needs them;
  /// otherwise only the end of the drawing is waited for. Seconds.
  double frame(bool readBack = true);

  /// The first frame of what is shown and the median of `frames` more: fast ones go on until half
  /// a second is full, slow ones end once `enough` seconds are. 0: the first alone.
  Timing time(int frames, double enough = std::numeric_limits<double>::infinity());

  Picture picture() const; ///< the last frame that was read back

  std::string glRenderer() const; ///< as the driver calls itself
  std::string glVersion() const;

private:
  vtkRenderer* takeRenderer();

  class Implementation;
  std::unique_ptr<Implementation> m_implementation;
};

} // namespace petrous::rendering
