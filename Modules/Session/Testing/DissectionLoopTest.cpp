#include <utility>

#include <gtest/gtest.h>

#include "LoopScene.h"
#include "petrous/Core/Error.h"

using namespace petrous;
using namespace petrous::session;
using namespace petrous::session::testing;
using Eigen::Quaterniond;
using Eigen::Vector3d;

namespace
{

TickRecord pressed(double time, const Vector3d& at, double thrust, bool drill)
{
  TickRecord record;
  record.input.now = time;
  record.proxy = PoseValues::of({at, Quaterniond::Identity()});
  record.thrust = thrust;
  record.burrForce[2] = thrust;
  record.drill = drill;
  return record;
}

} // namespace

TEST(DissectionLoop, MakesAStrokeOfEachTimeTheDrillIsOn)
{
  LoopScene scene;
  std::vector<double> durations;
  int begun = 0;
  DissectionLoop::Hooks hooks;
  hooks.begin = [&begun]
  {
    ++begun;
    dissection::StrokeInfo info;
    info.burr.diameter = 4.0;
    return info;
  };
  hooks.close = [&durations](dissection::Dissection& work)
  {
    durations.push_back(work.openInfo().duration);
    work.endStroke();
  };
  DissectionLoop loop(scene.work, *scene.mask, scene.removalModel, {}, hooks);
  double time = 5.0;
  loop.step(pressed(time, {0.0, 0.0, 9.0}, 0.0, false));
  for (int stroke = 0; stroke < 3; ++stroke)
  {
    for (int n = 0; n < 100; ++n)
      loop.step(pressed(time += 0.001, {0.0, 0.0, 1.0 - 0.02 * n}, 1.0, true));
    for (int n = 0; n < 10; ++n)
      EXPECT_FALSE(loop.step(pressed(time += 0.001, {5.0 * stroke, 0.0, 1.0}, 1.0, false)));
  }
  EXPECT_EQ(begun, 3);
  ASSERT_EQ(durations.size(), 3u);
  EXPECT_NEAR(durations[1], 0.1, 1e-9);
  // The second and third strokes find nothing to remove where the first one was.
  ASSERT_EQ(scene.work.strokes().size(), 1u);
  EXPECT_EQ(scene.work.strokes()[0]->info.burr.diameter, 4.0);
  EXPECT_FALSE(scene.work.strokeOpen());
}

TEST(DissectionLoop, KeepsHowFastTheBurrTurnedWhereAPedalSetThat)
{
  LoopScene scene;
  DissectionLoop::Hooks hooks;
  hooks.begin = []
  {
    dissection::StrokeInfo info;
    info.burr.rpm = 40000.0;
    return info;
  };
  DissectionLoop loop(scene.work, *scene.mask, scene.removalModel, {}, hooks);
  double time = 5.0;
  double x = -10.0;
  // A stroke of 100 ticks, the last 25 of them with the second pressure.
  const auto drill = [&](double first, double second, std::uint8_t bits, std::uint8_t lastBits)
  {
    x += 4.0;
    loop.step(pressed(time += 0.001, {x, 0.0, 9.0}, 0.0, false));
    for (int n = 0; n < 100; ++n)
    {
      TickRecord record = pressed(time += 0.001, {x, 0.0, 1.0 - 0.02 * n}, 1.0, true);
      record.input.pedal = n < 75 ? first : second;
      record.input.parameters.drill = n < 75 ? bits : lastBits;
      loop.step(record);
    }
    loop.step(pressed(time += 0.001, {x, 0.0, 9.0}, 0.0, false));
    return scene.work.strokes().back()->info.speed;
  };
  constexpr std::uint8_t kPedal = ServoParameters::kPedalSpeed;
  const auto eased = drill(0.4, 0.8, kPedal, kPedal);
  ASSERT_TRUE(eased);
  EXPECT_NEAR(eased->mean, 40000.0 * (0.75 * 0.4 + 0.25 * 0.8), 1e-6);
  EXPECT_NEAR(eased->max, 32000.0, 1e-9);
  const auto key = drill(0.2, 0.2, kPedal, kPedal | ServoParameters::kDrill);
  ASSERT_TRUE(key);
  EXPECT_NEAR(key->mean, 40000.0 * (0.75 * 0.2 + 0.25), 1e-6) << "a key drills at full speed";
  EXPECT_NEAR(key->max, 40000.0, 1e-9);
  EXPECT_FALSE(drill(0.7, 0.9, 0, 0)) << "the pedal is a switch";
  EXPECT_FALSE(drill(0.0, 0.0, ServoParameters::kDrill, kPedal | ServoParameters::kDrill));
  EXPECT_EQ(scene.work.strokes().size(), 4u);
}

