#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "petrous/Core/Error.h"
#include "petrous/Devices/RateControl.h"

using namespace petrous;
using namespace petrous::devices;

namespace
{

RateControl::Parameters plain()
{
  RateControl::Parameters parameters;
  parameters.speed = 40.0;
  parameters.turnRate = 2.0;
  parameters.deadZone = 0.0;
  parameters.exponent = 1.0;
  return parameters;
}

SpaceMouseState deflection(int axis, int counts)
{
  SpaceMouseState state;
  state.axes[static_cast<std::size_t>(axis)] = static_cast<std::int16_t>(counts);
  return state;
}

// `seconds` of ticks of 1 ms with a report every `period` ms; returns the end time.
double hold(RateControl& rate, const SpaceMouseState& state, double start, int milliseconds,
            int period = 10)
{
  double now = start;
  for (int i = 0; i < milliseconds; ++i)
  {
    now = start + 0.001 * i;
    if (i % period == 0)
      rate.setDeflection(state, now);
    rate.advance(now);
  }
  return now;
}

} // namespace

TEST(RateControl, MovesBySpeedTimesTimeLessHalfTheFirstRamp)
{
  RateControl rate(plain());
  rate.advance(0.999);
  const double now = hold(rate, deflection(0, 175), 1.0, 1001);
  EXPECT_DOUBLE_EQ(now, 2.0);
  // Half deflection: 20 mm/s for 1 s; the first ramp takes at most 20 ms, half of which is lost.
  EXPECT_NEAR(rate.rate().linear.x(), 20.0, 1e-9);
  const double x = rate.advance(now).position.x();
  EXPECT_NEAR(x, 20.0 * (1.0 - 0.01), 0.11);
  EXPECT_LE(x, 20.0);
  EXPECT_EQ(rate.advance(now).position.y(), 0.0);
}

TEST(RateControl, TurnsAboutTheAxisOfTheFrameByRateTimesTime)
{
  RateControl rate(plain());
  rate.advance(0.999);
  // The cap's z points down: a right-handed rotation about it is clockwise seen from above.
  hold(rate, deflection(5, 350), 1.0, 501);
  const Eigen::Vector3d turned = haptics::rotationVector(rate.advance(1.5).rotation);
  EXPECT_NEAR(turned.y(), -2.0 * 0.5, 0.03);
  EXPECT_NEAR(turned.x(), 0.0, 1e-12);
  EXPECT_NEAR(turned.z(), 0.0, 1e-12);
  EXPECT_NEAR(rate.advance(1.5).rotation.norm(), 1.0, 1e-12);
}

TEST(RateControl, StandsStillInTheDeadZoneAndReachesFullSpeedAtTheStop)
{
  RateControl::Parameters parameters = plain();
  parameters.deadZone = 0.1;
  parameters.exponent = 2.0;
  RateControl rate(parameters);
  rate.advance(0.0);
  hold(rate, deflection(0, 35), 0.001, 100);
  EXPECT_EQ(rate.rate().linear.x(), 0.0);
  EXPECT_EQ(rate.advance(0.101).position.x(), 0.0);
  hold(rate, deflection(0, 350), 0.2, 100);
  EXPECT_NEAR(rate.rate().linear.x(), 40.0, 1e-9);
  // ((0.55 - 0.1) / 0.9)^2 = 1/4
  SpaceMouseState half = deflection(0, 0);
  half.axes[0] = 192; // 0.5486
  hold(rate, half, 0.4, 100);
  const double share = (192.0 / 350.0 - 0.1) / 0.9;
  EXPECT_NEAR(rate.rate().linear.x(), 40.0 * share * share, 1e-9);
}

TEST(RateControl, IsNoFasterOnADiagonal)
{
  RateControl rate(plain());
  SpaceMouseState state;
  state.axes = {350, 350, 350, 0, 0, 0};
  hold(rate, state, 0.0, 100);
  EXPECT_NEAR(rate.rate().linear.norm(), 40.0, 1e-9);
}

