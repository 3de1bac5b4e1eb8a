#include "petrous/Haptics/ShellSweep.h"

#include <gtest/gtest.h>

#include "ProxyChecks.h"

using namespace petrous;
using namespace petrous::haptics;
using namespace petrous::haptics::testing;
using Eigen::Quaterniond;
using Eigen::Vector3d;

namespace
{

constexpr double kVoxel = 0.3;

struct Sweeping
{
  Sweeping(const Scene& scene, PointShell shell, double step = 0.5, int bisections = 10)
    : sweep(scene.field, std::move(shell), step, bisections)
    , state(scene.published->acquire())
  {
    sweep.look(*state);
  }

  ShellSweep::Hit advance(const Motion& motion)
  {
    sweep.findNear(0.0);
    sweep.addNear(motion.linear.norm(), motion.angular.norm());
    return sweep.advance(motion);
  }

  ShellSweep sweep;
  const volume::MaskState* state;
};

// Bone with caves, all of its surfaces curved, of thicknesses from zero to several voxels.
SignedDistance caves()
{
  return [](const Vector3d& p)
  {
    const double value =
        std::sin(2.1 * p.x()) + std::sin(1.7 * p.y() + 0.4) + std::sin(2.6 * p.z() - 0.3) - 0.6;
    return 0.4 * value;
  };
}

} // namespace

TEST(ShellSweep, StopsWherePlaneTouchesPoint)
{
  const Scene scene = sceneOf(scanOf(plane(Vector3d(0.3, -0.5, 0.8)), kVoxel, 6.0));
  const Vector3d normal = Vector3d(0.3, -0.5, 0.8).normalized();
  for (const double start : {0.05, 0.7, 2.0})
  {
    Sweeping one(scene, pointShell());
    one.sweep.moveTo(poseAt(start * normal));
    const double way = 4.0; // less than the 64 chords of half a voxel
    const ShellSweep::Hit hit = one.advance({-way * normal, Vector3d::Zero()});
    ASSERT_TRUE(hit.any);
    EXPECT_EQ(hit.point, 0U);
    EXPECT_LT((hit.direction + normal).norm(), 1e-9);
    // Bisection to 2^-10 of a chord, and the plane to the scan's rounding.
    EXPECT_NEAR(hit.free * way, start, 0.01 * kVoxel);
    EXPECT_NEAR(normal.dot(one.sweep.pose().position), start - hit.free * way, 1e-9);
    EXPECT_LE(scene.tissue->value(one.sweep.pose().position), 0.0);
  }
}

TEST(ShellSweep, GoesTheWholeWayWhereThereIsNothing)
{
  const Scene scene = sceneOf(scanOf(plane(Vector3d::UnitZ()), kVoxel, 6.0));
  Sweeping one(scene, shortBurr(1.0, 6.0, kVoxel, 300));
  one.sweep.moveTo(poseAt({0.0, 0.0, 1.5}));
  const Motion motion{Vector3d(2.0, -1.0, 0.2), Vector3d(0.0, 0.0, 1.0)};
  const ShellSweep::Hit hit = one.advance(motion);
  EXPECT_FALSE(hit.any);
  EXPECT_EQ(hit.free, 1.0);
  EXPECT_LT((one.sweep.pose().position - Vector3d(2.0, -1.0, 1.7)).norm(), 1e-12);
  EXPECT_NEAR(one.sweep.pose().rotation.angularDistance(rotationFrom(motion.angular)), 0.0, 1e-7);
}

TEST(ShellSweep, GoesNoFartherThanItsChordsReach)
{
  const Scene scene = sceneOf(scanOf(plane(Vector3d::UnitZ()), kVoxel, 6.0));
  Sweeping one(scene, pointShell());
  one.sweep.moveTo(poseAt({0.0, 0.0, 3.0}));
  const double reach = ShellSweep::kMaxSteps * 0.5 * kVoxel;
  const ShellSweep::Hit hit = one.advance({Vector3d(0.0, 0.0, 4.0 * reach), Vector3d::Zero()});
  EXPECT_FALSE(hit.any);
  EXPECT_NEAR(hit.free, 0.25, 1e-12);
  EXPECT_NEAR(one.sweep.pose().position.z(), 3.0 + reach, 1e-9);
}

