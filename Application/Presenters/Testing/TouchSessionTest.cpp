#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <thread>
#include <vector>

#include "BoneCase.h"
#include "HeldTool.h"

using namespace petrous;
using namespace petrous::presenters;
using Eigen::Vector3d;
using namespace petrous::presenters::testing;

namespace
{

class TouchSessionTest : public ::testing::Test
{
protected:
  scene::Case value = block();
  session::TouchScene scene{value};
  HeldTool held{Vector3d(6.0, 6.0, kTop + 2.5), session::TouchTool::Mode::SixDof};
  session::TouchSession session{value, scene, held.device, held.setup};

  // One frame: applies the removal and feeds the device.
  session::TouchSession::News frame()
  {
    auto news = session.advance();
    if (news.record)
      held.device.see(*news.record);
    return news;
  }
  // Half a millimetre deep: the first bites only shave partial voxels.
  bool drillSome()
  {
    held.drill(true);
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
  session::TickRecord record;
  ASSERT_TRUE(until(
      [&]
      {
        record = frame().record.value_or(record);
        return std::abs(record.thrust - 1.0) < 0.05;
      }));
  EXPECT_NEAR(record.proxy.pose().position.z(), kTop + 2.0, 0.1); // the burr's radius is 2 mm
  EXPECT_TRUE(value.dissection.mask().untouched());
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
  held.drill(false);
  session::TouchSession::News news;
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
  ASSERT_EQ(value.dissection.strokes().size(), 1u);
  EXPECT_EQ(value.applied(), 1u);
  EXPECT_TRUE(session.stop().strokes.empty()); // already closed
}

// The drill does not depend on how often a picture is drawn.
TEST_F(TouchSessionTest, DrillsOneWholeStrokeWithTenPicturesASecond)
{
  const auto picture = [this]
  {
    std::this_thread::sleep_for(std::chrono::milliseconds(100));
    return frame();
  };
  held.drill(true);
  double lowest = 100.0;
  ASSERT_TRUE(until(
      [&]
      {
        if (const auto record = picture().record; record && record->drill)
          lowest = std::min(lowest, record->proxy.pose().position.z());
        return lowest < kTop + 1.0;
      }));
  held.drill(false);
  std::vector<std::shared_ptr<const dissection::Stroke>> strokes;
  ASSERT_TRUE(until(
      [&]
      {
        for (const auto& stroke : picture().strokes)
          strokes.push_back(stroke);
        return !strokes.empty();
      }));
  EXPECT_TRUE(session.stop().strokes.empty());
  ASSERT_EQ(strokes.size(), 1u);
  ASSERT_TRUE(strokes.front());
  EXPECT_EQ(value.dissection.strokes().size(), 1u);
  // The burr of 2 mm sank in by more than a millimetre: at least that cap is gone.
  const double cap = std::acos(-1.0) * 1.0 * (3.0 * 2.0 - 1.0) / 3.0; // mm^3
  EXPECT_GT(strokes.front()->info.removed, 0.8 * cap);
}

TEST_F(TouchSessionTest, TheToolSinksInWhereItDrills)
{
  held.drill(true);
  double lowest = 100.0;
  ASSERT_TRUE(until(
      [&]
      {
        if (const auto record = frame().record; record && record->drill)
          lowest = std::min(lowest, record->proxy.pose().position.z());
        return lowest < kTop + 1.0; // a millimetre below the first contact
      }));
}

TEST_F(TouchSessionTest, SurvivesUndoAndRedoInContact)
{
  ASSERT_TRUE(drillSome());
  const auto step = [this](bool back)
  {
    back ? session.undo() : session.redo();
    session::TouchSession::News news;
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
  // The drill is still on: the branch continues with the next stroke.
  ASSERT_TRUE(until(
      [this]
      {
        frame();
        return session.drilling() && !value.dissection.mask().untouched();
      }));
  held.drill(false);
  ASSERT_TRUE(until([this] { return !frame().strokes.empty(); }));
  ASSERT_EQ(value.dissection.strokes().size(), 2u) << "the one undone is kept";
  EXPECT_TRUE(value.dissection.history().find("main~1"));
  step(true);
  EXPECT_TRUE(value.dissection.mask().untouched());
  step(false);
  EXPECT_EQ(value.applied(), 1u);
  EXPECT_FALSE(value.dissection.mask().untouched());
  ASSERT_TRUE(until(
      [this]
      {
        const auto record = frame().record;
        return record && record->fault == 0 && std::abs(record->thrust - 1.0) < 0.1;
      }));
  session.redo(); // there is nothing to redo
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

namespace
{

// Moves at 6 mm/s over the bone, with the drill on from 0.3 s to 0.9 s after the first reading.
class ScriptedDevice final : public haptics::Device
{
public:
  explicit ScriptedDevice(const Vector3d& place) { m_reading.pose.position = place; }
  const haptics::DeviceDescription& description() const noexcept override { return m_about; }
  haptics::DeviceReading read(double now) noexcept override
  {
    m_start = std::min(m_start, now);
    m_reading.pose.position.x() = 3.0 + 6.0 * (now - m_start);
    m_reading.time = now;
    m_reading.health = haptics::DeviceHealth::Good;
    m_reading.buttons = now > m_start + 0.3 && now < m_start + 0.9 ? 1U : 0U;
    return m_reading;
  }
  void send(const haptics::Wrench&) noexcept override {}

private:
  haptics::DeviceDescription m_about;
  haptics::DeviceReading m_reading;
  double m_start = std::numeric_limits<double>::max(); // s
};

struct Drilled
{
  double rate = 0.0;        // mm^3/s
  std::uint64_t states = 0; // mask states seen by the servo
};

Drilled drilledAt(double picturesPerSecond)
{
  scene::Case value = block();
  session::TouchScene scene(value);
  ScriptedDevice device(Vector3d(6.0, 6.0, kTop + 2.2));
  session::TouchSession::Setup setup;
  setup.parameters.constantThrust = 1;
  setup.parameters.drillButtons = 1;
  setup.parameters.approach[2] = -5.0;
  session::TouchSession session(value, scene, device, setup);
  Drilled drilled;
  for (bool over = false; !over;)
  {
    std::this_thread::sleep_for(std::chrono::duration<double>(1.0 / picturesPerSecond));
    const auto news = session.advance();
    over = !news.strokes.empty();
    drilled.states = news.record ? news.record->maskState : 0;
  }
  session.stop();
  EXPECT_EQ(value.dissection.strokes().size(), 1u);
  const auto& info = value.dissection.strokes().front()->info;
  EXPECT_GT(info.duration, 0.3);
  drilled.rate = info.removed / info.duration;
  return drilled;
}

} // namespace

TEST(TouchSession, DrillsAtTheSameRateHoweverSeldomPicturesAreDrawn)
{
  const Drilled often = drilledAt(60.0);
  for (const double picturesPerSecond : {5.0, 1.5})
  {
    const Drilled seldom = drilledAt(picturesPerSecond);
    // The path of a burr sliding in its groove is not reproducible.
    EXPECT_NEAR(seldom.rate, often.rate, 0.12 * often.rate) << picturesPerSecond << " Hz";
    EXPECT_GT(seldom.states, 100u); // 3 frames, and 1, while it drilled
  }
  EXPECT_GT(often.rate, 0.5);
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
  session::TouchScene scene(value);
  Unplugged device;
  session::TouchSession::Setup setup;
  setup.tool.mode = session::TouchTool::Mode::ThreeDof;
  session::TouchSession session(value, scene, device, setup);
  std::string fault;
  ASSERT_TRUE(until(
      [&]
      {
        fault = session.advance().fault;
        return !fault.empty();
      }));
  EXPECT_EQ(fault, haptics::toString(haptics::DeviceVerdict::Disconnected));
}

TEST(TouchSession, RefusesBadParameters)
{
  scene::Case value = block();
  session::TouchScene scene(value);
  HeldTool held(Vector3d(6.0, 6.0, 10.0));
  held.setup.tool.burr.rpm = -1.0;
  EXPECT_THROW(session::TouchSession(value, scene, held.device, held.setup),
               core::InvalidParameter);
  held.setup.tool.burr.rpm = 60000.0;
  held.setup.parameters.thrust = 50.0;
  EXPECT_THROW(session::TouchSession(value, scene, held.device, held.setup),
               core::InvalidParameter);
}

TEST(TouchTool, IsHeldTheStifferWhereASetThrustPressesIt)
{
  using Mode = session::TouchTool::Mode;
  const haptics::ProxyParameters usual;
  EXPECT_EQ(session::couplingFor(Mode::SixDof, std::nullopt).stiffness, usual.stiffness);
  EXPECT_EQ(session::couplingFor(Mode::ThreeDof, 1.0).stiffness, usual.stiffness);
  const haptics::ProxyParameters pressed = session::couplingFor(Mode::SixDof, 1.0);
  EXPECT_EQ(pressed.stiffness, session::ConstantThrust::coupling(1.0).stiffness);
  EXPECT_GT(pressed.stiffness, 5.0 * usual.stiffness);
  EXPECT_GT(pressed.angularStiffness, usual.angularStiffness);
}
