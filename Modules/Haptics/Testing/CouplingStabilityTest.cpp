#include <algorithm>
#include <ostream>
#include <string>

#include <gtest/gtest.h>

#include "SampledSpring.h"
#include "SimulatedDevice.h"
#include "WallPress.h"

using namespace petrous::haptics;

namespace petrous::haptics
{

void PrintTo(const RealDevice& real, std::ostream* out)
{
  *out << real.name;
}

} // namespace petrous::haptics

namespace
{

Touching pressed(const RealDevice& real, double stiffness, double tremor, bool guarded = true)
{
  WallPress how;
  how.stiffness = stiffness;
  how.tremor = tremor;
  how.guarded = guarded;
  return press(real, how);
}

// Half of the exact stability limit, as `device-test` proposes, at most what a device may describe.
double setting(const RealDevice& real, double handStiffness)
{
  return std::min(10.0,
                  0.5 * sampledSpringLimit(real.mass, real.damping, handStiffness, real.delay));
}

class CouplingStability : public ::testing::TestWithParam<RealDevice>
{
};

} // namespace

TEST_P(CouplingStability, GivesNoEnergyAndDoesNotOscillateUpToTheSetting)
{
  const RealDevice& real = GetParam();
  const double most = setting(real, SimulatedDevice::Hand().stiffness);
  RecordProperty("setting_n_per_mm", std::to_string(most));
  for (const double share : {0.25, 0.5, 1.0})
  {
    const Touching still = pressed(real, share * most, 0.0);
    EXPECT_LE(still.energyOut, 0.1) << share * most << " N/mm";
    EXPECT_LE(still.ripple, 0.05) << share * most << " N/mm";
    EXPECT_GT(still.mostForce, 0.3) << "the wall was felt";
    EXPECT_LE(pressed(real, share * most, 0.05).energyOut, 0.1) << share * most << " N/mm, tremor";
  }
}

// The test sees an unstable coupling: far beyond the limit, the ripple is there.
TEST_P(CouplingStability, OscillatesFarBeyondTheLimitWithoutTheGuardsHelp)
{
  const RealDevice& real = GetParam();
  const double limit =
      sampledSpringLimit(real.mass, real.damping, SimulatedDevice::Hand().stiffness, real.delay);
  const Touching wild = pressed(real, 4.0 * limit, 0.0, false);
  EXPECT_GT(wild.ripple, 0.05);
  EXPECT_GT(wild.energyOut, 0.1);
}

// Mass and damper alone, without the guard. The border of the simulation is that of the closed
// loop's poles, within 3 %, and that of passivity, which neglects the mass, within 10 %: a delay of
// 8 ms is long for it.
TEST(CouplingBorder, IsThatOfColgateAndSchenkelWithTheDelayAdded)
{
  WallPress how;
  how.guarded = false;
  how.rest = 12.0;
  how.subStep = 2e-5; // the simulation's force comes half a sub-step early
  for (const int delay : {0, 2, 8})
  {
    RealDevice real;
    real.damping = 0.006;
    real.mass = 0.2;
    real.delay = delay;
    const double exact = sampledSpringLimit(real.mass, real.damping, how.handStiffness, delay);
    how.stiffness = 0.97 * exact;
    EXPECT_LE(press(real, how).ripple, Touching::kMostRipple) << delay << " ms";
    how.stiffness = 1.03 * exact;
    EXPECT_GT(press(real, how).ripple, Touching::kMostRipple) << delay << " ms";
    EXPECT_NEAR(passiveStiffness(real) / exact, 1.0, 0.1) << delay << " ms";
  }
}

TEST(CouplingBorder, IsFoundByBisection)
{
  RealDevice real;
  real.damping = 0.006;
  real.mass = 0.2;
  real.delay = 2;
  WallPress how;
  how.rest = 12.0;
  EXPECT_NEAR(ringingStiffness(real, how) /
                  sampledSpringLimit(real.mass, real.damping, how.handStiffness, real.delay),
              1.0, 0.05);
}

// Friction quiets an encoder's steps up to 2 f / q [Diolaiti et al. 2006].
TEST(CouplingBorder, AnEncodersStepsAreQuietOnlyAsFarAsFrictionGoes)
{
  RealDevice coarse;
  coarse.quantum = 0.05;
  coarse.damping = 0.006;
  EXPECT_GT(pressed(coarse, 3.0, 0.0, false).ripple, Touching::kMostRipple);
  coarse.friction = 0.25; // 2 f / q = 10 N/mm
  EXPECT_LE(pressed(coarse, 3.0, 0.0, false).ripple, Touching::kMostRipple);
}

// What the guard took for energy of encoder counts would add up over the presses, and be damped in
// jumps of the force: up to 20 N s/m times a count per tick, 1.1 N on a Touch.
TEST(CouplingBorder, TheGuardLeavesManyPressesOnCoarseEncodersAlone)
{
  for (const KnownHandle& handle : kHandles)
  {
    RealDevice real = handle.real;
    if (real.quantum < 0.05)
      continue;
    for (const double stiffness : {0.35, 0.7, 1.4, 2.8}) // k < 4 f / q = 3.3
      for (real.delay = 0; real.delay <= 2; ++real.delay)
      {
        WallPress how;
        how.stiffness = stiffness;
        how.times = 30;
        const Touching felt = press(real, how);
        EXPECT_LE(felt.ripple, Touching::kMostRipple) << real.name << stiffness << real.delay;
        EXPECT_LE(felt.energyOut, Touching::kMostEnergy) << real.name << stiffness << real.delay;
        EXPECT_LE(felt.changed, 0.05) << real.name << stiffness << real.delay;
      }
  }
}

// A Touch is stable with the guard where it is without.
TEST(CouplingBorder, TheGuardTakesNoStabilityFromATouch)
{
  RealDevice touch = kHandles[1].real;
  int compared = 0;
  for (touch.missed = 0.0; touch.missed < 0.06; touch.missed += 0.05)
    for (const int delay : {0, 1, 2, 4, 8})
      for (const double stiffness : {0.35, 1.0, 2.8, 5.6, 9.0})
      {
        touch.delay = delay;
        WallPress how;
        how.stiffness = stiffness;
        how.times = 10;
        how.guarded = false;
        if (!press(touch, how).stable())
          continue;
        ++compared;
        how.guarded = true;
        how.stiffness = 0.9 * stiffness;
        EXPECT_TRUE(press(touch, how).stable()) << delay << " ms, " << how.stiffness << " N/mm";
      }
  EXPECT_GT(compared, 20);
}

INSTANTIATE_TEST_SUITE_P(, CouplingStability,
                         ::testing::Values(RealDevice{"Ideal", 0.15, 0.003, 0.0, 0, 0.0, 0},
                                           RealDevice{"Late", 0.1, 0.006, 0.05, 2, 0.005, 0},
                                           RealDevice{"VeryLate", 0.1, 0.004, 0.03, 4, 0.002, 0},
                                           RealDevice{"Dropping", 0.15, 0.01, 0.1, 1, 0.01, 50},
                                           RealDevice{"Stiff", 0.25, 0.025, 0.1, 0, 0.005, 20}),
                         [](const auto& instance) { return std::string(instance.param.name); });
