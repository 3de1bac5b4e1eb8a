#include "petrous/Core/RigidTransform.h"

#include "petrous/Core/Error.h"

namespace petrous::core
{

RigidTransform::RigidTransform(const Eigen::Quaterniond& rotation,
                               const Eigen::Vector3d& translation)
  : m_rotation(rotation)
  , m_translation(translation)
{
  const double norm = rotation.norm();
  if (!(norm > 1e-12) || !std::isfinite(norm))
    throw InvalidParameter("rigid transform: the quaternion is zero or not finite");
  if (!translation.allFinite())
    throw InvalidParameter("rigid transform: the translation is not finite");
  m_rotation.coeffs() /= norm;
}

RigidTransform RigidTransform::fromMatrix(const Eigen::Matrix4d& matrix)
{
  const Eigen::Matrix3d r = matrix.topLeftCorner<3, 3>();
  const bool orthonormal =
      matrix.allFinite() && (r.transpose() * r - Eigen::Matrix3d::Identity()).norm() < 1e-6;
  if (!orthonormal || r.determinant() < 0.0)
    throw InvalidParameter("rigid transform: the matrix is not a rotation (sheared, scaled or "
                           "mirrored); only rigid motions are accepted");
  if ((matrix.row(3) - Eigen::RowVector4d(0, 0, 0, 1)).norm() > 1e-9)
    throw InvalidParameter("rigid transform: the last row must be 0 0 0 1");
  return {Eigen::Quaterniond(r), matrix.topRightCorner<3, 1>()};
}

Eigen::Matrix4d RigidTransform::matrix() const
{
  Eigen::Matrix4d m = Eigen::Matrix4d::Identity();
  m.topLeftCorner<3, 3>() = m_rotation.toRotationMatrix();
  m.topRightCorner<3, 1>() = m_translation;
  return m;
}

RigidTransform RigidTransform::inverse() const
{
  const Eigen::Quaterniond r = m_rotation.conjugate();
  return {r, -(r * m_translation)};
}

Eigen::Vector3d RigidTransform::operator*(const Eigen::Vector3d& point) const
{
  return m_rotation * point + m_translation;
}

RigidTransform RigidTransform::operator*(const RigidTransform& other) const
{
  return {m_rotation * other.m_rotation, m_rotation * other.m_translation + m_translation};
}

} // namespace petrous::core
