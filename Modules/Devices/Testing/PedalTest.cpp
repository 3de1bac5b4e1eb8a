#include <memory>
#include <vector>

#include <gtest/gtest.h>

#include "Eventually.h"
#include "StandIn.h"
#include "petrous/Core/Error.h"
#include "petrous/Devices/Pedal.h"
#include "petrous/Devices/PedalledDevice.h"

using namespace petrous;
using namespace petrous::devices;
using namespace petrous::devices::testing;

namespace
{

constexpr char kPlug[] = "plug foot 05f3 00ff c 3 VEC USB Footpedal\nawait foot\n";

Pedal::Options quick()
{
  Pedal::Options options;
  options.lookEvery = 0.02;
  return options;
}

// A made-up pedal: ID 4, one switch, pressure 100 to 900 in two bytes.
PedalLayout pressurePedal()
{
  PedalLayout layout;
  layout.vendor = 0x1234;
  layout.product = 0x5678;
  layout.reportId = 4;
  layout.size = 4;
  layout.buttonByte = 1;
  layout.buttonMask = 0x01;
  layout.pressureByte = 2;
  layout.pressureBytes = 2;
  layout.pressureMin = 100;
  layout.pressureMax = 900;
  return layout;
}

// A device at rest with its own pedal pressed to a third and button 0 held.
class StillHand final : public haptics::Device
{
public:
  const haptics::DeviceDescription& description() const noexcept override { return m_description; }
  haptics::DeviceReading read(double now) noexcept override
  {
    haptics::DeviceReading reading;
    reading.time = now;
    reading.pose.position = {1.0, 2.0, 3.0};
    reading.buttons = 1;
    reading.pedal = 1.0 / 3.0;
    reading.health = haptics::DeviceHealth::Good;
    return reading;
  }
  void send(const haptics::Wrench& wrench) noexcept override { force = wrench.linear; }

  Eigen::Vector3d force{0.0, 0.0, 0.0};

private:
  haptics::DeviceDescription m_description{"Still hand"};
};

bool decode(const PedalLayout& layout, const std::vector<unsigned char>& bytes, PedalState& state)
{
  return decodePedal(layout, bytes.data(), bytes.size(), state);
}

} // namespace

TEST(PedalReport, ReadsTheThreeSwitchesOfTheInfinityPedal)
{
  const PedalLayout infinity = knownPedals().front();
  PedalState state;
  for (const unsigned bits : {1U, 2U, 4U, 7U, 0U})
  {
    EXPECT_TRUE(decode(infinity, {static_cast<unsigned char>(bits), 0}, state));
    EXPECT_EQ(state.buttons, bits);
    EXPECT_FALSE(state.hasPressure);
  }
  EXPECT_TRUE(decode(infinity, {0xf9}, state));
  EXPECT_EQ(state.buttons, 1U) << "bits that are no switches count";
}

TEST(PedalReport, ReadsPressureWithinItsRange)
{
  const PedalLayout layout = pressurePedal();
  PedalState state;
  EXPECT_TRUE(decode(layout, {4, 0, 0xf4, 0x01}, state)); // 500
  EXPECT_TRUE(state.hasPressure);
  EXPECT_DOUBLE_EQ(state.pressure, 0.5);
  EXPECT_TRUE(decode(layout, {4, 1, 0xff, 0xff}, state));
  EXPECT_EQ(state.pressure, 1.0);
  EXPECT_EQ(state.buttons, 1U);
  EXPECT_TRUE(decode(layout, {4, 0, 0, 0}, state));
  EXPECT_EQ(state.pressure, 0.0);
}

TEST(PedalReport, RefusesShortReportsAndOtherIdsWithoutAChange)
{
  const PedalLayout layout = pressurePedal();
  PedalState state;
  decode(layout, {4, 1, 0xf4, 0x01}, state);
  EXPECT_FALSE(decode(layout, {}, state));
  EXPECT_FALSE(decode(layout, {4, 0, 0}, state));
  EXPECT_FALSE(decode(layout, {5, 0, 0, 0}, state));
  EXPECT_EQ(state.buttons, 1U);
  EXPECT_DOUBLE_EQ(state.pressure, 0.5);
}

