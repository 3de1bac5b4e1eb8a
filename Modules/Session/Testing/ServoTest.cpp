#include <limits>

#include <gtest/gtest.h>

#include "Session.h"
#include "petrous/Core/Error.h"

using namespace petrous::session;
using namespace petrous::session::testing;
using Eigen::Vector3d;
using petrous::haptics::Pose;
using petrous::haptics::ProxyStatus;

namespace
{

const Vector3d kAbove(0.0, 0.0, 5.0);
const Vector3d kPressing(0.0, 0.0, 1.0); // 1 mm into the plane for a ball of 2 mm: 1 N

const Pose kDevicePose{kPressing, Eigen::Quaterniond::Identity()};

void settle(Session& session)
{
  session.go(kAbove, kAbove, 50);
  session.go(kAbove, kPressing, 50);
  session.go(kPressing, kPressing, 150);
}

// The records from `first` on: the force falls to zero without a jump, and stays there.
void expectRampToZero(const Session& session, std::size_t first, std::size_t zeroAfter)
{
  double before = forceOf(session.records[first - 1].output).norm();
  ASSERT_GT(before, 0.5);
  for (std::size_t n = first; n < session.records.size(); ++n)
  {
    const double force = forceOf(session.records[n].output).norm();
    EXPECT_LE(force, before + 1e-12) << n - first;
    EXPECT_LE(before - force, 0.2) << n - first;
    if (n >= first + zeroAfter)
    {
      EXPECT_EQ(force, 0.0) << n - first;
    }
    before = force;
  }
}

} // namespace

TEST(Servo, FeelsThePlaneAsTheCouplingSays)
{
  Session session;
  settle(session);
  const TickRecord& record = session.records.back();
  EXPECT_EQ(faultOf(record), ServoFault::None);
  EXPECT_EQ(toString(record), "");
  EXPECT_NEAR((forceOf(record.wrench) - Vector3d(0.0, 0.0, 1.0)).norm(), 0.0, 1e-12);
  EXPECT_EQ(forceOf(record.output), forceOf(record.wrench));
  EXPECT_NEAR((record.proxy.pose().position - Vector3d(0.0, 0.0, 2.0)).norm(), 0.0, 1e-12);
  EXPECT_EQ(record.mapped.pose().position, kPressing);
  EXPECT_EQ(record.contacts, 1);
  EXPECT_NEAR(record.thrust, 1.0, 1e-12);
  EXPECT_EQ(record.number, session.records.size() - 1);
}

TEST(Servo, KnowsTheToolsPoseWithAValidReadingOnly)
{
  Session session;
  session.health = petrous::haptics::DeviceHealth::NotReady;
  const TickRecord before = session.tick({kAbove, Eigen::Quaterniond::Identity()});
  EXPECT_FALSE(hasToolPose(before)) << "the tool is not placed: it stands at the origin";
  session.health = petrous::haptics::DeviceHealth::Good;
  settle(session);
  EXPECT_TRUE(hasToolPose(session.records.back()));
  TickRecord record = session.records.back();
  record.proxy.rotation[2] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(hasToolPose(record));
  session.health = petrous::haptics::DeviceHealth::Disconnected;
  EXPECT_FALSE(hasToolPose(session.tick(kDevicePose)));
}

TEST(Servo, ReportsRadiusAndElevationOfTheContact)
{
  for (const double elevation : {0.2, 0.7, 1.2})
  {
    Session session;
    // The spindle is tilted from the normal by pi/2 - elevation.
    const Eigen::Quaterniond heading(
        Eigen::AngleAxisd(std::acos(0.0) - elevation, Vector3d(0.6, 0.8, 0.0)));
    session.go(kAbove, kPressing, 50, heading);
    const TickRecord& record = session.go(kPressing, kPressing, 50, heading);
    EXPECT_NEAR(record.elevation, elevation, 1e-9);
    EXPECT_NEAR(record.contactRadius, 2.0 * std::cos(elevation), 1e-9);
  }
}

