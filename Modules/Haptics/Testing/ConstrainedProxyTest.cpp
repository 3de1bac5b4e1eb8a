#include "petrous/Haptics/ConstrainedProxy.h"

#include <limits>

#include <gtest/gtest.h>

#include "ProxyChecks.h"
#include "SurfaceErrors.h"
#include "petrous/Core/Error.h"

using namespace petrous::haptics;
using namespace petrous::haptics::testing;
using Eigen::Quaterniond;
using Eigen::Vector3d;

namespace
{

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

Scene floorScene(double h = 0.3, double half = 6.0)
{
  return sceneOf(scanOf(plane(Vector3d::UnitZ()), h, half));
}

std::string refusalOf(const ProxyParameters& parameters)
{
  static const Scene scene = sceneOf(scanOf(plane(Vector3d::UnitZ()), 1.0, 3.0));
  try
  {
    const ConstrainedProxy proxy(scene.field, pointShell(), parameters);
  }
  catch (const petrous::core::InvalidParameter& error)
  {
    return error.what();
  }
  return "";
}

} // namespace

TEST(ConstrainedProxy, RefusesParametersOutOfTheirDomain)
{
  const auto with = [](auto member, auto value)
  {
    ProxyParameters parameters;
    parameters.*member = value;
    return refusalOf(parameters);
  };
  EXPECT_EQ(refusalOf({}), "");
  EXPECT_NE(with(&ProxyParameters::stiffness, 0.0).find("stiffness"), std::string::npos);
  EXPECT_NE(with(&ProxyParameters::stiffness, kNan).find("stiffness"), std::string::npos);
  EXPECT_NE(with(&ProxyParameters::angularStiffness, -1.0).find("angular"), std::string::npos);
  EXPECT_NE(with(&ProxyParameters::nearGap, 3.0).find("near gap"), std::string::npos);
  EXPECT_NE(with(&ProxyParameters::sweepStep, 2.0).find("sweep"), std::string::npos);
  EXPECT_NE(with(&ProxyParameters::bisections, 0).find("bisections"), std::string::npos);
  EXPECT_NE(with(&ProxyParameters::rounds, 0).find("rounds"), std::string::npos);
  EXPECT_NE(with(&ProxyParameters::deadband, kNan).find("deadband"), std::string::npos);
  EXPECT_NE(with(&ProxyParameters::samples, 10).find("samples"), std::string::npos);
}

TEST(ConstrainedProxy, RefusesAShellWithoutPointsOrNormalsAndNoField)
{
  const Scene scene = sceneOf(scanOf(plane(Vector3d::UnitZ()), 1.0, 3.0));
  EXPECT_THROW(ConstrainedProxy(scene.field, PointShell{}), petrous::core::InvalidParameter);
  PointShell bald = pointShell();
  bald.normals.clear();
  EXPECT_THROW(ConstrainedProxy(scene.field, bald), petrous::core::InvalidParameter);
  EXPECT_THROW(ConstrainedProxy(nullptr, pointShell()), petrous::core::InvalidParameter);
}

// Equation 1 with M = K: the wrench is the contacts', for any contacts.
TEST(ConstrainedProxy, GivesTheSumOfItsContactsForcesAndTorques)
{
  const double h = 0.3;
  const Scene scene = sceneOf(scanOf(wedge(0.6, surfaceTurn(true)), h, 9.0));
  ConstrainedProxy proxy(scene.field, shortBurr(1.0, 7.0, h, 400));
  const Pose start = poseAt(surfaceTurn(true) * Vector3d(0.0, 0.0, 3.0));
  proxy.place(start);
  RandomHand hand(5, start, 3.5);
  int pressed = 0;
  int several = 0;
  for (int t = 0; t < 1500; ++t)
  {
    const ProxyTick& tick = proxy.step(hand.tick());
    if (tick.contactCount == 0)
    {
      ASSERT_LT(tick.wrench.linear.norm() + tick.wrench.angular.norm(), 1e-9);
      continue;
    }
    ++pressed;
    several += tick.contactCount > 1;
    ASSERT_LT(tick.contactCount, ProxyTick::kMaxContacts);
    ASSERT_LE(sumError(tick), 1e-9);
    double thrust = 0.0;
    for (std::size_t n = 0; n < tick.contactCount; ++n)
    {
      ASSERT_GE(tick.contacts[n].thrust, 0.0);
      ASSERT_NEAR(tick.contacts[n].normal.norm(), 1.0, 1e-9);
      if (tick.contacts[n].point < proxy.shell().burrCount)
        thrust += tick.contacts[n].thrust;
    }
    ASSERT_NEAR(tick.thrust, thrust, 1e-9 * std::max(1.0, thrust));
  }
  EXPECT_GT(pressed, 200);
  EXPECT_GT(several, 50);
}

