#include "petrous/Haptics/ConstrainedProxy.h"
#include "petrous/Haptics/PointProxy.h"

#include <gtest/gtest.h>

#include "ProxyChecks.h"
#include "SoftScenes.h"
#include "SurfaceErrors.h"

using namespace petrous;
using namespace petrous::haptics;
using namespace petrous::haptics::testing;
using Eigen::Vector3d;

namespace
{

constexpr double kCreep = 0.02; // mm per tick that a tool may move beyond twice the device's motion

ProxyParameters coupling(double stiffness)
{
  ProxyParameters parameters;
  parameters.stiffness = stiffness;
  return parameters;
}

const ProxyTick& settle(ConstrainedProxy& proxy, const Pose& goal, int ticks = 20)
{
  for (int t = 1; t < ticks; ++t)
    proxy.step(goal);
  return proxy.step(goal);
}

// A rod of points, length 2 `half`, along x.
PointShell rod(double half, int count)
{
  PointShell shell;
  for (int n = 0; n < count; ++n)
  {
    shell.points.emplace_back(half * (2.0 * n / (count - 1) - 1.0), 0.0, 0.0);
    shell.normals.emplace_back(0.0, 0.0, -1.0);
  }
  return shell;
}

} // namespace

// One contact, D the goal's depth, d the tool's: the coupling pulls with K (D - d) and the tissue
// pushes back with k d. At rest both equal F = K k / (K + k) D.
TEST(SoftContacts, IsTwoSpringsInARow)
{
  const double radius = 4.0;
  for (const double tissue : {0.2, 1.0, 10.0})
  {
    const Scene scene = softScene({{ball(radius), tissue}});
    for (const double stiffness : {0.5, 2.0})
    {
      ConstrainedProxy proxy(scene.field, pointShell(), coupling(stiffness));
      const Vector3d out = Vector3d(0.4, -0.2, 0.9).normalized();
      proxy.place(poseAt((radius + 0.5) * out));
      for (const double depth : {0.2, 0.6, 1.2, 3.0})
      {
        SCOPED_TRACE(::testing::Message()
                     << tissue << " N/mm, " << stiffness << " N/mm, " << depth << " mm");
        const ProxyTick& tick = settle(proxy, poseAt((radius - depth) * out));
        const double force = depth * stiffness * tissue / (stiffness + tissue);
        EXPECT_EQ(tick.status, ProxyStatus::Contact);
        ASSERT_EQ(tick.contactCount, 1U);
        EXPECT_TRUE(tick.contacts[0].soft);
        // 1 %, plus the effect of 0.02 voxel in the surface's height.
        const double allowed = (0.01 + 0.02 * kSoftVoxel / depth) * force;
        EXPECT_NEAR(tick.contacts[0].thrust, force, allowed);
        EXPECT_LT((tick.wrench.linear - force * out).norm(), 3.0 * allowed);
        EXPECT_LT(sumError(tick), 1e-9);
        EXPECT_NEAR(radius - tick.pose.position.norm(), force / tissue,
                    0.01 * force / tissue + 0.02 * kSoftVoxel);
      }
    }
  }
}

TEST(SoftContacts, DoesNotCountThePointsOfTheTool)
{
  const Vector3d out = Vector3d(0.3, 0.4, 0.8).normalized();
  const Scene scene = softScene({{plane(out), 0.5}});
  for (const std::size_t points : {100, 400, 1600})
  {
    SCOPED_TRACE(points);
    ConstrainedProxy proxy(scene.field, ballShell(1.5, points));
    proxy.place(poseAt(2.5 * out));
    const ProxyTick& tick = settle(proxy, poseAt((1.5 - 0.9) * out));
    EXPECT_NEAR(tick.wrench.linear.norm(), 0.9 / 3.0, 0.003);
    EXPECT_LT((tick.wrench.linear.normalized() - out).norm(), 0.01);
    EXPECT_LT(tick.wrench.angular.norm(), 0.003);
  }
}

