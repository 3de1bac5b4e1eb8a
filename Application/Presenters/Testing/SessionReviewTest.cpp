#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <set>
#include <sstream>

#include <gtest/gtest.h>

#include <unistd.h>

#include "BoneCase.h"
#include "petrous/Core/CsvTable.h"
#include "petrous/Presenters/Recordings.h"
#include "petrous/Presenters/SessionReview.h"
#include "petrous/Scene/Branches.h"
#include "petrous/Session/PathDrill.h"
#include "petrous/Session/RecordingWriter.h"

using namespace petrous;
using namespace petrous::presenters;
using namespace petrous::presenters::testing;
using Eigen::Vector3d;

namespace
{

session::TickRecord tick(double time, const Vector3d& center, bool drill = false,
                         double force = 0.0)
{
  session::TickRecord record;
  record.input.now = time;
  haptics::Pose pose;
  pose.position = center;
  record.proxy = session::PoseValues::of(pose);
  record.drill = drill ? 1 : 0;
  record.wrench.force[2] = force;
  record.thrust = 2.0 * force;
  return record;
}

// A block with a structure in it, from 3 mm below the top on.
scene::Case namedBlock()
{
  scene::Case value = block();
  auto labels =
      std::make_shared<volume::Volume<std::uint16_t>>(value.ct.geometry, std::uint16_t{0});
  for (int k = 0; k < 10; ++k)
    for (int j = 10; j < 30; ++j)
      for (int i = 10; i < 30; ++i)
        labels->at(i, j, k) = 1;
  scene::LabelPart part;
  part.labels = std::make_shared<const volume::LabelMap>(volume::makeLabelMap(labels, {}));
  scene::StructurePart nerve;
  nerve.name = "nerve";
  nerve.index = 1;
  part.structures.push_back(nerve);
  value.labels.push_back(part);
  return value;
}

class SessionReviewTest : public ::testing::Test
{
protected:
  void SetUp() override { std::filesystem::create_directories(folder); }
  void TearDown() override { std::filesystem::remove_all(folder); }

  // Two strokes along a path that goes into bone.
  void drill(scene::Case& value)
  {
    session::TouchScene scene(value);
    session::PathDrill::Options options;
    options.tool.mode = session::TouchTool::Mode::ThreeDof;
    options.recording = file;
    session::PathDrill drill(value, scene, options);
    for (int n = 0; n < 600; ++n)
    {
      const double t = 0.001 * n;
      dissection::ToolSample sample;
      sample.time = t;
      sample.pose =
          core::RigidTransform(Eigen::Quaterniond::Identity(), {4.0 + 5.0 * t, 6.0, kTop - 1.0});
      sample.drill = n % 300 < 250;
      drill.feel(sample);
      drill.cut(sample);
    }
    drill.end();
  }

  // An older stroke about a place, or one that the recording has.
  static void cut(scene::Case& value, const Vector3d& at)
  {
    value.dissection.beginStroke({});
    ASSERT_TRUE(value.dissection.cut({at, at, 1.5}));
    value.dissection.endStroke();
  }

  // Redoes a stroke, if told so, and then cuts a new one, which it may undo and redo.
  void record(scene::Case& value, bool redo, const Vector3d& at, bool again = false)
  {
    session::TouchScene scene(value);
    session::TouchTool tool;
    tool.mode = session::TouchTool::Mode::ThreeDof;
    session::RecordingWriter writer(file,
                                    scene.recordingOf(tool, scene.servoOf(tool), "redo and cut"));
    session::NoRemovalModel none;
    auto hooks = scene.hooksOf(tool.burr, [] { return std::nullopt; });
    hooks.edited = [this, &writer](session::MaskEdit edit)
    {
      if (edit.kind == session::MaskEdit::Kind::Redo && !tellsRedone)
        edit.setRedone(0);
      writer.add(edit);
    };
    session::DissectionLoop loop(value.dissection, *scene.mask(), none,
                                 scene.drill().protectedTissue(), hooks);
    if (redo)
    {
      ASSERT_TRUE(loop.redo());
    }
    ASSERT_TRUE(loop.sweep(tick(1.0, at, true), {at, at, 2.0}));
    loop.endStroke();
    if (again)
    {
      ASSERT_TRUE(loop.undo());
      ASSERT_TRUE(loop.redo());
    }
    writer.add(tick(1.0, at));
    writer.close();
  }

