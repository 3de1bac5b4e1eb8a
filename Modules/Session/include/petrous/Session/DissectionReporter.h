#pragma once

#include <functional>

#include "petrous/Session/DissectionLoop.h"
#include "petrous/Session/DissectionUpdate.h"

namespace petrous::session
{

/// Collects the changes made by a DissectionLoop and posts them. For the cutting thread.
class DissectionReporter
{
public:
  /// Adds to a stroke what is known only at its end (its removed volume). An exception is reported
  /// once by `takeComplaint`, and the stroke is closed without.
  using Complete = std::function<void(dissection::Dissection&)>;

  /// Both must outlive this; `work` is the loop's dissection.
  DissectionReporter(const dissection::Dissection& work, UpdateQueue& mailbox);

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
  UpdateQueue& m_mailbox;
  DissectionUpdate m_mail;
  std::shared_ptr<const dissection::Stroke> m_closed;
  std::string m_complaint;
};

} // namespace petrous::session
