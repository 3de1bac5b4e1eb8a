#include "petrous/Haptics/ForceLimits.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "petrous/Core/Error.h"

namespace petrous::haptics
{

namespace
{

using Eigen::Vector3d;

constexpr double kTick = 1e-3; // s

void check(bool holds, const char* what)
{
  if (!holds)
    throw core::InvalidParameter(std::string("force limits: ") + what);
}

bool positive(double value)
{
  return value > 0.0 && std::isfinite(value);
}

Vector3d saturate(const Vector3d& wanted, double most, bool& noted) noexcept
{
  const double largest = wanted.cwiseAbs().maxCoeff();
  if (largest == 0.0)
    return wanted;
  // Scaled first: the square of a huge number overflows.
  const Vector3d scaled = wanted / largest;
  const double norm = scaled.norm();
  if (largest <= most / norm)
    return wanted;
  noted = true;
  return scaled * (most / norm);
}

Vector3d slew(const Vector3d& last, const Vector3d& target, double most, bool& noted) noexcept
{
  const Vector3d change = target - last;
  const double norm = change.norm();
  if (norm <= most)
    return target;
  noted = true;
  return last + change * (most / norm);
}

// Reduced to the length of `target` if that is shorter, in the direction of `last`.
Vector3d shrink(const Vector3d& last, const Vector3d& target) noexcept
{
  const double norm = last.norm();
  const double wanted = target.norm();
  return wanted < norm ? Vector3d(last * (wanted / norm)) : last;
}

} // namespace

ForceLimits::ForceLimits(const Limits& limits)
  : m_limits(limits)
{
  check(limits.maxForce >= 0.0 && std::isfinite(limits.maxForce),
        "the largest force must not be below 0 N");
  check(limits.maxTorque >= 0.0 && std::isfinite(limits.maxTorque),
        "the largest torque must not be below 0 N mm");
  check(positive(limits.forceSlew), "the force's slew rate must be above 0 N/s");
  check(positive(limits.torqueSlew), "the torque's slew rate must be above 0 N mm/s");
  check(positive(limits.fadeIn), "the force must fade in over more than 0 s");
  check(positive(limits.fadeOut), "the force must fade out over more than 0 s");
  check(positive(limits.maxStep), "the longest step must be above 0 s");
}

double ForceLimits::elapsed(double now) noexcept
{
  if (!std::isfinite(now))
    return 0.0;
  const double since = m_hasTime ? now - m_time : 0.0;
  m_time = now;
  m_hasTime = true;
  return std::clamp(since, 0.0, m_limits.maxStep);
}

Wrench ForceLimits::apply(const Wrench& wanted, double now) noexcept
{
  const double dt = elapsed(now);
  m_notes = {};
  m_notes.notFinite = !wanted.finite();
  if (m_stopped)
  {
    m_fade = std::max(0.0, m_fade - (dt > 0.0 ? dt : kTick) / m_limits.fadeOut);
    m_last = {m_fade * m_held.linear, m_fade * m_held.angular};
    return m_last;
  }
  if (m_notes.notFinite)
  {
    m_fade = 0.0;
    m_last = {};
    return m_last;
  }
  m_fade = std::min(1.0, m_fade + dt / m_limits.fadeIn);
  const Vector3d force = m_fade * saturate(wanted.linear, m_limits.maxForce, m_notes.saturated);
  const Vector3d torque = m_fade * saturate(wanted.angular, m_limits.maxTorque, m_notes.saturated);
  if (dt > 0.0)
    m_last = {slew(m_last.linear, force, m_limits.forceSlew * dt, m_notes.slewed),
              slew(m_last.angular, torque, m_limits.torqueSlew * dt, m_notes.slewed)};
  else
    m_last = {shrink(m_last.linear, force), shrink(m_last.angular, torque)};
  return m_last;
}

void ForceLimits::fault() noexcept
{
  if (m_stopped)
    return;
  m_stopped = true;
  m_held = m_last;
  m_fade = 1.0;
}

void ForceLimits::resume() noexcept
{
  m_stopped = false;
  m_fade = 0.0;
}

} // namespace petrous::haptics