TEST(Servo, TurnsTheForceToTheDevicesAxes)
{
  Session session;
  // The camera looks along patient x: the device's right is patient y, its up is z.
  petrous::core::CameraPose camera;
  camera.position = {100.0, 0.0, 0.0};
  camera.focalPoint = {0.0, 0.0, 0.0};
  setCamera(session.parameters, camera);
  session.parameters.scale = 0.5;
  session.parameters.forceGain = 2.0;
  session.go({0.0, 10.0, 0.0}, {0.0, 2.0, 0.0}, 100);
  session.go({0.0, 2.0, 0.0}, {0.0, 2.0, 0.0}, 150);
  const TickRecord& record = session.records.back();
  EXPECT_NEAR(forceOf(record.wrench).z(), 1.0, 1e-12);
  EXPECT_NEAR((forceOf(record.output) - Vector3d(0.0, 1.0, 0.0)).norm(), 0.0, 1e-12);
}

TEST(Servo, DrillsByPedalButtonOrKeyAndOnlyWhileAllIsWell)
{
  Session session;
  settle(session);
  EXPECT_FALSE(session.tick(kDevicePose).drill);
  session.pedal = 0.7;
  EXPECT_TRUE(session.tick(kDevicePose).drill);
  session.pedal = 0.0;
  session.parameters.drillButtons = 2;
  session.buttons = 1;
  EXPECT_FALSE(session.tick(kDevicePose).drill);
  session.buttons = 3;
  EXPECT_TRUE(session.tick(kDevicePose).drill);
  session.buttons = 0;
  session.parameters.drill = 1;
  EXPECT_TRUE(session.tick(kDevicePose).drill);
  session.parameters.clutch = 1;
  EXPECT_FALSE(session.tick(kDevicePose).drill);
  session.parameters.clutch = 0;
  session.parameters.pause = 1;
  EXPECT_FALSE(session.tick(kDevicePose).drill);
  session.parameters.pause = 0;
  session.health = petrous::haptics::DeviceHealth::Disconnected;
  EXPECT_FALSE(session.tick(kDevicePose).drill);
}

TEST(Servo, ThePedalsPressureIsTheFractionOfTheSpeed)
{
  TickInput input;
  input.parameters.drillButtons = 2;
  const auto spindle = [&input](double pedal, std::uint32_t buttons = 0)
  {
    input.pedal = pedal;
    input.buttons = buttons;
    EXPECT_EQ(input.drillWanted(), input.spindle() > 0.0) << pedal;
    return input.spindle();
  };
  // As a switch.
  EXPECT_EQ(spindle(0.0), 0.0);
  EXPECT_EQ(spindle(0.49), 0.0);
  EXPECT_EQ(spindle(0.5), 1.0);
  EXPECT_EQ(spindle(0.0, 2), 1.0);
  input.parameters.drill = ServoParameters::kPedalSpeed;
  EXPECT_TRUE(input.parameters.valid());
  EXPECT_EQ(spindle(0.0), 0.0);
  EXPECT_EQ(spindle(0.05), 0.0);
  EXPECT_EQ(spindle(0.37), 0.37);
  EXPECT_EQ(spindle(1.0), 1.0);
  EXPECT_EQ(spindle(0.37, 1), 0.37);
  EXPECT_EQ(spindle(0.37, 2), 1.0);
  input.parameters.drill |= ServoParameters::kDrill;
  EXPECT_EQ(spindle(0.37), 1.0);
  input.parameters.drill = 4;
  EXPECT_FALSE(input.parameters.valid());
}

TEST(Servo, AFootThatTremblesDoesNotSwitchTheDrill)
{
  Session session;
  session.parameters.drill = ServoParameters::kPedalSpeed;
  settle(session);
  int switches = 0;
  bool on = false;
  for (int n = 0; n <= 4000; ++n) // up to 0.2 and down again, with noise
  {
    session.pedal = 0.2 - 0.0001 * std::abs(n - 2000) + (n % 2 ? 0.01 : -0.01);
    const TickRecord& record = session.tick(kDevicePose);
    EXPECT_EQ(record.drill != 0, record.input.spindle() > 0.0);
    switches += (record.drill != 0) != on;
    on = record.drill != 0;
    if (on)
    {
      EXPECT_EQ(record.input.spindle(), session.pedal);
    }
  }
  EXPECT_EQ(switches, 2);
}

