#include "petrous/Haptics/ConstrainedProxy.h"

#include <limits>

#include <gtest/gtest.h>

#include "ProxyChecks.h"
#include "SurfaceErrors.h"

using namespace petrous::haptics;
using namespace petrous::haptics::testing;
using Eigen::Quaterniond;
using Eigen::Vector3d;

namespace
{

struct Walk
{
  int touched = 0;  ///< ticks in contact
  int crossed = 0;  ///< ticks with a shell point beyond the plate
  int inside = 0;   ///< ticks without contact, inside tissue
  double deep = -1; ///< largest f at a shell point
  double worstSum = 0.0;
};

// Random ticks over a plate of the given thickness; all points stay inside the grid.
Walk walkOnPlate(const Vector3d& toward, double thickness, double offset, unsigned seed, int ticks)
{
  const double h = 0.3;
  const double within = 3.0;
  const double reach = 3.5;
  const Vector3d normal = toward.normalized();
  const SignedDistance centred = plate(normal, thickness);
  const Scene scene = sceneOf(scanOf(
      [&](const Vector3d& p) { return centred(p - offset * normal); }, h, within + reach + 1.5));
  const PointShell shell = shortBurr(1.0, reach, h, 300);
  ConstrainedProxy proxy(scene.field, shell);
  const Pose start =
      poseAt((offset + 1.5) * normal, Quaterniond::FromTwoVectors(Vector3d::UnitZ(), normal));
  proxy.place(start);
  RandomHand hand(seed, start, within);
  Walk walk;
  for (int t = 0; t < ticks; ++t)
  {
    const ProxyTick& tick = proxy.step(hand.tick());
    walk.touched += tick.contactCount > 0;
    walk.inside += tick.status == ProxyStatus::Inside;
    if (tick.contactCount < ProxyTick::kMaxContacts)
      walk.worstSum = std::max(walk.worstSum, sumError(tick));
    double lowest = std::numeric_limits<double>::max();
    for (const Vector3d& point : shell.points)
    {
      const Vector3d p = tick.pose * point;
      lowest = std::min(lowest, normal.dot(p) - offset);
      // Farther than a voxel from the plate there is air.
      if (std::abs(normal.dot(p) - offset) < 0.5 * thickness + 2.0 * h)
        walk.deep = std::max(walk.deep, scene.tissue->value(p));
    }
    walk.crossed += lowest < 0.0;
  }
  return walk;
}

} // namespace

TEST(ConstrainedProxy, NeverEntersOrCrossesAThinPlateWhateverTheDeviceDoes)
{
  const double h = 0.3;
  unsigned seed = 1;
  for (const double thickness : {1.0 * h, 1.5 * h, 2.0 * h})
    for (const Vector3d& normal : {Vector3d(0.0, 0.0, 1.0), Vector3d(0.3, -0.5, 0.8)})
    {
      SCOPED_TRACE(::testing::Message() << thickness << " mm, normal " << normal.transpose());
      const Walk walk = walkOnPlate(normal, thickness, 0.11 * seed * h, seed, 1700);
      ++seed;
      EXPECT_GT(walk.touched, 300) << "the walk must meet the plate";
      EXPECT_EQ(walk.crossed, 0);
      EXPECT_EQ(walk.inside, 0);
      EXPECT_LE(walk.deep, 0.0);
      EXPECT_LE(walk.worstSum, 1e-9);
    }
}

// A plate of 0.6 voxels, visible to the samples, and ticks of 20 voxels.
TEST(ConstrainedProxy, StopsAtAWallThinnerThanItsStep)
{
  const double h = 0.3;
  const Scene scene = sceneOf(scanOf(plate(Vector3d::UnitX(), 0.6 * h), h, 9.0));
  ASSERT_GT(scene.tissue->value(Vector3d::Zero()), 0.0) << "a layer of voxels must lie in it";
  for (int phase = 0; phase < 16; ++phase)
  {
    SCOPED_TRACE(phase);
    const PointShell shell = ballShell(1.0, 200);
    ConstrainedProxy proxy(scene.field, shell);
    proxy.place(poseAt({3.0 + phase * h / 16.0, 0.1, -0.2}));
    for (int t = 0; t < 3; ++t)
    {
      const ProxyTick& tick = proxy.step(poseAt({3.0 + phase * h / 16.0 - 20.0 * h, 0.1, -0.2}));
      EXPECT_GT(tick.pose.position.x(), 1.0);
      EXPECT_LT(tick.pose.position.x(), 1.0 + h);
      EXPECT_LE(deepest(*scene.tissue, shell, tick.pose), 0.0);
    }
    EXPECT_EQ(proxy.step(poseAt({-3.0, 0.1, -0.2})).status, ProxyStatus::Contact);
  }
}

