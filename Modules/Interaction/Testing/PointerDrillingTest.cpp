#include <gtest/gtest.h>

#include "Tissue.h"
#include "petrous/Haptics/ConstrainedProxy.h"
#include "petrous/Interaction/PointerAim.h"
#include "petrous/Interaction/PointerDevice.h"
#include "petrous/Simulation/Servo.h"

using namespace petrous;
using namespace petrous::interaction;
using namespace petrous::interaction::testing;
using Eigen::Vector3d;
using Mode = AimSettings::Mode;
using simulation::ServoFault;
using simulation::TickRecord;

namespace
{

constexpr double kRadius = 2.0;
constexpr double kVoxel = 0.5;
const Vector3d kEye(0.0, 0.0, 150.0);
const Vector3d kCenter(40.0, -40.0, 40.0); // of the device

SightLine through(const Vector3d& point)
{
  return {kEye, (point - kEye).normalized()};
}

/// A pointer, a servo and a block of bone below z = 0: 1000 ticks a second, a frame every 16.
class Session
{
public:
  explicit Session(Mode mode)
    : proxy(haptic(*tissue), haptics::makeBurrShell(shape(), kVoxel, 700))
    , servo(proxy, setup(proxy))
    , device(kCenter)
    , aim([this](const SightLine& line) { return firstTissue(*tissue, line); }, settings(mode))
  {
    core::CameraPose camera;
    camera.position = kEye;
    camera.focalPoint = {0.0, 0.0, 0.0};
    camera.viewUp = {0.0, 1.0, 0.0};
    aim.setCamera(camera);
  }

  const TickRecord& run(int ticks)
  {
    for (int n = 0; n < ticks; ++n)
    {
      if (n % 16 == 0)
        frame();
      now += 0.001;
      record = servo.tick(simulation::TickInput::of(now, device.read(now), parameters));
    }
    return record;
  }

  Vector3d tool() const { return record.proxy.pose().position; }
  Vector3d force() const { return record.wrench.wrench().linear; }
  ServoFault fault() const { return static_cast<ServoFault>(record.fault); }

  std::shared_ptr<const volume::TissueField> tissue = block();
  haptics::ConstrainedProxy proxy;
  simulation::Servo servo;
  PointerDevice device;
  PointerAim aim;
  simulation::ServoParameters parameters;
  double now = 10.0;

private:
  static haptics::BurrShape shape()
  {
    haptics::BurrShape burr;
    burr.radius = kRadius;
    return burr;
  }
  static AimSettings settings(Mode mode)
  {
    AimSettings settings;
    settings.mode = mode;
    settings.burrRadius = kRadius;
    return settings;
  }
  static std::shared_ptr<const haptics::HapticField> haptic(const volume::TissueField& tissue)
  {
    return std::make_shared<haptics::HapticField>(
        tissue, std::make_shared<volume::PublishedMask>(volume::CutMask(tissue.geometry())));
  }
  static simulation::ServoSetup setup(const haptics::ConstrainedProxy& tool)
  {
    simulation::ServoSetup setup;
    setup.limits.maxForce = 10.0;
    setup.limits.maxTorque = 500.0;
    setup.burrPoints = tool.shell().burrCount;
    setup.center = kCenter;
    return setup;
  }
  void frame()
  {
    aim.see(record, device.see(record));
    aim.update();
    if (aim.wanted())
      device.want(*aim.wanted());
    device.setButtons(aim.buttons());
    aim.apply(parameters);
  }

  TickRecord record;
};

double besideLine(const Vector3d& point, const SightLine& line)
{
  return (point - line.origin).cross(line.direction).norm();
}

} // namespace

TEST(PointerDrilling, HoversOverTheBoneWithoutForce)
{
  Session session(Mode::Surface);
  const SightLine line = through({3.0, -2.0, 0.0});
  session.aim.point(line);
  const TickRecord& record = session.run(300);
  EXPECT_EQ(session.fault(), ServoFault::None);
  EXPECT_EQ(session.force().norm(), 0.0);
  EXPECT_EQ(record.drill, 0);
  EXPECT_NEAR(session.tool().z(), kRadius + 1.0, 0.01);
  EXPECT_LT(besideLine(session.tool(), line), 0.01);
}

