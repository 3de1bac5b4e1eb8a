#include "petrous/Session/RecordingReplay.h"

namespace petrous::session
{

RecordingReplay::RecordingReplay(RecordingReader& reader, Servo& servo, DissectionLoop& loop)
  : m_reader(reader)
  , m_servo(servo)
  , m_loop(loop)
{
}

// Reads until there is a tick to play; false at the end.
bool RecordingReplay::read()
{
  while (!m_ended && m_at == m_block.ticks.size())
  {
    m_at = 0;
    m_ended = !m_reader.next(m_block);
    m_edits.insert(m_edits.end(), m_block.edits.begin(), m_block.edits.end());
  }
  if (m_ended)
    m_outcome.warning = m_reader.warning();
  else if (m_block.ticks[m_at].number != m_outcome.ticks)
  {
    // The servo cannot continue across a gap.
    m_ended = true;
    m_edits.clear();
    m_outcome.warning = "the recording has a gap after " + std::to_string(m_outcome.ticks) +
                        " ticks; what follows cannot be played";
  }
  return !m_ended;
}

void RecordingReplay::reach(std::uint64_t state)
{
  while (m_loop.state() < state && !m_edits.empty())
  {
    const MaskEdit edit = m_edits.front();
    m_edits.pop_front();
    if (!m_loop.apply(edit) && m_outcome.difference.empty())
      m_outcome.difference = "the cut of state " + std::to_string(edit.state) +
                             " of the mask, before tick " + std::to_string(m_outcome.ticks);
  }
}

void RecordingReplay::finish()
{
  reach(~std::uint64_t{0});
  m_loop.endStroke();
}

void RecordingReplay::follow()
{
  if (m_ended)
    return;
  if (read())
    reach(m_block.ticks[m_at].maskState);
  else
    finish();
}

const TickRecord* RecordingReplay::next()
{
  follow();
  return m_ended ? nullptr : &m_block.ticks[m_at];
}

const TickRecord& RecordingReplay::feel() noexcept
{
  const TickRecord& recorded = m_block.ticks[m_at++];
  const TickRecord& felt = m_servo.tick(recorded.input);
  if (!identical(felt, recorded))
  {
    if (!m_outcome.firstDifferent)
    {
      m_outcome.firstDifferent = recorded.number;
      if (m_outcome.difference.empty())
        m_outcome.difference = differenceOf(recorded, felt);
    }
    ++m_outcome.different;
  }
  ++m_outcome.ticks;
  return felt;
}

} // namespace petrous::session
