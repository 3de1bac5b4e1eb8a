#include "petrous/Rendering/PixelRays.h"

#include <cmath>
#include <limits>

#include <Eigen/Geometry>
#include <gtest/gtest.h>
#include <vtkCamera.h>
#include <vtkMatrix4x4.h>
#include <vtkNew.h>

#include "petrous/Core/Error.h"

using namespace petrous;
using namespace petrous::rendering;

namespace
{

constexpr int kWidth = 96;
constexpr int kHeight = 72;

core::CameraPose camera()
{
  core::CameraPose pose;
  pose.position = {50.0, -60.0, 25.0};
  pose.focalPoint = {1.0, 0.5, -0.5};
  pose.viewUp = {0.1, 0.2, 1.0};
  pose.viewAngle = 24.0;
  return pose;
}

// A point at 40 mm on every pixel's ray must be projected to the pixel's centre by VTK's camera.
void expectProjectionOfVtk(const core::CameraPose& pose)
{
  constexpr double aspect = static_cast<double>(kWidth) / kHeight;
  vtkNew<vtkCamera> reference;
  reference->SetPosition(pose.position.data());
  reference->SetFocalPoint(pose.focalPoint.data());
  reference->SetViewUp(pose.viewUp.data());
  reference->SetViewAngle(pose.viewAngle);
  reference->SetParallelProjection(pose.parallelScale ? 1 : 0);
  if (pose.parallelScale)
    reference->SetParallelScale(*pose.parallelScale);
  reference->SetWindowCenter(pose.lensShift / aspect, 0.0);
  reference->SetClippingRange(1.0, 500.0);
  vtkMatrix4x4* projection = reference->GetCompositeProjectionTransformMatrix(aspect, -1.0, 1.0);
  const PixelRays rays(pose, kWidth, kHeight);
  for (int row = 0; row < kHeight; row += 7)
    for (int column = 0; column < kWidth; column += 5)
    {
      const PixelRay ray = rays.through(column, row);
      const Eigen::Vector3d point = ray.origin + 40.0 * ray.direction;
      const double from[4] = {point[0], point[1], point[2], 1.0};
      double to[4];
      projection->MultiplyPoint(from, to);
      EXPECT_NEAR(0.5 * kWidth * (1.0 + to[0] / to[3]) - 0.5, column, 1e-6);
      EXPECT_NEAR(0.5 * kHeight * (1.0 - to[1] / to[3]) - 0.5, row, 1e-6);
    }
}

} // namespace

TEST(PixelRays, GoThroughThePixelsOfVtksCamera)
{
  core::CameraPose pose = camera();
  expectProjectionOfVtk(pose);
  pose.lensShift = 0.3;
  expectProjectionOfVtk(pose);
}

TEST(PixelRays, GoThroughThePixelsOfVtksParallelCamera)
{
  core::CameraPose pose = camera();
  pose.parallelScale = 17.0;
  expectProjectionOfVtk(pose);
  pose.lensShift = -0.45;
  expectProjectionOfVtk(pose);
}

TEST(PixelRays, SpanTheAngleVertically)
{
  const core::CameraPose pose = camera();
  const PixelRays rays(pose, kWidth, kHeight);
  const double middle = 0.5 * (kWidth - 1);
  const Eigen::Vector3d top = rays.through(middle, -0.5).direction;
  const Eigen::Vector3d bottom = rays.through(middle, kHeight - 0.5).direction;
  EXPECT_NEAR(std::acos(top.dot(bottom)) * 180.0 / M_PI, pose.viewAngle, 1e-9);
  EXPECT_GT(top.z(), bottom.z());
}

// Rays of pixels below each other are apart by the edge of a pixel.
TEST(PixelRays, KnowHowWideAPixelIs)
{
  core::CameraPose pose = camera();
  for (const bool parallel : {false, true})
  {
    if (parallel)
      pose.parallelScale = 17.0;
    const PixelRays rays(pose, kWidth, kHeight);
    const PixelRay one = rays.through(0.5 * (kWidth - 1), 0.5 * (kHeight - 1));
    const PixelRay next = rays.through(0.5 * (kWidth - 1), 0.5 * (kHeight + 1));
    for (const double distance : {10.0, 300.0})
    {
      const double apart =
          ((next.origin + distance * next.direction) - (one.origin + distance * one.direction))
              .norm();
      EXPECT_NEAR(one.pixelAt(distance) / apart, 1.0, 1e-4);
    }
  }
}

TEST(PixelRays, SpanTwiceTheParallelScaleVertically)
{
  core::CameraPose pose = camera();
  pose.parallelScale = 17.0;
  const PixelRays rays(pose, kWidth, kHeight);
  const double height =
      (rays.through(3.0, -0.5).origin - rays.through(3.0, kHeight - 0.5).origin).norm();
  EXPECT_NEAR(height, 34.0, 1e-9);
}

TEST(PixelRays, RefuseACameraWithoutDirection)
{
  core::CameraPose pose = camera();
  pose.focalPoint = pose.position;
  EXPECT_THROW(PixelRays(pose, 10, 10), core::InvalidParameter);
  pose = camera();
  pose.viewUp = pose.focalPoint - pose.position;
  EXPECT_THROW(PixelRays(pose, 10, 10), core::InvalidParameter);
}

TEST(PixelRays, RefuseACameraThatIsNoNumber)
{
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  core::CameraPose pose = camera();
  pose.position[1] = nan;
  EXPECT_THROW(PixelRays(pose, 10, 10), core::InvalidParameter);
  pose = camera();
  pose.viewAngle = nan;
  EXPECT_THROW(PixelRays(pose, 10, 10), core::InvalidParameter);
  pose = camera();
  pose.lensShift = std::numeric_limits<double>::infinity();
  EXPECT_THROW(PixelRays(pose, 10, 10), core::InvalidParameter);
}
