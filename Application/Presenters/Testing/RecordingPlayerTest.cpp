#include <cmath>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <functional>
#include <set>

#include <gtest/gtest.h>

#include <unistd.h>

#include "BoneCase.h"
#include "HeldTool.h"
#include "petrous/Presenters/RecordingPlayer.h"
#include "petrous/Presenters/Recordings.h"
#include "petrous/Session/PathDrill.h"

using namespace petrous;
using namespace petrous::presenters;
using Eigen::Vector3d;
using namespace petrous::presenters::testing;

namespace
{

class RecordingPlayerTest : public ::testing::TestWithParam<session::TouchTool::Mode>
{
protected:
  void SetUp() override { std::filesystem::create_directories(folder); }
  void TearDown() override { std::filesystem::remove_all(folder); }

  // As in a window: drills, slides on, undoes while pressed, redoes.
  void liveSession(scene::Case& value, session::TouchScene& scene)
  {
    HeldTool held(Vector3d(5.0, 6.0, kTop + 2.5), GetParam());
    held.setup.recording = file;
    // A burr that sinks into bone removes at once what it overlaps; it must not emerge below.
    const bool sinks = GetParam() == session::TouchTool::Mode::ThreeDof;
    const std::uint64_t states = sinks ? 1 : 8;
    session::TouchSession session(value, scene, held.device, held.setup);
    std::uint64_t felt = 0; // number of the mask's state
    double thrust = 0.0;    // N
    std::size_t steps = 0;
    const auto frames = [&](const std::function<bool()>& enough)
    {
      ASSERT_TRUE(until(
          [&]
          {
            const auto news = session.advance();
            steps += news.steps.size();
            if (news.record)
            {
              held.device.see(*news.record);
              felt = news.record->maskState;
              thrust = news.record->thrust;
            }
            return enough();
          }));
    };
    const auto after = [&](std::uint64_t ticks)
    {
      return [&session, end = session.state().ticks + ticks]
      { return session.state().ticks >= end; };
    };
    frames([&thrust] { return thrust > 0.0; });
    frames(after(80));
    for (int round = 0; round < (sinks ? 1 : 3); ++round)
    {
      held.drill(true);
      frames([&, end = felt + states] { return felt >= end; });
      if (sinks)
        held.drill(false);
      haptics::Pose aside;
      aside.position = Vector3d(5.5 + 0.5 * round, 6.0, kTop + 2.5);
      held.device.want(aside);
      frames(after(150));
      if (round == 0)
        held.drill(false);
      frames(after(20));
      session.undo();
      frames([&, end = steps + 1] { return steps >= end; });
      frames(after(60));
      if (round == 0)
      {
        session.redo();
        frames([&, end = steps + 1] { return steps >= end; });
      }
    }
    const auto news = session.stop();
    EXPECT_EQ(news.recordingFault, "");
    EXPECT_FALSE(session.recording()->recording());
    EXPECT_EQ(session.recording()->ticks(), session.state().ticks);
    EXPECT_EQ(session.recording()->bytes(), std::filesystem::file_size(file));
  }

  // What is replayed on that case; the replay itself compares the forces.
  session::RecordingReplay::Outcome replayed(scene::Case& value)
  {
    session::RecordingReader reader(file);
    session::TouchScene scene(value, {}, reader.setup().scene.firstState);
    RecordingPlayer replay(value, scene, reader, "session.ticks");
    const session::TickRecord* recorded = nullptr;
    while ((recorded = replay.next()))
    {
      const session::TickRecord& felt = replay.feel();
      differences += std::memcmp(recorded, &felt, sizeof felt) != 0;
      pressed += felt.thrust > 0.0;
    }
    return replay.outcome();
  }

  std::string refusal(scene::Case& value)
  {
    try
    {
      replayed(value);
    }
    catch (const core::InvalidParameter& error)
    {
      return error.what();
    }
    return "was played";
  }

