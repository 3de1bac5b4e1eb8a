#include "ErrorModel.h"

#include <algorithm>
#include <cmath>

namespace petrous::registration
{

namespace
{

constexpr double kInflation = 1.1; // calibrated
constexpr double kFloor = 0.06;    // in voxels of the finest level, along each axis; calibrated
// Quantiles of the standard normal distribution.
constexpr double kNormal95 = 1.6449;
constexpr double kNormal999 = 3.0902;

// Chi-square percentile by Wilson and Hilferty (1931), accurate to 1 % for 1 or more degrees of
// freedom.
double chiSquare(double degrees, double normal)
{
  const double a = 2.0 / (9.0 * degrees);
  return degrees * std::pow(std::max(0.0, 1.0 - a + normal * std::sqrt(a)), 3.0);
}

} // namespace

LocalError localError(const core::RigidTransform& mrFromCt,
                      const std::vector<core::RigidTransform>& repeats,
                      const Eigen::Vector3d& ctPoint, double voxel, double stray)
{
  LocalError error;
  error.point = ctPoint;
  const Eigen::Vector3d landed = mrFromCt * ctPoint;
  Eigen::Matrix3d moments = Eigen::Matrix3d::Zero();
  double furthest = 0.0;
  int count = 0;
  for (const core::RigidTransform& repeat : repeats)
  {
    const Eigen::Vector3d off = repeat * ctPoint - landed;
    if (off.norm() > stray)
      continue;
    moments += off * off.transpose();
    furthest = std::max(furthest, off.norm());
    ++count;
  }
  if (count > 0)
    moments *= kInflation * kInflation / count;
  const double floor = kFloor * voxel;
  moments += floor * floor * Eigen::Matrix3d::Identity();
  const double trace = moments.trace();
  const double square = (moments * moments).trace();
  const double scale = square / trace;
  const double degrees = trace * trace / square;
  error.median = std::sqrt(scale * chiSquare(degrees, 0.0));
  error.p95 = std::sqrt(scale * chiSquare(degrees, kNormal95));
  error.max = std::max(std::sqrt(scale * chiSquare(degrees, kNormal999)),
                       std::hypot(kInflation * furthest, floor));
  return error;
}

LocalError withDisplaced(LocalError error, double offset, double spread)
{
  error.median = std::max(error.median, offset);
  error.p95 = offset + std::hypot(error.p95, 2.0 * spread);
  error.max = offset + std::hypot(error.max, 3.0 * spread);
  return error;
}

double strayShare(const core::RigidTransform& mrFromCt,
                  const std::vector<core::RigidTransform>& repeats, const Eigen::Vector3d& ctPoint,
                  double stray)
{
  if (repeats.empty())
    return 1.0;
  const Eigen::Vector3d landed = mrFromCt * ctPoint;
  const auto strays =
      std::count_if(repeats.begin(), repeats.end(),
                    [&](const auto& repeat) { return (repeat * ctPoint - landed).norm() > stray; });
  return static_cast<double>(strays) / static_cast<double>(repeats.size());
}

} // namespace petrous::registration
