#include <cmath>
#include <limits>
#include <random>

#include <gtest/gtest.h>

#include "petrous/Core/Error.h"
#include "petrous/Haptics/ForceLimits.h"

using namespace petrous::haptics;
using Eigen::Vector3d;
using Limits = ForceLimits::Limits;

namespace
{

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();

Limits wide() // to test one limit at a time
{
  Limits limits;
  limits.maxForce = 10.0;
  limits.maxTorque = 100.0;
  limits.forceSlew = 1e9;
  limits.torqueSlew = 1e9;
  return limits;
}

// Limits after one second with force enabled, with their clock.
struct Running
{
  explicit Running(const Limits& limits = wide())
    : is(limits)
  {
    is.resume();
    for (int n = 0; n < 1000; ++n)
      is.apply({}, now += 0.001);
  }
  Wrench tick(const Wrench& wanted) { return is.apply(wanted, now += 0.001); }

  ForceLimits is;
  double now = 0.0;
};

} // namespace

TEST(ForceLimits, PassesAWrenchWithinItsLimitsToTheLastBit)
{
  Running limits;
  std::mt19937 random(1);
  std::uniform_real_distribution<double> part(-5.0, 5.0);
  for (int n = 0; n < 1000; ++n)
  {
    const Wrench wanted{{part(random), part(random), part(random)},
                        {10 * part(random), 10 * part(random), 10 * part(random)}};
    const Wrench out = limits.tick(wanted);
    ASSERT_EQ(out.linear, wanted.linear);
    ASSERT_EQ(out.angular, wanted.angular);
    ASSERT_FALSE(limits.is.notes().saturated || limits.is.notes().slewed);
  }
}

TEST(ForceLimits, SaturatesForceAndTorqueApartAndKeepsTheirDirections)
{
  Running limits;
  Wrench out = limits.tick({{30, 40, 0}, {1, 2, 2}});
  EXPECT_LE((out.linear - Vector3d(6, 8, 0)).norm(), 1e-14);
  EXPECT_EQ(out.angular, Vector3d(1, 2, 2));
  EXPECT_TRUE(limits.is.notes().saturated);
  out = limits.tick({{1, 2, 3}, {0, 0, -500}});
  EXPECT_EQ(out.linear, Vector3d(1, 2, 3));
  EXPECT_EQ(out.angular, Vector3d(0, 0, -100));
  out = limits.tick({{1e308, -1e308, 1e308}, {0, 0, 0}});
  EXPECT_LE((out.linear - 10.0 / std::sqrt(3.0) * Vector3d(1, -1, 1)).norm(), 1e-14);
}

TEST(ForceLimits, ADeviceWithoutTorqueGetsNone)
{
  Limits device = wide();
  device.maxTorque = 0.0;
  Running limits(device);
  EXPECT_EQ(limits.tick({{1, 0, 0}, {5, 5, 5}}).angular, Vector3d(0, 0, 0));
}

TEST(ForceLimits, ChangesNoFasterThanTheSlewRate)
{
  Limits slow = wide();
  slow.forceSlew = 100.0;
  slow.torqueSlew = 2000.0;
  Running limits(slow);
  const Wrench wanted{{0.0, 3.0, 4.0}, {50.0, 0.0, 0.0}};
  for (int n = 1; n <= 60; ++n)
  {
    const Wrench out = limits.tick(wanted);
    ASSERT_NEAR(out.linear.norm(), std::min(5.0, 0.1 * n), 1e-9);
    ASSERT_NEAR(out.linear.dot(Vector3d(0, 0.6, 0.8)), out.linear.norm(), 1e-12);
    ASSERT_NEAR(out.angular.x(), std::min(50.0, 2.0 * n), 1e-9);
    if (n != 50) // rounding decides there
    {
      ASSERT_EQ(limits.is.notes().slewed, n < 50) << n;
    }
  }
}

