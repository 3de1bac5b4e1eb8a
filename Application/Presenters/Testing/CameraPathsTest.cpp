#include "petrous/Presenters/CameraPaths.h"

#include <cmath>

#include <gtest/gtest.h>

#include "ShapeCase.h"
#include "petrous/Core/Error.h"

using namespace petrous;
using namespace petrous::presenters;
using Eigen::Vector3d;

TEST(Turntable, GoesOnceAroundTheFocalPointInEqualSteps)
{
  core::CameraPose camera;
  camera.focalPoint = {3.0, -2.0, 5.0};
  camera.position = camera.focalPoint + Vector3d(0.0, -50.0, 10.0);
  camera.viewUp = {0.0, 0.0, 2.0};
  const auto cameras = turntable(camera, 8);
  ASSERT_EQ(cameras.size(), 8U);
  EXPECT_LT((cameras[0].position - camera.position).norm(), 1e-12);
  // After a quarter the camera that looked at the face (from -y) is on the patient's right (-x).
  EXPECT_LT((cameras[2].position - (camera.focalPoint + Vector3d(-50.0, 0.0, 10.0))).norm(), 1e-9);
  for (std::size_t n = 0; n < cameras.size(); ++n)
  {
    const Vector3d a = cameras[n].position - camera.focalPoint;
    const Vector3d b = cameras[(n + 1) % 8].position - camera.focalPoint;
    EXPECT_NEAR(a.head<2>().dot(b.head<2>()) / (50.0 * 50.0), std::sqrt(0.5), 1e-12);
    EXPECT_NEAR(a.z(), 10.0, 1e-12);
    EXPECT_EQ(cameras[n].viewUp, camera.viewUp);
  }
  EXPECT_THROW(turntable(camera, 1), core::InvalidParameter);
  EXPECT_THROW(turntable(camera, kMaxFrames + 1), core::InvalidParameter);
}

TEST(Flight, GoesEvenlyAlongALineAndLooksAhead)
{
  // A corner, and a point twice.
  const std::vector<Vector3d> line{
      {0.0, 0.0, 0.0}, {10.0, 0.0, 0.0}, {10.0, 0.0, 0.0}, {10.0, 20.0, 0.0}};
  const auto cameras = flight(line, 31);
  ASSERT_EQ(cameras.size(), 31U);
  for (int n = 0; n <= 30; ++n)
  {
    const Vector3d expected = n <= 10 ? Vector3d(n, 0.0, 0.0) : Vector3d(10.0, n - 10.0, 0.0);
    EXPECT_LT((cameras[static_cast<std::size_t>(n)].position - expected).norm(), 1e-9) << n;
  }
  for (const core::CameraPose& camera : cameras)
  {
    const Vector3d ahead = (camera.focalPoint - camera.position).normalized();
    EXPECT_NEAR(camera.viewUp.norm(), 1.0, 1e-12);
    EXPECT_NEAR(camera.viewUp.dot(ahead), 0.0, 1e-12);
    EXPECT_NEAR(camera.viewUp.z(), 1.0, 1e-9) << "in a horizontal line superior stays up";
  }
  EXPECT_NEAR((cameras[0].focalPoint - cameras[0].position).normalized().x(), 1.0, 1e-12);
  EXPECT_NEAR((cameras[30].focalPoint - cameras[30].position).normalized().y(), 1.0, 1e-12);
  EXPECT_THROW(flight({{1.0, 1.0, 1.0}, {1.0, 1.0, 1.0}}, 10), core::InvalidParameter);
}

TEST(Flight, FollowsACanalWhichItHides)
{
  namespace shapes = presenters::testing;
  const core::GridGeometry grid({60, 24, 24}, Vector3d::Constant(0.5), {0.0, 0.0, 0.0});
  const Vector3d from(3.0, 6.0, 6.0);
  const Vector3d to(27.0, 6.0, 6.0);
  scene::Case value = shapes::shapeCase(grid, {{"canal", shapes::cylinder(from, to, 2.0)}});
  value.labels.front().structures.front().look.shown = true;
  const auto cameras = flightAlong(value, "canal", 20);
  ASSERT_EQ(cameras.size(), 20U);
  EXPECT_FALSE(scene::findStructure(value, "canal")->look.shown);
  for (const core::CameraPose& camera : cameras) // within a voxel of the axis
    EXPECT_LT((camera.position - Vector3d(camera.position.x(), 6.0, 6.0)).norm(), 0.5);
  EXPECT_NEAR(std::abs(cameras.back().position.x() - cameras.front().position.x()), 24.0, 1.0);
  EXPECT_THROW(flightAlong(value, "nothing", 20), core::InvalidParameter);
}
