#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

#include <gtest/gtest.h>

#include "SimulatedDevice.h"
#include "petrous/Core/Error.h"
#include "petrous/Haptics/PassivityGuard.h"

using namespace petrous::haptics;
using Eigen::Vector3d;
using Parameters = PassivityGuard::Parameters;

namespace
{

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

Pose along(double x)
{
  return {{x, 0, 0}, Eigen::Quaterniond::Identity()};
}

// 50 g (and 45 kg mm^2) on a soft spring with the damping b of a light device: a sampled spring is
// passive up to K = 2 b / T = 0.4 N/mm (360 N mm/rad).
SimulatedDevice::Hand lightHand()
{
  SimulatedDevice::Hand hand;
  hand.mass = 0.05;
  hand.inertia = 45.0;
  hand.stiffness = 0.1;
  hand.angularStiffness = 90.0;
  hand.damping = 2e-4;
  hand.angularDamping = 0.18;
  hand.subStep = 2e-5;
  return hand;
}

// Response of a rendered spring, sampled at 1 kHz, to an impact: largest excursions after it and at
// the end, mm or rad, and whether the guard ever changed a bit.
struct Outcome
{
  double first = 0.0;
  double last = 0.0;
  bool untouched = true;
};

template <typename Environment>
Outcome strike(PassivityGuard* guard, bool turning, double seconds, Environment wrenchAt)
{
  SimulatedDevice device([](double) { return Pose(); }, lightHand(), {});
  device.read(0.0);
  // Short, so that the spring is nearly relaxed when the guard starts.
  device.send(turning ? Wrench{{0, 0, 0}, {0, 450.0, 0}} : Wrench{{5.0, 0, 0}, {0, 0, 0}});
  device.read(0.001);
  Outcome outcome;
  const int ticks = static_cast<int>(seconds * 1000.0);
  for (int n = 0; n < ticks; ++n)
  {
    const double now = 0.001 + 0.001 * n;
    const Pose pose = device.read(now).pose;
    const Wrench wanted = wrenchAt(pose);
    const Wrench out = guard ? guard->apply(wanted, pose, now) : wanted;
    outcome.untouched =
        outcome.untouched && out.linear == wanted.linear && out.angular == wanted.angular;
    device.send(out);
    const double extent = pose.position.norm() + rotationVector(pose.rotation).norm();
    if (n < 100)
      outcome.first = std::max(outcome.first, extent);
    if (n >= ticks - 300)
      outcome.last = std::max(outcome.last, extent);
  }
  return outcome;
}

auto spring(double stiffness, double angularStiffness = 0.0)
{
  return [=](const Pose& pose) {
    return Wrench{-stiffness * pose.position, -angularStiffness * rotationVector(pose.rotation)};
  };
}

// A wall in x < 0.5 mm; the hand's target is behind it.
Wrench wall(const Pose& pose)
{
  const double depth = 0.5 - pose.position.x();
  return {{depth > 0.0 ? 5.0 * depth : 0.0, 0, 0}, {0, 0, 0}};
}

} // namespace

TEST(PassivityGuard, ASpringBeyondTheLimitGrowsWithoutAndStaysBoundedWithTheGuard)
{
  for (const double stiffness : {1.0, 2.0, 5.0})
  {
    const Outcome without = strike(nullptr, false, 1.5, spring(stiffness));
    EXPECT_GT(without.last, 10.0 * without.first) << stiffness;
    PassivityGuard guard;
    const Outcome with = strike(&guard, false, 30.0, spring(stiffness));
    EXPECT_LT(with.last, with.first) << stiffness;
    EXPECT_FALSE(with.untouched);
  }
}

TEST(PassivityGuard, AngularSpringsBeyondTheLimitAreHeldToo)
{
  const Outcome without = strike(nullptr, true, 1.0, spring(0.0, 2000.0));
  EXPECT_GT(without.last, 10.0 * without.first);
  PassivityGuard guard;
  const Outcome with = strike(&guard, true, 30.0, spring(0.0, 2000.0));
  EXPECT_LT(with.last, with.first);
}