TEST(ForceLimits, NoInputEverPutsOutMoreThanTheLimits)
{
  Limits hard = wide();
  hard.forceSlew = 500.0;
  Running limits(hard);
  std::mt19937 random(2);
  std::normal_distribution<double> part(0.0, 20.0);
  std::uniform_real_distribution<double> step(-0.002, 0.004);
  Vector3d last(0, 0, 0);
  for (int n = 0; n < 100000; ++n)
  {
    switch (random() % 400)
    {
    case 0:
      limits.is.fault();
      break;
    case 1:
      limits.is.resume();
      break;
    default:;
    }
    const double dt = step(random);
    Wrench wanted{{part(random), part(random), part(random)},
                  {part(random), part(random), part(random)}};
    if (random() % 50 == 0)
      wanted.linear.y() = kNan;
    const Wrench out = limits.is.apply(wanted, limits.now += dt);
    ASSERT_TRUE(out.finite());
    ASSERT_LE(out.linear.norm(), 10.0 + 1e-12);
    ASSERT_LE(out.angular.norm(), 100.0 + 1e-12);
    ASSERT_LE(out.linear.norm() - last.norm(), 500.0 * std::max(dt, 0.0) + 1e-9);
    last = out.linear;
  }
}

TEST(ForceLimits, BeginsStopped)
{
  ForceLimits limits(wide());
  EXPECT_TRUE(limits.stopped());
  for (int n = 0; n < 1000; ++n)
    ASSERT_EQ(limits.apply({{5, 0, 0}, {}}, 0.001 * n).linear.norm(), 0.0);
}

TEST(ForceLimits, FadesInOverATenthOfASecond)
{
  ForceLimits limits(wide());
  limits.apply({}, 0.0);
  limits.resume();
  for (int n = 1; n <= 200; ++n)
    ASSERT_NEAR(limits.apply({{5, 0, 0}, {0, 20, 0}}, 0.001 * n).linear.x(),
                5.0 * std::min(1.0, n / 100.0), 1e-9)
        << n;
  EXPECT_EQ(limits.fade(), 1.0);
}

TEST(ForceLimits, FallsToZeroInTwentyMillisecondsAfterAFault)
{
  Limits slow = wide();
  slow.forceSlew = 10.0; // by itself the fall would take half a second
  Running limits(slow);
  for (int n = 0; n < 1000; ++n)
    limits.tick({{0, 5, 0}, {0, 0, 20}});
  limits.is.fault();
  for (int n = 1; n <= 40; ++n)
  {
    limits.is.fault();
    const Wrench out = limits.tick({{9, -9, 9}, {kNan, 0, 0}}); // ignored
    const double share = std::max(0.0, 1.0 - n / 20.0);
    ASSERT_LE((out.linear - share * Vector3d(0, 5, 0)).norm(), 1e-9) << n;
    ASSERT_LE((out.angular - share * Vector3d(0, 0, 20)).norm(), 1e-9) << n;
  }
}

TEST(ForceLimits, ReturnsFromAFaultInAFade)
{
  Running limits;
  limits.tick({{5, 0, 0}, {}});
  limits.is.fault();
  for (int n = 0; n < 50; ++n)
    limits.tick({{5, 0, 0}, {}});
  limits.is.resume();
  for (int n = 1; n <= 120; ++n)
    ASSERT_NEAR(limits.tick({{5, 0, 0}, {}}).linear.x(), 5.0 * std::min(1.0, n / 100.0), 1e-9);
}

TEST(ForceLimits, ResumingInTheMidstOfAFallStaysContinuous)
{
  Limits slow = wide();
  slow.forceSlew = 400.0;
  Running limits(slow);
  for (int n = 0; n < 100; ++n)
    limits.tick({{5, 0, 0}, {}});
  limits.is.fault();
  double last = 0.0;
  for (int n = 0; n < 5; ++n)
    last = limits.tick({{5, 0, 0}, {}}).linear.x();
  limits.is.resume();
  for (int n = 0; n < 150; ++n)
  {
    const double out = limits.tick({{5, 0, 0}, {}}).linear.x();
    ASSERT_LE(std::abs(out - last), 0.4 + 1e-9);
    last = out;
  }
  EXPECT_EQ(last, 5.0);
}

