#include <cmath>
#include <csignal>
#include <cstdlib>
#include <limits>
#include <string>
#include <vector>

#include <sys/wait.h>
#include <unistd.h>

#include <gtest/gtest.h>

#include "DeviceBlock.h"
#include "ServerOptions.h"
#include "ServerProcess.h"
#include "StandInVendor/VendorBench.h"
#include "petrous/Devices/DeviceServerExchange.h"

using namespace petrous;
using namespace petrous::devices;
using namespace petrous::devices::testing;
using haptics::DeviceHealth;
using haptics::DeviceReading;

namespace
{

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
const double kHalf = std::sqrt(0.5);

// Ticks of a servo, each with this wrench, until `condition` holds.
template <typename Condition>
bool pushUntil(ServedDevice& device, const Eigen::Vector3d& force, Condition condition)
{
  return eventually(
      [&]
      {
        const DeviceReading reading = device.read(steadySeconds());
        device.send({force, Eigen::Vector3d(10.0, 20.0, 30.0)});
        return condition(reading);
      });
}

bool isAt(const DeviceReading& reading, double x, double y, double z)
{
  return (reading.pose.position - Eigen::Vector3d(x, y, z)).norm() < 1e-9;
}

bool isTurned(const DeviceReading& reading, double w, double x, double y, double z)
{
  return std::abs(std::abs(reading.pose.rotation.dot(Eigen::Quaterniond(w, x, y, z))) - 1.0) < 1e-9;
}

class VendorServer : public ::testing::TestWithParam<Vendor>
{
};

} // namespace

TEST(ForceDimensionServer, ConvertsAxesAndUnitsOfPoseAndWrench)
{
  VendorBench bench(kForceDimension);
  bench->place(0.01, 0.02, 0.03); // to the user, right, up
  // A quarter turn about the axis to the user: right becomes up.
  const double quarter[9] = {1, 0, 0, 0, 0, -1, 0, 1, 0};
  for (int i = 0; i < 9; ++i)
    bench->rotation[i] = quarter[i];
  bench->buttons = 5;
  ServedDevice device(bench.options("fd-axes"));
  EXPECT_EQ(device.description().name, "Force Dimension sigma.7");
  EXPECT_TRUE(device.description().sensesRotation);
  EXPECT_TRUE(device.description().givesTorque);
  EXPECT_TRUE(pushUntil(device, {1.0, 2.0, 3.0},
                        [&](const DeviceReading& reading)
                        {
                          return isAt(reading, 20.0, 30.0, 10.0) && reading.buttons == 5U &&
                                 isTurned(reading, kHalf, 0.0, 0.0, kHalf) &&
                                 bench.forceIs(3.0, 1.0, 2.0);
                        }));
  EXPECT_NEAR(bench->torque[0], 0.030, 1e-12); // N m
  EXPECT_NEAR(bench->torque[1], 0.010, 1e-12);
  EXPECT_NEAR(bench->torque[2], 0.020, 1e-12);
  EXPECT_EQ(bench->gravity, 1);
  EXPECT_EQ(bench->watchdog, 240) << "30 ms";
}

TEST(ForceDimensionServer, EnablesForcesAgainThatTheDeviceItselfSwitchedOff)
{
  VendorBench bench(kForceDimension);
  ServedDevice device(bench.options("fd-watchdog"));
  ASSERT_TRUE(becomes(device, DeviceHealth::Good));
  bench->forceOff = 3; // its watchdog
  EXPECT_TRUE(becomes(device, DeviceHealth::Faulty));
  EXPECT_TRUE(becomes(device, DeviceHealth::Good));
}