  std::filesystem::path folder = std::filesystem::temp_directory_path() /
                                 ("petrous-session-review-" + std::to_string(::getpid()));
  std::filesystem::path file = folder / "session.ticks";
  bool tellsRedone = true; // in recordings of older programs it is not
};

// A straight way of so many mm in so many seconds, drilling under a force.
OperationReview::Part straight(double begin, double seconds, double length, double force)
{
  RecordedCourse course;
  const int ticks = static_cast<int>(1000.0 * seconds);
  for (int n = 0; n <= ticks; ++n)
    course.add(tick(10.0 + 0.001 * n, {length * n / ticks, 0.0, 0.0}, true, force));
  OperationReview::Part part;
  part.begin = begin;
  part.review.course = course.tools();
  part.review.metrics = course.metrics();
  part.review.burr.rpm = 60000.0;
  return part;
}

dissection::StrokeInfo strokeOf(double removed, double nerve)
{
  dissection::StrokeInfo info;
  info.removed = removed;
  info.structures = {{"nerve", nerve}};
  return info;
}

// With strokes of 1, 2, … mm^3, a tenth of it nerve.
void fill(SessionReview& review, std::size_t applied, const std::vector<double>& made,
          std::size_t undone, double nearest)
{
  review.applied = applied;
  review.undone = undone;
  review.removed = 0.0;
  for (const double removed : made)
  {
    review.made.push_back(strokeOf(removed, 0.1 * removed));
    *review.removed += removed;
  }
  review.strokes = made.size();
  review.structures = {{"nerve", nearest, 0.1 * *review.removed}};
}

} // namespace

// 2 N for one second along 3 mm, then 5 N for three along 4 mm.
TEST(OperationReview, AddsTimesAndPathsAndTakesForcesOverAllOfTheTime)
{
  const OperationReview whole =
      togetherOf({straight(0.0, 1.0, 3.0, 2.0), straight(1.0, 3.0, 4.0, 5.0)});
  EXPECT_NEAR(whole.metrics.duration, 4.0, 1e-9);
  EXPECT_NEAR(whole.metrics.drilling, 4.0, 1e-9);
  EXPECT_NEAR(whole.metrics.path, 7.0, 2.0 * RecordedCourse::kStep);
  EXPECT_NEAR(whole.metrics.drillingPath, 7.0, 2.0 * RecordedCourse::kStep);
  EXPECT_NEAR(whole.metrics.meanForce, (2.0 * 1.0 + 5.0 * 3.0) / 4.0, 1e-9);
  EXPECT_DOUBLE_EQ(whole.metrics.maxForce, 5.0);
  EXPECT_DOUBLE_EQ(whole.metrics.maxThrust, 10.0);
  EXPECT_EQ(whole.metrics.drillStarts, 2U);
  EXPECT_FALSE(whole.speed) << "no pedal set it";
  double last = 0.0;
  for (const RecordedTool& tool : whole.course)
  {
    EXPECT_GE(tool.time, last);
    EXPECT_DOUBLE_EQ(tool.force, tool.time < 1.0 ? 2.0 : tool.time > 1.01 ? 5.0 : tool.force);
    last = tool.time;
  }
  EXPECT_NEAR(last, 4.0, 1e-9);
  EXPECT_NEAR(toolAt(whole.course, 2.5)->center.x(), 2.0, 0.01) << "half of the second part";
  EXPECT_EQ(&partAt(whole, 0.5), &whole.parts[0]);
  EXPECT_EQ(&partAt(whole, 1.5), &whole.parts[1]);
  EXPECT_EQ(&partAt(whole, 9.0), &whole.parts[1]);
  EXPECT_THROW(togetherOf({}), core::InvalidParameter);
}