// A wall of a single layer of voxels, at every phase of the chords and for every allowed chord.
TEST(ShellSweep, MeetsAWallThinnerThanItsChord)
{
  const double thickness = 0.6 * kVoxel;
  const Scene scene = sceneOf(scanOf(plate(Vector3d::UnitX(), thickness), kVoxel, 6.0));
  ASSERT_GT(scene.tissue->value(Vector3d::Zero()), 0.0) << "a layer of voxels must lie in it";
  for (const double step : {0.25, 0.5, 1.0})
    for (int phase = 0; phase < 64; ++phase)
    {
      const double start = 2.0 + phase * kVoxel / 64.0;
      Sweeping one(scene, pointShell(), step);
      one.sweep.moveTo(poseAt({start, 0.1, -0.2}));
      const ShellSweep::Hit hit = one.advance({Vector3d(-4.4, 0.01, 0.02), Vector3d::Zero()});
      ASSERT_TRUE(hit.any) << step << ' ' << phase;
      ASSERT_NEAR(one.sweep.pose().position.x(), 0.5 * thickness, 0.02 * kVoxel);
    }
}

TEST(ShellSweep, MeetsAWallByRotationAlone)
{
  const double arm = 5.0;
  PointShell shell = pointShell();
  shell.points = {Vector3d(arm, 0.0, 0.0)};
  // A sheet across the point's path, after 30 degrees.
  const Vector3d along(std::cos(M_PI / 6.0), std::sin(M_PI / 6.0), 0.0);
  const Vector3d across(-along.y(), along.x(), 0.0);
  const Scene scene = sceneOf(scanOf(plate(across, 1.2 * kVoxel), kVoxel, 6.5));
  Sweeping one(scene, shell);
  one.sweep.moveTo({});
  const ShellSweep::Hit hit = one.advance({Vector3d::Zero(), Vector3d(0.0, 0.0, 1.2)});
  ASSERT_TRUE(hit.any);
  const double angle = one.sweep.pose().rotation.angularDistance(Quaterniond::Identity());
  EXPECT_NEAR(angle, M_PI / 6.0 - std::asin(0.6 * kVoxel / arm), 0.1 * kVoxel / arm);
}

// The path made is resampled a hundred times as finely: where it was free, it is free except for
// grazes shorter than h/16, and where it stopped there is tissue.
TEST(ShellSweep, AgreesWithAFineLookAtItsWay)
{
  const Scene scene = sceneOf(scanOf(caves(), kVoxel, 6.0));
  const PointShell shell = shortBurr(0.6, 2.0, kVoxel, 200);
  Sweeping one(scene, shell);
  std::mt19937 random(6);
  std::normal_distribution<double> normal;
  const auto draw = [&] { return Vector3d(normal(random), normal(random), normal(random)); };
  int hits = 0;
  int through = 0;
  for (int n = 0; n < 1500; ++n)
  {
    const Pose start = poseAt(1.3 * draw(), rotationFrom(2.0 * draw()));
    if (deepest(*scene.tissue, shell, start) > 0.0)
      continue;
    one.sweep.moveTo(start);
    const Motion motion{1.0 * draw().normalized(), 0.5 * draw().normalized()};
    const ShellSweep::Hit hit = one.advance(motion);
    ASSERT_LE(deepest(*scene.tissue, shell, one.sweep.pose()), 0.0);
    const double way = maxDisplacement(motion, shell.reach);
    // A graze of h/16 reaches a depth of half of it times the slope of the field (0.4 by the
    // maximum of the three sines, 400 HU per mm over a scale of 1000 HU), and the path's arc
    // deviates from its chord by chord^2 / (8 arm).
    const double allowed = 1.6 * 0.4 * (kVoxel / 32.0 + 0.25 * kVoxel * kVoxel / 8.0 / 0.6);
    const int looks = static_cast<int>(hit.free * way / (0.02 * kVoxel));
    for (int look = 0; look <= looks; ++look)
      ASSERT_LE(deepest(*scene.tissue, shell, moved(start, motion, hit.free * look / (looks + 1))),
                allowed);
    ++through;
    if (!hit.any)
    {
      EXPECT_EQ(hit.free, 1.0);
      continue;
    }
    ++hits;
    // A little further the point that stopped it is in tissue. Where the chord was free and the arc
    // is not, a tenth of the motion is given back.
    bool entered = false;
    const int most = 40 + static_cast<int>(0.1 * hit.free * way / (0.01 * kVoxel));
    for (int look = 1; look <= most && !entered; ++look)
    {
      const Pose further = moved(start, motion, hit.free + look * 0.01 * kVoxel / way);
      if (hit.point ==
          ShellSweep::kNoPoint) // a point of the tissue's surface that entered the tool
      {
        const Vector3d p = further.rotation.conjugate() * (hit.place - further.position);
        const bool inShaft = p.z() > 0.0 && p.z() < shell.solid.shaftEnd &&
                             std::hypot(p.x(), p.y()) < shell.solid.shaftRadius;
        entered = inShaft || p.norm() < shell.burrRadius;
      }
      else
        entered = scene.tissue->value(further * shell.points[hit.point]) > 0.0;
    }
    EXPECT_TRUE(entered) << n;
  }
  EXPECT_GT(through, 60);
  EXPECT_GT(hits, 40);
}