TEST(TouchServer, ReadsTheColumnMajorTransformInMillimetres)
{
  VendorBench bench(kTouch);
  bench->place(1.0, 2.0, 3.0);
  const double quarter[9] = {0, -1, 0, 1, 0, 0, 0, 0, 1};
  for (int i = 0; i < 9; ++i)
    bench->rotation[i] = quarter[i];
  bench->buttons = 2;
  ServedDevice device(bench.options("touch-axes"));
  EXPECT_EQ(device.description().name, "Touch");
  EXPECT_DOUBLE_EQ(device.description().maxForce, 3.3);
  EXPECT_DOUBLE_EQ(device.description().maxStiffness, 0.5);
  EXPECT_FALSE(device.description().givesTorque);
  EXPECT_TRUE(pushUntil(device, {0.5, 1.0, 1.5},
                        [&](const DeviceReading& reading)
                        {
                          return isAt(reading, 1.0, 2.0, 3.0) && reading.buttons == 2U &&
                                 isTurned(reading, kHalf, 0.0, 0.0, kHalf) &&
                                 bench.forceIs(0.5, 1.0, 1.5);
                        }));
}

TEST(ForceDimensionServer, LeavesForcesOffThatTheButtonSwitchedOffDuringCalibration)
{
  VendorBench bench(kForceDimension);
  ServedDevice device(bench.options("fd-button"));
  ASSERT_TRUE(becomes(device, DeviceHealth::Good));
  bench->calibrated = 0;
  ASSERT_TRUE(becomes(device, DeviceHealth::NotReady));
  bench->forceOff = 1;
  bench->calibrated = 1;
  ASSERT_TRUE(becomes(device, DeviceHealth::Faulty));
  EXPECT_TRUE(eventually(
      [&] { return device.status().fault.find("press the force button") != std::string::npos; }))
      << device.status().fault;
  EXPECT_EQ(bench->enabled, 0);
}

TEST(VendorServerName, TellsDevicesOfOneModelApart)
{
  for (const Vendor& vendor : {kForceDimension, kTouch})
  {
    VendorBench bench(vendor);
    bench->serial = 4711;
    const ServedDevice device(bench.options("serial"));
    EXPECT_NE(device.description().name.find(" 4711"), std::string::npos)
        << device.description().name;
  }
}

TEST(TouchServer, LeavesForcesOffThatTheDriverDisabledUntilItIsChosenAgain)
{
  VendorBench bench(kTouch);
  {
    ServedDevice device(bench.options("touch-disabled"));
    ASSERT_TRUE(becomes(device, DeviceHealth::Good));
    bench->enabled = 0;
    ASSERT_TRUE(pushUntil(device, {1.0, 0.0, 0.0},
                          [](const DeviceReading& reading)
                          { return reading.health == DeviceHealth::Faulty; }));
    const std::uint64_t since = bench->commands;
    EXPECT_TRUE(pushUntil(device, {1.0, 0.0, 0.0},
                          [&](const DeviceReading& reading)
                          {
                            EXPECT_EQ(reading.health, DeviceHealth::Faulty);
                            return bench->commands > since + 200;
                          }));
    EXPECT_EQ(bench->enabled, 0);
    EXPECT_TRUE(bench.forceIs(0.0, 0.0, 0.0));
    EXPECT_TRUE(eventually(
        [&] { return device.status().fault.find("choose the device again") != std::string::npos; }))
        << device.status().fault;
  }
  ServedDevice again(bench.options("touch-again"));
  EXPECT_TRUE(becomes(again, DeviceHealth::Good));
}

TEST(TouchServer, RestsWithHotMotors)
{
  VendorBench bench(kTouch);
  ServedDevice device(bench.options("touch-hot"));
  ASSERT_TRUE(pushUntil(device, {1.0, 0.0, 0.0},
                        [&](const DeviceReading&) { return bench.forceIs(1.0, 0.0, 0.0); }));
  bench->error = 0x0200;
  EXPECT_TRUE(pushUntil(device, {1.0, 0.0, 0.0},
                        [&](const DeviceReading& reading)
                        { return reading.health == DeviceHealth::Faulty; }));
  EXPECT_TRUE(eventually([&] { return device.status().fault.find("hot") != std::string::npos; }));
  EXPECT_TRUE(bench.forceIs(0.0, 0.0, 0.0));
}

