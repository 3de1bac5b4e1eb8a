#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <new>
#include <optional>
#include <random>
#include <thread>

#include <gtest/gtest.h>

#include "../../Core/Testing/Eventually.h"
#include "LoopScene.h"
#include "SimulatedDevice.h"
#include "petrous/Session/DissectionThread.h"
#include "petrous/Session/DissectionUpdate.h"
#include "petrous/Session/ServoThread.h"

using namespace petrous;
using namespace petrous::session;
using namespace petrous::session::testing;
using Eigen::Vector3d;
using Kind = DissectionEvent::Kind;

namespace
{

std::vector<std::uint16_t> voxelsOf(const dissection::Dissection& work)
{
  const auto dense = work.mask().dense();
  return {dense.data(), dense.data() + dense.size()};
}

volume::CutMask::BrickVersion version(std::uint16_t value)
{
  auto brick = std::make_shared<volume::CutMask::Brick>();
  brick->fill(value);
  return brick;
}

// Servo, cutting thread and a follower, as in a window.
class Following : public ::testing::Test
{
protected:
  LoopScene scene;
  dissection::Dissection seen = scene.work;
  UpdateQueue queue;
  DissectionReporter reporter{scene.work, queue};
  DissectionLoop loop{scene.work, *scene.mask, scene.removalModel, {}, reporter.listen({}, {}, {})};
  SpscRing<TickRecord> ring{1 << 15};
  std::size_t applied = 0, closed = 0; // according to the events

  DissectionThread::Hooks hooks()
  {
    return {[this](const TickRecord& record) { reporter.note(record); },
            [this] { reporter.post(); }};
  }

  // One frame: applies changes and checks that each was reported.
  void follow()
  {
    const auto before = seen.mask();
    DissectionUpdate mail = queue.take();
    const auto bricks = session::follow(mail, seen);
    EXPECT_TRUE(std::is_sorted(bricks.begin(), bricks.end()));
    for (std::size_t brick = 0; brick < before.brickCount(); ++brick)
      if (before.brick(brick) != seen.mask().brick(brick))
      {
        EXPECT_TRUE(std::binary_search(bricks.begin(), bricks.end(), brick)) << brick;
      }
    for (const DissectionEvent& event : mail.events)
    {
      closed += event.kind == Kind::StrokeClosed && event.stroke;
      applied += (event.kind == Kind::StrokeClosed && event.stroke) || event.kind == Kind::Redone;
      applied -= event.kind == Kind::Undone;
    }
    EXPECT_EQ(seen.applied(), applied);
    EXPECT_TRUE(seen.mask().takeDirty().empty());
  }
};

} // namespace

TEST(DissectionUpdate, HoldsTheLatestVersionOfABrickHoweverLongNobodyAsks)
{
  UpdateQueue queue;
  std::vector<volume::CutMask::BrickVersion> made;
  for (std::uint16_t n = 0; n < 1000; ++n)
  {
    DissectionUpdate mail;
    made.push_back(version(n));
    mail.bricks[n % 3U] = made.back();
    queue.post(mail);
    EXPECT_TRUE(mail.empty());
  }
  const DissectionUpdate mail = queue.take();
  ASSERT_EQ(mail.bricks.size(), 3u);
  EXPECT_EQ(mail.bricks.at(0), made[999]);
  EXPECT_EQ(mail.bricks.at(1), made[997]);
  EXPECT_EQ(mail.bricks.at(2), made[998]);
  EXPECT_TRUE(queue.take().empty());
  // The intermediate versions are not held elsewhere.
  EXPECT_EQ(made[0].use_count(), 1);
  EXPECT_EQ(made[999].use_count(), 2);
}

TEST(DissectionUpdate, TellsStrokesThatTookNothingOnceInARow)
{
  UpdateQueue queue;
  const auto stroke = std::make_shared<const dissection::Stroke>();
  for (int n = 0; n < 100; ++n)
  {
    DissectionUpdate mail;
    mail.events = {{Kind::StrokeBegun, nullptr}};
    queue.post(mail);
    mail.events = {{Kind::StrokeClosed, n == 50 ? stroke : nullptr}};
    queue.post(mail);
  }
  const DissectionUpdate mail = queue.take();
  ASSERT_EQ(mail.events.size(), 6u);
  EXPECT_EQ(mail.events[1].stroke, nullptr);
  EXPECT_EQ(mail.events[2].kind, Kind::StrokeBegun);
  EXPECT_EQ(mail.events[3].stroke, stroke);
  EXPECT_EQ(mail.events[4].kind, Kind::StrokeBegun);
  EXPECT_EQ(mail.events[5].stroke, nullptr);
}