TEST(OperationReview, TakesTheSetSpeedWhereNoPedalGaveOne)
{
  auto first = straight(0.0, 1.0, 1.0, 1.0);
  auto second = straight(1.0, 3.0, 1.0, 1.0);
  second.review.speed = dissection::SpindleSpeed{20000.0, 30000.0};
  const OperationReview whole = togetherOf({first, second});
  ASSERT_TRUE(whole.speed);
  EXPECT_NEAR(whole.speed->mean, (60000.0 + 3.0 * 20000.0) / 4.0, 1e-6);
  EXPECT_DOUBLE_EQ(whole.speed->max, 60000.0);
}

// 7 strokes are older. The second part undoes the last stroke of the first; between second and
// third another one was undone.
TEST(OperationReview, AddsVolumesOfTheStrokesThatStayAndTakesTheNearestDistance)
{
  std::vector<OperationReview::Part> parts{
      straight(0.0, 1.0, 1.0, 1.0), straight(1.0, 1.0, 1.0, 1.0), straight(2.0, 1.0, 1.0, 1.0)};
  fill(parts[0].review, 7, {1.0, 2.0, 4.0}, 0, 0.8);
  fill(parts[1].review, 10, {8.0, 16.0}, 1, 0.3);
  fill(parts[2].review, 10, {32.0}, 0, 0.5); // 7 + 3 - 1 + 2 = 11 before
  parts[2].review.structures.push_back({"dura", 1.5, 0.0});
  const OperationReview whole = togetherOf(parts);
  ASSERT_TRUE(whole.removed);
  EXPECT_DOUBLE_EQ(*whole.removed, 1.0 + 2.0 + 8.0 + 32.0);
  EXPECT_EQ(whole.strokes, 4U);
  ASSERT_EQ(whole.structures.size(), 2U);
  EXPECT_EQ(whole.structures[0].name, "dura");
  EXPECT_DOUBLE_EQ(*whole.structures[0].nearest, 1.5);
  EXPECT_DOUBLE_EQ(*whole.structures[1].nearest, 0.3);
  EXPECT_NEAR(*whole.structures[1].removed, 4.3, 1e-12);

  // What is not known of a part is not known of all.
  parts[1].review.removed.reset();
  parts[1].review.whyUnmeasured = "began on another dissection";
  const OperationReview partly = togetherOf(parts);
  EXPECT_FALSE(partly.removed);
  EXPECT_EQ(partly.whyUnmeasured, "began on another dissection");
  EXPECT_FALSE(partly.structures[1].removed);
  EXPECT_DOUBLE_EQ(*partly.structures[1].nearest, 0.3);
}

TEST(OperationReview, ATableHasARowPerPartAndOneOfTheWhole)
{
  std::vector<OperationReview::Part> parts{straight(0.0, 1.0, 3.0, 2.0),
                                           straight(1.0, 3.0, 4.0, 5.0)};
  parts[0].name = "a.ticks";
  parts[1].name = "b, \"c\".ticks";
  fill(parts[0].review, 0, {1.0}, 0, 0.8);
  fill(parts[1].review, 1, {2.0, 4.0}, 0, 0.3);
  const OperationReview whole = togetherOf(parts);
  std::istringstream table(operationCsv(whole));
  std::vector<double> durations, volumes, nearest;
  std::vector<std::string> lines;
  for (std::string line; std::getline(table, line);)
    lines.push_back(line);
  ASSERT_EQ(lines.size(), 4U);
  EXPECT_NE(lines[0].find("nearest_mm nerve,removed_mm3 nerve"), std::string::npos) << lines[0];
  EXPECT_EQ(lines[1].rfind("1,a.ticks,", 0), 0U) << lines[1];
  EXPECT_EQ(lines[2].rfind("2,\"b, \"\"c\"\".ticks\",", 0), 0U) << lines[2];
  EXPECT_EQ(lines[3].rfind("total,,,,,4.000,4.000,2,", 0), 0U) << lines[3];
  EXPECT_NE(lines[3].find(",3,7.000,0.300,0.700"), std::string::npos) << lines[3];

  std::istringstream course(operationCourseCsv(whole));
  std::size_t rows = 0;
  core::readCsv(course, "course", {"t_s", "force_n", "part"},
                [&](std::size_t, const std::vector<double>& row)
                {
                  EXPECT_NEAR(row[0], whole.course[rows].time, 1e-4);
                  EXPECT_DOUBLE_EQ(row[1], row[2] == 1.0 ? 2.0 : 5.0);
                  ++rows;
                });
  EXPECT_EQ(rows, whole.course.size());
}