#ifdef PETROUS_INVERSE3_SERVER
TEST(Inverse3Server, ConvertsAxesAndUnitsInBothFormatsOfTheService)
{
  for (const int format : {31, 35})
  {
    VendorBench bench(kInverse3);
    bench->format = format;
    bench->place(0.01, 0.02, 0.03); // right, forward, up
    bench->rotation[0] = kHalf;     // a quarter turn about up
    bench->rotation[1] = 0.0;
    bench->rotation[2] = 0.0;
    bench->rotation[3] = kHalf;
    bench->buttons = 6;
    ServedDevice device(bench.options("inverse3-axes"));
    EXPECT_EQ(device.description().name, "Haply Inverse3 049D with VerseGrip");
    EXPECT_TRUE(pushUntil(device, {0.5, 1.0, 1.5},
                          [&](const DeviceReading& reading)
                          {
                            return isAt(reading, 10.0, 30.0, -20.0) && reading.buttons == 6U &&
                                   isTurned(reading, kHalf, 0.0, kHalf, 0.0) &&
                                   bench.forceIs(0.5, -1.5, 1.0);
                          }))
        << format;
  }
}

TEST(Inverse3Server, StaysWithItsDeviceWhereThereAreTwo)
{
  VendorBench bench(kInverse3);
  bench->place(0.01, 0.02, 0.03);
  ServedDevice device(bench.options("inverse3-two"));
  ASSERT_TRUE(becomes(device, DeviceHealth::Good));
  bench->another = 1;
  const std::uint64_t since = bench->commands;
  EXPECT_TRUE(pushUntil(device, {0.5, 0.0, 0.0},
                        [&](const DeviceReading& reading)
                        {
                          EXPECT_TRUE(isAt(reading, 10.0, 30.0, -20.0));
                          return bench->commands > since + 50;
                        }));
  bench->plugged = 0;
  EXPECT_TRUE(becomes(device, DeviceHealth::Disconnected)) << "not the other";
  EXPECT_TRUE(
      eventually([&] { return device.status().fault.find("its Inverse3") != std::string::npos; }))
      << device.status().fault;
  bench->plugged = 1;
  EXPECT_TRUE(becomes(device, DeviceHealth::Good));
  EXPECT_TRUE(isAt(device.read(steadySeconds()), 10.0, 30.0, -20.0));
}

TEST(Inverse3Server, IsNotReadyWhereTheServiceDoesNotSaySo)
{
  VendorBench bench(kInverse3);
  bench->untold = 8;
  ServedDevice::Options options = bench.options("inverse3-untold");
  std::string advice;
  options.waits = [&](const std::string& text)
  {
    advice = text; // of a slow service first, where the machine is busy
    if (text.find("does not tell") != std::string::npos)
      bench->untold = 0;
  };
  ServedDevice device(options);
  EXPECT_NE(advice.find("does not tell"), std::string::npos) << advice;
  ASSERT_TRUE(becomes(device, DeviceHealth::Good));
  for (const int bit : {1, 2, 4})
  {
    bench->untold = bit;
    EXPECT_TRUE(eventually([&] { return healthOf(device) != DeviceHealth::Good; })) << bit;
    bench->untold = 0;
    EXPECT_TRUE(becomes(device, DeviceHealth::Good)) << bit;
  }
  bench->untold = 8;
  const std::uint64_t since = bench->commands;
  EXPECT_TRUE(eventually([&] { return bench->commands > since + 50; }));
  EXPECT_EQ(healthOf(device), DeviceHealth::Good) << "a message without a status changes nothing";
}

TEST(Inverse3Server, NamesTheServiceThatDoesNotAnswer)
{
  ServedDevice::Options options = optionsFor("no-service");
  options.command = {PETROUS_INVERSE3_SERVER, "--url", "ws://127.0.0.1:1"};
  try
  {
    const ServedDevice device(options);
    ADD_FAILURE();
  }
  catch (const ServerError& error)
  {
    EXPECT_EQ(error.reason(), ServerError::Reason::NoDevice);
    EXPECT_NE(std::string(error.what()).find("haply-inverse-service"), std::string::npos)
        << error.what();
  }
}

TEST(Inverse3Server, WaitsForALateAnswerBeforeItSendsTheNextForce)
{
  VendorBench bench(kInverse3);
  bench->stall = 60;
  ServedDevice device(bench.options("inverse3-late"));
  EXPECT_TRUE(eventually([&] { return bench->commands >= 5U; }));
  EXPECT_EQ(bench->piled, 0);
}
#endif