TEST_F(Following, AStrokeThatIsOpenIsSeenAsTheThreadHasIt)
{
  TickRecord record;
  record.drill = 1;
  record.thrust = 1.0;
  record.burrForce[2] = 1.0;
  for (int n = 1; n <= 20; ++n)
  {
    record.number = static_cast<std::uint64_t>(n);
    record.input.now = 0.001 * n;
    record.proxy = PoseValues::of({{0.0, 0.0, 1.0}, Eigen::Quaterniond::Identity()});
    loop.step(record);
    reporter.post();
    if (n % 7 == 0)
    {
      follow();
      EXPECT_TRUE(seen.strokeOpen());
      EXPECT_EQ(voxelsOf(seen), scene.voxels());
      EXPECT_TRUE(seen.maskBeforeStroke().untouched());
      EXPECT_FALSE(seen.mask().untouched());
    }
  }
  loop.endStroke();
  reporter.post();
  follow();
  EXPECT_FALSE(seen.strokeOpen());
  ASSERT_EQ(seen.strokes().size(), 1u);
  EXPECT_EQ(seen.strokes().front(), scene.work.strokes().front());
  EXPECT_EQ(closed, 1u);
}

TEST_F(Following, AStrokeThatWasStoredMeanwhileStaysSo)
{
  TickRecord record;
  record.thrust = 1.0;
  record.burrForce[2] = 1.0;
  for (int n = 1; n <= 20; ++n)
  {
    record.number = static_cast<std::uint64_t>(n);
    record.input.now = 0.001 * n;
    record.drill = n != 10;
    record.proxy = PoseValues::of({{0.0, n < 10 ? 0.0 : 4.0, 1.0}, Eigen::Quaterniond::Identity()});
    loop.step(record);
    if (n != 10)
      continue;
    reporter.post();
    follow();
    ASSERT_EQ(seen.strokes().size(), 1u);
    seen.setStored(0, "a.stroke", seen.strokes()[0]->packed);
  }
  loop.endStroke();
  reporter.post();
  follow();
  ASSERT_EQ(seen.strokes().size(), 2u);
  EXPECT_EQ(seen.strokes()[0]->object, "a.stroke");
  EXPECT_EQ(seen.strokes()[0]->packed.peek(), scene.work.strokes()[0]->packed.peek());
  EXPECT_EQ(seen.strokes()[1]->object, "");
  EXPECT_EQ(voxelsOf(seen), scene.voxels());
}

// Hundreds of frames of live sessions stopped at random times: the follower is bit-identical to the
// thread and misses nothing in between.
TEST_F(Following, RandomSessionsWithUndoAndRedoAreFollowedToTheLastBit)
{
  std::mt19937 random(5);
  const auto upTo = [&random](unsigned n) { return static_cast<int>(random() % (n + 1)); };
  std::uint64_t ticks = 0;
  std::size_t open = 0;
  for (int session = 0; session < 12; ++session)
  {
    std::optional<double> start;
    haptics::SimulatedDevice device(
        [&start, session](double now) -> haptics::Pose
        {
          start = start.value_or(now);
          const double t = now - *start;
          const double z =
              1.0 - 0.2 * session + 0.8 * std::sin(20.0 * t) + std::max(0.0, 4.0 - 60.0 * t);
          return {{3.0 * std::sin(5.0 * t + session), 3.0 * std::cos(4.0 * t), z},
                  Eigen::Quaterniond::Identity()};
        });
    PlaneProxy proxy;
    proxy.mask = scene.mask;
    Servo servo(proxy, Session::plainSetup());
    ServoParameters parameters;
    ServoThread servoThread(servo, device, ring, parameters);
    DissectionThread thread(ring, loop, hooks());
    const int pictures = 10 + upTo(25);
    for (int n = 0; n < pictures; ++n)
    {
      parameters.drill = upTo(3) > 0 ? 1 : 0;
      servoThread.setParameters(parameters);
      for (int asked = upTo(5) - 3; asked > 0; --asked)
        upTo(2) > 0 ? thread.undo() : thread.redo();
      if (upTo(1) == 0)
        std::this_thread::sleep_for(std::chrono::milliseconds(upTo(20)));
      follow();
      open += seen.strokeOpen();
    }
    servoThread.stop();
    thread.stop();
    EXPECT_EQ(thread.takeFailure(), "");
    ticks += servoThread.state().ticks;
    follow();
    ASSERT_EQ(voxelsOf(seen), scene.voxels());
    ASSERT_EQ(seen.strokes(), scene.work.strokes());
    ASSERT_EQ(seen.applied(), scene.work.applied());
    ASSERT_FALSE(seen.strokeOpen());
    // It is also the history's: undo and redo on the copy lead to the same bits.
    dissection::Dissection again = seen;
    while (again.undo())
    {
    }
    EXPECT_TRUE(again.mask().untouched());
    while (again.applied() < seen.applied() && again.redo())
    {
    }
    ASSERT_EQ(voxelsOf(again), scene.voxels());
    EXPECT_LE(scene.mask->statesHeld(), 2u); // the current one, and the reader's last
  }
  EXPECT_GT(closed, 5u);
  EXPECT_GT(open, 5u);
  EXPECT_GT(ticks, 500u);
}

