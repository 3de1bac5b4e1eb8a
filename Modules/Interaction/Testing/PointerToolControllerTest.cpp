#include "petrous/Interaction/PointerToolController.h"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "Tissue.h"
#include "petrous/Core/Error.h"
#include "petrous/Haptics/PointShell.h"
#include "petrous/Interaction/PointerDevice.h"

using namespace petrous;
using namespace petrous::interaction;
using namespace petrous::interaction::testing;
using Eigen::Vector3d;
using Mode = AimSettings::Mode;
using Press = PointerToolController::Press;
using Parameters = session::ServoParameters;

namespace
{

constexpr double kPi = 3.14159265358979323846;
constexpr double kDegree = kPi / 180.0;

// From 200 mm above the origin; right is x, up is y.
core::CameraPose fromAbove()
{
  core::CameraPose camera;
  camera.position = {0.0, 0.0, 200.0};
  camera.focalPoint = {0.0, 0.0, 0.0};
  camera.viewUp = {0.0, 1.0, 0.0};
  return camera;
}

PickRay through(const Vector3d& point)
{
  const Vector3d eye = fromAbove().position;
  return {eye, (point - eye).normalized()};
}

AimSettings inMode(Mode mode)
{
  AimSettings settings;
  settings.mode = mode;
  return settings;
}

PointerToolController aimAt(const PickRay& line, Mode mode, TissueQuery surface = plane(0.0))
{
  PointerToolController aim(std::move(surface), inMode(mode));
  aim.setCamera(fromAbove());
  aim.point(line);
  return aim;
}

Vector3d place(const PointerToolController& aim)
{
  return aim.wanted()->position;
}

Vector3d shaft(const PointerToolController& aim)
{
  return aim.wanted()->rotation * Vector3d::UnitZ();
}

session::TickRecord recordAt(const Vector3d& tool)
{
  session::TickRecord record;
  record.proxy = session::PoseValues::of({tool, Eigen::Quaterniond::Identity()});
  return record;
}

double distanceToLine(const Vector3d& point, const PickRay& line)
{
  return (point - line.origin).cross(line.direction).norm();
}

void expectNear(const Vector3d& one, const Vector3d& other, double tolerance = 1e-9)
{
  EXPECT_LT((one - other).norm(), tolerance) << one.transpose() << " / " << other.transpose();
}

} // namespace

TEST(PointerToolController, WantsNothingBeforeItIsPointed)
{
  PointerToolController aim(plane(0.0));
  aim.press(Press::Drill);
  aim.wheel(1.0, false);
  aim.nudge(1.0, 0.0, false);
  EXPECT_FALSE(aim.wanted());
}

TEST(PointerToolController, HoversBeforeTheTissueUnderThePointer)
{
  const Vector3d target(30.0, -20.0, 0.0);
  const PickRay line = through(target);
  const PointerToolController aim = aimAt(line, Mode::Surface);
  EXPECT_TRUE(aim.meetsTissue());
  EXPECT_LT(distanceToLine(place(aim), line), 1e-9);
  EXPECT_NEAR((target - place(aim)).norm(), 2.0 + 1.0, 1e-9); // radius and lift
  EXPECT_LT((place(aim) - line.origin).norm(), (target - line.origin).norm());
}

TEST(PointerToolController, PressesAlongTheLineOfSightByConstantThrust)
{
  const Vector3d target(30.0, -20.0, 0.0);
  PointerToolController aim = aimAt(through(target), Mode::Surface);
  session::ServoParameters parameters;
  aim.apply(parameters);
  EXPECT_EQ(parameters.constantThrust, Parameters::kPointer);
  EXPECT_EQ(aim.buttons(), 0U);

  aim.press(Press::Drill);
  EXPECT_NEAR((target - place(aim)).norm(), 2.0, 1e-9);
  aim.apply(parameters);
  EXPECT_EQ(parameters.constantThrust, Parameters::kPointer | Parameters::kPressed);
  EXPECT_EQ(parameters.thrust, 1.0);
  // From the burr's position to the target, away from the camera.
  expectNear(Vector3d(parameters.approach), target - place(aim));
  EXPECT_EQ(aim.buttons() & parameters.drillButtons, PointerDevice::kDrill);
  EXPECT_TRUE(parameters.valid());

  aim.press(Press::Touch);
  aim.apply(parameters);
  EXPECT_EQ(parameters.constantThrust, Parameters::kPointer | Parameters::kPressed);
  EXPECT_EQ(aim.buttons(), 0U);
}