TEST(RecordedCourse, MeasuresTimePathAndForceOfAStraightStroke)
{
  RecordedCourse course;
  for (int n = 0; n <= 2000; ++n) // 10 mm/s for two seconds, drilling in the second one with 3 N
    course.add(tick(5.0 + 0.001 * n, {0.01 * n, 0.0, 0.0}, n >= 1000, n >= 1000 ? 3.0 : 0.0));
  const SessionMetrics metrics = course.metrics();
  EXPECT_NEAR(metrics.duration, 2.0, 1e-9);
  EXPECT_NEAR(metrics.drilling, 1.0, 1e-9);
  EXPECT_NEAR(metrics.path, 20.0, RecordedCourse::kStep + 1e-9);
  EXPECT_NEAR(metrics.drillingPath, 10.0, RecordedCourse::kStep + 1e-9);
  EXPECT_NEAR(metrics.meanForce, 3.0, 1e-9);
  EXPECT_DOUBLE_EQ(metrics.maxForce, 3.0);
  EXPECT_DOUBLE_EQ(metrics.maxThrust, 6.0);
  EXPECT_EQ(metrics.drillStarts, 1u);
}

TEST(RecordedCourse, TellsTheSpeedThatAPedalGave)
{
  const auto course = [](std::uint8_t bits)
  {
    RecordedCourse made;
    for (int n = 0; n <= 3000; ++n) // 1 s before, 1 s at half speed, 1 s at full speed
    {
      session::TickRecord record = tick(0.001 * n, {0.0, 0.0, 0.0}, n >= 1000);
      record.input.pedal = n < 1000 ? 0.0 : n < 2000 ? 0.5 : 1.0;
      record.input.parameters.drill = bits;
      made.add(record);
    }
    return made;
  };
  const auto speed = course(session::ServoParameters::kPedalSpeed).speed(50000.0);
  ASSERT_TRUE(speed);
  EXPECT_NEAR(speed->mean, 37500.0, 0.1);
  EXPECT_NEAR(speed->max, 50000.0, 1e-9);
  EXPECT_FALSE(course(0).speed(50000.0)) << "of a pedal that is a switch";

  SessionReview review;
  review.burr.rpm = 50000.0;
  EXPECT_EQ(metricsCsv(review).find("mean_spindle_speed"), std::string::npos);
  review.speed = speed;
  const std::string metrics = metricsCsv(review);
  EXPECT_NE(metrics.find("mean_spindle_speed_drilling,,37500,1/min"), std::string::npos) << metrics;
  EXPECT_NE(metrics.find("max_spindle_speed,,50000,1/min"), std::string::npos) << metrics;

  const auto speeds = [&](std::uint8_t bits, double halfway)
  {
    review.course = course(bits).tools();
    std::istringstream text(courseCsv(review));
    core::readCsv(text, "course", {"t_s", "rpm"},
                  [&](std::size_t, const std::vector<double>& row)
                  {
                    const double t = std::round(row[0] * 1000.0) / 1000.0;
                    EXPECT_EQ(row[1], t < 1.0 ? 0.0 : t < 2.0 ? halfway : 50000.0) << t << " s";
                  });
    EXPECT_GT(review.course.size(), 200u);
  };
  speeds(session::ServoParameters::kPedalSpeed, 25000.0);
  speeds(0, 50000.0); // a switch
}

TEST(RecordedCourse, CountsNoTremorAsPath)
{
  RecordedCourse course;
  for (int n = 0; n < 5000; ++n)
    course.add(tick(0.001 * n, {n % 2 == 0 ? 0.0 : 0.02, 0.0, 0.0}));
  EXPECT_DOUBLE_EQ(course.metrics().path, 0.0);
}

