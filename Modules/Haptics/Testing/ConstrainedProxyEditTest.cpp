#include "petrous/Haptics/ConstrainedProxy.h"

#include <gtest/gtest.h>

#include "ProxyChecks.h"

using namespace petrous::haptics;
using namespace petrous::haptics::testing;
using Eigen::Quaterniond;
using Eigen::Vector3d;

namespace
{

constexpr double kVoxel = 0.3;
constexpr double kRadius = 1.0;
const Pose kAbove = poseAt({0.0, 0.0, 2.5});
const Pose kPressed = poseAt({0.0, 0.0, -1.5}); // 2.5 mm below first contact with bone

Scene bone()
{
  return sceneOf(scanOf(plane(Vector3d::UnitZ()), kVoxel, 6.0));
}

bool forceless(const ProxyTick& tick)
{
  return tick.wrench.linear.isZero(0.0) && tick.wrench.angular.isZero(0.0) && tick.thrust == 0.0 &&
         tick.contactCount == 0;
}

} // namespace

TEST(ConstrainedProxy, GivesNoForceWhileItIsPlacedInTissueUntilItIsFree)
{
  const Scene scene = bone();
  const PointShell shell = ballShell(kRadius, 300);
  ConstrainedProxy proxy(scene.field, shell);
  proxy.place(poseAt({0.0, 0.0, -1.5}));
  bool wasFree = false;
  for (int t = 0; t <= 1000; ++t)
  {
    const Pose goal = poseAt({0.0, 0.0, -1.5 + 0.004 * t});
    const ProxyTick& tick = proxy.step(goal);
    const double deep = deepest(*scene.tissue, shell, tick.pose);
    if (tick.status == ProxyStatus::Inside)
    {
      ASSERT_FALSE(wasFree);
      ASSERT_TRUE(forceless(tick));
      ASSERT_GT(deep, 0.0);
      // The ball's lowest point, of 300; no depth beyond the ball's radius is reported.
      ASSERT_NEAR(tick.penetration, std::min(kRadius - goal.position.z(), kRadius), 0.02);
      ASSERT_EQ(tick.pose.position, goal.position) << "it goes where the hand goes";
      continue;
    }
    ASSERT_LE(deep, 0.0);
    ASSERT_EQ(tick.penetration, 0.0);
    if (!wasFree)
    {
      EXPECT_NEAR(tick.pose.position.z(), kRadius, 0.05 * kVoxel + 0.004);
    }
    wasFree = true;
  }
  EXPECT_TRUE(wasFree);
  EXPECT_EQ(proxy.step(kPressed).status, ProxyStatus::Contact);
}

// The cavity is a ball of 1.6 mm: the burr of 1 mm sinks until it touches the floor.
TEST(ConstrainedProxy, SinksIntoTheHoleThatIsCutUnderIt)
{
  Scene scene = bone();
  const PointShell shell = ballShell(kRadius, 400);
  ConstrainedProxy proxy(scene.field, shell);
  proxy.place(kAbove);
  for (int t = 0; t < 5; ++t)
    proxy.step(kPressed);
  double height = proxy.pose().position.z();
  ASSERT_NEAR(height, kRadius, 0.05 * kVoxel);
  for (int cut = 1; cut <= 40; ++cut)
  {
    cutBall(scene, Vector3d(0.0, 0.0, 1.2 - 0.03 * cut), 1.6);
    for (int t = 0; t < 5; ++t)
    {
      const ProxyTick& tick = proxy.step(kPressed);
      ASSERT_LE(tick.pose.position.z(), height + 0.05 * kVoxel) << "it only sinks";
      ASSERT_LE(deepest(*scene.tissue, shell, tick.pose), 0.0);
      ASSERT_EQ(tick.status, ProxyStatus::Contact);
      height = std::min(height, tick.pose.position.z());
    }
  }
  // Floor of the last cut at z = -1.6; the mask's edge is a ramp one voxel wide around the ball,
  // its interpolation error is at most h^2/(8 r) to either side.
  EXPECT_NEAR(height, -1.6 + kRadius, 0.05 * kVoxel + 3.0 * kVoxel * kVoxel / 8.0 / 1.6);
}

