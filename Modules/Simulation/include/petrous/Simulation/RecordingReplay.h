#pragma once

#include <cstdint>
#include <deque>
#include <optional>
#include <string>

#include "petrous/Simulation/DissectionLoop.h"
#include "petrous/Simulation/RecordingReader.h"
#include "petrous/Simulation/Servo.h"

namespace petrous::simulation
{

/// Plays a recording again: the mask goes through the states that it went through, and each tick
/// finds the one that it felt then, whatever thread cut at the time. The result is the recording,
/// bit for bit, and each tick is held against it.
///
///     while (replay.next())
///       use(replay.feel());
///
/// One thread.
class RecordingReplay
{
public:
  struct Outcome
  {
    std::uint64_t ticks = 0;
    std::uint64_t different = 0;                 ///< ticks that are not the recorded ones
    std::optional<std::uint64_t> firstDifferent; ///< number of the first one
    std::string difference; ///< what of it differs, or where the mask went another way; for people
    std::string warning;    ///< the recording ends early; for people

    bool equal() const noexcept { return different == 0 && difference.empty(); }
  };

  /// reader  of which nothing was read yet
  /// servo   fresh, with reader.setup().servo and a proxy as the recording's
  /// loop    over a dissection and a mask as they were when the recording began (RecordedScene,
  ///         with its first state's number), without a tick
  /// All must outlive this.
  RecordingReplay(RecordingReader& reader, Servo& servo, DissectionLoop& loop);

  /// Takes the mask to the state that the next tick felt, and gives that tick as it was recorded.
  /// Null at the end, with all done to the mask that was done. Throws RecordingError.
  const TickRecord* next();

  /// The servo's tick, after next(). It holds until the one after.
  const TickRecord& feel() noexcept;

  /// Does now what was done to the mask before the tick that comes next, for those who look at it
  /// between ticks; next() would do it. Throws RecordingError.
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
  std::size_t m_at = 0; // in the block's ticks
  std::deque<MaskEdit> m_edits;
  bool m_ended = false;
  Outcome m_outcome;
};

} // namespace petrous::simulation