TEST(DissectionLoop, PublishesEachCutAndSaysWhereTissueCameBack)
{
  LoopScene scene;
  std::vector<std::size_t> changed;
  DissectionLoop::Hooks hooks;
  hooks.changed = [&](const std::vector<std::size_t>& bricks) { changed = bricks; };
  DissectionLoop loop(scene.work, *scene.mask, scene.removalModel, {}, hooks);
  EXPECT_FALSE(loop.undo());
  loop.step(pressed(0.000, {0.0, 0.0, 1.0}, 1.0, true));
  EXPECT_TRUE(loop.step(pressed(0.001, {0.0, 0.0, 1.0}, 1.0, true)));
  const volume::MaskState* cut = scene.mask->acquire();
  EXPECT_EQ(cut->number(), 1u);
  EXPECT_EQ(cut->raises(), 0u);
  EXPECT_FALSE(changed.empty());
  for (const std::size_t brick : std::exchange(changed, {}))
    EXPECT_EQ(scene.mask->acquire()->brick(brick), scene.work.mask().brick(brick).get());

  EXPECT_TRUE(loop.undo()); // closes the open stroke
  EXPECT_EQ(scene.mask->acquire()->raises(), 1u);
  EXPECT_TRUE(scene.work.mask().untouched());
  EXPECT_FALSE(changed.empty());
  for (const std::size_t brick : changed)
    EXPECT_EQ(scene.mask->acquire()->brick(brick), nullptr) << brick;
  EXPECT_TRUE(loop.redo());
  EXPECT_EQ(scene.mask->acquire()->raises(), 2u);
  EXPECT_FALSE(scene.work.mask().untouched());
  EXPECT_FALSE(loop.redo());
  scene.mask->release();
}

TEST(DissectionLoop, RepeatsARedoOnlyOfTheStrokeThatWasRedone)
{
  const auto undone = [](LoopScene& scene, double x)
  {
    const Vector3d at(x, 0.0, -1.0);
    scene.work.beginStroke({});
    ASSERT_TRUE(scene.work.cut({at, at, 1.5}));
    scene.work.endStroke();
    ASSERT_EQ(scene.work.undo(), 1u);
  };
  std::vector<MaskEdit> edits;
  DissectionLoop::Hooks hooks;
  hooks.edited = [&edits](const MaskEdit& edit) { edits.push_back(edit); };
  LoopScene recorded;
  undone(recorded, 0.0);
  DissectionLoop loop(recorded.work, *recorded.mask, recorded.removalModel, {}, hooks);
  ASSERT_TRUE(loop.redo());
  ASSERT_EQ(edits.size(), 1u);
  for (const double x : {0.0, 3.0})
  {
    LoopScene scene;
    undone(scene, x);
    DissectionLoop repeated(scene.work, *scene.mask, scene.removalModel);
    EXPECT_EQ(repeated.apply(edits[0]), x == 0.0);
    LoopScene older; // its recording does not tell
    undone(older, x);
    DissectionLoop unchecked(older.work, *older.mask, older.removalModel);
    MaskEdit edit = edits[0];
    edit.setRedone(0);
    EXPECT_TRUE(unchecked.apply(edit));
  }
}

TEST(DissectionLoop, RemovesNothingForTheTimeInWhichTheServoStoodStill)
{
  LoopScene scene;
  DissectionLoop loop(scene.work, *scene.mask, scene.removalModel);
  loop.step(pressed(0.0, {0.0, 0.0, 2.0}, 1.0, true));
  loop.step(pressed(3.0, {0.0, 0.0, 2.0}, 1.0, true)); // 60 mm at 20 mm/s
  EXPECT_LE(scene.work.openInfo().duration, 0.0101);
  const core::GridGeometry& grid = scene.grid;
  EXPECT_EQ(scene.work.mask().sample(grid.voxelFromPatient({0.0, 0.0, -2.0})), 1.0);
}