TEST(PointerToolController, GivesTheServoThePatientsAxes)
{
  session::ServoParameters parameters;
  parameters.scale = 0.5;
  parameters.camera[0] = 0.0;
  parameters.camera[2] = 1.0;
  parameters.forceGain = 3.0;
  aimAt(through({1.0, 2.0, 0.0}), Mode::Depth).apply(parameters);
  EXPECT_EQ(parameters.scale, 1.0);
  EXPECT_EQ(parameters.camera[0], 1.0);
  EXPECT_EQ(parameters.camera[2], 0.0);
  EXPECT_EQ(parameters.forceGain, 3.0);
  EXPECT_EQ(parameters.constantThrust, 0);
  EXPECT_EQ(parameters.driftLimit, 5.0F); // lateral pointer motion presses no harder than the wheel
}

TEST(PointerToolController, KeepsItsDepthPastTheEdgeOfTheTissue)
{
  // Tissue for x < 10 only.
  const auto ledge = [](const PickRay& line) -> std::optional<double>
  {
    const auto hit = plane(0.0)(line);
    return hit && line.at(*hit).x() < 10.0 ? hit : std::nullopt;
  };
  PointerToolController aim = aimAt(through({9.0, 0.0, 0.0}), Mode::Surface, ledge);
  aim.press(Press::Drill);
  const double height = place(aim).z();
  const PickRay beyond = through({25.0, 5.0, 0.0});
  aim.point(beyond);
  EXPECT_FALSE(aim.meetsTissue());
  EXPECT_NEAR(place(aim).z(), height, 1e-9);
  EXPECT_LT(distanceToLine(place(aim), beyond), 1e-9);
  session::ServoParameters parameters;
  aim.apply(parameters);
  EXPECT_EQ(parameters.constantThrust, Parameters::kPointer); // it would fall
  aim.point(through({5.0, 0.0, 0.0}));
  aim.apply(parameters);
  EXPECT_EQ(parameters.constantThrust, Parameters::kPointer | Parameters::kPressed);
}

// Bone at 0 for x < 10, and another surface far below it.
TEST(PointerToolController, LiftsWhereTheDepthLeapsUnderAPressedPointer)
{
  const auto ledge = [](double low)
  {
    return [low](const PickRay& line) -> std::optional<double>
    {
      const auto hit = plane(0.0)(line);
      return hit && line.at(*hit).x() < 10.0 ? hit : plane(low)(line);
    };
  };
  for (const Press press : {Press::Drill, Press::Touch})
  {
    PointerToolController aim = aimAt(through({9.0, 0.0, 0.0}), Mode::Surface, ledge(-60.0));
    aim.press(press);
    const double height = place(aim).z();
    const PickRay beyond = through({14.0, 0.0, 0.0});
    aim.point(beyond);
    EXPECT_TRUE(aim.lifted());
    EXPECT_NEAR(place(aim).z(), height + aim.settings().lift, 1e-9);
    EXPECT_LT(distanceToLine(place(aim), beyond), 1e-9);
    EXPECT_EQ(aim.buttons(), 0U);
    session::ServoParameters parameters;
    aim.apply(parameters);
    EXPECT_EQ(parameters.constantThrust, Parameters::kPointer);
    EXPECT_EQ(parameters.pause, 1) << "a pedal would drill";
    aim.update(); // the next frame
    EXPECT_NEAR(place(aim).z(), height + aim.settings().lift, 1e-9);

    aim.point(through({5.0, 0.0, 0.0})); // back on the bone
    EXPECT_FALSE(aim.lifted());
    EXPECT_NEAR(place(aim).z(), height, 0.01);
    aim.point(beyond);
    aim.press(Press::None);
    EXPECT_FALSE(aim.lifted());
    EXPECT_LT(place(aim).z(), -50.0); // hovers there
    aim.press(press);                 // pressed again
    EXPECT_FALSE(aim.lifted());
    EXPECT_LT(place(aim).z(), -50.0);
    aim.point(through({5.0, 0.0, 0.0})); // in the other direction
    EXPECT_TRUE(aim.lifted());
    EXPECT_LT(place(aim).z(), -50.0);
  }
  for (const double low : {-4.0, -6.0}) // an air cell is followed, an edge is not
  {
    PointerToolController aim = aimAt(through({9.0, 0.0, 0.0}), Mode::Surface, ledge(low));
    aim.press(Press::Drill);
    aim.point(through({14.0, 0.0, 0.0}));
    EXPECT_EQ(aim.lifted(), low < -5.0);
  }
}

