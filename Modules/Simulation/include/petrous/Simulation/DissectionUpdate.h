#pragma once

#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "petrous/Dissection/Dissection.h"
#include "petrous/Simulation/TickRecord.h"

namespace petrous::simulation
{

/// A step of a dissection's history.
struct DissectionEvent
{
  enum class Kind
  {
    StrokeBegun,
    StrokeClosed,
    Undone,
    Redone
  };
  Kind kind = Kind::StrokeBegun;
  std::shared_ptr<const dissection::Stroke> stroke; ///< closed; null when it took nothing
};

/// What a thread that cuts has done since it was last asked, for the thread that draws. However
/// long nobody asks, it holds a brick once (only the latest version matters), a history once, and
/// of the events no more than there are strokes: one that took nothing is told once in a row.
struct DissectionUpdate
{
  std::map<std::size_t, volume::CutMask::BrickVersion> bricks; ///< that changed, as they are now
  std::vector<DissectionEvent> events;                         ///< in order
  std::optional<dissection::Dissection> history; ///< after the last event; nothing without events
  std::optional<TickRecord> fault;               ///< the latest tick that had one
  std::string recordingFault;                    ///< why the recording ended

  bool empty() const noexcept;

  /// `next` follows this, and is empty then. On std::bad_alloc both are as they were.
  void append(DissectionUpdate& next);
};

/// Hands mail from one thread to another. Either holds the other up for some swaps of pointers.
class UpdateQueue
{
public:
  void post(DissectionUpdate& mail); ///< which is empty then
  DissectionUpdate take();

private:
  std::mutex m_mutex;
  DissectionUpdate m_mail;
};

/// Brings a copy of the dissection to where the thread's was when the mail was posted; sorted, the
/// bricks that changed. In an open stroke the copy has mask and maskBeforeStroke of the thread's;
/// openBricks and openInfo are as they were at its begin.
std::vector<std::size_t> follow(DissectionUpdate& mail, dissection::Dissection& copy);

} // namespace petrous::simulation