// A mouse leaps and is pressed at once: the burr drills where it is pressed, not on its way there.
TEST(Servo, APointerToolDrillsFromItsArrivalOn)
{
  using Parameters = ServoParameters;
  for (const int mode : {int{Parameters::kPointer}, Parameters::kPointer | Parameters::kPressed})
  {
    SCOPED_TRACE(mode);
    ServoSetup setup = Session::plainSetup();
    setup.guard.speed = 1e6; // a pointer's
    Session session(setup);
    session.parameters.constantThrust = static_cast<std::uint8_t>(mode);
    session.parameters.thrust = 1.0;
    session.parameters.approach[2] = -2.0;
    session.go(kAbove, kAbove, 50);
    session.parameters.drill = 1;
    const Vector3d there = kAbove + Vector3d(8.0, 0.0, 0.0);
    bool drilled = false;
    for (int n = 0; n < 1000; ++n)
    {
      const TickRecord& record = session.tick({there, Eigen::Quaterniond::Identity()});
      const double beside = std::abs(record.proxy.pose().position.x() - there.x());
      if (!drilled)
      {
        EXPECT_EQ(record.drill != 0, beside <= 0.5) << n << ": " << beside << " mm";
      }
      drilled = drilled || record.drill;
    }
    EXPECT_TRUE(drilled);
    // In one stroke it cuts wherever it is dragged.
    EXPECT_TRUE(session.tick({kAbove, Eigen::Quaterniond::Identity()}).drill);
    session.parameters.drill = 0;
    session.tick({kAbove, Eigen::Quaterniond::Identity()});
    session.parameters.drill = 1;
    const TickRecord& anew = session.tick({there, Eigen::Quaterniond::Identity()});
    EXPECT_EQ(anew.drill != 0, std::abs(anew.proxy.pose().position.x() - there.x()) <= 0.5);
  }
}

namespace
{

// Held between contacts that alternate from tick to tick, as in a canal of the burr's own width.
class TremblingProxy : public petrous::haptics::Proxy
{
public:
  const Pose& pose() const noexcept override { return m_tick.pose; }
  void place(const Pose& pose) noexcept override { m_at = m_tick.pose = pose; }
  bool placeFree(const Pose&) noexcept override { return false; }
  const petrous::haptics::ProxyTick& step(const Pose&) noexcept override
  {
    m_isAside = !m_isAside;
    m_tick.pose.position = m_at.position + Vector3d(m_isAside ? 0.03 : 0.0, 0.0, 0.0);
    m_tick.status = petrous::haptics::ProxyStatus::Contact;
    m_tick.wrench.linear = Vector3d::UnitZ();
    m_tick.thrust = 1.0;
    m_tick.contactCount = 1;
    m_tick.contacts[0].normal = Vector3d::UnitZ();
    m_tick.contacts[0].thrust = 1.0;
    return m_tick;
  }

private:
  Pose m_at;
  petrous::haptics::ProxyTick m_tick;
  bool m_isAside = false;
};

} // namespace

// The burr, 2 mm in radius, covers what is 1.9 mm beside it, and not what is 2.2 mm beside it.
TEST(Servo, APointerToolThatTremblesInATightPlaceHasArrivedIfItCoversItsTarget)
{
  for (const double beside : {1.9, 2.2})
  {
    TremblingProxy proxy;
    ServoSetup setup = Session::plainSetup();
    setup.guard.speed = 1e6; // a pointer's
    Servo servo(proxy, setup);
    petrous::haptics::DeviceReading reading;
    reading.health = petrous::haptics::DeviceHealth::Good;
    reading.pose.position = kAbove;
    ServoParameters parameters;
    parameters.constantThrust = ServoParameters::kPointer | ServoParameters::kPressed;
    parameters.approach[2] = -2.0;
    bool drills = false;
    for (int n = 1; n <= 1000; ++n)
    {
      reading.time = 0.001 * n;
      if (n > 100)
      {
        reading.pose.position = kAbove + Vector3d(beside, 0.0, 0.0);
        parameters.drill = ServoParameters::kDrill;
      }
      drills = servo.tick(TickInput::of(reading.time, reading, parameters)).drill != 0;
      if (n <= 110)
      {
        EXPECT_FALSE(drills) << n;
      }
    }
    EXPECT_EQ(drills, beside < 2.0);
  }
}