// On a busy machine the servo misses ticks, and a reading may be lost.
TEST(DissectionLoop, AFaultWhileTheDrillIsHeldDoesNotDivideTheStroke)
{
  LoopScene scene;
  DissectionLoop loop(scene.work, *scene.mask, scene.removalModel);
  double time = 1.0;
  const auto drill = [&](ServoFault fault, bool held)
  {
    TickRecord record =
        pressed(time += 0.001, {0.0, 0.0, 1.0}, 1.0, held && fault == ServoFault::None);
    record.fault = static_cast<std::uint8_t>(fault);
    record.input.parameters.drillButtons = 2;
    record.input.buttons = held ? 2 : 0;
    return loop.step(record);
  };
  EXPECT_FALSE(drill(ServoFault::Stalled, true));
  EXPECT_FALSE(scene.work.strokeOpen()); // it has not begun
  bool cuts = false;
  for (int n = 0; n < 100; ++n)
  {
    const ServoFault fault = n == 40  ? ServoFault::Stalled
                             : n > 60 ? ServoFault::Device
                                      : ServoFault::None;
    const bool cut = drill(n < 90 ? fault : ServoFault::None, true);
    EXPECT_FALSE(cut && fault != ServoFault::None && n < 90);
    cuts = cuts || cut;
    EXPECT_TRUE(scene.work.strokeOpen()) << n;
  }
  EXPECT_TRUE(cuts);
  EXPECT_TRUE(scene.work.strokes().empty()); // the first one is still open
  // On its way back to the pointer the tool does not drill, and the stroke goes on afterwards.
  TickRecord onTheWay = pressed(time += 0.001, {0.0, 0.0, -1.0}, 1.0, false);
  onTheWay.input.parameters.drillButtons = 2;
  onTheWay.input.buttons = 2;
  EXPECT_FALSE(loop.step(onTheWay));
  EXPECT_TRUE(scene.work.strokeOpen());
  onTheWay.input.now = time += 0.001;
  onTheWay.input.parameters.clutch = 1; // the user holds the tool: that ends it
  EXPECT_FALSE(loop.step(onTheWay));
  EXPECT_FALSE(scene.work.strokeOpen());
  EXPECT_EQ(scene.work.strokes().size(), 1u);
  drill(ServoFault::None, true);
  drill(ServoFault::Stalled, false);
  EXPECT_FALSE(scene.work.strokeOpen());
  EXPECT_EQ(scene.work.strokes().size(), 1u);
  // Undone while it is held: it waits for the drill to be switched on anew, also over a fault.
  drill(ServoFault::None, true);
  loop.undo();
  drill(ServoFault::Stalled, true);
  EXPECT_FALSE(drill(ServoFault::None, true));
  EXPECT_FALSE(scene.work.strokeOpen());
}

TEST(DissectionLoop, DoesNotCutWhatCameBackByTicksFromBefore)
{
  LoopScene scene;
  DissectionLoop loop(scene.work, *scene.mask, scene.removalModel);
  for (int n = 0; n < 10; ++n)
    loop.step(pressed(0.001 * n, {0.0, 0.0, 1.0}, 1.0, true));
  ASSERT_TRUE(loop.undo());
  loop.ignoreUntil(0.0125);
  EXPECT_FALSE(loop.step(pressed(0.011, {0.0, 0.0, 0.0}, 1.0, true)));
  EXPECT_FALSE(loop.step(pressed(0.012, {0.0, 0.0, 0.0}, 1.0, true)));
  EXPECT_TRUE(scene.work.mask().untouched());
  EXPECT_TRUE(loop.redo()); // not discarded by a new stroke
}

TEST(DissectionLoop, ADrillThatIsOnAtAnUndoWaitsUntilItIsSwitchedOnAnew)
{
  LoopScene scene;
  int begun = 0;
  DissectionLoop::Hooks hooks;
  hooks.begin = [&begun]
  {
    ++begun;
    return dissection::StrokeInfo();
  };
  DissectionLoop loop(scene.work, *scene.mask, scene.removalModel, {}, hooks);
  for (int n = 0; n < 10; ++n)
    loop.step(pressed(0.001 * n, {0.0, 0.0, 1.0}, 1.0, true));
  ASSERT_EQ(begun, 1);
  for (const bool back : {true, false})
  {
    const double now = back ? 0.1 : 0.2;
    ASSERT_TRUE(back ? loop.undo() : loop.redo());
    const double turned = scene.work.mask().sample(scene.grid.voxelFromPatient({0.0, 0.0, -2.0}));
    const std::uint64_t state = loop.state();
    for (int n = 0; n < 50; ++n)
      EXPECT_FALSE(loop.step(pressed(now + 0.001 * n, {0.0, 0.0, 0.0}, 1.0, true)));
    EXPECT_FALSE(scene.work.strokeOpen());
    EXPECT_EQ(loop.state(), state);
    EXPECT_EQ(scene.work.mask().sample(scene.grid.voxelFromPatient({0.0, 0.0, -2.0})), turned);
  }
  EXPECT_EQ(begun, 1);
  EXPECT_EQ(scene.work.history().ahead(), 0u);
  loop.step(pressed(0.300, {0.0, 0.0, 0.0}, 1.0, false));
  bool any = false;
  for (int n = 1; n < 10; ++n)
    any = loop.step(pressed(0.300 + 0.001 * n, {0.0, 0.0, 0.0}, 1.0, true)) || any;
  EXPECT_TRUE(any);
  EXPECT_EQ(begun, 2);
}

