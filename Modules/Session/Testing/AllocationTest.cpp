#include <algorithm>
#include <memory>
#include <new>
#include <random>

#include <gtest/gtest.h>

#include "AllocationHook.h"
#include "BoneBlock.h"
#include "SimulatedDevice.h"
#include "petrous/Core/SnapshotBuffer.h"
#include "petrous/Haptics/ConstrainedProxy.h"
#include "petrous/Session/DissectionUpdate.h"
#include "petrous/Session/ServoThread.h"
#include "petrous/Session/SpscRing.h"

using namespace petrous;
using namespace petrous::session;
using namespace petrous::session::testing;
using Eigen::Quaterniond;
using Eigen::Vector3d;

namespace
{

haptics::Pose handAt(double t)
{
  return {{4.0 * std::sin(1.7 * t), 4.0 * std::cos(2.3 * t), 1.0 + 3.0 * std::sin(5.0 * t)},
          Quaterniond(Eigen::AngleAxisd(0.5 * std::sin(t), Vector3d(0.6, 0.8, 0.0)))};
}

void tickThrough(const std::vector<haptics::SoftStructure>& soft)
{
  LoopScene scene;
  DissectionLoop loop(scene.work, *scene.mask, scene.removalModel);
  const auto field = boneOf(scene.mask, soft);
  const haptics::PointShell shell = haptics::makeBurrShell({}, 0.3, 800);
  ServoSetup setup = Session::plainSetup();
  setup.burrPoints = shell.burrCount;
  setup.passivity.emplace();
  haptics::ConstrainedProxy proxy(field, shell);
  Servo servo(proxy, setup);
  haptics::SimulatedDevice device([](double t) { return handAt(t); });
  SpscRing<TickRecord> ring(64);
  core::SnapshotBuffer<TickRecord> latest;
  ServoParameters parameters;

  std::uint64_t inTicks = 0;
  std::uint64_t contacts = 0;
  std::uint64_t faults = 0;
  for (int n = 0; n < 10000; ++n)
  {
    const double now = 0.001 * n;
    parameters.drill = n % 1000 > 600;
    parameters.constantThrust = n > 6000;
    parameters.clutch = n % 3000 > 2900;
    const std::uint64_t before = allocationCount();
    haptics::DeviceReading reading = device.read(now);
    if (n > 4000 && n < 4050)
      reading.pose.position.x() = std::nan("");
    const TickRecord& record = servo.tick(TickInput::of(now, reading, parameters));
    device.send(record.output.wrench());
    latest.write(record);
    ring.push(record);
    inTicks += allocationCount() - before;
    contacts += record.contacts > 0;
    faults += record.fault != 0;
    TickRecord item;
    ring.pop(item);
    loop.step(item);
    if (n % 2500 == 2499)
      loop.undo();
  }
  EXPECT_EQ(inTicks, 0u);
  EXPECT_GT(contacts, 3000u);
  EXPECT_GT(faults, 50u);
  EXPECT_GT(loop.cuts(), 300u);
}

} // namespace

TEST(AllocationHook, SeesNewAndMalloc)
{
  const std::uint64_t before = allocationCount();
  auto* volatile number = new int(3);
  delete number;
  void* volatile memory = std::malloc(10);
  std::free(memory);
  EXPECT_EQ(allocationCount() - before, 4u);
}

TEST(ServoTick, AllocatesNothingInTenThousandTicksWithFaultsAndCuts)
{
  tickThrough({});
}

TEST(ServoTick, AllocatesNothingInSoftTissue)
{
  tickThrough({softLayer()});
}

TEST(DissectionLoop, WithoutMemoryAtAnyPointKeepsMaskAndHistoryTogether)
{
  int failures = 0;
  for (std::uint64_t n = 1; n < 1000; ++n)
  {
    LoopScene scene;
    const dissection::SweptSphere first{{0.0, 0.0, 1.0}, {0.0, 0.0, 1.0}, 2.0};
    dissection::Dissection seen = scene.work;
    UpdateQueue queue;
    DissectionReporter reporter(scene.work, queue);
    DissectionLoop loop(scene.work, *scene.mask, scene.removalModel, {},
                        reporter.listen({}, {}, {}));
    TickRecord record;
    record.input.now = 1.0;
    ASSERT_TRUE(loop.sweep(record, first));
    bool failed = false;
    failAllocation(n);
    try
    {
      // Bricks of the first cut and new ones.
      loop.sweep(record, {{0.0, 0.0, 1.0}, {3.0, 0.0, -3.0}, 2.0});
    }
    catch (const std::bad_alloc&)
    {
      failed = true;
    }
    failAllocation(0);
    loop.endStroke();
    reporter.post();
    DissectionUpdate mail = queue.take();
    follow(mail, seen);
    const auto cut = scene.voxels();
    const auto dense = seen.mask().dense();
    ASSERT_TRUE(std::equal(cut.begin(), cut.end(), dense.data())) << n;
    ASSERT_TRUE(loop.undo());
    ASSERT_TRUE(scene.work.mask().untouched()) << n << ": cut, and in no stroke";
    ASSERT_TRUE(loop.redo());
    ASSERT_EQ(scene.voxels(), cut) << n;
    if (!failed)
    {
      EXPECT_GT(failures, 5);
      return;
    }
    ++failures;
  }
  FAIL() << "no cut came through";
}

// The parts of a tick cannot throw.
static_assert(noexcept(std::declval<Servo&>().tick(std::declval<const TickInput&>())));
static_assert(noexcept(std::declval<haptics::Proxy&>().step(std::declval<const haptics::Pose&>())));
static_assert(noexcept(std::declval<haptics::Device&>().read(0.0)));
static_assert(
    noexcept(std::declval<haptics::Device&>().send(std::declval<const haptics::Wrench&>())));
static_assert(noexcept(std::declval<haptics::DeviceGuard&>().judge(
    std::declval<const haptics::DeviceReading&>(), 0.0)));
static_assert(noexcept(
    std::declval<haptics::ForceLimits&>().apply(std::declval<const haptics::Wrench&>(), 0.0)));
static_assert(noexcept(std::declval<PoseMapping&>().map(std::declval<const haptics::Pose&>(),
                                                        std::declval<const PoseMapping::View&>())));
static_assert(
    noexcept(std::declval<SpscRing<TickRecord>&>().push(std::declval<const TickRecord&>())));
static_assert(noexcept(
    std::declval<core::SnapshotBuffer<TickRecord>&>().write(std::declval<const TickRecord&>())));
static_assert(noexcept(
    std::declval<core::SnapshotBuffer<ServoParameters>&>().read(std::declval<ServoParameters&>())));