TEST(SoftContacts, FeelsABurrOnABallAlongTheirCentres)
{
  const double radius = 3.0;
  const double burr = 1.5;
  const Scene scene = softScene({{ball(radius), 0.5}});
  ConstrainedProxy proxy(scene.field, ballShell(burr, 800));
  Vector3d out = Vector3d::UnitZ();
  proxy.place(poseAt((radius + burr + 0.2) * out));
  for (int t = 0; t < 600; ++t)
  {
    out = Eigen::AngleAxisd(0.003, Vector3d(0.6, 0.8, 0.1).normalized()) * out;
    const ProxyTick& tick = proxy.step(poseAt((radius + burr - 0.6) * out));
    if (t < 50)
      continue;
    ASSERT_EQ(tick.contactCount, 1U);
    ASSERT_NEAR(tick.wrench.linear.norm(), 0.2, 0.006);
    // The tool lags behind the goal; apart from that its force is radial.
    ASSERT_LT((tick.wrench.linear.normalized() - tick.pose.position.normalized()).norm(), 0.03);
    ASSERT_LT(tick.wrench.angular.norm(), 0.01);
    ASSERT_LT(sumError(tick), 1e-9);
  }
}

// A rod lying flat rests flat: its points share one spring, and its ends share the force.
TEST(SoftContacts, LetsARodLieFlat)
{
  const Vector3d out = Vector3d::UnitZ();
  const Scene scene = softScene({{plane(out), 0.5}});
  for (const int points : {2, 11, 60})
  {
    SCOPED_TRACE(points);
    ConstrainedProxy proxy(scene.field, rod(4.5, points));
    proxy.place(poseAt({0.0, 0.0, 1.0}));
    for (int t = 0; t < 400; ++t)
    {
      const double depth = 0.005 * t - 1.0;
      const ProxyTick& tick = proxy.step(poseAt({0.0, 0.0, -depth}));
      ASSERT_NEAR(tick.wrench.linear.z(), std::max(depth, 0.0) / 3.0, 0.005);
      ASSERT_LT(tick.wrench.angular.norm(), 0.02);
      ASSERT_LT(tick.pose.rotation.angularDistance(Eigen::Quaterniond::Identity()), 0.002);
    }
    // A tilted rod presses with its lower end only.
    const ProxyTick& tick = settle(
        proxy,
        poseAt({0.0, 0.0, 0.0}, Eigen::Quaterniond(Eigen::AngleAxisd(0.2, -Vector3d::UnitY()))),
        100);
    const double arm = 4.5 * std::cos(0.2);
    EXPECT_NEAR(tick.wrench.angular.norm() / tick.wrench.linear.norm(), arm, 0.1 * arm);
  }
}

TEST(SoftContacts, ComesInWithoutAJump)
{
  const Vector3d out = Vector3d(0.1, 0.2, 0.9).normalized();
  const Scene scene = softScene({{plane(out), 0.5}});
  for (const double speed : {0.01, 0.1, 1.0}) // mm per tick
  {
    SCOPED_TRACE(speed);
    ConstrainedProxy proxy(scene.field, ballShell(1.5, 400));
    proxy.place(poseAt(3.5 * out));
    for (double height = 3.5; height > 0.5; height -= speed)
    {
      const ProxyTick& tick = proxy.step(poseAt(height * out));
      const double depth = std::max(0.0, 1.5 - height);
      ASSERT_NEAR(tick.wrench.linear.dot(out), depth / 3.0, 0.004) << height;
    }
  }
}

TEST(SoftContacts, RisesUpToTheMiddle)
{
  const double half = 2.0;
  const Vector3d out = Vector3d(0.5, 0.5, -0.7).normalized();
  const Scene scene =
      softScene({{[&](const Vector3d& p) { return half - std::abs(out.dot(p)); }, 0.4}});
  ConstrainedProxy proxy(scene.field, pointShell(), coupling(2.0));
  proxy.place(poseAt((half + 0.2) * out));
  double before = 0.0;
  double depth = 0.0;
  for (int t = 0; depth < half - 0.5 * kSoftVoxel; ++t)
  {
    ASSERT_LT(t, 1000);
    const ProxyTick& tick = proxy.step(poseAt((half - 0.01 * t) * out));
    const double force = tick.wrench.linear.dot(out);
    depth = half - tick.pose.position.dot(out);
    ASSERT_NEAR(force, 0.4 * std::max(depth, 0.0), 0.001 + 0.01 * force);
    ASSERT_GE(force, before - 1e-5);
    before = force;
  }
}

