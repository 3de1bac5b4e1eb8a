#include "petrous/Haptics/PassivityGuard.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "petrous/Core/Error.h"

namespace petrous::haptics
{

namespace
{

constexpr double kMaxStep = 0.02;  // s
constexpr double kFriction = 0.05; // N, that the joints of a device with coarse encoders have
constexpr double kCoarsest = 0.1;  // mm; a larger change is no count
constexpr int kUnchanged = 8;      // ticks before a change that is taken for one count

void check(bool holds, const char* what)
{
  if (!holds)
    throw core::InvalidParameter(std::string("passivity guard: ") + what);
}

bool positive(double value)
{
  return value > 0.0 && std::isfinite(value);
}

bool notNegative(double value)
{
  return value >= 0.0 && std::isfinite(value);
}

double storedBy(const Eigen::Vector3d& load, double stiffness) noexcept
{
  if (load.isZero(0.0))
    return 0.0;
  return stiffness > 0.0 ? 0.5 * load.squaredNorm() / stiffness
                         : std::numeric_limits<double>::infinity();
}

} // namespace

PassivityGuard::PassivityGuard(const Parameters& parameters)
  : m_parameters(parameters)
{
  check(positive(parameters.allowance), "the allowance must be above 0 N mm");
  check(notNegative(parameters.stiffness), "the stiffness must not be below 0 N/mm");
  check(notNegative(parameters.angularStiffness),
        "the angular stiffness must not be below 0 N mm/rad");
  check(notNegative(parameters.deviceDamping), "the device's damping must not be below 0 N s/mm");
  check(notNegative(parameters.deviceAngularDamping),
        "the device's angular damping must not be below 0 N mm s/rad");
  check(positive(parameters.largestDamping), "the largest damping must be above 0 N s/mm");
  check(positive(parameters.lever), "the lever must be above 0 mm");
}

double PassivityGuard::maxStored(const Wrench& wanted,
                                 const Eigen::Vector3d& position) const noexcept
{
  return std::max(0.0, storedBy(wanted.linear, m_parameters.stiffness) +
                           wanted.linear.dot(position - m_pose.position) +
                           storedBy(wanted.angular, m_parameters.angularStiffness));
}

// Of each axis, from the readings.
void PassivityGuard::lookForCounts(const Eigen::Vector3d& position) noexcept
{
  for (int axis = 0; axis < 3; ++axis)
  {
    const std::size_t i = static_cast<std::size_t>(axis);
    const double change = std::abs(position[axis] - m_read[axis]);
    if (change == 0.0)
    {
      m_unchanged[i] = std::min(m_unchanged[i] + 1, kUnchanged);
      continue;
    }
    const double known = m_count[axis];
    if (m_unchanged[i] == kUnchanged && change <= kCoarsest)
      m_count[axis] = known > 0.0 ? std::min(known, change) : change;
    m_unchanged[i] = 0;
  }
}

Wrench PassivityGuard::apply(const Wrench& wanted, const Pose& pose, double now) noexcept
{
  m_damping = 0.0;
  const double dt = now - m_time;
  const bool observed =
      m_hasPose && pose.finite() && dt > 0.0 && dt <= kMaxStep; // false if dt is NaN
  Motion step;
  double friction = 0.0; // N mm
  if (observed)
  {
    lookForCounts(pose.position);
    step = motionBetween(m_pose, pose);
    if (m_parameters.stiffness > 0.0)
      for (int axis = 0; axis < 3; ++axis)
      {
        const double slack = std::min(0.5 * m_count[axis], kFriction / m_parameters.stiffness);
        step.linear[axis] -= std::clamp(step.linear[axis], -slack, slack);
        friction += m_parameters.stiffness * slack * std::abs(step.linear[axis]);
      }
    m_energy += (m_parameters.deviceDamping * step.linear.squaredNorm() +
                 m_parameters.deviceAngularDamping * step.angular.squaredNorm()) /
                    dt +
                friction - m_sent.linear.dot(step.linear) - m_sent.angular.dot(step.angular);
    if (!std::isfinite(m_energy)) // from implausible forces
      m_energy = 0.0;
  }
  m_hasPose = pose.finite() && std::isfinite(now);
  m_pose.position = observed ? m_pose.position + step.linear : pose.position;
  m_pose.rotation = pose.rotation;
  m_read = pose.position;
  m_time = now;
  m_sent = wanted.finite() ? wanted : Wrench{};
  if (!observed || !wanted.finite())
    return wanted;

  const double debt = -m_energy - m_parameters.allowance;
  m_energy = std::min(m_energy, maxStored(wanted, pose.position));
  const double lever2 = m_parameters.lever * m_parameters.lever;
  const double speed2 =
      (step.linear.squaredNorm() + lever2 * step.angular.squaredNorm()) / (dt * dt);
  if (!(debt > 0.0) || !(speed2 > 0.0))
    return wanted;
  m_damping = std::min(m_parameters.largestDamping, debt / (speed2 * dt));
  m_sent.linear -= m_damping / dt * step.linear;
  m_sent.angular -= m_damping * lever2 / dt * step.angular;
  return m_sent;
}

void PassivityGuard::sent(const Wrench& wrench) noexcept
{
  m_sent = wrench.finite() ? wrench : Wrench{};
}

} // namespace petrous::haptics
