#include <cmath>
#include <limits>
#include <string>

#include <gtest/gtest.h>

#include "petrous/Core/Error.h"
#include "petrous/Haptics/DeviceGuard.h"

using namespace petrous::haptics;
using Eigen::Vector3d;
using Limits = DeviceGuard::Limits;
using Judgement = DeviceGuard::Judgement;

namespace
{

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();

// A hand that moves along x at 100 mm/s, read at 1 kHz.
DeviceReading at(int tick)
{
  DeviceReading reading;
  reading.time = 0.001 * tick;
  reading.pose.position = Vector3d(0.1 * tick, 0, 0);
  reading.health = DeviceHealth::Good;
  return reading;
}

// Feeds the guard valid readings of ticks [from, to) and returns the last judgement.
Judgement feed(DeviceGuard& guard, int from, int to)
{
  Judgement last;
  for (int tick = from; tick < to; ++tick)
    last = guard.judge(at(tick), 0.001 * tick);
  return last;
}

// A guard that was good up to tick 99 receives this one reading at tick 100.
Judgement meet(const DeviceReading& reading)
{
  DeviceGuard guard;
  EXPECT_TRUE(feed(guard, 0, 100).usable);
  return guard.judge(reading, 0.1);
}

} // namespace

TEST(DeviceGuard, PassesSoundReadingsUnchanged)
{
  DeviceGuard guard;
  feed(guard, 0, 50);
  for (int tick = 50; tick < 200; ++tick)
  {
    const Judgement judgement = guard.judge(at(tick), 0.001 * tick);
    ASSERT_EQ(judgement.verdict, DeviceVerdict::Good);
    ASSERT_TRUE(judgement.usable);
    ASSERT_EQ(judgement.pose.position, at(tick).pose.position);
  }
}

TEST(DeviceGuard, GivesNoForceBeforeEnoughSoundReadings)
{
  DeviceGuard guard;
  for (int tick = 0; tick < 19; ++tick)
  {
    const Judgement judgement = guard.judge(at(tick), 0.001 * tick);
    ASSERT_EQ(judgement.verdict, DeviceVerdict::Settling);
    ASSERT_FALSE(judgement.usable);
    ASSERT_EQ(judgement.value, 19 - tick) << "readings still to come";
  }
  const Judgement judgement = guard.judge(at(19), 0.019);
  EXPECT_EQ(judgement.verdict, DeviceVerdict::Good);
  EXPECT_TRUE(judgement.usable);
}

TEST(DeviceGuard, NamesEachFaultAndHoldsTheLastGoodPose)
{
  const auto expect = [](const DeviceReading& reading, DeviceVerdict verdict)
  {
    const Judgement judgement = meet(reading);
    EXPECT_EQ(judgement.verdict, verdict) << toString(judgement);
    EXPECT_FALSE(judgement.usable);
    EXPECT_EQ(judgement.pose.position, at(99).pose.position);
    EXPECT_EQ(judgement.pose.rotation.coeffs(), Eigen::Quaterniond::Identity().coeffs());
  };
  DeviceReading reading = at(100);
  reading.pose.position.y() = kNan;
  expect(reading, DeviceVerdict::NotFinite);
  reading = at(100);
  reading.pose.rotation.x() = kInfinity;
  expect(reading, DeviceVerdict::NotFinite);
  reading = at(100);
  reading.time = kNan;
  expect(reading, DeviceVerdict::NotFinite);
  reading = at(100);
  reading.pose.rotation.coeffs() *= 1.002;
  expect(reading, DeviceVerdict::NotUnit);
  reading.pose.rotation.coeffs().setZero();
  expect(reading, DeviceVerdict::NotUnit);
  reading = at(100);
  reading.pose.position.z() = 1e200;
  expect(reading, DeviceVerdict::OutOfReach);
  reading = at(100);
  reading.time = 0.098;
  expect(reading, DeviceVerdict::TimeBackward);
  reading.time = 0.2;
  expect(reading, DeviceVerdict::TimeAhead);
  reading = at(100);
  reading.pose.position.x() += 50.0;
  expect(reading, DeviceVerdict::Jump);
  reading = at(100);
  reading.pose.rotation = rotationFrom({0.0, 0.1, 0.0});
  expect(reading, DeviceVerdict::Jump);
  for (const auto& [health, verdict] :
       {std::pair{DeviceHealth::NotReady, DeviceVerdict::NotReady},
        std::pair{DeviceHealth::Stale, DeviceVerdict::Stale},
        std::pair{DeviceHealth::Disconnected, DeviceVerdict::Disconnected},
        std::pair{DeviceHealth::Faulty, DeviceVerdict::Faulty}})
  {
    reading = at(100);
    reading.health = health;
    expect(reading, verdict);
  }
}

