#include "ErrorModel.h"

#include <algorithm>
#include <cmath>

namespace petrous::registration
{

namespace
{

constexpr double kInflation = 1.1; // calibrated
constexpr double kFloor = 0.06;    // in voxels of the finest level, along each axis; calibrated

} // namespace

LocalError localError(const core::RigidTransform& mrFromCt,
                      const std::vector<core::RigidTransform>& repeats,
                      const Eigen::Vector3d& ctPoint, double voxel, double stray)
{
  LocalError error;
  error.point = ctPoint;
  const Eigen::Vector3d landed = mrFromCt * ctPoint;
  double furthest = 0.0;
  std::vector<core::RigidTransform> counted;
  for (const core::RigidTransform& repeat : repeats)
  {
    const double off = (repeat * ctPoint - landed).norm();
    if (off > stray)
      continue;
    furthest = std::max(furthest, off);
    counted.push_back(repeat);
  }
  core::RigidSpread spread = core::spreadOf(mrFromCt, counted, ctPoint);
  spread.moments *= kInflation * kInflation;
  const double floor = kFloor * voxel;
  spread.moments.topLeftCorner<3, 3>() += floor * floor * Eigen::Matrix3d::Identity();
  const Eigen::Matrix3d moments = core::displacementMoments(spread, ctPoint);
  error.median = core::lengthQuantile(moments, core::kNormalMedian);
  error.p95 = core::lengthQuantile(moments, core::kNormal95);
  error.max = std::max(core::lengthQuantile(moments, core::kNormal999),
                       std::hypot(kInflation * furthest, floor));
  if (!counted.empty())
    error.spread = spread;
  return error;
}

LocalError withDisplaced(LocalError error, double offset, double spread)
{
  error.median = std::max(error.median, offset);
  error.p95 = offset + std::hypot(error.p95, 2.0 * spread);
  error.max = offset + std::hypot(error.max, 3.0 * spread);
  error.spread.reset(); // what a part adds is no rigid motion of the whole
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