TEST(Servo, ClutchKeepsTheToolWhileTheDeviceGoesAway)
{
  Session session;
  settle(session);
  session.parameters.clutchButtons = 4;
  session.buttons = 4;
  const Vector3d elsewhere(20.0, -10.0, 30.0);
  const Vector3d tool = session.records.back().proxy.pose().position;
  const TickRecord& held = session.go(kPressing, elsewhere, 100);
  EXPECT_LT((held.proxy.pose().position - tool).norm(), 1e-9);
  EXPECT_LT(forceOf(held.output).norm(), 1e-9);
  session.buttons = 0;
  const TickRecord& after = session.go(elsewhere, elsewhere + Vector3d(1.0, 2.0, 3.0), 50);
  EXPECT_LT((after.proxy.pose().position - tool - Vector3d(1.0, 2.0, 3.0)).norm(), 1e-9);
}

TEST(Servo, GivesForceSlowlyAtFirst)
{
  Session session;
  session.go(kPressing, kPressing, 19);
  EXPECT_EQ(faultOf(session.records.back()), ServoFault::Device);
  EXPECT_FALSE(toString(session.records.back()).empty());
  session.go({0.0, 0.0, 2.0}, {0.0, 0.0, 2.0}, 1);
  const std::size_t first = session.records.size();
  session.go({0.0, 0.0, 2.0}, kPressing, 10);
  session.go(kPressing, kPressing, 200);
  for (std::size_t n = first; n < session.records.size(); ++n)
  {
    const double step =
        (forceOf(session.records[n].output) - forceOf(session.records[n - 1].output)).norm();
    EXPECT_LE(step, 0.05);
  }
  EXPECT_NEAR(forceOf(session.records.back().output).z(), 1.0, 1e-9);
}

class ServoFaults : public ::testing::TestWithParam<int>
{
};

// Each fault of a device in contact, for 60 ticks; then it is back, elsewhere.
TEST_P(ServoFaults, EndInASafeForceAndTheSessionGoesOn)
{
  const double nan = std::numeric_limits<double>::quiet_NaN();
  Session session;
  session.pedal = 1.0;
  settle(session);
  const std::size_t first = session.records.size();
  const Vector3d tool = session.records.back().proxy.pose().position;
  for (int n = 0; n < 60; ++n)
  {
    Pose devicePose = kDevicePose;
    session.now += 0.001;
    switch (GetParam())
    {
    case 0: // NaN
      session.deviceTime += 0.001;
      devicePose.position.x() = nan;
      break;
    case 1: // infinite rotation
      session.deviceTime += 0.001;
      devicePose.rotation.w() = std::numeric_limits<double>::infinity();
      break;
    case 2: // jumps of 50 mm back and forth
      session.deviceTime += 0.001;
      devicePose.position.x() += n % 2 ? 50.0 : 0.0;
      devicePose.position.x() += n == 0 ? 50.0 : 0.0;
      break;
    case 3: // time runs backward
      session.deviceTime -= 0.001;
      break;
    case 4: // disconnected
      session.health = petrous::haptics::DeviceHealth::Disconnected;
      break;
    case 5: // an invalid rotation
      session.deviceTime += 0.001;
      devicePose.rotation.coeffs() *= 3.0;
      break;
    default: // a time that is NaN
      session.deviceTime = nan;
    }
    const TickRecord& record = session.tickAsItIs(devicePose);
    EXPECT_EQ(faultOf(record), ServoFault::Device);
    EXPECT_GT(toString(record).size(), 20u);
    EXPECT_FALSE(record.drill);
    EXPECT_TRUE(record.proxy.pose().finite());
    EXPECT_LT((record.proxy.pose().position - tool).norm(), 1e-9);
  }
  expectRampToZero(session, first, 25);

  session.health = petrous::haptics::DeviceHealth::Good;
  session.deviceTime = session.now;
  const Vector3d back(-8.0, 3.0, 12.0);
  session.go(back, back, 30);
  EXPECT_EQ(faultOf(session.records.back()), ServoFault::None);
  EXPECT_TRUE(session.records.back().drill);
  EXPECT_LT((session.records.back().proxy.pose().position - tool).norm(), 1e-9);
  const TickRecord& pressing = session.go(back, back - Vector3d(0.0, 0.0, 2.0), 200);
  EXPECT_NEAR(forceOf(pressing.output).z(), 2.0, 1e-9);
}

