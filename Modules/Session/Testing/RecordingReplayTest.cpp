#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <csignal>
#include <cstring>
#include <filesystem>
#include <thread>

#include <gtest/gtest.h>

#include "ProportionalRemovalModel.h"
#include <sys/resource.h>
#include <unistd.h>

#include "../../Core/Testing/Eventually.h"
#include "BoneBlock.h"
#include "SimulatedDevice.h"
#include "petrous/Haptics/ConstrainedProxy.h"
#include "petrous/Haptics/PointProxy.h"
#include "petrous/Session/DissectionThread.h"
#include "petrous/Session/RecordingReplay.h"
#include "petrous/Session/ServoThread.h"
#include "petrous/Session/SessionRecorder.h"

using namespace petrous;
using namespace petrous::session;
using namespace petrous::session::testing;
using Eigen::Quaterniond;
using Eigen::Vector3d;

namespace
{

constexpr double kRadius = 2.0; // mm

enum class Tool
{
  Burr,  // six degrees of freedom
  Centre // three
};

// A block of bone that can be cut, and a tool in it, before a session.
struct Workplace
{
  Workplace(Tool tool, std::uint64_t firstState = 0)
    : work(gridOfTheBlock())
    , mask(std::make_shared<volume::PublishedMask>(work.mask(), firstState))
  {
    setup.servo = Session::plainSetup();
    setup.servo.passivity.emplace();
    if (tool == Tool::Burr)
    {
      const haptics::PointShell shell = haptics::makeBurrShell({}, 0.3, 400);
      setup.servo.burrPoints = shell.burrCount;
      proxy = std::make_unique<haptics::ConstrainedProxy>(boneOf(mask), shell);
    }
    else
      proxy = std::make_unique<haptics::PointProxy>(boneOf(mask), haptics::CentreBurr{kRadius});
  }

  DissectionLoop::Hooks hooks()
  {
    DissectionLoop::Hooks result;
    result.edited = [this](const MaskEdit& edit)
    {
      edits.push_back(edit);
      if (recorder)
        recorder->add(edit);
    };
    return result;
  }

  // A stroke before any session.
  void drillBefore(const Vector3d& at)
  {
    work.beginStroke({});
    work.cut({at, at, 1.0});
    work.endStroke();
  }

  std::vector<std::uint16_t> voxels() const
  {
    const auto dense = work.mask().dense();
    return {dense.data(), dense.data() + dense.size()};
  }

  dissection::Dissection work;
  std::shared_ptr<volume::PublishedMask> mask;
  RecordingSetup setup;
  std::unique_ptr<haptics::Proxy> proxy;
  ProportionalRemovalModel removalModel{kRadius};
  SessionRecorder* recorder = nullptr;
  std::vector<MaskEdit> edits;
};

// Descends onto the block, presses at a height of 1 mm (or `lower`) and slides, so that drilling
// sinks in and restored tissue meets it.
class DraggingHand
{
public:
  explicit DraggingHand(double lower)
    : m_lower(lower)
  {
  }
  haptics::Pose operator()(double now)
  {
    if (!m_start)
      m_start = now;
    const double t = now - *m_start;
    const double height = 1.0 - m_lower + 0.6 * std::sin(5.0 * t) + std::max(0.0, 4.0 - 20.0 * t);
    return {{3.0 * std::sin(2.0 * t), 3.0 * std::cos(1.7 * t), height},
            Quaterniond(Eigen::AngleAxisd(0.2 * std::sin(t), Vector3d(0.6, 0.0, 0.8)))};
  }

private:
  double m_lower;                // mm
  std::optional<double> m_start; // s
};

class RecordingReplayTest : public ::testing::TestWithParam<Tool>
{
protected:
  void TearDown() override { std::filesystem::remove(file); }

  // Waits for ticks, as nothing else is known about the time that a test takes.
  static void wait(const ServoThread& servo, std::uint64_t ticks)
  {
    const std::uint64_t until = servo.state().ticks + ticks;
    ASSERT_TRUE(core::testing::eventually([&] { return servo.state().ticks >= until; }));
  }

