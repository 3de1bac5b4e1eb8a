#pragma once

#include <filesystem>
#include <memory>
#include <optional>

#include "petrous/Dissection/ToolPath.h"
#include "petrous/Presenters/TouchScene.h"
#include "petrous/Simulation/DissectionLoop.h"
#include "petrous/Simulation/RecordingWriter.h"
#include "petrous/Simulation/Servo.h"

namespace petrous::presenters
{

/// Plays tool poses through device, proxy, force and cut, one tick after the other: the same poses
/// give the same result to the last bit.
///
/// Where the tool stands in tissue (a path that begins inside bone) nothing is felt, and a drill
/// that is on takes what the burr sweeps, until the tool is free.
///
/// The scene must outlive this. One thread.
class PathDrill
{
public:
  /// mm/s per N of thrust. A written path does not wait for the burr as a hand does: led at v mm/s
  /// by a coupling of k N/mm the burr lags by v / (kFeed k), here 0.25 mm at 5 mm/s. With a live
  /// hand's feed (TouchSession::kFeed) it would be 2.5 mm, which the path would leave undrilled.
  static constexpr double kFeed = 20.0;

  struct Options
  {
    TouchTool tool;
    std::optional<double> thrust;           ///< N: the tool is pressed on the surface with it
    std::optional<core::CameraPose> camera; ///< noted with each stroke
    std::filesystem::path recording;        ///< ticks and cuts are written there; empty: not
  };

  /// Throws InvalidParameter naming the first bad value, RecordingError.
  PathDrill(scene::Case& value, TouchScene& scene, const Options& options);

  /// The servo's tick: what the hand feels at this pose. The record holds until the next tick.
  const simulation::TickRecord& feel(const dissection::ToolSample& sample) noexcept;

  /// What follows it in the tissue: the drill's bite, a stroke's begin and end. Throws
  /// RecordingError when the disk is full.
  void cut(const dissection::ToolSample& sample);

  /// Drill off: closes the stroke that is open, and the recording. Throws RecordingError.
  void end();

  /// Null when there is none.
  const simulation::RecordingWriter* recording() const noexcept { return m_recording.get(); }

private:
  simulation::DissectionLoop::Hooks hooks(TouchScene& scene, const Options& options);

  double m_radius; // mm
  std::unique_ptr<haptics::Proxy> m_proxy;
  simulation::Servo m_servo;
  std::unique_ptr<simulation::RecordingWriter> m_recording;
  simulation::SimpleFeed m_law;
  simulation::OwedFeed m_feed; // looks at m_law
  simulation::DissectionLoop m_loop;
  simulation::ServoParameters m_parameters;
  simulation::TickRecord m_record;
  std::optional<Eigen::Vector3d> m_swept; // where the drill was last in tissue, mm
};

} // namespace petrous::presenters