TEST(PointerToolController, StartsInTheFocalPlaneWhereThereIsNoTissue)
{
  for (const Mode mode : {Mode::Surface, Mode::Depth})
  {
    const PointerToolController aim = aimAt(through({12.0, 7.0, 0.0}), mode, nothing());
    expectNear(place(aim), {12.0, 7.0, 0.0});
  }
}

TEST(PointerToolController, FollowsTissueThatGivesWay)
{
  double height = 0.0;
  PointerToolController aim([&height](const PickRay& line) { return plane(height)(line); });
  aim.setCamera(fromAbove());
  aim.point(through({0.0, 0.0, 0.0}));
  aim.press(Press::Drill);
  expectNear(place(aim), {0.0, 0.0, 2.0});
  height = -3.0;
  aim.update();
  expectNear(place(aim), {0.0, 0.0, -1.0});
}

TEST(PointerToolController, NeverGoesBehindTheEye)
{
  const PointerToolController aim =
      aimAt(through({0.0, 0.0, 0.0}), Mode::Surface,
            [](const PickRay&) { return std::optional<double>(0.5); });
  expectNear(place(aim), {0.0, 0.0, 200.0});
}

TEST(PointerToolController, TurnsTheWheelIntoDepthAlongTheLineOfSight)
{
  const PickRay line = through({40.0, 0.0, 0.0});
  PointerToolController aim = aimAt(line, Mode::Depth);
  const Vector3d before = place(aim);
  aim.wheel(3.0, false);
  expectNear(place(aim), before + 3.0 * 0.25 * line.direction);
  aim.wheel(1.0, true);
  expectNear(place(aim), before + (0.75 + 0.05) * line.direction);
  aim.wheel(-5.0, false);
  expectNear(place(aim), before + (0.80 - 1.25) * line.direction);
}

TEST(PointerToolController, LeavesTheDepthAloneWhileThePointerMoves)
{
  PointerToolController aim = aimAt(through({0.0, 0.0, 0.0}), Mode::Depth);
  aim.wheel(20.0, false);
  const double height = place(aim).z();
  EXPECT_NEAR(height, 3.0 - 5.0, 1e-9); // in the tissue: the coupling presses there
  for (const double x : {-30.0, 11.0, 60.0})
  {
    const PickRay line = through({x, 2.0 * x, 0.0});
    aim.point(line);
    EXPECT_NEAR(place(aim).z(), height, 1e-9);
    EXPECT_LT(distanceToLine(place(aim), line), 1e-9);
  }
}