// Rotation only: the handle end of the tool moves by many voxels per tick, its tip does not move.
TEST(ConstrainedProxy, StopsALongToolThatIsTurnedIntoAWall)
{
  const double h = 0.4;
  const Vector3d tip(0.0, 0.0, -60.0); // the wall is beside the handpiece
  const Scene scene = sceneOf(
      scanOf([](const Vector3d& p) { return std::min(p.x() - 8.0, 9.0 - p.x()); }, h, 16.0));
  const PointShell shell = makeBurrShell({}, h, 2000);
  for (const double angle : {0.02, 0.3, -0.3, 1.0})
  {
    SCOPED_TRACE(angle);
    ConstrainedProxy proxy(scene.field, shell);
    proxy.place(poseAt(tip));
    const Pose goal = poseAt(tip, Quaterniond(Eigen::AngleAxisd(angle, Vector3d::UnitY())));
    const ProxyTick* tick = nullptr;
    for (int t = 0; t < 10; ++t)
    {
      tick = &proxy.step(goal);
      ASSERT_LE(deepest(*scene.tissue, shell, tick->pose), 0.0);
    }
    const double turned = 2.0 * std::acos(std::abs(tick->pose.rotation.w()));
    if (angle == 0.02 || angle < 0.0) // too little to reach it, or away from it
      EXPECT_NEAR(turned, std::abs(angle), 1e-6);
    else
    {
      EXPECT_GT(turned, 0.02);
      // The wall is 8 mm from the tool's axis, within the scanned cube 44 to 76 mm from the tip.
      EXPECT_LT(turned, 0.05);
      EXPECT_LT(tick->wrench.angular.y(), -1.0) << "it is turned back";
    }
  }
}

TEST(ConstrainedProxy, DoesNotCreepAtRest)
{
  const double h = 0.2;
  const AnalyticSurface surface = torusSurface(surfaceTurn(true));
  const Scene scene = sceneOf(scanOf(surface.distance, h, 7.5));
  ConstrainedProxy proxy(scene.field, shortBurr(2.0, 8.0, h, 400));
  const Quaterniond held(Eigen::AngleAxisd(0.4, Vector3d(1.0, 2.0, 0.5).normalized()));
  proxy.place(poseAt(surface.goal(0.3, 2.0, -1.0), held));
  const Pose goal = poseAt(surface.goal(0.3, 2.0, 1.0), held);
  for (int t = 0; t < 20; ++t)
    proxy.step(goal);
  const Pose rest = proxy.pose();
  double drift = 0.0;
  for (int t = 0; t < 100000; ++t)
    drift = std::max(drift, (proxy.step(goal).pose.position - rest.position).norm());
  EXPECT_LT(drift, 1e-3);
  EXPECT_NEAR(proxy.pose().rotation.norm(), 1.0, 1e-12);
  EXPECT_LT(rest.rotation.angularDistance(proxy.pose().rotation), 1e-4);
  EXPECT_EQ(proxy.step(goal).status, ProxyStatus::Contact);
}

// Static bone gives the hand no energy: over a closed path of the goal, in either direction, the
// hand's work is not below zero by more than the peak force times the allowed ripple of height,
// 0.02 h. The force is integrated as it changes from tick to tick (trapezoidal rule), so that the
// rest is due to the renderer and not to a delay of one tick.
TEST(ConstrainedProxy, ReturnsNoMoreEnergyThanTheDevicePutIn)
{
  const double radius = 1.5;
  const int ticks = 3000;
  for (const double h : {0.15, 0.3})
    for (const AnalyticSurface& surface : analyticSurfaces(true))
    {
      SCOPED_TRACE(surface.name + ", h " + std::to_string(h));
      const Scene scene = sceneOf(scanOf(surface.distance, h, 7.0));
      ConstrainedProxy proxy(scene.field, shortBurr(radius, 6.0, h, 500));
      const auto goalAt = [&](int t)
      {
        const double turn = 2.0 * M_PI * t / ticks;
        const double depth = 0.5 - std::cos(turn); // from 0.5 mm above to 1.5 mm below
        const Vector3d way(0.3 * std::sin(turn), 0.3 * std::sin(2.0 * turn), 0.0);
        return poseAt(surface.goal(0.4 * std::sin(turn), radius, depth) + way,
                      rotationFrom(Vector3d(0.0, 0.1, 0.2) * std::sin(turn)));
      };
      proxy.place(goalAt(0));
      for (const int direction : {1, -1})
      {
        Wrench last = proxy.step(goalAt(0)).wrench;
        double work = 0.0; // of the hand, N mm
        double stored = 0.0;
        double force = 0.0;
        for (int t = 1; t <= ticks; ++t)
        {
          const Wrench wrench = proxy.step(goalAt(direction * t)).wrench;
          const Motion way = motionBetween(goalAt(direction * (t - 1)), goalAt(direction * t));
          work -= 0.5 * (wrench.linear + last.linear).dot(way.linear) +
                  0.5 * (wrench.angular + last.angular).dot(way.angular);
          stored = std::max(stored, work);
          force = std::max(force, wrench.linear.norm());
          last = wrench;
        }
        EXPECT_GT(stored, 0.8) << "N mm: it must have been pressed";
        EXPECT_GE(work, -0.02 * h * force) << "N mm";
      }
    }
}
