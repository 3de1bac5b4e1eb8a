#include "petrous/Presenters/DeviceLimits.h"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <iterator>
#include <ostream>
#include <string>

#include <gtest/gtest.h>

#include <unistd.h>

#include "WallPress.h"
#include "petrous/Core/Error.h"
#include "petrous/Devices/DeviceCheck.h"

using namespace petrous;
using namespace petrous::presenters;

namespace petrous::haptics
{

void PrintTo(const KnownHandle& handle, std::ostream* out)
{
  *out << handle.real.name;
}

} // namespace petrous::haptics

namespace
{

class TestedHandle : public ::testing::TestWithParam<haptics::KnownHandle>
{
};

constexpr double kTick = 0.001; // s

// N/mm, as `device-test` proposes it.
double proposedFor(const haptics::RealDevice& real)
{
  haptics::TransmittedDevice device(real, [](double) { return haptics::Pose(); });
  devices::DeviceCheck::Options options;
  options.workspaceTime = 0.5;
  devices::DeviceCheck check(device.description(), options);
  haptics::MissedTicks misses(real);
  for (int n = 0; n < 400000 && check.stage() != devices::DeviceCheck::Stage::Done; ++n)
  {
    const haptics::DeviceReading reading = device.read(kTick * n);
    if (!misses(n))
      device.send(check.tick(reading, kTick * n));
  }
  return check.result().proposed;
}

constexpr double kDescribed = 5.0; // N/mm

std::optional<double> kept(const std::filesystem::path& file, const char* server,
                           const char* device)
{
  return keptStiffness(file, server, device, kDescribed);
}

} // namespace

TEST(DeviceLimits, KeepsOneStiffnessForEachDeviceOfAServer)
{
  const std::filesystem::path folder =
      std::filesystem::path(::testing::TempDir()) / ("device-limits-" + std::to_string(::getpid()));
  const std::filesystem::path file = folder / "petrous" / "device-limits.json";
  EXPECT_FALSE(kept(file, "touch", "Touch"));
  keepStiffness(file, "touch", "Touch", 0.35);
  keepStiffness(file, "omega", "omega.7", 2.0);
  keepStiffness(file, "touch", "Touch", 0.45);
  EXPECT_EQ(kept(file, "touch", "Touch"), 0.45);
  EXPECT_EQ(kept(file, "omega", "omega.7"), 2.0);
  EXPECT_FALSE(kept(file, "touch", "Touch X")) << "another device at the same server";
  for (const double bad : {0.0, -1.0, 21.0, std::nan("")})
    EXPECT_THROW(keepStiffness(file, "touch", "Touch", bad), core::InvalidParameter);

  for (const char* text : {"", "[]", "{\"touch\": 1}", "{\"touch\": {\"device\": \"Touch\"}}",
                           "{\"touch\": {\"device\": \"Touch\", \"max_stiffness_n_per_mm\": 1e9}}"})
  {
    std::ofstream(file, std::ios::trunc) << text;
    EXPECT_FALSE(kept(file, "touch", "Touch")) << text;
  }
  keepStiffness(file, "touch", "Touch", 0.5);
  keepStiffness(file, "touch", "Touch 4711", 0.7);
  EXPECT_EQ(kept(file, "touch", "Touch"), 0.5);
  EXPECT_EQ(kept(file, "touch", "Touch 4711"), 0.7) << "another of that model";
  std::filesystem::remove_all(folder);
}

TEST(DeviceLimits, RaisesWhatTheServerDescribesToTwiceAtMost)
{
  const std::filesystem::path file = std::filesystem::path(::testing::TempDir()) /
                                     ("device-bound-" + std::to_string(::getpid()) + ".json");
  keepStiffness(file, "touch", "Touch", 8.0);
  EXPECT_EQ(keptStiffness(file, "touch", "Touch", 5.0), 8.0);
  EXPECT_EQ(keptStiffness(file, "touch", "Touch", 0.4), 0.8);
  EXPECT_EQ(keptStiffness(file, "touch", "Touch", 0.0), 0.0);
  EXPECT_EQ(boundedStiffness(0.2, 0.4), 0.2);
  std::filesystem::remove(file);
}

TEST(DeviceLimits, TakesAQuarterOfWhatAServerDescribesUntilItIsMeasured)
{
  EXPECT_EQ(untestedStiffness(0.0), 0.0);
  EXPECT_EQ(untestedStiffness(0.2), 0.1);
  EXPECT_EQ(untestedStiffness(0.4), 0.2);
  EXPECT_EQ(untestedStiffness(0.6), 0.2);
  EXPECT_EQ(untestedStiffness(1.0), 0.25);
  EXPECT_EQ(untestedStiffness(2.0), 0.5);
  EXPECT_EQ(untestedStiffness(20.0), 0.5);
}

