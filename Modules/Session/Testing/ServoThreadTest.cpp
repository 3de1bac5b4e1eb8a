#include <chrono>
#include <cmath>
#include <thread>

#include <gtest/gtest.h>

#include "../../Core/Testing/Eventually.h"
#include "BoneBlock.h"
#include "SimulatedDevice.h"
#include "petrous/Core/Error.h"
#include "petrous/Haptics/ConstrainedProxy.h"
#include "petrous/Session/DissectionThread.h"
#include "petrous/Session/ServoThread.h"

using namespace petrous;
using namespace petrous::session;
using namespace petrous::session::testing;
using core::testing::eventually;
using Eigen::Quaterniond;
using Eigen::Vector3d;

namespace
{

// A device that presses into the plane and retracts, about twice a second.
haptics::Pose pressing(double t)
{
  return {{3.0 * std::sin(9.0 * t), 3.0 * std::cos(7.0 * t), 1.0 + 2.0 * std::sin(15.0 * t)},
          Quaterniond::Identity()};
}

std::vector<TickRecord> drained(SpscRing<TickRecord>& ring)
{
  std::vector<TickRecord> records(ring.capacity());
  records.resize(ring.pop(records.data(), records.size()));
  return records;
}

// Sleeps in one of its readings, like a suspended machine.
class SleepyDevice : public haptics::SimulatedDevice
{
public:
  SleepyDevice(int when, std::chrono::milliseconds length)
    : SimulatedDevice(pressing)
    , m_when(when)
    , m_length(length)
  {
  }
  haptics::DeviceReading read(double now) noexcept override
  {
    if (m_reads++ == m_when)
      std::this_thread::sleep_for(m_length);
    return SimulatedDevice::read(now);
  }

private:
  int m_when;
  std::chrono::milliseconds m_length;
  int m_reads = 0;
};

// Leaves a quarter of a millimetre to the next tick, in every second tick.
class SlowProxy : public PlaneProxy
{
public:
  const haptics::ProxyTick& step(const haptics::Pose& goal) noexcept override
  {
    m_tick = PlaneProxy::step(goal);
    m_tick.postponed = m_steps++ % 2 ? 0.25 : 0.0;
    return m_tick;
  }

  std::size_t steps() const noexcept { return m_steps; } ///< of a thread that has stopped

private:
  haptics::ProxyTick m_tick;
  std::size_t m_steps = 0;
};

// Touch in one thread; cuts, undo and redo in another; a window's queries in this one.
void touchCutAndUndo(LoopScene& scene, Servo& tool)
{
  DissectionLoop loop(scene.work, *scene.mask, scene.removalModel);
  haptics::SimulatedDevice device(pressing);
  SpscRing<TickRecord> ring(4096);
  ServoParameters parameters;
  parameters.drill = 1;
  std::uint64_t recorded = 0;
  {
    ServoThread servo(tool, device, ring, parameters);
    DissectionThread dissection(ring, loop, {[&recorded](const TickRecord&) { ++recorded; }, {}});
    for (int n = 0; n < 12; ++n)
    {
      const std::uint64_t from = servo.state().ticks;
      EXPECT_TRUE(eventually([&] { return servo.state().ticks > from + 60; }));
      n % 3 == 2 ? dissection.redo() : dissection.undo();
      parameters.drill = n % 2 ? 1 : 0;
      servo.setParameters(parameters);
      TickRecord latest;
      EXPECT_TRUE(servo.latest(latest));
      EXPECT_TRUE(latest.proxy.pose().finite());
    }
    for (const bool drill : {false, true}) // after an undo it must have been off
    {
      parameters.drill = drill;
      servo.setParameters(parameters);
      const std::uint64_t from = servo.state().ticks;
      EXPECT_TRUE(eventually([&] { return servo.state().ticks > from + 100; }));
    }
    servo.stop();
    dissection.stop();
    EXPECT_EQ(dissection.takeFailure(), "");
    EXPECT_EQ(recorded + servo.state().dropped, servo.state().ticks);
  }
  EXPECT_GT(loop.cuts(), 10u);
  EXPECT_GE(scene.work.strokes().size(), 1u);
  EXPECT_FALSE(scene.work.strokeOpen());
}

} // namespace

TEST(ServoThread, TicksPublishesAndStopsWithTheForceGone)
{
  PlaneProxy proxy;
  Servo servo(proxy, Session::plainSetup());
  haptics::SimulatedDevice device(pressing);
  SpscRing<TickRecord> ring(1 << 16);
  ServoThread thread(servo, device, ring, {});
  EXPECT_TRUE(eventually([&] { return thread.state().ticks > 200; }));
  EXPECT_TRUE(thread.state().running);
  TickRecord latest;
  ASSERT_TRUE(thread.latest(latest));
  EXPECT_GT(latest.number, 0u);
  thread.stop();
  thread.stop();
  const ServoThread::State state = thread.state();
  EXPECT_FALSE(state.running);
  EXPECT_EQ(state.dropped, 0u);
  EXPECT_GT(state.worstWall, 0.0);
  EXPECT_EQ(state.worstWall, thread.wallTimes().max());
  EXPECT_EQ(thread.wallTimes().count(), state.ticks);
  EXPECT_EQ(thread.lateness().count(), state.ticks);
  EXPECT_GE(thread.wallTimes().max(), thread.wallTimes().quantile(0.5));
  EXPECT_EQ(state.postponed, 0u);
  EXPECT_EQ(state.worstPostponed, 0.0);
  EXPECT_EQ(device.sent().linear, Vector3d(0.0, 0.0, 0.0));

  const auto records = drained(ring);
  ASSERT_EQ(records.size(), state.ticks);
  for (std::size_t n = 0; n < records.size(); ++n)
  {
    ASSERT_EQ(records[n].number, n);
    if (n > 0)
    {
      ASSERT_GT(records[n].time(), records[n - 1].time());
    }
  }
  EXPECT_EQ(forceOf(records.back().output), Vector3d(0.0, 0.0, 0.0));
}