// The previous ray's depth would be in the bone, or beyond it.
TEST(PointerToolController, ATakenUpToolBeginsBeforeTheTissueInDepthToo)
{
  double height = -30.0;
  PointerToolController aim([&height](const PickRay& line) { return plane(height)(line); });
  aim.setCamera(fromAbove());
  aim.point(through({0.0, 0.0, 0.0}));
  aim.setSettings(inMode(Mode::Depth));
  aim.begin();
  EXPECT_FALSE(aim.wanted());
  height = 0.0; // another part of the patient
  aim.point(through({0.0, 0.0, 0.0}));
  expectNear(place(aim), {0.0, 0.0, 3.0});
}

TEST(PointerToolController, AnotherToolGoesOnWhereTheLastOneWas)
{
  const PickRay line = through({20.0, 10.0, 0.0});
  PointerToolController aim = aimAt(line, Mode::Depth);
  aim.wheel(1000.0, false); // far into the tissue, which holds the tool
  const Vector3d held = line.at((line.origin.z() - 2.0) / -line.direction.z());
  aim.see(recordAt(held), false);
  aim.resume();
  expectNear(place(aim), held);

  PointerToolController hovers = aimAt(line, Mode::Surface);
  hovers.see(recordAt(place(hovers)), false);
  AimSettings settings = hovers.settings();
  settings.burrRadius = 3.5;
  hovers.setSettings(settings);
  hovers.resume();
  EXPECT_LT(distanceToLine(place(hovers), line), 1e-9);
  EXPECT_NEAR((Vector3d(20.0, 10.0, 0.0) - place(hovers)).norm(), 3.5 + 1.0, 1e-9);

  PointerToolController unused(plane(0.0));
  unused.resume();
  EXPECT_FALSE(unused.wanted());
}

TEST(PointerToolController, DoesNotTurnTheWheelIntoDepthOnTheSurface)
{
  PointerToolController aim = aimAt(through({0.0, 0.0, 0.0}), Mode::Surface);
  const Vector3d before = place(aim);
  aim.wheel(4.0, false);
  expectNear(place(aim), before);
}

TEST(PointerToolController, PressesNoDeeperThanTheLead)
{
  PointerToolController aim = aimAt(through({0.0, 0.0, 0.0}), Mode::Depth);
  aim.see(recordAt({0.0, 0.0, 2.0}), false); // held there by the tissue
  aim.wheel(1000.0, false);
  expectNear(place(aim), {0.0, 0.0, 2.0 - 5.0});
  aim.wheel(1.0, false);
  expectNear(place(aim), {0.0, 0.0, -3.0});
  aim.see(recordAt({0.0, 0.0, 1.0}), false); // tissue was removed
  aim.wheel(1000.0, false);
  expectNear(place(aim), {0.0, 0.0, -4.0});
  aim.see(recordAt({0.0, 0.0, 9.0}), false); // deeper than the lead: not pulled out
  aim.wheel(1.0, false);
  expectNear(place(aim), {0.0, 0.0, -4.0});
  aim.wheel(-2.0, false);
  expectNear(place(aim), {0.0, 0.0, -3.5});
}

TEST(PointerToolController, TakesTheDepthOfAToolThatWasTakenUpAnew)
{
  const PickRay line = through({20.0, 10.0, 0.0});
  PointerToolController aim = aimAt(line, Mode::Depth);
  aim.wheel(16.0, false);
  aim.see(recordAt({3.0, 3.0, 6.0}), true);
  EXPECT_NEAR(place(aim).z(), 6.0, 1e-9);
  EXPECT_LT(distanceToLine(place(aim), line), 1e-9);
}

TEST(PointerToolController, NudgesOnTheScreen)
{
  for (const Mode mode : {Mode::Surface, Mode::Depth})
  {
    PointerToolController aim = aimAt(through({0.0, 0.0, 0.0}), mode);
    const Vector3d before = place(aim);
    aim.nudge(2.0, 0.0, false);
    expectNear(place(aim), before + Vector3d(0.5, 0.0, 0.0));
    aim.nudge(0.0, -1.0, true);
    expectNear(place(aim), before + Vector3d(0.5, -0.05, 0.0));
    aim.point(through({0.0, 0.0, 0.0}));
    expectNear(place(aim), before + Vector3d(0.5, -0.05, 0.0)); // the nudge is kept
    aim.home();
    expectNear(place(aim), before);
  }
}