TEST(PointerDrilling, DrillsWithTheSetThrustUnderThePointer)
{
  for (const double thrust : {0.4, 1.0, 2.0})
  {
    Session session(Mode::Surface);
    AimSettings settings = session.aim.settings();
    settings.thrust = thrust;
    session.aim.setSettings(settings);
    const SightLine line = through({3.0, -2.0, 0.0});
    session.aim.point(line);
    session.run(100);
    session.aim.press(PointerAim::Press::Drill);
    const TickRecord& record = session.run(500);
    EXPECT_EQ(session.fault(), ServoFault::None);
    EXPECT_EQ(record.drill, 1);
    EXPECT_NEAR(record.thrust, thrust, 0.02 * thrust);
    EXPECT_NEAR(session.force().z(), thrust, 0.02 * thrust);
    EXPECT_NEAR(session.tool().z(), kRadius, 0.05 * kVoxel);
    EXPECT_LT(besideLine(session.tool(), line), 0.1);

    session.aim.press(PointerAim::Press::None);
    session.run(300);
    EXPECT_EQ(session.force().norm(), 0.0);
    EXPECT_NEAR(session.tool().z(), kRadius + 1.0, 0.02);
  }
}

TEST(PointerDrilling, FollowsThePointerOverTheBoneWhileItDrills)
{
  Session session(Mode::Surface);
  session.aim.point(through({-5.0, 0.0, 0.0}));
  session.run(100);
  session.aim.press(PointerAim::Press::Drill);
  session.run(200);
  for (int n = 0; n <= 50; ++n)
  {
    session.aim.point(through({-5.0 + 0.2 * n, 0.1 * n, 0.0}));
    session.run(16); // 12.5 mm/s
    EXPECT_NEAR(session.tool().z(), kRadius, 0.05 * kVoxel) << n;
    EXPECT_EQ(session.fault(), ServoFault::None);
  }
  session.run(300);
  EXPECT_LT(besideLine(session.tool(), through({5.0, 5.0, 0.0})), 0.1);
}

TEST(PointerDrilling, PressesByTheWheelAsTheCouplingSays)
{
  Session session(Mode::Depth);
  session.aim.point(through({0.0, 0.0, 0.0}));
  session.run(100);
  EXPECT_EQ(session.force().norm(), 0.0);
  session.aim.wheel(10.0, false); // 2.5 mm: 1 mm of air, then 1.5 N at 1 N/mm
  const TickRecord& record = session.run(400);
  EXPECT_NEAR(session.force().z(), 1.5, 0.02);
  EXPECT_NEAR(session.force().head<2>().norm(), 0.0, 0.02);
  EXPECT_NEAR(session.tool().z(), kRadius, 0.05 * kVoxel);
  EXPECT_EQ(record.drill, 0);
}

TEST(PointerDrilling, ComesBackUnderThePointerAfterAStall)
{
  Session session(Mode::Depth);
  session.aim.point(through({0.0, 0.0, 0.0}));
  session.run(100);
  session.aim.wheel(10.0, false);
  session.run(300);
  session.now += 0.3; // the machine slept; the tool is taken up where it is, without force
  session.run(1);
  EXPECT_EQ(session.fault(), ServoFault::Stalled);
  const SightLine line = through({4.0, 3.0, 0.0});
  session.aim.point(line);
  session.run(400);
  EXPECT_EQ(session.fault(), ServoFault::None);
  EXPECT_LT(besideLine(session.tool(), line), 0.02);
  EXPECT_LT(session.force().norm(), 0.05);
  session.aim.wheel(4.0, false);
  session.run(300);
  EXPECT_NEAR(session.force().z(), 1.0, 0.05);
}