TEST(DeviceGuard, ATimeThatIsNoNumberOnTheServosSideIsAFaultToo)
{
  DeviceGuard guard;
  feed(guard, 0, 100);
  EXPECT_FALSE(guard.judge(at(100), kNan).usable);
}

TEST(DeviceGuard, TheOtherSignOfAQuaternionIsNoJump)
{
  DeviceReading reading = at(100);
  reading.pose.rotation.coeffs() *= -1.0;
  EXPECT_EQ(meet(reading).verdict, DeviceVerdict::Good);
}

TEST(DeviceGuard, TheFastestMotionPassesAndAFasterOneDoesNot)
{
  DeviceReading reading = at(100);
  reading.pose.position = at(99).pose.position + Vector3d(0, 4.99, 0); // 5 m/s is 5 mm per tick
  EXPECT_EQ(meet(reading).verdict, DeviceVerdict::Good);
  reading.pose.position = at(99).pose.position + Vector3d(0, 5.01, 0);
  EXPECT_EQ(meet(reading).verdict, DeviceVerdict::Jump);
}

TEST(DeviceGuard, NoiseBetweenReadingsThatAreAlmostTheSameMomentIsNoJump)
{
  DeviceReading reading = at(99);
  reading.time += 1e-6;
  reading.pose.position.x() += 0.05;
  EXPECT_EQ(meet(reading).verdict, DeviceVerdict::Good);
}

TEST(DeviceGuard, ARepeatedReadingIsHarmlessUntilItIsStale)
{
  DeviceGuard guard;
  feed(guard, 0, 100);
  for (int tick = 100; tick <= 148; ++tick)
  {
    const Judgement judgement = guard.judge(at(99), 0.001 * tick);
    ASSERT_EQ(judgement.verdict, DeviceVerdict::Repeated) << tick;
    ASSERT_TRUE(judgement.usable);
  }
  const Judgement judgement = guard.judge(at(99), 0.151);
  EXPECT_EQ(judgement.verdict, DeviceVerdict::Stale);
  EXPECT_FALSE(judgement.usable);
  EXPECT_NEAR(judgement.value, 0.052, 1e-12);
}

TEST(DeviceGuard, APoseThatMovesWhileItsTimeStandsIsNotUsed)
{
  DeviceReading reading = at(99);
  reading.pose.position.x() += 1.0;
  const Judgement judgement = meet(reading);
  EXPECT_EQ(judgement.verdict, DeviceVerdict::Repeated);
  EXPECT_EQ(judgement.pose.position, at(99).pose.position);
}

TEST(DeviceGuard, AfterAFaultTheForceReturnsWithTheTwentiethSoundReading)
{
  DeviceGuard guard;
  feed(guard, 0, 100);
  DeviceReading broken = at(100);
  broken.pose.position.x() = kNan;
  guard.judge(broken, 0.1);
  for (int tick = 101; tick < 120; ++tick)
  {
    const Judgement judgement = guard.judge(at(tick), 0.001 * tick);
    ASSERT_EQ(judgement.verdict, DeviceVerdict::Settling);
    ASSERT_EQ(judgement.pose.position, at(99).pose.position) << "the old pose is held";
  }
  const Judgement judgement = guard.judge(at(120), 0.12);
  EXPECT_TRUE(judgement.usable);
  EXPECT_EQ(judgement.pose.position, at(120).pose.position);
}

