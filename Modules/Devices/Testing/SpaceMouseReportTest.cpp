#include <random>
#include <vector>

#include <gtest/gtest.h>

#include "petrous/Devices/SpaceMouseReport.h"

using namespace petrous::devices;

namespace
{

using Axes = std::array<std::int16_t, 6>;

SpaceMouseReport decode(const std::vector<unsigned char>& bytes, SpaceMouseState& state)
{
  return decodeSpaceMouse(bytes.data(), bytes.size(), state);
}

} // namespace

// Bytes from a USB trace of a SpaceNavigator.
TEST(SpaceMouseReport, ReadsTheReportsOfASpaceNavigator)
{
  SpaceMouseState state;
  EXPECT_EQ(decode({0x01, 0, 0, 0, 0, 0, 0}, state), SpaceMouseReport::Motion);
  EXPECT_FALSE(state.deflected());
  EXPECT_EQ(decode({0x02, 0x00, 0x00, 0xe2, 0xff, 0x00, 0x00}, state), SpaceMouseReport::Motion);
  EXPECT_EQ(state.axes, (Axes{0, 0, 0, 0, -30, 0}));
  EXPECT_EQ(decode({0x03, 0x01, 0x00}, state), SpaceMouseReport::Buttons);
  EXPECT_EQ(state.buttons, 1U);
  EXPECT_EQ(decode({0x03, 0x03, 0x00}, state), SpaceMouseReport::Buttons);
  EXPECT_EQ(state.buttons, 3U);
  EXPECT_EQ(decode({0x03, 0x00, 0x00}, state), SpaceMouseReport::Buttons);
  EXPECT_EQ(state.buttons, 0U);
}

TEST(SpaceMouseReport, KeepsTranslationWhenRotationComesAndTheOtherWayRound)
{
  SpaceMouseState state;
  decode({0x01, 0x5e, 0x01, 0xff, 0xff, 0x10, 0x00}, state);
  decode({0x02, 0xa2, 0xfe, 0x02, 0x00, 0x03, 0x00}, state);
  EXPECT_EQ(state.axes, (Axes{350, -1, 16, -350, 2, 3}));
  decode({0x01, 0, 0, 0, 0, 0, 0}, state);
  EXPECT_EQ(state.axes, (Axes{0, 0, 0, -350, 2, 3}));
}

TEST(SpaceMouseReport, ReadsSixAxesFromOneLongReport)
{
  SpaceMouseState state;
  EXPECT_EQ(decode({0x01, 1, 0, 2, 0, 3, 0, 4, 0, 5, 0, 0xfa, 0xff}, state),
            SpaceMouseReport::Motion);
  EXPECT_EQ(state.axes, (Axes{1, 2, 3, 4, 5, -6}));
}

TEST(SpaceMouseReport, KeepsThirtyTwoButtonsOfLongButtonReports)
{
  SpaceMouseState state;
  EXPECT_EQ(decode({0x03, 0x01, 0x10, 0x00, 0x80, 0xff, 0xff}, state), SpaceMouseReport::Buttons);
  EXPECT_EQ(state.buttons, 0x80001001U);
  EXPECT_EQ(decode({0x03, 0x02}, state), SpaceMouseReport::Buttons);
  EXPECT_EQ(state.buttons, 2U);
}

TEST(SpaceMouseReport, IgnoresTheBatteryAndUnknownIds)
{
  SpaceMouseState state;
  EXPECT_EQ(decode({0x17, 0x5f, 0x00}, state), SpaceMouseReport::Ignored);
  EXPECT_EQ(decode({0x1c, 0x01, 0x00}, state), SpaceMouseReport::Ignored);
  EXPECT_FALSE(state.deflected());
  EXPECT_EQ(state.buttons, 0U);
}

TEST(SpaceMouseReport, CutsDeflectionsBeyondTheFullOne)
{
  SpaceMouseState state;
  decode({0x01, 0xf4, 0x01, 0x0c, 0xfe, 0x00, 0x04}, state); // 500, -500, 1024
  EXPECT_EQ(state.axes, (Axes{350, -350, 350, 0, 0, 0}));
}

TEST(SpaceMouseReport, RefusesShortReportsAndGarbageWithoutAChange)
{
  SpaceMouseState state;
  decode({0x01, 10, 0, 20, 0, 30, 0}, state);
  const SpaceMouseState before = state;
  const std::vector<std::vector<unsigned char>> bad = {
      {},
      {0x01},
      {0x01, 0, 0, 0, 0, 0},
      {0x01, 0, 0, 0, 0, 0, 0, 0},
      {0x01, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0},
      {0x02, 0, 0},
      {0x02, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0},
      {0x03},
      {0x03, 0, 0, 0, 0, 0, 0, 0, 0, 0},
      {0x01, 0xff, 0x7f, 0, 0, 0, 0},
      {0x01, 1, 0, 2, 0, 0x00, 0x80},
      {0x02, 0x01, 0x04, 0, 0, 0, 0}, // 1025
  };
  for (const auto& bytes : bad)
  {
    EXPECT_EQ(decode(bytes, state), SpaceMouseReport::Refused);
    EXPECT_EQ(state.axes, before.axes);
    EXPECT_EQ(state.buttons, before.buttons);
  }
}

TEST(SpaceMouseReport, StaysWithinTheFullDeflectionWhateverComes)
{
  std::mt19937 random(7);
  SpaceMouseState state;
  for (int i = 0; i < 20000; ++i)
  {
    std::vector<unsigned char> bytes(random() % 65);
    for (unsigned char& byte : bytes)
      byte = static_cast<unsigned char>(random());
    if (!bytes.empty() && i % 2 == 0)
      bytes[0] = static_cast<unsigned char>(1 + random() % 3);
    decode(bytes, state);
    for (const std::int16_t axis : state.axes)
      ASSERT_LE(std::abs(axis), 350);
  }
}

TEST(SpaceMouseReport, TurnsTheCapsAxesIntoRightUpAndTowardsTheUser)
{
  SpaceMouseState state;
  state.axes = {350, 0, 0, 0, 0, 0};
  EXPECT_EQ(state.translation(), Eigen::Vector3d(1, 0, 0));
  state.axes = {0, 350, 0, 0, 0, 0}; // pulled to the user
  EXPECT_EQ(state.translation(), Eigen::Vector3d(0, 0, 1));
  state.axes = {0, 0, 350, 0, 0, 0}; // pressed down
  EXPECT_EQ(state.translation(), Eigen::Vector3d(0, -1, 0));
  state.axes = {0, 0, 0, 0, 0, -175}; // half the turn rate to the left, seen from above
  EXPECT_EQ(state.rotation(), Eigen::Vector3d(0, 0.5, 0));
}