TEST(RecordedCourse, CountsADrillThatIsHeldThroughAnInterruptionOnce)
{
  using session::ServoFault;
  RecordedCourse course;
  int n = 0;
  const auto add = [&](int count, bool wanted, bool turns, ServoFault fault = ServoFault::None)
  {
    for (int k = 0; k < count; ++k)
    {
      session::TickRecord record = tick(0.001 * n++, {0.0, 0.0, 0.0}, turns);
      record.input.parameters.drill = wanted ? session::ServoParameters::kDrill : 0;
      record.fault = static_cast<std::uint8_t>(fault);
      course.add(record);
    }
  };
  const auto starts = [&] { return course.metrics().drillStarts; };
  add(10, false, false);
  add(10, true, true);
  add(1, true, false, ServoFault::Stalled);
  add(20, true, false, ServoFault::Device);
  add(20, true, false); // back to the pointer
  add(10, true, true);
  EXPECT_EQ(starts(), 1u);
  add(10, false, false);
  add(10, true, true);
  EXPECT_EQ(starts(), 2u);
  add(5, false, false, ServoFault::Device); // let go meanwhile
  add(10, true, true);
  EXPECT_EQ(starts(), 3u);
  EXPECT_LT(course.metrics().drilling, 0.05) << "of which no interruption is a part";
}

TEST(RecordedCourse, PassesOverWhatIsBeforeTheToolIsPlaced)
{
  RecordedCourse course;
  session::TickRecord none = tick(0.0, {99.0, 0.0, 0.0});
  none.fault = static_cast<std::uint8_t>(session::ServoFault::Device);
  EXPECT_FALSE(course.add(none));
  EXPECT_TRUE(course.add(tick(1.0, {1.0, 0.0, 0.0})));
  EXPECT_TRUE(course.add(tick(1.5, {2.0, 0.0, 0.0})));
  EXPECT_DOUBLE_EQ(course.metrics().duration, 0.5);
  EXPECT_DOUBLE_EQ(course.metrics().path, 1.0);
  ASSERT_EQ(course.tools().size(), 2u);
  EXPECT_DOUBLE_EQ(course.tools()[0].time, 0.0);
}

TEST(RecordedCourse, IsThinnedButKeepsEachChangeOfTheDrill)
{
  RecordedCourse course;
  for (int n = 0; n < 1000; ++n)
    course.add(tick(0.001 * n, {0.0, 0.0, 0.0}, n == 503 || n == 504));
  EXPECT_LE(course.tools().size(), 105u);
  EXPECT_GE(course.tools().size(), 98u);
  const auto drills = std::count_if(course.tools().begin(), course.tools().end(),
                                    [](const RecordedTool& tool) { return tool.drilling; });
  EXPECT_EQ(drills, 1);
  EXPECT_NEAR(course.metrics().drilling, 0.002, 1e-9);
}

TEST(RecordedCourse, TimeNeverRunsBackward)
{
  RecordedCourse course;
  for (const double time : {1.0, 1.1, 0.2, 1.3})
    course.add(tick(time, {0.0, 0.0, 0.0}));
  for (std::size_t n = 1; n < course.tools().size(); ++n)
    EXPECT_GE(course.tools()[n].time, course.tools()[n - 1].time);
}

TEST(ToolAt, InterpolatesBetweenSamplesAndStandsAtTheEnds)
{
  EXPECT_FALSE(toolAt({}, 0.0));
  std::vector<RecordedTool> course(2);
  course[0].time = 1.0;
  course[0].drilling = true;
  course[1].time = 3.0;
  course[1].center = {4.0, 0.0, 0.0};
  course[1].axisToHand = {1.0, 0.0, 0.0};
  course[1].force = 2.0;
  EXPECT_EQ(toolAt(course, 0.0)->center, course[0].center);
  EXPECT_EQ(toolAt(course, 9.0)->center, course[1].center);
  const RecordedTool middle = *toolAt(course, 2.0);
  EXPECT_NEAR(middle.center.x(), 2.0, 1e-12);
  EXPECT_NEAR(middle.axisToHand.norm(), 1.0, 1e-12);
  EXPECT_NEAR(middle.axisToHand.x(), std::sqrt(0.5), 1e-12);
  EXPECT_NEAR(middle.force, 1.0, 1e-12);
  EXPECT_TRUE(middle.drilling);
}

