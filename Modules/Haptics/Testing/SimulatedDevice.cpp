#include "SimulatedDevice.h"

#include <algorithm>
#include <cmath>
#include <random>
#include <string>
#include <utility>

#include "petrous/Core/Error.h"

namespace petrous::haptics
{

namespace
{

using Eigen::Vector3d;

constexpr double kPi = 3.14159265358979323846;
constexpr double kMilli = 1000.0; // N = kg mm/s^2 / 1000
constexpr double kMaxLeap = 1.0;  // s
constexpr double kSlowest = 8.0;  // Hz, physiological tremor
constexpr double kFastest = 12.0; // Hz

void check(bool holds, const char* what)
{
  if (!holds)
    throw core::InvalidParameter(std::string("simulated device: ") + what);
}

bool positive(double value)
{
  return value > 0.0 && std::isfinite(value);
}

bool notNegative(double value)
{
  return value >= 0.0 && std::isfinite(value);
}

// The velocity after a sub-step. `pull` acts on the body at its position, N or N mm; `way` is the
// target's change.
Vector3d nextVelocity(const Vector3d& velocity, const Vector3d& pull, const Vector3d& way,
                      double damping, double inertia, double step) noexcept
{
  const double scale = kMilli / inertia;
  return (velocity + scale * (step * pull + damping * way)) / (1.0 + scale * step * damping);
}

} // namespace

DeviceDescription SimulatedDevice::usualDescription()
{
  DeviceDescription description;
  description.name = "Simulated device";
  description.givesForce = true;
  description.givesTorque = true;
  description.maxForce = 10.0;
  description.maxTorque = 500.0;
  description.maxStiffness = 1.0;
  description.maxAngularStiffness = 2000.0;
  return description;
}

SimulatedDevice::SimulatedDevice(Target target)
  : SimulatedDevice(std::move(target), Hand(), Faults())
{
}

SimulatedDevice::SimulatedDevice(Target target, const Hand& hand, const Faults& faults,
                                 DeviceDescription description)
  : m_target(std::move(target))
  , m_hand(hand)
  , m_faults(faults)
  , m_description(std::move(description))
{
  check(static_cast<bool>(m_target), "a target is needed");
  check(positive(hand.mass), "the mass must be above 0 kg");
  check(positive(hand.inertia), "the inertia must be above 0 kg mm^2");
  check(notNegative(hand.stiffness), "the hand's stiffness must not be below 0 N/mm");
  check(notNegative(hand.damping), "the hand's damping must not be below 0 N s/mm");
  check(notNegative(hand.friction), "the friction must not be below 0 N");
  check(notNegative(hand.angularStiffness),
        "the hand's angular stiffness must not be below 0 N mm/rad");
  check(notNegative(hand.angularDamping),
        "the hand's angular damping must not be below 0 N mm s/rad");
  check(notNegative(hand.tremor), "the tremor must not be below 0 mm");
  check(hand.subStep >= 1e-6 && hand.subStep <= 1e-2,
        "the sub-step must lie between 1e-6 and 0.01 s");
  check(notNegative(faults.stallFor), "a stall must not be shorter than 0 s");
  std::mt19937 random(hand.seed);
  const auto share = [&random] { return static_cast<double>(random()) / 4294967296.0; };
  for (auto& axis : m_tremor)
    for (std::size_t k = 0; k < kWaves; ++k)
    {
      // One wave in each eighth of the band, so that every seed covers all of it.
      const double hertz = kSlowest + (kFastest - kSlowest) * (static_cast<double>(k) + share()) /
                                          static_cast<double>(kWaves);
      axis[k] = {2.0 * kPi * hertz, 2.0 * kPi * share()};
    }
}

Pose SimulatedDevice::wantedAt(double time) const noexcept
{
  Pose wanted = m_target(time);
  wanted.rotation.normalize();
  if (m_hand.tremor == 0.0)
    return wanted;
  const double amplitude = m_hand.tremor * std::sqrt(2.0 / static_cast<double>(kWaves));
  for (int axis = 0; axis < 3; ++axis)
    for (const Wave& wave : m_tremor[static_cast<std::size_t>(axis)])
      wanted.position[axis] += amplitude * std::sin(wave.rate * time + wave.phase);
  return wanted;
}

void SimulatedDevice::advance(double from, double to) noexcept
{
  // Slightly less, so that a tick of 1 ms is ten sub-steps and not eleven by rounding.
  const double steps = std::max(1.0, std::ceil((to - from) / m_hand.subStep - 1e-6));
  const double step = (to - from) / steps;
  m_wanted = wantedAt(from); // differs from the last one only after a time jump
  for (double n = 1.0; n <= steps; n += 1.0)
  {
    const Pose wanted = wantedAt(from + n * step);
    const Motion way = motionBetween(m_wanted, wanted);
    const Motion apart = motionBetween(m_pose, m_wanted);
    m_wanted = wanted;
    m_velocity.linear =
        nextVelocity(m_velocity.linear, m_wrench.linear + m_hand.stiffness * apart.linear,
                     way.linear, m_hand.damping, m_hand.mass, step);
    // Friction stops the handle, it does not turn it back.
    const double speed = m_velocity.linear.norm();
    const double slower = kMilli / m_hand.mass * m_hand.friction * step;
    if (slower > 0.0)
      m_velocity.linear *= speed > slower ? 1.0 - slower / speed : 0.0;
    m_velocity.angular =
        nextVelocity(m_velocity.angular, m_wrench.angular + m_hand.angularStiffness * apart.angular,
                     way.angular, m_hand.angularDamping, m_hand.inertia, step);
    m_pose = moved(m_pose, m_velocity, step);
  }
}

DeviceReading SimulatedDevice::read(double now) noexcept
{
  if (!m_started && std::isfinite(now))
  {
    m_started = true;
    m_time = now;
    m_wanted = m_pose = wantedAt(now);
  }
  if (now >= m_faults.unplugAt)
    m_wrench = {};
  if (now > m_time && std::isfinite(now))
  {
    advance(std::max(m_time, now - kMaxLeap), now);
    m_time = now;
  }

  if (now >= m_faults.stallFrom && now < m_faults.stallFrom + m_faults.stallFor)
    return m_last;
  DeviceReading reading;
  reading.time = now;
  reading.pose = m_pose;
  reading.buttons = m_buttons;
  reading.pedal = m_pedal;
  reading.health = m_started ? DeviceHealth::Good : DeviceHealth::NotReady;
  if (now >= m_faults.jumpFrom)
    reading.pose.position += m_faults.jump;
  if (now >= m_faults.nanFrom)
    reading.pose.position.setConstant(std::numeric_limits<double>::quiet_NaN());
  if (now >= m_faults.repeatFrom)
    reading.time = m_faults.repeatFrom;
  if (now >= m_faults.backwardFrom)
    reading.time = 2.0 * m_faults.backwardFrom - now;
  if (now >= m_faults.unplugAt)
    reading.health = DeviceHealth::Disconnected;
  m_last = reading;
  return reading;
}

void SimulatedDevice::send(const Wrench& wrench) noexcept
{
  m_wrench = wrench.finite() ? wrench : Wrench{};
}

void SimulatedDevice::press(std::uint32_t buttons, double pedal) noexcept
{
  m_buttons = buttons;
  m_pedal = pedal;
}

} // namespace petrous::haptics