TEST(DeviceGuard, ADeviceThatJumpedAndStaysThereIsAcceptedThere)
{
  DeviceGuard guard;
  feed(guard, 0, 100);
  Judgement judgement;
  int jumps = 0;
  for (int tick = 100; tick < 121; ++tick)
  {
    DeviceReading reading = at(tick);
    reading.pose.position.y() += 50.0;
    judgement = guard.judge(reading, 0.001 * tick);
    jumps += judgement.verdict == DeviceVerdict::Jump;
  }
  EXPECT_EQ(jumps, 1);
  EXPECT_TRUE(judgement.usable);
  EXPECT_EQ(judgement.pose.position.y(), 50.0);
}

TEST(DeviceGuard, AFaultWhileItSettlesStartsTheCountAnew)
{
  DeviceGuard guard;
  feed(guard, 0, 15);
  DeviceReading gone = at(15);
  gone.health = DeviceHealth::Disconnected;
  guard.judge(gone, 0.015);
  EXPECT_FALSE(feed(guard, 16, 35).usable);
  EXPECT_TRUE(feed(guard, 35, 36).usable);
}

TEST(DeviceGuard, AClockThatRunsBackwardNeverBecomesUsable)
{
  Limits limits;
  limits.goodTicks = 2;
  DeviceGuard guard(limits);
  for (int n = 0; n < 40; ++n)
  {
    DeviceReading reading = at(100 - n);
    ASSERT_FALSE(guard.judge(reading, 0.1).usable) << n;
  }
}

TEST(DeviceGuard, ADeviceSlowerThanTheServoSettlesByItsReadings)
{
  DeviceGuard guard;
  int usableFrom = -1;
  for (int tick = 0; tick < 400 && usableFrom < 0; ++tick)
    if (guard.judge(at(tick / 10 * 10), 0.001 * tick).usable)
      usableFrom = tick;
  EXPECT_EQ(usableFrom, 190);
}

TEST(DeviceGuard, SaysInWordsWhatIsWrongWithItsNumber)
{
  DeviceReading reading = at(99);
  reading.time = 0.1;
  reading.pose.position.y() = 50.0;
  EXPECT_EQ(toString(meet(reading)),
            "The device's handle jumped by 50.0 mm from one reading to the "
            "next, faster than a hand moves.");
  reading = at(99);
  reading.time = 0.03;
  EXPECT_EQ(toString(meet(reading)), "The device has sent nothing new for 70 ms.");
  reading.time = 0.09;
  EXPECT_EQ(toString(meet(reading)), "The device's clock went back by 9.0 ms.");
  reading.time = 0.16;
  EXPECT_EQ(toString(meet(reading)), "The device's clock is 60 ms ahead of the computer's.");
  reading = at(100);
  reading.pose.rotation.coeffs() *= 2.0;
  EXPECT_EQ(toString(meet(reading)),
            "The device sent an invalid rotation: its quaternion's length is 2.");
  for (int verdict = 0; verdict <= static_cast<int>(DeviceVerdict::Faulty); ++verdict)
  {
    const std::string words = toString(static_cast<DeviceVerdict>(verdict));
    EXPECT_EQ(words.find("unknown"), std::string::npos) << verdict;
    EXPECT_EQ(words.back(), '.');
  }
}

TEST(DeviceGuard, RefusesLimitsThatMakeNoSense)
{
  const auto refuses = [](auto change)
  {
    Limits limits;
    change(limits);
    EXPECT_THROW(DeviceGuard{limits}, petrous::core::InvalidParameter);
  };
  refuses([](Limits& l) { l.speed = 0.0; });
  refuses([](Limits& l) { l.angularSpeed = kNan; });
  refuses([](Limits& l) { l.reach = -1.0; });
  refuses([](Limits& l) { l.staleAfter = kInfinity; });
  refuses([](Limits& l) { l.unitTolerance = 0.0; });
  refuses([](Limits& l) { l.goodTicks = 0; });
}