// What the window renders on the simulated handles: no limit cycle and no energy out of 30 presses,
// by a balance at the handle that knows nothing of the guard's.
TEST(DeviceLimits, KeepsDevicesStableWithLongDelaysAndMissedTicks)
{
  for (const haptics::KnownHandle& handle : haptics::kHandles)
  {
    if (handle.real.friction == 0.0) // no device
      continue;
    for (const int delay : {0, 3, 5, 8})
      for (const int burst : {1, 3})
      {
        haptics::RealDevice real = handle.real;
        real.delay = delay;
        real.missed = 0.05;
        real.burst = burst;
        haptics::WallPress how;
        how.times = 30;
        how.stiffness = untestedStiffness(handle.described);
        const haptics::Touching felt = haptics::press(real, how);
        EXPECT_LE(felt.energyOut, haptics::Touching::kMostEnergy)
            << real.name << delay << " ms " << burst;
        EXPECT_LE(felt.ripple, haptics::Touching::kMostRipple)
            << real.name << delay << " ms " << burst;
        EXPECT_GT(felt.mostForce, 0.3) << real.name;
      }
  }
}

// What `device-test` proposes on them, whatever the server describes. Where no tick is missed, not
// below 0.4 of the stiffness that is passive by the damping alone, or of the ramp's end.
TEST_P(TestedHandle, IsStableAndNotTooSoftAtTheProposedStiffness)
{
  const struct
  {
    double share;
    int burst;
  } missing[] = {{0.0, 1}, {0.01, 1}, {0.05, 1}, {0.05, 3}};
  for (int delay = 0; delay <= 8; ++delay)
    for (const auto& missed : missing)
    {
      haptics::RealDevice real = GetParam().real;
      real.delay = delay;
      real.missed = missed.share;
      real.burst = missed.burst;
      haptics::WallPress how;
      how.times = 30;
      how.stiffness = proposedFor(real);
      const std::string cell = std::to_string(how.stiffness) + " N/mm, " + std::to_string(delay) +
                               " ms, " + std::to_string(missed.share) + " missed";
      ASSERT_GT(how.stiffness, 0.0) << cell;
      const double least =
          missed.share == 0.0 ? 0.4 * std::min(10.0, haptics::passiveStiffness(real)) : 0.0;
      EXPECT_GE(how.stiffness, least) << cell;
      const haptics::Touching felt = haptics::press(real, how);
      EXPECT_LE(felt.energyOut, haptics::Touching::kMostEnergy) << cell;
      EXPECT_LE(felt.ripple, haptics::Touching::kMostRipple) << cell;
      EXPECT_GT(felt.mostForce, 0.3) << "the wall was felt; " << cell;
    }
}

// All but mass and damper alone, which is no device.
INSTANTIATE_TEST_SUITE_P(DeviceLimits, TestedHandle,
                         ::testing::ValuesIn(std::begin(haptics::kHandles) + 1,
                                             std::end(haptics::kHandles)),
                         [](const auto& instance)
                         { return std::string(instance.param.real.name); });

TEST(DeviceLimits, ReadsTheFormerFormatAndKeepsItsEntry)
{
  const std::filesystem::path file = std::filesystem::path(::testing::TempDir()) /
                                     ("device-former-" + std::to_string(::getpid()) + ".json");
  std::ofstream(file) << R"({"touch": {"device": "Touch", "max_stiffness_n_per_mm": 0.3}})";
  EXPECT_EQ(kept(file, "touch", "Touch"), 0.3);
  EXPECT_FALSE(kept(file, "touch", "device"));
  keepStiffness(file, "touch", "Touch X", 0.6);
  EXPECT_EQ(kept(file, "touch", "Touch"), 0.3);
  EXPECT_EQ(kept(file, "touch", "Touch X"), 0.6);
  std::filesystem::remove(file);
}

TEST(DeviceLimits, PutsADamagedFileAsideBeforeItWritesAnother)
{
  const std::filesystem::path folder = std::filesystem::path(::testing::TempDir()) /
                                       ("device-damaged-" + std::to_string(::getpid()));
  std::filesystem::create_directories(folder);
  const std::filesystem::path file = folder / "device-limits.json";
  for (const char* name : {"device-limits.json.damaged", "device-limits.json.damaged-2"})
  {
    const std::string damaged = std::string("{\"omega\": ") + name;
    std::ofstream(file, std::ios::trunc) << damaged;
    keepStiffness(file, "touch", "Touch", 0.5);
    std::ifstream aside(folder / name);
    std::string text((std::istreambuf_iterator<char>(aside)), {});
    EXPECT_EQ(text, damaged);
    EXPECT_EQ(kept(file, "touch", "Touch"), 0.5);
  }
  std::filesystem::remove_all(folder);
}
