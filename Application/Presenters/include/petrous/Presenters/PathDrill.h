#pragma once

#include <filesystem>
#include <memory>
#include <optional>

#include "petrous/Dissection/ToolPath.h"
#include "petrous/Presenters/TouchScene.h"
#include "petrous/Simulation/DissectionLoop.h"
#include "petrous/Simulation/RecordingWriter.h"
#include "petrous/Simulation/Servo.h"
#include "petrous/Simulation/SurfaceApproach.h"

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
  struct Options
  {
    TouchTool tool;
    dissection::Catalogues catalogues = dissection::Catalogues::builtIn();
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

  /// What the laws say of the drilling, and what went into them at the last tick.
  const simulation::BurrRemovalModel& removal() const noexcept { return m_removal->removalModel; }

  double radius() const noexcept { return m_radius; } ///< mm, of the burr

  /// mm^3 taken besides, where the tool stood in tissue: of that no law says anything.
  double swept() const noexcept { return m_sweptVolume; }

  /// Null when there is none.
  const simulation::RecordingWriter* recording() const noexcept { return m_recording.get(); }

private:
  simulation::DissectionLoop::Hooks hooks(TouchScene& scene, const Options& options);
  void sweep(const Eigen::Vector3d& at);
  void approach(const Eigen::Vector3d& place);

  const dissection::Dissection& m_dissection;
  const volume::TissueField& m_tissue;
  double m_radius; // mm
  bool m_turns;    // a burr that stands still takes nothing, wherever it is
  std::unique_ptr<haptics::Proxy> m_proxy;
  simulation::Servo m_servo;
  std::unique_ptr<simulation::RecordingWriter> m_recording;
  std::unique_ptr<CaseRemoval> m_removal;
  simulation::DissectionLoop m_loop;
  simulation::ServoParameters m_parameters;
  simulation::SurfaceApproach m_approach;
  std::uint64_t m_approached = 0; // the mask's state that it looked at
  simulation::TickRecord m_record;
  std::optional<Eigen::Vector3d> m_swept; // where the drill was last in tissue, mm
  std::vector<std::size_t> m_changed;     // bricks, while it sweeps
  double m_sweptVolume = 0.0;             // mm^3
};

} // namespace petrous::presenters