// Two adjacent structures are two springs: on the seam a burr presses both.
TEST(SoftContacts, SlidesAcrossTheSeamOfTwoStructures)
{
  const auto half = [](double side)
  { return [side](const Vector3d& p) { return std::min(-p.z(), side * p.x()); }; };
  const Scene scene = softScene({{half(1.0), 0.3}, {half(-1.0), 0.3}});
  ConstrainedProxy proxy(scene.field, ballShell(1.5, 800));
  proxy.place(poseAt({-4.0, 0.0, 2.0}));
  settle(proxy, poseAt({-4.0, 0.0, 1.0}));
  const double alone = 0.5 * 0.3 / 1.3;
  double before = proxy.step(poseAt({-4.0, 0.0, 1.0})).wrench.linear.z();
  EXPECT_NEAR(before, alone, 0.003);
  int both = 0;
  for (int t = 0; t <= 1600; ++t)
  {
    const ProxyTick& tick = proxy.step(poseAt({-4.0 + 0.005 * t, 0.0, 1.0}));
    const double force = tick.wrench.linear.z();
    ASSERT_LT(std::abs(force - before), 3.0 * 0.005 + kCreep);
    ASSERT_GT(force, 0.8 * alone); // each is deepest beside the seam
    ASSERT_LT(force, 0.5 * 0.6 / 1.6 + 0.01);
    both += tick.contactCount > 1;
    before = force;
  }
  EXPECT_NEAR(before, alone, 0.003);
  EXPECT_GT(both, 20);
}

TEST(SoftContacts, IsStoppedByTheBoneBehindIt)
{
  const double layer = 1.0; // mm of soft tissue on bone that fills z < 0
  const Scene scene =
      softScene({{[&](const Vector3d& p) { return std::min(layer - p.z(), p.z() + 0.3); }, 0.2}},
                plane(Vector3d::UnitZ()));
  for (const PointShell& shell : {pointShell(), shortBurr(1.0, 5.0, kSoftVoxel, 400)})
  {
    const double radius = shell.burrRadius;
    ConstrainedProxy proxy(scene.field, shell);
    proxy.place(poseAt({0.0, 0.0, 3.0}));
    double lowest = 3.0;
    Vector3d before = Vector3d::Zero();
    for (int t = 0; t < 800; ++t)
    {
      const ProxyTick& tick = proxy.step(poseAt({0.3, 0.1, 3.0 - 0.006 * t}));
      ASSERT_LE(deepest(*scene.tissue, shell, tick.pose), 0.0);
      ASSERT_LT((tick.wrench.linear - before).norm(), 3.0 * 0.006 + kCreep + 0.02);
      before = tick.wrench.linear;
      lowest = std::min(lowest, tick.pose.position.z());
    }
    EXPECT_NEAR(lowest, radius, 0.05 * kSoftVoxel);
    EXPECT_NEAR(before.z(), radius + 1.79, 0.35);
  }
}

// Rigid structures inside and beside soft ones are unaffected.
TEST(SoftContacts, LeavesARigidStructureInsideItRigid)
{
  const auto ct = scanOf(air, kSoftVoxel, 6.0);
  const auto stone = occupancyOf(ball(1.0), ct->geometry());
  std::vector<SoftStructure> soft{
      {volume::makeDistanceMap(*occupancyOf(ball(3.0), ct->geometry()), ct->geometry()), 0.1}};
  const Scene scene = sceneOf(ct, {stone}, soft);
  ConstrainedProxy proxy(scene.field, pointShell());
  proxy.place(poseAt({0.0, 0.0, 4.0}));
  for (int t = 0; t < 800; ++t)
    ASSERT_LE(scene.tissue->value(proxy.step(poseAt({0.0, 0.0, 4.0 - 0.005 * t})).pose.position),
              0.0);
  EXPECT_NEAR(proxy.pose().position.z(), 1.0, 0.05 * kSoftVoxel);
}

