#include <cmath>
#include <limits>
#include <memory>
#include <vector>

#include <gtest/gtest.h>

#include "SimulatedDevice.h"
#include "petrous/Core/Error.h"
#include "petrous/Haptics/DeviceGuard.h"

using namespace petrous::haptics;
using Eigen::Vector3d;
using Hand = SimulatedDevice::Hand;
using Faults = SimulatedDevice::Faults;

namespace
{

constexpr double kPi = 3.14159265358979323846;
constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

Pose still(double)
{
  return {};
}

Pose alongX(double time)
{
  return {{20.0 * time, 0, 0}, Eigen::Quaterniond::Identity()};
}

// x(t) of an oscillator at rest at 0, with a constant force acting from t = 0 on.
double stepResponse(double force, double mass, double stiffness, double damping, double time)
{
  const double rate = std::sqrt(stiffness / mass);
  const double decay = 0.5 * damping / mass;
  const double swing = std::sqrt(rate * rate - decay * decay);
  return force / stiffness *
         (1.0 - std::exp(-decay * time) *
                    (std::cos(swing * time) + decay / swing * std::sin(swing * time)));
}

// A device read at 1 kHz from t = 0 on.
struct Handled
{
  explicit Handled(SimulatedDevice::Target target, const Hand& hand = {}, const Faults& faults = {})
    : device(std::make_unique<SimulatedDevice>(std::move(target), hand, faults))
  {
  }
  DeviceReading until(double time)
  {
    DeviceReading reading;
    for (; 0.001 * tick <= time + 1e-9; ++tick)
      reading = device->read(0.001 * tick);
    return reading;
  }
  std::unique_ptr<SimulatedDevice> device;
  int tick = 0;
};

double largestError(double subStep, bool turning)
{
  Hand hand;
  hand.mass = 0.2;
  hand.stiffness = 0.4;
  hand.damping = 0.002;
  hand.inertia = 80.0;
  hand.angularStiffness = 300.0;
  hand.angularDamping = 1.0;
  hand.subStep = subStep;
  Handled run(still, hand);
  run.until(0.0);
  const Vector3d axis(2.0 / 3.0, -1.0 / 3.0, 2.0 / 3.0);
  run.device->send({2.0 * axis, 90.0 * axis});
  double worst = 0.0;
  for (int n = 1; n <= 300; ++n)
  {
    const Pose pose = run.until(0.001 * n).pose;
    const Vector3d error =
        turning ? Vector3d(rotationVector(pose.rotation) -
                           stepResponse(90.0, 0.08, 300.0, 1.0, 0.001 * n) * axis)
                : Vector3d(pose.position - stepResponse(2.0, 2e-4, 0.4, 0.002, 0.001 * n) * axis);
    worst = std::max(worst, error.norm());
  }
  return worst;
}

} // namespace

TEST(SimulatedDevice, IsADampedOscillatorToTheFirstOrderInItsSubStep)
{
  for (const bool turning : {false, true})
  {
    const double coarse = largestError(1e-3, turning);
    const double middle = largestError(1e-4, turning);
    const double fine = largestError(1e-5, turning);
    EXPECT_NEAR(std::log10(coarse / middle), 1.0, 0.05);
    EXPECT_NEAR(std::log10(middle / fine), 1.0, 0.02);
    EXPECT_LT(fine, turning ? 1e-4 : 2e-3) << "5 mm, 0.3 rad";
  }
}

TEST(SimulatedDevice, RestsWhereTheHandBalancesWhatIsSent)
{
  Handled run(still);
  run.until(0.0);
  run.device->send({{0.6, -0.3, 0.9}, {40.0, 0.0, -20.0}});
  const DeviceReading reading = run.until(4.0);
  EXPECT_LE((reading.pose.position - Vector3d(2, -1, 3)).norm(), 1e-9);
  EXPECT_LE((rotationVector(reading.pose.rotation) - Vector3d(0.08, 0, -0.04)).norm(), 1e-9);
  EXPECT_LE(run.device->velocity().linear.norm(), 1e-7);
}

TEST(SimulatedDevice, AFreeBodyGainsTheMomentumOfTheForce)
{
  Hand hand;
  hand.stiffness = hand.damping = hand.angularStiffness = hand.angularDamping = 0.0;
  Handled run(still, hand);
  run.until(0.0);
  run.device->send({{0.15, 0, 0}, {0, 10, 0}});
  run.until(0.5);
  EXPECT_NEAR(run.device->velocity().linear.x(), 500.0, 1e-8) << "1 m/s^2 for half a second";
  EXPECT_NEAR(run.device->velocity().angular.y(), 50.0, 1e-9);
  EXPECT_NEAR(run.device->pose().position.x(), 125.0, 0.1);
  EXPECT_NEAR(run.device->pose().rotation.norm(), 1.0, 1e-15);
}