TEST_F(Following, StopLosesNoStrokeAndNoRequest)
{
  Session& session = scene.session;
  session.go({0.0, 0.0, 3.0}, {0.0, 0.0, 1.0}, 50);
  session.pedal = 1.0;
  // All of the servo's ticks and the requests, before the thread first looks.
  for (int n = 0; n < 50; ++n)
    ring.push(session.tick({{0.0, 0.0, 1.0}, Eigen::Quaterniond::Identity()}));
  {
    DissectionThread thread(ring, loop, hooks());
    thread.stop();
  }
  follow();
  EXPECT_EQ(closed, 1u);
  EXPECT_FALSE(seen.mask().untouched());
  {
    DissectionThread thread(ring, loop, hooks());
    thread.undo();
    thread.redo();
    thread.undo();
    thread.stop();
  }
  follow();
  EXPECT_EQ(applied, 0u);
  EXPECT_TRUE(seen.mask().untouched());
  EXPECT_EQ(seen.strokes().size(), 1u);
}

TEST_F(Following, ACutThatFailsLeavesWhatWasCutAndIsReportedOnce)
{
  int cuts = 0; // out of memory after the 21st
  const auto failing = [&cuts](const MaskEdit& edit)
  {
    if (edit.kind == MaskEdit::Kind::Cut && ++cuts > 20)
      throw std::bad_alloc();
  };
  DissectionLoop cutter(scene.work, *scene.mask, scene.removalModel, {},
                        reporter.listen({}, failing, {}));
  Session& session = scene.session;
  session.go({0.0, 0.0, 3.0}, {0.0, 0.0, 1.0}, 50);
  session.pedal = 1.0;
  int taken = 0;
  std::atomic<int> done{0};
  DissectionThread thread(ring, cutter,
                          {[&](const TickRecord& record)
                           {
                             reporter.note(record);
                             ++taken;
                           },
                           [&]
                           {
                             reporter.post();
                             done = taken;
                           }});
  std::string failure;
  for (int n = 1; n <= 200; ++n)
  {
    ring.push(session.tick({{0.0, 0.0, 1.0}, Eigen::Quaterniond::Identity()}));
    ASSERT_TRUE(core::testing::eventually([&] { return done == n; })) << n;
    if (const std::string statusMessage = thread.takeFailure(); !statusMessage.empty())
    {
      EXPECT_EQ(failure, "") << "reported twice";
      failure = statusMessage;
    }
  }
  EXPECT_TRUE(thread.failed());
  thread.stop();
  EXPECT_NE(failure.find("Cutting failed"), std::string::npos) << failure;
  EXPECT_EQ(cuts, 21);
  follow();
  EXPECT_EQ(closed, 1u);
  EXPECT_FALSE(seen.mask().untouched());
  EXPECT_EQ(voxelsOf(seen), scene.voxels());
  EXPECT_FALSE(seen.strokeOpen());
}

TEST_F(Following, AStrokeIsClosedAlsoWhereItCannotBeMeasured)
{
  DissectionLoop cutter(scene.work, *scene.mask, scene.removalModel, {},
                        reporter.listen({}, {},
                                        [](dissection::Dissection&)
                                        { throw std::runtime_error("the labels are damaged"); }));
  Session& session = scene.session;
  session.go({0.0, 0.0, 3.0}, {0.0, 0.0, 1.0}, 50);
  session.pedal = 1.0;
  for (int n = 0; n < 20; ++n)
    cutter.step(session.tick({{0.0, 0.0, 1.0}, Eigen::Quaterniond::Identity()}));
  cutter.endStroke();
  reporter.post();
  EXPECT_EQ(reporter.takeComplaint(), "the labels are damaged");
  EXPECT_EQ(reporter.takeComplaint(), "");
  follow();
  EXPECT_EQ(closed, 1u);
  EXPECT_EQ(seen.strokes(), scene.work.strokes());
}
