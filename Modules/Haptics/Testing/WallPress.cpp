#include "WallPress.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "petrous/Haptics/ForceLimits.h"
#include "petrous/Haptics/PassivityGuard.h"

namespace petrous::haptics
{

namespace
{

constexpr double kTick = 0.001; // s

SimulatedDevice::Hand handOf(const RealDevice& real, SimulatedDevice::Hand hand)
{
  hand.mass = real.mass;
  hand.damping = real.damping;
  hand.friction = real.friction;
  return hand;
}

} // namespace

MissedTicks::MissedTicks(const RealDevice& real)
  : m_every(real.dropEvery)
  , m_share(real.missed / real.burst)
  , m_burst(real.burst)
{
}

bool MissedTicks::operator()(int tick)
{
  if (m_every > 0 && tick % m_every == 0)
    return true;
  if (m_left == 0 && m_share > 0.0 && static_cast<double>(m_random()) < 4294967296.0 * m_share)
    m_left = m_burst;
  if (m_left == 0)
    return false;
  --m_left;
  return true;
}

TransmittedDevice::TransmittedDevice(const RealDevice& real, Target target, Hand hand)
  : SimulatedDevice(std::move(target), handOf(real, hand), {})
  , m_quantum(real.quantum)
  , m_underway(static_cast<std::size_t>(real.delay))
{
}

DeviceReading TransmittedDevice::read(double now) noexcept
{
  DeviceReading reading = SimulatedDevice::read(now);
  if (m_quantum > 0.0)
    for (double& x : reading.pose.position)
      x = m_quantum * std::round(x / m_quantum);
  return reading;
}

void TransmittedDevice::send(const Wrench& wrench) noexcept
{
  m_underway.push_back(wrench);
  SimulatedDevice::send(m_underway.front());
  m_underway.pop_front();
}

Touching press(const RealDevice& real, const WallPress& how)
{
  const double period = how.rest + 0.6; // s
  const auto target = [period](double time)
  {
    const double t = std::fmod(time, period);
    const double share = std::clamp(std::min(t - 0.1, period - 0.1 - t) / 0.2, 0.0, 1.0);
    return Pose{{2.0 - 8.0 * share, 0.0, 0.0}, Eigen::Quaterniond::Identity()};
  };
  SimulatedDevice::Hand hand;
  hand.tremor = how.tremor;
  hand.stiffness = how.handStiffness;
  hand.subStep = how.subStep;
  TransmittedDevice device(real, target, hand);
  PassivityGuard::Parameters parameters;
  parameters.stiffness = how.stiffness;
  PassivityGuard guard(parameters);
  ForceLimits::Limits limits;
  limits.maxForce = real.maxForce;
  ForceLimits limited(limits);
  limited.resume();

  MissedTicks misses(real);
  Touching result;
  constexpr double none = std::numeric_limits<double>::infinity();
  double low = none; // of this cycle
  double high = -none;
  device.read(0.0);
  double before = device.pose().position.x();
  double energy = 0.0; // of this cycle, which begins and ends before the wall
  int cycle = 0;
  for (int n = 1; n <= static_cast<int>((how.times + 0.001) * period / kTick); ++n)
  {
    const double now = kTick * n;
    const Pose pose = device.read(now).pose;
    const double x = device.pose().position.x();
    const double acting = device.sent().linear.x();
    energy += acting * (x - before) - real.friction * std::abs(x - before);
    before = x;
    if (const int present = static_cast<int>(now / period); present != cycle)
    {
      cycle = present;
      result.energyOut = std::max(result.energyOut, energy);
      result.ripple = std::max(result.ripple, 0.5 * (high - low));
      energy = 0.0;
      low = none;
      high = -none;
    }
    const double at = std::fmod(now, period);
    if (at > how.rest - 0.2 && at < how.rest + 0.2)
    {
      low = std::min(low, acting);
      high = std::max(high, acting);
    }
    result.mostForce = std::max(result.mostForce, std::abs(acting));
    if (misses(n))
      continue;
    Wrench wanted;
    wanted.linear.x() = how.stiffness * std::max(0.0, -pose.position.x());
    const Wrench passed = how.guarded ? guard.apply(wanted, pose, now) : wanted;
    result.changed = std::max(result.changed, std::abs(passed.linear.x() - wanted.linear.x()));
    const Wrench output = limited.apply(passed, now);
    guard.sent(output);
    device.send(output);
  }
  return result;
}

double passiveStiffness(const RealDevice& real) noexcept
{
  return real.damping / (kTick * (0.5 + real.delay));
}

double ringingStiffness(const RealDevice& real, WallPress how)
{
  how.guarded = false;
  double low = 0.05;
  double high = 100.0;
  while (high / low > 1.002)
  {
    how.stiffness = std::sqrt(low * high);
    (press(real, how).ripple <= Touching::kMostRipple ? low : high) = how.stiffness;
  }
  return low;
}

} // namespace petrous::haptics
