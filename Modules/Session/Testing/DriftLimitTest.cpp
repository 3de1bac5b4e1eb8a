#include <limits>

#include <gtest/gtest.h>

#include "Session.h"

using namespace petrous::session;
using namespace petrous::session::testing;
using Eigen::Vector3d;
using petrous::haptics::Pose;

namespace
{

const Vector3d kAbove(0.0, 0.0, 5.0);

} // namespace

TEST(DriftLimit, BoundsTheForceAndForgetsWhatTheDeviceRanAhead)
{
  Session session;
  session.parameters.driftLimit = 0.5F;
  session.go(kAbove, kAbove, 50);
  const Vector3d deep(0.0, 0.0, -30.0); // 32 mm beyond where the plane holds the ball
  const TickRecord& pressed = session.go(kAbove, deep, 200);
  EXPECT_NEAR(forceOf(pressed.wrench).z(), 0.5, 1e-9); // 1 N/mm
  EXPECT_NEAR((pressed.mapped.pose().position - Vector3d(0.0, 0.0, 1.5)).norm(), 0.0, 1e-9);
  // Moving back by 1 of 32 mm puts the goal 1 mm above the drift limit.
  const TickRecord& back = session.go(deep, deep + Vector3d(0.0, 0.0, 1.0), 50);
  EXPECT_NEAR(back.mapped.pose().position.z(), 2.5, 1e-9);
  EXPECT_NEAR(back.proxy.pose().position.z(), 2.5, 1e-9);
  EXPECT_EQ(forceOf(back.wrench).norm(), 0.0);
}

TEST(DriftLimit, LeavesAFreeDeviceAlone)
{
  Session free;
  Session limited;
  limited.parameters.driftLimit = 0.5F;
  for (Session* session : {&free, &limited})
  {
    session->go(kAbove, kAbove, 50);
    session->go(kAbove, {40.0, -20.0, 60.0}, 100, Eigen::Quaterniond(0.8, 0.0, 0.6, 0.0));
  }
  const Pose a = free.records.back().proxy.pose();
  const Pose b = limited.records.back().proxy.pose();
  EXPECT_NEAR((a.position - b.position).norm(), 0.0, 1e-9);
  EXPECT_LE(petrous::haptics::motionBetween(a, b).angular.norm(), 1e-9);
}

TEST(DriftLimit, RefusesABoundThatIsNone)
{
  Session session;
  session.go(kAbove, kAbove, 50);
  session.parameters.driftLimit = -1.0F;
  EXPECT_EQ(faultOf(session.tick({kAbove, Eigen::Quaterniond::Identity()})),
            ServoFault::Parameters);
  session.parameters.driftLimit = std::numeric_limits<float>::quiet_NaN();
  EXPECT_EQ(faultOf(session.tick({kAbove, Eigen::Quaterniond::Identity()})),
            ServoFault::Parameters);
}
