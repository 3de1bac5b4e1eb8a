#include "petrous/Presenters/MrMotion.h"

namespace petrous::presenters
{

namespace
{
constexpr double kDegree = 3.14159265358979323846 / 180.0;
}

core::RigidTransform shifted(const core::RigidTransform& mrFromCt, const Eigen::Vector3d& shift)
{
  // What appeared at p appears at p + shift.
  return mrFromCt * core::RigidTransform(Eigen::Quaterniond::Identity(), -shift);
}

core::RigidTransform turned(const core::RigidTransform& mrFromCt, const Eigen::Vector3d& axis,
                            double degrees, const Eigen::Vector3d& about)
{
  const Eigen::Quaterniond back(Eigen::AngleAxisd(-degrees * kDegree, axis.normalized()));
  return mrFromCt * core::RigidTransform(back, about - back * about);
}

core::RigidTransform broughtTo(const core::RigidTransform& mrFromCt, const Eigen::Vector3d& mr,
                               const Eigen::Vector3d& ct)
{
  return {mrFromCt.rotation(), mr - mrFromCt.rotation() * ct};
}

MrDifference difference(const core::RigidTransform& from, const core::RigidTransform& to,
                        const Eigen::Vector3d& at)
{
  return {(to * at - from * at).norm(), from.rotation().angularDistance(to.rotation()) / kDegree};
}

} // namespace petrous::presenters
