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

/// Removal by a live tool, in a separate thread on a fork of the case's dissection: that thread is
/// the fork's only writer and publishes its states to the servo. The case is not modified; `take`
/// returns what happened, and simulation::follow applies it to the case.
///
/// A recording contains each tick and each cut; a recording failure ends only the recording.
///
/// Call from one thread, which waits for the removal only in `stop`.
class TouchDissection
{
public:
  struct Setup
  {
    dissection::Burr burr;
    dissection::Catalogues catalogues;
    bool cuts = true; ///< false: removes nothing and opens no stroke
    std::unique_ptr<simulation::SessionRecorder> recorder; ///< nullptr: nothing is recorded
    /// Receives the fork, in its thread, before its changes become available to `take`: at each
    /// history step, and every kJournal in an open stroke. May be empty; an exception ends the
    /// session.
    std::function<void(const dissection::Dissection&)> journal;
  };
  static constexpr double kJournal = 0.05; ///< s

  /// start   forked; scene.mask() must have been published from it
  /// ring    the servo's; it and the scene must outlive this
  /// Throws InvalidParameter, or std::system_error if no thread can be started.
  TouchDissection(const dissection::Dissection& start, TouchScene& scene,
                  simulation::SpscRing<simulation::TickRecord>& ring, Setup setup);

  void setCamera(const core::CameraPose& camera); ///< stored with the strokes to come

  // Asynchronous: done after the servo ticks so far (DissectionThread).
  void undo() { m_thread.undo(); }
  void redo() { m_thread.redo(); }

  simulation::DissectionUpdate take() { return m_mailbox.take(); }

  /// Why removal has stopped, one sentence, reported once; empty while it works.
  std::string takeFailure() { return m_thread.takeFailure(); }
  bool failed() const noexcept { return m_thread.failed(); }

  /// Processes the rest of the ring, closes the stroke and the recording. Idempotent.
  void stop();

  /// Only after `stop`; nullptr if nothing is recorded.
  const simulation::SessionRecorder* recording() const noexcept { return m_setup.recorder.get(); }

private:
  simulation::DissectionLoop::Hooks hooks(TouchScene& scene);
  void pass();
  void journal();

  Setup m_setup;
  std::mutex m_mutex; // guards m_camera
  std::optional<core::CameraPose> m_camera;
  dissection::Dissection m_work;
  std::uint64_t m_changes = 0; // of the fork, as of the last journal entry
  std::chrono::steady_clock::time_point m_journalled;
  std::unique_ptr<CaseRemoval> m_removal;
  simulation::UpdateQueue m_mailbox;
  simulation::DissectionReporter m_reporter;
  simulation::DissectionLoop m_loop;
  simulation::DissectionThread m_thread; // last: uses all others
};

} // namespace petrous::presenters