TEST(RateControl, HasNoStepInSpeedBetweenReports)
{
  RateControl rate(plain());
  rate.advance(-0.001);
  double last = 0.0;
  double greatest = 0.0;
  // A cap moved to its stop in 160 ms, reported every 16 ms in steps of 4 mm/s.
  for (int i = 0; i < 200; ++i)
  {
    const double now = 0.001 * i;
    if (i % 16 == 0)
      rate.setDeflection(deflection(0, std::min(350, 35 * (i / 16))), now);
    rate.advance(now);
    const double speed = rate.rate().linear.x();
    EXPECT_GE(speed, last - 1e-12);
    greatest = std::max(greatest, speed - last);
    last = speed;
  }
  EXPECT_NEAR(last, 40.0, 1e-9);
  // 4 mm/s spread over 16 ms are 0.25 per tick; without the ramp it would be 4 at once.
  EXPECT_LT(greatest, 0.35);
}

TEST(RateControl, IsAsSmoothWhenTranslationAndRotationComeAsAPair)
{
  RateControl rate(plain());
  rate.advance(-0.001);
  SpaceMouseState state;
  double last = 0.0;
  for (int i = 0; i < 300; ++i)
  {
    const double now = 0.001 * i;
    if (i % 16 == 0)
      state.axes[0] = static_cast<std::int16_t>(std::min(350, 35 * (i / 16)));
    if (i % 16 == 0 || i % 16 == 1)
      rate.setDeflection(state, now);
    rate.advance(now);
    EXPECT_LT(std::abs(rate.rate().linear.x() - last), 0.35) << i;
    last = rate.rate().linear.x();
  }
}

TEST(RateControl, StopsWithoutReportsWhileDeflectedAndGoesOnWithTheNext)
{
  RateControl rate(plain());
  double now = hold(rate, deflection(0, 350), 0.0, 200);
  EXPECT_FALSE(rate.silent(now));
  for (int i = 0; i < 200; ++i)
    rate.advance(now += 0.001);
  EXPECT_TRUE(rate.silent(now));
  EXPECT_EQ(rate.rate().linear.x(), 0.0);
  const double x = rate.advance(now).position.x();
  rate.advance(now += 0.05);
  EXPECT_EQ(rate.advance(now).position.x(), x);
  now = hold(rate, deflection(0, 350), now, 100);
  EXPECT_FALSE(rate.silent(now));
  EXPECT_NEAR(rate.rate().linear.x(), 40.0, 1e-9);
}

TEST(RateControl, IsNotSilentAtRest)
{
  RateControl rate(plain());
  rate.setDeflection(SpaceMouseState{}, 0.0);
  rate.advance(10.0);
  EXPECT_FALSE(rate.silent(10.0));
}

TEST(RateControl, StaysWithinItsReachAndComesBackAtOnce)
{
  RateControl::Parameters parameters = plain();
  parameters.reach = 5.0;
  RateControl rate(parameters);
  hold(rate, deflection(0, 350), 0.0, 1000);
  EXPECT_EQ(rate.advance(1.0).position.x(), 5.0);
  hold(rate, deflection(0, -350), 1.0, 100);
  EXPECT_LT(rate.advance(1.1).position.x(), 3.0);
}

TEST(RateControl, DoesNotLeapWhenTheServoWasAwayOrItsClockWentBack)
{
  RateControl rate(plain());
  hold(rate, deflection(0, 350), 0.0, 50);
  const double x = rate.advance(0.049).position.x();
  rate.setDeflection(deflection(0, 350), 100.0);
  EXPECT_LE(rate.advance(100.0).position.x() - x, 40.0 * 0.1 + 1e-9);
  const double there = rate.advance(100.0).position.x();
  EXPECT_EQ(rate.advance(99.0).position.x(), there);
}

TEST(RateControl, RefusesParametersOutOfTheirDomain)
{
  const auto refuses = [](auto change)
  {
    RateControl::Parameters parameters;
    change(parameters);
    EXPECT_THROW(RateControl{parameters}, core::InvalidParameter);
  };
  using P = RateControl::Parameters;
  refuses([](P& p) { p.speed = -1.0; });
  refuses([](P& p) { p.turnRate = std::nan(""); });
  refuses([](P& p) { p.deadZone = 1.0; });
  refuses([](P& p) { p.exponent = 0.5; });
  refuses([](P& p) { p.timeout = 0.0; });
  refuses([](P& p) { p.reach = std::numeric_limits<double>::infinity(); });
}
