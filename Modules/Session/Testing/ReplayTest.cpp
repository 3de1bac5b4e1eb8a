#include <filesystem>
#include <functional>
#include <vector>

#include <gtest/gtest.h>

#include <unistd.h>

#include "BoneBlock.h"
#include "petrous/Haptics/ConstrainedProxy.h"
#include "petrous/Session/RecordingReader.h"
#include "petrous/Session/RecordingWriter.h"

using namespace petrous;
using namespace petrous::session;
using namespace petrous::session::testing;
using Eigen::Quaterniond;
using Eigen::Vector3d;

namespace
{

// A device that drills a groove, is disconnected, clutches, and turns the camera.
void perform(Session& session, DissectionLoop& loop)
{
  for (int n = 0; n < 1500; ++n)
  {
    const double t = 0.001 * n;
    const haptics::Pose devicePose{
        {3.0 * std::sin(2.0 * t), 2.0 * std::cos(3.0 * t), 2.5 + 2.0 * std::cos(5.0 * t)},
        Quaterniond(Eigen::AngleAxisd(0.3 * t, Vector3d(0.6, 0.0, 0.8)))};
    session.pedal = n % 400 < 300 ? 1.0 : 0.0;
    session.health =
        n > 700 && n < 750 ? haptics::DeviceHealth::Disconnected : haptics::DeviceHealth::Good;
    session.parameters.clutch = n > 900 && n < 950;
    session.parameters.constantThrust = n > 1200;
    if (n > 1000)
    {
      session.parameters.camera[0] = std::cos(0.2 * t);
      session.parameters.camera[2] = std::sin(0.2 * t);
    }
    loop.step(session.tick(devicePose));
  }
}

// The servo on recorded inputs; `after` with each new record, to update the mask.
std::vector<TickRecord> replay(const std::vector<TickRecord>& recorded, Servo& servo,
                               const std::function<void(const TickRecord&)>& after = {})
{
  std::vector<TickRecord> result;
  for (const TickRecord& record : recorded)
  {
    result.push_back(servo.tick(record.input));
    if (after)
      after(result.back());
  }
  return result;
}

} // namespace

TEST(Replay, OfARecordingIsTheRecordingToTheLastBit)
{
  const auto file = std::filesystem::temp_directory_path() /
                    ("petrous-replay-" + std::to_string(::getpid()) + ".ticks");
  LoopScene first;
  DissectionLoop firstLoop(first.work, *first.mask, first.removalModel);
  perform(first.session, firstLoop);
  EXPECT_GT(firstLoop.cuts(), 100u);
  {
    RecordingSetup setup;
    setup.servo = Session::plainSetup();
    RecordingWriter writer(file, setup);
    for (const TickRecord& record : first.session.records)
      writer.add(record);
    writer.close();
  }

  RecordingReader reader(file);
  std::vector<TickRecord> recorded;
  RecordingBlock block;
  while (reader.next(block))
    recorded.insert(recorded.end(), block.ticks.begin(), block.ticks.end());
  LoopScene second;
  DissectionLoop secondLoop(second.work, *second.mask, second.removalModel);
  Servo servo(second.session.proxy, reader.setup().servo);
  const auto again =
      replay(recorded, servo, [&](const TickRecord& record) { secondLoop.step(record); });
  std::filesystem::remove(file);

  ASSERT_EQ(again.size(), first.session.records.size());
  for (std::size_t n = 0; n < again.size(); ++n)
    ASSERT_TRUE(identical(again[n], first.session.records[n])) << n;
  EXPECT_EQ(second.voxels(), first.voxels());
  EXPECT_EQ(second.work.strokes().size(), first.work.strokes().size());
}

TEST(Replay, DiffersWhereTheMaskIsNotCut)
{
  LoopScene first;
  DissectionLoop loop(first.work, *first.mask, first.removalModel);
  perform(first.session, loop);
  LoopScene second;
  Servo servo(second.session.proxy, Session::plainSetup());
  const auto again = replay(first.session.records, servo);
  std::size_t different = 0;
  for (std::size_t n = 0; n < again.size(); ++n)
    different += !identical(again[n], first.session.records[n]);
  EXPECT_GT(different, 500u);
}

TEST(Replay, IsTheSameWithTheConstrainedTool)
{
  const haptics::PointShell shell = haptics::makeBurrShell({}, 0.3, 600);
  ServoSetup setup = Session::plainSetup();
  setup.burrPoints = shell.burrCount;
  setup.passivity.emplace();

  LoopScene first;
  DissectionLoop firstLoop(first.work, *first.mask, first.removalModel);
  haptics::ConstrainedProxy firstTool(boneOf(first.mask), shell);
  Session session(setup, firstTool);
  perform(session, firstLoop);
  EXPECT_GT(firstLoop.cuts(), 100u);

  LoopScene second;
  DissectionLoop secondLoop(second.work, *second.mask, second.removalModel);
  haptics::ConstrainedProxy secondTool(boneOf(second.mask), shell);
  Servo servo(secondTool, setup);
  const auto again =
      replay(session.records, servo, [&](const TickRecord& record) { secondLoop.step(record); });
  for (std::size_t n = 0; n < again.size(); ++n)
    ASSERT_TRUE(identical(again[n], session.records[n])) << n;
  EXPECT_EQ(second.voxels(), first.voxels());
}