TEST(ConstrainedProxy, GoesBackOnItsPathWhenTissueComesBackRoundIt)
{
  Scene scene = bone();
  const PointShell shell = ballShell(kRadius, 400);
  const Vector3d centre(0.0, 0.0, -0.4);
  cutBall(scene, centre, 1.6);
  ConstrainedProxy proxy(scene.field, shell);
  proxy.place(kAbove);
  for (int t = 0; t < 20; ++t)
    proxy.step(kPressed);
  ASSERT_LT(proxy.pose().position.z(), 0.0) << "it must lie in the hole";
  cutBall(scene, centre, 1.6, true);
  const ProxyTick& tick = proxy.step(kPressed);
  EXPECT_EQ(tick.status, ProxyStatus::Retreated);
  EXPECT_LE(deepest(*scene.tissue, shell, tick.pose), 0.0);
  EXPECT_GT(tick.pose.position.z(), kRadius - 0.05 * kVoxel);
  const ProxyTick& next = proxy.step(kPressed);
  EXPECT_EQ(next.status, ProxyStatus::Contact);
  EXPECT_NEAR(next.pose.position.z(), kRadius, 0.05 * kVoxel);
}

// Placed in the hole: there is no path back.
TEST(ConstrainedProxy, GivesNoForceWhenTissueComesBackAndNoWayOutIsKnown)
{
  Scene scene = bone();
  const PointShell shell = ballShell(kRadius, 400);
  const Vector3d centre(0.0, 0.0, -2.0);
  cutBall(scene, centre, 1.6);
  ConstrainedProxy proxy(scene.field, shell);
  proxy.place(poseAt(centre));
  EXPECT_EQ(proxy.step(poseAt(centre)).status, ProxyStatus::Free);
  for (int t = 0; t < 5; ++t) // all of the ball is near: a tick makes part of the motion
    proxy.step(poseAt({0.0, 0.0, -3.0}));
  EXPECT_EQ(proxy.step(poseAt({0.0, 0.0, -3.0})).status, ProxyStatus::Contact);
  cutBall(scene, centre, 1.6, true);
  for (int t = 0; t < 10; ++t)
  {
    const ProxyTick& tick = proxy.step(poseAt({0.0, 0.0, -3.0}));
    EXPECT_EQ(tick.status, ProxyStatus::Inside);
    EXPECT_TRUE(forceless(tick));
  }
  EXPECT_EQ(proxy.step(kAbove).status, ProxyStatus::Free);
  EXPECT_EQ(proxy.step(kPressed).status, ProxyStatus::Contact);
}

// For any cuts and undos while the device moves: no force from inside tissue, and no pose in tissue
// with contact.
TEST(ConstrainedProxy, IsNeverHeldInTissueWhileCutsAreMadeAndUndone)
{
  Scene scene = bone();
  const PointShell shell = shortBurr(kRadius, 4.0, kVoxel, 300);
  ConstrainedProxy proxy(scene.field, shell);
  proxy.place(kAbove);
  RandomHand hand(9, kAbove, 2.8);
  std::mt19937 random(4);
  std::uniform_real_distribution<double> place(-2.5, 2.5);
  int touched = 0;
  int recovered = 0;
  for (int t = 0; t < 2000; ++t)
  {
    if (t % 20 == 0)
      cutBall(scene, proxy.pose().position, 1.3);
    if (t % 90 == 89)
      cutBall(scene, {place(random), place(random), place(random)}, 2.5, true);
    const ProxyTick& tick = proxy.step(hand.tick());
    touched += tick.contactCount > 0;
    recovered += tick.status == ProxyStatus::Retreated || tick.status == ProxyStatus::Inside;
    if (tick.status == ProxyStatus::Inside)
    {
      ASSERT_TRUE(forceless(tick)) << t;
    }
    else
    {
      ASSERT_LE(deepest(*scene.tissue, shell, tick.pose), 0.0) << t;
    }
  }
  EXPECT_GT(touched, 200);
  EXPECT_GT(recovered, 3);
}
