#include <random>

#include <gtest/gtest.h>

#include "Tissue.h"
#include "petrous/Haptics/ConstrainedProxy.h"
#include "petrous/Interaction/PointerDevice.h"
#include "petrous/Interaction/PointerToolController.h"
#include "petrous/Session/Servo.h"

using namespace petrous;
using namespace petrous::interaction;
using namespace petrous::interaction::testing;
using Eigen::Vector3d;
using Mode = AimSettings::Mode;
using session::ServoFault;
using session::TickRecord;

namespace
{

constexpr double kRadius = 2.0;
constexpr double kVoxel = 0.5;
const Vector3d kEye(0.0, 0.0, 150.0);
const Vector3d kCenter(40.0, -40.0, 40.0); // of the device

PickRay through(const Vector3d& point)
{
  return {kEye, (point - kEye).normalized()};
}

/// A pointer, a servo and a block of bone below z = 0: 1000 ticks per second, one frame per 16.
class Session
{
public:
  explicit Session(Mode mode, std::shared_ptr<const volume::TissueField> bone = block(),
                   double radius = kRadius)
    : tissue(std::move(bone))
    , proxy(haptic(*tissue), haptics::makeBurrShell(shape(radius), kVoxel, 700))
    , servo(proxy, setup(proxy))
    , device(kCenter)
    , aim([this](const PickRay& line) { return firstTissue(*tissue, line); },
          settings(mode, radius))
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
      record = servo.tick(session::TickInput::of(now, device.read(now), parameters));
    }
    return record;
  }

  Vector3d tool() const { return record.proxy.pose().position; }
  Vector3d force() const { return record.wrench.wrench().linear; }
  ServoFault fault() const { return static_cast<ServoFault>(record.fault); }

  std::shared_ptr<const volume::TissueField> tissue;
  haptics::ConstrainedProxy proxy;
  session::Servo servo;
  PointerDevice device;
  PointerToolController aim;
  session::ServoParameters parameters;
  double now = 10.0;

private:
  static haptics::BurrShape shape(double radius)
  {
    haptics::BurrShape burr;
    burr.radius = radius;
    return burr;
  }
  static AimSettings settings(Mode mode, double radius)
  {
    AimSettings settings;
    settings.mode = mode;
    settings.burrRadius = radius;
    return settings;
  }
  static std::shared_ptr<const haptics::HapticField> haptic(const volume::TissueField& tissue)
  {
    return std::make_shared<haptics::HapticField>(
        tissue, std::make_shared<volume::PublishedMask>(volume::CutMask(tissue.geometry())));
  }
  static session::ServoSetup setup(const haptics::ConstrainedProxy& tool)
  {
    session::ServoSetup setup;
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
    parameters.pause = 0;
    aim.apply(parameters);
  }

public:
  TickRecord record;
};

// Drills a hole at `mouth`, then releases the button.
void drillInto(Session& session, const Vector3d& mouth)
{
  session.aim.point(through(mouth));
  session.run(100);
  session.aim.press(PointerToolController::Press::Drill);
  session.run(600);
  ASSERT_LT(session.tool().z(), -2.5);
  session.aim.press(PointerToolController::Press::None);
}

double besideLine(const Vector3d& point, const PickRay& line)
{
  return (point - line.origin).cross(line.direction).norm();
}

} // namespace

TEST(PointerDrilling, HoversOverTheBoneWithoutForce)
{
  Session session(Mode::Surface);
  const PickRay line = through({3.0, -2.0, 0.0});
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
    const PickRay line = through({3.0, -2.0, 0.0});
    session.aim.point(line);
    session.run(100);
    session.aim.press(PointerToolController::Press::Drill);
    const TickRecord& record = session.run(500);
    EXPECT_EQ(session.fault(), ServoFault::None);
    EXPECT_EQ(record.drill, 1);
    EXPECT_NEAR(record.thrust, thrust, 0.02 * thrust);
    EXPECT_NEAR(session.force().z(), thrust, 0.02 * thrust);
    EXPECT_NEAR(session.tool().z(), kRadius, 0.05 * kVoxel);
    EXPECT_LT(besideLine(session.tool(), line), 0.1);

    session.aim.press(PointerToolController::Press::None);
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
  session.aim.press(PointerToolController::Press::Drill);
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
  session.now += 0.3; // after a suspend: the tool is re-anchored where it is, without force
  session.run(1);
  EXPECT_EQ(session.fault(), ServoFault::Stalled);
  const PickRay line = through({4.0, 3.0, 0.0});
  session.aim.point(line);
  session.run(400);
  EXPECT_EQ(session.fault(), ServoFault::None);
  EXPECT_LT(besideLine(session.tool(), line), 0.02);
  EXPECT_LT(session.force().norm(), 0.05);
  session.aim.wheel(4.0, false);
  session.run(300);
  EXPECT_NEAR(session.force().z(), 1.0, 0.05);
}

