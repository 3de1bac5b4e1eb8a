#include "petrous/Session/PathDrill.h"

#include <utility>

namespace petrous::session
{

namespace
{

constexpr double kBeyond = 1.0; // mm: see ConstantThrust::goal, of a tool without a ball

ServoSetup setupOf(const TouchScene& scene, const TouchTool& tool)
{
  ServoSetup setup = scene.servoOf(tool);
  // A scripted path may jump; no user is at risk.
  setup.guard.speed = 1e9;
  setup.guard.angularSpeed = 1e9;
  setup.guard.reach = 1e9;
  setup.guard.goodTicks = 1;
  setup.stallAfter = 1e9;
  return setup;
}

} // namespace

PathDrill::PathDrill(scene::Case& value, TouchScene& scene, const Options& options)
  : m_dissection(value.dissection)
  , m_tissue(scene.drill().field())
  , m_radius(0.5 * options.tool.burr.diameter)
  , m_cuts(!options.tool.instrument)
  , m_turns(options.tool.burr.rpm > 0.0)
  , m_proxy(scene.proxyOf(options.tool))
  , m_servo(*m_proxy, setupOf(scene, options.tool))
  , m_recording(
        options.recording.empty()
            ? nullptr
            : std::make_unique<RecordingWriter>(
                  options.recording, scene.recordingOf(options.tool, m_servo.setup(), "tool path")))
  , m_removal(scene.removalOf(options.tool.burr, options.catalogues))
  , m_loop(value.dissection, *scene.mask(), m_removal->removalModel,
           scene.drill().protectedTissue(), hooks(scene, options))
  , m_approach(m_tissue)
{
  m_parameters.constantThrust = options.thrust ? ServoParameters::kPressed : 0;
  m_parameters.thrust = options.thrust.value_or(1.0);
  check(m_parameters);
}

DissectionLoop::Hooks PathDrill::hooks(TouchScene& scene, const Options& options)
{
  auto hooks = scene.hooksOf(options.tool.burr, [camera = options.camera] { return camera; });
  if (m_recording)
    hooks.edited = [this](const MaskEdit& edit) { m_recording->add(edit); };
  return hooks;
}

const TickRecord& PathDrill::feel(const dissection::ToolSample& sample) noexcept
{
  haptics::DeviceReading reading;
  reading.time = sample.time;
  reading.pose = {sample.pose.translation(), sample.pose.rotation()};
  reading.health = haptics::DeviceHealth::Good;
  m_parameters.drill = sample.drill && m_cuts ? 1 : 0;
  m_record = m_servo.tick(TickInput::of(sample.time, reading, m_parameters));
  return m_record;
}

// For the next tick; a burr in contact needs none.
void PathDrill::approach(const Eigen::Vector3d& place)
{
  if (!m_parameters.constantThrust || m_record.thrust > 0.0)
    return;
  if (std::exchange(m_approached, m_loop.state()) != m_loop.state())
    m_approach.forget();
  m_approach.apply(place, m_parameters);
  Eigen::Map<Eigen::Vector3d> way(m_parameters.approach);
  if (const double length = way.norm(); !m_cuts && length > 0.0)
    way *= 1.0 + kBeyond / length; // a burr's centre may go to the surface, a tip beyond it
}

void PathDrill::cut(const dissection::ToolSample& sample)
{
  if (m_recording)
    m_recording->add(m_record);
  const bool inside = m_record.status == static_cast<std::uint8_t>(haptics::ProxyStatus::Inside);
  if (!inside || !sample.drill || !m_turns || !m_cuts)
  {
    m_swept.reset();
    measureSwept(); // what the removal laws take does not count
    m_loop.step(m_record);
    approach(sample.pose.translation());
    return;
  }
  sweep(sample.pose.translation());
  approach(sample.pose.translation());
}

void PathDrill::sweep(const Eigen::Vector3d& at)
{
  if (!m_unmeasured)
    m_unmeasured = m_dissection.mask();
  m_loop.sweep(m_record, {m_swept.value_or(at), at, m_radius});
  m_swept = at;
}

// Once for many ticks: it costs far more than the sweeps themselves.
void PathDrill::measureSwept()
{
  if (!m_unmeasured)
    return;
  const volume::CutMask& now = m_dissection.mask();
  m_sweptVolume += dissection::measureRemoved(m_tissue, *m_unmeasured, now,
                                              dissection::changedBricks(*m_unmeasured, now), {})
                       .total;
  m_unmeasured.reset();
}

double PathDrill::swept()
{
  measureSwept();
  return m_sweptVolume;
}

void PathDrill::end()
{
  m_loop.endStroke();
  if (m_recording)
    m_recording->close();
}

} // namespace petrous::session
