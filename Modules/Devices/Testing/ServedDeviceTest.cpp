#include <cmath>
#include <csignal>
#include <fstream>
#include <limits>
#include <string>

#include <unistd.h>

#include <gtest/gtest.h>

#include "Eventually.h"
#include "FakeServer.h"
#include "ServerOptions.h"
#include "petrous/Devices/ServedDevice.h"

using namespace petrous;
using namespace petrous::devices;
using namespace petrous::devices::testing;
using haptics::DeviceHealth;
using haptics::DeviceReading;

namespace
{

// Ticks of at least 1 ms, each a read and a send, until `condition` holds for the reading.
template <typename Condition>
bool servoUntil(ServedDevice& device, const haptics::Wrench& wrench, Condition condition)
{
  return eventually(
      [&]
      {
        const DeviceReading reading = device.read(steadySeconds());
        device.send(wrench);
        return condition(reading);
      });
}

double distanceFromAxis(const DeviceReading& reading, double x)
{
  return std::hypot(reading.pose.position.x() - x, reading.pose.position.y());
}

} // namespace

TEST(ServedDevice, ExchangesPosesAndWrenchesWithTheExampleServer)
{
  ServedDevice device(exampleFor("exchange"));
  EXPECT_EQ(device.description().name, "Petrous example device");
  EXPECT_TRUE(device.description().givesForce);
  EXPECT_FALSE(device.description().givesTorque);
  EXPECT_DOUBLE_EQ(device.description().maxForce, 3.3);

  ASSERT_TRUE(
      servoUntil(device, {}, [&](const DeviceReading&) { return device.exchange().poses >= 500; }));
  const DeviceReading reading = device.read(steadySeconds());
  EXPECT_EQ(reading.health, DeviceHealth::Good);
  // The example's handle moves on a circle of 20 mm, rotated about z by its angle on it.
  EXPECT_NEAR(distanceFromAxis(reading, 0.0), 20.0, 1e-9);
  const Eigen::Vector3d ahead = reading.pose.rotation * Eigen::Vector3d(20.0, 0.0, 0.0);
  EXPECT_NEAR((ahead - reading.pose.position).norm(), 0.0, 1e-9);
  EXPECT_EQ(device.exchange().rejected, 0U);
  EXPECT_GT(device.exchange().roundTrip, 0.0);
  EXPECT_EQ(device.status().fault, "");
  RecordProperty("poses", std::to_string(device.exchange().poses));
  RecordProperty("wrenches", std::to_string(device.exchange().wrenches));
  RecordProperty("round_trip_us", std::to_string(1e6 * device.exchange().roundTrip));
}

TEST(ServedDevice, DeliversTheForceAndTheServerDropsItWhenTheServoFallsSilent)
{
  ServedDevice device(exampleFor("force"));
  haptics::Wrench push;
  push.linear = {2.0, 0.0, 0.0};
  // Compliance 1 mm/N: under 2 N the circle's centre is at x = 2.
  EXPECT_TRUE(servoUntil(device, push,
                         [](const DeviceReading& reading)
                         { return std::abs(distanceFromAxis(reading, 2.0) - 20.0) < 1e-9; }));
  // Reading continues, but nothing is sent.
  EXPECT_TRUE(eventually(
      [&]
      {
        const DeviceReading reading = device.read(steadySeconds());
        return reading.health == DeviceHealth::Good &&
               std::abs(distanceFromAxis(reading, 0.0) - 20.0) < 1e-9;
      }));
}

TEST(ServedDevice, MakesTheServerEndWithItsMotorsOff)
{
  const std::string record =
      ::testing::TempDir() + "petrous-device-record-" + std::to_string(::getpid());
  ServedDevice::Options options = optionsFor("record");
  options.command = {PETROUS_EXAMPLE_SERVER, "--record", record};
  {
    ServedDevice device(options);
    haptics::Wrench push;
    push.linear = {0.0, 0.0, -1.5};
    ASSERT_TRUE(servoUntil(
        device, push, [&](const DeviceReading&) { return device.exchange().roundTrip > 0.0; }));
  }
  std::ifstream file(record);
  double time = 0.0;
  unsigned long long tick = 0;
  double wrench[6] = {};
  bool pushed = false;
  while (file >> time >> tick >> wrench[0] >> wrench[1] >> wrench[2] >> wrench[3] >> wrench[4] >>
         wrench[5])
    pushed = pushed || wrench[2] == -1.5;
  EXPECT_TRUE(pushed);
  EXPECT_EQ(tick, 0U);
  EXPECT_EQ(wrench[2], 0.0);
  ::unlink(record.c_str());
}