TEST_F(SessionReviewTest, MeasuresWhatTheRecordedStrokesRemoved)
{
  scene::Case value = namedBlock();
  drill(value);
  double removed = 0.0;
  for (const auto& stroke : value.dissection.strokes())
    removed += stroke->info.removed;
  ASSERT_GT(removed, 0.0);
  const SessionReview review = reviewRecording(file, namedBlock());
  EXPECT_EQ(review.whyUnmeasured, "");
  EXPECT_EQ(review.warning, "");
  ASSERT_TRUE(review.removed);
  EXPECT_DOUBLE_EQ(*review.removed, removed);
  EXPECT_EQ(review.strokes, value.dissection.strokes().size());
  EXPECT_NEAR(review.metrics.duration, 0.599, 1e-6);
  ASSERT_EQ(review.structures.size(), 1u);
  EXPECT_EQ(review.structures[0].name, "nerve");
  ASSERT_TRUE(review.structures[0].nearest);
  EXPECT_GE(*review.structures[0].nearest, 0.0);
  ASSERT_TRUE(review.structures[0].removed);
}

// Two balls that overlap: the second stroke removes less. On a copy where nothing was drilled the
// second recording goes on from the first.
TEST_F(SessionReviewTest, RecordingsOfAnOperationAreReviewedTogether)
{
  scene::Case value = namedBlock();
  record(value, false, {5.0, 6.0, kTop - 1.0});
  const auto first = file;
  file = folder / "session (2).ticks";
  record(value, false, {6.0, 6.0, kTop - 1.0});
  const double removed = value.removedVolume();
  ASSERT_GT(removed, 0.0);
  for (const scene::Case& one : {value, namedBlock()})
  {
    const OperationReview whole = reviewOperation({first, file}, one);
    EXPECT_EQ(whole.whyUnmeasured, "");
    ASSERT_TRUE(whole.removed);
    EXPECT_NEAR(*whole.removed, removed, 1e-9 * removed);
    EXPECT_EQ(whole.strokes, 2U);
    ASSERT_EQ(whole.parts.size(), 2U);
    EXPECT_EQ(whole.parts[1].name, "session (2).ticks");
    EXPECT_LT(*whole.parts[1].review.removed, *whole.parts[0].review.removed);
    EXPECT_DOUBLE_EQ(*whole.removed,
                     *whole.parts[0].review.removed + *whole.parts[1].review.removed);
  }
  const OperationReview alone = reviewOperation({first}, namedBlock());
  ASSERT_TRUE(alone.removed);
  EXPECT_EQ(metricsCsv(alone), metricsCsv(reviewRecording(first, namedBlock())));
  const OperationReview wrong = reviewOperation({file}, namedBlock());
  EXPECT_FALSE(wrong.removed);
}

// A colleague's copy holds what was drilled, more of it, and perhaps another threshold.
TEST_F(SessionReviewTest, OpensOnACopyThatWasDrilledAndChangedSince)
{
  scene::Case value = namedBlock();
  drill(value);
  const SessionReview first = reviewRecording(file, namedBlock());
  scene::Case copy = value;
  copy.name = "of a colleague";
  copy.iso = 450.0;
  const SessionReview review = reviewRecording(file, copy);
  EXPECT_EQ(review.whyUnmeasured, "");
  ASSERT_TRUE(review.removed);
  EXPECT_DOUBLE_EQ(*review.removed, *first.removed);
  EXPECT_EQ(copy.applied(), value.applied());
}