  // The servo in one thread; cutting, undo and redo in another.
  void liveSession(Workplace& place, int rounds)
  {
    Servo servo(*place.proxy, place.setup.servo);
    SessionRecorder recorder(file, place.setup);
    place.recorder = &recorder;
    DissectionLoop loop(place.work, *place.mask, place.removalModel, {}, place.hooks());
    haptics::SimulatedDevice device{DraggingHand(GetParam() == Tool::Centre ? 1.5 : 0.0)};
    SpscRing<TickRecord> ring(1 << 15);
    ServoParameters parameters;
    ServoThread thread(servo, device, ring, parameters);
    DissectionThread dissection(
        ring, loop,
        {[&](const TickRecord& record)
         {
           recorder.add(&record, 1);
           live.push_back(record);
           retreats += record.status == static_cast<std::uint8_t>(haptics::ProxyStatus::Retreated);
         },
         {}});
    // A slow machine has fewer ticks for the same motion of the device: continue until restored
    // tissue has met the tool.
    for (int n = 0; n < rounds || (retreats == 0 && n < 10 * rounds); ++n)
    {
      parameters.drill = 1;
      thread.setParameters(parameters);
      wait(thread, 150);
      parameters.drill = n % 2 ? 1 : 0; // also undone while still drilling
      thread.setParameters(parameters);
      wait(thread, 20);
      n % 4 == 3 ? dissection.redo() : dissection.undo();
      wait(thread, 80);
    }
    thread.stop();
    dissection.stop();
    recorder.close();
    ASSERT_EQ(thread.state().dropped, 0u);
    ASSERT_EQ(dissection.takeFailure(), "");
    ASSERT_EQ(recorder.takeFailure(), "");
    place.recorder = nullptr;
  }

  RecordingReplay::Outcome replayed(Workplace& place)
  {
    RecordingReader reader(file);
    Servo servo(*place.proxy, reader.setup().servo);
    DissectionLoop loop(place.work, *place.mask, place.removalModel, {}, place.hooks());
    RecordingReplay replay(reader, servo, loop);
    while (replay.next())
      again.push_back(replay.feel());
    return replay.outcome();
  }

  static std::size_t count(const Workplace& place, MaskEdit::Kind kind)
  {
    return static_cast<std::size_t>(std::count_if(place.edits.begin(), place.edits.end(),
                                                  [kind](const MaskEdit& edit)
                                                  { return edit.kind == kind; }));
  }

  std::filesystem::path file =
      std::filesystem::temp_directory_path() / ("petrous-live-" + std::to_string(::getpid()));
  std::vector<TickRecord> live, again;
  std::atomic<std::size_t> retreats{0}; // in the live session
};

} // namespace

TEST_P(RecordingReplayTest, OfASessionThatAnotherThreadCutIsTheSessionToTheLastBit)
{
  Workplace first(GetParam());
  liveSession(first, 8);
  // A meaningful session: several states felt in contact, tissue restored around the tool.
  EXPECT_GT(count(first, MaskEdit::Kind::Cut), 20u);
  EXPECT_GT(count(first, MaskEdit::Kind::Undo), 1u);
  std::size_t states = 0, pressed = 0;
  for (std::size_t n = 1; n < live.size(); ++n)
  {
    states += live[n].maskState != live[n - 1].maskState;
    pressed += live[n].thrust > 0.0;
  }
  EXPECT_GT(states, 20u);
  EXPECT_GT(pressed, live.size() / 4);
  EXPECT_GT(retreats, 0u);

  Workplace second(GetParam());
  const auto outcome = replayed(second);
  EXPECT_TRUE(outcome.equal()) << outcome.difference << " at "
                               << outcome.firstDifferent.value_or(0);
  EXPECT_EQ(outcome.warning, "");
  EXPECT_EQ(outcome.ticks, live.size());
  ASSERT_EQ(again.size(), live.size());
  for (std::size_t n = 0; n < live.size(); ++n)
    ASSERT_EQ(std::memcmp(&again[n], &live[n], sizeof(TickRecord)), 0) << n;
  EXPECT_EQ(second.voxels(), first.voxels());
  ASSERT_EQ(second.work.strokes().size(), first.work.strokes().size());
  EXPECT_EQ(second.work.applied(), first.work.applied());
  for (std::size_t n = 0; n < first.work.strokes().size(); ++n)
    EXPECT_EQ(second.work.strokes()[n]->info.duration, first.work.strokes()[n]->info.duration);
  ASSERT_EQ(second.edits.size(), first.edits.size());
  for (std::size_t n = 0; n < first.edits.size(); ++n)
    ASSERT_EQ(std::memcmp(&second.edits[n], &first.edits[n], sizeof(MaskEdit)), 0) << n;
}

TEST_P(RecordingReplayTest, TakesBackStrokesThatWereThereBeforeTheRecording)
{
  const auto before = [](Workplace& place)
  {
    place.drillBefore({0.0, 3.0, 0.0});
    place.drillBefore({1.0, 3.0, 0.0});
    place.mask->publish(place.work.mask(), place.work.mask().takeDirty(), false);
  };
  Workplace first(GetParam());
  before(first);
  ASSERT_EQ(first.mask->number(), 1u);
  first.setup.scene.firstState = first.mask->number();
  liveSession(first, 5);
  EXPECT_GT(live.back().maskState, first.setup.scene.firstState);
  EXPECT_LE(live.back().maskState, first.mask->number()); // the last cuts come after

  Workplace second(GetParam());
  before(second);
  const auto outcome = replayed(second);
  EXPECT_TRUE(outcome.equal()) << outcome.difference;
  EXPECT_EQ(second.voxels(), first.voxels());
}

