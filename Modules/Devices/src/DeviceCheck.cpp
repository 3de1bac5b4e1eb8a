#include "petrous/Devices/DeviceCheck.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "petrous/Core/Error.h"

namespace petrous::devices
{

using haptics::DeviceHealth;
using haptics::DeviceReading;
using haptics::Wrench;

namespace
{

constexpr double kPi = 3.14159265358979323846;

constexpr double kLostFor = 0.5;  // s without a good reading
constexpr double kFaultFor = 5.0; // s of a fault: forces that a driver cut return in up to 3 s

// Speed, by two readings at least so far apart that it does not matter when they came.
constexpr double kTooFast = 500.0;      // mm/s
constexpr double kSpeedWindow = 0.0045; // s

// Rest before a step.
constexpr double kRest = 1.0;       // s
constexpr double kRestWithin = 1.0; // mm
constexpr double kRestLimit = 20.0; // s to wait for it

// Step of force.
constexpr double kRise = 0.02;        // s
constexpr double kHold = 0.15;        // s, with the rise
constexpr double kMoved = 0.05;       // mm
constexpr double kMain = 0.7;         // of the motion, along the axis
constexpr double kAgainst = 2.0;      // mm against the force: ends the check
constexpr double kAgainstAtEnd = 0.3; // mm, likewise; a tremor would be as large in between

// Ramp.
constexpr double kLeast = 0.1;      // N/mm
constexpr double kGrowth = 1.15;    // a level
constexpr double kLevel = 0.4;      // s
constexpr double kTapRise = 25.0;   // N/s
constexpr double kTapWay = 0.5;     // mm
constexpr double kTapFor = 0.06;    // s, at most
constexpr double kSettle = 0.12;    // s
constexpr double kCorner = 25.0;    // Hz, of the high-passes
constexpr double kCycle = 0.05;     // N
constexpr double kDecay = 0.85;     // of the first half's amplitude
constexpr int kChanges = 3;         // of sign in half the time
constexpr double kPulledFor = 0.1;  // s at the cap
constexpr int kMaxRestarts = 20;    // of one axis, also of its step
constexpr double kLargestCap = 3.0; // N
constexpr double kCapShare = 0.6;   // of the device's maximum
constexpr double kMargin = 0.5;     // proposed stiffness / largest that was stable
constexpr std::size_t kTrips = 100000;

const DeviceCheck::Options& checked(const DeviceCheck::Options& options)
{
  const auto check = [](bool good, const char* what)
  {
    if (!good)
      throw core::InvalidParameter(std::string("device test: ") + what);
  };
  check(options.readyTime > 0.0 && std::isfinite(options.readyTime),
        "the time to wait for the device must be above 0 s");
  check(options.workspaceTime >= 0.5 && std::isfinite(options.workspaceTime),
        "the time for the workspace must be 0.5 s or more");
  check(options.stepForce > 0.0 && std::isfinite(options.stepForce),
        "the step of force must be above 0 N");
  check(options.maxStiffness >= kLeast && options.maxStiffness <= 20.0,
        "the ramp must end between 0.1 and 20 N/mm");
  return options;
}

} // namespace

DeviceCheck::DeviceCheck(const haptics::DeviceDescription& description, const Options& options)
  : m_description(description)
  , m_options(checked(options))
  , m_stepForce(std::min(options.stepForce, 0.25 * description.maxForce))
  , m_forceCap(std::min(kLargestCap, kCapShare * description.maxForce))
{
  m_result.roundTrips.reserve(kTrips);
}

double DeviceCheck::progress() const noexcept
{
  const double whole = std::log(m_options.maxStiffness / kLeast);
  const double ramp = m_stiffness > 0.0 ? std::log(m_stiffness / kLeast) / whole : 0.0;
  switch (m_stage)
  {
  case Stage::Ready:
    return 0.0;
  case Stage::Workspace:
    return 0.2 * std::min(1.0, (m_lastTime - m_since) / m_options.workspaceTime);
  case Stage::Rest:
  case Stage::ForceStep:
    return 0.2 + 0.1 * m_axis / 3.0;
  case Stage::Stiffness:
    return 0.3 + 0.7 * (m_axis + ramp) / 3.0;
  case Stage::Done:
    break;
  }
  return 1.0;
}

void DeviceCheck::end(const std::string& problem) noexcept
{
  m_result.problem = problem;
  m_stage = Stage::Done;
}

void DeviceCheck::enter(Stage stage, int axis, double now) noexcept
{
  if (stage == Stage::Stiffness || (stage == Stage::Rest && axis != m_axis))
    m_restarts = 0;
  m_stage = stage;
  m_axis = axis;
  m_since = m_restSince = now;
  m_anchor = m_last;
  m_wasFast = false;
  if (stage == Stage::ForceStep)
    m_result.axes[static_cast<std::size_t>(axis)].latency = 0.0;
  if (stage == Stage::Stiffness)
  {
    m_stiffness = kLeast;
    beginLevel(now);
  }
}

void DeviceCheck::nextAxis(double now) noexcept
{
  int next = m_axis + 1;
  if (m_stage == Stage::ForceStep && next < 3)
    return enter(Stage::Rest, next, now);
  if (m_stage == Stage::ForceStep)
    next = 0;
  // A spring on an axis whose force goes elsewhere drives the handle away.
  while (next < 3 && !m_result.axes[static_cast<std::size_t>(next)].follows)
    ++next;
  if (next < 3)
    return enter(Stage::Stiffness, next, now);
  double least = m_options.maxStiffness;
  for (const Axis& axis : m_result.axes)
    least = std::min(least, axis.stable);
  m_result.proposed = kMargin * least;
  m_axis = next;
  m_stage = Stage::Done;
}

// At its beginning.
void DeviceCheck::fault(double now) noexcept
{
  if (m_stage == Stage::Ready)
    return;
  ++m_result.faults;
  if (m_stage != Stage::Stiffness)
    return;
  Axis& axis = m_result.axes[static_cast<std::size_t>(m_axis)];
  axis.limit = m_stiffness;
  axis.faulted = true;
  nextAxis(now);
}

// What was measured meanwhile, or without force, is void.
void DeviceCheck::comeBack(const DeviceReading& reading, double now) noexcept
{
  m_last = m_anchor = m_speedAt = reading.pose.position;
  m_speedTime = reading.time;
  m_wasFast = false;
  m_lastTime = now;
  if (m_stage == Stage::Ready)
    return enter(Stage::Workspace, 0, now);
  if (m_stage == Stage::Workspace)
    return;
  if (++m_restarts > kMaxRestarts)
    return end("the device's readings stopped again and again");
  if (m_stage == Stage::Stiffness)
    beginLevel(now);
  else
    enter(Stage::Rest, m_axis, now);
}

bool DeviceCheck::tooFast(const DeviceReading& reading) noexcept
{
  const double dt = reading.time - m_speedTime;
  if (dt < kSpeedWindow)
    return false;
  // A spring does not answer for what another axis still does.
  const Eigen::Vector3d moved = reading.pose.position - m_speedAt;
  const double way = m_stage == Stage::Stiffness ? std::abs(moved[m_axis]) : moved.norm();
  // Twice: one late reading makes a jump of what came before it.
  const bool before = std::exchange(m_wasFast, way > kTooFast * dt);
  m_speedAt = reading.pose.position;
  m_speedTime = reading.time;
  return before && m_wasFast;
}

// Extent, rate and buttons, in every stage without force.
void DeviceCheck::roam(const DeviceReading& reading, double now) noexcept
{
  if (m_readings == 0)
  {
    m_first = reading.pose;
    m_result.lowest = m_result.highest = reading.pose.position;
    m_firstReading = m_lastReading = reading.time;
    m_readings = 1;
  }
  if (reading.time > m_lastReading)
  {
    m_result.worstGap = std::max(m_result.worstGap, reading.time - m_lastReading);
    m_lastReading = reading.time;
    ++m_readings;
  }
  m_result.lowest = m_result.lowest.cwiseMin(reading.pose.position);
  m_result.highest = m_result.highest.cwiseMax(reading.pose.position);
  m_result.turned =
      std::max(m_result.turned, haptics::motionBetween(m_first, reading.pose).angular.norm());
  m_result.buttons |= reading.buttons;
  m_result.pedal = std::max(m_result.pedal, reading.pedal);
  if (now - m_since < m_options.workspaceTime)
    return;
  const double time = m_lastReading - m_firstReading;
  m_result.rate = time > 0.0 ? (m_readings - 1) / time : 0.0;
  if (m_options.force && m_description.givesForce)
    enter(Stage::Rest, 0, now);
  else
    m_stage = Stage::Done;
}

void DeviceCheck::rest(const Eigen::Vector3d& position, double now) noexcept
{
  if ((position - m_anchor).norm() > kRestWithin)
  {
    m_anchor = position;
    m_restSince = now;
  }
  if (now - m_restSince >= kRest)
    enter(Stage::ForceStep, m_axis, now);
  else if (now - m_since > kRestLimit)
    end("the handle does not rest; hold it lightly in the middle, and keep it still");
}

// N along the present axis.
double DeviceCheck::step(const DeviceReading& reading, double now) noexcept
{
  const double time = now - m_since;
  Axis& axis = m_result.axes[static_cast<std::size_t>(m_axis)];
  const Eigen::Vector3d moved = reading.pose.position - m_anchor;
  const bool ends = tooFast(reading) || time >= kHold;
  axis.moved = moved;
  if (axis.latency == 0.0 && std::abs(moved[m_axis]) > kMoved)
    axis.latency = time;
  if (moved[m_axis] < (ends ? -kAgainstAtEnd : -kAgainst) && -moved[m_axis] > kMain * moved.norm())
  {
    end(std::string("the handle moved against the force along ") + "xyz"[m_axis] +
        ": do not use the device");
    return 0.0;
  }
  if (!ends)
    return m_stepForce * std::min(1.0, time / kRise);
  axis.follows = moved[m_axis] > kMoved && moved[m_axis] > kMain * moved.norm();
  nextAxis(now);
  return 0.0;
}

void DeviceCheck::beginLevel(double now) noexcept
{
  m_since = now;
  m_amplitudes[0] = m_amplitudes[1] = 0.0;
  m_sign = 0.0;
  m_changes = 0;
  m_pulledSince = 0.0;
  m_tapped = false;
  m_tapAt = m_last[m_axis];
  m_capped = {false, false};
}

void DeviceCheck::judgeLevel(double now) noexcept
{
  Axis& axis = m_result.axes[static_cast<std::size_t>(m_axis)];
  // Wide swings under a capped force are slower than kChanges.
  const bool wide = m_capped[0] && m_capped[1];
  const bool cycles = m_fast || wide ||
                      (m_changes >= kChanges && m_amplitudes[1] > kCycle &&
                       m_amplitudes[1] > kDecay * m_amplitudes[0]);
  if (cycles)
  {
    axis.limit = m_stiffness;
    axis.hertz = m_fast ? 0.0 : m_changes / (kLevel - kSettle); // half the time, half a period each
    m_fast = false;
    nextAxis(now);
    return;
  }
  axis.stable = m_stiffness;
  if (m_stiffness >= m_options.maxStiffness)
  {
    nextAxis(now);
    return;
  }
  m_stiffness = std::min(kGrowth * m_stiffness, m_options.maxStiffness);
  beginLevel(now);
}

double DeviceCheck::spring(const DeviceReading& reading, double now) noexcept
{
  const Eigen::Vector3d& position = reading.pose.position;
  const double dt = now - m_lastTime;
  m_fast = tooFast(reading);
  if (m_fast || now - m_since >= kLevel)
  {
    const int axis = m_axis;
    judgeLevel(now);
    if (m_axis != axis)
      return 0.0;
  }
  const double time = now - m_since;
  m_tapped = m_tapped || time > kTapFor || std::abs(position[m_axis] - m_tapAt) > kTapWay;
  const double wanted = m_tapped ? -m_stiffness * (position[m_axis] - m_anchor[m_axis])
                                 : std::min(kTapRise * time, m_forceCap);
  const double force = std::clamp(wanted, -m_forceCap, m_forceCap);
  if (force == wanted)
    m_pulledSince = 0.0;
  else if (m_pulledSince == 0.0)
    m_pulledSince = now;
  else if (now - m_pulledSince > kPulledFor)
  {
    if (++m_restarts > kMaxRestarts)
    {
      end("the handle was pulled away again and again; hold it lightly where it is");
      return 0.0;
    }
    m_anchor = position;
    beginLevel(now);
    return 0.0;
  }

  double high = force;
  const double share = 1.0 - std::exp(-2.0 * kPi * kCorner * std::clamp(dt, 0.0, 0.01));
  for (double& low : m_low)
  {
    low += share * (high - low);
    high -= low;
  }
  const double half = 0.5 * (kSettle + kLevel);
  if (time < kSettle)
    return force;
  if (force != wanted)
    m_capped[force > 0.0 ? 1 : 0] = true;
  double& amplitude = m_amplitudes[time < half ? 0 : 1];
  amplitude = std::max(amplitude, std::abs(high));
  const double sign = high > 0.0 ? 1.0 : -1.0;
  if (time >= half && m_sign != 0.0 && sign != m_sign)
    ++m_changes;
  m_sign = sign;
  return force;
}

Wrench DeviceCheck::tick(const DeviceReading& reading, double now, double roundTrip) noexcept
{
  if (m_stage == Stage::Done || !std::isfinite(now))
    return {};
  if (!m_started)
  {
    m_started = true;
    m_since = m_lastGood = m_lastTime = now;
  }
  Wrench wrench;
  const bool good = reading.health == DeviceHealth::Good && reading.pose.finite();
  const bool faulty = reading.health == DeviceHealth::Faulty;
  if (faulty && !m_faulty)
    fault(now);
  if (m_stage != Stage::Ready && (good || faulty != m_faulty))
    m_lastGood = now;
  m_faulty = faulty;
  const bool back = good && !m_good;
  m_good = good;
  if (!good)
  {
    const double most = m_stage == Stage::Ready ? m_options.readyTime
                        : faulty                ? kFaultFor
                                                : kLostFor;
    if (m_stage != Stage::Done && now - m_lastGood > most)
      end(m_stage == Stage::Ready ? "no good reading came from the device" : "the device was lost");
    return wrench;
  }
  if (back)
    comeBack(reading, now);
  m_lastGood = now;
  if (roundTrip > 0.0 && m_result.roundTrips.size() < kTrips)
    m_result.roundTrips.push_back(roundTrip);
  const int axis = std::min(m_axis, 2);
  switch (m_stage)
  {
  case Stage::Workspace:
    roam(reading, now);
    break;
  case Stage::Rest:
    rest(reading.pose.position, now);
    break;
  // The axis of this force, whichever is next.
  case Stage::ForceStep:
    wrench.linear[axis] = step(reading, now);
    break;
  case Stage::Stiffness:
    wrench.linear[axis] = spring(reading, now);
    break;
  case Stage::Ready:
  case Stage::Done:
    break;
  }
  m_last = reading.pose.position;
  m_lastTime = now;
  return wrench;
}

} // namespace petrous::devices
