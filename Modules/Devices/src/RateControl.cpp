#include "petrous/Devices/RateControl.h"

#include <algorithm>
#include <cmath>

#include "petrous/Core/Error.h"
#include "petrous/Core/NumberText.h"

namespace petrous::devices
{

namespace
{

constexpr double kShortestRamp = 0.004; // s
constexpr double kMaxRamp = 0.020;      // s
constexpr double kMaxStep = 0.1;        // s

void require(double value, double least, double most, const char* name)
{
  if (value >= least && value <= most)
    return;
  throw core::InvalidParameter(std::string("rate control: ") + name + " is " +
                               core::plainText(value) + "; it must lie in [" +
                               core::plainText(least) + ", " + core::plainText(most) + "]");
}

} // namespace

RateControl::RateControl(const Parameters& parameters)
  : m_parameters(parameters)
{
  require(parameters.speed, 0.0, 1000.0, "speed (mm/s)");
  require(parameters.turnRate, 0.0, 20.0, "turn rate (rad/s)");
  require(parameters.deadZone, 0.0, 0.9, "dead zone");
  require(parameters.exponent, 1.0, 4.0, "exponent");
  require(parameters.timeout, 0.02, 10.0, "timeout (s)");
  require(parameters.reach, 1.0, 1e6, "reach (mm)");
}

haptics::Motion RateControl::rateOf(const SpaceMouseState& state) const noexcept
{
  const auto shaped = [this](const Eigen::Vector3d& u, double gain) -> Eigen::Vector3d
  {
    const double length = u.norm();
    const double d = m_parameters.deadZone;
    if (length <= d)
      return Eigen::Vector3d::Zero();
    const double share = (std::min(length, 1.0) - d) / (1.0 - d);
    return gain * std::pow(share, m_parameters.exponent) / length * u;
  };
  return {shaped(state.translation(), m_parameters.speed),
          shaped(state.rotation(), m_parameters.turnRate)};
}

haptics::Motion RateControl::rateAt(double now) const noexcept
{
  const double share =
      m_rampTime > 0.0 ? std::clamp((now - m_rampStart) / m_rampTime, 0.0, 1.0) : 1.0;
  return {m_from.linear + share * (m_to.linear - m_from.linear),
          m_from.angular + share * (m_to.angular - m_from.angular)};
}

void RateControl::rampTo(const haptics::Motion& rate, double now, double duration) noexcept
{
  m_from = rateAt(now);
  m_to = rate;
  m_rampStart = now;
  m_rampTime = duration;
}

void RateControl::setDeflection(const SpaceMouseState& state, double now) noexcept
{
  // The longer of the last two intervals: translation and rotation may arrive as a pair of reports
  // in immediate succession.
  const double interval = std::clamp(now - m_reportTime, kShortestRamp, kMaxRamp);
  rampTo(rateOf(state), now, std::max(interval, m_interval));
  m_interval = interval;
  m_reportTime = now;
  m_deflected = state.deflected();
}

void RateControl::stop() noexcept
{
  m_from = {};
  m_to = {};
  m_rampTime = 0.0;
  m_deflected = false;
}

bool RateControl::silent(double now) const noexcept
{
  return m_deflected && now - m_reportTime > m_parameters.timeout;
}

const haptics::Pose& RateControl::advance(double now) noexcept
{
  if (silent(now) && (!m_to.linear.isZero(0.0) || !m_to.angular.isZero(0.0)))
    rampTo({}, now, kMaxRamp);

  const haptics::Motion rate = rateAt(now);
  // The mean of both ends: exact for a linear ramp.
  const double step = std::clamp(now - m_now, 0.0, kMaxStep);
  if (m_now > -1e9 && step > 0.0)
  {
    const haptics::Motion mean{0.5 * (m_rate.linear + rate.linear),
                               0.5 * (m_rate.angular + rate.angular)};
    m_pose = haptics::moved(m_pose, mean, step);
    m_pose.position = m_pose.position.cwiseMax(-m_parameters.reach).cwiseMin(m_parameters.reach);
  }
  m_rate = rate;
  m_now = std::max(m_now, now);
  return m_pose;
}

} // namespace petrous::devices
