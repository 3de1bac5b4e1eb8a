#include "RayView.h"

#include <cmath>
#include <limits>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include "petrous/Core/Error.h"
#include "petrous/Rendering/PixelRays.h"

using namespace petrous;
using namespace petrous::rendering;

namespace
{

constexpr int kColumns = 40;
constexpr int kRows = 30;
constexpr double kNear = 3.0;
constexpr double kFar = 500.0;

// OpenGL's matrices as in its specification.
Eigen::Matrix4d lookAt(const core::CameraPose& pose)
{
  const Eigen::Vector3d forward = (pose.focalPoint - pose.position).normalized();
  const Eigen::Vector3d right = forward.cross(pose.viewUp).normalized();
  Eigen::Matrix4d view = Eigen::Matrix4d::Identity();
  view.row(0).head<3>() = right;
  view.row(1).head<3>() = right.cross(forward);
  view.row(2).head<3>() = -forward;
  view.topRightCorner<3, 1>() = -view.topLeftCorner<3, 3>() * pose.position;
  return view;
}

Eigen::Matrix4d projectionOf(const core::CameraPose& pose)
{
  const double aspect = static_cast<double>(kColumns) / kRows;
  const double half =
      pose.parallelScale ? *pose.parallelScale : std::tan(pose.viewAngle * std::acos(-1.0) / 360.0);
  const double left = half * (pose.lensShift - aspect);
  const double right = half * (pose.lensShift + aspect);
  Eigen::Matrix4d p = Eigen::Matrix4d::Zero();
  p(0, 0) = 2.0 / (right - left);
  p(1, 1) = 1.0 / half;
  if (pose.parallelScale)
  {
    p(0, 3) = -(right + left) / (right - left);
    p(2, 2) = -2.0 / (kFar - kNear);
    p(2, 3) = -(kFar + kNear) / (kFar - kNear);
    p(3, 3) = 1.0;
  }
  else
  {
    p(0, 2) = (right + left) / (right - left);
    p(2, 2) = -(kFar + kNear) / (kFar - kNear);
    p(2, 3) = -2.0 * kFar * kNear / (kFar - kNear);
    p(3, 2) = -1.0;
  }
  return p;
}

core::CameraPose slanting()
{
  core::CameraPose pose;
  pose.position = {40.0, -70.0, 25.0};
  pose.focalPoint = {1.0, 2.0, -3.0};
  pose.viewUp = {0.1, 0.2, 1.0};
  pose.viewAngle = 35.0;
  return pose;
}

std::vector<core::CameraPose> poses()
{
  std::vector<core::CameraPose> result(4, slanting());
  result[1].lensShift = 0.3;
  result[2].parallelScale = 17.0;
  result[3].parallelScale = 17.0;
  result[3].lensShift = -0.2;
  return result;
}

// Maximum distance between the rays of a view and those of the camera, at their origins and at unit
// depth.
double farthest(const RayView& view, const core::CameraPose& pose)
{
  const PixelRays rays(pose, kColumns, kRows);
  double result = 0.0;
  for (int row = 0; row < kRows; ++row)
    for (int column = 0; column < kColumns; ++column)
    {
      const double x = (2.0 * column + 1.0) / kColumns - 1.0;
      const double y = 1.0 - (2.0 * row + 1.0) / kRows;
      const PixelRay ray = rays.through(column, row);
      const Eigen::Vector3d origin = view.origin + x * view.originX + y * view.originY;
      const Eigen::Vector3d direction = view.direction + x * view.directionX + y * view.directionY;
      const Eigen::Vector3d forward = (pose.focalPoint - pose.position).normalized();
      result = std::max({result, (origin - ray.origin).norm(),
                         (direction - ray.direction / ray.direction.dot(forward)).norm()});
    }
  return result;
}

} // namespace

TEST(RayView, GivesTheRaysOfTheCamera)
{
  for (const core::CameraPose& pose : poses())
  {
    const RayView view = rayView(lookAt(pose), projectionOf(pose), Eigen::Matrix4d::Identity());
    EXPECT_EQ(view.parallel, pose.parallelScale.has_value());
    EXPECT_LT(farthest(view, pose), 1e-9);
  }
}

TEST(RayView, FollowsThePatientInTheWorld)
{
  Eigen::Affine3d worldFromPatient = Eigen::Translation3d(11.0, -5.0, 40.0) *
                                     Eigen::AngleAxisd(1.1, Eigen::Vector3d(1, 2, 3).normalized());
  for (const core::CameraPose& pose : poses())
  {
    core::CameraPose moved = pose; // the same camera in world coordinates
    moved.position = worldFromPatient * pose.position;
    moved.focalPoint = worldFromPatient * pose.focalPoint;
    moved.viewUp = worldFromPatient.linear() * pose.viewUp;
    const RayView view = rayView(lookAt(moved), projectionOf(pose), worldFromPatient.matrix());
    EXPECT_LT(farthest(view, pose), 1e-9);
  }
}

TEST(RayView, KeepsItsRaysFarFromTheWorldsOrigin)
{
  const Eigen::Affine3d worldFromPatient(Eigen::Translation3d(1e6, -2e6, 5e5));
  for (const core::CameraPose& pose : poses())
  {
    core::CameraPose moved = pose;
    moved.position = worldFromPatient * pose.position;
    moved.focalPoint = worldFromPatient * pose.focalPoint;
    const RayView view = rayView(lookAt(moved), projectionOf(pose), worldFromPatient.matrix());
    EXPECT_LT(farthest(view, pose), 1e-7); // 1e-4 micrometres
  }
}

TEST(RayView, TurnsWindowDepthIntoDepthOfView)
{
  for (const core::CameraPose& pose : poses())
  {
    const Eigen::Matrix4d projection = projectionOf(pose);
    const RayView view = rayView(lookAt(pose), projection, Eigen::Matrix4d::Identity());
    for (const double depth : {kNear, 20.0, 77.7, kFar})
    {
      const Eigen::Vector4d clip = projection * Eigen::Vector4d(1.0, 2.0, -depth, 1.0);
      const double z = clip[2] / clip[3];
      const double found =
          view.parallel ? view.depth[2] + view.depth[3] * z : view.depth[1] / (z + view.depth[0]);
      EXPECT_NEAR(found, depth, 1e-9 * kFar);
    }
  }
}

TEST(RayView, RefusesMatricesThatCannotBeInverted)
{
  const Eigen::Matrix4d good = Eigen::Matrix4d::Identity();
  const Eigen::Matrix4d projection = projectionOf(slanting());
  const Eigen::Matrix4d flat = Eigen::Matrix4d::Zero();
  const Eigen::Matrix4d broken =
      Eigen::Matrix4d::Constant(std::numeric_limits<double>::quiet_NaN());
  for (const Eigen::Matrix4d& bad : {flat, broken})
  {
    EXPECT_THROW(rayView(bad, projection, good), core::InvalidParameter);
    EXPECT_THROW(rayView(good, bad, good), core::InvalidParameter);
    EXPECT_THROW(rayView(good, projection, bad), core::InvalidParameter);
  }
}