TEST_P(VendorServer, UnpluggedInContactIsReportedAndTakenUpAnewWithoutForce)
{
  VendorBench bench(GetParam());
  ServedDevice device(bench.options("unplugged"));
  const auto pushed = [&](const DeviceReading&)
  { return bench->force[0] != 0.0 || bench->force[1] != 0.0; };
  ASSERT_TRUE(pushUntil(device, {1.0, 0.0, 0.0}, pushed));
  bench->plugged = 0;
  ASSERT_TRUE(pushUntil(device, {1.0, 0.0, 0.0},
                        [](const DeviceReading& reading)
                        { return reading.health == DeviceHealth::Disconnected; }));
  ASSERT_TRUE(eventually([&] { return !device.status().fault.empty(); }));
  EXPECT_NE(device.status().fault.find("has no device: "), std::string::npos)
      << device.status().fault;
  bench->plugged = 1;
  ASSERT_TRUE(becomes(device, DeviceHealth::Good));
  EXPECT_TRUE(bench.forceIs(0.0, 0.0, 0.0)) << "nothing was sent since";
  EXPECT_EQ(bench->opened, 2);
  EXPECT_EQ(device.status().restarts, 0);
  EXPECT_TRUE(pushUntil(device, {1.0, 0.0, 0.0}, pushed));
}

TEST_P(VendorServer, SaysHowToCalibrateAndWaitsForIt)
{
  VendorBench bench(GetParam());
  bench->calibrated = 0;
  ServedDevice::Options options = bench.options("calibration");
  std::string advice;
  options.waits = [&](const std::string& text)
  {
    advice = text; // of a slow service first, where the machine is busy
    if (text.find("not calibrated: ") != std::string::npos)
      bench->calibrated = 1;
  };
  ServedDevice device(options);
  EXPECT_TRUE(becomes(device, DeviceHealth::Good));
  EXPECT_NE(advice.find("not calibrated: "), std::string::npos) << advice;
}

TEST_P(VendorServer, GivesNoForceWhileForcesAreSwitchedOffAndSaysWhy)
{
  const Vendor& vendor = GetParam();
  VendorBench bench(vendor);
  ServedDevice device(bench.options("emergency"));
  ASSERT_TRUE(becomes(device, DeviceHealth::Good));
  (*bench.operator->()).*vendor.forces = vendor.off;
  ASSERT_TRUE(pushUntil(device, {1.0, 0.0, 0.0},
                        [&](const DeviceReading& reading)
                        { return reading.health == DeviceHealth::Faulty; }));
  EXPECT_TRUE(
      eventually([&] { return device.status().fault.find(vendor.advice) != std::string::npos; }))
      << device.status().fault;
  EXPECT_TRUE(bench.forceIs(0.0, 0.0, 0.0));
  (*bench.operator->()).*vendor.forces = 1 - vendor.off;
  EXPECT_TRUE(becomes(device, DeviceHealth::Good));
}