TEST_P(RecordingReplayTest, SaysWhereItDiffersWithAnotherDissection)
{
  Workplace first(GetParam());
  liveSession(first, 3);
  Workplace other(GetParam());
  // Different tissue under the device: the difference is reported, and where it begins.
  other.drillBefore({live[100].proxy.position[0], live[100].proxy.position[1], 0.0});
  other.mask->publish(other.work.mask(), other.work.mask().takeDirty(), false);
  const auto outcome = replayed(other);
  EXPECT_FALSE(outcome.equal());
  ASSERT_TRUE(outcome.firstDifferent);
  EXPECT_FALSE(outcome.difference.empty());
  EXPECT_EQ(outcome.ticks, live.size());
  std::uint64_t firstDifferent = 0;
  while (identical(live[firstDifferent], again[firstDifferent]))
    ++firstDifferent;
  EXPECT_EQ(*outcome.firstDifferent, firstDifferent);
}

INSTANTIATE_TEST_SUITE_P(Tools, RecordingReplayTest, ::testing::Values(Tool::Burr, Tool::Centre),
                         [](const auto& tool)
                         { return tool.param == Tool::Burr ? "Burr" : "Centre"; });

TEST(SessionRecorder, EndsWhereTicksWereLostAndHoldsTheSessionUpToThere)
{
  const auto file =
      std::filesystem::temp_directory_path() / ("petrous-gap-" + std::to_string(::getpid()));
  std::vector<TickRecord> ticks(100);
  for (std::size_t n = 0; n < ticks.size(); ++n)
    ticks[n].number = n < 60 ? n : n + 7;
  SessionRecorder recorder(file, {});
  recorder.add(ticks.data(), 50);
  EXPECT_TRUE(recorder.recording());
  recorder.add(ticks.data() + 50, 50);
  EXPECT_FALSE(recorder.recording());
  EXPECT_NE(recorder.takeFailure(), "");
  EXPECT_EQ(recorder.takeFailure(), "");
  recorder.add(ticks.data(), 1);
  recorder.close();
  RecordingReader reader(file);
  RecordingBlock block;
  ASSERT_TRUE(reader.next(block));
  EXPECT_EQ(block.ticks.size(), 60u);
  EXPECT_FALSE(reader.next(block));
  EXPECT_TRUE(reader.complete());
  std::filesystem::remove(file);
}

TEST(SessionRecorder, GivesUpAloneWhenTheDiskIsFull)
{
  const auto file =
      std::filesystem::temp_directory_path() / ("petrous-full-" + std::to_string(::getpid()));
  SessionRecorder recorder(file, {});
  std::vector<TickRecord> ticks(5000);
  for (std::size_t n = 0; n < ticks.size(); ++n)
    ticks[n].number = n;
  // Like a full disk: no file may grow much beyond its size.
  rlimit before{};
  ASSERT_EQ(::getrlimit(RLIMIT_FSIZE, &before), 0);
  const auto old = std::signal(SIGXFSZ, SIG_IGN);
  rlimit small = before;
  small.rlim_cur = recorder.bytes() + 20;
  ASSERT_EQ(::setrlimit(RLIMIT_FSIZE, &small), 0);
  recorder.add(ticks.data(), ticks.size());
  ASSERT_EQ(::setrlimit(RLIMIT_FSIZE, &before), 0);
  std::signal(SIGXFSZ, old);
  EXPECT_FALSE(recorder.recording());
  EXPECT_NE(recorder.takeFailure().find("could not be written"), std::string::npos);
  recorder.add(MaskEdit{});
  recorder.close();
  EXPECT_EQ(recorder.takeFailure(), "");
  std::filesystem::remove(file);
}

TEST(Replay, NamesWhatDiffers)
{
  TickRecord a, b;
  EXPECT_EQ(differenceOf(a, b), "");
  b.contacts = 3;
  EXPECT_EQ(differenceOf(a, b), "contacts, faults or drill");
  b.maskState = 1;
  EXPECT_EQ(differenceOf(a, b), "the state of the mask");
  b.wrench.torque[2] = -0.0;
  EXPECT_EQ(differenceOf(a, b), "the force");
  b.input.pedal = 1.0;
  EXPECT_EQ(differenceOf(a, b), "the device's reading");
}