INSTANTIATE_TEST_SUITE_P(Device, ServoFaults, ::testing::Range(0, 7));

TEST(Servo, HoldsTheForceThroughTicksWithoutANewReadingUntilTheyAreStale)
{
  Session session;
  settle(session);
  const std::size_t first = session.records.size();
  for (int n = 0; n < 200; ++n)
  {
    session.now += 0.001;
    session.tickAsItIs(kDevicePose);
  }
  EXPECT_EQ(faultOf(session.records[first + 40]), ServoFault::None);
  EXPECT_NEAR(forceOf(session.records[first + 40].output).z(), 1.0, 1e-9);
  EXPECT_EQ(faultOf(session.records[first + 60]), ServoFault::Device);
  EXPECT_EQ(forceOf(session.records.back().output).norm(), 0.0);
}

TEST(Servo, TakesTheToolUpAnewAfterAStall)
{
  Session session;
  session.pedal = 1.0;
  settle(session);
  const Vector3d tool = session.records.back().proxy.pose().position;
  // The device moved 8 mm deeper while the machine was suspended.
  const Vector3d deeper = kPressing - Vector3d(0.0, 0.0, 8.0);
  const TickRecord stalled = session.tick({deeper, Eigen::Quaterniond::Identity()}, 0.2);
  EXPECT_EQ(faultOf(stalled), ServoFault::Stalled);
  EXPECT_GT(toString(stalled).size(), 20u);
  EXPECT_FALSE(stalled.drill);
  EXPECT_LE(forceOf(stalled.output).norm(), 1.0 + 1e-12);
  session.go(deeper, deeper, 50);
  EXPECT_EQ(faultOf(session.records.back()), ServoFault::None);
  EXPECT_LT((session.records.back().proxy.pose().position - tool).norm(), 1e-9);
  EXPECT_LT(forceOf(session.records.back().output).norm(), 1e-9);
}

TEST(Servo, GivesNoForceWhileItsOwnClockRunsBack)
{
  Session session;
  settle(session);
  for (int n = 0; n < 40; ++n)
  {
    session.now -= 0.0005;
    session.deviceTime += 1e-6;
    EXPECT_EQ(faultOf(session.tickAsItIs(kDevicePose)), ServoFault::Clock);
  }
  EXPECT_EQ(forceOf(session.records.back().output).norm(), 0.0);
  EXPECT_GT(toString(session.records.back()).size(), 20u);
  session.go(kPressing, kPressing, 1);
  EXPECT_EQ(faultOf(session.records.back()), ServoFault::None);
}

TEST(Servo, GivesNoForceWithASettingOutOfItsRange)
{
  Session session;
  settle(session);
  const std::size_t first = session.records.size();
  session.parameters.scale = std::numeric_limits<double>::quiet_NaN();
  session.go(kPressing, kPressing, 60);
  EXPECT_EQ(faultOf(session.records.back()), ServoFault::Parameters);
  EXPECT_GT(toString(session.records.back()).size(), 20u);
  expectRampToZero(session, first, 25);
  session.parameters.scale = 1.0;
  session.go(kPressing, kPressing, 1);
  session.go(kPressing, kPressing - Vector3d(0.0, 0.0, 1.0), 200);
  EXPECT_EQ(faultOf(session.records.back()), ServoFault::None);
  EXPECT_NEAR(forceOf(session.records.back().output).z(), 1.0, 1e-9);
}

