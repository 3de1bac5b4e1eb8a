#include <gtest/gtest.h>

#include "Session.h"

using namespace petrous::simulation;
using namespace petrous::simulation::testing;
using Eigen::Quaterniond;
using Eigen::Vector3d;

namespace
{

ServoSetup setupWith(double stiffness)
{
  ServoSetup setup = Session::plainSetup();
  setup.guard.goodTicks = 1; // a written path is sound from its first tick
  setup.stiffness = stiffness;
  return setup;
}

} // namespace

TEST(ConstantThrust, PressesAPlaneWithTheForceThatIsSet)
{
  for (const double stiffness : {0.4, 1.0, 5.0})
    for (const double thrust : {0.3, 1.0, 3.0})
    {
      Session session(setupWith(stiffness));
      session.proxy.stiffness = stiffness;
      session.proxy.normal = Vector3d(0.2, -0.5, 0.9).normalized();
      session.parameters.constantThrust = 1;
      session.parameters.thrust = thrust;
      // The place lies above, then in, then above the surface, and moves along it.
      session.go({0.0, 0.0, 6.0}, {10.0, 4.0, 6.0}, 1000);
      const std::size_t first = 500; // 50 mm/s and at most 10 mm to the plane
      session.go({10.0, 4.0, 6.0}, {0.0, 8.0, -3.0}, 500);
      for (std::size_t n = first; n < session.records.size(); ++n)
      {
        EXPECT_NEAR(session.records[n].thrust, thrust, 0.01 * thrust) << n;
        EXPECT_LT(
            (forceOf(session.records[n].wrench) - session.records[n].thrust * session.proxy.normal)
                .norm(),
            0.01 * thrust);
      }
      // Across the normal the tool is where the hand points.
      const Vector3d place = session.records.back().mapped.pose().position;
      const Vector3d off = session.records.back().proxy.pose().position - place;
      EXPECT_LT(off.cross(session.proxy.normal).norm(), 0.05);
    }
}

TEST(ConstantThrust, KeepsTheForceWhileTheSurfaceGivesWay)
{
  Session session(setupWith(1.0));
  session.parameters.constantThrust = 1;
  session.go({0.0, 0.0, 2.5}, {0.0, 0.0, 2.5}, 100);
  for (int n = 0; n < 1000; ++n)
  {
    session.proxy.offset -= 0.02; // a drill's 20 mm/s
    const TickRecord& record = session.tick({{0.0, 0.0, 2.5}, Quaterniond::Identity()});
    if (n > 100)
    {
      EXPECT_NEAR(record.thrust, 1.0, 0.01) << n;
    }
  }
}

TEST(ConstantThrust, ComesAlongTheShaftNoFasterThanSet)
{
  Session session(setupWith(1.0));
  session.parameters.constantThrust = 1;
  session.parameters.approachSpeed = 30.0;
  // The shaft points to +x: the burr comes along -x to a wall there.
  session.proxy.normal = Vector3d::UnitX();
  const Quaterniond heading = Quaterniond::FromTwoVectors(Vector3d::UnitZ(), Vector3d::UnitX());
  session.go({10.0, 0.0, 0.0}, {10.0, 0.0, 0.0}, 200, heading);
  for (std::size_t n = 1; n < 200; ++n)
  {
    const Vector3d way =
        session.records[n].proxy.pose().position - session.records[n - 1].proxy.pose().position;
    EXPECT_NEAR(way.x(), -0.03, 1e-9);
    EXPECT_EQ(session.records[n].thrust, 0.0);
  }
  session.go({10.0, 0.0, 0.0}, {10.0, 0.0, 0.0}, 200, heading);
  EXPECT_NEAR(session.records.back().proxy.pose().position.x(), 2.0, 1e-9);
  EXPECT_NEAR(session.records.back().thrust, 1.0, 1e-9);
}

TEST(ConstantThrust, ComesAlongTheApproachThatIsGiven)
{
  Session session(setupWith(1.0));
  session.parameters.constantThrust = 1;
  session.parameters.approach[1] = 2.0;
  session.proxy.normal = -Vector3d::UnitY();
  session.go({0.0, -5.0, 0.0}, {0.0, -5.0, 0.0}, 200);
  EXPECT_NEAR((session.records.back().proxy.pose().position - Vector3d(0.0, -2.0, 0.0)).norm(), 0.0,
              1e-9);
}

TEST(ConstantThrust, BacksOutOfTissueAndThenPresses)
{
  Session session(setupWith(1.0));
  session.parameters.constantThrust = 1;
  session.go({0.0, 0.0, -3.0}, {0.0, 0.0, -3.0}, 400);
  EXPECT_NEAR(session.records.back().proxy.pose().position.z(), 2.0, 1e-9);
  EXPECT_NEAR(session.records.back().thrust, 1.0, 1e-9);
}

TEST(ConstantThrust, StopsWhereThereIsNothingToPressOn)
{
  Session session(setupWith(1.0));
  session.proxy.absent = true;
  session.parameters.constantThrust = 1;
  session.go({0.0, 0.0, 0.0}, {0.0, 0.0, 0.0}, 3000);
  EXPECT_NEAR(session.records.back().proxy.pose().position.z(), -ConstantThrust::kReach, 1e-9);
}

TEST(ConstantThrust, PullsSidewaysNoHarderThanItPresses)
{
  Session session(setupWith(1.0));
  session.parameters.constantThrust = 1;
  session.go({0.0, 0.0, 2.5}, {0.0, 0.0, 2.5}, 100);
  const Vector3d before = session.records.back().proxy.pose().position;
  session.tick({{4.0, 0.0, 2.5}, Quaterniond::Identity()});
  EXPECT_NEAR((session.records.back().proxy.pose().position - before).norm(), 1.0, 1e-6);
}
