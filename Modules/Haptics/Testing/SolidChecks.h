#pragma once

#include <map>
#include <tuple>

#include "ProxyChecks.h"

// Shared by the tests of solid tools: bone thinner than the spacing of a shell's points, and the
// true depth of the tool in it.
namespace petrous::haptics::testing
{

constexpr double kMax = 0.05; // mm, of bone in the tool

/// Depth of a point in ball, shaft and handpiece, mm; shapes as in BurrShape.
inline double depthIn(const BurrShape& shape, double shaftRadius, const Eigen::Vector3d& p)
{
  const double across = std::hypot(p.x(), p.y());
  double depth = shape.radius - p.norm();
  if (p.z() > 0.0 && p.z() < shape.shaftLength)
    depth = std::max(depth, shaftRadius - across);
  const double along = p.z() - shape.shaftLength;
  if (shape.handpieceRadius > 0.0 && along > 0.0 && along < shape.handpieceLength)
    depth = std::max(
        depth, std::min({shape.handpieceRadius - across, along, shape.handpieceLength - along}));
  return depth;
}

/// Ground truth: tissue of the interpolated field in the cells of a grid, sampled `perVoxel` times
/// per voxel.
inline double deepestIn(const core::GridGeometry& grid, const Scene& scene, const BurrShape& shape,
                        double shaftRadius, const Pose& pose, double perVoxel)
{
  const Eigen::Vector3d last(grid.dims()[0] - 1, grid.dims()[1] - 1, grid.dims()[2] - 1);
  const Eigen::Matrix3d toTool = pose.rotation.toRotationMatrix().transpose();
  const double step = 1.0 / perVoxel;
  double deepest = 0.0;
  Eigen::Vector3d v;
  // Voxels that may contain bone first, then their interior.
  for (v.z() = 0.0; v.z() < last.z(); v.z() += 1.0)
    for (v.y() = 0.0; v.y() < last.y(); v.y() += 1.0)
      for (v.x() = 0.0; v.x() < last.x(); v.x() += 1.0)
      {
        const Eigen::Vector3d middle = grid.patientFromVoxel(v + Eigen::Vector3d::Constant(0.5));
        if (depthIn(shape, shaftRadius, toTool * (middle - pose.position)) <
            -0.9 * grid.spacing().maxCoeff())
          continue;
        bool any = false;
        for (int n = 0; n < 8 && !any; ++n)
          any = scene.tissue->value(
                    grid.patientFromVoxel(v + Eigen::Vector3d(n & 1, (n >> 1) & 1, n >> 2))) > 0.0;
        if (!any)
          continue;
        for (double z = 0.0; z < 1.0; z += step)
          for (double y = 0.0; y < 1.0; y += step)
            for (double x = 0.0; x < 1.0; x += step)
            {
              const Eigen::Vector3d p = grid.patientFromVoxel(v + Eigen::Vector3d(x, y, z));
              const double depth = depthIn(shape, shaftRadius, toTool * (p - pose.position));
              if (depth > deepest && scene.tissue->value(p) > 0.0)
                deepest = depth;
            }
      }
  return deepest;
}

inline double deepestBone(const Scene& scene, const BurrShape& shape, double shaftRadius,
                          const Pose& pose, double perVoxel)
{
  return deepestIn(scene.field->geometry(), scene, shape, shaftRadius, pose, perVoxel);
}

inline core::GridGeometry boxOf(const Eigen::Vector3d& half, double h, const Eigen::Vector3d& phase)
{
  core::Index3 dims;
  Eigen::Vector3d last;
  for (std::size_t a = 0; a < 3; ++a)
  {
    const auto axis = static_cast<Eigen::Index>(a);
    dims[a] = static_cast<int>(std::ceil(2.0 * half[axis] / h)) + 1;
    last[axis] = h * (dims[a] - 1);
  }
  return {dims, Eigen::Vector3d::Constant(h), -0.5 * last + h * phase};
}

/// A plate on edge: `thickness` along x, up to z = 0.
inline SignedDistance plateOnEdge(double thickness,
                                  const Eigen::Matrix3d& turn = Eigen::Matrix3d::Identity())
{
  return [=](const Eigen::Vector3d& at)
  {
    const Eigen::Vector3d p = turn.transpose() * at;
    return std::min(0.5 * thickness - std::abs(p.x()), -p.z());
  };
}

/// Built once for all tests.
inline const PointShell& sharedShell(const BurrShape& shape, double h)
{
  static std::map<std::tuple<double, double, double, double, double>, PointShell> shells;
  const auto key = std::make_tuple(shape.radius, shape.shaftLength, shape.handpieceRadius,
                                   shape.handpieceLength, h);
  const auto known = shells.find(key);
  return known != shells.end() ? known->second
                               : shells.emplace(key, makeBurrShell(shape, h)).first->second;
}

inline const Eigen::Quaterniond kAlongX =
    Eigen::Quaterniond::FromTwoVectors(Eigen::Vector3d::UnitZ(), Eigen::Vector3d::UnitX());

struct Dragged
{
  double deepest = 0.0;  // mm, truth
  double reported = 0.0; // mm, largest penetration reported
  double stretch = 0.0;  // mm, distance of goal and tool at the end
};

/// The tool is parallel to x and lowered onto the bone by 3 mm in 300 ticks; `at` is the position
/// on its axis, from the burr's centre, that is above the origin. `truth`: the grid in whose cells
/// tissue is sampled.
inline Dragged drag(const Scene& scene, const BurrShape& shape, double radius, double at,
                    double perVoxel = 8.0, const core::GridGeometry* truth = nullptr)
{
  const double h = scene.field->voxel();
  ConstrainedProxy proxy(scene.field, sharedShell(shape, h));
  const double shaftRadius = proxy.shell().solid.shaftRadius;
  const auto pose = [&](double z)
  {
    return poseAt({-at, 0.07, z},
                  kAlongX * Eigen::Quaterniond(Eigen::AngleAxisd(0.2, Eigen::Vector3d::UnitZ())));
  };
  const double start = radius + 2.0 * h;
  proxy.place(pose(start));
  Dragged result;
  for (int t = 1; t <= 300; ++t)
  {
    const ProxyTick& tick = proxy.step(pose(start - 0.01 * t));
    result.reported = std::max(result.reported, tick.penetration);
    if (t % 150 == 0)
      result.deepest =
          std::max(result.deepest, deepestIn(truth ? *truth : scene.field->geometry(), scene, shape,
                                             shaftRadius, tick.pose, perVoxel));
    result.stretch = maxDisplacement(motionBetween(tick.pose, pose(start - 0.01 * t)), at);
  }
  return result;
}

} // namespace petrous::haptics::testing