TEST(ServedDevice, NamesAKilledServerAndTakesUpItsSuccessor)
{
  ServedDevice device(exampleFor("killed"));
  ASSERT_TRUE(becomes(device, DeviceHealth::Good));
  const int first = device.status().pid;
  ASSERT_EQ(::kill(first, SIGKILL), 0);

  ASSERT_TRUE(eventually([&] { return !device.status().lastFault.empty(); }));
  const std::string fault = device.status().lastFault;
  EXPECT_NE(fault.find("process " + std::to_string(first)), std::string::npos) << fault;
  EXPECT_NE(fault.find("killed by signal 9"), std::string::npos) << fault;

  ASSERT_TRUE(eventually([&] { return device.status().restarts == 1; }));
  ASSERT_TRUE(becomes(device, DeviceHealth::Good));
  EXPECT_NE(device.status().pid, first);
  EXPECT_EQ(device.status().fault, "");
  EXPECT_EQ(device.status().lastFault, fault);
}

TEST(ServedDevice, TwoAtOnceLeaveEachOtherAlone)
{
  ServedDevice first(exampleFor("one-of-two"));
  ServedDevice second(exampleFor("two-of-two"));
  ASSERT_TRUE(becomes(first, DeviceHealth::Good));
  ASSERT_TRUE(becomes(second, DeviceHealth::Good));
  EXPECT_NE(first.status().pid, second.status().pid);
  // Compliance 1 mm/N: the circle of the one that is pushed lies 2 mm aside, the other's does not.
  haptics::Wrench push;
  push.linear = {2.0, 0.0, 0.0};
  ASSERT_TRUE(eventually(
      [&]
      {
        const DeviceReading pushed = first.read(steadySeconds());
        first.send(push);
        const DeviceReading other = second.read(steadySeconds());
        second.send({});
        EXPECT_NEAR(distanceFromAxis(other, 0.0), 20.0, 1e-9);
        return std::abs(distanceFromAxis(pushed, 2.0) - 20.0) < 1e-9;
      }));
  const int pid = second.status().pid;
  ASSERT_EQ(::kill(first.status().pid, SIGKILL), 0);
  ASSERT_TRUE(eventually([&] { return first.status().restarts == 1; }));
  ASSERT_TRUE(becomes(first, DeviceHealth::Good));
  EXPECT_EQ(second.status().pid, pid);
  EXPECT_EQ(second.status().lastFault, "");
  EXPECT_EQ(second.status().restarts, 0);
  ASSERT_TRUE(becomes(second, DeviceHealth::Good));
}

TEST(ServedDevice, StaysDisconnectedWhereARestartIsNotWanted)
{
  ServedDevice::Options options = exampleFor("no-restart");
  options.restart = false;
  ServedDevice device(options);
  ASSERT_EQ(::kill(device.status().pid, SIGABRT), 0);
  ASSERT_TRUE(becomes(device, DeviceHealth::Disconnected));
  EXPECT_NE(device.status().fault.find("signal 6"), std::string::npos);
  EXPECT_FALSE(eventually([&] { return healthOf(device) != DeviceHealth::Disconnected; }, 0.5));
}

TEST(ServedDevice, IsStaleWhileTheServerIsStoppedAndGoodWhenItGoesOn)
{
  ServedDevice::Options options = exampleFor("stopped");
  options.hungAfter = 1000.0;
  ServedDevice device(options);
  ASSERT_TRUE(becomes(device, DeviceHealth::Good));
  const int pid = device.status().pid;
  ASSERT_EQ(::kill(pid, SIGSTOP), 0);
  EXPECT_TRUE(becomes(device, DeviceHealth::Stale));
  ASSERT_EQ(::kill(pid, SIGCONT), 0);
  EXPECT_TRUE(becomes(device, DeviceHealth::Good));
  EXPECT_EQ(device.status().restarts, 0);
  EXPECT_EQ(device.status().pid, pid);
}

TEST(ServedDevice, EndsAndRestartsAServerThatHangs)
{
  ServedDevice::Options options = exampleFor("hung");
  options.hungAfter = 0.3;
  ServedDevice device(options);
  const int pid = device.status().pid;
  ASSERT_EQ(::kill(pid, SIGSTOP), 0);
  ASSERT_TRUE(eventually([&] { return device.status().restarts == 1; }));
  EXPECT_NE(device.status().lastFault.find("hangs"), std::string::npos);
  ASSERT_TRUE(becomes(device, DeviceHealth::Good));
  EXPECT_NE(device.status().pid, pid);
  EXPECT_NE(::kill(pid, 0), 0) << "the hung server still runs";
}

