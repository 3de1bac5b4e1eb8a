#include <cmath>

#include <gtest/gtest.h>

#include "Session.h"

using namespace petrous;
using namespace petrous::session;
using namespace petrous::session::testing;
using Eigen::Quaterniond;
using Eigen::Vector3d;

namespace
{

ServoSetup setupWith(double stiffness)
{
  ServoSetup setup = Session::plainSetup();
  setup.guard.goodTicks = 1; // a scripted path is valid from its first tick
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
      session.parameters.approach[2] = -10.0;
      session.parameters.thrust = thrust;
      // The target is above, then in, then above the surface, and moves along it.
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
      // Perpendicular to the normal the tool is at the device's position.
      const Vector3d place = session.records.back().mapped.pose().position;
      const Vector3d off = session.records.back().proxy.pose().position - place;
      EXPECT_LT(off.cross(session.proxy.normal).norm(), 0.05);
    }
}

TEST(ConstantThrust, KeepsTheForceWhileTheSurfaceGivesWay)
{
  Session session(setupWith(1.0));
  session.parameters.constantThrust = 1;
  session.parameters.approach[2] = -2.5;
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

TEST(ConstantThrust, ComesAlongItsApproachNoFasterThanSet)
{
  Session session(setupWith(1.0));
  session.parameters.constantThrust = 1;
  session.parameters.approachSpeed = 30.0;
  session.parameters.approach[0] = -10.0;
  // The burr comes along -x to a wall there.
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
  session.parameters.approach[1] = 5.0;
  session.proxy.normal = -Vector3d::UnitY();
  session.go({0.0, -5.0, 0.0}, {0.0, -5.0, 0.0}, 200);
  EXPECT_NEAR((session.records.back().proxy.pose().position - Vector3d(0.0, -2.0, 0.0)).norm(), 0.0,
              1e-9);
}

TEST(ConstantThrust, BacksOutOfTissueAndThenPresses)
{
  Session session(setupWith(1.0));
  session.parameters.constantThrust = 1;
  session.parameters.approach[2] = -3.0;
  session.go({0.0, 0.0, -3.0}, {0.0, 0.0, -3.0}, 400);
  EXPECT_NEAR(session.records.back().proxy.pose().position.z(), 2.0, 1e-9);
  EXPECT_NEAR(session.records.back().thrust, 1.0, 1e-9);
}

TEST(ConstantThrust, GoesNoFartherFromItsPlaceThanTheSurfaceIs)
{
  Session session(setupWith(1.0));
  session.proxy.absent = true;
  session.parameters.constantThrust = 1;
  session.parameters.approach[1] = 4.0;
  session.go({0.0, 0.0, 0.0}, {0.0, 0.0, 0.0}, 3000);
  EXPECT_NEAR((session.records.back().proxy.pose().position - Vector3d(0.0, 4.0, 0.0)).norm(), 0.0,
              1e-9);
}

TEST(ConstantThrust, WaitsAtItsPlaceWhereThereIsNothingToPressOn)
{
  Session session(setupWith(1.0));
  session.proxy.absent = true;
  session.parameters.constantThrust = 1;
  session.go({1.0, 2.0, 3.0}, {3.0, 2.0, 1.0}, 3000);
  EXPECT_NEAR((session.records.back().proxy.pose().position - Vector3d(3.0, 2.0, 1.0)).norm(), 0.0,
              1e-9);
}

TEST(ConstantThrust, PullsSidewaysNoHarderThanItPresses)
{
  Session session(setupWith(1.0));
  session.parameters.constantThrust = 1;
  session.parameters.approach[2] = -2.5;
  session.go({0.0, 0.0, 2.5}, {0.0, 0.0, 2.5}, 100);
  const Vector3d before = session.records.back().proxy.pose().position;
  session.tick({{4.0, 0.0, 2.5}, Quaterniond::Identity()});
  const double pulled = (session.records.back().proxy.pose().position - before).norm();
  EXPECT_GT(pulled, 0.5);
  EXPECT_LT(pulled, 1.0); // F / k
}

TEST(ConstantThrust, GuidesWhatFollows)
{
  Session session(setupWith(10.0));
  session.proxy.stiffness = 10.0;
  session.parameters.constantThrust = 1;
  session.parameters.thrust = 0.2;
  session.parameters.approach[2] = -2.5;
  session.go({0.0, 0.0, 2.5}, {0.0, 0.0, 2.5}, 100);
  session.go({0.0, 0.0, 2.5}, {10.0, 0.0, 2.5}, 100); // 0.1 m/s
  EXPECT_NEAR(session.records.back().proxy.pose().position.x(), 10.0, 0.5);
  EXPECT_NEAR(session.records.back().thrust, 0.2, 0.002);
}

namespace
{

// Result of a tool that stands still and pushes back with the coupling's whole force, except for
// the planned motion that it does not make.
haptics::ProxyTick held(const Vector3d& at, const Vector3d& goal, double stiffness,
                        double planned = 0.0)
{
  haptics::ProxyTick tick;
  tick.status = haptics::ProxyStatus::Contact;
  tick.pose.position = at;
  Vector3d stretch = goal - at;
  stretch *= 1.0 - planned / stretch.norm();
  tick.wrench.linear = -stiffness * stretch;
  tick.contactCount = 1;
  tick.contacts[0].thrust = tick.wrench.linear.norm();
  tick.contacts[0].normal = tick.wrench.linear / tick.contacts[0].thrust;
  tick.thrust = tick.contacts[0].thrust;
  return tick;
}

constexpr double kTick = 0.001, kSpeed = 50.0;

Vector3d goalOf(ConstantThrust& thrust, const Vector3d& place, const Vector3d& at, double force)
{
  return thrust
      .goal({place, Quaterniond::Identity()}, {at, Quaterniond::Identity()},
            -5.0 * Vector3d::UnitZ(), force, kSpeed, kTick)
      .position;
}

// In contact with a plane under it.
ConstantThrust onAPlane(const Vector3d& at, double stiffness)
{
  ConstantThrust thrust(stiffness, 1);
  goalOf(thrust, at, at, 1.0);
  thrust.see(held(at, at - Vector3d(0.0, 0.0, 0.1), stiffness), kSpeed, kTick);
  return thrust;
}

} // namespace

// A wall holds it off its target: including the lateral pull, the force is the requested one.
TEST(ConstantThrust, WhatPullsSidewaysIsPartOfTheForce)
{
  const Vector3d at(0.0, 0.0, 2.0), place(0.05, 0.0, 2.0);
  ConstantThrust thrust = onAPlane(at, 10.0);
  Vector3d goal;
  for (int n = 0; n < 200; ++n)
  {
    goal = goalOf(thrust, place, at, 1.0);
    thrust.see(held(at, goal, 10.0), kSpeed, kTick);
  }
  EXPECT_NEAR(10.0 * (goal - at).norm(), 1.0, 0.01);
  EXPECT_NEAR(10.0 * (goal - at).x(), 0.5, 0.01);
}

// Ripples of the hollow let it slide back and forth, and push it sideways.
TEST(ConstantThrust, SlidingInAHollowDoesNotTurnIt)
{
  const Vector3d at(0.0, 0.0, 2.0), place(0.0, 0.0, -3.0);
  ConstantThrust thrust = onAPlane(at, 10.0);
  Vector3d goal;
  for (int n = 0; n < 2000; ++n)
  {
    const Vector3d slid = at + Vector3d(0.05 * std::sin(0.3 * n), 0.0, 0.0);
    goal = goalOf(thrust, place, slid, 1.0);
    const Vector3d ripple(0.05, 0.0, 0.0);
    thrust.see(held(slid, goal + ripple, 10.0), kSpeed, kTick);
  }
  const Vector3d last = at + Vector3d(0.05 * std::sin(0.3 * 1999), 0.0, 0.0);
  // It pulls sideways towards the target, which is straight below the first contact.
  EXPECT_NEAR((goal - last).x(), -last.x(), 1e-6);
}

// A tick's work is bounded: a tool may plan a motion that it does not make, and push less.
TEST(ConstantThrust, MakesUpForAToolThatPushesLessThanRequested)
{
  const Vector3d at(0.0, 0.0, 2.0);
  ConstantThrust thrust = onAPlane(at, 10.0);
  haptics::ProxyTick tick;
  for (int n = 0; n < 50; ++n)
  {
    tick = held(at, goalOf(thrust, at, at, 1.0), 10.0, 0.02);
    thrust.see(tick, kSpeed, kTick);
  }
  EXPECT_NEAR(tick.thrust, 1.0, 0.01);
}

TEST(ConstantThrust, ComesBackGentlyToASurfaceThatItLost)
{
  const Vector3d at(0.0, 0.0, 2.0);
  ConstantThrust thrust = onAPlane(at, 10.0);
  haptics::ProxyTick free;
  free.pose.position = goalOf(thrust, at, at, 0.1); // arrived, with nothing there
  thrust.see(free, kSpeed, kTick);
  const Vector3d next = goalOf(thrust, at, free.pose.position, 0.1);
  // Meeting the surface there would cost some tenths of a newton, not 50 mm/s and 0.5 N.
  EXPECT_LE(10.0 * (free.pose.position - next).norm(), 3.0 * 0.1 + 1e-9);
  EXPECT_NEAR((at - free.pose.position).norm(), 0.01, 1e-9);
}

// The tissue under it gave way, and the tool hangs on something that gives no row.
TEST(ConstantThrust, AFallThatMakesNoWayIsOver)
{
  const Vector3d at(0.0, 0.0, 2.0);
  ConstantThrust thrust = onAPlane(at, 10.0);
  const Vector3d place(0.0, 0.0, 5.0); // the approach is along +x
  const auto goal = [&]
  {
    return thrust
        .goal({place, Quaterniond::Identity()}, {at, Quaterniond::Identity()}, {4.0, 0.0, 0.0}, 1.0,
              kSpeed, kTick)
        .position;
  };
  haptics::ProxyTick hangs;
  hangs.pose.position = at;
  for (int n = 0; n < ConstantThrust::kIdleTicks; ++n)
  {
    EXPECT_NEAR(goal().x(), 0.0, 1e-12) << n;
    thrust.see(hangs, kSpeed, kTick);
  }
  EXPECT_GT(goal().x(), 0.0);
  EXPECT_GT(goal().z(), at.z()); // back to its target
}

// The burr touches nothing, and the target is far: the obstacle is pulled with at most the thrust.
TEST(ConstantThrust, AToolThatItsShaftHoldsPullsWithTheThrust)
{
  ConstantThrust thrust(10.0, 1);
  const Vector3d at(0.0, 0.0, 2.0);
  haptics::ProxyTick tick;
  tick.status = haptics::ProxyStatus::Contact;
  tick.pose.position = at;
  tick.contactCount = 1;
  tick.contacts[0].point = 7; // not on the burr
  tick.contacts[0].thrust = 1.0;
  for (int n = 0; n < 100; ++n)
  {
    const Vector3d goal = goalOf(thrust, {40.0, -20.0, 1.0}, at, 1.0);
    if (n > 0)
    {
      EXPECT_LE(10.0 * (goal - at).norm(), 1.0 + 1e-12);
    }
    thrust.see(tick, kSpeed, kTick);
  }
}

// The mode is left and re-entered in contact: the time in between does not count.
TEST(ConstantThrust, BeginsAnewWhereItWasNotAskedFor)
{
  const Vector3d at(0.0, 0.0, 2.0);
  ConstantThrust thrust = onAPlane(at, 10.0);
  goalOf(thrust, at, at, 1.0);
  thrust.see(held(at, at - Vector3d(0.0, 0.0, 0.1), 10.0), kSpeed, kTick);
  for (int n = 0; n < 100; ++n) // manually, lightly
    thrust.see(held(at, at - Vector3d(0.0, 0.0, 0.001), 10.0), kSpeed, kTick);
  EXPECT_NEAR(10.0 * (goalOf(thrust, at, at, 1.0) - at).norm(), 1.0, 1e-6);
}

TEST(ConstantThrust, IsCoupledTheStifferTheHarderItPresses)
{
  const haptics::ProxyParameters usual;
  for (const double thrust : {0.0, 0.01, 0.04})
    EXPECT_EQ(ConstantThrust::coupling(thrust).stiffness, usual.stiffness);
  double before = usual.stiffness;
  for (const double thrust : {0.1, 0.2, 0.4, 5.0, 20.0})
  {
    const auto coupling = ConstantThrust::coupling(thrust);
    EXPECT_GE(coupling.stiffness, before);
    EXPECT_GE(thrust / coupling.stiffness, 0.04 - 1e-12); // mm
    before = coupling.stiffness;
  }
}