TEST(ShellSweep, FindsEveryPointThatIsNearTissue)
{
  const Scene scene = sceneOf(scanOf(caves(), kVoxel, 6.0));
  const PointShell shell = shortBurr(0.6, 4.0, kVoxel, 300);
  Sweeping one(scene, shell);
  std::mt19937 random(3);
  std::normal_distribution<double> normal;
  const auto draw = [&] { return Vector3d(normal(random), normal(random), normal(random)); };
  one.sweep.moveTo({});
  for (int n = 0; n < 300; ++n)
  {
    // Continue from here: points remembered as far may be near now.
    const Motion motion{0.2 * draw(), 0.1 * draw()};
    one.advance(motion);
    const double distance = 0.3 * kVoxel;
    one.sweep.findNear(distance);
    std::vector<bool> found(shell.points.size());
    for (const ShellSweep::Near& near : one.sweep)
    {
      ASSERT_FALSE(found[near.point]) << "each once";
      found[near.point] = true;
      const Vector3d here = one.sweep.pose() * shell.points[near.point];
      ASSERT_NEAR(near.sample.value, scene.tissue->value(here), 1e-9);
    }
    for (std::size_t i = 0; i < shell.points.size(); ++i)
      for (int m = 0; m < 6 && !found[i]; ++m)
      {
        const Vector3d close = one.sweep.pose() * shell.points[i] + distance * draw().normalized();
        ASSERT_LE(scene.tissue->value(close), 0.0) << n << ' ' << i;
      }
  }
}

TEST(ShellSweep, KnowsTissueThatCameBackOnceItIsToldToForget)
{
  Scene scene = sceneOf(scanOf(plane(Vector3d::UnitZ()), kVoxel, 6.0));
  cutBall(scene, Vector3d(0.0, 0.0, -1.0), 3.0);
  Sweeping one(scene, pointShell());
  one.sweep.moveTo(poseAt({0.0, 0.0, -1.0}));
  one.sweep.findNear(0.05);
  EXPECT_EQ(one.sweep.nearCount(), 0U);
  EXPECT_TRUE(one.sweep.freeAt(one.sweep.pose()));
  cutBall(scene, Vector3d(0.0, 0.0, -1.0), 3.0, true);
  one.sweep.look(*scene.published->acquire());
  one.sweep.forgetClearances();
  one.sweep.findNear(0.05);
  EXPECT_EQ(one.sweep.nearCount(), 1U);
  EXPECT_FALSE(one.sweep.freeAt(one.sweep.pose()));
}
