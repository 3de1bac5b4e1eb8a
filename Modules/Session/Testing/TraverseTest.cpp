#include "petrous/Session/Traverse.h"

#include <gtest/gtest.h>

using namespace petrous;
using namespace petrous::session;
using Eigen::Quaterniond;
using Eigen::Vector3d;

namespace
{

constexpr double kTick = 0.001;
const Vector3d kSight(0.0, 0.0, -1.0);

// A tool in a world with one thin wall at x = 0, up to z = `rim`.
struct Wall
{
  double rim = 0.0;
  haptics::Pose tool;
  Traverse traverse{10.0};
  double force = 0.0; // N, the last

  void tick(const Vector3d& place, double thrust = 1.0)
  {
    const auto goal = traverse.goal({place, Quaterniond::Identity()}, tool, kSight, thrust, kTick);
    haptics::ProxyTick tick;
    Vector3d to = goal.position;
    if (tool.position.z() < rim && tool.position.x() <= 0.0)
      to.x() = std::min(to.x(), 0.0);
    force = 10.0 * (goal.position - to).norm();
    tick.contactCount = force > 0.0 ? 1 : 0;
    tool = {to, goal.rotation};
    tick.pose = tool;
    traverse.see(tick);
  }
};

} // namespace

TEST(Traverse, RetractsTraversesAndComesDown)
{
  Wall wall;
  wall.tool.position = {0.0, 0.0, -5.0};
  const Vector3d place(6.0, 0.0, -2.0); // below the rim: the height of the target is not enough
  double across = -10.0;                // minimum height beyond the wall
  for (int n = 0; n < 1000; ++n)
  {
    const bool touched = wall.force > 0.0;
    wall.tick(place);
    if (touched)
    {
      EXPECT_LE(wall.force, Traverse::kShare + 1e-12);
    }
    if (wall.tool.position.x() > 0.0 && across < -5.0)
      across = wall.tool.position.z();
  }
  EXPECT_GE(across, 0.0);
  EXPECT_LT(across, Traverse::kLift + 0.5);
  EXPECT_NEAR((wall.tool.position - place).norm(), 0.0, 1e-9);
}

TEST(Traverse, GoesUpToItsPlaceBeforeItGoesOver)
{
  Wall wall;
  wall.rim = -100.0; // no wall
  double before = 0.0;
  for (int n = 0; n < 100; ++n)
  {
    wall.tick({3.0, 0.0, 4.0});
    EXPECT_GE(wall.tool.position.z(), before);
    if (wall.tool.position.x() > 0.0)
    {
      EXPECT_GT(wall.tool.position.z(), 3.8);
    }
    before = wall.tool.position.z();
  }
  EXPECT_NEAR((wall.tool.position - Vector3d(3.0, 0.0, 4.0)).norm(), 0.0, 1e-9);
}

TEST(Traverse, StaysWhereItComesDownOnTissue)
{
  Traverse traverse(10.0);
  haptics::Pose tool;
  tool.position = {0.0, 0.0, 1.0};
  const haptics::Pose place{{0.0, 0.0, 0.0}, Quaterniond::Identity()};
  // Bone below z = 0.5 pushes it sideways as well, like a slope.
  for (int n = 0; n < 3000; ++n)
  {
    const auto goal = traverse.goal(place, tool, kSight, 1.0, kTick);
    haptics::ProxyTick tick;
    tool.position = {0.4, 0.0, std::max(goal.position.z(), 0.5)};
    tick.contactCount = goal.position.z() < 0.5 ? 1 : 0;
    tick.pose = tool;
    traverse.see(tick);
    if (n > 10)
    {
      ASSERT_LT(tool.position.z(), 0.6) << n; // it does not oscillate
    }
  }
  EXPECT_FALSE(traverse.stuck());
}

TEST(Traverse, TriesTheShaftWhereTheLineOfSightIsClosedAndThenSaysSo)
{
  Traverse traverse(10.0);
  const haptics::Pose tool{{0.0, 0.0, 0.0},
                           Quaterniond::FromTwoVectors(Vector3d::UnitZ(), Vector3d::UnitY())};
  haptics::ProxyTick held;
  held.pose = tool;
  held.contactCount = 1;
  bool byShaft = false;
  for (int n = 0; n < 3 * Traverse::kIdleTicks; ++n)
  {
    const auto goal =
        traverse.goal({{5.0, 0.0, 0.0}, tool.rotation}, tool, kSight, 1.0, kTick).position;
    byShaft = byShaft || goal.y() > 0.9 * goal.norm();
    if (n > 0) // was free
    {
      EXPECT_LE(10.0 * goal.norm(), Traverse::kShare + 1e-12);
    }
    if (!byShaft)
    {
      EXPECT_FALSE(traverse.stuck());
    }
    traverse.see(held);
  }
  EXPECT_TRUE(byShaft);
  EXPECT_TRUE(traverse.stuck());
  traverse.forget();
  EXPECT_FALSE(traverse.stuck());
}
