#include "petrous/Devices/DeviceCheck.h"

#include <algorithm>
#include <cmath>
#include <deque>
#include <limits>

#include <gtest/gtest.h>

#include "SampledSpring.h"
#include "SimulatedDevice.h"
#include "petrous/Core/Error.h"

using namespace petrous;
using namespace petrous::devices;
using haptics::DeviceReading;
using haptics::Pose;
using haptics::SimulatedDevice;
using haptics::Wrench;
using Stage = DeviceCheck::Stage;

namespace
{

constexpr double kTick = 0.001; // s

// What lies between the program and the motors.
struct Transmission
{
  std::size_t delay = 0; // ticks until a wrench acts
  double quantum = 0.0;  // mm, of the encoders
  int dropEvery = 0;     // ticks: every so many is not read
  bool crossed = false;  // x and y of the force are exchanged
  double sign = 1.0;     // of the force
  double cutAbove = 1e9; // N: the driver reports a fault for 1 s
  int readEvery = 1;     // ticks
  int faultAt = -1;      // tick: a fault of 20 ms
};

double largestForce = 0.0; // N, in the last check

Pose still(double)
{
  return {};
}

DeviceCheck::Options quick()
{
  DeviceCheck::Options options;
  options.workspaceTime = 0.5;
  return options;
}

// Runs the check on a simulated clock to its end; the largest force in each stage.
DeviceCheck::Result examined(SimulatedDevice& device, const Transmission& way = {},
                             const DeviceCheck::Options& options = quick())
{
  DeviceCheck check(device.description(), options);
  std::deque<Wrench> underway(way.delay);
  DeviceReading reading;
  int cutUntil = 0; // tick
  largestForce = 0.0;
  for (int n = 0; n < 400000 && check.stage() != Stage::Done; ++n)
  {
    DeviceReading fresh = device.read(kTick * n);
    if (way.quantum > 0.0)
      for (int i = 0; i < 3; ++i)
        fresh.pose.position[i] = way.quantum * std::round(fresh.pose.position[i] / way.quantum);
    if (n % way.readEvery != 0)
      fresh = reading;
    if (n == 0 || way.dropEvery == 0 || n % way.dropEvery != 0)
      reading = fresh;
    reading.health = n < cutUntil ? haptics::DeviceHealth::Faulty : fresh.health;
    underway.push_back(check.tick(reading, kTick * n, 0.002));
    Wrench wrench = underway.front();
    underway.pop_front();
    largestForce = std::max(largestForce, wrench.linear.norm());
    if (n >= cutUntil && wrench.linear.norm() > way.cutAbove)
      cutUntil = n + 1000;
    if (n == way.faultAt)
      cutUntil = n + 20;
    if (n < cutUntil)
      wrench = {};
    if (way.crossed)
      std::swap(wrench.linear[0], wrench.linear[1]);
    wrench.linear *= way.sign;
    device.send(wrench);
  }
  EXPECT_EQ(check.stage(), Stage::Done);
  EXPECT_EQ(check.progress(), 1.0);
  return check.result();
}

double stabilityLimit(const SimulatedDevice::Hand& hand, int delay)
{
  return haptics::sampledSpringLimit(hand.mass, hand.damping, hand.stiffness, delay);
}

} // namespace

TEST(DeviceCheck, FindsTheStabilityLimitOfASampledSpringWithinItsMargin)
{
  struct
  {
    double mass, damping;
    int delay;
  } const cases[] = {{0.15, 0.003, 0}, {0.15, 0.003, 2}, {0.1, 0.006, 4}, {0.3, 0.002, 1}};
  for (const auto& set : cases)
  {
    SimulatedDevice::Hand hand;
    hand.mass = set.mass;
    hand.damping = set.damping;
    SimulatedDevice device(still, hand, {});
    Transmission way;
    way.delay = static_cast<std::size_t>(set.delay);
    const double limit = stabilityLimit(hand, set.delay);
    ASSERT_GT(limit, 0.2);
    ASSERT_LT(limit, 9.0) << "below the ramp's end";
    const auto result = examined(device, way);
    for (const auto& axis : result.axes)
    {
      EXPECT_GT(axis.stable, 0.6 * limit) << set.delay;
      EXPECT_LT(axis.stable, limit) << set.delay;
      EXPECT_GT(axis.limit, axis.stable);
      // An undamped mass on that spring.
      const double hertz = std::sqrt(1000.0 * (axis.limit + hand.stiffness) / hand.mass) / 6.2832;
      EXPECT_NEAR(axis.hertz, hertz, 0.25 * hertz);
    }
    EXPECT_NEAR(result.proposed, 0.5 * result.axes[0].stable, 0.1 * limit);
    EXPECT_LT(device.velocity().linear.norm(), 100.0) << "mm/s: the cycle was left at once";
  }
}