TEST(ServedDevice, HoldsTheLastGoodPoseWhileTheServerSendsWhatNoDeviceCan)
{
  const double nan = std::nan("");
  petrous_device_pose bad[5];
  bad[0] = FakeServer::poseAt(nan, 0.0, 0.0);
  bad[1] = FakeServer::poseAt(0.0, std::numeric_limits<double>::infinity(), 0.0);
  bad[2] = FakeServer::poseAt(0.0, 0.0, 5000.0);
  bad[3] = FakeServer::poseAt(1.0, 2.0, 3.0);
  bad[3].rotation[0] = 0.0;
  bad[4] = FakeServer::poseAt(1.0, 2.0, 3.0);
  bad[4].pedal = 7.0;

  const ServedDevice::Options options = optionsFor("garbage");
  FakeServer server(options.name);
  server.setPose(FakeServer::poseAt(1.0, 2.0, 3.0));
  ServedDevice device(options);
  for (const petrous_device_pose& pose : bad)
  {
    ASSERT_TRUE(becomes(device, DeviceHealth::Good));
    server.setPose(pose);
    ASSERT_TRUE(becomes(device, DeviceHealth::Faulty));
    const DeviceReading reading = device.read(steadySeconds());
    EXPECT_EQ(reading.pose.position, Eigen::Vector3d(1.0, 2.0, 3.0));
    EXPECT_EQ(reading.pedal, 0.0);
    server.setPose(FakeServer::poseAt(1.0, 2.0, 3.0));
  }
  EXPECT_TRUE(becomes(device, DeviceHealth::Good));
  EXPECT_GE(device.exchange().rejected, 5U);
}

TEST(ServedDevice, CallsAJumpFasterThanAnyHandFaultyAndThenTakesTheNewPlace)
{
  const ServedDevice::Options options = optionsFor("jump");
  FakeServer server(options.name);
  server.setPose(FakeServer::poseAt(0.0, 0.0, 0.0));
  ServedDevice device(options);
  // A simulated clock, so that load on the machine does not matter: it stands still while the pose
  // jumps.
  double now = 100.0;
  const auto healthAfter = [&](double seconds) { return device.read(now += seconds).health; };
  ASSERT_TRUE(eventually([&] { return healthAfter(0.0) == DeviceHealth::Good; }));
  server.setPose(FakeServer::poseAt(900.0, 0.0, 0.0));
  ASSERT_TRUE(eventually([&] { return healthAfter(0.0) == DeviceHealth::Faulty; }));
  EXPECT_EQ(device.read(now).pose.position.x(), 0.0);
  // A read between two messages of the server returns the last good pose.
  EXPECT_TRUE(eventually(
      [&]
      {
        const haptics::DeviceReading sample = device.read(now += 0.001);
        return sample.health == DeviceHealth::Good && sample.pose.position.x() == 900.0;
      }));
}

TEST(ServedDevice, SaysWhatTheServerSaysOfItsDevice)
{
  const ServedDevice::Options options = optionsFor("says");
  FakeServer server(options.name);
  ServedDevice device(options);
  ASSERT_TRUE(becomes(device, DeviceHealth::Good));

  server.say(PETROUS_SERVER_NO_DEVICE, "cable\tout");
  ASSERT_TRUE(becomes(device, DeviceHealth::Disconnected));
  EXPECT_TRUE(eventually(
      [&] { return device.status().fault.find("has no device: cable out") != std::string::npos; }));

  server.say(PETROUS_SERVER_FAULT, "motor too hot");
  ASSERT_TRUE(becomes(device, DeviceHealth::Faulty));
  EXPECT_TRUE(
      eventually([&] { return device.status().fault.find("motor too hot") != std::string::npos; }));

  server.say(77, "");
  EXPECT_TRUE(
      eventually([&] { return device.status().fault.find("state 77") != std::string::npos; }));

  server.say(PETROUS_SERVER_READY, "");
  EXPECT_TRUE(becomes(device, DeviceHealth::Good));
  EXPECT_TRUE(eventually([&] { return device.status().fault.empty(); }));
}

TEST(ServedDevice, CallsAServerOfSomebodyElseHungAndTakesItUpAgain)
{
  ServedDevice::Options options = optionsFor("silent");
  options.hungAfter = 0.2;
  FakeServer server(options.name);
  ServedDevice device(options);
  ASSERT_TRUE(becomes(device, DeviceHealth::Good));
  server.setSilent(true);
  EXPECT_TRUE(becomes(device, DeviceHealth::Faulty));
  EXPECT_NE(device.status().fault.find("hangs"), std::string::npos);
  server.setSilent(false);
  EXPECT_TRUE(becomes(device, DeviceHealth::Good));
}

TEST(ServedDevice, SendsNothingThatTheMotorsCannotGive)
{
  const ServedDevice::Options options = optionsFor("limits");
  const FakeServer server(options.name);
  ServedDevice device(options);

  haptics::Wrench wrench;
  wrench.linear = {0.0, 60.0, 80.0}; // 100 N; the fake gives 3 N
  wrench.angular = {1.0, 0.0, 0.0};  // and no torque
  device.send(wrench);
  petrous_device_wrench sent = server.wrench();
  EXPECT_EQ(sent.tick, 1U);
  EXPECT_NEAR(sent.force[0], 0.0, 1e-12);
  EXPECT_NEAR(sent.force[1], 1.8, 1e-12);
  EXPECT_NEAR(sent.force[2], 2.4, 1e-12);
  EXPECT_EQ(sent.torque[0], 0.0);

  wrench.linear = {1.0, std::nan(""), 0.0};
  device.send(wrench);
  sent = server.wrench();
  EXPECT_EQ(sent.tick, 2U);
  for (const double component : sent.force)
    EXPECT_EQ(component, 0.0);
}
