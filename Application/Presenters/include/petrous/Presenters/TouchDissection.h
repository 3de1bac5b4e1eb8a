#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>

#include "petrous/Presenters/TouchScene.h"
#include "petrous/Simulation/DissectionReporter.h"
#include "petrous/Simulation/DissectionThread.h"
#include "petrous/Simulation/SessionRecorder.h"

namespace petrous::presenters
{

/// What a live tool drills, cut in a thread of its own on a fork of the case's dissection: that
/// thread is the only one that writes the fork, and publishes its states to the servo. The case is
/// not touched; `take` tells what happened, and simulation::follow brings the case there.
///
/// A recording holds each tick and each cut; what fails there ends the recording alone.
///
/// All is called from one thread, which never waits for a cut but in `stop`.
class TouchDissection
{
public:
  struct Setup
  {
    dissection::Burr burr;
    dissection::Catalogues catalogues;
    bool cuts = true; ///< false: takes nothing and opens no stroke
    std::unique_ptr<simulation::SessionRecorder> recorder; ///< null: nothing is recorded
    /// Gets the fork, in its thread, before what it has new can be taken: at each step of the
    /// history, and every kJournal in an open stroke. May be empty; what it throws ends the
    /// session.
    std::function<void(const dissection::Dissection&)> journal;
  };
  static constexpr double kJournal = 0.05; ///< s

  /// start   forked; scene.mask() must have been published from it
  /// ring    the servo's; it and the scene must outlive this
  /// Throws InvalidParameter, or std::system_error without a thread.
  TouchDissection(const dissection::Dissection& start, TouchScene& scene,
                  simulation::SpscRing<simulation::TickRecord>& ring, Setup setup);

  void setCamera(const core::CameraPose& camera); ///< noted with the strokes to come

  // Asked for: done after what the servo did until now (DissectionThread).
  void undo() { m_thread.undo(); }
  void redo() { m_thread.redo(); }

  simulation::DissectionUpdate take() { return m_mailbox.take(); }

  /// Why it cuts no more, one sentence, once; empty while it does.
  std::string takeFailure() { return m_thread.takeFailure(); }
  bool failed() const noexcept { return m_thread.failed(); }

  /// Cuts the rest of the ring, closes the stroke and the recording. Again is as once.
  void stop();

  /// Only after `stop`; null when there is none.
  const simulation::SessionRecorder* recording() const noexcept { return m_setup.recorder.get(); }

private:
  simulation::DissectionLoop::Hooks hooks(TouchScene& scene);
  void pass();
  void journal();

  Setup m_setup;
  std::mutex m_mutex; // guards m_camera
  std::optional<core::CameraPose> m_camera;
  dissection::Dissection m_work;
  std::uint64_t m_changes = 0; // of the fork, that the journal has
  std::chrono::steady_clock::time_point m_journalled;
  std::unique_ptr<CaseRemoval> m_removal;
  simulation::UpdateQueue m_mailbox;
  simulation::DissectionReporter m_reporter;
  simulation::DissectionLoop m_loop;
  simulation::DissectionThread m_thread; // last: uses all the others
};

} // namespace petrous::presenters
