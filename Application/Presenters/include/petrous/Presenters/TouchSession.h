#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "petrous/Presenters/TouchScene.h"
#include "petrous/Simulation/DissectionLoop.h"
#include "petrous/Simulation/ServoThread.h"
#include "petrous/Simulation/SessionRecorder.h"

namespace petrous::presenters
{

/// A tool in a live hand: the servo runs in a thread of its own, and what it drills is cut in the
/// thread that calls `advance`, once a picture. So one thread writes the mask and draws it, and the
/// servo sees its states through the scene's PublishedMask.
///
/// A recording holds each tick and each cut; what fails there ends the recording alone. It begins
/// with the session: for another tool, or a switch that is turned on later, there is a new session.
///
/// Between two calls the servo feels the old surface, so the bites of one call go no deeper
/// together than `kDeepest` of the burr's radius: a slow picture drills slower, never in a leap.
///
/// Case, scene and device must outlive this. One thread.
class TouchSession
{
public:
  static constexpr double kDeepest = 0.5;

  /// mm/s per N of thrust: at 1 N a burr of 4 mm sinks in within 2 s, as slowly as a hand can lead
  /// it. A tool path has ten times that (PathDrill::kFeed), which no hand could follow: at 1 N the
  /// burr would be in within 0.2 s, the time in which one begins to answer; and since the servo
  /// feels the surface of the last picture, it would fall by 0.3 mm with each of 60 pictures a
  /// second. With this one it is 0.03 mm, less than is felt.
  static constexpr double kFeed = 2.0;

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
    bool cuts = true;    ///< false: takes nothing and opens no stroke, whatever asks for the drill
    double feed = kFeed; ///< mm/s per N of thrust, > 0
  };

  /// What happened since the last call.
  struct News
  {
    std::optional<simulation::TickRecord> record; ///< the latest; nothing before the first tick
    std::vector<std::size_t> bricks;              ///< of the mask that changed, sorted
    std::vector<std::shared_ptr<const dissection::Stroke>> strokes; ///< closed; null: took nothing
    std::string fault;          ///< the latest one, one sentence; empty while all is well
    std::string recordingFault; ///< why the recording ended before the session; empty otherwise
  };

  /// Makes the tool's points (up to some 1.5 s), unless they are given, and starts the servo.
  /// Throws InvalidParameter naming the first bad value, RecordingError when the recording cannot
  /// be begun, or std::system_error without a thread.
  TouchSession(scene::Case& value, TouchScene& scene, haptics::Device& device, const Setup& setup);
  ~TouchSession();
  TouchSession(const TouchSession&) = delete;
  TouchSession& operator=(const TouchSession&) = delete;

  /// Cuts what the servo drilled.
  News advance();

  /// For the ticks to come. Throws InvalidParameter.
  void setParameters(const simulation::ServoParameters& parameters);

  /// Noted with the strokes to come.
  void setCamera(const core::CameraPose& camera) { m_camera = camera; }

  bool drilling() const noexcept; ///< a stroke is open

  /// Cuts what was drilled until now and closes the stroke, also while the hand still drills: then
  /// the next tick opens another.
  News endStroke();

  /// One stroke back or forth, the open one closed first; the tissue that comes back moves the tool
  /// out. False when there is none; what changed is in the next news.
  bool undo();
  bool redo();

  /// The force falls, the servo ends (some 20 ms), the stroke is closed. Again is as once.
  News stop();

  simulation::ServoThread::State state() const noexcept { return m_thread->state(); }

  /// Null when there is none.
  const simulation::SessionRecorder* recording() const noexcept { return m_recorder.get(); }

private:
  class BoundedFeed : public simulation::Feed
  {
  public:
    BoundedFeed(double radius, double gain);
    std::optional<dissection::SweptSphere> bite(const simulation::TickRecord& record,
                                                double seconds) override;
    void begin() noexcept { m_left = m_most; } ///< of a call

  private:
    simulation::SimpleFeed m_feed;
    double m_most; // mm
    double m_left = 0.0;
  };

  simulation::DissectionLoop::Hooks hooks(const dissection::Burr& burr);
  std::size_t hear();
  void drain();
  void close();
  bool step(bool (simulation::DissectionLoop::*way)());
  News take();

  scene::Case& m_case;
  TouchScene& m_scene;
  std::optional<core::CameraPose> m_camera;
  std::unique_ptr<haptics::Proxy> m_proxy;
  simulation::Servo m_servo;
  std::unique_ptr<simulation::SessionRecorder> m_recorder;
  const bool m_cuts;
  BoundedFeed m_feed;
  simulation::DissectionLoop m_loop;
  simulation::SpscRing<simulation::TickRecord> m_ring;
  std::vector<simulation::TickRecord> m_batch;
  News m_news;
  std::unique_ptr<simulation::ServoThread> m_thread; // last: uses all the others
};

} // namespace petrous::presenters
