#pragma once

#include <array>
#include <chrono>
#include <optional>

#include "petrous/Rendering/RenderQuality.h"

namespace petrous::rendering
{

/// GPU time of frames, measured without stalling: timestamp queries before and after a frame's
/// commands, read when a later frame begins. A frame that begins while its predecessor is still
/// pending is not timed. With a software renderer the timer waits for completion: it runs on the
/// CPU anyway, and its timestamps only mark the start of the last tile.
class FrameTimer
{
public:
  struct Frame
  {
    double milliseconds = 0.0;
    RenderQuality quality; ///< used for the frame
  };

  /// All calls need the same context current.
  void begin();
  void end(const RenderQuality& quality);
  bool holdsQueries() const noexcept { return m_queries[Begin] != 0; }
  void release(); ///< call before the context is destroyed or replaced

  /// A newly measured frame, once.
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
  bool m_pending = false;                      // both stamped, not yet read
  bool m_open = false;                         // the first is stamped
  std::chrono::steady_clock::time_point m_begun;
  RenderQuality m_quality; // of the pending frame
  std::optional<Frame> m_known;
};

} // namespace petrous::rendering
