#pragma once

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "petrous/Session/DissectionThread.h"
#include "petrous/Session/DissectionUpdate.h"
#include "petrous/Session/ServoThread.h"
#include "petrous/Session/SessionRecorder.h"
#include "petrous/Session/TouchScene.h"

namespace petrous::session
{

/// A live session with a tool. The servo runs in one thread; removal runs in another, on a fork of
/// the case's dissection of which that thread is the only writer. The servo sees each cut through
/// the scene's PublishedMask, whatever the frame rate. Only `advance` modifies the case, once per
/// frame: it applies the updates queued until then. So this thread can read the case without
/// locking, and a save contains the strokes closed until then.
///
/// A recording contains each tick and each cut; a recording failure ends only the recording. It
/// begins with the session: another tool, or recording switched on later, needs a new session.
///
/// Case, scene and device must outlive this. Not thread-safe.
class TouchSession
{
public:
  struct Setup
  {
    TouchTool tool;
    ServoParameters parameters;
    Eigen::Vector3d center{0.0, 0.0, 0.0}; ///< patient mm: position of the device's origin
    /// File to record the session to, for replay; empty: not recorded.
    std::filesystem::path recording;
    haptics::DeviceGuard::Limits guard;
    haptics::ForceLimits::Limits limits; ///< of the device
    std::optional<haptics::PassivityGuard::Parameters> passivity;
    bool cuts = true; ///< false: removes nothing and opens no stroke, whatever requests the drill
    dissection::Catalogues catalogues = dissection::Catalogues::builtIn();
    /// Receives the fork, in the thread of removal, before its changes become available to
    /// `advance`: at each history step, and every kJournal in an open stroke. May be empty; an
    /// exception ends removal.
    std::function<void(const dissection::Dissection&)> journal;
    /// Called with each tick, some milliseconds after it, in the thread of removal, which it must
    /// not hold up; with an empty one when the session stops. May be empty.
    std::function<void(const TickRecord&)> heard;
  };

  static constexpr double kJournal = 0.05; ///< s

  /// What happened since the last call.
  struct News
  {
    std::optional<TickRecord> record; ///< the latest; none before the first tick
    std::vector<std::size_t> bricks;  ///< of the mask that changed, sorted
    std::vector<std::shared_ptr<const dissection::Stroke>> strokes; ///< closed; nullptr: empty
    std::vector<bool> steps;    ///< history steps; true: undo, false: redo
    std::string fault;          ///< the latest, one sentence; empty if there is none
    std::string recordingFault; ///< why the recording ended before the session; else empty
    std::string journalFault;   ///< why the journal is not on the disk; reported once
    std::string failure;        ///< why removal has stopped, reported once; see `failed`
  };

  /// Makes the tool's point shell (up to about 1.5 s), unless cached, and starts the servo. Throws
  /// InvalidParameter naming the first bad value, RecordingError if the recording cannot be begun,
  /// or std::system_error if no thread can be started.
  TouchSession(scene::Case& value, TouchScene& scene, haptics::Device& device, const Setup& setup);
  ~TouchSession(); ///< calls stop
  TouchSession(const TouchSession&) = delete;
  TouchSession& operator=(const TouchSession&) = delete;

  /// Applies to the case what was drilled, undone and redone. Never blocks on removal.
  News advance();

  /// For the following ticks. Throws InvalidParameter.
  void setParameters(const ServoParameters& parameters);

  /// Stored with the strokes to come.
  void setCamera(const core::CameraPose& camera);

  bool drilling() const noexcept; ///< a stroke is open, as far as the case has followed

  /// Requests undo or redo of one stroke, closing an open one first; restored tissue pushes the
  /// tool out. Reported by News some milliseconds later, or not at all if there is nothing to undo
  /// or redo.
  void undo() { m_dissectionThread.undo(); }
  void redo() { m_dissectionThread.redo(); }

  /// Ramps down the force, ends the servo (about 20 ms), finishes the removal, closes the stroke
  /// and brings the case up to date. Idempotent.
  News stop();

  /// Removal has stopped. `stop` returns all that was removed until then; afterwards the scene must
  /// be remade.
  bool failed() const noexcept { return m_dissectionThread.failed(); }

  ServoThread::State state() const noexcept { return m_servoThread->state(); }
  const ServoThread& servo() const noexcept { return *m_servoThread; } ///< its times

  /// Only after `stop`; nullptr if nothing is recorded.
  const SessionRecorder* recording() const noexcept { return m_recorder.get(); }

private:
  DissectionLoop::Hooks hooks();
  void passUpdates(); ///< in the thread of removal
  void writeJournal();
  void logEnd() const;

  scene::Case& m_case;
  TouchScene& m_scene;
  const dissection::Burr m_burr;
  const std::function<void(const dissection::Dissection&)> m_journal;
  const std::function<void(const TickRecord&)> m_heard;
  std::shared_ptr<const core::LockedMemory> m_locked; // what the servo reads
  std::unique_ptr<haptics::Proxy> m_proxy;
  Servo m_servo;
  std::unique_ptr<SessionRecorder> m_recorder;
  std::uint8_t m_loggedFault = 0; // ServoFault
  SpscRing<TickRecord> m_ring;

  std::mutex m_mutex; // guards m_camera
  std::optional<core::CameraPose> m_camera;

  // Of the thread of removal.
  dissection::Dissection m_fork;
  std::uint64_t m_changes = 0; // of the fork, that the journal has
  std::chrono::steady_clock::time_point m_journalled;
  std::unique_ptr<CaseRemoval> m_removal;
  UpdateQueue m_queue;
  DissectionReporter m_reporter;
  DissectionLoop m_loop;
  DissectionThread m_dissectionThread;

  std::unique_ptr<ServoThread> m_servoThread; // last: uses all the others
};

} // namespace petrous::session