  static std::vector<std::uint16_t> voxels(const scene::Case& value)
  {
    const auto dense = value.dissection.mask().dense();
    return {dense.data(), dense.data() + dense.size()};
  }

  std::filesystem::path folder = std::filesystem::temp_directory_path() /
                                 ("petrous-hand-replay-" + std::to_string(::getpid()));
  std::filesystem::path file = folder / "session.ticks";
  std::size_t differences = 0, pressed = 0;
};

} // namespace

TEST_P(RecordingPlayerTest, OfALiveSessionIsTheSessionToTheLastBit)
{
  scene::Case first = block();
  {
    session::TouchScene scene(first);
    liveSession(first, scene);
  }
  scene::Case second = block();
  const auto outcome = replayed(second);
  EXPECT_TRUE(outcome.equal()) << outcome.difference;
  EXPECT_EQ(outcome.warning, "");
  EXPECT_EQ(differences, 0u);
  EXPECT_GT(outcome.ticks, 250u);
  EXPECT_GT(pressed, 50u);
  EXPECT_FALSE(first.dissection.mask().untouched());
  EXPECT_EQ(voxels(second), voxels(first));
  ASSERT_EQ(second.dissection.strokes().size(), first.dissection.strokes().size());
  EXPECT_EQ(second.applied(), first.applied());
  for (std::size_t n = 0; n < first.dissection.strokes().size(); ++n)
  {
    EXPECT_EQ(second.dissection.strokes()[n]->info.removed,
              first.dissection.strokes()[n]->info.removed);
    EXPECT_EQ(second.dissection.strokes()[n]->info.duration,
              first.dissection.strokes()[n]->info.duration);
    EXPECT_EQ(second.dissection.strokes()[n]->info.burr.diameter,
              first.dissection.strokes()[n]->info.burr.diameter);
  }
}

TEST_P(RecordingPlayerTest, GoesOnFromWhereASceneWasThatOthersHadUsed)
{
  scene::Case first = block();
  scene::Case second = block();
  session::TouchScene scene(first);
  {
    // An earlier session, not recorded: the case and the mask's state numbers continue from it.
    HeldTool held(Vector3d(5.0, 5.0, kTop + 2.5), GetParam());
    session::TouchSession session(first, scene, held.device, held.setup);
    held.drill(true);
    ASSERT_TRUE(until(
        [&]
        {
          const auto record = session.advance().record;
          return record && record->maskState > 5;
        }));
    session.stop();
  }
  second.dissection = first.dissection;
  liveSession(first, scene);
  const auto outcome = replayed(second);
  EXPECT_TRUE(outcome.equal()) << outcome.difference;
  EXPECT_EQ(voxels(second), voxels(first));
}

TEST_P(RecordingPlayerTest, RefusesACaseThatIsNotAsItWas)
{
  scene::Case first = block();
  {
    session::TouchScene scene(first);
    liveSession(first, scene);
  }
  const std::string done = refusal(first);
  EXPECT_NE(done.find("session.ticks: began on another dissection (0 strokes)"), std::string::npos)
      << done;
  EXPECT_NE(done.find("petrous undo 'block' " + std::to_string(first.applied())), std::string::npos)
      << done;
  first.dissection.undo(first.applied());
  EXPECT_TRUE(replayed(first).equal());

  scene::Case other = block();
  other.iso = 310.0;
  EXPECT_NE(refusal(other).find("--iso 300"), std::string::npos) << refusal(other);
  scene::Case voxel = block();
  auto ct = std::make_shared<volume::Volume<std::int16_t>>(voxel.ct.geometry);
  voxel.ct.volume.get()->visit(
      [&ct](const auto& from)
      {
        std::transform(from.data(), from.data() + from.size(), ct->data(),
                       [](auto value) { return static_cast<std::int16_t>(value); });
      });
  ct->at(1, 2, 3) = static_cast<std::int16_t>(ct->at(1, 2, 3) + 1);
  voxel.ct.volume = std::make_shared<const volume::IntensityVolume>(
      std::shared_ptr<const volume::Volume<std::int16_t>>(ct));
  EXPECT_NE(refusal(voxel).find("another CT"), std::string::npos);
  voxel.ct.modality = scene::Modality::Mr;
  EXPECT_NE(refusal(voxel).find("another MR"), std::string::npos) << refusal(voxel);
  other.ct.modality = scene::Modality::Mr;
  EXPECT_NE(refusal(other).find("with tissue from 300 on"), std::string::npos) << refusal(other);
}

