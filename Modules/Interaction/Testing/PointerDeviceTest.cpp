#include "petrous/Interaction/PointerDevice.h"

#include <atomic>
#include <limits>
#include <thread>

#include <gtest/gtest.h>

#include "petrous/Core/Error.h"
#include "petrous/Haptics/DeviceGuard.h"
#include "petrous/Session/PoseMapping.h"

using namespace petrous;
using namespace petrous::interaction;
using Eigen::AngleAxisd;
using Eigen::Quaterniond;
using Eigen::Vector3d;
using haptics::DeviceHealth;
using haptics::DeviceReading;
using haptics::Pose;

namespace
{

const Vector3d kCenter(100.0, -1400.0, 30.0); // a scanner's table may be far from its origin
const Quaterniond kHeading(AngleAxisd(0.8, Vector3d(1.0, -2.0, 0.5).normalized()));

// The servo's side: device and mapping at 1 kHz, without tissue.
struct Hand
{
  explicit Hand(PointerDevice& held)
    : device(held)
  {
  }
  PointerDevice& device;
  session::PoseMapping mapping{kCenter};
  double now = 50.0;
  session::TickRecord record;
  double fastest = 0.0;  // mm/s
  double quickest = 0.0; // rad/s
  bool moved = false;

  Pose tool() const { return record.mapped.pose(); }

  void tick()
  {
    now += 0.001;
    const Pose before = record.input.device.pose();
    const DeviceReading reading = device.read(now);
    record.input = session::TickInput::of(now, reading, {});
    if (reading.health != DeviceHealth::Good)
      return;
    record.mapped = session::PoseValues::of(mapping.map(reading.pose, {}));
    if (moved)
    {
      const haptics::Motion motion = haptics::motionBetween(before, reading.pose);
      fastest = std::max(fastest, motion.linear.norm() / 0.001);
      quickest = std::max(quickest, motion.angular.norm() / 0.001);
    }
    moved = true;
  }
  void run(int ticks)
  {
    for (int n = 0; n < ticks; ++n)
      tick();
  }
};

void expectAt(const Pose& tool, const Pose& wanted)
{
  EXPECT_LT((tool.position - wanted.position).norm(), 1e-5);
  EXPECT_LT(haptics::rotationVector(tool.rotation * wanted.rotation.conjugate()).norm(), 1e-5);
}

} // namespace

TEST(PointerDevice, HasNoHandBeforeTheFirstWord)
{
  PointerDevice device(kCenter);
  EXPECT_EQ(device.read(1.0).health, DeviceHealth::NotReady);
  device.setButtons(PointerDevice::kDrill);
  EXPECT_EQ(device.read(1.001).health, DeviceHealth::NotReady);
  device.want({kCenter, kHeading});
  EXPECT_EQ(device.read(1.002).health, DeviceHealth::Good);
  EXPECT_FALSE(device.description().givesForce);
  EXPECT_TRUE(device.description().sensesRotation);
}

TEST(PointerDevice, BringsTheToolWhereItIsWanted)
{
  PointerDevice device(kCenter);
  Hand hand(device);
  const Pose first{kCenter + Vector3d(3.0, 4.0, -7.0), kHeading};
  device.want(first);
  hand.tick();
  expectAt(hand.tool(), first); // immediate: no pose before
  const Pose next{kCenter + Vector3d(-2.0, 9.0, 1.0), Quaterniond::Identity()};
  device.want(next);
  hand.run(400);
  expectAt(hand.tool(), next);
}

TEST(PointerDevice, RestsWithoutEverBeingStale)
{
  PointerDevice device(kCenter);
  haptics::DeviceGuard guard;
  device.want({kCenter + Vector3d(5.0, 0.0, 0.0), kHeading});
  haptics::DeviceGuard::Judgement judgement;
  for (int n = 0; n < 5000; ++n)
  {
    const double now = 7.0 + 0.001 * n;
    if (n % 300 == 0)
      device.see({}); // a frame
    judgement = guard.judge(device.read(now), now);
    if (n >= 20)
    {
      ASSERT_TRUE(judgement.usable) << n;
    }
  }
  EXPECT_EQ(judgement.verdict, haptics::DeviceVerdict::Good);
}

