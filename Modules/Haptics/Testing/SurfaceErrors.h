#pragma once

#include "AnalyticSurfaces.h"
#include "petrous/Haptics/Proxy.h"

namespace petrous::haptics::testing
{

/// Deviation of a proxy's pose and force from the exact solution on a surface.
struct SurfaceErrors
{
  double bias = 0.0;      ///< mm, mean height above the exact position, along the exact force
  double ripple = 0.0;    ///< mm, RMS of that height about its mean
  double distance = 0.0;  ///< mm, RMS distance of the ball's centre from its exact position
  double meanAngle = 0.0; ///< degrees between force and exact force
  double maxAngle = 0.0;
  double worstSum = 0.0;    ///< |wrench - sum of the contacts' thrusts|, relative
  double worstTorque = 0.0; ///< N mm about the ball's centre; exactly 0 without friction
  int ticks = 0;            ///< ticks in contact
};

/// |wrench - sum of (lambda n, lambda r x n)| / max(|wrench|, 1e-3), N and N mm.
inline double sumError(const ProxyTick& tick)
{
  Wrench sum;
  for (std::size_t n = 0; n < tick.contactCount; ++n)
  {
    const ProxyContact& contact = tick.contacts[n];
    sum.linear += contact.thrust * contact.normal;
    sum.angular += contact.thrust * contact.arm.cross(contact.normal);
  }
  const double size = tick.wrench.linear.norm() + tick.wrench.angular.norm();
  return ((sum.linear - tick.wrench.linear).norm() + (sum.angular - tick.wrench.angular).norm()) /
         std::max(size, 1e-3);
}

/// Lowers a ball from 1 mm above the surface to a goal 1 mm below, which then moves for `ticks`,
/// each `pace` further in s (some millimetres per unit). `step(goal)` makes a tick; the first goal
/// is free.
template <typename Step>
SurfaceErrors followSurface(const AnalyticSurface& surface, double radius, int ticks, double pace,
                            Step step)
{
  constexpr double kPressed = 1.0; // mm
  constexpr int kLowering = 300;
  constexpr double kDegrees = 57.29577951308232;
  SurfaceErrors errors;
  double sum = 0.0;
  double squares = 0.0;
  for (int t = -kLowering; t < ticks; ++t)
  {
    const double depth = kPressed * std::min(1.0, 1.0 + 2.0 * t / kLowering);
    Pose goal;
    goal.position = surface.goal(pace * t, radius, depth);
    const ProxyTick& tick = step(goal);
    errors.worstSum = std::max(errors.worstSum, sumError(tick));
    if (t < 0 || tick.contactCount == 0)
      continue;
    const Eigen::Vector3d held = surface.held(goal.position, radius);
    const Eigen::Vector3d force = (held - goal.position).normalized();
    const double height = (tick.pose.position - held).dot(force);
    const double cosine = std::clamp(tick.wrench.linear.normalized().dot(force), -1.0, 1.0);
    const double angle = kDegrees * std::acos(cosine);
    errors.distance += (tick.pose.position - held).squaredNorm();
    sum += height;
    squares += height * height;
    errors.meanAngle += angle;
    errors.maxAngle = std::max(errors.maxAngle, angle);
    errors.worstTorque = std::max(errors.worstTorque, tick.wrench.angular.norm());
    ++errors.ticks;
  }
  const double count = std::max(errors.ticks, 1);
  errors.bias = sum / count;
  errors.ripple = std::sqrt(std::max(0.0, squares / count - errors.bias * errors.bias));
  errors.distance = std::sqrt(errors.distance / count);
  errors.meanAngle /= count;
  return errors;
}

} // namespace petrous::haptics::testing
