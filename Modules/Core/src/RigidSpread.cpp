#include "petrous/Core/RigidSpread.h"

#include <algorithm>
#include <cmath>

namespace petrous::core
{

namespace
{

using Motion = Eigen::Matrix<double, 6, 1>;

Eigen::Matrix3d crossMatrix(const Eigen::Vector3d& v)
{
  Eigen::Matrix3d matrix;
  matrix << 0.0, -v[2], v[1], v[2], 0.0, -v[0], -v[1], v[0], 0.0;
  return matrix;
}

// Chi-square percentile by Wilson and Hilferty.
double chiSquare(double degrees, double normal)
{
  const double a = 2.0 / (9.0 * degrees);
  return degrees * std::pow(std::max(0.0, 1.0 - a + normal * std::sqrt(a)), 3.0);
}

} // namespace

bool operator==(const RigidSpread& a, const RigidSpread& b) noexcept
{
  return a.about == b.about && a.moments == b.moments;
}

RigidSpread spreadOf(const RigidTransform& transform, const std::vector<RigidTransform>& repeats,
                     const Eigen::Vector3d& about)
{
  RigidSpread spread;
  spread.about = about;
  const RigidTransform back = transform.inverse();
  for (const RigidTransform& repeat : repeats)
  {
    const RigidTransform by = back * repeat;
    const Eigen::AngleAxisd rotation(by.rotation());
    Motion motion;
    motion << by * about - about, rotation.angle() * rotation.axis();
    spread.moments += motion * motion.transpose();
  }
  if (!repeats.empty())
    spread.moments /= static_cast<double>(repeats.size());
  return spread;
}

RigidSpread takenAbout(const RigidSpread& spread, const Eigen::Vector3d& about)
{
  RigidSpread::Moments jacobian = RigidSpread::Moments::Identity();
  jacobian.topRightCorner<3, 3>() = -crossMatrix(about - spread.about);
  return {about, jacobian * spread.moments * jacobian.transpose()};
}

RigidSpread chained(const RigidSpread& second, const RigidSpread& first,
                    const RigidTransform& bFromA)
{
  // (X_CB E_B X_BA) = X_CA (X_AB E_B X_BA): the second's motion in the axes of A.
  const Eigen::Matrix3d aFromB = bFromA.rotation().conjugate().toRotationMatrix();
  RigidSpread::Moments turn = RigidSpread::Moments::Zero();
  turn.topLeftCorner<3, 3>() = aFromB;
  turn.bottomRightCorner<3, 3>() = aFromB;
  const RigidSpread there{bFromA.inverse() * second.about,
                          turn * second.moments * turn.transpose()};
  RigidSpread sum = takenAbout(there, first.about);
  sum.moments += first.moments;
  return sum;
}

Eigen::Matrix3d displacementMoments(const RigidSpread& spread, const Eigen::Vector3d& point)
{
  return takenAbout(spread, point).moments.topLeftCorner<3, 3>();
}

double lengthQuantile(const Eigen::Matrix3d& moments, double normalQuantile)
{
  const double trace = moments.trace();
  const double square = (moments * moments).trace();
  if (!(trace > 0.0) || !(square > 0.0))
    return 0.0;
  return std::sqrt(square / trace * chiSquare(trace * trace / square, normalQuantile));
}

double largestP95(const RigidSpread& spread, const PatientBox& box)
{
  double most = 0.0;
  for (int corner = 0; corner < 8; ++corner)
  {
    const Eigen::Vector3d point = box.corner(static_cast<PatientBox::CornerType>(corner));
    most = std::max(most, lengthQuantile(displacementMoments(spread, point), kNormal95));
  }
  return most;
}

} // namespace petrous::core