TEST(PointerDevice, MakesALeapOfThePointerAMotionOfAHand)
{
  PointerDevice::Limits limits;
  limits.speed = 300.0;
  limits.angularSpeed = 8.0;
  PointerDevice device(kCenter, limits);
  Hand hand(device);
  haptics::DeviceGuard guard;
  device.want({kCenter, Quaterniond::Identity()});
  hand.run(30);
  const Pose far{kCenter + Vector3d(0.0, 90.0, 0.0),
                 Quaterniond(AngleAxisd(2.0, Vector3d::UnitX()))};
  device.want(far);
  hand.run(250);
  // 75 mm of 90, and 2 rad at 8 rad/s except for settling.
  EXPECT_NEAR((hand.tool().position - kCenter).norm(), 75.0, 1e-6);
  EXPECT_NEAR(hand.fastest, 300.0, 1e-6);
  EXPECT_LE(hand.quickest, 8.0 + 1e-6);
  hand.run(400);
  expectAt(hand.tool(), far);
  EXPECT_LE(hand.fastest, 300.0 + 1e-6);
}

TEST(PointerDevice, GlidesBetweenTheWordsOfAWindow)
{
  // 60 updates per second of 2 mm each: 120 mm/s. Applied as steps they would give 2000 mm/s.
  PointerDevice device(kCenter);
  Hand hand(device);
  for (int n = 0; n < 1000; ++n)
  {
    if (n % 16 == 0)
      device.want({kCenter + Vector3d(0.125 * n, 0.0, 0.0), kHeading});
    hand.tick();
  }
  EXPECT_LT(hand.fastest, 300.0);
  EXPECT_NEAR(hand.tool().position.x() - kCenter.x(), 124.0, 2.5);
}

TEST(PointerDevice, ComesBackUnderThePointerAfterTheToolWasTakenUpAnew)
{
  PointerDevice device(kCenter);
  Hand hand(device);
  const Pose wanted{kCenter + Vector3d(3.0, 4.0, -7.0), kHeading};
  device.want(wanted);
  hand.run(30);
  EXPECT_FALSE(device.see(hand.record));

  // Tissue was restored: the servo holds the tool 4 mm away, rotated.
  const Pose held{wanted.position + Vector3d(0.0, 0.0, 4.0),
                  Quaterniond(AngleAxisd(0.3, Vector3d::UnitY())) * kHeading};
  hand.mapping.hold(hand.record.input.device.pose(), {}, held);
  hand.tick();
  expectAt(hand.tool(), held);
  EXPECT_TRUE(device.see(hand.record));
  EXPECT_FALSE(device.see(hand.record));
  hand.run(400);
  expectAt(hand.tool(), wanted);
  EXPECT_FALSE(device.see(hand.record)); // detected at once, even while moving
}

TEST(PointerDevice, LearnsNothingFromRecordsThatDoNotTell)
{
  PointerDevice device(kCenter);
  Hand hand(device);
  device.want({kCenter, kHeading});
  hand.run(30);
  hand.record.mapped.position[0] += 5.0;
  for (const auto fault : {session::ServoFault::Device, session::ServoFault::Clock,
                           session::ServoFault::Parameters, session::ServoFault::Retreated})
  {
    session::TickRecord bad = hand.record;
    bad.fault = static_cast<std::uint8_t>(fault);
    EXPECT_FALSE(device.see(bad));
  }
  session::TickRecord clutched = hand.record;
  clutched.input.parameters.clutchButtons = PointerDevice::kFreeze;
  clutched.input.buttons = PointerDevice::kFreeze;
  EXPECT_FALSE(device.see(clutched));
  session::TickRecord scaled = hand.record;
  scaled.input.parameters.scale = 0.5;
  EXPECT_FALSE(device.see(scaled));
  EXPECT_TRUE(device.see(hand.record));
}

TEST(PointerDevice, IsStaleWhileTheWindowHangs)
{
  PointerDevice device(kCenter);
  device.want({kCenter, kHeading});
  device.setButtons(PointerDevice::kDrill | PointerDevice::kFreeze);
  double now = 3.0;
  EXPECT_EQ(device.read(now).buttons, PointerDevice::kDrill | PointerDevice::kFreeze);
  EXPECT_EQ(device.read(now += 0.45).buttons, PointerDevice::kDrill | PointerDevice::kFreeze);
  EXPECT_EQ(device.read(now).health, DeviceHealth::Good);
  EXPECT_EQ(device.read(now += 0.1).health, DeviceHealth::Stale);
  EXPECT_EQ(device.read(now).buttons, PointerDevice::kDrill | PointerDevice::kFreeze);
  device.see({}); // a frame
  EXPECT_EQ(device.read(now += 0.001).health, DeviceHealth::Good);
  EXPECT_EQ(device.read(now).buttons, PointerDevice::kDrill | PointerDevice::kFreeze);
}

