#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>

#include "petrous/Session/TouchScene.h"
#include "petrous/Session/DissectionReporter.h"
#include "petrous/Session/DissectionThread.h"
#include "petrous/Session/SessionRecorder.h"

namespace petrous::session
{

/// Removal by a live tool, in a separate thread on a fork of the case's dissection: that thread is
/// the fork's only writer and publishes its states to the servo. The case is not modified; `take`
/// returns what happened, and session::follow applies it to the case.
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
    std::unique_ptr<session::SessionRecorder> recorder; ///< nullptr: nothing is recorded
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
                  session::SpscRing<session::TickRecord>& ring, Setup setup);

  void setCamera(const core::CameraPose& camera); ///< stored with the strokes to come

  // Asynchronous: done after the servo ticks so far (DissectionThread).
  void undo() { m_thread.undo(); }
  void redo() { m_thread.redo(); }

  session::DissectionUpdate take() { return m_mailbox.take(); }

  /// Why removal has stopped, one sentence, reported once; empty while it works.
  std::string takeFailure() { return m_thread.takeFailure(); }
  bool failed() const noexcept { return m_thread.failed(); }

  /// Processes the rest of the ring, closes the stroke and the recording. Idempotent.
  void stop();

  /// Only after `stop`; nullptr if nothing is recorded.
  const session::SessionRecorder* recording() const noexcept { return m_setup.recorder.get(); }

private:
  session::DissectionLoop::Hooks hooks(TouchScene& scene);
  void pass();
  void journal();

  Setup m_setup;
  std::mutex m_mutex; // guards m_camera
  std::optional<core::CameraPose> m_camera;
  dissection::Dissection m_work;
  std::uint64_t m_changes = 0; // of the fork, as of the last journal entry
  std::chrono::steady_clock::time_point m_journalled;
  std::unique_ptr<CaseRemoval> m_removal;
  session::UpdateQueue m_mailbox;
  session::DissectionReporter m_reporter;
  session::DissectionLoop m_loop;
  session::DissectionThread m_thread; // last: uses all others
};

} // namespace petrous::session
