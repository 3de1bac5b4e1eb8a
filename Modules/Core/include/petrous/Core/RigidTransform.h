#pragma once

#include <Eigen/Geometry>

namespace petrous::core
{

/// A rotation followed by a translation, in millimetres: p_A = R_AB p_B + p_AB.
///
/// X_AB is the pose of frame B in frame A (Documentation/frames.md); X_AC = X_AB * X_BC. The
/// rotation is stored as a unit quaternion, so composition never introduces shear.
class RigidTransform
{
public:
  RigidTransform() = default;

  /// The quaternion is normalised. Throws InvalidParameter if it is zero or not finite, or if the
  /// translation is not finite.
  RigidTransform(const Eigen::Quaterniond& rotation, const Eigen::Vector3d& translation);

  /// From a 4x4 matrix whose upper left block is a rotation within 1e-6 (no shear, scale or
  /// reflection) and whose last row is 0 0 0 1; throws InvalidParameter otherwise.
  static RigidTransform fromMatrix(const Eigen::Matrix4d& matrix);

  const Eigen::Quaterniond& rotation() const noexcept { return m_rotation; }
  const Eigen::Vector3d& translation() const noexcept { return m_translation; }
  Eigen::Matrix4d matrix() const;
  RigidTransform inverse() const;

  Eigen::Vector3d operator*(const Eigen::Vector3d& point) const;
  RigidTransform operator*(const RigidTransform& other) const;

private:
  Eigen::Quaterniond m_rotation = Eigen::Quaterniond::Identity();
  Eigen::Vector3d m_translation = Eigen::Vector3d::Zero();
};

} // namespace petrous::core