// A tap leaps and presses at once: nothing must be drilled between the old place and the new one.
TEST(PointerDevice, ADrillPressedOnTheWayIsOnWhereItArrives)
{
  PointerDevice device(kCenter);
  Hand hand(device);
  device.want({kCenter, kHeading});
  hand.run(30);
  const Pose there{kCenter + Vector3d(40.0, 0.0, 0.0), kHeading};
  device.want(there);
  device.setButtons(PointerDevice::kDrill | PointerDevice::kFreeze);
  for (int n = 0; n < 300; ++n)
  {
    hand.tick();
    EXPECT_TRUE(hand.record.input.buttons & PointerDevice::kFreeze);
    const double way = (hand.tool().position - there.position).norm();
    EXPECT_EQ((hand.record.input.buttons & PointerDevice::kDrill) != 0, way <= 0.5) << way;
  }
  expectAt(hand.tool(), there);
  device.want({kCenter, kHeading}); // a drag: it drills all the way
  for (int n = 0; n < 300; ++n)
  {
    hand.tick();
    EXPECT_TRUE(hand.record.input.buttons & PointerDevice::kDrill);
  }
}

TEST(PointerDevice, ADrillPressedUnderAMovingPointerIsOnOnceItIsFollowed)
{
  PointerDevice device(kCenter);
  Hand hand(device);
  device.want({kCenter, kHeading});
  hand.run(30);
  device.setButtons(PointerDevice::kDrill);
  device.want({kCenter + Vector3d(20.0, 0.0, 0.0), kHeading});
  int off = 0;
  for (int n = 0; n < 400; ++n) // 100 mm/s from a leap of 20 mm: 1 mm ahead of the tool
  {
    device.want({kCenter + Vector3d(20.0 + 0.1 * n, 0.0, 0.0), kHeading});
    hand.tick();
    off += (hand.record.input.buttons & PointerDevice::kDrill) == 0;
  }
  EXPECT_GT(off, 40); // 20 mm at 500 mm/s
  EXPECT_LT(off, 100);
}

TEST(PointerDevice, StaysInPlaceOverASleepAndABackwardClock)
{
  PointerDevice device(kCenter);
  device.want({kCenter, kHeading});
  device.read(10.0);
  device.want({kCenter + Vector3d(500.0, 0.0, 0.0), kHeading});
  EXPECT_LE(device.read(3600.0).pose.position.norm(), 25.0 + 1e-9); // at most 0.05 s of it count
  const Pose there = device.read(3600.001).pose;
  EXPECT_EQ(device.read(3000.0).pose.position, there.position);
  EXPECT_EQ(device.read(std::numeric_limits<double>::quiet_NaN()).pose.position, there.position);
  EXPECT_TRUE(device.read(3000.001).pose.finite());
}

TEST(PointerDevice, RefusesWhatIsNoPoseAndNoLimit)
{
  PointerDevice device;
  Pose pose;
  pose.position.x() = std::numeric_limits<double>::infinity();
  EXPECT_THROW(device.want(pose), core::InvalidParameter);
  EXPECT_EQ(device.read(1.0).health, DeviceHealth::NotReady);
  const auto refused = [](auto PointerDevice::Limits::*value, double bad)
  {
    PointerDevice::Limits limits;
    limits.*value = bad;
    EXPECT_THROW(PointerDevice(kCenter, limits), core::InvalidParameter);
  };
  refused(&PointerDevice::Limits::speed, 0.0);
  refused(&PointerDevice::Limits::speed, 1e5);
  refused(&PointerDevice::Limits::angularSpeed, std::numeric_limits<double>::quiet_NaN());
  refused(&PointerDevice::Limits::settle, 0.0);
  refused(&PointerDevice::Limits::silence, -1.0);
  EXPECT_THROW(PointerDevice(Vector3d::Constant(std::numeric_limits<double>::quiet_NaN())),
               core::InvalidParameter);
}

TEST(PointerDevice, TakesWordsFromAnotherThread)
{
  PointerDevice device(kCenter);
  device.want({kCenter, Quaterniond::Identity()});
  std::atomic<bool> done{false};
  std::thread window(
      [&]
      {
        for (int n = 1; n <= 20000; ++n)
        {
          // Updates whose parts must stay consistent: y = 2 x.
          device.want({kCenter + Vector3d(0.001 * n, 0.002 * n, 0.0), Quaterniond::Identity()});
          device.see({});
        }
        done = true;
      });
  double now = 1.0;
  double worst = 0.0;
  while (!done)
  {
    const Vector3d p = device.read(now += 0.001).pose.position;
    worst = std::max(worst, std::abs(p.y() - 2.0 * p.x()));
  }
  window.join();
  EXPECT_LT(worst, 1e-6);
  for (int n = 0; n < 1000; ++n)
    device.read(now += 0.001);
  EXPECT_NEAR(device.read(now).pose.position.y(), 40.0, 1e-5);
}