// A ball of 3 mm on the rim of a hole of 2.25 mm has its centre sqrt(3^2 - 2.25^2) above it.
TEST(PointerDrilling, ALargerBurrComesFreeOnTheLineOfSightWhereTheSmallerOneWas)
{
  const auto bone = blockWithHole(-4.0, 0.0, 2.25, 4.0);
  const PickRay line = through({-4.0, 0.0, 0.0});
  for (const Mode mode : {Mode::Surface, Mode::Depth})
  {
    Session small(Mode::Surface, bone);
    drillInto(small, {-4.0, 0.0, 0.0});
    for (const double radius : {3.0, kRadius})
    {
      SCOPED_TRACE(radius);
      Session next(mode, bone, radius);
      next.aim.point(line);
      next.aim.see(small.record, false);
      next.aim.resume();
      const TickRecord& record = next.run(100);
      EXPECT_EQ(next.fault(), ServoFault::None);
      EXPECT_EQ(record.drill, 0);
      EXPECT_LT(besideLine(next.tool(), line), 0.15);
      if (radius != kRadius)
      {
        EXPECT_GT(next.tool().z(), std::sqrt(9.0 - 2.25 * 2.25) - kVoxel);
        if (mode == Mode::Depth)
        {
          EXPECT_LT(next.tool().z(), small.tool().z() + 8.05) << "four steps back";
        }
      }
      else if (mode == Mode::Depth)
      {
        EXPECT_GT(next.tool().z(), small.tool().z() - 0.05);
        // Its own hole is tight about it, so that the first step may not be free.
        EXPECT_LT(next.tool().z(), small.tool().z() + 2.05) << "two steps back at most";
        EXPECT_EQ(next.force().norm(), 0.0);
      }
      next.run(400);
      EXPECT_EQ(next.fault(), ServoFault::None);
    }
  }
}

// The burr is in a hole of its own size; without the button the pointer is free to leave.
TEST(PointerDrilling, ComesOutOfItsHoleByTheLineOfSightAndGoesOn)
{
  for (const double way : {4.0, 7.0, 9.5})
  {
    SCOPED_TRACE(way);
    const Vector3d mouth(-4.0, 0.0, 0.0);
    Session session(Mode::Surface, blockWithHole(-4.0, 0.0, 2.25, 4.0));
    drillInto(session, mouth);
    const PickRay line = through({way - 4.0, 1.0, 0.0});
    session.aim.point(line);
    double highest = -10.0;
    for (int n = 0; n < 800; ++n)
    {
      session.run(1);
      EXPECT_LE(session.force().norm(), session.aim.settings().thrust);
      EXPECT_EQ(session.fault(), ServoFault::None) << n;
      highest = std::max(highest, session.tool().z());
    }
    EXPECT_LT(besideLine(session.tool(), line), 0.2);
    EXPECT_NEAR(session.tool().z(), kRadius + 1.0, 0.1);
    EXPECT_LT(highest, kRadius + 3.0); // lifts without overshooting
    EXPECT_EQ(session.force().norm(), 0.0);
  }
}

TEST(PointerDrilling, ThePointerAtTheMenuPullsNoHarderThanTheThrust)
{
  Session session(Mode::Surface, blockWithHole(-4.0, 0.0, 2.25, 4.0));
  drillInto(session, {-4.0, 0.0, 0.0});
  session.aim.point(through({60.0, 80.0, 0.0})); // no tissue there
  for (int n = 0; n < 1500; ++n)
  {
    session.run(1);
    ASSERT_LE(session.force().norm(), session.aim.settings().thrust) << n;
    ASSERT_EQ(session.fault(), ServoFault::None) << n;
  }
  EXPECT_LT(besideLine(session.tool(), through({60.0, 80.0, 0.0})), session::Servo::kFarthest);
}

// Dragging with the button pressed over the rim of a cavity, in which the shaft holds the tool.
TEST(PointerDrilling, TheForceIsTheThrustWhereverAPressedPointerGoes)
{
  Session session(Mode::Surface, blockWithHole(-4.0, 0.0, 2.25, 4.0));
  drillInto(session, {-4.0, 0.0, 0.0});
  session.aim.press(PointerToolController::Press::Drill);
  for (int n = 0; n < 60; ++n)
  {
    session.aim.point(through({-4.0 + 0.2 * n, 0.1 * n, 0.0}));
    for (int tick = 0; tick < 16; ++tick)
    {
      session.run(1);
      ASSERT_LE(session.force().norm(), 1.0 + 1e-9) << n;
      ASSERT_EQ(session.fault(), ServoFault::None) << n;
    }
  }
  session.run(500);
  EXPECT_LT(besideLine(session.tool(), through({-4.0 + 0.2 * 59, 5.9, 0.0})), 0.5);
}

