#include "petrous/Haptics/ConstrainedProxy.h"

#include <gtest/gtest.h>

#include "SurfaceErrors.h"

using namespace petrous::haptics;
using namespace petrous::haptics::testing;

namespace
{

constexpr double kHalf = 7.5; // mm, of the scanned cube

SurfaceErrors follow(const AnalyticSurface& surface, double h, double radius,
                     const PointShell& shell)
{
  const Scene scene = sceneOf(scanOf(surface.distance, h, kHalf));
  ConstrainedProxy proxy(scene.field, shell);
  bool placed = false;
  return followSurface(surface, radius, 2500, 0.002,
                       [&](const Pose& goal) -> const ProxyTick&
                       {
                         if (!placed)
                           proxy.place(goal);
                         placed = true;
                         return proxy.step(goal);
                       });
}

void expectWithinBounds(const SurfaceErrors& errors, double h)
{
  EXPECT_GT(errors.ticks, 2400) << "it must stay in contact";
  EXPECT_LE(std::abs(errors.bias), 0.05 * h);
  EXPECT_LE(errors.ripple, 0.02 * h);
  EXPECT_LE(errors.meanAngle, 1.0);
  EXPECT_LE(errors.maxAngle, 3.0);
  EXPECT_LE(errors.worstSum, 1e-9);
}

class OnSurface : public ::testing::TestWithParam<bool>
{
};

} // namespace

// Bounds: bias 0.05 h, ripple 0.02 h, mean angle 1 degree.
TEST_P(OnSurface, HoldsABallWithinAFractionOfAVoxel)
{
  const double radius = 2.0;
  for (const AnalyticSurface& surface : analyticSurfaces(GetParam()))
    for (const double h : {0.1, 0.2, 0.4})
    {
      SCOPED_TRACE(surface.name + (GetParam() ? " tilted, h " : ", h ") + std::to_string(h));
      expectWithinBounds(follow(surface, h, radius, ballShell(radius, 800)), h);
    }
}

TEST_P(OnSurface, HoldsABurrWithItsShaftAsWell)
{
  const double h = 0.3;
  BurrShape shape;
  shape.radius = 1.5;
  shape.shaftLength = 12.0;
  shape.handpieceRadius = 0.0;
  const PointShell shell = makeBurrShell(shape, h, 800);
  for (const AnalyticSurface& surface : analyticSurfaces(GetParam()))
  {
    SCOPED_TRACE(surface.name + (GetParam() ? " tilted" : ""));
    expectWithinBounds(follow(surface, h, shape.radius, shell), h);
  }
}

INSTANTIATE_TEST_SUITE_P(ConstrainedProxy, OnSurface, ::testing::Bool(),
                         [](const auto& tilted)
                         { return std::string(tilted.param ? "Tilted" : "AxisAligned"); });

// A frictionless ball receives no torque, however its points are arranged.
TEST(ConstrainedProxy, GivesABallNoTorque)
{
  const double radius = 2.0;
  const AnalyticSurface surface = ballSurface(surfaceTurn(true));
  const SurfaceErrors errors = follow(surface, 0.2, radius, ballShell(radius, 300));
  EXPECT_GT(errors.ticks, 2400);
  EXPECT_LE(errors.worstTorque, 1e-6);
}

// At half the voxel size, at most half the allowed error: the error in millimetres decreases.
TEST(ConstrainedProxy, ComesNearerToTheSurfaceWithSmallerVoxels)
{
  const double radius = 2.0;
  const AnalyticSurface surface = torusSurface(surfaceTurn(true));
  const auto error = [&](double h)
  {
    const SurfaceErrors errors = follow(surface, h, radius, ballShell(radius, 800));
    return std::hypot(errors.bias, errors.ripple);
  };
  EXPECT_LT(error(0.2), 0.7 * error(0.4));
}