TEST_P(VendorServer, ReleasesTheMotorsOfADeviceThatLostItsCalibrationInContact)
{
  VendorBench bench(GetParam());
  ServedDevice device(bench.options("uncalibrated"));
  const auto pushed = [&](const DeviceReading&) { return !bench.forceIs(0.0, 0.0, 0.0); };
  ASSERT_TRUE(pushUntil(device, {1.0, 0.0, 0.0}, pushed));
  bench->calibrated = 0;
  ASSERT_TRUE(pushUntil(device, {1.0, 0.0, 0.0},
                        [](const DeviceReading& reading)
                        { return reading.health != DeviceHealth::Good; }));
  EXPECT_TRUE(pushUntil(device, {1.0, 0.0, 0.0},
                        [&](const DeviceReading&) { return bench.forceIs(0.0, 0.0, 0.0); }));
  for (int i = 0; i < 200; ++i)
  {
    pushUntil(device, {1.0, 0.0, 0.0}, [](const DeviceReading&) { return true; });
    EXPECT_TRUE(bench.forceIs(0.0, 0.0, 0.0));
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  bench->calibrated = 1;
  ASSERT_TRUE(becomes(device, DeviceHealth::Good));
  EXPECT_TRUE(pushUntil(device, {1.0, 0.0, 0.0}, pushed));
}

TEST_P(VendorServer, GivesNoForceToAPoseThatIsNoNumber)
{
  VendorBench bench(GetParam());
  ServedDevice device(bench.options("nan"));
  ASSERT_TRUE(pushUntil(device, {0.0, 0.0, 1.0},
                        [&](const DeviceReading&) { return !bench.forceIs(0.0, 0.0, 0.0); }));
  bench->position[1] = kNan;
  ASSERT_TRUE(pushUntil(device, {0.0, 0.0, 1.0},
                        [&](const DeviceReading& reading)
                        { return reading.health == DeviceHealth::Faulty; }));
  EXPECT_TRUE(pushUntil(device, {0.0, 0.0, 1.0},
                        [&](const DeviceReading&) { return bench.forceIs(0.0, 0.0, 0.0); }));
  bench->position[1] = 0.0;
  EXPECT_TRUE(becomes(device, DeviceHealth::Good));
}

TEST_P(VendorServer, ReportsAnSdkThatHangsAndGoesOnWithIt)
{
  VendorBench bench(GetParam());
  ServedDevice::Options options = bench.options("hangs");
  options.hungAfter = 1000.0;
  ServedDevice device(options);
  ASSERT_TRUE(becomes(device, DeviceHealth::Good));
  bench->stall = 500;
  EXPECT_TRUE(
      eventually([&] { return device.status().fault.find("not answered") != std::string::npos; }));
  EXPECT_EQ(healthOf(device), DeviceHealth::Faulty);
  bench->stall = 0;
  EXPECT_TRUE(becomes(device, DeviceHealth::Good));
  EXPECT_EQ(device.status().restarts, 0);
}

TEST_P(VendorServer, EndsWithForcesOffAndTheDeviceClosed)
{
  VendorBench bench(GetParam());
  {
    ServedDevice device(bench.options("end"));
    ASSERT_TRUE(pushUntil(device, {1.0, 0.0, 0.0},
                          [&](const DeviceReading&) { return !bench.forceIs(0.0, 0.0, 0.0); }));
  }
  EXPECT_TRUE(eventually([&] { return bench->closed == 1; }));
  EXPECT_TRUE(bench.forceIs(0.0, 0.0, 0.0));
  EXPECT_EQ(bench->enabled, 0);
}

// Against a Petrous that sends what it never should.
TEST_P(VendorServer, LimitsForcesByItselfAndStopsThemOnSilenceAndSigterm)
{
  VendorBench bench(GetParam());
  DeviceBlock block("test-limits-" + std::to_string(::getpid()));
  ServerProcess process;
  ASSERT_FALSE(process.start(bench.command(), block.path()));
  const auto ready = [&]
  { return __atomic_load_n(&block->server_state, __ATOMIC_ACQUIRE) == PETROUS_SERVER_READY; };
  ASSERT_TRUE(eventually(ready));
  const double most = block->max_force;
  ASSERT_GT(most, 0.0);

  const auto strength = [&]
  {
    return std::sqrt(bench->force[0] * bench->force[0] + bench->force[1] * bench->force[1] +
                     bench->force[2] * bench->force[2]);
  };
  petrous_device_wrench wrench{};
  const auto send = [&](double force)
  {
    ++wrench.tick;
    wrench.force[0] = wrench.force[1] = force;
    petrous_device_put(&block->wrench_sequence, block->wrench, &wrench);
    __atomic_add_fetch(&block->petrous_beat, 1, __ATOMIC_RELEASE);
  };
  EXPECT_TRUE(eventually(
      [&]
      {
        send(1e6);
        return std::abs(strength() - most) < 1e-9;
      }));
  EXPECT_TRUE(eventually(
      [&]
      {
        send(kNan);
        return strength() == 0.0;
      }));
  const auto push = [&]
  {
    send(1.0);
    return std::abs(strength() - std::sqrt(2.0)) < 1e-9;
  };
  ASSERT_TRUE(eventually(push));
  EXPECT_TRUE(eventually([&] { return strength() == 0.0; })) << "nothing was sent";
  ASSERT_TRUE(eventually(push));
  process.signal(SIGTERM);
  EXPECT_TRUE(process.waitForEnd(20.0));
  EXPECT_EQ(strength(), 0.0);
  EXPECT_EQ(bench->enabled, 0);
}

// Its death is seen although wrenches and heartbeats still come, and although nobody has reaped it.
TEST_P(VendorServer, TurnsTheMotorsOffAtOnceWhenPetrousIsKilled)
{
  VendorBench bench(GetParam());
  DeviceBlock block("test-killed-" + std::to_string(::getpid()));
  const std::vector<std::string> command = bench.command();
  const pid_t petrous = ::fork();
  if (petrous == 0)
  {
    __atomic_store_n(&block->petrous_pid, static_cast<std::uint32_t>(::getpid()), __ATOMIC_RELEASE);
    ServerProcess process;
    process.start(command, block.path());
    for (;;)
      ::pause();
  }
  ASSERT_GT(petrous, 0);
  petrous_device_wrench wrench{};
  const auto pushUnless = [&](bool off)
  {
    ++wrench.tick;
    wrench.force[0] = 1.0;
    petrous_device_put(&block->wrench_sequence, block->wrench, &wrench);
    __atomic_add_fetch(&block->petrous_beat, 1, __ATOMIC_RELEASE);
    return bench.forceIs(0.0, 0.0, 0.0) == off;
  };
  EXPECT_TRUE(eventually([&] { return pushUnless(false); }));
  ::kill(petrous, SIGKILL);
  EXPECT_TRUE(eventually([&] { return pushUnless(true) && bench->closed == 1; }));
  EXPECT_EQ(bench->enabled, 0);
  ::waitpid(petrous, nullptr, 0);
}

TEST_P(VendorServer, EndsOnSigtermEvenWhileTheSdkHangs)
{
  VendorBench bench(GetParam());
  DeviceBlock block("test-hung-end-" + std::to_string(::getpid()));
  ServerProcess process;
  ASSERT_FALSE(process.start(bench.command(), block.path()));
  ASSERT_TRUE(eventually(
      [&]
      { return __atomic_load_n(&block->server_state, __ATOMIC_ACQUIRE) == PETROUS_SERVER_READY; }));
  bench->stall = 60000;
  ASSERT_TRUE(eventually(
      [&]
      {
        __atomic_add_fetch(&block->petrous_beat, 1, __ATOMIC_RELEASE);
        return __atomic_load_n(&block->server_state, __ATOMIC_ACQUIRE) == PETROUS_SERVER_FAULT;
      }));
  process.signal(SIGTERM);
  EXPECT_TRUE(process.waitForEnd(20.0));
}

INSTANTIATE_TEST_SUITE_P(, VendorServer,
                         ::testing::Values(kForceDimension, kTouch
#ifdef PETROUS_INVERSE3_SERVER
                                           ,
                                           kInverse3
#endif
                                           ),
                         [](const auto& instance) { return std::string(instance.param.name); });

TEST(VendorServerStart, NamesTheLibraryThatIsMissing)
{
  for (const char* program : {PETROUS_FORCE_DIMENSION_SERVER, PETROUS_TOUCH_SERVER})
  {
    ServedDevice::Options options = optionsFor("missing");
    options.command = {program, "--sdk", "/nowhere/libvendor.so"};
    try
    {
      const ServedDevice device(options);
      ADD_FAILURE() << program;
    }
    catch (const ServerError& error)
    {
      EXPECT_EQ(error.reason(), ServerError::Reason::Fault);
      EXPECT_NE(std::string(error.what()).find("/nowhere/libvendor.so"), std::string::npos)
          << error.what();
    }
  }
}

TEST(VendorServerStart, RefusesOptionsThatMakeNoSense)
{
  for (const char* option : {"--max-force -1", "--max-force x", "--unknown 1"})
  {
    const std::string command =
        std::string(PETROUS_TOUCH_SERVER) + " " + option + " /petrous-device-none 2>/dev/null";
    const int status = std::system(command.c_str());
    EXPECT_EQ(WEXITSTATUS(status), 2) << option;
  }
}
