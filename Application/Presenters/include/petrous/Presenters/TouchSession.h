#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "petrous/Presenters/TouchDissection.h"
#include "petrous/Simulation/ServoThread.h"

namespace petrous::presenters
{

/// A tool in a live hand. The servo runs in one thread, and what it drills is cut in another
/// (TouchDissection); the servo feels each cut through the scene's PublishedMask, however seldom
/// pictures are drawn. The case is written by `advance` alone, once a picture: it follows what was
/// cut until then. So all that reads the case in this thread reads it in peace, and a save holds
/// the strokes that were closed until then.
///
/// A recording holds each tick and each cut; what fails there ends the recording alone. It begins
/// with the session: for another tool, or a switch that is turned on later, there is a new session.
///
/// Case, scene and device must outlive this. One thread.
class TouchSession
{
public:
  struct Setup
  {
    TouchTool tool;
    simulation::ServoParameters parameters;
    Eigen::Vector3d center{0.0, 0.0, 0.0}; ///< patient mm: where the hand's origin is
    /// The session is written there, so that it can be played again; empty: it is not.
    std::filesystem::path recording;
    haptics::DeviceGuard::Limits guard;
    haptics::ForceLimits::Limits limits; ///< of the device
    std::optional<haptics::PassivityGuard::Parameters> passivity;
    bool cuts = true; ///< false: takes nothing and opens no stroke, whatever asks for the drill
    dissection::Catalogues catalogues = dissection::Catalogues::builtIn();
    std::function<void(const dissection::Dissection&)> journal; ///< see TouchDissection
  };

  /// What happened since the last call.
  struct News
  {
    std::optional<simulation::TickRecord> record; ///< the latest; nothing before the first tick
    std::vector<std::size_t> bricks;              ///< of the mask that changed, sorted
    std::vector<std::shared_ptr<const dissection::Stroke>> strokes; ///< closed; null: took nothing
    std::vector<bool> steps;    ///< of the history; true: a stroke was undone, false: redone
    std::string fault;          ///< the latest one, one sentence; empty while all is well
    std::string recordingFault; ///< why the recording ended before the session; empty otherwise
    std::string journalFault;   ///< why what is drilled is not on the disk; told once
    std::string failure;        ///< why nothing is cut any more, told once; see `failed`
  };

  /// Makes the tool's points (up to some 1.5 s), unless they are given, and starts the servo.
  /// Throws InvalidParameter naming the first bad value, RecordingError when the recording cannot
  /// be begun, or std::system_error without a thread.
  TouchSession(scene::Case& value, TouchScene& scene, haptics::Device& device, const Setup& setup);
  ~TouchSession(); ///< as stop
  TouchSession(const TouchSession&) = delete;
  TouchSession& operator=(const TouchSession&) = delete;

  /// Brings the case to what was drilled, undone and redone. Never waits for it.
  News advance();

  /// For the ticks to come. Throws InvalidParameter.
  void setParameters(const simulation::ServoParameters& parameters);

  /// Noted with the strokes to come.
  void setCamera(const core::CameraPose& camera) { m_dissection.setCamera(camera); }

  bool drilling() const noexcept; ///< a stroke is open, as far as the case has followed

  /// Asks for one stroke back or forth, the open one closed first; the tissue that comes back moves
  /// the tool out. Told by the news, some milliseconds later; nothing is when there is none.
  void undo() { m_dissection.undo(); }
  void redo() { m_dissection.redo(); }

  /// The force falls, the servo ends (some 20 ms), what it drilled is cut, the stroke is closed and
  /// the case is there. Again is as once.
  News stop();

  /// Nothing is cut any more. All that was cut until then comes with `stop`; then the scene is to
  /// be made anew.
  bool failed() const noexcept { return m_dissection.failed(); }

  simulation::ServoThread::State state() const noexcept { return m_thread->state(); }

  /// Only after `stop`; null when there is none.
  const simulation::SessionRecorder* recording() const noexcept { return m_dissection.recording(); }

private:
  scene::Case& m_case;
  std::shared_ptr<const core::LockedMemory> m_locked; // what the servo reads
  std::unique_ptr<haptics::Proxy> m_proxy;
  simulation::Servo m_servo;
  simulation::SpscRing<simulation::TickRecord> m_ring;
  TouchDissection m_dissection;
  std::unique_ptr<simulation::ServoThread> m_thread; // last: uses all the others
};

} // namespace petrous::presenters
