#include "petrous/Presenters/ActiveDevice.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <filesystem>
#include <thread>

#include <unistd.h>

#include <gtest/gtest.h>

#include "Eventually.h"
#include "StandIn.h"
#include "petrous/Core/Error.h"
#include "petrous/Devices/ServedDevice.h"

using namespace petrous;
using namespace petrous::presenters;
using devices::testing::StandIn;

TEST(FindDevices, TheMouseIsAlwaysThereAndThePedalIsNotOne)
{
  EXPECT_EQ(findDevices({}).devices.size(), 1U);
  EXPECT_EQ(findDevices({}).devices.front().kind, InputDevice::Kind::Mouse);
  StandIn hid;
  hid.playAll("plug foot 05f3 00ff c 3 VEC USB Footpedal\n");
  const auto found = findDevices({hid.library(), {}});
  EXPECT_EQ(found.devices.size(), 1U);
  EXPECT_TRUE(found.pedal);
}

TEST(FindDevices, ListsOneSpaceMouseAndTheServers)
{
  StandIn hid;
  // The keyboard interface is not a SpaceMouse; a second SpaceMouse is ignored until the first is
  // unplugged.
  hid.playAll("plug keys 256f c635 1 6 SpaceMouse Compact\n"
              "plug cap 256f c635 1 8 SpaceMouse Compact\n"
              "plug cap2 256f c632 1 8 SpaceMouse Pro Wireless\n");
  const std::filesystem::path servers = std::filesystem::path(PETROUS_EXAMPLE_SERVER).parent_path();
  const auto found = findDevices({hid.library(), {servers}});
  ASSERT_GE(found.devices.size(), 3U);
  EXPECT_EQ(found.devices[1].name, "SpaceMouse Compact");
  EXPECT_EQ(found.devices[1].id, "spacemouse");
  EXPECT_EQ(found.devices[1].advice, "");
  const auto example =
      std::find_if(found.devices.begin(), found.devices.end(),
                   [](const InputDevice& input) { return input.id == "server-example"; });
  ASSERT_NE(example, found.devices.end());
  EXPECT_EQ(example->kind, InputDevice::Kind::Server);
  EXPECT_EQ(example->name, "example");
}

TEST(ActiveDevice, ASpaceMouseBeginsWithAShaftThatDoesNotHideTheBurr)
{
  StandIn hid;
  hid.playAll("plug cap 256f c635 1 8 SpaceMouse Compact\n");
  InputDevice input;
  input.kind = InputDevice::Kind::SpaceMouse;
  ActiveDevice device({hid.library(), {}}, input);
  EXPECT_TRUE(device.endless());
  const Eigen::Vector3d shaft = device.read(1.0).pose.rotation * Eigen::Vector3d::UnitZ();
  EXPECT_NEAR(std::acos(shaft.z()) * 180.0 / std::acos(-1.0), 20.0, 1e-9); // from the view axis
  EXPECT_GT(shaft.x(), 0.0);                                               // as in a right hand,
  EXPECT_LT(shaft.y(), 0.0);                                               // from below
}

TEST(ActiveDevice, AServersHandleKeepsItsOwnHeading)
{
  InputDevice input;
  input.kind = InputDevice::Kind::Server;
  input.name = "held-" + std::to_string(::getpid());
  input.program = PETROUS_EXAMPLE_SERVER;
  ActiveDevice device({}, input);
  EXPECT_EQ(device.description().name, "Petrous example device");
  EXPECT_FALSE(device.endless());
  for (int n = 0; n < 2000 && device.read(devices::testing::steadySeconds()).health !=
                                  haptics::DeviceHealth::Good;
       ++n)
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
  // It rotates about its own z.
  const auto reading = device.read(devices::testing::steadySeconds());
  ASSERT_EQ(reading.health, haptics::DeviceHealth::Good);
  EXPECT_NEAR((reading.pose.rotation * Eigen::Vector3d::UnitZ()).z(), 1.0, 1e-9);
  EXPECT_EQ(device.problem(), "");
}

TEST(ActiveDevice, RefusesWhatIsNoDevice)
{
  EXPECT_THROW(ActiveDevice({}, InputDevice()), core::InvalidParameter);
  InputDevice cap;
  cap.kind = InputDevice::Kind::SpaceMouse;
  EXPECT_THROW(ActiveDevice({}, cap), core::InvalidParameter);
  InputDevice server;
  server.kind = InputDevice::Kind::Server;
  server.name = "missing-" + std::to_string(::getpid());
  server.program = "/nowhere/at/all";
  EXPECT_THROW(ActiveDevice({}, server), devices::ServerError);
}