TEST(PassivityGuard, BouncingOnAStiffWallDiesDownInsteadOfGrowing)
{
  const Outcome without = strike(nullptr, false, 20.0, wall);
  PassivityGuard guard;
  const Outcome with = strike(&guard, false, 20.0, wall);
  EXPECT_GT(without.last, 2.0 * without.first);
  EXPECT_LT(with.last, 1.1 * with.first);
}

TEST(PassivityGuard, ASpringWithinTheLimitPassesToTheLastBit)
{
  Parameters parameters;
  parameters.deviceDamping = 2e-4;
  parameters.deviceAngularDamping = 0.18;
  for (const bool turning : {false, true})
    for (const bool known : {false, true})
    {
      parameters.stiffness = known ? 0.39 : 0.0;
      parameters.angularStiffness = known ? 350.0 : 0.0;
      PassivityGuard guard(parameters);
      EXPECT_TRUE(strike(&guard, turning, 10.0, spring(0.39, 350.0)).untouched);
    }
}

TEST(PassivityGuard, ADamperPassesToTheLastBit)
{
  PassivityGuard guard;
  std::mt19937 random(1);
  std::normal_distribution<double> push(0.0, 40.0);
  double x = 0.0;
  double v = 0.0;
  for (int n = 0; n < 10000; ++n)
  {
    // The force opposes the motion of the steps before and after: v keeps its sign.
    v = n % 500 == 0 ? push(random) : 0.99 * v;
    const Wrench wanted{{n % 500 == 0 ? 0.0 : -0.005 * v, 0, 0}, {0, 0, 0}};
    const Wrench out = guard.apply(wanted, along(x), 0.001 * n);
    ASSERT_EQ(out.linear, wanted.linear) << n;
    x += 0.001 * v;
  }
}

TEST(PassivityGuard, DampsAForceThatPushesTheHandAlong)
{
  // 1 N along a motion of 0.1 mm per tick gives 0.1 N mm per tick; 0.05 are allowed. At 100 mm/s
  // and 1 ms a damping of alpha dissipates 10 alpha, so 0.005 N s/mm pays 0.05 N mm with 0.5 N.
  PassivityGuard guard;
  const Wrench wanted{{1, 0, 0}, {0, 0, 0}};
  EXPECT_EQ(guard.apply(wanted, along(0.0), 0.000).linear.x(), 1.0);
  EXPECT_NEAR(guard.apply(wanted, along(0.1), 0.001).linear.x(), 0.5, 1e-9);
  EXPECT_NEAR(guard.energy(), -0.1, 1e-12);
  EXPECT_NEAR(guard.damping(), 0.005, 1e-12);
  EXPECT_NEAR(guard.apply(wanted, along(0.2), 0.002).linear.x(), 0.0, 1e-9);
  EXPECT_NEAR(guard.energy(), -0.15, 1e-12);
  for (int n = 3; n < 100; ++n)
    guard.apply(wanted, along(0.1 * n), 0.001 * n);
  EXPECT_NEAR(guard.energy(), -0.15, 1e-9) << "no more is given out";
}

TEST(PassivityGuard, TheDampingHasItsLimit)
{
  Parameters parameters;
  parameters.largestDamping = 0.001;
  PassivityGuard guard(parameters);
  for (int n = 0; n < 200; ++n)
  {
    const Wrench out = guard.apply({{1, 0, 0}, {0, 0, 0}}, along(0.1 * n), 0.001 * n);
    ASSERT_GE(out.linear.x(), 1.0 - 0.001 * 100.0 - 1e-9);
  }
  EXPECT_EQ(guard.damping(), 0.001);
}

