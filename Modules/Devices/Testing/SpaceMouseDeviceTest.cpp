#include <gtest/gtest.h>

#include "Eventually.h"
#include "StandIn.h"
#include "petrous/Core/Error.h"
#include "petrous/Devices/SpaceMouseDevice.h"

using namespace petrous;
using namespace petrous::devices;
using namespace petrous::devices::testing;
using haptics::DeviceHealth;
using haptics::DeviceReading;

namespace
{

constexpr char kPlug[] = "plug cap 256f c635 1 8 SpaceMouse Compact\n";
constexpr char kFullRight[] = "report cap 01 5e 01 00 00 00 00\n"; // +350 along x
constexpr char kReleased[] = "report cap 01 00 00 00 00 00 00\n";

SpaceMouseDevice::Options quick()
{
  SpaceMouseDevice::Options options;
  options.lookEvery = 0.02;
  return options;
}

template <typename Condition>
bool readsUntil(SpaceMouseDevice& device, Condition condition)
{
  return eventually([&] { return condition(device.read(steadySeconds())); });
}

bool becomes(SpaceMouseDevice& device, DeviceHealth health)
{
  return readsUntil(device,
                    [health](const DeviceReading& reading) { return reading.health == health; });
}

} // namespace

TEST(SpaceMouseDevice, WaitsUntilOneIsPluggedIn)
{
  StandIn hid;
  SpaceMouseDevice device(hid.library(), quick());
  EXPECT_EQ(device.read(0.0).health, DeviceHealth::Disconnected);
  EXPECT_NE(device.problem().find("no SpaceMouse"), std::string::npos);
  EXPECT_FALSE(device.description().givesForce);
  EXPECT_TRUE(device.description().sensesRotation);
  hid.play(kPlug);
  EXPECT_TRUE(becomes(device, DeviceHealth::Good));
  EXPECT_EQ(device.problem(), "");
}

TEST(SpaceMouseDevice, MovesWhileTheCapIsDeflectedAndStopsWhenItIsReleased)
{
  StandIn hid;
  SpaceMouseDevice device(hid.library(), quick());
  hid.play(std::string(kPlug) + "await cap\n" + "repeat 10000\n" + kFullRight + "wait 8\nend\n");
  ASSERT_TRUE(readsUntil(device, [](const DeviceReading& reading)
                         { return reading.pose.position.x() > 1.0; }));
  const DeviceReading moving = device.read(steadySeconds());
  EXPECT_EQ(moving.pose.position.y(), 0.0);
  EXPECT_EQ(moving.pose.position.z(), 0.0);
}

TEST(SpaceMouseDevice, StandsStillAfterTheCapIsReleasedWithoutBeingStale)
{
  StandIn hid;
  SpaceMouseDevice device(hid.library(), quick());
  hid.playAll(std::string(kPlug) + "await cap\n" + kFullRight + "wait 8\n" + kReleased);
  double last = -1.0;
  int still = 0;
  // 50 ticks of a simulated clock without motion, one per read.
  double now = 0.0;
  EXPECT_TRUE(eventually(
      [&]
      {
        const double x = device.read(now += 0.001).pose.position.x();
        still = x == last ? still + 1 : 0;
        last = x;
        return still >= 50;
      }));
  EXPECT_EQ(device.read(now += 1.0).health, DeviceHealth::Good);
}

TEST(SpaceMouseDevice, IsStaleAndStandsStillWhenReportsStopWhileDeflected)
{
  StandIn hid;
  SpaceMouseDevice device(hid.library(), quick());
  hid.playAll(std::string(kPlug) + "await cap\n" + kFullRight);
  ASSERT_TRUE(becomes(device, DeviceHealth::Stale));
  double now = steadySeconds() + 1.0;
  device.read(now);
  device.read(now += 0.05);
  const double x = device.read(now).pose.position.x();
  EXPECT_EQ(device.read(now + 0.05).pose.position.x(), x);
}

TEST(SpaceMouseDevice, GoesOnByItselfAfterUnpluggingAndPluggingIn)
{
  StandIn hid;
  SpaceMouseDevice device(hid.library(), quick());
  hid.playAll(std::string(kPlug) + "await cap\n" + kFullRight + "report cap 03 01 00\n");
  ASSERT_TRUE(
      readsUntil(device, [](const DeviceReading& reading) { return reading.buttons == 1; }));
  ASSERT_TRUE(becomes(device, DeviceHealth::Stale));
  hid.play("unplug cap\n");
  ASSERT_TRUE(becomes(device, DeviceHealth::Disconnected));
  const DeviceReading gone = device.read(steadySeconds());
  EXPECT_EQ(gone.buttons, 0U);

  hid.play(kPlug);
  ASSERT_TRUE(becomes(device, DeviceHealth::Good));
  EXPECT_EQ(hid.opened("cap"), 2);
  // The pose is unchanged, and the old deflection is discarded.
  EXPECT_EQ(device.read(steadySeconds()).pose.position, gone.pose.position);
  hid.play("report cap 03 02 00\n");
  EXPECT_TRUE(
      readsUntil(device, [](const DeviceReading& reading) { return reading.buttons == 2; }));
}