TEST(Servo, PausesAndComesBackSlowly)
{
  Session session;
  settle(session);
  const std::size_t first = session.records.size();
  session.parameters.pause = 1;
  session.go(kPressing, kPressing, 60);
  expectRampToZero(session, first, 25);
  session.parameters.pause = 0;
  const std::size_t again = session.records.size();
  session.go(kPressing, kPressing, 200);
  EXPECT_LT(forceOf(session.records[again + 10].output).z(), 0.2);
  EXPECT_NEAR(forceOf(session.records.back().output).z(), 1.0, 1e-9);
}

TEST(Servo, StartsInsideBoneWithoutForceUntilItIsDrawnOut)
{
  Session session;
  session.pedal = 1.0;
  const Vector3d deep(0.0, 0.0, -6.0);
  session.go(deep, deep, 100);
  session.go(deep, {0.0, 0.0, 1.9}, 100);
  for (std::size_t n = 20; n < session.records.size(); ++n)
  {
    EXPECT_EQ(faultOf(session.records[n]), ServoFault::Inside);
    EXPECT_EQ(session.records[n].status, static_cast<std::uint8_t>(ProxyStatus::Inside));
    EXPECT_EQ(forceOf(session.records[n].output).norm(), 0.0);
    EXPECT_FALSE(session.records[n].drill);
  }
  EXPECT_GT(toString(session.records.back()).size(), 20u);
  session.go({0.0, 0.0, 1.9}, kAbove, 100);
  session.go(kAbove, kPressing, 300);
  EXPECT_NEAR(forceOf(session.records.back().output).z(), 1.0, 1e-9);
}

TEST(Servo, FeelsNothingInAnEmptyVolume)
{
  Session session;
  session.proxy.absent = true;
  session.pedal = 1.0;
  session.go(kAbove, {0.0, 0.0, -40.0}, 200);
  const TickRecord& record = session.records.back();
  EXPECT_EQ(faultOf(record), ServoFault::None);
  EXPECT_EQ(forceOf(record.output).norm(), 0.0);
  EXPECT_EQ(record.thrust, 0.0);
  EXPECT_LT((record.proxy.pose().position - Vector3d(0.0, 0.0, -40.0)).norm(), 1e-12);
}

TEST(Servo, NeverSendsMoreThanTheLimits)
{
  ServoSetup setup = Session::plainSetup();
  setup.limits.maxForce = 3.3;
  Session session(setup);
  session.go(kAbove, {0.0, 0.0, -20.0}, 300);
  session.go({0.0, 0.0, -20.0}, {0.0, 0.0, -20.0}, 100);
  for (const TickRecord& record : session.records)
    EXPECT_LE(forceOf(record.output).norm(), 3.3 + 1e-12);
  EXPECT_NEAR(forceOf(session.records.back().wrench).z(), 22.0, 1e-9);
  EXPECT_NEAR(forceOf(session.records.back().output).z(), 3.3, 1e-12);
}

TEST(Servo, GivesTheSameRecordsForTheSameInputs)
{
  const auto run = []
  {
    Session session;
    session.pedal = 1.0;
    settle(session);
    session.health = petrous::haptics::DeviceHealth::Disconnected;
    session.go(kPressing, kPressing, 30);
    session.health = petrous::haptics::DeviceHealth::Good;
    session.go(kPressing, {3.0, 2.0, 0.3}, 100);
    return session.records;
  };
  const auto a = run();
  const auto b = run();
  for (std::size_t n = 0; n < a.size(); ++n)
    EXPECT_TRUE(identical(a[n], b[n])) << n;
}

TEST(Servo, RefusesASetupThatCannotBe)
{
  PlaneProxy proxy;
  ServoSetup setup;
  setup.stiffness = 0.0;
  EXPECT_THROW(Servo(proxy, setup), petrous::core::InvalidParameter);
  setup = {};
  setup.center.x() = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(Servo(proxy, setup), petrous::core::InvalidParameter);
  setup = {};
  setup.stallAfter = 0.0;
  EXPECT_THROW(Servo(proxy, setup), petrous::core::InvalidParameter);
}
