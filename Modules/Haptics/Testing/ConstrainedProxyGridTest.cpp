#include "petrous/Haptics/ConstrainedProxy.h"

#include <gtest/gtest.h>

#include "ProxyChecks.h"
#include "SurfaceErrors.h"

using namespace petrous;
using namespace petrous::haptics;
using namespace petrous::haptics::testing;
using Eigen::Matrix3d;
using Eigen::Vector3d;

namespace
{

// A grid of at least `half` mm around the origin on every side.
core::GridGeometry gridOf(const Vector3d& spacing, const Matrix3d& direction, double half)
{
  core::Index3 dims;
  Vector3d last;
  for (std::size_t a = 0; a < 3; ++a)
  {
    const auto axis = static_cast<Eigen::Index>(a);
    dims[a] = static_cast<int>(std::ceil(2.0 * half / spacing[axis])) + 1;
    last[axis] = (dims[a] - 1) * spacing[axis];
  }
  return {dims, spacing, -0.5 * direction * last, direction};
}

SurfaceErrors follow(const AnalyticSurface& surface, const core::GridGeometry& grid)
{
  const double radius = 2.0;
  const Scene scene = sceneOf(scanOn(grid, surface.distance));
  ConstrainedProxy proxy(scene.field, ballShell(radius, 800));
  bool placed = false;
  return followSurface(surface, radius, 1500, 0.003,
                       [&](const Pose& goal) -> const ProxyTick&
                       {
                         if (!placed)
                           proxy.place(goal);
                         placed = true;
                         return proxy.step(goal);
                       });
}

Matrix3d turned()
{
  return Eigen::AngleAxisd(0.7, Vector3d(0.5, 1.0, -0.4).normalized()).toRotationMatrix();
}

} // namespace

// Planes are exact in any grid of trilinear cells; the error on curved bone is the sagitta of the
// longest side, s^2/(8 r), whatever its direction.
TEST(ConstrainedProxy, HoldsABallOnPlanesOfLongVoxels)
{
  const Vector3d spacing(0.2, 0.2, 1.0);
  for (const bool tilted : {false, true})
  {
    const SurfaceErrors errors =
        follow(planeSurface(surfaceTurn(tilted)), gridOf(spacing, Matrix3d::Identity(), 6.5));
    SCOPED_TRACE(tilted);
    EXPECT_GT(errors.ticks, 1400);
    EXPECT_LE(std::abs(errors.bias), 0.05 * 0.2);
    EXPECT_LE(errors.ripple, 0.02 * 0.2);
    EXPECT_LE(errors.meanAngle, 1.0);
    EXPECT_LE(errors.maxAngle, 3.0);
    EXPECT_LE(errors.worstSum, 1e-9);
  }
}

TEST(ConstrainedProxy, HoldsABallOnABallOfLongVoxelsWithinTheirSagitta)
{
  const Vector3d spacing(0.2, 0.2, 1.0);
  const SurfaceErrors errors =
      follow(ballSurface(surfaceTurn(true)), gridOf(spacing, Matrix3d::Identity(), 6.5));
  const double sagitta = 1.0 / (8.0 * 3.0);
  EXPECT_GT(errors.ticks, 1400);
  EXPECT_LE(std::abs(errors.bias), sagitta + 0.05 * 0.2);
  EXPECT_LE(errors.ripple, 0.5 * sagitta + 0.02 * 0.2);
  EXPECT_LE(errors.worstSum, 1e-9);
}