TEST(SoftContacts, LetsAToolThroughAThinLayerWithoutAKick)
{
  const double half = 0.6;
  for (const double stiffness : {0.2, 1.0, 5.0})
    for (const PointShell& shell : {pointShell(), ballShell(1.0, 400)})
    {
      SCOPED_TRACE(::testing::Message() << stiffness << ' ' << shell.burrRadius);
      const Scene scene =
          softScene({{[&](const Vector3d& p) { return half - std::abs(p.z()); }, stiffness}});
      ConstrainedProxy proxy(scene.field, shell);
      proxy.place(poseAt({0.0, 0.0, 3.0}));
      double before = 0.0;
      double most = 0.0;
      double work = 0.0; // done by the tool on the hand
      const double step = 0.005;
      for (int t = 0; t < 2000; ++t)
      {
        const ProxyTick& tick = proxy.step(poseAt({0.0, 0.0, 3.0 - step * t}));
        const double force = tick.wrench.linear.z();
        ASSERT_LT(std::abs(force - before), 3.0 * step + kCreep) << t;
        work -= 0.5 * (force + before) * step;
        before = force;
        most = std::max(most, std::abs(force));
      }
      EXPECT_LT((proxy.pose().position - Vector3d(0.0, 0.0, 3.0 - step * 1999)).norm(), 0.01);
      EXPECT_LT(std::abs(before), 0.01);
      EXPECT_LE(most, stiffness * half + 1e-3);
      EXPECT_GT(most, 0.5 * stiffness * half);
      EXPECT_LE(work, 1e-6);
    }
}

// The hand presses, slides and releases in many ways: it never gets back more than it put in.
TEST(SoftContacts, GivesNoEnergyOverClosedCycles)
{
  const Scene scene = softScene(
      {{ball(2.5), 0.4},
       {[](const Vector3d& p) { return 1.0 - (p - Vector3d(3.2, 0.0, 0.0)).norm(); }, 1.5}});
  for (const PointShell& shell : {pointShell(), ballShell(1.0, 400)})
    for (int cycle = 0; cycle < 12; ++cycle)
    {
      SCOPED_TRACE(::testing::Message() << shell.burrRadius << ' ' << cycle);
      const Vector3d centre(0.4 * cycle - 1.0, 0.1 * cycle, 3.6);
      const double size = 0.8 + 0.15 * cycle;
      const auto goal = [&](int t)
      {
        const double turn = 2.0 * 3.141592653589793 * t / 2000.0;
        return Vector3d(centre +
                        size * Vector3d(std::sin(2.0 * turn) * 0.5, std::sin(turn) * 0.7,
                                        std::cos(turn) - 1.0) +
                        Vector3d(0.0, 0.0, 0.0));
      };
      ConstrainedProxy proxy(scene.field, shell);
      proxy.place(poseAt(goal(0)));
      Vector3d before = Vector3d::Zero();
      double given = 0.0; // mJ, by the hand
      // The second cycle begins and ends in the same state.
      for (int t = 1; t <= 4000; ++t)
      {
        const Vector3d force = proxy.step(poseAt(goal(t))).wrench.linear;
        if (t > 2000)
          given -= 0.5 * (force + before).dot(goal(t) - goal(t - 1));
        before = force;
      }
      EXPECT_GE(given, -1e-3) << "mJ";
    }
}