TEST(PassivityGuard, EnergyIsTheWorkDoneAgainstWhatWasSent)
{
  PassivityGuard guard;
  std::mt19937 random(2);
  std::normal_distribution<double> normal;
  Pose pose;
  double work = 100.0;
  Wrench sent{{-1000.0, 0, 0}, {0, 0, 0}}; // credit first, so that nothing is damped
  guard.apply(sent, along(-0.1), -0.001);
  for (int n = 0; n < 2000; ++n)
  {
    const Wrench wanted{{normal(random), normal(random), normal(random)},
                        {normal(random), normal(random), normal(random)}};
    guard.apply(wanted, pose, 0.001 * n);
    ASSERT_EQ(guard.damping(), 0.0);
    ASSERT_NEAR(guard.energy(), work, 1e-9);
    sent = wanted;
    if (n % 3 == 0)
    {
      sent = {0.5 * wanted.linear, {0, 0, 0}};
      guard.sent(sent);
    }
    const Motion step{{0.01 * normal(random), 0.01 * normal(random), 0.01 * normal(random)},
                      {0.01 * normal(random), 0.01 * normal(random), 0.01 * normal(random)}};
    pose = moved(pose, step);
    work -= sent.linear.dot(step.linear) + sent.angular.dot(step.angular);
  }
}

TEST(PassivityGuard, EnergySpentInDrillingGivesNoCreditForLater)
{
  Parameters parameters;
  parameters.stiffness = 2.0;
  PassivityGuard guard(parameters);
  for (int n = 0; n < 1000; ++n) // 2 N over 100 mm
    guard.apply({{-2, 0, 0}, {0, 0, 0}}, along(0.1 * n), 0.001 * n);
  EXPECT_LE(guard.energy(), 1.0 + 1e-12) << "all that a spring of 2 N/mm holds at 2 N";

  PassivityGuard unknown;
  for (int n = 0; n < 1000; ++n)
    unknown.apply({{-2, 0, 0}, {0, 0, 0}}, along(0.1 * n), 0.001 * n);
  EXPECT_NEAR(unknown.energy(), 199.8, 1e-9);
  unknown.apply({}, along(100.0), 1.0);
  EXPECT_EQ(unknown.energy(), 0.0) << "out of contact";
}

TEST(PassivityGuard, SeesAForceThatPushesOnThroughManyCounts)
{
  Parameters parameters;
  parameters.stiffness = 1.0;
  PassivityGuard guard(parameters);
  for (int n = 0; n < 200; ++n) // 1 N over a count of 0.05 mm each 10 ms: 1 mJ
    guard.apply({{1, 0, 0}, {0, 0, 0}}, along(0.05 * (n / 10)), 0.001 * n);
  EXPECT_LT(guard.energy(), -0.05);
}

// The handle crosses one count at a time, on a spring that feels the readings: the force is a
// function of the position, so no press gives or takes anything, and none may leave a debt.
TEST(PassivityGuard, ManySlowPressesOnCoarseEncodersLeaveNoDebt)
{
  constexpr double q = 0.055;
  for (const double stiffness : {0.35, 1.0, 1.8, 2.8, 3.6}) // 4 f / q = 3.64
  {
    Parameters parameters;
    parameters.stiffness = stiffness;
    PassivityGuard guard(parameters);
    int tick = 0;
    const auto rest = [&](int count)
    {
      for (int n = 0; n < 12; ++n, ++tick)
      {
        const Wrench wanted{{-stiffness * q * std::max(0, count), 0, 0}, {0, 0, 0}};
        ASSERT_EQ(guard.apply(wanted, along(q * count), 0.001 * tick).linear, wanted.linear);
      }
    };
    for (int press = 0; press < 100; ++press)
    {
      for (int count = -2; count < 20; ++count)
        rest(count);
      for (int count = 20; count > -2; --count)
        rest(count);
      ASSERT_GE(guard.energy(), -1e-12) << stiffness << " N/mm, press " << press;
      ASSERT_LE(guard.energy(), 1e-12) << stiffness << " N/mm, press " << press;
    }
  }
}