// At the tap's speed v, Coulomb friction f damps no more than a damper of 4 f / (pi v), the least v
// being 40 mm/s [describing function]; the limit with that added is an upper bound.
TEST(DeviceCheck, FrictionHidesNoLimitCycle)
{
  for (const double friction : {0.1, 0.3})
    for (const int delay : {4, 8})
    {
      SimulatedDevice::Hand hand;
      hand.friction = friction;
      SimulatedDevice device(still, hand, {});
      Transmission way;
      way.delay = static_cast<std::size_t>(delay);
      const double most = haptics::sampledSpringLimit(
          hand.mass, hand.damping + 4.0 * friction / (3.1416 * 40.0), hand.stiffness, delay);
      const auto result = examined(device, way);
      for (const auto& axis : result.axes)
      {
        EXPECT_GT(axis.stable, 0.2);
        EXPECT_LT(axis.stable, most) << friction << " N, " << delay << " ms";
      }
    }
}

// 6 Hz change their sign once or twice in the time that is judged.
TEST(DeviceCheck, TakesAWideSwingForALimitCycle)
{
  SimulatedDevice::Hand hand;
  hand.damping = 0.1;
  const auto swinging = [](double t)
  {
    const double since = std::max(0.0, t - 5.5); // in the ramps
    return Pose{{5.0 * std::sin(37.7 * since), 0.0, 0.0}, Eigen::Quaterniond::Identity()};
  };
  SimulatedDevice device(swinging, hand, {});
  const auto result = examined(device);
  EXPECT_EQ(result.problem, "");
  EXPECT_GT(result.axes[0].limit, 3.0 / 5.0) << "N/mm: the cap at that amplitude";
  EXPECT_LT(result.axes[0].limit, 1.5);
  EXPECT_EQ(result.axes[1].limit, 0.0);
}

TEST(DeviceCheck, EndsAtTheTopWhereNothingOscillates)
{
  SimulatedDevice::Hand hand;
  hand.damping = 0.02;
  SimulatedDevice device(still, hand, {});
  DeviceCheck::Options options = quick();
  options.maxStiffness = 5.0;
  const auto result = examined(device, {}, options);
  for (const auto& axis : result.axes)
  {
    EXPECT_EQ(axis.stable, 5.0);
    EXPECT_EQ(axis.limit, 0.0);
  }
  EXPECT_EQ(result.proposed, 2.5);
}

TEST(DeviceCheck, ToleratesEncodersAndReadingsThatAreDropped)
{
  SimulatedDevice::Hand hand;
  hand.damping = 0.006;
  SimulatedDevice device(still, hand, {});
  Transmission way;
  way.quantum = 0.01;
  way.dropEvery = 50;
  const auto result = examined(device, way);
  const double limit = stabilityLimit(hand, 0);
  for (const auto& axis : result.axes)
    EXPECT_GT(axis.stable, 0.25 * std::min(limit, 10.0));
}

TEST(DeviceCheck, StepsShowDirectionAndLatencyOfTheForce)
{
  SimulatedDevice device(still);
  const auto straight = examined(device);
  for (int i = 0; i < 3; ++i)
  {
    const auto& axis = straight.axes[static_cast<std::size_t>(i)];
    EXPECT_TRUE(axis.follows);
    EXPECT_GT(axis.moved[i], 0.9 * axis.moved.norm());
    EXPECT_GT(axis.latency, 0.0);
    EXPECT_LT(axis.latency, 0.03) << "0.5 N on 0.15 kg for 0.05 mm, with the rise: 12 ms";
  }
  SimulatedDevice other(still);
  Transmission late;
  late.delay = 20;
  EXPECT_NEAR(examined(other, late).axes[0].latency, straight.axes[0].latency + 0.02, 1e-9);

  SimulatedDevice wrong(still);
  Transmission way;
  way.crossed = true;
  const auto crossed = examined(wrong, way);
  EXPECT_FALSE(crossed.axes[0].follows);
  EXPECT_FALSE(crossed.axes[1].follows);
  EXPECT_GT(crossed.axes[0].moved.y(), 0.05) << "a force to the right moved it up";
  EXPECT_TRUE(crossed.axes[2].follows);
  for (const int axis : {0, 1})
  {
    EXPECT_EQ(crossed.axes[static_cast<std::size_t>(axis)].stable, 0.0) << "no spring was tried";
    EXPECT_EQ(crossed.axes[static_cast<std::size_t>(axis)].limit, 0.0);
  }
  EXPECT_GT(crossed.axes[2].stable, 0.0);
  EXPECT_EQ(crossed.proposed, 0.0);
}

