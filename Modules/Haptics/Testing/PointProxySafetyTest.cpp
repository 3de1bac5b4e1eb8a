#include "petrous/Haptics/PointProxy.h"

#include <random>

#include <gtest/gtest.h>

#include "SurfaceErrors.h"

using namespace petrous;
using namespace petrous::haptics;
using namespace petrous::haptics::testing;
using Eigen::Vector3d;

namespace
{

constexpr double kStiffness = 1.0; // N/mm, of ProxyParameters

Pose at(const Vector3d& position)
{
  return {position, Eigen::Quaterniond::Identity()};
}

Vector3d randomVector(std::mt19937& random, double size)
{
  std::uniform_real_distribution<double> component(-size, size);
  const double x = component(random);
  const double y = component(random);
  return {x, y, component(random)};
}

/// Sets the whole mask: 0 removes all tissue, kUntouched restores it.
void setAll(const Scene& scene, std::uint16_t value, bool raised)
{
  auto brick = std::make_shared<volume::CutMask::Brick>();
  brick->fill(value);
  std::vector<std::size_t> bricks;
  for (std::size_t b = 0; b < scene.mask->brickCount(); ++b)
  {
    scene.mask->setBrick(b, value == volume::CutMask::kUntouched ? nullptr : brick);
    bricks.push_back(b);
  }
  scene.published->publish(*scene.mask, bricks, raised);
}

} // namespace

// The centre as a point on plane, ball and torus. Bounds as in ConstrainedProxySurfaceTest or
// tighter.
TEST(PointProxy, HoldsTheCentreToTheSurface)
{
  const double h = 0.2;
  for (const bool tilted : {false, true})
    for (const AnalyticSurface& surface : analyticSurfaces(tilted))
    {
      SCOPED_TRACE(surface.name + (tilted ? " tilted" : ""));
      if (surface.name == "wedge")
        continue; // at the floor the field is rounded: see the test below
      const Scene scene = sceneOf(scanOf(surface.distance, h, 7.5));
      PointProxy proxy(scene.field, {2.0, 100, 0.0});
      bool placed = false;
      const SurfaceErrors errors = followSurface(surface, 0.0, 2500, 0.002,
                                                 [&](const Pose& goal) -> const ProxyTick&
                                                 {
                                                   if (!placed)
                                                     proxy.place(goal);
                                                   placed = true;
                                                   return proxy.step(goal);
                                                 });
      EXPECT_GT(errors.ticks, 2400);
      EXPECT_LE(std::abs(errors.bias), 0.05 * h);
      EXPECT_LE(errors.ripple, 0.02 * h);
      EXPECT_LE(errors.meanAngle, 0.5);
      EXPECT_LE(errors.maxAngle, 1.5);
      EXPECT_LE(errors.worstSum, 1e-9);
      EXPECT_EQ(errors.worstTorque, 0.0);
    }
}

// Down the walls and along the floor of a valley, which interpolation rounds within a voxel.
TEST(PointProxy, SlidesAlongTheFloorOfAValleyAndRestsThere)
{
  const double h = 0.2;
  for (const bool tilted : {false, true})
  {
    SCOPED_TRACE(tilted ? "tilted" : "axis-aligned");
    const Eigen::Matrix3d turn = surfaceTurn(tilted);
    const AnalyticSurface valley = wedgeSurface(turn);
    const Scene scene = sceneOf(scanOf(valley.distance, h, 6.0));
    PointProxy proxy(scene.field, {2.0, 100, 0.0});
    for (double along = -2.0; along < 2.0; along += 0.1)
    {
      const Vector3d goal = turn * Vector3d(0.2 * std::sin(9.0 * along), along, -0.7);
      proxy.place(at(turn * Vector3d(1.0, -2.5, 3.0)));
      for (int t = 0; t < 50; ++t)
        proxy.step(at(goal));
      const ProxyTick tick = proxy.step(at(goal));
      EXPECT_LT((tick.pose.position - valley.held(goal, 0.0)).norm(), 0.75 * h) << along;
      EXPECT_LT(std::abs(turn.col(1).dot(tick.pose.position - goal)), 0.4 * h) << along;
      const Vector3d spring = kStiffness * (tick.pose.position - goal);
      EXPECT_LT((tick.wrench.linear - spring).norm(), 0.01) << "nothing holds it but the walls";
      for (int t = 0; t < 100; ++t)
        proxy.step(at(goal));
      EXPECT_LT((proxy.pose().position - tick.pose.position).norm(), 1e-3) << "held still";
    }
  }
}

TEST(PointProxy, RestsInACornerOfThreeWallsUntilTheyAreCut)
{
  const double h = 0.2;
  const Eigen::Matrix3d turn = surfaceTurn(true);
  const auto walls = [&](const Vector3d& p) { return (-(turn.transpose() * p)).maxCoeff(); };
  const Scene scene = sceneOf(scanOf(walls, h, 5.0));
  PointProxy proxy(scene.field, {1.0, 100, 0.0});
  proxy.place(at(turn * Vector3d(2, 2, 2)));
  const Vector3d goal = turn * Vector3d(-0.5, -1.0, -0.7);
  for (int t = 0; t < 30; ++t)
    proxy.step(at(goal));
  const ProxyTick tick = proxy.step(at(goal));
  EXPECT_LT(tick.pose.position.norm(), 0.5 * h);
  EXPECT_LT((tick.wrench.linear - kStiffness * (tick.pose.position - goal)).norm(), 0.01);
  EXPECT_LT(sumError(tick), 1e-9);
  for (int t = 0; t < 1000; ++t)
    proxy.step(at(goal));
  EXPECT_LT((proxy.pose().position - tick.pose.position).norm(), 1e-3) << "held still";

  setAll(scene, 0, false);
  EXPECT_LT((proxy.step(at(goal)).pose.position - goal).norm(), 1e-9);
  EXPECT_EQ(proxy.step(at(goal)).wrench.linear.norm(), 0.0);
}