// The balance at the handle itself, of motions slow and fast with ticks missed. With readings
// p = h + e and a spring in contact at p > 0, E exceeds the hand's work by no more than (record 55)
//   |F| (q/2 + s) + k sum((s |dp| - e dp) + s |dp|)
TEST(PassivityGuard, TakesNoMoreCreditThanItsBound)
{
  constexpr double q = 0.05;
  constexpr double stiffness = 1.5; // s = q/2
  Parameters parameters;
  parameters.stiffness = stiffness;
  parameters.allowance = 1e6; // observes only
  PassivityGuard guard(parameters);
  std::mt19937 random(3);
  std::normal_distribution<double> push(0.0, 1.0);
  double h = -1.0;
  double v = 0.0;
  double speed = 1.0;
  double force = 0.0;
  double work = 0.0;  // of the hand, N mm
  double bound = 0.0; // N mm
  double before = q * std::round(h / q);
  double most = 0.0;
  for (int n = 0; n < 200000; ++n)
  {
    if (n % 4000 == 0)
      speed = n % 8000 == 0 ? 2.0 : 60.0; // mm/s
    v = 0.98 * v + 0.2 * speed * push(random) - 0.5 * h;
    const double step = 0.001 * v;
    work -= force * step;
    h += step;
    if (random() % 20 == 0)
      continue;
    const double p = q * std::round(h / q);
    const double moved = p - before;
    bound += stiffness * (q * std::abs(moved) - (p - h) * moved);
    before = p;
    force = -stiffness * std::max(0.0, p);
    guard.apply({{force, 0, 0}, {0, 0, 0}}, along(p), 0.001 * n);
    ASSERT_LE(guard.energy(), work + bound + std::abs(force) * q + 1e-9) << n;
    most = std::max(most, guard.energy());
  }
  EXPECT_GT(most, 0.5) << "it was pressed";
}

TEST(PassivityGuard, WhatCannotBeObservedPassesUnchanged)
{
  const Wrench wanted{{1, 2, 3}, {4, 5, 6}};
  for (const double now : {0.05, 0.049, 0.0721, 1e9, kNan})
  {
    PassivityGuard guard;
    for (int n = 0; n <= 50; ++n) // deep in debt
      guard.apply(wanted, along(0.1 * n), 0.001 * n);
    const double before = guard.energy();
    const Wrench out = guard.apply(wanted, along(9.0), now);
    EXPECT_EQ(out.linear, wanted.linear);
    EXPECT_EQ(out.angular, wanted.angular);
    EXPECT_EQ(guard.energy(), before);
  }
  PassivityGuard guard;
  guard.apply(wanted, along(0.0), 0.0);
  EXPECT_EQ(guard.apply(wanted, along(kNan), 0.001).linear, wanted.linear);
  EXPECT_EQ(guard.apply(wanted, along(5.0), 0.002).linear, wanted.linear) << "no step to it";
  EXPECT_EQ(guard.energy(), 0.0);
}

TEST(PassivityGuard, NumbersThatAreNoneLeaveNoTrace)
{
  PassivityGuard guard;
  guard.apply({{kNan, 0, 0}, {0, 0, 0}}, along(0.0), 0.0);
  guard.apply({{1e300, 0, 0}, {0, 0, 0}}, along(0.1), 0.001);
  guard.sent({{kNan, 0, 0}, {0, 0, 0}});
  guard.apply({{1e300, 0, 0}, {0, 0, 0}}, along(0.2), 0.002);
  guard.apply({{1, 0, 0}, {0, 0, 0}}, along(1e200), 0.003);
  EXPECT_TRUE(std::isfinite(guard.energy()));
  for (int n = 4; n < 100; ++n)
    ASSERT_TRUE(guard.apply({{-1, 0, 0}, {0, 0, 0}}, along(0.1 * n), 0.001 * n).finite());
}

TEST(PassivityGuard, RefusesParametersThatMakeNoSense)
{
  const auto refuses = [](double Parameters::*value, double is)
  {
    Parameters parameters;
    parameters.*value = is;
    EXPECT_THROW(PassivityGuard{parameters}, petrous::core::InvalidParameter);
  };
  for (const auto value :
       {&Parameters::allowance, &Parameters::stiffness, &Parameters::angularStiffness,
        &Parameters::deviceDamping, &Parameters::deviceAngularDamping, &Parameters::largestDamping,
        &Parameters::lever})
  {
    refuses(value, -1.0);
    refuses(value, kNan);
  }
  refuses(&Parameters::allowance, 0.0);
  refuses(&Parameters::largestDamping, 0.0);
  refuses(&Parameters::lever, 0.0);
}