TEST(DissectionLoop, TakesStepsAtOnePlaceTogether)
{
  LoopScene one, all;
  DissectionLoop each(one.work, *one.mask, one.removalModel);
  DissectionLoop batch(all.work, *all.mask, all.removalModel);
  std::vector<TickRecord> records;
  for (int n = 0; n < 40; ++n)
  {
    records.push_back(pressed(0.001 * n, {0.0, 0.0, 1.0}, 0.05, true));
    records.back().number = static_cast<std::uint64_t>(n);
  }
  records.push_back(pressed(0.040, {0.0, 0.0, 1.0}, 0.0, false));
  for (const TickRecord& record : records)
    each.step(record);
  batch.step(records.data(), records.size());
  EXPECT_EQ(batch.cuts(), 1u);
  // Combined they go as deep as one after the other at positions that follow each step.
  LoopScene deep;
  deep.work.beginStroke({});
  deep.work.cut({{0.0, 0.0, 1.0}, {0.0, 0.0, 1.0 - 39 * 0.001}, 2.0});
  deep.work.endStroke();
  const auto expected = deep.voxels();
  const auto got = all.voxels();
  {
    int worst = 0;
    for (std::size_t n = 0; n < got.size(); ++n)
      worst = std::max(worst, std::abs(int(got[n]) - int(expected[n])));
    EXPECT_LE(worst, 1); // of 65535: rounding of the sums
  }
  EXPECT_EQ(all.work.strokes().size(), 1u);
}

TEST(DissectionLoop, DrillsAPlaneAtTheRateOfTheRemovalModel)
{
  LoopScene scene;
  DissectionLoop loop(scene.work, *scene.mask, scene.removalModel);
  Session& session = scene.session;
  session.parameters.constantThrust = 1;
  session.parameters.approach[2] = -2.2;
  session.pedal = 1.0;
  const haptics::Pose place{{0.1, -0.2, 2.2}, Quaterniond::Identity()};
  for (int n = 0; n < 400; ++n)
    loop.step(session.tick(place));
  const double depth0 = session.records[200].proxy.pose().position.z();
  const double depth1 = session.records[399].proxy.pose().position.z();
  // 1 N at 20 mm/s per N. The ball's pole feels the interpolated mask, which is within a hundredth
  // of a voxel of the ball that cut it; at 0.02 mm per step that is up to a sixth.
  EXPECT_NEAR((depth0 - depth1) / 0.199, 20.0, 3.4);
  EXPECT_EQ(scene.work.strokes().size(), 0u);
  session.pedal = 0.0;
  loop.step(session.tick(place));
  EXPECT_EQ(scene.work.strokes().size(), 1u);
}

TEST(DissectionLoop, UndoInContactPutsTheToolOutAndTheForceBackSlowly)
{
  LoopScene scene;
  DissectionLoop loop(scene.work, *scene.mask, scene.removalModel);
  Session& session = scene.session;
  session.go({0.0, 0.0, 4.0}, {0.0, 0.0, 1.0}, 100);
  session.pedal = 1.0;
  for (int n = 0; n < 300; ++n)
    loop.step(session.tick({{0.0, 0.0, 1.0 - 0.01 * n}, Quaterniond::Identity()}));
  EXPECT_LT(session.records.back().proxy.pose().position.z(), 0.0);
  const std::size_t before = session.records.size() - 1;
  ASSERT_TRUE(loop.undo());
  const haptics::Pose devicePose{{0.0, 0.0, -2.0}, Quaterniond::Identity()};
  const TickRecord back = session.tick(devicePose);
  EXPECT_EQ(faultOf(back), ServoFault::Retreated);
  EXPECT_GT(toString(back).size(), 20u);
  EXPECT_FALSE(back.drill);
  EXPECT_NEAR(back.proxy.pose().position.z(), 2.0, 1e-6);
  session.pedal = 0.0;
  for (int n = 0; n < 200; ++n)
    session.tick(devicePose);
  const double most = forceOf(session.records[before].output).norm();
  for (std::size_t n = before + 1; n < session.records.size(); ++n)
    EXPECT_LE(forceOf(session.records[n].output).norm(), most + 1e-12);
  EXPECT_LT(forceOf(session.records.back().output).norm(), 1e-6);
  // The session continues from there.
  const TickRecord& pressing = session.go({0.0, 0.0, -2.0}, {0.0, 0.0, -3.0}, 100);
  EXPECT_NEAR(forceOf(pressing.output).z(), 1.0, 1e-6);
}