TEST(SpaceMouseDevice, ForgetsTheDeflectionOfACapThatWasReplacedBetweenTwoReads)
{
  StandIn hid;
  SpaceMouseDevice device(hid.library(), quick());
  hid.playAll(std::string(kPlug) + "await cap\n" + kFullRight);
  double now = 0.0;
  ASSERT_TRUE(eventually([&] { return device.read(now += 0.001).pose.position.x() > 0.0; }));
  hid.playAll(std::string("unplug cap\n") + kPlug);
  ASSERT_TRUE(eventually([&] { return hid.opened("cap") == 2 && device.problem().empty(); }));
  std::this_thread::sleep_for(std::chrono::milliseconds(50)); // for the thread to pass it on
  device.read(now += 0.001);
  EXPECT_EQ(device.read(now + 0.2).health, DeviceHealth::Good);
}

TEST(SpaceMouseDevice, OpensTheDeviceAgainAfterAReadThatFailed)
{
  StandIn hid;
  SpaceMouseDevice device(hid.library(), quick());
  hid.playAll(std::string(kPlug) + "await cap\nerror cap\n");
  EXPECT_TRUE(eventually([&] { return hid.opened("cap") == 2; }));
  EXPECT_TRUE(becomes(device, DeviceHealth::Good));
}

TEST(SpaceMouseDevice, CountsShortAndGarbledReportsAndIsNotMovedByThem)
{
  StandIn hid;
  SpaceMouseDevice device(hid.library(), quick());
  hid.playAll(std::string(kPlug) +
              "await cap\nreport cap 01 5e 01\nreport cap 01 ff 7f ff 7f ff 7f\n"
              "report cap 17 50 00\nreport cap 03 01 00\n");
  ASSERT_TRUE(
      readsUntil(device, [](const DeviceReading& reading) { return reading.buttons == 1; }));
  EXPECT_EQ(device.refused(), 2U);
  EXPECT_EQ(device.read(steadySeconds()).pose.position.norm(), 0.0);
}

TEST(SpaceMouseDevice, LeavesOtherDevicesAndOtherInterfacesAlone)
{
  StandIn hid;
  const SpaceMouseDevice device(hid.library(), quick());
  hid.playAll("plug mouse 046d c077 1 2 Optical Mouse\n"
              "plug keys 256f c633 1 6 SpaceMouse Enterprise\n"
              "plug cap 256f c633 1 8 SpaceMouse Enterprise\nawait cap\n");
  EXPECT_EQ(hid.opened("mouse"), 0);
  EXPECT_EQ(hid.opened("keys"), 0);
}

TEST(SpaceMouseDevice, SaysThatItMayNotOpenTheDeviceAndTakesItWhenItMay)
{
  StandIn hid;
  SpaceMouseDevice device(hid.library(), quick());
  hid.play(std::string("deny cap\n") + kPlug);
  EXPECT_TRUE(eventually(
      [&]
      { return device.problem().find("SpaceMouse Compact (256f:c635)") != std::string::npos; }));
  EXPECT_EQ(device.read(steadySeconds()).health, DeviceHealth::Disconnected);
  hid.play("allow cap\n");
  EXPECT_TRUE(becomes(device, DeviceHealth::Good));
}

TEST(SpaceMouseDevice, IsNotUpsetByJitterInTheReports)
{
  StandIn hid;
  SpaceMouseDevice device(hid.library(), quick());
  hid.play(std::string(kPlug) + "await cap\njitter 8\nrepeat 10000\n" + kFullRight +
           "wait 12\nend\n");
  double last = 0.0;
  ASSERT_TRUE(readsUntil(device,
                         [&](const DeviceReading& reading)
                         {
                           EXPECT_GE(reading.pose.position.x(), last);
                           last = reading.pose.position.x();
                           return last > 3.0;
                         }));
}

TEST(SpaceMouseDevice, RefusesOptionsOutOfTheirDomain)
{
  StandIn hid;
  SpaceMouseDevice::Options options;
  options.lookEvery = 0.0;
  EXPECT_THROW(SpaceMouseDevice(hid.library(), options), core::InvalidParameter);
  options = {};
  options.rate.speed = -1.0;
  EXPECT_THROW(SpaceMouseDevice(hid.library(), options), core::InvalidParameter);
}