TEST(DeviceCheck, EndsAtOnceWhereTheHandleMovesAgainstTheForce)
{
  for (const double stiffness : {0.3, 1.0}) // N/mm, of the hand
  {
    SimulatedDevice::Hand hand;
    hand.stiffness = stiffness;
    SimulatedDevice device(still, hand, {});
    Transmission way;
    way.sign = -1.0;
    const auto result = examined(device, way);
    EXPECT_NE(result.problem.find("against the force along x"), std::string::npos)
        << result.problem;
    EXPECT_LE(largestForce, 0.5);
    EXPECT_LT(device.pose().position.norm(), 5.0) << "mm";
    EXPECT_EQ(result.proposed, 0.0);
  }
}

TEST(DeviceCheck, EndsAStepThatIsTooFast)
{
  SimulatedDevice::Hand hand;
  hand.mass = 0.02;
  hand.stiffness = 0.0;
  hand.damping = 0.0;
  SimulatedDevice device(still, hand, {});
  DeviceCheck check(device.description(), quick());
  double fastest = 0.0;
  for (int n = 0; n < 3000; ++n)
  {
    device.send(check.tick(device.read(kTick * n), kTick * n));
    fastest = std::max(fastest, device.velocity().linear.norm());
  }
  EXPECT_GT(fastest, 500.0);
  EXPECT_LT(fastest, 900.0) << "mm/s, of 3700 after the whole step";
}

TEST(DeviceCheck, PushesOnlyAHandleThatRests)
{
  SimulatedDevice::Hand stiff;
  stiff.stiffness = 30.0;
  stiff.damping = 0.05;
  // To the middle with 60 mm/s, until 2 s after the workspace stage.
  const auto coming = [](double t) {
    return Pose{{60.0 * std::max(0.0, 2.5 - t), 0.0, 0.0}, Eigen::Quaterniond::Identity()};
  };
  SimulatedDevice device(coming, stiff, {});
  DeviceCheck check(device.description(), quick());
  double pushedAt = 0.0;
  for (int n = 0; n < 6000 && pushedAt == 0.0; ++n)
  {
    const Wrench wrench = check.tick(device.read(kTick * n), kTick * n);
    device.send(wrench);
    if (wrench.linear.norm() > 0.0)
      pushedAt = kTick * n;
  }
  EXPECT_GT(pushedAt, 3.45);
  EXPECT_LT(pushedAt, 3.6);

  const auto restless = [](double t) {
    return Pose{{3.0 * std::sin(6.0 * t), 0.0, 0.0}, Eigen::Quaterniond::Identity()};
  };
  SimulatedDevice other(restless, stiff, {});
  EXPECT_NE(examined(other).problem.find("does not rest"), std::string::npos);
  EXPECT_EQ(largestForce, 0.0);
}

TEST(DeviceCheck, TakesAFaultWithinTheRampAsItsLimit)
{
  SimulatedDevice::Hand hand;
  hand.damping = 0.02;
  SimulatedDevice device(still, hand, {});
  Transmission way;
  way.cutAbove = 0.6; // N, which only the spring reaches
  const auto result = examined(device, way);
  EXPECT_EQ(result.problem, "");
  EXPECT_EQ(result.faults, 3);
  for (const auto& axis : result.axes)
  {
    EXPECT_TRUE(axis.faulted);
    EXPECT_GT(axis.limit, 0.0);
    EXPECT_LT(axis.stable, axis.limit);
    EXPECT_LT(axis.limit, 10.0);
  }
  EXPECT_LT(result.proposed, 0.5 * result.axes[0].limit);
}

