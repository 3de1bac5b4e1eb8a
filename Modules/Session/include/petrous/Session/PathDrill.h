#pragma once

#include <filesystem>
#include <memory>
#include <optional>

#include "petrous/Dissection/ToolPath.h"
#include "petrous/Session/DissectionLoop.h"
#include "petrous/Session/RecordingWriter.h"
#include "petrous/Session/Servo.h"
#include "petrous/Session/SurfaceApproach.h"
#include "petrous/Session/TouchScene.h"

namespace petrous::session
{

/// Plays tool poses through device, proxy, force and removal, tick by tick: the same poses give a
/// bit-identical result.
///
/// While the tool is embedded in tissue (a path that begins inside bone) no force is rendered, and
/// a running drill removes what the burr sweeps, until the tool is free. An instrument removes
/// nothing, whatever the path's drill says.
///
/// The scene must outlive this. Not thread-safe.
class PathDrill
{
public:
  struct Options
  {
    TouchTool tool;
    dissection::Catalogues catalogues = dissection::Catalogues::builtIn();
    std::optional<double> thrust;           ///< N: presses the tool on the surface
    std::optional<core::CameraPose> camera; ///< stored with each stroke
    std::filesystem::path recording;        ///< file for ticks and cuts; empty: none
  };

  /// Throws InvalidParameter naming the first bad value, RecordingError.
  PathDrill(scene::Case& value, TouchScene& scene, const Options& options);

  /// The servo's tick: the force at this pose. The record is valid until the next tick.
  const TickRecord& feel(const dissection::ToolSample& sample) noexcept;

  /// The tick's effect on the tissue: removal, begin and end of a stroke. Throws RecordingError if
  /// the disk is full.
  void cut(const dissection::ToolSample& sample);

  /// Drill off: closes the open stroke and the recording. Throws RecordingError.
  void end();

  /// The removal model's results, and its inputs at the last tick.
  const BurrRemovalModel& removal() const noexcept { return m_removal->removalModel; }

  double radius() const noexcept { return m_radius; } ///< mm, of the burr

  /// mm^3 removed by sweeping while the tool was embedded in tissue, outside the removal laws.
  /// Measured here, of all sweeps since it was last asked for: some milliseconds.
  double swept();

  /// nullptr if nothing is recorded.
  const RecordingWriter* recording() const noexcept { return m_recording.get(); }

private:
  DissectionLoop::Hooks hooks(TouchScene& scene, const Options& options);
  void sweep(const Eigen::Vector3d& at);
  void measureSwept();
  void approach(const Eigen::Vector3d& place);

  const dissection::Dissection& m_dissection;
  const volume::TissueField& m_tissue;
  double m_radius; // mm
  bool m_cuts;     // an instrument does not
  bool m_turns;    // a burr that does not spin removes nothing, even when embedded
  std::unique_ptr<haptics::Proxy> m_proxy;
  Servo m_servo;
  std::unique_ptr<RecordingWriter> m_recording;
  std::unique_ptr<CaseRemoval> m_removal;
  DissectionLoop m_loop;
  ServoParameters m_parameters;
  SurfaceApproach m_approach;
  std::uint64_t m_approached = 0; // the mask's state at the last approach
  TickRecord m_record;
  std::optional<Eigen::Vector3d> m_swept;      // where the drill was last embedded in tissue, mm
  std::optional<volume::CutMask> m_unmeasured; // before the sweeps that were not measured yet
  double m_sweptVolume = 0.0;                  // mm^3, of those that were
};

} // namespace petrous::session