TEST(ForceLimits, AWrenchThatIsNoNumberGivesZeroAndSaysSo)
{
  for (const double bad : {kNan, kInfinity, -kInfinity})
    for (const bool inTorque : {false, true})
    {
      Running limits;
      limits.tick({{5, 0, 0}, {1, 1, 1}});
      Wrench wanted{{5, 0, 0}, {1, 1, 1}};
      (inTorque ? wanted.angular : wanted.linear).y() = bad;
      const Wrench out = limits.tick(wanted);
      EXPECT_EQ(out.linear.norm() + out.angular.norm(), 0.0);
      EXPECT_TRUE(limits.is.notes().notFinite);
      EXPECT_NEAR(limits.tick({{5, 0, 0}, {}}).linear.x(), 0.05, 1e-9) << "it fades in again";
      EXPECT_FALSE(limits.is.notes().notFinite);
    }
}

TEST(ForceLimits, WhileTheClockStandsTheForceMayOnlyShrink)
{
  for (const double step : {0.0, -0.5, kNan})
  {
    Running limits;
    limits.tick({{0, 4, 0}, {0, 8, 0}});
    EXPECT_EQ(limits.is.apply({{0, 9, 0}, {30, 0, 0}}, limits.now += step).linear,
              Vector3d(0, 4, 0));
    Wrench out = limits.is.apply({{3, 0, 0}, {0, 1, 0}}, limits.now += step);
    EXPECT_LE((out.linear - Vector3d(0, 3, 0)).norm(), 1e-15) << "shorter, and not turned";
    EXPECT_LE((out.angular - Vector3d(0, 1, 0)).norm(), 1e-15);
    EXPECT_EQ(limits.is.apply({}, limits.now += step).linear.norm(), 0.0);
  }
}

TEST(ForceLimits, AClockSetBackGoesOnFromThere)
{
  Running limits;
  limits.now -= 100.0;
  limits.tick({{1, 0, 0}, {}});
  EXPECT_EQ(limits.tick({{1, 0, 0}, {}}).linear, Vector3d(1, 0, 0));
}

TEST(ForceLimits, TheFadeDoesNotAdvanceWhileTheClockStands)
{
  ForceLimits limits(wide());
  limits.resume();
  for (int n = 0; n < 1000; ++n)
    ASSERT_EQ(limits.apply({{5, 0, 0}, {}}, 3.0).linear.norm(), 0.0);
}

TEST(ForceLimits, AFaultEndsTheForceEvenIfTheClockStands)
{
  for (const double step : {0.0, -0.001, kNan})
  {
    Running limits;
    limits.tick({{5, 0, 0}, {}});
    limits.is.fault();
    double out = 5.0;
    for (int n = 0; n < 21; ++n)
      out = limits.is.apply({{5, 0, 0}, {}}, limits.now += step).linear.norm();
    EXPECT_EQ(out, 0.0);
  }
}

TEST(ForceLimits, AfterAStallOneStepCountsNoMoreThanTenMilliseconds)
{
  Limits slow = wide();
  slow.forceSlew = 100.0;
  Running limits(slow);
  EXPECT_NEAR(limits.is.apply({{5, 0, 0}, {}}, limits.now += 3600.0).linear.x(), 1.0, 1e-12);

  ForceLimits fading(wide());
  fading.apply({}, 0.0);
  fading.resume();
  EXPECT_NEAR(fading.apply({{5, 0, 0}, {}}, 1e9).linear.x(), 0.5, 1e-12);
}

TEST(ForceLimits, RefusesLimitsThatMakeNoSense)
{
  const auto refuses = [](double Limits::*value, double is)
  {
    Limits limits;
    limits.*value = is;
    EXPECT_THROW(ForceLimits{limits}, petrous::core::InvalidParameter);
  };
  for (const double bad : {-1.0, kNan, kInfinity})
    for (const auto value :
         {&Limits::maxForce, &Limits::maxTorque, &Limits::forceSlew, &Limits::torqueSlew,
          &Limits::fadeIn, &Limits::fadeOut, &Limits::maxStep})
      refuses(value, bad);
  for (const auto value : {&Limits::forceSlew, &Limits::torqueSlew, &Limits::fadeIn,
                           &Limits::fadeOut, &Limits::maxStep})
    refuses(value, 0.0);
}