TEST(SoftContacts, RestsQuietly)
{
  const Scene scene = softScene({{ball(2.5), 0.4}, {plane(Vector3d(0.2, 0.1, 1.0), -1.0), 2.0}});
  ConstrainedProxy proxy(scene.field, shortBurr(1.0, 6.0, kSoftVoxel, 400));
  const Eigen::Quaterniond tilt(Eigen::AngleAxisd(1.2, Vector3d(1.0, 0.4, 0.0).normalized()));
  proxy.place(poseAt({0.0, 0.0, 5.0}, tilt));
  const Pose goal = poseAt({0.6, 0.3, 1.4}, tilt);
  for (int t = 0; t < 500; ++t)
    proxy.step(goal);
  const Wrench wrench = proxy.step(goal).wrench;
  const Pose pose = proxy.pose();
  EXPECT_GT(wrench.linear.norm(), 0.2);
  for (int t = 0; t < 2000; ++t)
  {
    const ProxyTick& tick = proxy.step(goal);
    ASSERT_LT((tick.wrench.linear - wrench.linear).norm(), 1e-3);
    ASSERT_LT((tick.pose.position - pose.position).norm(), 2e-3);
  }
}

TEST(SoftContacts, PassesWhatWasCutAwayWithoutForce)
{
  Scene scene = softScene({{ball(2.0), 5.0}});
  ConstrainedProxy proxy(scene.field, pointShell());
  const Pose goal = poseAt({0.0, 0.0, 1.0});
  proxy.place(poseAt({0.0, 0.0, 3.0}));
  proxy.step(goal);
  EXPECT_EQ(proxy.step(goal).status, ProxyStatus::Contact);
  cutBall(scene, {0.0, 0.0, 1.5}, 1.6);
  const ProxyTick& tick = settle(proxy, goal, 100);
  EXPECT_EQ(tick.status, ProxyStatus::Free);
  EXPECT_LT((tick.pose.position - goal.position).norm(), 2e-3);
}

// After a cut, tissue begins at the cut surface.
TEST(SoftContacts, BeginsAtTheSurfaceOfACut)
{
  Scene scene = softScene({{plane(Vector3d::UnitZ(), 3.0), 0.5}});
  cutBall(scene, {0.0, 0.0, 3.0}, 3.0);
  ConstrainedProxy proxy(scene.field, ballShell(1.0, 400));
  proxy.place(poseAt({0.0, 0.0, 2.5}));
  double before = 0.0;
  for (int t = 0; t < 1000; ++t)
  {
    const double height = 2.0 - 0.002 * t;
    const double force = proxy.step(poseAt({0.0, 0.0, height})).wrench.linear.z();
    if (height > 1.0 + 0.1 * kSoftVoxel)
    {
      ASSERT_LT(std::abs(force), 1e-9) << height;
    }
    if (height < 1.0 - 0.1 * kSoftVoxel)
    {
      ASSERT_GT(force, 0.0) << height;
    }
    ASSERT_LT(std::abs(force - before), 0.03) << height;
    before = force;
  }
  EXPECT_GT(before, 1.0 / 3.0);
}

// For any motion of the device: no step into bone, a force equal to the coupling's, and one that
// changes no faster than device and tool move.
TEST(SoftContacts, AreSteadyUnderARandomHand)
{
  const double turnLever = std::sqrt(20.0); // mm, of the default coupling
  const auto size = [&](const Motion& m)
  { return std::hypot(m.linear.norm(), turnLever * m.angular.norm()); };
  const SoftPart lump{ball(2.5), 0.8};
  const SoftPart cord{
      [](const Vector3d& p) { return 0.9 - Vector3d(p.x() - 1.0, 0.0, p.z() + 2.5).norm(); }, 3.0};
  for (const bool bone : {false, true})
  {
    const Scene scene = softScene({lump, cord}, bone ? plane(Vector3d(0.1, 0.0, 1.0), -3.0) : air);
    const PointShell shell = shortBurr(1.0, 6.0, kSoftVoxel, 400);
    ConstrainedProxy proxy(scene.field, shell);
    const Pose start = poseAt({0.0, 0.0, 5.0});
    proxy.place(start);
    RandomHand hand(12, start, 4.0);
    Pose before = start;
    Motion last;
    int pressed = 0;
    for (int t = 0; t < 6000; ++t)
    {
      const Pose goal = hand.tick();
      const ProxyTick& tick = proxy.step(goal);
      ASSERT_TRUE(tick.wrench.finite());
      if (bone)
      {
        ASSERT_LE(deepest(*scene.tissue, shell, tick.pose), 0.0);
        continue;
      }
      const Motion stretch{tick.wrench.linear / 1.0, tick.wrench.angular / 20.0};
      const double moved = size(motionBetween(before, goal));
      ASSERT_LE(size({stretch.linear - last.linear, stretch.angular - last.angular}),
                3.0 * moved + kCreep + 0.01)
          << t;
      pressed += tick.contactCount > 0;
      before = goal;
      last = stretch;
    }
    EXPECT_TRUE(bone || pressed > 1000);
  }
}