TEST(PointerToolController, DoesNotMoveTheToolWithTheCamera)
{
  PointerToolController aim = aimAt(through({5.0, 6.0, 0.0}), Mode::Depth);
  const haptics::Pose before = *aim.wanted();
  core::CameraPose other = fromAbove();
  other.position = {150.0, 0.0, 120.0};
  aim.setCamera(other);
  EXPECT_EQ(aim.wanted()->position, before.position);
  EXPECT_EQ(aim.wanted()->rotation.coeffs(), before.rotation.coeffs());
  // When pointed at again at its position, it stays there.
  aim.point({other.position, (before.position - other.position).normalized()});
  expectNear(place(aim), before.position);
}

TEST(PointerToolController, TiltsTheShaftFromTheEyeBySetAngles)
{
  const PickRay line = through({0.0, 0.0, 0.0});
  PointerToolController aim = aimAt(line, Mode::Surface);
  for (const double tilt : {0.0, 20.0, 55.0})
    for (const double turn : {-40.0, 0.0, 90.0, 170.0})
    {
      AimSettings settings;
      settings.tilt = tilt;
      settings.turn = turn;
      aim.setSettings(settings);
      const double s = std::sin(tilt * kDegree);
      expectNear(shaft(aim), {s * std::cos(turn * kDegree), s * std::sin(turn * kDegree),
                              std::cos(tilt * kDegree)});
    }
}

TEST(PointerToolController, KeepsTheTiltOnEveryLineOfSight)
{
  core::CameraPose camera;
  camera.position = {80.0, -120.0, 60.0};
  camera.focalPoint = {5.0, 3.0, -2.0};
  PointerToolController aim(nothing());
  aim.setCamera(camera);
  const Vector3d forward = (camera.focalPoint - camera.position).normalized();
  for (const Vector3d& aside : {Vector3d(0, 0, 0), Vector3d(0.2, 0.1, 0.0), Vector3d(0, 0, -0.3)})
  {
    const PickRay line{camera.position, (forward + aside).normalized()};
    aim.point(line);
    EXPECT_NEAR(shaft(aim).dot(-line.direction), std::cos(20.0 * kDegree), 1e-9);
    EXPECT_NEAR(aim.wanted()->rotation.norm(), 1.0, 1e-12);
  }
}

TEST(PointerToolController, LeavesTheLargestBurrInSightAsItStands)
{
  // The near rim of the default handpiece must not cross the lines of sight to a 7 mm burr;
  // parallel lines are the worst case, a camera far away.
  const PointerToolController aim = aimAt(through({0.0, 0.0, 0.0}), Mode::Surface);
  const haptics::BurrShape tool;
  const haptics::Pose pose = *aim.wanted();
  for (int n = 0; n < 360; ++n)
    for (const double along : {tool.shaftLength, tool.shaftLength + tool.handpieceLength})
    {
      const Vector3d rim = pose * Vector3d(tool.handpieceRadius * std::cos(n * kDegree),
                                           tool.handpieceRadius * std::sin(n * kDegree), along);
      EXPECT_GT((rim - pose.position).head<2>().norm(), 3.5) << n;
    }
}

TEST(PointerToolController, BoundsTiltAndWrapsTurn)
{
  PointerToolController aim(plane(0.0));
  aim.tiltBy(500.0);
  EXPECT_EQ(aim.settings().tilt, 80.0);
  aim.tiltBy(-500.0);
  EXPECT_EQ(aim.settings().tilt, 0.0);
  aim.turnBy(250.0);
  EXPECT_NEAR(aim.settings().turn, -150.0, 1e-9);
  aim.turnBy(std::numeric_limits<double>::quiet_NaN());
  EXPECT_NEAR(aim.settings().turn, -150.0, 1e-9);
}

