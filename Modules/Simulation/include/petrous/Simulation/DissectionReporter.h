#pragma once

#include <functional>

#include "petrous/Simulation/DissectionLoop.h"
#include "petrous/Simulation/DissectionUpdate.h"

namespace petrous::simulation
{

/// Notes what a DissectionLoop does and posts it. For the thread that cuts.
class DissectionReporter
{
public:
  /// Fills in what is known of a stroke only at its end (its removed volume). What it throws is
  /// told once by `complain`, and the stroke is closed without.
  using Complete = std::function<void(dissection::Dissection&)>;

  /// Both must outlive this; `work` is the loop's dissection.
  DissectionReporter(const dissection::Dissection& work, UpdateQueue& mailbox);

  /// The loop's hooks, so that this hears of all. Strokes are closed and undone in `work`, and
  /// nowhere else: of the hooks there are only these two to be had beside this one's own.
  DissectionLoop::Hooks listen(DissectionLoop::Begin begin, DissectionLoop::Edited edited,
                               Complete complete);

  void note(const TickRecord& record); ///< for its fault
  void note(const std::string& recordingFault);

  /// Posts what was noted since: once after several ticks, so that bricks, events and history fit
  /// each other.
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

} // namespace petrous::simulation
