#include "petrous/Session/Servo.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "petrous/Core/Error.h"

namespace petrous::session
{

using haptics::DeviceGuard;
using haptics::DeviceVerdict;
using haptics::Pose;
using haptics::ProxyStatus;
using haptics::ProxyTick;

namespace
{

constexpr double kMaxStep = 0.01; // s, maximum per tick

// Distances for relocating a tool, mm from its target towards the camera: the last is beyond any
// scan.
constexpr double kFirstBack = 1.0;
constexpr double kLastBack = 4096.0;
constexpr double kNearer = 1.0;     // mm by which relocation must reduce the distance
constexpr int kRest = 100;          // ticks until the next attempt after a failure
constexpr double kHeldShare = 0.05; // of the contacts' forces
constexpr double kFace = 0.01;      // mm: rounding at the handpiece's own face
constexpr double kNoWay = 1e-6;     // mm, no progress
constexpr double kAtGoal = 0.005;   // mm: the proxy has a deadband
constexpr double kArrived = 0.5;    // mm beside the pick ray: a pressed tool may begin to drill
constexpr double kHeld = 1e-4;      // mm per tick: tissue holds the tool
constexpr double kTremble = 0.1;    // mm: between contacts a held tool trembles
constexpr double kTrembled = 0.1;   // s within that

const ServoSetup& checked(const ServoSetup& setup)
{
  if (!(setup.stiffness > 0.0) || !std::isfinite(setup.stiffness))
    throw core::InvalidParameter("servo: the coupling's stiffness must be above 0 N/mm");
  if (!setup.center.allFinite())
    throw core::InvalidParameter("servo: the centre is not finite");
  if (!(setup.stallAfter > 0.0))
    throw core::InvalidParameter("servo: a stall must be longer than 0 s");
  return setup;
}

} // namespace

Servo::Servo(haptics::Proxy& proxy, const ServoSetup& setup)
  : m_setup(checked(setup))
  , m_proxy(proxy)
  , m_guard(setup.guard)
  , m_limits(setup.limits)
  , m_passivity(setup.passivity.value_or(haptics::PassivityGuard::Parameters()))
  , m_mapping(setup.center)
  , m_thrust(setup.stiffness, setup.burrPoints)
  , m_traverse(setup.stiffness)
{
}

// Fills the step and the record's fault from the input.
Servo::Step Servo::judge(const TickInput& input) noexcept
{
  Step step;
  const ServoParameters& p = input.parameters;
  const DeviceGuard::Judgement judgement = m_guard.judge(input.reading(), input.now);
  m_record.verdict = static_cast<std::uint8_t>(judgement.verdict);
  ServoFault fault = ServoFault::None;
  const double past = input.now - m_time;
  if (!judgement.usable)
  {
    fault = ServoFault::Device;
    m_record.verdictValue = judgement.value;
  }
  else if (!std::isfinite(input.now) || (m_hasTime && past < 0.0))
    fault = ServoFault::Clock;
  else if (!p.valid())
    fault = ServoFault::Parameters;
  else if (m_hasTime && past > m_setup.stallAfter)
    fault = ServoFault::Stalled;
  step.usable = fault == ServoFault::None || fault == ServoFault::Stalled;
  m_record.fault = static_cast<std::uint8_t>(fault);

  step.device = judgement.pose;
  const double* q = p.camera;
  step.view = {{q[0], q[1], q[2], q[3]}, p.scale};
  step.clutch = input.clutched();
  const bool led = step.usable && !step.clutch;
  step.pressed = led && (p.constantThrust & ServoParameters::kPressed) != 0;
  step.pointer = led && (p.constantThrust & ServoParameters::kPointer) != 0;
  if (std::isfinite(input.now))
  {
    step.dt = m_hasTime ? std::clamp(past, 0.0, kMaxStep) : 0.0;
    m_time = input.now;
    m_hasTime = true;
  }
  return step;
}

void Servo::map(Step& step, bool anew) noexcept
{
  if (!m_placed && step.usable)
  {
    step.mapped = m_mapping.map(step.device, step.view);
    // A wheel's tool also starts in front of the tissue, and continues from there.
    const bool byWheel = m_record.input.parameters.driftLimit > 0.0F &&
                         Eigen::Map<const Eigen::Vector3d>(m_record.input.parameters.approach) !=
                             Eigen::Vector3d::Zero();
    bool before = false;
    if (step.pointer || byWheel) // all positions at once: no force is rendered yet
      do
        before = placeAnew(step);
      while (!before && m_rest == 0);
    if (!before)
      m_proxy.place(step.mapped);
    else if (byWheel)
    {
      step.mapped = m_proxy.pose();
      m_mapping.hold(step.device, step.view, step.mapped);
    }
    m_placed = true;
    return;
  }
  // With a set thrust the position is absolute and needs no anchor for safety.
  if (step.usable && !step.clutch && (!anew || m_record.input.parameters.constantThrust))
  {
    step.mapped = m_mapping.map(step.device, step.view);
    if (const double limit = static_cast<double>(m_record.input.parameters.driftLimit);
        limit > 0.0 && m_touches)
      limitDrift(step, limit);
    return;
  }
  step.mapped = m_proxy.pose();
  if (step.usable)
    m_mapping.hold(step.device, step.view, step.mapped);
}

void Servo::limitDrift(Step& step, double limit) noexcept
{
  const Pose& tool = m_proxy.pose();
  haptics::Motion drift = haptics::motionBetween(tool, step.mapped);
  const double distance = drift.linear.norm();
  const double angle = drift.angular.norm();
  if (distance <= limit && angle <= ServoParameters::kMaxTurn)
    return;
  if (distance > limit)
    drift.linear *= limit / distance;
  if (angle > ServoParameters::kMaxTurn)
    drift.angular *= ServoParameters::kMaxTurn / angle;
  step.mapped = haptics::moved(tool, drift);
  m_mapping.hold(step.device, step.view, step.mapped);
}

namespace
{

Eigen::Vector3d sightOf(const ServoParameters& p, const Pose& place) noexcept
{
  const Eigen::Vector3d given(p.approach[0], p.approach[1], p.approach[2]);
  const double length = given.stableNorm();
  return length > 0.0 ? Eigen::Vector3d(given / length)
                      : Eigen::Vector3d(-(place.rotation * Eigen::Vector3d::UnitZ()));
}

// Distance of a tool to its target, mm: to the part of the pick ray in front of the target, since
// tissue may keep it from coming closer.
double distanceTo(const Pose& place, const Eigen::Vector3d& tool,
                  const Eigen::Vector3d& sight) noexcept
{
  const Eigen::Vector3d offset = tool - place.position;
  const double before = std::min(sight.dot(offset), 0.0);
  return (offset - before * sight).norm();
}

} // namespace

bool Servo::isFar(const Step& step) const noexcept
{
  if (m_inside || m_traverse.stuck())
    return true;
  const Eigen::Vector3d sight = sightOf(m_record.input.parameters, step.mapped);
  return distanceTo(step.mapped, m_proxy.pose().position, sight) > kFarthest;
}

// One position per tick once the tool is in use: testing whether a pose is free is expensive.
bool Servo::placeAnew(const Step& step) noexcept
{
  const Eigen::Vector3d sight = sightOf(m_record.input.parameters, step.mapped);
  const bool first = !m_placed || m_inside || m_traverse.stuck();
  const double now = distanceTo(step.mapped, m_proxy.pose().position, sight);
  Pose there = step.mapped;
  there.position = step.mapped.position - m_back * sight;
  const bool nearer = first || !(distanceTo(step.mapped, there.position, sight) + kNearer > now);
  const bool placed = nearer && m_proxy.placeFree(there);
  m_back = std::max(2.0 * m_back, kFirstBack);
  if (placed)
  {
    m_thrust = ConstantThrust(m_setup.stiffness, m_setup.burrPoints);
    m_traverse.forget();
    m_inside = m_touches = false;
  }
  else if (!nearer || m_back > kLastBack)
    m_rest = kRest;
  if (placed || m_rest > 0)
    m_back = 0.0;
  return placed;
}

// A tool without progress is held, and the wrench includes the coupling's stretch, even where the
// contacts do not fully account for it.
void Servo::notifyStretch(const Eigen::Vector3d& stretch, const Eigen::Vector3d& way) noexcept
{
  const double rendered = m_record.wrench.wrench().linear.norm();
  const double pulls =
      std::min(m_setup.stiffness * stretch.norm(), m_record.input.parameters.thrust);
  const bool holds = way.norm() <= kNoWay && stretch.norm() > kAtGoal && !m_inside;
  if (!holds || !(pulls > rendered))
    return;
  const Eigen::Vector3d force = -pulls / stretch.norm() * stretch;
  std::copy(force.data(), force.data() + 3, m_record.wrench.force);
}

// A pointer leaps, and the tool follows it through whatever lies between: it must not drill there.
// A tool that tissue holds has arrived if the burr covers the pick ray.
void Servo::awaitArrival(const Step& step, bool wanted, const Eigen::Vector3d& way) noexcept
{
  const Eigen::Vector3d& tool = m_proxy.pose().position;
  if (!wanted || !step.pointer)
  {
    m_arrived = false;
    m_stillFor = 0.0;
    m_stillAt = tool;
    return;
  }
  m_stillFor += step.dt;
  if ((tool - m_stillAt).norm() > kTremble)
  {
    m_stillFor = 0.0;
    m_stillAt = tool;
  }
  const bool held = m_touches && (way.norm() < kHeld || m_stillFor > kTrembled);
  const ServoParameters& p = m_record.input.parameters;
  const Eigen::Vector3d sight = sightOf(p, step.mapped);
  const Eigen::Vector3d offset = tool - step.mapped.position;
  const double beside = (offset - sight.dot(offset) * sight).norm();
  const double reach = Eigen::Map<const Eigen::Vector3d>(p.approach).stableNorm();
  m_arrived = m_arrived || beside <= kArrived || (held && beside <= reach);
}

// Goal of the proxy.
Pose Servo::goalOf(const Step& step) noexcept
{
  const ServoParameters& p = m_record.input.parameters;
  const Eigen::Vector3d approach(p.approach[0], p.approach[1], p.approach[2]);
  if (step.pressed)
    return m_thrust.goal(step.mapped, m_proxy.pose(), approach, p.thrust, p.approachSpeed, step.dt);
  if (step.pointer)
    return m_traverse.goal(step.mapped, m_proxy.pose(), approach, p.thrust, step.dt);
  return step.mapped;
}

// Records the fraction `share` of the contact forces.
void Servo::reportContacts(const ProxyTick& tick, double share) noexcept
{
  Eigen::Vector3d force = Eigen::Vector3d::Zero();
  const Eigen::Vector3d spindle = tick.pose.rotation * Eigen::Vector3d::UnitZ();
  double weight = 0.0;
  double radius = 0.0;
  double all = 0.0;
  double shaft = 0.0;
  double handpiece = 0.0;
  for (std::size_t n = 0; n < tick.contactCount; ++n)
  {
    const haptics::ProxyContact& contact = tick.contacts[n];
    all += contact.thrust;
    if (contact.point >= m_setup.burrPoints)
    {
      const bool byShaft = contact.arm.dot(spindle) < m_setup.handpiece - kFace;
      (byShaft ? shaft : handpiece) += contact.thrust;
      continue;
    }
    force += share * contact.thrust * contact.normal;
    weight += contact.thrust;
    radius += contact.thrust * (contact.arm - contact.arm.dot(spindle) * spindle).norm();
  }
  const double length = force.norm();
  m_record.contactRadius = weight > 0.0 ? radius / weight : 0.0;
  m_record.elevation =
      length > 0.0 ? std::asin(std::clamp(force.dot(spindle) / length, -1.0, 1.0)) : 0.0;
  for (int axis = 0; axis < 3; ++axis)
    m_record.burrForce[axis] = force[axis];
  m_record.proxy = PoseValues::of(tick.pose);
  m_record.wrench = WrenchValues::of({share * tick.wrench.linear, share * tick.wrench.angular});
  m_record.thrust = share * tick.thrust;
  if (shaft > kHeldShare * all)
    m_record.held |= TickRecord::kShaft;
  if (handpiece > kHeldShare * all)
    m_record.held |= TickRecord::kHandpiece;
  m_record.penetration = tick.penetration;
  m_record.maskState = tick.maskState;
  m_record.contacts = static_cast<std::uint16_t>(tick.contactCount);
  m_record.status = static_cast<std::uint8_t>(tick.status);
}

void Servo::giveForce(const Step& step, const haptics::Wrench& wrench, bool anew) noexcept
{
  const bool give = step.usable && !m_record.input.parameters.pause;
  if (!give)
    m_limits.fault();
  else if (!m_giving || anew)
    m_limits.resume();
  m_giving = give;
  haptics::Wrench wanted;
  const double now = m_record.input.now;
  if (give)
    wanted = m_mapping.toHand(wrench, m_record.input.parameters.forceGain);
  if (give && m_setup.passivity)
    wanted = m_passivity.apply(wanted, step.device, now);
  const haptics::Wrench output = m_limits.apply(wanted, now);
  if (m_setup.passivity)
    m_passivity.sent(output);
  m_record.output = WrenchValues::of(output);
}

const TickRecord& Servo::tick(const TickInput& input) noexcept
{
  const ServoParameters& p = input.parameters;
  m_record = TickRecord();
  m_record.number = m_number++;
  m_record.input = input;
  if ((p.drill & ServoParameters::kPedalSpeed) != 0)
  {
    // With hysteresis: a foot that trembles does not divide a stroke. A replay gives the same.
    const double on = m_pedalOn ? ServoParameters::kOffPressure : ServoParameters::kOnPressure;
    m_pedalOn = input.pedal >= on; // false for NaN
    if (!m_pedalOn)
      m_record.input.pedal = 0.0;
  }

  Step step = judge(input);
  bool anew = m_record.fault == static_cast<std::uint8_t>(ServoFault::Stalled) ||
              (step.usable && !m_wasUsable);
  m_wasUsable = step.usable;
  map(step, anew);
  m_record.mapped = PoseValues::of(step.mapped);

  m_rest = std::max(m_rest - 1, 0);
  const bool far = step.pointer && m_rest == 0 && isFar(step);
  if (!far)
    m_back = 0.0;
  const bool leapt = far && placeAnew(step);
  anew = anew || leapt;
  const Eigen::Vector3d before = m_proxy.pose().position;
  const Pose goal = leapt ? m_proxy.pose() : goalOf(step);
  const ProxyTick& tick = m_placed ? m_proxy.step(goal) : m_none;
  m_postponed = tick.postponed;
  m_touches = tick.contactCount > 0;
  m_inside = tick.status == ProxyStatus::Inside;
  if (step.usable)
  {
    m_thrust.see(tick, p.approachSpeed, step.dt);
    m_traverse.see(tick);
  }
  // A tool that meets tissue on its way does not press with the rest of its motion in that tick.
  const double force = tick.wrench.linear.norm();
  const bool bounded = (step.pressed || step.pointer) && force > p.thrust;
  reportContacts(tick, bounded ? p.thrust / force : 1.0);
  if (step.pressed || step.pointer)
    notifyStretch(goal.position - tick.pose.position, before - tick.pose.position);

  ServoFault fault = static_cast<ServoFault>(m_record.fault);
  if (tick.status == ProxyStatus::Retreated)
  {
    // The device is deep in restored tissue: re-anchor at its present pose.
    anew = true;
    if (step.usable && !p.constantThrust)
      m_mapping.hold(step.device, step.view, tick.pose);
    fault = fault == ServoFault::None ? ServoFault::Retreated : fault;
  }
  else if (!tick.wrench.finite() || tick.status == ProxyStatus::BadGoal)
    fault = fault == ServoFault::None ? ServoFault::Wrench : fault;
  else if (tick.status == ProxyStatus::Inside)
    fault = fault == ServoFault::None ? ServoFault::Inside : fault;
  m_record.fault = static_cast<std::uint8_t>(fault);

  giveForce(step, m_record.wrench.wrench(), anew);
  const bool wanted = m_record.input.drillWanted();
  awaitArrival(step, wanted, tick.pose.position - before);
  const bool waits = step.pointer && !m_arrived;
  m_record.drill = wanted && !waits && m_giving && !step.clutch && fault == ServoFault::None;
  return m_record;
}

} // namespace petrous::session
