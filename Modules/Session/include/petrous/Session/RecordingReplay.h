#pragma once

#include <cstdint>
#include <deque>
#include <optional>
#include <string>

#include "petrous/Session/DissectionLoop.h"
#include "petrous/Session/RecordingReader.h"
#include "petrous/Session/Servo.h"

namespace petrous::session
{

/// Replays a recording: the mask passes through the same states, and each tick uses the one that it
/// used when recorded, whichever thread cut at that time. The result is bit-identical to the
/// recording, which is checked for each tick.
///
///     while (replay.next())
///       use(replay.feel());
///
/// Not thread-safe.
class RecordingReplay
{
public:
  struct Outcome
  {
    std::uint64_t ticks = 0;
    std::uint64_t different = 0;                 ///< ticks that differ from the recorded ones
    std::optional<std::uint64_t> firstDifferent; ///< index of the first one
    std::string difference; ///< what differs first, or where the mask diverged; for display
    std::string warning;    ///< the recording is truncated; for display

    bool equal() const noexcept { return different == 0 && difference.empty(); }
  };

  /// reader  not read yet
  /// servo   new, with reader.setup().servo and a proxy as in the recording
  /// loop    over a dissection and a mask as at the start of the recording (RecordedScene, with its
  ///         first state's number), without a tick
  /// All must outlive this.
  RecordingReplay(RecordingReader& reader, Servo& servo, DissectionLoop& loop);

  /// Brings the mask to the state used by the next tick, and returns that tick as recorded. Returns
  /// nullptr at the end, after all edits. Throws RecordingError.
  const TickRecord* next();

  /// Runs the servo's tick, after next(). The result is valid until the next call.
  const TickRecord& feel() noexcept;

  /// Applies the edits made before the next tick, for inspection between ticks; next() would do so.
  /// Throws RecordingError.
  void follow();

  const Outcome& outcome() const noexcept { return m_outcome; }

private:
  bool read();
  void reach(std::uint64_t state);
  void finish();

  RecordingReader& m_reader;
  Servo& m_servo;
  DissectionLoop& m_loop;
  RecordingBlock m_block;
  std::size_t m_at = 0; // index in the block's ticks
  std::deque<MaskEdit> m_edits;
  bool m_ended = false;
  Outcome m_outcome;
};

} // namespace petrous::session