TEST(Pedal, DrillsWithAnySwitchAndNoLongerWhenUnplugged)
{
  StandIn hid;
  Pedal pedal(hid.library(), quick());
  EXPECT_FALSE(pedal.read().connected);
  EXPECT_EQ(pedal.read().drill, 0.0);
  hid.playAll(std::string(kPlug) + "report foot 02 00\n");
  EXPECT_TRUE(eventually([&] { return pedal.read().drill == 1.0; }));
  EXPECT_EQ(pedal.read().buttons, 2U);
  hid.play("unplug foot\n");
  EXPECT_TRUE(eventually([&] { return pedal.read().drill == 0.0; }));
  EXPECT_TRUE(eventually([&] { return !pedal.read().connected; }));
}

TEST(Pedal, DrillsOnlyWithTheSwitchesThatAreTheDrills)
{
  StandIn hid;
  Pedal::Options options = quick();
  options.drillButtons = 0x2;
  Pedal pedal(hid.library(), options);
  hid.playAll(std::string(kPlug) + "report foot 05 00\n");
  ASSERT_TRUE(eventually([&] { return pedal.read().buttons == 5; }));
  EXPECT_EQ(pedal.read().drill, 0.0);
  hid.playAll("report foot 07 00\n");
  EXPECT_TRUE(eventually([&] { return pedal.read().drill == 1.0; }));
}

TEST(Pedal, GivesPressureWhereTheLayoutHasIt)
{
  StandIn hid;
  Pedal::Options options = quick();
  options.layouts = {pressurePedal()};
  Pedal pedal(hid.library(), options);
  hid.playAll("plug foot 1234 5678 0 0 Pressure pedal\nawait foot\nreport foot 04 00 f4 01\n");
  EXPECT_TRUE(eventually([&] { return pedal.read().drill == 0.5; }));
}

TEST(Pedal, RefusesLayoutsThatCannotBe)
{
  StandIn hid;
  Pedal::Options options;
  options.layouts = {pressurePedal()};
  options.layouts[0].size = 3;
  EXPECT_THROW(Pedal(hid.library(), options), core::InvalidParameter);
  options.layouts = {pressurePedal()};
  options.layouts[0].pressureMax = 100;
  EXPECT_THROW(Pedal(hid.library(), options), core::InvalidParameter);
}

TEST(PedalledDevice, AddsTheFootToTheHand)
{
  StandIn hid;
  auto hand = std::make_unique<StillHand>();
  StillHand& still = *hand;
  PedalledDevice device(std::move(hand), std::make_unique<Pedal>(hid.library(), quick()));
  haptics::DeviceReading reading = device.read(5.0);
  EXPECT_EQ(reading.health, haptics::DeviceHealth::Good) << "a missing pedal is no fault";
  EXPECT_DOUBLE_EQ(reading.pedal, 1.0 / 3.0);
  EXPECT_EQ(reading.buttons, 1U);

  hid.playAll(std::string(kPlug) + "report foot 04 00\n");
  EXPECT_TRUE(eventually([&] { return device.read(5.0).pedal == 1.0; }));
  reading = device.read(6.0);
  EXPECT_EQ(reading.buttons, 1U | (4U << PedalledDevice::kFirstPedalButton));
  EXPECT_EQ(reading.time, 6.0);
  EXPECT_EQ(reading.pose.position, Eigen::Vector3d(1.0, 2.0, 3.0));
  EXPECT_EQ(device.description().name, "Still hand");

  haptics::Wrench wrench;
  wrench.linear = {0.0, 1.0, 0.0};
  device.send(wrench);
  EXPECT_EQ(still.force, wrench.linear);
  EXPECT_THROW(PedalledDevice(nullptr, nullptr), core::InvalidParameter);
}