TEST(SimulatedDevice, FrictionStopsABodyAndHoldsItAgainstWeakerForces)
{
  Hand hand;
  hand.stiffness = hand.damping = 0.0;
  hand.friction = 0.15;
  Handled run(still, hand);
  run.until(0.0);
  run.device->send({{0.45, 0, 0}, {0, 0, 0}});
  run.until(0.1); // 2 m/s^2 for 0.1 s: 200 mm/s, 10 mm
  EXPECT_NEAR(run.device->velocity().linear.x(), 200.0, 1e-6);
  run.device->send({});
  run.until(0.4); // -1 m/s^2: 20 mm further, in 0.2 s
  EXPECT_EQ(run.device->velocity().linear.x(), 0.0);
  EXPECT_NEAR(run.device->pose().position.x(), 30.0, 0.05);
  const double there = run.device->pose().position.x();
  run.device->send({{0.14, 0, 0}, {0, 0, 0}});
  run.until(0.6);
  EXPECT_EQ(run.device->pose().position.x(), there);
}

TEST(SimulatedDevice, FollowsASteadyHandWithoutLag)
{
  Handled run([](double t) { return Pose{{20.0 * t, 0, 0}, rotationFrom({0, 0, 0.5 * t})}; });
  const DeviceReading reading = run.until(3.0);
  EXPECT_NEAR(reading.pose.position.x(), 60.0, 1e-6);
  EXPECT_NEAR(rotationVector(reading.pose.rotation).z(), 1.5, 1e-6);
}

TEST(SimulatedDevice, TremorHasItsAmplitudeInItsBand)
{
  Hand stiff; // so that the handle is at the hand's target
  stiff.mass = 0.01;
  stiff.stiffness = 100.0;
  stiff.damping = 0.01;
  stiff.tremor = 0.08;
  stiff.seed = 9;
  Handled run(still, stiff);
  run.until(1.0);
  const int count = 20000;
  std::vector<Vector3d> seen;
  for (int n = 0; n < count; ++n)
    seen.push_back(run.until(1.001 + 0.001 * n).pose.position);
  for (int axis = 0; axis < 3; ++axis)
  {
    double power = 0.0;
    for (const auto& p : seen)
      power += p[axis] * p[axis] / count;
    EXPECT_NEAR(std::sqrt(power), 0.08, 0.004);
    // Fourier sums with a Hann window, in steps of its resolution.
    double inside = 0.0;
    double outside = 0.0;
    for (double hertz = 1.0; hertz < 30.0; hertz += 0.1)
    {
      double cosine = 0.0;
      double sine = 0.0;
      for (int n = 0; n < count; n += 4)
      {
        const double window = 1.0 - std::cos(2.0 * kPi * n / count);
        const double phase = 2.0 * kPi * hertz * 0.001 * n;
        cosine += window * seen[static_cast<std::size_t>(n)][axis] * std::cos(phase);
        sine += window * seen[static_cast<std::size_t>(n)][axis] * std::sin(phase);
      }
      (hertz > 7.9 && hertz < 12.1 ? inside : outside) += cosine * cosine + sine * sine;
    }
    EXPECT_GT(inside, 1000.0 * outside);
  }
}

TEST(SimulatedDevice, TheSeedDecidesTheTremor)
{
  Hand hand;
  hand.tremor = 0.1;
  Handled one(alongX, hand);
  Handled two(alongX, hand);
  EXPECT_EQ(one.until(0.5).pose.position, two.until(0.5).pose.position);
  hand.seed = 2;
  Handled other(alongX, hand);
  EXPECT_GT((other.until(0.5).pose.position - one.device->pose().position).norm(), 1e-3);
}

TEST(SimulatedDevice, TimeThatStandsOrRunsBackMovesNothing)
{
  Handled run(alongX);
  const Vector3d before = run.until(1.0).pose.position;
  for (const double now : {1.0, 1.0, 0.4, kNan})
    EXPECT_EQ(run.device->read(now).pose.position, before);
  EXPECT_GT(run.device->read(1.001).pose.position.x(), before.x());
}

TEST(SimulatedDevice, AHugeLeapOfTheClockEndsAndStaysFinite)
{
  Handled run(still);
  run.until(0.1);
  run.device->send({{0.3, 0, 0}, {0, 0, 0}});
  const DeviceReading reading = run.device->read(1e6);
  EXPECT_NEAR(reading.pose.position.x(), 1.0, 1e-3);
}

TEST(SimulatedDevice, AWrenchThatIsNoNumberActsAsNone)
{
  Handled run(still);
  run.until(0.0);
  run.device->send({{kNan, 0, 0}, {0, 0, 0}});
  EXPECT_EQ(run.until(0.1).pose.position, Vector3d(0, 0, 0));
}

TEST(SimulatedDevice, ReportsButtonsAndPedal)
{
  Handled run(still);
  run.device->press(5u, 0.25);
  const DeviceReading reading = run.until(0.0);
  EXPECT_EQ(reading.buttons, 5u);
  EXPECT_EQ(reading.pedal, 0.25);
  EXPECT_EQ(reading.health, DeviceHealth::Good);
}