TEST(ConstrainedProxy, FeelsTheSameInAGridThatIsTurnedInThePatient)
{
  const double h = 0.3;
  Matrix3d mirrored = turned();
  mirrored.col(1) = -mirrored.col(1); // left-handed axes are allowed
  for (const Matrix3d& direction : {turned(), mirrored})
    for (const AnalyticSurface& surface : analyticSurfaces(false))
    {
      SCOPED_TRACE(surface.name);
      const SurfaceErrors errors = follow(surface, gridOf(Vector3d::Constant(h), direction, 7.5));
      EXPECT_GT(errors.ticks, 1400);
      EXPECT_LE(std::abs(errors.bias), 0.05 * h);
      EXPECT_LE(errors.ripple, 0.02 * h);
      EXPECT_LE(errors.meanAngle, 1.0);
      EXPECT_LE(errors.maxAngle, 3.0);
      EXPECT_LE(errors.worstSum, 1e-9);
    }
}

// Bone that continues beyond the scan ends at the hull of the voxel centres: a box for the tool.
TEST(ConstrainedProxy, RestsOnTheFacesOfAScanThatCutsThroughBone)
{
  const double h = 0.4;
  const double radius = 1.5;
  const Scene scene = sceneOf(scanOf([](const Vector3d&) { return 2.0; }, h, 4.0));
  const Vector3d half = scene.field->geometry().patientBounds().max();
  const PointShell shell = ballShell(radius, 600);
  for (int axis = 0; axis < 3; ++axis)
    for (const double side : {-1.0, 1.0})
    {
      SCOPED_TRACE(::testing::Message() << axis << ' ' << side);
      const Vector3d out = side * Vector3d::Unit(axis);
      const Vector3d across = Vector3d::Unit((axis + 1) % 3);
      ConstrainedProxy proxy(scene.field, shell);
      proxy.place(poseAt((half[axis] + radius + 1.0) * out));
      double worst = 0.0;
      for (int t = 0; t < 300; ++t)
      {
        const Vector3d slide = 1.5 * std::sin(0.02 * t) * across;
        const ProxyTick& tick = proxy.step(poseAt((half[axis] + radius - 1.0) * out + slide));
        ASSERT_LE(deepest(*scene.tissue, shell, tick.pose), 0.0);
        if (t < 20)
          continue;
        ASSERT_EQ(tick.status, ProxyStatus::Contact);
        worst = std::max(worst, std::abs(tick.pose.position.dot(out) - half[axis] - radius));
        // Outside the grid there is no gradient: the shell's own normal gives the outward
        // direction, and its points are up to 0.12 rad from the ball's true contact.
        ASSERT_LT((tick.wrench.linear.normalized() - out).norm(), 0.12);
      }
      EXPECT_LE(worst, 0.05 * h);
    }
}

TEST(ConstrainedProxy, IsNotStuckAtTheEdgesOfAScanThatCutsThroughBone)
{
  const double h = 0.4;
  const double radius = 1.5;
  const Scene scene = sceneOf(scanOf([](const Vector3d&) { return 2.0; }, h, 3.0));
  const Vector3d half = scene.field->geometry().patientBounds().max();
  const PointShell shell = ballShell(radius, 600);
  ConstrainedProxy proxy(scene.field, shell);
  // The goal passes 0.3 mm below the face, over the edge and down the other side.
  const double below = radius - 0.3;
  proxy.place(poseAt({0.0, 0.0, half.z() + radius + 0.5}));
  const auto follow = [&](const Vector3d& to)
  {
    const Vector3d from = proxy.pose().position;
    for (int t = 1; t <= 400; ++t)
    {
      const ProxyTick& tick = proxy.step(poseAt(from + (to - from) * t / 400.0));
      EXPECT_LE(deepest(*scene.tissue, shell, tick.pose), 0.0);
    }
    for (int t = 0; t < 50; ++t)
      proxy.step(poseAt(to));
  };
  follow({0.0, 0.0, half.z() + below});
  follow({half.x() + below, 0.0, half.z() + below});
  follow({half.x() + below, 0.0, 0.0});
  EXPECT_NEAR(proxy.pose().position.x(), half.x() + radius, 0.05 * h);
  EXPECT_NEAR(proxy.pose().position.z(), 0.0, 0.05 * h);
}
