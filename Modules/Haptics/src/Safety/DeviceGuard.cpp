#include "petrous/Haptics/DeviceGuard.h"

#include <algorithm>
#include <cmath>

#include "petrous/Core/Error.h"
#include "petrous/Core/NumberText.h"

namespace petrous::haptics
{

namespace
{

// Readings closer in time than this are judged as if that far apart: position noise divided by a
// tiny interval would be a high speed.
constexpr double kShortestTick = 1e-3; // s

void check(bool holds, const char* what)
{
  if (!holds)
    throw core::InvalidParameter(std::string("device guard: ") + what);
}

bool positive(double value)
{
  return value > 0.0 && std::isfinite(value);
}

} // namespace

DeviceGuard::DeviceGuard(const Limits& limits)
  : m_limits(limits)
{
  check(positive(limits.speed), "the largest speed must be above 0 mm/s");
  check(positive(limits.angularSpeed), "the largest angular speed must be above 0 rad/s");
  check(positive(limits.reach), "the reach must be above 0 mm");
  check(positive(limits.staleAfter), "readings must be stale after more than 0 s");
  check(positive(limits.unitTolerance), "the quaternion's tolerance must be above 0");
  check(limits.goodTicks >= 1, "at least 1 good reading is needed");
}

DeviceVerdict DeviceGuard::verdictOn(const DeviceReading& reading, double now,
                                     double& value) noexcept
{
  switch (reading.health)
  {
  case DeviceHealth::Good:
    break;
  case DeviceHealth::NotReady:
    return DeviceVerdict::NotReady;
  case DeviceHealth::Stale:
    return DeviceVerdict::Stale;
  case DeviceHealth::Disconnected:
    return DeviceVerdict::Disconnected;
  case DeviceHealth::Faulty:
    return DeviceVerdict::Faulty;
  }
  const Pose& pose = reading.pose;
  if (!std::isfinite(reading.time) || !std::isfinite(now) || !pose.position.allFinite() ||
      !pose.rotation.coeffs().allFinite())
    return DeviceVerdict::NotFinite;
  const double age = now - reading.time;
  value = age;
  if (age > m_limits.staleAfter)
    return DeviceVerdict::Stale;
  if (age < -m_limits.staleAfter)
    return DeviceVerdict::TimeAhead;
  if (m_hasLatest && reading.time == m_time)
    return DeviceVerdict::Repeated;
  if (m_hasLatest && reading.time < m_time)
  {
    value = m_time - reading.time;
    return DeviceVerdict::TimeBackward;
  }
  value = pose.rotation.norm();
  if (!(std::abs(value - 1.0) <= m_limits.unitTolerance))
    return DeviceVerdict::NotUnit;
  value = pose.position.stableNorm();
  if (!(value <= m_limits.reach))
    return DeviceVerdict::OutOfReach;
  if (!m_hasLatest)
    return DeviceVerdict::Good;
  const double tick = std::max(reading.time - m_time, kShortestTick);
  const Motion motion = motionBetween(m_latest, {pose.position, pose.rotation.normalized()});
  value = motion.linear.norm();
  if (!(value <= m_limits.speed * tick))
    return DeviceVerdict::Jump;
  value = 0.0;
  const bool turnsAsHandsDo = motion.angular.norm() <= m_limits.angularSpeed * tick;
  return turnsAsHandsDo ? DeviceVerdict::Good : DeviceVerdict::Jump;
}

DeviceGuard::Judgement DeviceGuard::judge(const DeviceReading& reading, double now) noexcept
{
  Judgement result;
  result.verdict = verdictOn(reading, now, result.value);
  const bool sound = result.verdict == DeviceVerdict::Good;
  const bool repeated = result.verdict == DeviceVerdict::Repeated;
  const bool elsewhere =
      result.verdict == DeviceVerdict::Jump || result.verdict == DeviceVerdict::TimeBackward;
  if (sound || elsewhere) // after a jump the next reading is compared with this one
  {
    m_latest = {reading.pose.position, reading.pose.rotation.normalized()};
    m_time = reading.time;
  }
  if (!repeated)
    m_hasLatest = sound || elsewhere;

  if (sound)
    m_sound = std::min(m_sound + 1, m_limits.goodTicks);
  else if (!repeated)
    m_sound = 0;
  m_usable = m_sound == m_limits.goodTicks;
  if (sound && m_usable)
    m_good = m_latest;
  if ((sound || repeated) && !m_usable)
  {
    result.verdict = DeviceVerdict::Settling;
    result.value = m_limits.goodTicks - m_sound;
  }
  result.pose = m_good;
  result.usable = m_usable;
  return result;
}

const char* toString(DeviceVerdict verdict) noexcept
{
  switch (verdict)
  {
  case DeviceVerdict::Good:
    return "The device works.";
  case DeviceVerdict::Repeated:
    return "The device works; it sent nothing new in this tick.";
  case DeviceVerdict::Settling:
    return "The device is back; the force returns when it has been steady for a moment.";
  case DeviceVerdict::NotReady:
    return "The device is connected and has sent nothing yet.";
  case DeviceVerdict::NotFinite:
    return "The device sent a position or time that is not a number.";
  case DeviceVerdict::NotUnit:
    return "The device sent an invalid rotation.";
  case DeviceVerdict::OutOfReach:
    return "The device sent a position farther away than any hand reaches.";
  case DeviceVerdict::TimeBackward:
    return "The device's clock went back.";
  case DeviceVerdict::TimeAhead:
    return "The device's clock is ahead of the computer's.";
  case DeviceVerdict::Stale:
    return "The device has sent nothing new for too long.";
  case DeviceVerdict::Jump:
    return "The device's handle jumped, faster than a hand moves.";
  case DeviceVerdict::Disconnected:
    return "The device is not connected.";
  case DeviceVerdict::Faulty:
    return "The device reports a fault.";
  }
  return "The device is in an unknown state.";
}

std::string toString(const DeviceGuard::Judgement& judgement)
{
  // No number for a rotation, nor if the device itself reports that it is stale.
  const double value = judgement.value;
  if (value == 0.0)
    return toString(judgement.verdict);
  switch (judgement.verdict)
  {
  case DeviceVerdict::Jump:
    return "The device's handle jumped by " + core::fixedText(value, 1) +
           " mm from one reading to the next, faster than a hand moves.";
  case DeviceVerdict::Stale:
    return "The device has sent nothing new for " + core::fixedText(1000.0 * value, 0) + " ms.";
  case DeviceVerdict::TimeBackward:
    return "The device's clock went back by " + core::fixedText(1000.0 * value, 1) + " ms.";
  case DeviceVerdict::TimeAhead:
    return "The device's clock is " + core::fixedText(-1000.0 * value, 0) +
           " ms ahead of the computer's.";
  case DeviceVerdict::NotUnit:
    return "The device sent an invalid rotation: its quaternion's length is " +
           core::plainText(value, 3) + ".";
  case DeviceVerdict::OutOfReach:
    return "The device sent a position " + core::plainText(value, 3) +
           " mm away, farther than any hand reaches.";
  default:
    return toString(judgement.verdict);
  }
}

} // namespace petrous::haptics