TEST(PointerToolController, StaysWhereItIsWhenTheModeChanges)
{
  PointerToolController aim = aimAt(through({4.0, 3.0, 0.0}), Mode::Surface);
  const Vector3d before = place(aim);
  aim.setSettings(inMode(Mode::Depth));
  expectNear(place(aim), before);
}

// Its origin is the tip, which touches only if it may go farther than the surface.
TEST(PointerToolController, PressesATipBeyondTheSurface)
{
  const Vector3d target(30.0, -20.0, 0.0);
  PointerToolController aim = aimAt(through(target), Mode::Surface);
  AimSettings settings = aim.settings();
  settings.burrRadius = 0.01;
  settings.beyond = 1.0;
  aim.setSettings(settings);
  aim.press(Press::Drill);
  EXPECT_NEAR((target - place(aim)).norm(), 0.01, 1e-9);
  session::ServoParameters parameters;
  aim.apply(parameters);
  const Vector3d way(parameters.approach);
  EXPECT_NEAR(way.norm(), 1.01, 1e-9);
  EXPECT_GT(way.normalized().dot((target - place(aim)).normalized()), 1.0 - 1e-6);
}

TEST(PointerToolController, RefusesBadSettingsAndLines)
{
  const auto refused = [](auto AimSettings::*value, double bad)
  {
    AimSettings settings;
    settings.*value = bad;
    EXPECT_THROW(PointerToolController(plane(0.0), settings), core::InvalidParameter);
  };
  const double nan = std::numeric_limits<double>::quiet_NaN();
  refused(&AimSettings::tilt, 81.0);
  refused(&AimSettings::turn, nan);
  refused(&AimSettings::depthStep, 0.0);
  refused(&AimSettings::nudgeStep, 11.0);
  refused(&AimSettings::fineFraction, 0.0);
  refused(&AimSettings::maxLead, nan);
  refused(&AimSettings::burrRadius, -1.0);
  refused(&AimSettings::beyond, 10.1);
  refused(&AimSettings::lift, -0.1);
  refused(&AimSettings::thrust, 21.0);
  refused(&AimSettings::approachSpeed, 0.0);
  EXPECT_THROW(PointerToolController{TissueQuery()}, core::InvalidParameter);

  PointerToolController aim(plane(0.0));
  EXPECT_THROW(aim.point({Vector3d(nan, 0.0, 0.0), Vector3d::UnitZ()}), core::InvalidParameter);
  EXPECT_THROW(aim.point({Vector3d::Zero(), Vector3d(0.0, 0.0, 2.0)}), core::InvalidParameter);
  core::CameraPose blind;
  blind.focalPoint = blind.position;
  EXPECT_THROW(aim.setCamera(blind), core::InvalidParameter);
  EXPECT_FALSE(aim.wanted());
}

TEST(FirstTissue, FindsTheSurfaceFromFarOutsideTheGrid)
{
  const auto field = block();
  const PickRay line = through({3.0, -2.0, 0.0});
  const auto hit = firstTissue(*field, line);
  ASSERT_TRUE(hit);
  EXPECT_NEAR(line.at(*hit).z(), 0.0, 1e-3);
  EXPECT_FALSE(firstTissue(*field, {{50.0, 0.0, 200.0}, {0.0, 0.0, -1.0}})); // misses
  EXPECT_FALSE(firstTissue(*field, {{0.0, 0.0, 200.0}, {0.0, 0.0, 1.0}}));   // points away
  const auto inside = firstTissue(*field, {{0.0, 0.0, -5.0}, {0.0, 0.0, -1.0}});
  ASSERT_TRUE(inside);
  EXPECT_EQ(*inside, 0.0);
}