TEST_P(RecordingPlayerTest, OfAToolPathIsThePath)
{
  scene::Case first = block();
  std::vector<session::TickRecord> felt;
  {
    session::TouchScene scene(first);
    session::PathDrill::Options options;
    options.tool.mode = GetParam();
    options.recording = file;
    session::PathDrill drill(first, scene, options);
    // It starts inside, where the drill removes what the burr sweeps, comes out and presses again.
    for (int n = 0; n < 600; ++n)
    {
      const double t = 0.001 * n;
      dissection::ToolSample sample;
      sample.time = t;
      const double z = kTop + (t < 0.1   ? -1.0 - 10.0 * t
                               : t < 0.4 ? -2.0 + 20.0 * (t - 0.1)
                                         : 4.0 - 20.0 * (t - 0.4));
      sample.pose = core::RigidTransform(Eigen::Quaterniond::Identity(), {4.0 + 5.0 * t, 6.0, z});
      sample.drill = n % 250 < 200;
      felt.push_back(drill.feel(sample));
      drill.cut(sample);
    }
    drill.end();
    EXPECT_EQ(drill.recording()->ticks(), 600u);
  }
  EXPECT_EQ(felt.front().status, static_cast<std::uint8_t>(haptics::ProxyStatus::Inside));
  EXPECT_EQ(felt.back().status, static_cast<std::uint8_t>(haptics::ProxyStatus::Contact));
  scene::Case second = block();
  const auto outcome = replayed(second);
  EXPECT_TRUE(outcome.equal()) << outcome.difference;
  EXPECT_EQ(outcome.ticks, 600u);
  EXPECT_EQ(voxels(second), voxels(first));
  ASSERT_EQ(second.dissection.strokes().size(), first.dissection.strokes().size());
  EXPECT_GE(first.dissection.strokes().size(), 2u);
}

TEST_P(RecordingPlayerTest, SaysThatARecordingCannotBeBegun)
{
  scene::Case value = block();
  session::TouchScene scene(value);
  HeldTool held(Vector3d(5.0, 6.0, kTop + 2.5), GetParam());
  held.setup.recording = folder / "missing" / "session.ticks";
  EXPECT_THROW(session::TouchSession(value, scene, held.device, held.setup),
               session::RecordingError);
}

INSTANTIATE_TEST_SUITE_P(Modes, RecordingPlayerTest,
                         ::testing::Values(session::TouchTool::Mode::SixDof,
                                           session::TouchTool::Mode::ThreeDof),
                         [](const auto& mode) {
                           return mode.param == session::TouchTool::Mode::SixDof ? "Six" : "Three";
                         });

TEST(Recordings, HaveNamesOfTheirOwnBesideTheCases)
{
  const auto folder =
      std::filesystem::temp_directory_path() / ("petrous-recordings-" + std::to_string(::getpid()));
  const library::Library library(folder);
  const scene::Case value = block();
  std::set<std::filesystem::path> seen;
  for (int n = 0; n < 3; ++n)
  {
    const auto file = newRecording(library, value);
    EXPECT_EQ(file.parent_path(), folder / "recordings");
    EXPECT_EQ(file.filename().string().find("block 2"), 0u) << file;
    EXPECT_TRUE(seen.insert(file).second);
    std::ofstream(file) << "taken";
  }
  EXPECT_TRUE(library.list().empty()) << "a recording is no case";
  std::filesystem::remove_all(folder);
}
