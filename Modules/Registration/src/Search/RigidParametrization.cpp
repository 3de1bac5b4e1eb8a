#include "RigidParametrization.h"

#include <cmath>

namespace petrous::registration
{

namespace
{

Eigen::Matrix3d cross(const Eigen::Vector3d& v)
{
  Eigen::Matrix3d m;
  m << 0.0, -v[2], v[1], v[2], 0.0, -v[0], -v[1], v[0], 0.0;
  return m;
}

Eigen::Quaterniond turn(const Eigen::Vector3d& vector)
{
  const double angle = vector.norm();
  if (angle < 1e-12)
    return Eigen::Quaterniond::Identity();
  return Eigen::Quaterniond(Eigen::AngleAxisd(angle, vector / angle));
}

// Left Jacobian J of SO(3): exp(w + dw) = exp(J dw) exp(w).
Eigen::Matrix3d leftJacobian(const Eigen::Vector3d& w)
{
  const double angle = w.norm();
  if (angle < 1e-6)
    return Eigen::Matrix3d::Identity() + 0.5 * cross(w);
  const Eigen::Matrix3d k = cross(w / angle);
  return Eigen::Matrix3d::Identity() + (1.0 - std::cos(angle)) / angle * k +
         (1.0 - std::sin(angle) / angle) * k * k;
}

} // namespace

RigidParametrization::RigidParametrization(const core::RigidTransform& base,
                                           const Eigen::Vector3d& centre, double radius)
  : m_base(base)
  , m_centre(centre)
  , m_radius(radius)
{
}

core::RigidTransform RigidParametrization::pose(const PoseVector& x) const
{
  const Eigen::Quaterniond rotation = turn(x.head<3>() / m_radius) * m_base.rotation();
  const Eigen::Vector3d mapped = m_base * m_centre + x.tail<3>();
  return {rotation, mapped - rotation * m_centre};
}

PoseVector RigidParametrization::gradient(const PoseVector& x, const Eigen::Vector3d& translation,
                                          const Eigen::Vector3d& rotation) const
{
  PoseVector g;
  g.head<3>() = leftJacobian(x.head<3>() / m_radius).transpose() * rotation / m_radius;
  g.tail<3>() = translation;
  return g;
}

double poseDistance(const core::RigidTransform& a, const core::RigidTransform& b,
                    const Eigen::Vector3d& centre, double radius)
{
  const double angle = a.rotation().angularDistance(b.rotation());
  return (a * centre - b * centre).norm() + 2.0 * radius * std::sin(0.5 * angle);
}

core::RigidTransform meanPose(const std::vector<core::RigidTransform>& poses,
                              const Eigen::Vector3d& centre)
{
  const Eigen::Quaterniond base = poses.front().rotation();
  Eigen::Vector3d vector = Eigen::Vector3d::Zero();
  Eigen::Vector3d mapped = Eigen::Vector3d::Zero();
  for (const core::RigidTransform& pose : poses)
  {
    const Eigen::AngleAxisd turned(pose.rotation() * base.inverse());
    vector += turned.angle() * turned.axis();
    mapped += pose * centre;
  }
  const auto count = static_cast<double>(poses.size());
  const Eigen::Quaterniond rotation = turn(vector / count) * base;
  return {rotation, mapped / count - rotation * centre};
}

} // namespace petrous::registration
