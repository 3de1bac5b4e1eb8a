#pragma once

#include <cmath>

#include <Eigen/Geometry>

namespace petrous::haptics
{

/// Pose of a rigid body: p_A = rotation * p_B + position, mm. Like core::RigidTransform, but may
/// hold any value (a device may send NaN) and never throws, for use in the servo tick. Check with
/// `finite` on input.
struct Pose
{
  Eigen::Vector3d position{0.0, 0.0, 0.0};                      ///< mm
  Eigen::Quaterniond rotation = Eigen::Quaterniond::Identity(); ///< unit

  Eigen::Vector3d operator*(const Eigen::Vector3d& point) const noexcept
  {
    return rotation * point + position;
  }
  bool finite() const noexcept
  {
    return position.allFinite() && rotation.coeffs().allFinite() && rotation.squaredNorm() > 1e-12;
  }
};

/// Six components about a stated point: force N and torque N mm, or translation mm and rotation
/// rad.
struct Spatial
{
  Eigen::Vector3d linear{0.0, 0.0, 0.0};
  Eigen::Vector3d angular{0.0, 0.0, 0.0};

  bool finite() const noexcept { return linear.allFinite() && angular.allFinite(); }
};
using Wrench = Spatial; ///< N, N mm
using Motion = Spatial; ///< mm, rad (rotation vector)

/// Rotation vector (axis * angle, rad) of a unit quaternion; the shorter rotation of q and -q.
inline Eigen::Vector3d rotationVector(const Eigen::Quaterniond& q) noexcept
{
  const double sign = q.w() < 0.0 ? -1.0 : 1.0;
  const Eigen::Vector3d v = sign * q.vec();
  const double sine = v.norm();
  const double cosine = sign * q.w();
  // atan2(s, c) / s -> 1 / c for small s: the first terms are accurate to ten digits below 1e-4.
  const double scale = sine > 1e-4 ? 2.0 * std::atan2(sine, cosine) / sine
                                   : 2.0 / cosine * (1.0 - sine * sine / (3.0 * cosine * cosine));
  return scale * v;
}

/// Unit quaternion of a rotation vector (rad).
inline Eigen::Quaterniond rotationFrom(const Eigen::Vector3d& vector) noexcept
{
  const double angle = vector.norm();
  const double half = 0.5 * angle;
  const double scale = angle > 1e-4 ? std::sin(half) / angle : 0.5 - angle * angle / 48.0;
  Eigen::Quaterniond q(std::cos(half), scale * vector.x(), scale * vector.y(), scale * vector.z());
  q.normalize();
  return q;
}

/// The motion from `from` to `to`: translation of the origin, rotation in the outer frame.
inline Motion motionBetween(const Pose& from, const Pose& to) noexcept
{
  return {to.position - from.position, rotationVector(to.rotation * from.rotation.conjugate())};
}

/// `pose` moved by the fraction `share` of a motion; the quaternion is renormalised.
inline Pose moved(const Pose& pose, const Motion& motion, double share = 1.0) noexcept
{
  Pose result{pose.position + share * motion.linear,
              rotationFrom(share * motion.angular) * pose.rotation};
  result.rotation.normalize();
  return result;
}

} // namespace petrous::haptics