TEST(ConstrainedProxy, StaysWithoutForceAtAGoalThatIsNoNumber)
{
  const Scene scene = floorScene();
  ConstrainedProxy proxy(scene.field, ballShell(1.0, 200));
  proxy.place(poseAt({0.0, 0.0, 2.0}));
  for (int t = 0; t < 5; ++t)
    proxy.step(poseAt({0.0, 0.0, 0.0}));
  const Pose before = proxy.pose();
  const double infinity = std::numeric_limits<double>::infinity();
  for (const Pose& bad : {poseAt({kNan, 0.0, 0.0}), poseAt({0.0, infinity, 0.0}),
                          poseAt({0.0, 0.0, 0.0}, Quaterniond(kNan, 0.0, 0.0, 0.0)),
                          poseAt({0.0, 0.0, 0.0}, Quaterniond(0.0, 0.0, 0.0, 0.0))})
  {
    const ProxyTick& tick = proxy.step(bad);
    EXPECT_EQ(tick.status, ProxyStatus::BadGoal);
    EXPECT_EQ(tick.contactCount, 0U);
    EXPECT_EQ(tick.thrust, 0.0);
    EXPECT_EQ(tick.wrench.linear.norm() + tick.wrench.angular.norm(), 0.0);
    EXPECT_EQ(tick.pose.position, before.position);
    EXPECT_EQ(tick.pose.rotation.coeffs(), before.rotation.coeffs());
  }
  EXPECT_EQ(proxy.step(poseAt({0.0, 0.0, 0.0})).status, ProxyStatus::Contact);
}

// q and -q are the same rotation; devices may send either.
TEST(ConstrainedProxy, TakesAQuaternionOfEitherSign)
{
  const Scene scene = floorScene();
  ConstrainedProxy proxy(scene.field, shortBurr(1.0, 6.0, 0.3, 300));
  const Quaterniond turn(Eigen::AngleAxisd(0.5, Vector3d(1.0, 0.3, 0.2).normalized()));
  proxy.place(poseAt({0.0, 0.0, 2.0}, turn));
  for (int t = 0; t < 20; ++t)
    proxy.step(poseAt({0.0, 0.0, 0.5}, turn));
  const Wrench one = proxy.step(poseAt({0.0, 0.0, 0.5}, turn)).wrench;
  const Quaterniond other(-turn.w(), -turn.x(), -turn.y(), -turn.z());
  const Wrench same = proxy.step(poseAt({0.0, 0.0, 0.5}, other)).wrench;
  EXPECT_GT(one.linear.norm(), 0.4);
  EXPECT_LT((one.linear - same.linear).norm(), 1e-3);
  EXPECT_LT((one.angular - same.angular).norm(), 1e-2);
}

TEST(ConstrainedProxy, IsFreeInAnEmptyVolume)
{
  const Scene scene = sceneOf(scanOf([](const Vector3d&) { return -2.0; }, 0.5, 6.0));
  const PointShell shell = shortBurr(1.5, 10.0, 0.5, 400);
  ConstrainedProxy proxy(scene.field, shell);
  const Pose start;
  proxy.place(start);
  RandomHand hand(2, start, 4.0);
  for (int t = 0; t < 500; ++t)
  {
    const Pose goal = hand.tick();
    const ProxyTick& tick = proxy.step(goal);
    ASSERT_EQ(tick.status, ProxyStatus::Free);
    ASSERT_LT((tick.pose.position - goal.position).norm(), 2e-3);
    ASSERT_LT(tick.wrench.linear.norm(), 2e-3);
    ASSERT_EQ(tick.contactCount, 0U);
  }
}

TEST(ConstrainedProxy, FollowsAGoalThatJumpsThroughAir)
{
  const Scene scene = sceneOf(scanOf([](const Vector3d&) { return -2.0; }, 0.5, 30.0));
  ConstrainedProxy proxy(scene.field, shortBurr(1.5, 10.0, 0.5, 400));
  proxy.place(poseAt({-25.0, 0.0, 0.0}));
  const Pose goal =
      poseAt({25.0, 3.0, 0.0}, Quaterniond(Eigen::AngleAxisd(2.0, Vector3d::UnitX())));
  proxy.step(goal);
  EXPECT_LT((proxy.pose().position - goal.position).norm(), 2e-3);
  EXPECT_LT(proxy.pose().rotation.angularDistance(goal.rotation), 1e-3);
}

TEST(ConstrainedProxy, StopsBeforeTissueWhenTheGoalJumpsBeyondIt)
{
  const double h = 0.5;
  const Scene scene = sceneOf(scanOf(plate(Vector3d(1.0, 0.2, 0.1), 1.2 * h), h, 30.0));
  const PointShell shell = shortBurr(1.5, 10.0, h, 400);
  const Vector3d normal = Vector3d(1.0, 0.2, 0.1).normalized();
  ConstrainedProxy proxy(scene.field, shell);
  proxy.place(poseAt(25.0 * normal));
  for (int t = 0; t < 8; ++t)
  {
    const ProxyTick& tick = proxy.step(poseAt(-25.0 * normal));
    ASSERT_LE(deepest(*scene.tissue, shell, tick.pose), 0.0);
    ASSERT_GT(normal.dot(tick.pose.position), 1.5 - h);
  }
  EXPECT_LT(normal.dot(proxy.pose().position), 1.5 + 1.5 * h);
  EXPECT_EQ(proxy.step(poseAt(-25.0 * normal)).status, ProxyStatus::Contact);
}