// The 3-DOF burr interacts with them as the 6-DOF ball does.
TEST(SoftContacts, HoldAPointProxyAsABall)
{
  const double radius = 1.5;
  const std::vector<Scene> scenes{
      softScene({{plane(Vector3d(0.2, -0.1, 0.9)), 0.5}}), softScene({{ball(2.5), 0.3}}),
      softScene({{plane(Vector3d::UnitZ(), 0.6), 0.5}}, plane(Vector3d::UnitZ(), -1.0))};
  for (std::size_t n = 0; n < scenes.size(); ++n)
  {
    SCOPED_TRACE(n);
    ConstrainedProxy six(scenes[n].field, ballShell(radius, 800));
    PointProxy three(scenes[n].field, {radius, 1000, 0.0});
    six.place(poseAt({0.3, 0.2, 4.5}));
    three.place(poseAt({0.3, 0.2, 4.5}));
    double most = 0.0;
    for (int t = 0; t < 700; ++t)
    {
      const Pose goal = poseAt({0.3, 0.2 + 0.001 * t, 4.5 - 0.005 * t});
      const Vector3d force = six.step(goal).wrench.linear;
      const ProxyTick& tick = three.step(goal);
      most = std::max(most, force.norm());
      ASSERT_EQ(tick.wrench.angular.norm(), 0.0);
      ASSERT_LT(sumError(tick), 1e-9);
      // Bone stops the one at its surface and the other at its centre.
      if (n < 2 || tick.pose.position.z() > -1.0 + radius + 0.05)
      {
        ASSERT_LT((tick.wrench.linear - force).norm(), 0.01) << t;
      }
      ASSERT_LE(scenes[n].tissue->value(tick.pose.position), 0.0);
    }
    EXPECT_GT(most, 0.15);
  }
}

TEST(SoftContacts, LetAPointProxyThroughAThinLayerWithoutAKick)
{
  const double half = 0.6;
  const Scene scene = softScene({{[&](const Vector3d& p) { return half - std::abs(p.z()); }, 3.0}});
  PointProxy proxy(scene.field, {1.0, 1000, 1.0});
  proxy.place(poseAt({0.0, 0.0, 3.0}));
  double before = 0.0;
  double most = 0.0;
  for (int t = 0; t < 2000; ++t)
  {
    const double force = proxy.step(poseAt({0.0, 0.0, 3.0 - 0.005 * t})).wrench.linear.z();
    ASSERT_LT(std::abs(force - before), 3.0 * 0.005 + kCreep) << t;
    before = force;
    most = std::max(most, force);
  }
  EXPECT_LE(most, 3.0 * half + 1e-3);
  EXPECT_GT(most, 1.5 * half);
  EXPECT_LT(std::abs(before), 0.01);
}

TEST(SoftContacts, RefusesAStiffnessOutOfItsDomain)
{
  const auto ct = scanOf(air, 1.0, 5.0);
  const auto map = volume::makeDistanceMap(*occupancyOf(ball(2.0), ct->geometry()), ct->geometry());
  EXPECT_NO_THROW(sceneOf(ct, {}, {{map, 1.0}}));
  EXPECT_THROW(sceneOf(ct, {}, {{map, 0.0}}), core::InvalidParameter);
  EXPECT_THROW(sceneOf(ct, {}, {{map, std::nan("")}}), core::InvalidParameter);
  EXPECT_THROW(sceneOf(ct, {}, {{nullptr, 1.0}}), core::InvalidParameter);
}
