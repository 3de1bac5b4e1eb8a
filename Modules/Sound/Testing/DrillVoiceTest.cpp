#include "petrous/Sound/DrillVoice.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include <gtest/gtest.h>

#include "HeardSound.h"
#include "petrous/Core/Error.h"

using namespace petrous;
using namespace petrous::sound;

namespace
{

constexpr double kRate = kHeardRate;

} // namespace

TEST(DrillVoice, TheThinnerTheWallTheBrighterTheSound)
{
  for (const int flutes : {8, 0})
    for (const double load : {0.5, 1.0, 3.0})
    {
      double last = 0.0;
      for (const double wall : {5.0, 4.0, 3.0, 2.0, 1.0, 0.5, 0.2, 0.0})
      {
        const double now = settledCentroid(drilling(load, wall, flutes));
        EXPECT_GT(now, 1.02 * last) << flutes << " flutes, " << load << " N, " << wall << " mm";
        last = now;
      }
    }
}

TEST(DrillVoice, TheTeethOfACuttingBurrAreHeardAtSpeedTimesFlutes)
{
  DrillVoice voice(kRate);
  DrillState state = drilling(DrillVoice::kFullLoad, 0.0);
  state.rpm = 30000.0; // 500 Hz, 470 under load; the teeth at 3760 Hz
  heard(voice, state, 0.6);
  const std::vector<double> power = heardSpectrum(heard(voice, state, 0.2));
  const auto near = [&power](double hertz)
  {
    const auto bin = static_cast<std::size_t>(std::lround(hertz / 50.0));
    return *std::max_element(power.begin() + static_cast<std::ptrdiff_t>(bin) - 1,
                             power.begin() + static_cast<std::ptrdiff_t>(bin) + 2);
  };
  const double teeth = near(8.0 * 470.0);
  EXPECT_GT(teeth, 5.0 * near(7.0 * 470.0));
  EXPECT_GT(teeth, 5.0 * near(9.0 * 470.0));
  state.flutes = 0;
  DrillVoice diamond(kRate);
  heard(diamond, state, 0.6);
  const std::vector<double> grit = heardSpectrum(heard(diamond, state, 0.2));
  EXPECT_LT(grit[75], 0.2 * teeth);
}

TEST(DrillVoice, IsSilentUntilItRunsAndLouderInBone)
{
  DrillVoice voice(kRate);
  DrillState off = drilling(2.0);
  off.running = false;
  EXPECT_EQ(loudness(heard(voice, off, 0.1)), 0.0);
  heard(voice, drilling(0.0), 0.5);
  const double inAir = loudness(heard(voice, drilling(0.0), 0.1));
  EXPECT_GT(inAir, 0.005);
  // Within 20 ms of contact, less the 13 ms that the speaker may keep.
  heard(voice, drilling(2.0), 0.007);
  EXPECT_GT(loudness(heard(voice, drilling(2.0), 0.005)), 2.0 * inAir);
  heard(voice, off, 1.0);
  EXPECT_EQ(loudness(heard(voice, off, 0.1)), 0.0);
}

TEST(DrillVoice, AWarningIsAToneThatRepeatsAndEnds)
{
  DrillVoice voice(kRate);
  DrillState state;
  state.warning = true;
  const std::vector<float> samples = heard(voice, state, 1.2);
  const auto part = [&samples](double from, double to)
  {
    return loudness(
        {samples.begin() + std::lround(kRate * from), samples.begin() + std::lround(kRate * to)});
  };
  EXPECT_GT(part(0.02, 0.1), 0.05);
  EXPECT_EQ(part(0.15, 0.55), 0.0);
  EXPECT_GT(part(0.62, 0.7), 0.05);
  state.warning = false;
  heard(voice, state, 0.7);
  EXPECT_EQ(loudness(heard(voice, state, 1.0)), 0.0);
}

TEST(DrillVoice, StaysWithinItsBoundsWhateverItIsGiven)
{
  constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
  constexpr double kHuge = std::numeric_limits<double>::infinity();
  DrillVoice voice(kRate);
  for (const double bad : {kNone, kHuge, -kHuge, -1.0, 1e300})
  {
    DrillState state = drilling(bad, bad, 1000000);
    state.rpm = bad;
    for (const float sample : heard(voice, state, 0.05))
      ASSERT_TRUE(sample >= -1.0F && sample <= 1.0F) << bad;
  }
  heard(voice, drilling(1.0), 0.5);
  EXPECT_GT(loudness(heard(voice, drilling(1.0), 0.1)), 0.01) << "it comes back";
  for (const double rate : {0.0, 7999.0, 1e9, kNone})
    EXPECT_THROW(DrillVoice{rate}, core::InvalidParameter) << rate;
}

// In between two blocks nothing jumps.
TEST(DrillVoice, ChangesWithoutClicks)
{
  DrillVoice voice(kRate);
  DrillState state = drilling(0.0);
  state.flutes = 0;
  heard(voice, state, 0.5);
  const std::vector<float> steady = heard(voice, state, 0.02);
  float step = 0.0F;
  for (std::size_t n = 1; n < steady.size(); ++n)
    step = std::max(step, std::abs(steady[n] - steady[n - 1]));
  float last = steady.back();
  state.running = false;
  for (const float sample : heard(voice, state, 0.2))
  {
    EXPECT_LE(std::abs(sample - last), 1.5F * step);
    last = sample;
  }
}

// Under load the spindle slows down and more harmonics of the teeth fit below half of the rate.
TEST(DrillVoice, AToothsHarmonicComesWithoutAStep)
{
  DrillVoice voice(kRate);
  DrillState state = drilling(0.0, 0.0);
  state.rpm = 82000.0; // the teeth's second harmonic is at 21.9 kHz, under load at 20.6
  heard(voice, state, 1.0);
  state.load = DrillVoice::kFullLoad;
  std::vector<double> levels;
  for (int block = 0; block < 40; ++block)
    levels.push_back(loudness(heard(voice, state, 0.005)));
  for (std::size_t n = 8; n < levels.size(); ++n)
    EXPECT_NEAR(levels[n], levels[n - 1], 0.25 * levels[n - 1]) << n;
}