TEST(SimulatedDevice, MisbehavesFromTheMomentItIsTold)
{
  Faults faults;
  faults.nanFrom = 0.5;
  EXPECT_TRUE(Handled(alongX, {}, faults).until(0.499).pose.finite());
  EXPECT_FALSE(Handled(alongX, {}, faults).until(0.5).pose.finite());

  faults = {};
  faults.jumpFrom = 0.5;
  Handled jump(alongX, {}, faults);
  const double before = jump.until(0.499).pose.position.x();
  EXPECT_NEAR(jump.until(0.5).pose.position.x() - before, 50.0, 0.1);
  EXPECT_NEAR(jump.device->pose().position.x(), before, 0.1) << "the hand did not jump";

  faults = {};
  faults.repeatFrom = 0.5;
  Handled repeat(alongX, {}, faults);
  const DeviceReading first = repeat.until(0.5);
  const DeviceReading later = repeat.until(0.6);
  EXPECT_EQ(later.time, first.time);
  EXPECT_GT(later.pose.position.x(), first.pose.position.x());

  faults = {};
  faults.backwardFrom = 0.5;
  Handled backward(alongX, {}, faults);
  EXPECT_EQ(backward.until(0.5).time, 0.5);
  EXPECT_NEAR(backward.until(0.6).time, 0.4, 1e-12);

  faults = {};
  faults.stallFrom = 0.5;
  Handled stall(alongX, {}, faults);
  const DeviceReading last = stall.until(0.499);
  const DeviceReading same = stall.until(0.699);
  EXPECT_EQ(same.time, last.time);
  EXPECT_EQ(same.pose.position, last.pose.position);
  EXPECT_NEAR(stall.until(0.701).time, 0.701, 1e-12);

  faults = {};
  faults.unplugAt = 0.5;
  Handled unplug(still, {}, faults);
  EXPECT_EQ(unplug.until(0.499).health, DeviceHealth::Good);
  unplug.device->send({{1, 0, 0}, {0, 0, 0}});
  EXPECT_EQ(unplug.until(0.7).health, DeviceHealth::Disconnected);
  EXPECT_EQ(unplug.device->pose().position, Vector3d(0, 0, 0)) << "its motors are dead";
}

TEST(SimulatedDevice, EachFaultIsSeenByTheGuard)
{
  const auto verdictAt = [](const Faults& faults, double time)
  {
    Handled run(alongX, {}, faults);
    DeviceGuard guard;
    DeviceGuard::Judgement judgement;
    for (int n = 0; n <= static_cast<int>(std::lround(1000.0 * time)); ++n)
      judgement = guard.judge(run.until(0.001 * n), 0.001 * n);
    return judgement;
  };
  EXPECT_EQ(verdictAt({}, 0.5).verdict, DeviceVerdict::Good);
  Faults faults;
  faults.nanFrom = 0.5;
  EXPECT_EQ(verdictAt(faults, 0.5).verdict, DeviceVerdict::NotFinite);
  faults = {};
  faults.jumpFrom = 0.5;
  EXPECT_EQ(verdictAt(faults, 0.5).verdict, DeviceVerdict::Jump);
  EXPECT_EQ(verdictAt(faults, 0.519).verdict, DeviceVerdict::Settling);
  EXPECT_TRUE(verdictAt(faults, 0.52).usable);
  faults = {};
  faults.repeatFrom = 0.5;
  EXPECT_EQ(verdictAt(faults, 0.52).verdict, DeviceVerdict::Repeated);
  EXPECT_EQ(verdictAt(faults, 0.56).verdict, DeviceVerdict::Stale);
  faults = {};
  faults.backwardFrom = 0.5;
  EXPECT_EQ(verdictAt(faults, 0.501).verdict, DeviceVerdict::TimeBackward);
  EXPECT_FALSE(verdictAt(faults, 0.8).usable);
  faults = {};
  faults.stallFrom = 0.5;
  EXPECT_EQ(verdictAt(faults, 0.6).verdict, DeviceVerdict::Stale);
  EXPECT_FALSE(verdictAt(faults, 0.71).usable);
  EXPECT_TRUE(verdictAt(faults, 0.73).usable);
  faults = {};
  faults.unplugAt = 0.5;
  EXPECT_EQ(verdictAt(faults, 0.5).verdict, DeviceVerdict::Disconnected);
}

TEST(SimulatedDevice, RefusesHandsThatMakeNoSense)
{
  const auto refuses = [](double Hand::*value, double is)
  {
    Hand hand;
    hand.*value = is;
    EXPECT_THROW(SimulatedDevice(still, hand, {}), petrous::core::InvalidParameter);
  };
  for (const auto value :
       {&Hand::mass, &Hand::inertia, &Hand::stiffness, &Hand::damping, &Hand::friction,
        &Hand::angularStiffness, &Hand::angularDamping, &Hand::tremor, &Hand::subStep})
  {
    refuses(value, -1.0);
    refuses(value, kNan);
  }
  refuses(&Hand::mass, 0.0);
  refuses(&Hand::inertia, 0.0);
  refuses(&Hand::subStep, 0.02);
  EXPECT_THROW(SimulatedDevice(nullptr, {}, {}), petrous::core::InvalidParameter);
}
