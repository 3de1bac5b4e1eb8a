#include <gtest/gtest.h>

#include <cmath>

#include "BoneCase.h"
#include "HeldTool.h"

using namespace petrous;
using namespace petrous::presenters;
using Eigen::Vector3d;
using petrous::presenters::testing::block;
using petrous::presenters::testing::HeldTool;
using petrous::presenters::testing::kTop;
using petrous::presenters::testing::until;

namespace
{

class TouchSessionTest : public ::testing::Test
{
protected:
  scene::Case value = block();
  TouchScene scene{value};
  HeldTool hand{Vector3d(6.0, 6.0, kTop + 2.5), TouchTool::Mode::SixDof};
  TouchSession session{value, scene, hand.device, hand.setup};

  // Cuts, and looks at what comes.
  TouchSession::News frame()
  {
    auto news = session.advance();
    if (news.record)
      hand.device.see(*news.record);
    return news;
  }
  // Half a millimetre deep: the first bites only shave what partial voxels there are.
  bool drillSome()
  {
    hand.drill(true);
    return until(
        [this]
        {
          const auto record = frame().record;
          return record && record->drill && record->proxy.pose().position.z() < kTop + 1.5;
        });
  }
};

} // namespace

TEST_F(TouchSessionTest, PressesOnTheBoneWithoutTakingAnyWhileTheDrillIsOff)
{
  simulation::TickRecord record;
  ASSERT_TRUE(until(
      [&]
      {
        record = frame().record.value_or(record);
        return std::abs(record.thrust - 1.0) < 0.05;
      }));
  EXPECT_NEAR(record.proxy.pose().position.z(), kTop + 2.0, 0.1); // the burr's radius is 2 mm
  EXPECT_TRUE(value.dissection->mask().untouched());
  EXPECT_FALSE(session.drilling());
  EXPECT_TRUE(session.stop().strokes.empty());
}

TEST_F(TouchSessionTest, DrillingTakesTissueAndListsTheStroke)
{
  core::CameraPose camera;
  camera.position = {6, 6, 90};
  session.setCamera(camera);
  ASSERT_TRUE(drillSome());
  EXPECT_TRUE(session.drilling());
  hand.drill(false);
  TouchSession::News news;
  ASSERT_TRUE(until(
      [&]
      {
        news = frame();
        return !news.strokes.empty();
      }));
  EXPECT_FALSE(session.drilling());
  ASSERT_EQ(news.strokes.size(), 1u);
  ASSERT_TRUE(news.strokes.front());
  EXPECT_GT(news.strokes.front()->info.removed, 0.0);
  ASSERT_TRUE(news.strokes.front()->info.camera);
  EXPECT_EQ(news.strokes.front()->info.camera->position, camera.position);
  ASSERT_EQ(value.strokes.size(), 1u);
  EXPECT_EQ(value.applied(), 1u);
  EXPECT_TRUE(session.stop().strokes.empty()); // it is closed already
}

TEST_F(TouchSessionTest, TheToolSinksInWhereItDrills)
{
  hand.drill(true);
  double lowest = 100.0;
  ASSERT_TRUE(until(
      [&]
      {
        if (const auto record = frame().record; record && record->drill)
          lowest = std::min(lowest, record->proxy.pose().position.z());
        return lowest < kTop + 1.0; // a millimetre below where it first touched
      }));
}

TEST_F(TouchSessionTest, SurvivesUndoAndRedoInContact)
{
  ASSERT_TRUE(drillSome());
  const auto step = [this](bool back)
  {
    back ? session.undo() : session.redo();
    TouchSession::News news;
    EXPECT_TRUE(until(
        [&]
        {
          news = frame();
          return !news.steps.empty();
        }));
    EXPECT_EQ(news.steps, std::vector<bool>{back});
    EXPECT_FALSE(news.bricks.empty());
  };
  step(true);
  EXPECT_EQ(value.applied(), 0u);
  // The drill is still held: the branch goes on with the next stroke.
  ASSERT_TRUE(until(
      [this]
      {
        frame();
        return session.drilling() && !value.dissection->mask().untouched();
      }));
  hand.drill(false);
  ASSERT_TRUE(until([this] { return !frame().strokes.empty(); }));
  ASSERT_EQ(value.strokes.size(), 2u) << "the one undone is kept";
  EXPECT_TRUE(value.history.find("main~1"));
  step(true);
  EXPECT_TRUE(value.dissection->mask().untouched());
  step(false);
  EXPECT_EQ(value.applied(), 1u);
  EXPECT_FALSE(value.dissection->mask().untouched());
  ASSERT_TRUE(until(
      [this]
      {
        const auto record = frame().record;
        return record && record->fault == 0 && std::abs(record->thrust - 1.0) < 0.1;
      }));
  session.redo(); // there is none
  const auto news = session.stop();
  EXPECT_TRUE(news.steps.empty());
  EXPECT_EQ(value.applied(), 1u);
}

TEST_F(TouchSessionTest, StopClosesTheStrokeAndEndsTheServo)
{
  ASSERT_TRUE(drillSome());
  const auto news = session.stop(); // the button is still held
  ASSERT_EQ(news.strokes.size(), 1u);
  EXPECT_TRUE(news.strokes.front());
  EXPECT_FALSE(session.drilling());
  EXPECT_FALSE(session.state().running);
  const auto after = session.stop();
  EXPECT_TRUE(after.strokes.empty());
  EXPECT_TRUE(after.bricks.empty());
}

TEST(TouchSession, SaysInWordsThatTheDeviceIsGone)
{
  struct Unplugged final : haptics::Device
  {
    haptics::DeviceDescription about;
    const haptics::DeviceDescription& description() const noexcept override { return about; }
    haptics::DeviceReading read(double now) noexcept override
    {
      haptics::DeviceReading reading;
      reading.time = now;
      reading.health = haptics::DeviceHealth::Disconnected;
      return reading;
    }
    void send(const haptics::Wrench&) noexcept override {}
  };
  scene::Case value = block();
  TouchScene scene(value);
  Unplugged device;
  TouchSession::Setup setup;
  setup.tool.mode = TouchTool::Mode::ThreeDof;
  TouchSession session(value, scene, device, setup);
  std::string fault;
  ASSERT_TRUE(until(
      [&]
      {
        fault = session.advance().fault;
        return !fault.empty();
      }));
  EXPECT_EQ(fault, haptics::inWords(haptics::DeviceVerdict::Disconnected));
}

TEST(TouchSession, RefusesBadParameters)
{
  scene::Case value = block();
  TouchScene scene(value);
  HeldTool hand(Vector3d(6.0, 6.0, 10.0));
  hand.setup.tool.burr.rpm = -1.0;
  EXPECT_THROW(TouchSession(value, scene, hand.device, hand.setup), core::InvalidParameter);
  hand.setup.tool.burr.rpm = 60000.0;
  hand.setup.parameters.thrust = 50.0;
  EXPECT_THROW(TouchSession(value, scene, hand.device, hand.setup), core::InvalidParameter);
}