// The new stroke overlaps the redone one: it removes less than on untouched bone.
TEST_F(SessionReviewTest, MeasuresARecordingThatBeginsWithARedo)
{
  const Vector3d first(5.0, 6.0, kTop - 1.0), second(6.0, 6.0, kTop - 1.0);
  scene::Case before = namedBlock();
  cut(before, first);
  ASSERT_EQ(before.dissection.undo(), 1u);
  scene::Case value = before;
  record(value, true, second);
  ASSERT_EQ(value.dissection.strokes().size(), 2u);
  const double removed = value.dissection.strokes()[1]->info.removed;
  scene::Case alone = namedBlock();
  const auto kept = file;
  file = folder / "alone.ticks";
  record(alone, false, second);
  file = kept;
  ASSERT_LT(removed, 0.95 * alone.dissection.strokes()[0]->info.removed);
  for (const scene::Case& one : {before, value})
  {
    const SessionReview review = reviewRecording(file, one);
    EXPECT_EQ(review.whyUnmeasured, "");
    ASSERT_TRUE(review.removed);
    EXPECT_DOUBLE_EQ(*review.removed, removed);
    EXPECT_EQ(review.strokes, 1u) << "the redone one is older";
  }

  // Another approach goes on from the same state; it is still known which stroke is redone.
  scene::startBranch(before, "other", 0);
  cut(before, {8.0, 6.0, kTop - 1.0});
  const SessionReview review = reviewRecording(file, before);
  EXPECT_EQ(review.whyUnmeasured, "");
  ASSERT_TRUE(review.removed);
  EXPECT_DOUBLE_EQ(*review.removed, removed);

  // On a copy another stroke was drilled in place of the redone one.
  scene::Case other = namedBlock();
  cut(other, {8.0, 6.0, kTop - 1.0});
  const SessionReview wrong = reviewRecording(file, other);
  EXPECT_FALSE(wrong.removed);
  EXPECT_NE(wrong.whyUnmeasured.find("does not have"), std::string::npos) << wrong.whyUnmeasured;
  EXPECT_FALSE(wrong.course.empty());
}

// As older programs wrote it: nothing tells which stroke was redone, however few there are.
TEST_F(SessionReviewTest, SaysNoVolumesWhereARecordingDoesNotTellWhatItRedid)
{
  const Vector3d at(6.0, 6.0, kTop - 1.0);
  scene::Case before = namedBlock();
  cut(before, {5.0, 6.0, kTop - 1.0});
  ASSERT_EQ(before.dissection.undo(), 1u);
  scene::Case value = before;
  tellsRedone = false;
  record(value, true, at);
  const SessionReview review = reviewRecording(file, before);
  EXPECT_FALSE(review.removed);
  EXPECT_NE(review.whyUnmeasured.find("does not tell which"), std::string::npos)
      << review.whyUnmeasured;

  // What the recording itself undid it may redo.
  file = folder / "own.ticks";
  scene::Case own = namedBlock();
  record(own, false, at, true);
  const SessionReview known = reviewRecording(file, namedBlock());
  EXPECT_EQ(known.whyUnmeasured, "");
  ASSERT_TRUE(known.removed);
  EXPECT_DOUBLE_EQ(*known.removed, own.dissection.strokes()[0]->info.removed);
}

TEST_F(SessionReviewTest, FindsTheApproachOnWhichTheRecordingBegan)
{
  scene::Case value = namedBlock();
  cut(value, {4.0, 4.0, kTop - 1.0});
  for (const char* name : {"b", "c", "d"})
  {
    scene::startBranch(value, name, 0);
    cut(value, {4.0 + (name[0] - 'a'), 7.0, kTop - 1.0});
  }
  scene::goToBranch(value, "c");
  scene::Case elsewhere = value;
  record(value, false, {6.5, 7.0, kTop - 1.0});
  scene::goToBranch(elsewhere, "main");
  const SessionReview review = reviewRecording(file, elsewhere);
  EXPECT_EQ(review.whyUnmeasured, "");
  ASSERT_TRUE(review.removed);
  EXPECT_DOUBLE_EQ(*review.removed, value.dissection.strokes().back()->info.removed);

  scene::removeBranch(elsewhere, "c");
  const SessionReview gone = reviewRecording(file, elsewhere);
  EXPECT_FALSE(gone.removed);
  EXPECT_NE(gone.whyUnmeasured.find("began on another dissection"), std::string::npos)
      << gone.whyUnmeasured;
}

TEST_F(SessionReviewTest, ShowsTheCourseWhereStructuresDifferAndSaysWhyNoVolumeIsKnown)
{
  scene::Case value = namedBlock();
  drill(value);
  scene::Case copy = namedBlock();
  copy.labels[0].structures[0].look.drillable = false;
  const SessionReview review = reviewRecording(file, copy);
  EXPECT_FALSE(review.course.empty());
  EXPECT_FALSE(review.removed);
  EXPECT_NE(review.whyUnmeasured.find("other structures under hand and drill"), std::string::npos)
      << review.whyUnmeasured;
}

