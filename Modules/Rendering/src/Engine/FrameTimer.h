#pragma once

#include <array>
#include <chrono>
#include <optional>

#include "petrous/Rendering/RenderQuality.h"

namespace petrous::rendering
{

/// How long frames take the graphics card, without waiting for it: a timestamp before and one
/// behind a frame's orders, read when a later frame begins. Frames whose predecessor is not done
/// yet are not timed. A software renderer is waited for: it works on the processor anyway, and its
/// timestamps tell when the last tile was begun.
class FrameTimer
{
public:
  struct Frame
  {
    double milliseconds = 0.0;
    RenderQuality quality; ///< that it was drawn with
  };

  /// All with the same context current.
  void begin();
  void end(const RenderQuality& quality);
  bool holdsQueries() const noexcept { return m_queries[Begin] != 0; }
  void release(); ///< before the context goes, or another one comes

  /// A frame that became known since, once.
  std::optional<Frame> take();

private:
  enum Mark : std::size_t
  {
    Begin,
    End,
    MarkCount
  };
  void read();

  std::optional<bool> m_software;
  std::array<unsigned, MarkCount> m_queries{}; // 0: none
  bool m_pending = false;                      // both are stamped, none read
  bool m_open = false;                         // the first is stamped
  std::chrono::steady_clock::time_point m_begun;
  RenderQuality m_quality; // of the pending frame
  std::optional<Frame> m_known;
};

} // namespace petrous::rendering
