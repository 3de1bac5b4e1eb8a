#include <algorithm>
#include <cmath>
#include <deque>
#include <ostream>
#include <string>

#include <gtest/gtest.h>

#include "SampledSpring.h"
#include "SimulatedDevice.h"
#include "petrous/Haptics/ForceLimits.h"
#include "petrous/Haptics/PassivityGuard.h"

using namespace petrous::haptics;

namespace
{

constexpr double kTick = 0.001; // s

// A device as it is between the program and the motors.
struct RealDevice
{
  const char* name;
  double mass;     // kg
  double damping;  // N s/mm
  double friction; // N
  int delay;       // ticks until a wrench acts
  double quantum;  // mm, of the encoders; at most 2 friction / stiffness (Diolaiti et al. 2006)
  int dropEvery;   // ticks: every so many the servo misses one
};

void PrintTo(const RealDevice& real, std::ostream* out)
{
  *out << real.name;
}

// Half of the exact stability limit, as `device-test` proposes, at most what a device may describe.
double setting(const RealDevice& real, double handStiffness)
{
  return std::min(10.0,
                  0.5 * sampledSpringLimit(real.mass, real.damping, handStiffness, real.delay));
}

struct Touching
{
  double energyOut = 0.0; // N mm (mJ) that came out at the handle in the worst cycle: the motors'
                          // work less the friction of the joints
  double ripple = 0.0;    // N, half of the force's range while the hand rests on the wall
  double mostForce = 0.0; // N
};

// Presses against a wall at x = 0 three times, through coupling, guard and limits as in the servo.
Touching press(const RealDevice& real, double stiffness, double tremor, bool guarded = true)
{
  SimulatedDevice::Hand hand;
  hand.mass = real.mass;
  hand.damping = real.damping;
  hand.friction = real.friction;
  hand.tremor = tremor;
  constexpr double kPeriod = 1.6; // s
  // 2 mm before the wall, 0.2 s down, 1 s at rest 6 mm behind it (about 1.8 N), 0.2 s back.
  const auto target = [](double time)
  {
    const double t = std::fmod(time, kPeriod);
    const double share = std::clamp(std::min(t - 0.1, 1.5 - t) / 0.2, 0.0, 1.0);
    return Pose{{2.0 - 8.0 * share, 0.0, 0.0}, Eigen::Quaterniond::Identity()};
  };
  SimulatedDevice device(target, hand, {});
  PassivityGuard::Parameters parameters;
  parameters.stiffness = stiffness;
  PassivityGuard guard(parameters);
  ForceLimits::Limits limits;
  limits.maxForce = 10.0;
  ForceLimits limited(limits);
  limited.resume();
  std::deque<Wrench> underway(static_cast<std::size_t>(real.delay));

  Touching result;
  double low = 1e9;
  double high = -1e9;
  double before = device.read(0.0).pose.position.x();
  double energy = 0.0; // of this cycle, which begins and ends before the wall
  int cycle = 0;
  for (int n = 1; n <= static_cast<int>(3.001 * kPeriod / kTick); ++n)
  {
    const double now = kTick * n;
    Pose pose = device.read(now).pose;
    const double x = device.pose().position.x();
    energy += device.sent().linear.x() * (x - before) - real.friction * std::abs(x - before);
    before = x;
    if (const int present = static_cast<int>(now / kPeriod); present != cycle)
    {
      cycle = present;
      result.energyOut = std::max(result.energyOut, energy);
      energy = 0.0;
    }
    const double at = std::fmod(now, kPeriod);
    if (at > 0.8 && at < 1.2)
    {
      low = std::min(low, device.sent().linear.x());
      high = std::max(high, device.sent().linear.x());
    }
    result.mostForce = std::max(result.mostForce, std::abs(device.sent().linear.x()));
    if (real.dropEvery > 0 && n % real.dropEvery == 0)
      continue;
    if (real.quantum > 0.0)
      pose.position.x() = real.quantum * std::round(pose.position.x() / real.quantum);
    Wrench wanted;
    wanted.linear.x() = stiffness * std::max(0.0, -pose.position.x());
    const Wrench output = limited.apply(guarded ? guard.apply(wanted, pose, now) : wanted, now);
    guard.sent(output);
    underway.push_back(output);
    device.send(underway.front());
    underway.pop_front();
  }
  result.ripple = 0.5 * (high - low);
  return result;
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
    const Touching still = press(real, share * most, 0.0);
    EXPECT_LE(still.energyOut, 0.1) << share * most << " N/mm";
    EXPECT_LE(still.ripple, 0.05) << share * most << " N/mm";
    EXPECT_GT(still.mostForce, 0.3) << "the wall was felt";
    EXPECT_LE(press(real, share * most, 0.05).energyOut, 0.1) << share * most << " N/mm, tremor";
  }
}

// The test sees an unstable coupling: far beyond the limit, the ripple is there.
TEST_P(CouplingStability, OscillatesFarBeyondTheLimitWithoutTheGuardsHelp)
{
  const RealDevice& real = GetParam();
  const double limit =
      sampledSpringLimit(real.mass, real.damping, SimulatedDevice::Hand().stiffness, real.delay);
  const Touching wild = press(real, 4.0 * limit, 0.0, false);
  EXPECT_GT(wild.ripple, 0.05);
  EXPECT_GT(wild.energyOut, 0.1);
}

INSTANTIATE_TEST_SUITE_P(, CouplingStability,
                         ::testing::Values(RealDevice{"Ideal", 0.15, 0.003, 0.0, 0, 0.0, 0},
                                           RealDevice{"Late", 0.1, 0.006, 0.05, 2, 0.005, 0},
                                           RealDevice{"VeryLate", 0.1, 0.004, 0.03, 4, 0.002, 0},
                                           RealDevice{"Dropping", 0.15, 0.01, 0.1, 1, 0.01, 50},
                                           RealDevice{"Stiff", 0.25, 0.025, 0.1, 0, 0.005, 20}),
                         [](const auto& instance) { return std::string(instance.param.name); });