TEST(ServoThread, CountsTheTicksThatLeaveMotionToTheNext)
{
  SlowProxy proxy;
  Servo servo(proxy, Session::plainSetup());
  haptics::SimulatedDevice device(pressing);
  SpscRing<TickRecord> ring(1 << 16);
  ServoThread thread(servo, device, ring, {});
  EXPECT_TRUE(eventually([&] { return thread.state().ticks > 100; }));
  thread.stop();
  EXPECT_GT(proxy.steps(), 50u); // none before the first usable reading, which places the tool
  EXPECT_EQ(thread.state().postponed, proxy.steps() / 2);
  EXPECT_EQ(thread.state().worstPostponed, 0.25);
}

TEST(ServoThread, TakesNewParameters)
{
  PlaneProxy proxy;
  Servo servo(proxy, Session::plainSetup());
  haptics::SimulatedDevice device(pressing);
  SpscRing<TickRecord> ring(16);
  ServoThread thread(servo, device, ring, {});
  ServoParameters parameters;
  parameters.drill = 1;
  thread.setParameters(parameters);
  TickRecord latest;
  EXPECT_TRUE(eventually([&] { return thread.latest(latest) && latest.drill; }));
  parameters.scale = -1.0;
  EXPECT_THROW(thread.setParameters(parameters), core::InvalidParameter);
  EXPECT_TRUE(eventually([&] { return thread.state().dropped > 0; })); // the ring is not emptied
}

TEST(ServoThread, DoesNotMakeUpForTheTicksOfAStall)
{
  PlaneProxy proxy;
  Servo servo(proxy, Session::plainSetup());
  SleepyDevice device(150, std::chrono::milliseconds(200));
  SpscRing<TickRecord> ring(1 << 16);
  {
    ServoThread thread(servo, device, ring, {});
    EXPECT_TRUE(eventually([&] { return thread.state().ticks > 300; }));
    thread.stop();
    EXPECT_GT(thread.state().late, 0u);
    EXPECT_GE(thread.state().worstWall, 0.2);
  }
  const auto records = drained(ring);
  ASSERT_GT(records.size(), 300u);
  ASSERT_GE(records[151].time() - records[150].time(), 0.2);
  EXPECT_EQ(faultOf(records[151]), ServoFault::Stalled);
  // Made up for, 200 ticks would come at once. On the grid there is at most one per millisecond.
  const double end = records[151].time() + 0.05;
  std::size_t soon = 0;
  for (std::size_t n = 151; n < records.size() && records[n].time() <= end; ++n)
    ++soon;
  EXPECT_LE(soon, 53u);
}

TEST(ServoThread, RefusesAPeriodThatCannotBe)
{
  PlaneProxy proxy;
  Servo servo(proxy, Session::plainSetup());
  haptics::SimulatedDevice device(pressing);
  SpscRing<TickRecord> ring(16);
  EXPECT_THROW(ServoThread(servo, device, ring, {}, 0.0), core::InvalidParameter);
  ServoParameters bad;
  bad.thrust = std::nan("");
  EXPECT_THROW(ServoThread(servo, device, ring, bad), core::InvalidParameter);
}

TEST(ServoThread, TouchesWhatAnotherThreadCutsAndUndoes)
{
  LoopScene scene;
  touchCutAndUndo(scene, scene.session.servo);
}

TEST(ServoThread, TouchesItWithTheConstrainedTool)
{
  LoopScene scene;
  const haptics::PointShell shell = haptics::makeBurrShell({}, 0.3, 400);
  haptics::ConstrainedProxy proxy(boneOf(scene.mask), shell);
  ServoSetup setup = Session::plainSetup();
  setup.burrPoints = shell.burrCount;
  Servo servo(proxy, setup);
  touchCutAndUndo(scene, servo);
}

TEST(DissectionThread, GoesOnCuttingWhenTheRecordingFails)
{
  LoopScene scene;
  DissectionLoop loop(scene.work, *scene.mask, scene.removalModel);
  SpscRing<TickRecord> ring(4096);
  Session& session = scene.session;
  session.go({0.0, 0.0, 3.0}, {0.0, 0.0, 1.0}, 50);
  session.pedal = 1.0;
  int calls = 0;
  DissectionThread thread(ring, loop,
                          {[&calls](const TickRecord&)
                           {
                             ++calls;
                             throw std::runtime_error("the disk is full");
                           },
                           {}});
  for (int n = 0; n < 50; ++n)
    ring.push(session.tick({{0.0, 0.0, 1.0}, Quaterniond::Identity()}));
  thread.stop();
  EXPECT_EQ(calls, 1);
  EXPECT_GT(loop.cuts(), 0u);
  EXPECT_EQ(scene.work.strokes().size(), 1u);
  EXPECT_EQ(thread.takeFailure(), "Recording failed: the disk is full");
  EXPECT_EQ(thread.takeFailure(), "");
}
