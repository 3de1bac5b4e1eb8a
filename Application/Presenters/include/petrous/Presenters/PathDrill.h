#pragma once

#include <memory>
#include <optional>

#include "petrous/Dissection/ToolPath.h"
#include "petrous/Presenters/TouchScene.h"
#include "petrous/Simulation/DissectionLoop.h"
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
  struct Options
  {
    TouchTool tool;
    std::optional<double> thrust;           ///< N: the tool is pressed on the surface with it
    std::optional<core::CameraPose> camera; ///< noted with each stroke
  };

  /// Throws InvalidParameter naming the first bad value.
  PathDrill(scene::Case& value, TouchScene& scene, const Options& options);

  /// The servo's tick: what the hand feels at this pose. The record holds until the next tick.
  const simulation::TickRecord& feel(const dissection::ToolSample& sample) noexcept;

  /// What follows it in the tissue: the drill's bite, a stroke's begin and end.
  void cut(const dissection::ToolSample& sample);

  /// Drill off: closes the stroke that is open.
  void end();

  /// Ticks of which the tool spent the whole in tissue.
  std::size_t ticksInside() const noexcept { return m_inside; }

private:
  void sweep(const dissection::ToolSample& sample);

  scene::Case& m_case;
  TouchScene& m_scene;
  Options m_options;
  std::unique_ptr<haptics::Proxy> m_proxy;
  simulation::Servo m_servo;
  simulation::SimpleFeed m_law;
  simulation::OwedFeed m_feed; // looks at m_law
  simulation::DissectionLoop m_loop;
  simulation::ServoParameters m_parameters;
  simulation::TickRecord m_record;
  std::size_t m_inside = 0;
};

} // namespace petrous::presenters