TEST_F(SessionReviewTest, RefusesAnotherImageAndWhatIsNoRecording)
{
  scene::Case value = namedBlock();
  drill(value);
  scene::Case other = namedBlock();
  auto ct = std::make_shared<volume::Volume<std::int16_t>>(other.ct.geometry, std::int16_t{0});
  other.ct.volume = std::make_shared<const volume::IntensityVolume>(
      std::shared_ptr<const volume::Volume<std::int16_t>>(ct));
  EXPECT_THROW(reviewRecording(file, other), core::InvalidParameter);
  std::ofstream(folder / "text.ticks") << "no recording at all, but long enough to be read";
  EXPECT_THROW(reviewRecording(folder / "text.ticks", namedBlock()), session::RecordingError);
  EXPECT_THROW(reviewRecording(folder / "missing.ticks", namedBlock()), session::RecordingError);
}

TEST_F(SessionReviewTest, ReadsARecordingThatWasNotClosed)
{
  scene::Case value = namedBlock();
  drill(value);
  std::filesystem::resize_file(file, std::filesystem::file_size(file) - 1);
  const SessionReview review = reviewRecording(file, namedBlock());
  EXPECT_NE(review.warning, "");
}

TEST_F(SessionReviewTest, TablesHaveTheMetricsAndTheCourse)
{
  scene::Case value = namedBlock();
  drill(value);
  const SessionReview review = reviewRecording(file, namedBlock());
  const std::string metrics = metricsCsv(review);
  EXPECT_EQ(metrics.rfind("quantity,structure,value,unit", 0), 0u) << metrics;
  EXPECT_NE(metrics.find("nearest_distance,nerve,"), std::string::npos) << metrics;
  EXPECT_NE(metrics.find("removed_volume,nerve,"), std::string::npos) << metrics;
  std::istringstream course(courseCsv(review));
  std::size_t rows = 0;
  core::readCsv(course, "course", {"t_s", "x_mm", "force_n", "drill"},
                [&](std::size_t, const std::vector<double>& row)
                {
                  EXPECT_NEAR(row[0], review.course[rows].time, 1e-4);
                  EXPECT_NEAR(row[1], review.course[rows].center.x(), 1e-4);
                  ++rows;
                });
  EXPECT_EQ(rows, review.course.size());
}

TEST(Recordings, FilesOfASessionBelongTogetherInTheirOrder)
{
  using Files = std::vector<std::filesystem::path>;
  const Files files{"r/ball 2026-03-02 08-00-00.ticks",      "r/ball 2026-03-01 09-30-00.ticks",
                    "r/ball 2026-03-01 09-30-00 (10).ticks", "r/ball 2026-03-01 09-30-00 (2).ticks",
                    "s/ball 2026-03-01 09-30-00 (3).ticks",  "r/notes (left).ticks"};
  const auto operations = inOperations(files);
  ASSERT_EQ(operations.size(), 4U);
  EXPECT_EQ(operations[0], Files{files[0]});
  EXPECT_EQ(operations[1], (Files{files[1], files[3], files[2]}));
  EXPECT_EQ(operations[2], Files{files[4]}) << "another folder";
  EXPECT_EQ(operations[3], Files{files[5]});
}

TEST_F(SessionReviewTest, RecordingsOfACaseAreListedLatestFirst)
{
  const library::Library library(folder / "library");
  const auto made = library.folder() / "recordings";
  std::filesystem::create_directories(made);
  for (const char* name : {"block 2026-03-01 09-30-00.ticks", "block 2026-03-02 08-00-00.ticks",
                           "block 2 2026-03-03 08-00-00.ticks", "block notes.ticks"})
    std::ofstream(made / name) << "recorded";
  const auto files = recordingsOf(library, "block");
  ASSERT_EQ(files.size(), 2u);
  EXPECT_EQ(files[0].filename(), "block 2026-03-02 08-00-00.ticks");
}