TEST(DeviceCheck, RepeatsAStepInWhichTheDeviceReportedAFault)
{
  SimulatedDevice device(still);
  const auto straight = examined(device);
  SimulatedDevice other(still);
  Transmission way;
  way.faultAt = 1560; // 60 ms into the first step
  const auto result = examined(other, way);
  EXPECT_EQ(result.faults, 1);
  EXPECT_TRUE(result.axes[0].follows);
  EXPECT_NEAR(result.axes[0].latency, straight.axes[0].latency, 0.002);
  EXPECT_FALSE(result.axes[0].faulted);
}

// At 100 Hz a hand that sways with 60 mm/s goes 0.6 mm from one tick to the next, every tenth tick.
TEST(DeviceCheck, TakesTheSpeedByTheReadingsTimes)
{
  SimulatedDevice::Hand hand;
  hand.damping = 0.02;
  const auto swaying = [](double t)
  {
    const double since = std::max(0.0, t - 5.0); // in the ramps
    return Pose{{5.0 * std::sin(12.0 * since), 0.0, 0.0}, Eigen::Quaterniond::Identity()};
  };
  SimulatedDevice device(swaying, hand, {});
  Transmission way;
  way.readEvery = 10;
  const auto result = examined(device, way);
  EXPECT_EQ(result.problem, "");
  for (const auto& axis : result.axes)
    EXPECT_FALSE(axis.limit > 0.0 && axis.hertz == 0.0) << "taken as faster than 500 mm/s";
}

TEST(DeviceCheck, MeasuresWorkspaceRateAndTrips)
{
  SimulatedDevice::Hand stiff;
  stiff.stiffness = 30.0;
  stiff.damping = 0.05;
  const auto ellipse = [](double t)
  {
    return Pose{{40.0 * std::cos(12.6 * t), 30.0 * std::sin(12.6 * t), 10.0},
                haptics::rotationFrom({0.0, 0.0, 0.4 * std::sin(12.6 * t)})};
  };
  haptics::DeviceDescription description = SimulatedDevice::usualDescription();
  description.givesForce = false;
  SimulatedDevice device(ellipse, stiff, {}, description);
  device.press(5U, 0.75);
  Transmission way;
  way.dropEvery = 2;
  DeviceCheck::Options options = quick();
  options.workspaceTime = 1.0;
  const auto result = examined(device, way, options);
  EXPECT_NEAR(result.lowest.x(), -40.0, 2.0);
  EXPECT_NEAR(result.highest.y(), 30.0, 2.0);
  EXPECT_NEAR(result.highest.z(), 10.0, 0.1);
  EXPECT_NEAR(result.turned, 0.4, 0.1);
  EXPECT_EQ(result.buttons, 5U);
  EXPECT_EQ(result.pedal, 0.75);
  EXPECT_NEAR(result.rate, 500.0, 2.0);
  EXPECT_NEAR(result.worstGap, 0.002, 1e-9);
  ASSERT_FALSE(result.roundTrips.empty());
  EXPECT_EQ(result.proposed, 0.0) << "it gives no force";
}

TEST(DeviceCheck, StopsAtOnceWhereTheDeviceIsLostOrNeverThere)
{
  SimulatedDevice::Faults faults;
  faults.unplugAt = 3.0;
  SimulatedDevice lost(still, {}, faults);
  EXPECT_EQ(examined(lost).problem, "the device was lost");
  faults = {};
  faults.unplugAt = 0.0;
  SimulatedDevice absent(still, {}, faults);
  EXPECT_EQ(examined(absent).problem, "no good reading came from the device");
  faults = {};
  faults.nanFrom = 4.0;
  SimulatedDevice broken(still, {}, faults);
  EXPECT_EQ(examined(broken).problem, "the device was lost");
  EXPECT_EQ(broken.sent().linear.norm(), 0.0);
}

TEST(DeviceCheck, RefusesOptionsThatMakeNoSense)
{
  for (const double value : {-1.0, 0.0, 30.0, std::numeric_limits<double>::quiet_NaN()})
  {
    DeviceCheck::Options options;
    options.maxStiffness = value;
    EXPECT_THROW(DeviceCheck({}, options), core::InvalidParameter) << value;
  }
}