TEST(ConstrainedProxy, LeavesTheGridAndComesBackToTheBone)
{
  const double h = 0.3;
  const Scene scene = floorScene(h, 6.0);
  const PointShell shell = ballShell(1.0, 300);
  ConstrainedProxy proxy(scene.field, shell);
  proxy.place(poseAt({0.0, 0.0, 3.0}));
  for (const Vector3d& far : {Vector3d(0.0, 0.0, 40.0), Vector3d(100.0, -30.0, 20.0),
                              Vector3d(0.0, 0.0, 1e6), Vector3d(0.0, 0.0, 3.0)})
    for (int t = 0; t < 100 && (proxy.pose().position - far).norm() > 2e-3; ++t)
      EXPECT_EQ(proxy.step(poseAt(far)).status, ProxyStatus::Free);
  for (int t = 0; t < 5; ++t)
    proxy.step(poseAt({0.0, 0.0, 0.0}));
  EXPECT_EQ(proxy.step(poseAt({0.0, 0.0, 0.0})).status, ProxyStatus::Contact);
  EXPECT_NEAR(proxy.pose().position.z(), 1.0, 0.05 * h);
}

// The work of a tick is bounded; following ticks make the rest of the motion, and the tool comes to
// rest where a single unbounded tick puts it.
TEST(ConstrainedProxy, MakesAWayTooLongForOneTickInThoseThatFollow)
{
  const double h = 0.3;
  const Scene scene = sceneOf(scanOf(wedge(0.6, surfaceTurn(true)), h, 9.0));
  const PointShell shell = ballShell(1.0, 800);
  const Eigen::Matrix3d turn = surfaceTurn(true);
  const Pose start = poseAt(turn * Vector3d(2.5, 0.0, 4.0));
  const Pose goal = poseAt(turn * Vector3d(0.4, 2.0, -1.0)); // pressed into the valley
  ProxyParameters bounded, free;
  bounded.samples = 400;
  free.samples = 1000000;
  ConstrainedProxy inTicks(scene.field, shell, bounded);
  ConstrainedProxy atOnce(scene.field, shell, free);
  inTicks.place(start);
  atOnce.place(start);
  for (int t = 0; t < 20; ++t)
    atOnce.step(goal);
  int ticks = 0;
  int postponed = 0;
  std::size_t most = 0;
  for (; ticks < 400; ++ticks)
  {
    const Vector3d before = inTicks.pose().position;
    const ProxyTick& tick = inTicks.step(goal);
    most = std::max(most, tick.samples);
    postponed += tick.postponed > 0.0;
    ASSERT_LE(deepest(*scene.tissue, shell, tick.pose), 0.0);
    if ((inTicks.pose().position - before).norm() < 1e-6)
      break;
  }
  EXPECT_GT(ticks, 3);
  EXPECT_LT(ticks, 400);
  EXPECT_GT(postponed, 1);
  EXPECT_EQ(inTicks.step(goal).postponed, 0.0);
  EXPECT_EQ(atOnce.step(goal).postponed, 0.0);
  // Beyond the bound: the last stretch, where every point may be examined a few times.
  EXPECT_LT(most, 400u + 6u * 800u);
  EXPECT_LT((inTicks.pose().position - atOnce.pose().position).norm(), 0.02 * h);
  EXPECT_NEAR(inTicks.step(goal).wrench.linear.norm(), atOnce.step(goal).wrench.linear.norm(),
              0.02);
}

// Along a plane that is near enough to be examined and not touched, it is the distance left.
TEST(ConstrainedProxy, TellsHowMuchOfItsWayATickLeavesToTheNext)
{
  const Scene scene = floorScene();
  ProxyParameters bounded;
  bounded.samples = 100;
  ConstrainedProxy proxy(scene.field, ballShell(1.0, 800), bounded);
  proxy.place(poseAt({-3.0, 0.0, 1.03}));
  const Pose goal = poseAt({3.0, 0.0, 1.03});
  int postponed = 0;
  for (int t = 0; t < 200; ++t)
  {
    const double left = proxy.step(goal).postponed;
    const double distance = (proxy.pose().position - goal.position).norm();
    if (left > 0.0)
    {
      EXPECT_NEAR(left, distance, 1e-6) << t;
    }
    else
    {
      EXPECT_LT(distance, bounded.deadband) << t;
    }
    postponed += left > 0.0;
  }
  EXPECT_GT(postponed, 2);
  EXPECT_LT(postponed, 150);
}
