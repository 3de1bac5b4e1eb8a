#include "petrous/Interaction/ToolView.h"

#include <gtest/gtest.h>

#include "Pixels.h"
#include "petrous/Core/Error.h"
#include "petrous/Haptics/PointShell.h"
#include "petrous/Rendering/OffscreenView.h"
#include "petrous/Rendering/ToolShape.h"

using namespace petrous;
using namespace petrous::interaction;
using namespace petrous::interaction::testing;
using Eigen::Quaterniond;
using Eigen::Vector3d;
using session::PoseValues;
using session::TickRecord;

namespace
{

TickRecord recordOf(const Vector3d& tool, const Vector3d& hand)
{
  TickRecord record;
  record.proxy = PoseValues::of({tool, Quaterniond(Eigen::AngleAxisd(0.5, Vector3d::UnitX()))});
  record.mapped = PoseValues::of({hand, Quaterniond::Identity()});
  return record;
}

} // namespace

TEST(ToolView, DrawsTheToolThatIsFelt)
{
  for (const double radius : {0.5, 1.0, 2.0, 3.5})
  {
    haptics::BurrShape felt;
    felt.radius = radius;
    rendering::ToolPose drawn;
    drawn.radius = radius;
    EXPECT_EQ(rendering::tool::shaftRadius(drawn), felt.resolvedShaftRadius());
    EXPECT_EQ(rendering::tool::kShaftLength, felt.shaftLength);
    EXPECT_EQ(rendering::tool::kHandpieceRadius, felt.handpieceRadius);
    EXPECT_EQ(rendering::tool::kHandpieceLength, felt.handpieceLength);
  }
}

// The handpiece begins 30 mm from the burr and is 6 mm in radius.
TEST(ToolView, TheHandpieceHidesTheFieldOnlyBetweenItAndTheEye)
{
  rendering::ToolPose tool;
  tool.center = {10.0, -20.0, 5.0};
  const auto seenFrom = [&tool](double degrees, double away)
  {
    const double angle = degrees * M_PI / 180.0;
    return hidesField(tool, tool.center + away * Vector3d(std::sin(angle), 0.0, std::cos(angle)));
  };
  EXPECT_TRUE(seenFrom(0.0, 300.0));
  EXPECT_TRUE(seenFrom(11.0, 300.0)) << "its edge is 0.3 mm from the line of sight";
  EXPECT_FALSE(seenFrom(25.0, 300.0)) << "12.7 mm beside it";
  EXPECT_FALSE(seenFrom(90.0, 300.0));
  EXPECT_FALSE(seenFrom(180.0, 300.0)) << "behind";
  EXPECT_FALSE(seenFrom(0.0, 20.0)) << "the eye is nearer than the handpiece";
  tool.handpiece = false;
  EXPECT_FALSE(seenFrom(0.0, 300.0));
}

TEST(ToolView, TurnsABurrThatDrills)
{
  ToolView view(1.5, rendering::BurrFinish::Fluted);
  TickRecord record = recordOf({1.0, 2.0, 3.0}, {1.0, 2.0, 3.0});
  EXPECT_EQ(view.update(record)->finish, rendering::BurrFinish::Fluted);
  EXPECT_EQ(view.update(record)->turn, 0.0);
  record.drill = 1;
  const double first = view.update(record)->turn;
  EXPECT_NE(view.update(record)->turn, first);
  record.drill = 0;
  const double last = view.update(record)->turn;
  EXPECT_EQ(view.update(record)->turn, last);
}

TEST(ToolView, ShowsTheProxyNotTheHand)
{
  ToolView view(1.5);
  TickRecord record = recordOf({1.0, 2.0, 3.0}, {1.0, 2.0, -4.0});
  const auto tool = view.update(record);
  ASSERT_TRUE(tool);
  EXPECT_EQ(tool->center, Vector3d(1.0, 2.0, 3.0));
  // The tool's +z axis, rotated by 0.5 about x.
  EXPECT_LT((tool->axisToHand - Vector3d(0.0, -std::sin(0.5), std::cos(0.5))).norm(), 1e-12);
  EXPECT_EQ(tool->radius, 1.5);
  EXPECT_FALSE(tool->drilling);
  EXPECT_NEAR(view.lag(), 7.0, 1e-12);
  record.drill = 1;
  EXPECT_TRUE(view.update(record)->drilling);
}

TEST(ToolView, ShowsNothingBeforeTheFirstSoundReading)
{
  ToolView view(1.5);
  TickRecord record = recordOf({1.0, 2.0, 3.0}, {1.0, 2.0, 3.0});
  record.fault = static_cast<std::uint8_t>(session::ServoFault::Device);
  EXPECT_FALSE(view.update(record));
  record.fault = 0;
  EXPECT_TRUE(view.update(record));
  record.fault = static_cast<std::uint8_t>(session::ServoFault::Device);
  EXPECT_TRUE(view.update(record)); // stays placed
}

TEST(ToolView, DrawsALineToAHandThatIsFarAhead)
{
  ToolView tool(1.0);
  rendering::ScenePicture picture;
  core::CameraPose camera;
  camera.position = {0.0, 0.0, 200.0};
  camera.focalPoint = {0.0, 0.0, 0.0};
  camera.viewUp = {0.0, 1.0, 0.0};
  camera.parallelScale = 30.0; // 4 pixels per mm
  picture.setContents({});
  picture.setCamera(camera);
  rendering::OffscreenView view(320, 240);
  const rendering::Picture empty = view.render(picture);
  tool.addTo(picture.renderer());

  tool.update(recordOf({1.0, 0.0, 0.0}, {1.9, 0.0, 0.0}));
  EXPECT_TRUE(difference(view.render(picture), empty).empty());
  tool.update(recordOf({-3.0, 2.0, 0.0}, {6.0, 10.0, 5.0}));
  const Reach line = reach(difference(view.render(picture), empty), {-12.0, 8.0}, {36.0, 32.0});
  EXPECT_NEAR(line.least, 0.0, 1.5);
  EXPECT_NEAR(line.most, std::hypot(36.0, 32.0), 1.5);
  EXPECT_LT(line.aside, 2.0);
}

TEST(ToolView, RefusesABurrWithoutSize)
{
  EXPECT_THROW(ToolView(0.0), core::InvalidParameter);
  EXPECT_THROW(ToolView(-1.0), core::InvalidParameter);
}
