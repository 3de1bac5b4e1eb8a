#include "petrous/Presenters/PathDrill.h"

namespace petrous::presenters
{

namespace
{

simulation::ServoSetup setupOf(const TouchScene& scene, const TouchTool& tool)
{
  simulation::ServoSetup setup = scene.servoOf(tool);
  // A written path may jump as it likes; no hand is harmed.
  setup.guard.speed = 1e9;
  setup.guard.angularSpeed = 1e9;
  setup.guard.reach = 1e9;
  setup.guard.goodTicks = 1;
  setup.stallAfter = 1e9;
  return setup;
}

} // namespace

PathDrill::PathDrill(scene::Case& value, TouchScene& scene, const Options& options)
  : m_case(value)
  , m_scene(scene)
  , m_options(options)
  , m_proxy(scene.proxyOf(options.tool))
  , m_servo(*m_proxy, setupOf(scene, options.tool))
  , m_law(0.5 * options.tool.burr.diameter)
  , m_feed(m_law)
  , m_loop(*value.dissection, *scene.mask(), m_feed, scene.drill().protectedTissue(),
           scene.hooksOf(options.tool.burr, [camera = options.camera] { return camera; }))
{
  m_parameters.constantThrust = options.thrust ? 1 : 0;
  m_parameters.thrust = options.thrust.value_or(1.0);
  simulation::check(m_parameters);
}

const simulation::TickRecord& PathDrill::feel(const dissection::ToolSample& sample) noexcept
{
  haptics::DeviceReading reading;
  reading.time = sample.time;
  reading.pose = {sample.pose.translation(), sample.pose.rotation()};
  reading.health = haptics::DeviceHealth::Good;
  m_parameters.drill = sample.drill ? 1 : 0;
  m_record = m_servo.tick(simulation::TickInput::of(sample.time, reading, m_parameters));
  return m_record;
}

void PathDrill::cut(const dissection::ToolSample& sample)
{
  const bool inside = m_record.status == static_cast<std::uint8_t>(haptics::ProxyStatus::Inside);
  m_inside += inside ? 1 : 0;
  if (inside && sample.drill)
    sweep(sample);
  else
    m_loop.step(m_record);
}

void PathDrill::sweep(const dissection::ToolSample& sample)
{
  DrillSession& drill = m_scene.drill();
  if (!drill.drilling())
    drill.begin(m_options.tool.burr, utcNow(), sample.time, m_options.camera);
  drill.moveTo(sample.pose.translation(), sample.time);
  m_scene.mask()->publish(m_case.dissection->mask(), m_case.dissection->mask().takeDirty(), false);
}

void PathDrill::end()
{
  m_loop.endStroke();
}

} // namespace petrous::presenters