TEST(PointProxy, NeverCrossesAThinPlate)
{
  const double h = 0.3;
  std::mt19937 random(11);
  int beyond = 0;
  for (const double thickness : {1.0, 1.3, 1.6, 2.0})
    for (const Vector3d& normal : {Vector3d(0, 0, 1), Vector3d(0.3, -0.5, 0.8).normalized()})
    {
      const Scene scene = sceneOf(scanOf(plate(normal, thickness * h), h, 9.0));
      PointProxy proxy(scene.field, {2.0, 100, 2.0 / 3.0});
      Vector3d goal = 2.0 * normal;
      Vector3d velocity = Vector3d::Zero(); // mm per tick; 1 is 1 m/s
      proxy.place(at(goal));
      for (int t = 0; t < 12500; ++t)
      {
        velocity += randomVector(random, 0.3) - 0.01 * goal;
        if (velocity.norm() > 1.0)
          velocity.normalize();
        if ((goal + velocity).norm() > 4.0)
          velocity = -goal.normalized();
        goal += velocity;
        const ProxyTick& tick = proxy.step(at(goal));
        beyond += goal.dot(normal) < -thickness * h;
        ASSERT_GT(tick.pose.position.dot(normal), 0.0) << thickness << ' ' << t;
        ASSERT_LE(scene.tissue->value(tick.pose.position), 1e-9);
      }
    }
  EXPECT_GT(beyond, 20000) << "the hand must often be on the other side";
}

TEST(PointProxy, KeepsItsPlaceWhenTheGoalIsNoPose)
{
  const Scene scene = sceneOf(scanOf(plane({0, 0, 1}), 0.3, 5.0));
  PointProxy proxy(scene.field, {2.0, 200, 1.0});
  proxy.place(at({0, 0, 3}));
  const Vector3d before = proxy.step(at({0.2, 0, -1})).wrench.linear;
  const Vector3d place = proxy.pose().position;
  const double nan = std::numeric_limits<double>::quiet_NaN();
  Pose turnless;
  turnless.rotation.coeffs().setZero();
  for (const Pose& bad : {at({nan, 0, 0}), at({0, 0, 1.0 / 0.0}), turnless})
  {
    proxy.place(bad);
    const ProxyTick& tick = proxy.step(bad);
    EXPECT_EQ(tick.status, ProxyStatus::BadGoal);
    EXPECT_EQ(tick.wrench.linear.norm(), 0.0);
    EXPECT_EQ(tick.contactCount, 0U);
    EXPECT_EQ(tick.thrust, 0.0);
    EXPECT_EQ(proxy.pose().position, place);
  }
  EXPECT_LT((proxy.step(at({0.2, 0, -1})).wrench.linear - before).norm(), 1e-3);
}

TEST(PointProxy, GivesNoForceInsideUntilItsCentreIsFree)
{
  const Scene scene = sceneOf(scanOf(plane({0, 0, 1}), 0.3, 5.0));
  PointProxy proxy(scene.field, {2.0, 200, 1.0});
  proxy.place(at({0, 0, -2}));
  for (const double z : {-2.0, -1.0, -0.2})
  {
    const ProxyTick& tick = proxy.step(at({0, 0, z}));
    EXPECT_EQ(tick.status, ProxyStatus::Inside);
    EXPECT_EQ(tick.wrench.linear.norm(), 0.0);
    EXPECT_EQ(tick.pose.position.z(), z);
  }
  EXPECT_EQ(proxy.step(at({0, 0, 0.2})).status, ProxyStatus::Free);
  const ProxyTick& tick = proxy.step(at({0, 0, -1}));
  EXPECT_EQ(tick.status, ProxyStatus::Contact);
  EXPECT_GT(tick.pose.position.z(), 0.0);
  EXPECT_GT(tick.wrench.linear.z(), kStiffness);
}

TEST(PointProxy, GoesBackOnItsPathWhereTissueReturns)
{
  const Scene scene = sceneOf(scanOf(plane({0, 0, 1}), 0.3, 5.0));
  setAll(scene, 0, false);
  PointProxy proxy(scene.field, {1.0, 200, 1.0});
  proxy.place(at({0, 0, 3}));
  for (double z = 3.0; z > -2.0; z -= 0.1)
    ASSERT_EQ(proxy.step(at({0, 0, z})).status, ProxyStatus::Free);
  PointProxy pathless(scene.field, {1.0, 200, 1.0});
  pathless.place(at({0, 0, -2}));
  ASSERT_EQ(pathless.step(at({0, 0, -2})).status, ProxyStatus::Free);

  setAll(scene, volume::CutMask::kUntouched, true);
  const ProxyTick& tick = proxy.step(at({0, 0, -2}));
  EXPECT_EQ(tick.status, ProxyStatus::Retreated);
  EXPECT_GT(tick.pose.position.z(), 0.0);
  EXPECT_LT(tick.pose.position.z(), 0.3);
  EXPECT_EQ(proxy.step(at({0, 0, -2})).status, ProxyStatus::Contact);
  EXPECT_EQ(pathless.step(at({0, 0, -2})).status, ProxyStatus::Inside);
  EXPECT_EQ(pathless.step(at({0, 0, -2})).wrench.linear.norm(), 0.0);
}
