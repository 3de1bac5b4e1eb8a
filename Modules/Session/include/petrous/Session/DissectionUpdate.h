#pragma once

#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "petrous/Dissection/Dissection.h"
#include "petrous/Session/DissectionLoop.h"
#include "petrous/Session/TickRecord.h"

namespace petrous::session
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
  std::shared_ptr<const dissection::Stroke> stroke; ///< closed stroke; nullptr if it removed
                                                    ///< nothing
};

/// Changes made by the cutting thread since last taken, for the rendering thread. Bounded however
/// long it is not taken: one entry per brick (only the latest version matters), one history, and no
/// more events than strokes; consecutive strokes that removed nothing count once.
struct DissectionUpdate
{
  std::map<std::size_t, volume::CutMask::BrickVersion> bricks; ///< changed bricks, latest versions
  std::vector<DissectionEvent> events;                         ///< in order
  std::optional<dissection::Dissection> history; ///< after the last event; nullopt without events
  std::optional<TickRecord> fault;               ///< latest tick with a fault
  std::string recordingFault;                    ///< why the recording ended

  bool empty() const noexcept;

  /// Appends `next`, the later update, which is then empty. On std::bad_alloc both are unchanged.
  void append(DissectionUpdate& next);
};

/// Passes updates between threads. Each blocks the other only for a few pointer swaps.
class UpdateQueue
{
public:
  void post(DissectionUpdate& update); ///< empty afterwards
  DissectionUpdate take();

private:
  std::mutex m_mutex;
  DissectionUpdate m_update;
};

/// Collects the changes made by a DissectionLoop and posts them. For the cutting thread.
class DissectionReporter
{
public:
  /// Adds to a stroke what is known only at its end (its removed volume). An exception is reported
  /// once by `takeComplaint`, and the stroke is closed without.
  using Complete = std::function<void(dissection::Dissection&)>;

  /// Both must outlive this; `work` is the loop's dissection.
  DissectionReporter(const dissection::Dissection& work, UpdateQueue& queue);

  /// Hooks for the loop. Only `begin` and `edited` can be supplied: strokes are closed and undone
  /// in `work` only.
  DissectionLoop::Hooks listen(DissectionLoop::Begin begin, DissectionLoop::Edited edited,
                               Complete complete);

  void note(const TickRecord& record); ///< for its fault
  void note(const std::string& recordingFault);

  /// Posts the changes noted since the last call: once after several ticks, so that bricks, events
  /// and history are consistent.
  void post();

  std::string takeComplaint(); ///< why a stroke was not completed, once; empty otherwise

private:
  void close(dissection::Dissection& work, const Complete& complete);
  void note(const MaskEdit& edit);

  const dissection::Dissection& m_work;
  UpdateQueue& m_queue;
  DissectionUpdate m_update;
  std::shared_ptr<const dissection::Stroke> m_closed;
  std::string m_complaint;
};

/// Brings a copy of the dissection up to date with the cutting thread's; returns the changed
/// bricks, sorted. During an open stroke the copy's mask and maskBeforeStroke equal the thread's;
/// openBricks and openInfo are those at its begin.
std::vector<std::size_t> follow(DissectionUpdate& update, dissection::Dissection& copy);

} // namespace petrous::session