// For a tool placed where shaft and handpiece do not fit, or in tissue.
TEST(PointerDrilling, IsNeverPutIntoTissueByAPointer)
{
  Session session(Mode::Surface);
  AimSettings settings = session.aim.settings();
  settings.tilt = 80.0; // the shaft is nearly parallel to the bone, the handpiece below its surface
  session.aim.setSettings(settings);
  std::mt19937 random(3);
  std::uniform_real_distribution<double> anywhere(-9.0, 9.0), angle(-180.0, 180.0);
  session.aim.point(through({9.0, 0.0, 0.0}));
  session.run(50); // until the device counts as valid
  for (int n = 0; n < 30; ++n)
  {
    settings.turn = angle(random);
    settings.tilt = 80.0 * (n % 3) / 2.0;
    session.aim.setSettings(settings);
    session.aim.point(through({anywhere(random), anywhere(random), 0.0}));
    session.aim.press(n % 4 == 3 ? PointerToolController::Press::Drill
                                 : PointerToolController::Press::None);
    for (int tick = 0; tick < 150; ++tick)
    {
      session.run(1);
      ASSERT_EQ(session.fault(), ServoFault::None) << n << ' ' << tick;
      ASSERT_LE(session.force().norm(), 1.0 + 1e-9) << n;
    }
  }
}

TEST(PointerDrilling, ATwistedHoleLetsTheToolGoInTheEnd)
{
  // The hole runs under the bone, seen from the camera: no way out along the line of sight.
  const auto bone = boneOf(
      [](const Vector3d& p)
      {
        const Vector3d along = Vector3d(1.0, 0.0, -1.0).normalized();
        const Vector3d mouth(-6.0, 0.0, 0.0);
        const double t = std::clamp(along.dot(p - mouth), -100.0, 7.0);
        return std::min(-p.z(), (p - mouth - t * along).norm() - 2.25);
      });
  Session session(Mode::Surface, bone);
  const Vector3d end = Vector3d(-6.0, 0.0, 0.0) + 7.0 * Vector3d(1.0, 0.0, -1.0).normalized();
  session.aim.point(through({-6.0, 0.0, 0.0}));
  session.run(50);
  ASSERT_TRUE(session.proxy.placeFree(
      {end, Eigen::Quaterniond::FromTwoVectors(Vector3d::UnitZ(), Vector3d(-1.0, 0.0, 1.0))}));
  const PickRay line = through({6.0, 3.0, 0.0});
  session.aim.point(line);
  for (int n = 0; n < 4000; ++n)
  {
    session.run(1);
    ASSERT_LE(session.force().norm(), 1.0 + 1e-9) << n;
    ASSERT_EQ(session.fault(), ServoFault::None) << n;
  }
  EXPECT_LT(besideLine(session.tool(), line), 0.2);
}

// Over an edge of bone with the button pressed: it used to drill the floor below in the same
// stroke.
TEST(PointerDrilling, DoesNotFallOverAnEdgeWhileItDrills)
{
  const auto bone = boneOf([](const Vector3d& p) { return (p.x() < 0.0 ? 5.0 : -9.0) - p.z(); });
  Session session(Mode::Surface, bone);
  session.aim.point(through({-4.0, 0.0, 0.0}));
  session.run(100);
  session.aim.press(PointerToolController::Press::Drill);
  EXPECT_EQ(session.run(300).drill, 1);
  for (int n = 0; n < 60; ++n)
  {
    session.aim.point(through({-4.0 + 0.15 * n, 0.0, 0.0}));
    session.run(16);
    EXPECT_GT(session.tool().z(), 2.0) << n;
  }
  EXPECT_EQ(session.run(300).drill, 0);
  EXPECT_EQ(session.force().norm(), 0.0);
  session.aim.press(PointerToolController::Press::None); // pressed again, it goes down
  session.run(300);
  session.aim.press(PointerToolController::Press::Drill);
  EXPECT_EQ(session.run(500).drill, 1);
  EXPECT_LT(session.tool().z(), kRadius - 8.0);
}

// In depth mode: from a ray that grazes the bone, where the ball does not fit at its position, and
// from a position that the pointer has left.
TEST(PointerDrilling, AWheelsToolBeginsBeforeTheBone)
{
  // A slope of 78 degrees, viewed from above.
  const auto bone = boneOf([](const Vector3d& p) { return -0.2 * p.z() - 0.98 * p.x(); });
  for (const double x : {-1.5, -0.5, 0.5, 1.5})
  {
    SCOPED_TRACE(x);
    Session session(Mode::Depth, bone);
    session.aim.point(through({x, 0.0, 0.0}));
    for (int n = 0; n < 300; ++n)
    {
      session.run(1);
      ASSERT_NE(session.fault(), ServoFault::Inside) << n;
    }
    EXPECT_EQ(session.force().norm(), 0.0);
    const Vector3d begun = session.tool();
    for (int n = 0; n < 40; ++n) // the pointer moves over the bone
    {
      session.aim.point(through({x - 0.15 * n, 0.0, 0.0}));
      session.run(16);
      ASSERT_NE(session.fault(), ServoFault::Inside) << n;
      ASSERT_TRUE(session.proxy.placeFree(session.record.proxy.pose())) << n;
    }
    EXPECT_GT(session.tool().z(), begun.z() - 1.0);
  }
}
