#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

#include <unistd.h>

#include "petrous/Core/NumberText.h"
#include "petrous/Phantom/Phantom.h"
#include "petrous/Presenters/CaseBuilder.h"
#include "petrous/Presenters/SegmentEditor.h"
#include "petrous/Segmentation/MaskOperations.h"

using namespace petrous;
using namespace petrous::presenters;
using Eigen::Vector3d;
using Tool = SegmentEditor::Tool;

namespace
{

// A cube of 0.5 mm voxels, with intensity x (mm) times 100, and a bright ball of 4 mm radius, 2000,
// at kBall.
class SegmentEditorTest : public ::testing::Test
{
protected:
  static constexpr int kSize = 40;
  static const Vector3d kBall;

  SegmentEditorTest()
    : folder(std::filesystem::temp_directory_path() /
             ("petrous-segment-" + std::to_string(::getpid()) + "-" +
              ::testing::UnitTest::GetInstance()->current_test_info()->name()))
    , model(library::Library(folder))
    , editor(model)
  {
    std::filesystem::remove_all(folder);
    editor.events.voxelsChanged = [this](const core::IndexBox& box) { changed = box; };
  }
  ~SegmentEditorTest() override { std::filesystem::remove_all(folder); }

  static core::GridGeometry grid()
  {
    return {{kSize, kSize, kSize}, Vector3d::Constant(0.5), Vector3d(-3, 5, 7)};
  }
  static scene::Case ballCase()
  {
    scene::Case value;
    value.name = "ball";
    value.ct.name = "ct";
    value.ct.geometry = grid();
    auto ct = std::make_shared<volume::Volume<std::int16_t>>(value.ct.geometry);
    for (int k = 0; k < kSize; ++k)
      for (int j = 0; j < kSize; ++j)
        for (int i = 0; i < kSize; ++i)
        {
          const Vector3d at = grid().patientFromVoxel(Vector3d(i, j, k));
          ct->at(i, j, k) = (at - kBall).norm() <= 4.0
                                ? std::int16_t{2000}
                                : static_cast<std::int16_t>(std::lround(100.0 * (at.x() + 3.0)));
        }
    value.ct.volume = std::make_shared<const volume::IntensityVolume>(
        std::shared_ptr<const volume::Volume<std::int16_t>>(ct));
    value.ct.range = {0.0, 2000.0};
    return value;
  }
  void open()
  {
    model.adopt(ballCase());
    editor.caseChanged();
  }
  // Of the case: a registered MR of the same voxels, 2 mm beside them.
  scene::ImagePart openWithMr()
  {
    scene::Case value = ballCase();
    scene::ImagePart mr = value.ct;
    mr.name = "T2";
    mr.registered = true;
    mr.mrFromCt = core::RigidTransform(Eigen::Quaterniond::Identity(), Vector3d(2.0, 0, 0));
    value.mr.push_back(mr);
    model.adopt(std::move(value));
    editor.caseChanged();
    return mr;
  }
  // As the window does, in one thread.
  void work()
  {
    while (auto due = editor.dueWork())
      (*due)({})();
  }
  void step()
  {
    auto work = editor.stepWork();
    ASSERT_TRUE(work) << editor.whyNotStep();
    (*work)({})();
  }
  void set(const std::function<void(SegmentValues&)>& change)
  {
    SegmentValues values = editor.values();
    change(values);
    editor.setValues(values);
    work();
  }
  void stroke(const Vector3d& from, const Vector3d& to)
  {
    editor.press(from, SliceOrientation::Axial);
    editor.drag(to);
    editor.release();
    work();
  }
  bool drawn(const Vector3d& patient) const
  {
    const DraftLayer layer = editor.layer();
    if (!layer.indexAt)
      return false;
    const Vector3d voxel = grid().voxelFromPatient(patient);
    return layer.indexAt({static_cast<int>(std::lround(voxel[0])),
                          static_cast<int>(std::lround(voxel[1])),
                          static_cast<int>(std::lround(voxel[2]))}) == 1;
  }
  static std::uint64_t count(const std::function<bool(const Vector3d&)>& inside)
  {
    std::uint64_t found = 0;
    for (int k = 0; k < kSize; ++k)
      for (int j = 0; j < kSize; ++j)
        for (int i = 0; i < kSize; ++i)
          found += inside(grid().patientFromVoxel(Vector3d(i, j, k)));
    return found;
  }
  static bool inBall(const Vector3d& at) { return (at - kBall).norm() <= 4.0; }

  std::filesystem::path folder;
  WorkstationModel model;
  SegmentEditor editor;
  core::IndexBox changed;
};

const Vector3d SegmentEditorTest::kBall{9.0, 15.0, 17.0};

} // namespace

TEST_F(SegmentEditorTest, DoesNothingWithoutACase)
{
  editor.setTool(Tool::Paint);
  EXPECT_EQ(editor.tool(), Tool::None);
  editor.press({1, 2, 3}, SliceOrientation::Axial);
  editor.drag({1, 2, 3});
  editor.release();
  editor.undo();
  editor.redo();
  editor.proposeRange();
  editor.removeTubePoint(0);
  editor.discard();
  EXPECT_FALSE(editor.dueWork());
  EXPECT_FALSE(editor.stepWork());
  EXPECT_FALSE(editor.hasDraft());
  EXPECT_FALSE(editor.layer().indexAt);
  EXPECT_THROW(editor.create(), core::InvalidParameter);
  EXPECT_THROW(editor.setSource("ct"), core::InvalidParameter);
  EXPECT_TRUE(editor.editable().empty());
}

TEST_F(SegmentEditorTest, AThresholdIsProposedSeenAndBecomesAStructure)
{
  open();
  editor.setTool(Tool::Threshold);
  work();
  EXPECT_GT(editor.values().upper, editor.values().lower) << "proposed";
  set(
      [](SegmentValues& values)
      {
        values.lower = 1950.0;
        values.upper = 2000.0;
      });
  const auto truth = [](const Vector3d& at)
  { return inBall(at) || (at.x() + 3.0) * 100.0 >= 1949.5; };
  EXPECT_EQ(editor.voxels(), count(truth));
  EXPECT_NEAR(editor.volume(), 0.125 * static_cast<double>(count(truth)), 1e-9);
  EXPECT_TRUE(drawn(kBall));
  EXPECT_FALSE(drawn(kBall + Vector3d(4.6, 0, 0)));
  EXPECT_FALSE(editor.canUndo()) << "a preview is no step";
  EXPECT_NE(editor.whyNotCreate(), "") << "no name";
  EXPECT_THROW(editor.create(), core::InvalidParameter);
  editor.setName("sigmoid sinus");
  EXPECT_EQ(editor.whyNotCreate(), "");
  editor.create();
  const auto* made = scene::findStructure(model.value(), "sigmoid sinus");
  ASSERT_TRUE(made);
  EXPECT_EQ(made->voxels, count(truth));
  EXPECT_FALSE(editor.hasDraft());
  EXPECT_EQ(editor.tool(), Tool::None);
}

TEST_F(SegmentEditorTest, ANameThatIsTakenIsToldAsItIsShown)
{
  const auto bone = [](SegmentValues& values)
  {
    values.lower = 1950.0;
    values.upper = 2000.0;
  };
  open();
  editor.setTool(Tool::Threshold);
  set(bone);
  work();
  editor.setName("facial_nerve");
  editor.create();
  editor.setTool(Tool::Threshold);
  set(bone);
  work();
  editor.setName("Facial Nerve");
  EXPECT_EQ(editor.whyNotCreate(),
            "The case has a structure 'facial nerve' already; choose another name.");
}

TEST_F(SegmentEditorTest, OnlyWhatHangsTogetherWithTheClickedPointCounts)
{
  open();
  editor.setTool(Tool::Threshold);
  set(
      [](SegmentValues& values)
      {
        values.lower = 1950.0;
        values.upper = 2000.0;
      });
  editor.press(kBall, SliceOrientation::Coronal);
  editor.release();
  work();
  EXPECT_TRUE(editor.values().connected);
  EXPECT_EQ(editor.voxels(), count(inBall));
  editor.press(kBall + Vector3d(-8, 0, 0), SliceOrientation::Coronal); // out of range
  editor.release();
  work();
  EXPECT_NE(editor.warning(), "") << "in words";
  // The draft without the refused preview is not what was asked for.
  editor.setName("ball");
  EXPECT_NE(editor.whyNotCreate(), "");
  EXPECT_THROW(editor.create(), core::InvalidParameter);
  // Each click is a step.
  ASSERT_TRUE(editor.canUndo());
  editor.undo();
  work();
  EXPECT_EQ(editor.voxels(), count(inBall));
  EXPECT_EQ(editor.whyNotCreate(), "");
  editor.undo();
  work();
  EXPECT_TRUE(editor.seeds().empty());
  EXPECT_FALSE(editor.canUndo());
  editor.redo();
  work();
  EXPECT_EQ(editor.voxels(), count(inBall));
}

TEST_F(SegmentEditorTest, AClickOnABorderIsDoubtedAndTheDoubtIsKept)
{
  open();
  editor.setTool(Tool::Threshold);
  work();
  editor.proposeRange();
  work();
  editor.press(kBall + Vector3d(-4.5, 0, 0),
               SliceOrientation::Coronal); // the voxel beside the ball
  editor.release();
  work();
  EXPECT_NE(editor.warning().find("lies on a border of tissues"), std::string::npos)
      << editor.warning();
  editor.setName("ramp");
  editor.create();
  work();
  const scene::Case& value = model.value();
  ASSERT_EQ(value.labels.size(), 1U);
  const auto& notes = value.labels.back().notes;
  ASSERT_FALSE(notes.empty());
  EXPECT_EQ(notes.front().find("The seed at"), 0U) << notes.front();
}

TEST_F(SegmentEditorTest, AnEditedStructureKeepsItsDoubts)
{
  open();
  editor.setTool(Tool::Paint);
  stroke(kBall, kBall);
  editor.setName("vein");
  editor.create();
  scene::Case noted = model.value();
  noted.labels.front().notes = {"has another grid than the CT, which was repaired",
                                "'vein': The seed at (1.0, 2.0, 3.0) mm lies on a border",
                                "The region has 64 cm³, and hardly a structure"};
  model.adopt(std::move(noted));
  editor.caseChanged();
  model.prepareNow();
  editor.edit("vein")({})();
  editor.setTool(Tool::Paint);
  stroke(kBall + Vector3d(4, 0, 0), kBall + Vector3d(4, 0, 0));
  editor.create();
  const std::vector<std::string> kept{"has another grid than the CT, which was repaired",
                                      "The seed at (1.0, 2.0, 3.0) mm lies on a border"};
  ASSERT_EQ(model.value().labels.size(), 1U);
  EXPECT_EQ(model.value().labels.front().notes, kept) << "small by now";
}

// Grown through the whole image, then cut down to the ball, which reaches none of its faces.
TEST_F(SegmentEditorTest, ARegionIsJudgedAsItIsInTheEnd)
{
  open();
  const auto grow = [this](double lower, SegmentValues::Combine combine)
  {
    set(
        [&](SegmentValues& values)
        {
          values.lower = lower;
          values.upper = 2100.0;
          values.connected = true;
          values.combine = combine;
        });
    editor.press(kBall, SliceOrientation::Coronal);
    editor.release();
    work();
  };
  const auto facesNoted = [this]
  {
    const auto& notes = model.value().labels.back().notes;
    return std::any_of(notes.begin(), notes.end(),
                       [](const std::string& note)
                       { return note.find("6 of the 6 faces") != note.npos; });
  };
  editor.setTool(Tool::Threshold);
  work();
  grow(0.0, SegmentValues::Combine::Replace);
  EXPECT_NE(editor.warning().find("6 of the 6 faces"), std::string::npos) << editor.warning();
  step();
  editor.setName("block");
  editor.create();
  EXPECT_TRUE(facesNoted());
  EXPECT_TRUE(editor.undo());
  editor.setTool(Tool::Threshold);
  work();
  grow(1960.0, SegmentValues::Combine::Intersect);
  EXPECT_EQ(editor.warning().find("6 faces"), std::string::npos) << editor.warning();
  step();
  editor.create();
  EXPECT_FALSE(facesNoted());
}

TEST_F(SegmentEditorTest, AClickOutsideProposedLimitsSetsThemAroundIt)
{
  open();
  editor.setTool(Tool::Threshold);
  work();
  EXPECT_LT(editor.values().lower, 1000.0);
  editor.proposeRange();
  work();
  const double proposed = editor.values().lower;
  const Vector3d dark = grid().patientFromVoxel(Vector3d(2, 20, 20));
  ASSERT_LT(100.0 * (dark.x() + 3.0), proposed);
  editor.press(dark, SliceOrientation::Coronal);
  editor.release();
  work();
  EXPECT_NE(editor.warning().find("of the 6 faces of the image"), std::string::npos)
      << "a slab of the ramp: " << editor.warning();
  EXPECT_LT(editor.values().lower, 100.0 * (dark.x() + 3.0));
  EXPECT_GT(editor.values().upper, 100.0 * (dark.x() + 3.0));
  EXPECT_LT(editor.values().upper, 2000.0);
  EXPECT_TRUE(drawn(dark));
  EXPECT_FALSE(drawn(kBall));
  // The point counts for a proposal, too.
  set([](SegmentValues& values) { values.upper = 1500.0; });
  EXPECT_EQ(editor.values().upper, 1500.0);
  editor.proposeRange();
  work();
  EXPECT_LT(editor.values().upper, 1500.0);
  EXPECT_TRUE(drawn(dark));
}

TEST_F(SegmentEditorTest, ABrushPaintsTheBallThatIsSeenAndUndoRestoresEveryVoxel)
{
  open();
  editor.setTool(Tool::Paint);
  set([](SegmentValues& values) { values.brush = 2.0; });
  const Vector3d at = grid().patientFromVoxel(Vector3d(20, 20, 20));
  editor.press(at, SliceOrientation::Axial);
  EXPECT_FALSE(changed.empty());
  editor.release();
  const auto ball = [&](const Vector3d& p) { return (p - at).norm() <= 2.0 + 1e-9; };
  EXPECT_EQ(editor.voxels(), count(ball));
  stroke(at, at + Vector3d(4, 0, 0));
  const std::uint64_t both = editor.voxels();
  EXPECT_GT(both, count(ball));
  EXPECT_TRUE(drawn(at + Vector3d(2, 0, 0))) << "no gap on a fast stroke";
  editor.setTool(Tool::Erase);
  stroke(at, at);
  EXPECT_FALSE(drawn(at));
  EXPECT_TRUE(drawn(at + Vector3d(4, 0, 0)));
  editor.undo();
  EXPECT_EQ(editor.voxels(), both);
  editor.undo();
  EXPECT_EQ(editor.voxels(), count(ball));
  editor.undo();
  EXPECT_EQ(editor.voxels(), 0U);
  EXPECT_FALSE(editor.canUndo());
  for (int n = 0; n < 3; ++n)
    editor.redo();
  EXPECT_FALSE(drawn(at));
  EXPECT_FALSE(editor.canRedo());
}

TEST_F(SegmentEditorTest, ADiskStaysInItsSliceAndARangeInItsIntensities)
{
  open();
  editor.setTool(Tool::Paint);
  set(
      [](SegmentValues& values)
      {
        values.brush = 3.0;
        values.ball = false;
      });
  stroke(kBall, kBall);
  EXPECT_EQ(editor.voxels(),
            count([](const Vector3d& p)
                  { return std::abs(p.z() - kBall.z()) < 0.1 && (p - kBall).norm() <= 3.0; }));
  editor.undo();
  set(
      [](SegmentValues& values)
      {
        values.brush = 6.0;
        values.ball = true;
        values.lower = 1990.0;
        values.upper = 2000.0;
        values.within = true;
      });
  stroke(kBall, kBall);
  EXPECT_EQ(editor.voxels(), count(inBall));
}

TEST_F(SegmentEditorTest, StepsChangeTheDraftAndEachIsUndone)
{
  open();
  editor.setTool(Tool::Paint);
  set([](SegmentValues& values) { values.brush = 2.0; });
  const Vector3d left = grid().patientFromVoxel(Vector3d(8, 20, 20));
  const Vector3d right = grid().patientFromVoxel(Vector3d(30, 20, 20));
  stroke(left, left);
  set([](SegmentValues& values) { values.brush = 3.0; });
  stroke(right, right);
  const std::uint64_t both = editor.voxels();
  editor.setTool(Tool::Islands);
  step();
  EXPECT_TRUE(drawn(right));
  EXPECT_FALSE(drawn(left));
  editor.undo();
  EXPECT_EQ(editor.voxels(), both);
  editor.press(left, SliceOrientation::Axial); // keeps that one alone
  editor.release();
  work();
  EXPECT_TRUE(drawn(left));
  EXPECT_FALSE(drawn(right));
  const std::uint64_t small = editor.voxels();
  editor.setTool(Tool::Margin);
  set([](SegmentValues& values) { values.margin = 1.0; });
  step();
  EXPECT_GT(editor.voxels(), small);
  editor.setTool(Tool::Smooth);
  step();
  EXPECT_TRUE(drawn(left));
  while (editor.canUndo())
    editor.undo();
  EXPECT_EQ(editor.voxels(), 0U);
  editor.setTool(Tool::Fill);
  EXPECT_NE(editor.whyNotStep(), "");
  EXPECT_FALSE(editor.stepWork());
}

TEST_F(SegmentEditorTest, SlicesBetweenThosePaintedAreFilled)
{
  open();
  editor.setTool(Tool::Paint);
  set(
      [](SegmentValues& values)
      {
        values.brush = 3.0;
        values.ball = false;
      });
  const Vector3d low = grid().patientFromVoxel(Vector3d(20, 20, 10));
  const Vector3d high = grid().patientFromVoxel(Vector3d(20, 20, 16));
  stroke(low, low);
  stroke(high, high);
  const std::uint64_t disks = editor.voxels();
  editor.setTool(Tool::Fill);
  step();
  EXPECT_TRUE(drawn(0.5 * (low + high)));
  EXPECT_NEAR(static_cast<double>(editor.voxels()), 3.5 * static_cast<double>(disks),
              0.02 * 3.5 * static_cast<double>(disks));
}

TEST_F(SegmentEditorTest, GrowsFromStrokesInsideAndBeside)
{
  open();
  editor.setTool(Tool::Grow);
  set([](SegmentValues& values) { values.brush = 1.0; });
  EXPECT_FALSE(editor.stepWork()) << "no stroke yet";
  stroke(kBall, kBall + Vector3d(1, 0, 0));
  EXPECT_FALSE(editor.stepWork()) << "none beside";
  set([](SegmentValues& values) { values.inside = false; });
  for (const Vector3d& off : {Vector3d(6, 0, 0), Vector3d(-6, 0, 0), Vector3d(0, 6, 0),
                              Vector3d(0, -6, 0), Vector3d(0, 0, 6), Vector3d(0, 0, -6)})
    stroke(kBall + off, kBall + off);
  EXPECT_TRUE(editor.hasStrokes());
  const DraftLayer layer = editor.layer();
  const auto indexAt = [&layer](const Vector3d& patient)
  {
    const Vector3d voxel = grid().voxelFromPatient(patient);
    return layer.indexAt({static_cast<int>(std::lround(voxel[0])),
                          static_cast<int>(std::lround(voxel[1])),
                          static_cast<int>(std::lround(voxel[2]))});
  };
  const std::uint16_t inside = indexAt(kBall), beside = indexAt(kBall + Vector3d(6, 0, 0));
  EXPECT_EQ(layer.colors[inside], SegmentEditor::kInsideStroke);
  EXPECT_EQ(layer.colors[beside], SegmentEditor::kBesideStroke);
  EXPECT_EQ(layer.hatched, beside);
  step();
  EXPECT_EQ(editor.voxels(), count(inBall));
  EXPECT_FALSE(editor.pieces()) << "one";
}

TEST_F(SegmentEditorTest, PiecesLeftByGrowingAreToldAndRemovedInAStep)
{
  open();
  editor.setTool(Tool::Grow);
  set([](SegmentValues& values) { values.brush = 0.6; });
  const Vector3d aside = kBall + Vector3d(0, 0, -8);
  stroke(kBall, kBall);
  stroke(aside, aside); // enclosed by strokes beside, and so a piece of its own
  set(
      [](SegmentValues& values)
      {
        values.inside = false;
        values.brush = 1.0;
      });
  for (int n = 0; n < 40; ++n)
    for (int m = 0; m < 6; ++m)
    {
      const double angle = 2.0 * 3.14159265358979 * n / 40.0;
      const double height = 3.14159265358979 * (m + 0.5) / 6.0;
      const Vector3d off(std::cos(angle) * std::sin(height), std::sin(angle) * std::sin(height),
                         std::cos(height));
      stroke(aside + 2.2 * off, aside + 2.2 * off);
      stroke(kBall + 5.2 * off, kBall + 5.2 * off);
    }
  step();
  const auto pieces = editor.pieces();
  ASSERT_TRUE(pieces);
  EXPECT_EQ(pieces->count, 2U);
  EXPECT_GT(pieces->outside, 0.5);
  const double before = editor.volume();
  editor.keepLargest();
  work();
  EXPECT_FALSE(editor.pieces());
  EXPECT_NEAR(editor.volume(), before - pieces->outside, 1e-9);
  editor.undo();
  EXPECT_EQ(editor.volume(), before);
  EXPECT_FALSE(editor.pieces()) << "of that step alone";
}

TEST_F(SegmentEditorTest, AStructureOfTheCaseIsEditedAndUndoGivesItBack)
{
  open();
  editor.setTool(Tool::Paint);
  stroke(kBall, kBall);
  const std::uint64_t first = editor.voxels();
  editor.setName("dura plate");
  editor.create();
  EXPECT_TRUE(editor.editable().empty()) << "not loaded yet";
  model.prepareNow();
  EXPECT_EQ(editor.editable(), std::vector<std::string>{"dura plate"});
  editor.edit("dura plate")({})();
  EXPECT_EQ(editor.voxels(), first);
  EXPECT_FALSE(editor.isUnsaved());
  EXPECT_THROW(editor.edit("dura plate"), core::InvalidParameter) << "one at a time";
  editor.setTool(Tool::Paint);
  stroke(kBall + Vector3d(4, 0, 0), kBall + Vector3d(4, 0, 0));
  EXPECT_TRUE(editor.isUnsaved());
  const std::uint64_t second = editor.voxels();
  editor.create();
  ASSERT_EQ(model.value().labels.size(), 1U);
  EXPECT_EQ(scene::findStructure(model.value(), "dura plate")->voxels, second);
  ASSERT_TRUE(editor.canUndo());
  EXPECT_TRUE(editor.undo());
  EXPECT_EQ(scene::findStructure(model.value(), "dura plate")->voxels, first);
  EXPECT_EQ(editor.voxels(), second) << "the draft is there again";
  EXPECT_EQ(editor.edited(), "dura plate");
}

TEST_F(SegmentEditorTest, WhatWasCreatedIsTakenBackAsTheDraftItWas)
{
  open();
  editor.setTool(Tool::Paint);
  stroke(kBall, kBall);
  const std::uint64_t voxels = editor.voxels();
  editor.setName("glomus");
  editor.create();
  EXPECT_TRUE(editor.undo());
  EXPECT_FALSE(scene::findStructure(model.value(), "glomus"));
  EXPECT_EQ(editor.voxels(), voxels);
  EXPECT_EQ(editor.name(), "glomus");
  EXPECT_FALSE(editor.undo());
  EXPECT_EQ(editor.voxels(), 0U);
}

TEST_F(SegmentEditorTest, UndoTakesBackTheVeryStructureWhateverItIsCalledNow)
{
  open();
  editor.setTool(Tool::Paint);
  stroke(kBall, kBall);
  const std::uint64_t voxels = editor.voxels();
  editor.setName("glomus");
  editor.create();
  model.renamePart("glomus", "tumour");
  volume::LabelMap other = *model.value().labels.front().labels.get();
  other.segments.front().name = "glomus";
  model.addStructure(std::move(other));
  EXPECT_TRUE(editor.undo());
  EXPECT_FALSE(scene::findStructure(model.value(), "tumour"));
  EXPECT_TRUE(scene::findStructure(model.value(), "glomus")) << "another one";
  EXPECT_EQ(editor.name(), "tumour");
  EXPECT_EQ(editor.voxels(), voxels);
}

TEST_F(SegmentEditorTest, AStructureThatIsGoneIsNotUndoneAndWhatItReplacedIsKept)
{
  open();
  editor.setTool(Tool::Paint);
  stroke(kBall, kBall);
  const std::uint64_t first = editor.voxels();
  editor.setName("dura plate");
  editor.create();
  model.prepareNow();
  editor.edit("dura plate")({})();
  editor.setTool(Tool::Paint);
  stroke(kBall + Vector3d(4, 0, 0), kBall + Vector3d(4, 0, 0));
  const std::uint64_t second = editor.voxels();
  editor.create();
  model.renamePart("dura plate", "dura");
  volume::LabelMap other = *model.value().labels.front().labels.get();
  other.segments.front().name = "dura plate";
  model.addStructure(std::move(other)); // the name that the first one needs
  EXPECT_THROW(editor.undo(), core::InvalidParameter);
  EXPECT_EQ(model.value().labels.size(), 2U) << "nothing is lost";
  EXPECT_FALSE(editor.hasDraft());
  model.removePart("dura plate");
  EXPECT_TRUE(editor.undo());
  EXPECT_EQ(scene::findStructure(model.value(), "dura plate")->voxels, first);
  EXPECT_EQ(editor.voxels(), second);
  editor.discard();
  EXPECT_EQ(scene::findStructure(model.value(), "dura plate")->voxels, first);
}

TEST_F(SegmentEditorTest, AStructureIsFollowedWhenItIsRenamedWhileItIsEdited)
{
  open();
  editor.setTool(Tool::Paint);
  stroke(kBall, kBall);
  editor.setName("dura plate");
  editor.create();
  model.prepareNow();
  model.events.partsChanged = [this] { editor.partsChanged(); };
  editor.edit("dura plate")({})();
  EXPECT_NE(editor.whyNotCreate(), "") << "nothing was changed";
  EXPECT_EQ(editor.warning(), "") << "its voxels are the CT's";
  editor.setTool(Tool::Paint);
  stroke(kBall + Vector3d(4, 0, 0), kBall + Vector3d(4, 0, 0));
  const std::uint64_t second = editor.voxels();
  model.renamePart("dura plate", "tegmen");
  EXPECT_EQ(editor.edited(), "tegmen");
  EXPECT_EQ(editor.name(), "tegmen");
  editor.create();
  ASSERT_EQ(model.value().labels.size(), 1U);
  EXPECT_EQ(scene::findStructure(model.value(), "tegmen")->voxels, second);
}

// A structure that was drawn on an MR is edited on the CT; its MR is renamed, and its name given to
// another one.
TEST_F(SegmentEditorTest, WhatComesBackLiesOnTheMrThatItWasDrawnOn)
{
  const scene::ImagePart mr = openWithMr();
  editor.setTool(Tool::Paint);
  stroke(kBall, kBall);
  const std::uint64_t drawn = editor.voxels();
  editor.setName("tumour");
  editor.create();
  scene::Case moved = model.value();
  moved.labels.front().drawnOn = "T2";
  model.adopt(std::move(moved));
  editor.caseChanged();
  model.prepareNow();

  editor.edit("tumour")({})();
  EXPECT_NE(editor.warning().find("drawn on other voxels"), std::string::npos);
  EXPECT_EQ(editor.voxels(), drawn) << "4 voxels to the side";
  editor.setTool(Tool::Paint);
  stroke(kBall, kBall);
  editor.create();
  EXPECT_EQ(model.value().labels.front().drawnOn, "");
  model.renamePart("T2", "T2 axial");
  const scene::Case before = model.value();
  scene::Case with = before;
  with.mr.push_back(mr);
  with.mr.back().volume = std::make_shared<const volume::IntensityVolume>(*mr.volume.get());
  model.takeParts(before, std::move(with));
  ASSERT_TRUE(scene::findMr(model.value(), "T2"));
  ASSERT_TRUE(editor.undo());
  EXPECT_EQ(model.value().labels.front().drawnOn, "T2 axial");
}

// Two structures of one map, or one on an MR: it would come back where that was before its axes
// were corrected, beside what was corrected with it.
TEST_F(SegmentEditorTest, WhatWasReplacedDoesNotComeBackToWhereItsAxesWere)
{
  openWithMr();
  volume::LabelMap map;
  auto voxels = std::make_shared<volume::Volume<std::uint16_t>>(grid());
  voxels->at(10, 10, 10) = 1;
  voxels->at(12, 10, 10) = 2;
  map.voxels = voxels;
  map.segments = {{"incus", 1, {}, 1}, {"malleus", 2, {}, 1}};
  scene::Case value = model.value();
  addStructures(value, std::move(map));
  model.adopt(std::move(value));
  editor.caseChanged();
  model.prepareNow();
  const auto edit = [this](const std::string& name)
  {
    editor.edit(name)({})();
    editor.setTool(Tool::Paint);
    stroke(kBall, kBall);
    editor.create();
    model.prepareNow();
  };
  edit("incus");
  ASSERT_EQ(model.value().labels.size(), 2U);
  const auto expectRefused = [this](const std::string& named)
  {
    const std::size_t parts = model.value().labels.size();
    try
    {
      editor.undo();
      FAIL() << named;
    }
    catch (const core::Error& error)
    {
      EXPECT_EQ(error.fault(), core::Fault::Refused) << error.what();
      EXPECT_NE(std::string(error.what()).find("axes of '" + named + "'"), std::string::npos)
          << error.what();
    }
    EXPECT_EQ(model.value().labels.size(), parts);
  };
  model.correctAxes("malleus", core::AxesCorrection::parse("RPS"));
  expectRefused("malleus");
  model.undo();
  model.correctAxes("incus", core::AxesCorrection::parse("RPS")); // that was created
  expectRefused("incus");
  model.undo();
  ASSERT_TRUE(editor.undo());
  ASSERT_NE(scene::findStructure(model.value(), "incus"), nullptr);
  EXPECT_EQ(scene::findStructure(model.value(), "incus")->voxels, 1U);
  editor.discard();

  value = model.value();
  for (scene::LabelPart& part : value.labels)
    part.drawnOn = "T2";
  model.adopt(std::move(value));
  editor.caseChanged();
  model.prepareNow();
  model.removePart("malleus");
  edit("incus");
  model.correctAxes("T2", core::AxesCorrection::parse("RPS"));
  expectRefused("T2");
  model.undo();
  EXPECT_TRUE(editor.undo());
  EXPECT_EQ(scene::findStructure(model.value(), "incus")->voxels, 1U);
}

TEST_F(SegmentEditorTest, WhatIsMadeFromAnMrKeepsWhichAndWhereItLay)
{
  openWithMr();
  editor.setTool(Tool::Paint);
  stroke(kBall, kBall);
  editor.setName("of CT");
  editor.create();
  EXPECT_TRUE(scene::findStructure(model.value(), "of CT")->readings.empty());

  ShownImages shown;
  shown.mr = "T2";
  editor.setShown(shown);
  editor.setTool(Tool::Paint);
  stroke(kBall, kBall);
  editor.setName("of T2");
  editor.create();
  const auto readings = [this] { return scene::findStructure(model.value(), "of T2")->readings; };
  ASSERT_EQ(readings().size(), 1U);
  EXPECT_EQ(scene::outdatedReading(model.value(), readings()), "");
  model.removePart("T2");
  EXPECT_NE(scene::outdatedReading(model.value(), readings()), "");
  model.restorePart();
  EXPECT_EQ(scene::outdatedReading(model.value(), readings()), "");
}

TEST_F(SegmentEditorTest, ACreatedStructureIsUndoneAndRedone)
{
  open();
  editor.setTool(Tool::Paint);
  stroke(kBall, kBall);
  const std::uint64_t voxels = editor.voxels();
  editor.setName("glomus");
  editor.create();
  EXPECT_FALSE(editor.canRedo());
  for (int n = 0; n < 2; ++n)
  {
    EXPECT_TRUE(editor.undo());
    EXPECT_FALSE(editor.undo()); // the stroke
    ASSERT_TRUE(editor.canRedo());
    editor.redo();
    EXPECT_EQ(editor.voxels(), voxels);
    ASSERT_TRUE(editor.canRedo()) << "the structure";
    editor.redo();
    ASSERT_TRUE(scene::findStructure(model.value(), "glomus"));
    EXPECT_EQ(scene::findStructure(model.value(), "glomus")->voxels, voxels);
    EXPECT_FALSE(editor.hasDraft());
    EXPECT_FALSE(editor.canRedo());
  }
  editor.undo();
  editor.setTool(Tool::Erase);
  stroke(kBall, kBall);
  EXPECT_FALSE(editor.canRedo()) << "it is another draft now";
}

TEST_F(SegmentEditorTest, WhileAnotherThreadStepsTheWindowSeesTheDraftAsItWas)
{
  scene::Case value = ballCase();
  const core::GridGeometry large({164, 164, 164}, Vector3d::Constant(0.5), Vector3d(-3, 5, 7));
  value.ct.geometry = large;
  auto ct = std::make_shared<volume::Volume<std::int16_t>>(large, std::int16_t{100});
  value.ct.volume = std::make_shared<const volume::IntensityVolume>(
      std::shared_ptr<const volume::Volume<std::int16_t>>(ct));
  model.adopt(std::move(value));
  editor.caseChanged();
  editor.setTool(Tool::Threshold);
  set(
      [](SegmentValues& values)
      {
        values.lower = 50.0;
        values.upper = 150.0;
      });
  editor.setName("block");
  editor.create();
  model.prepareNow();
  editor.edit("block")({})();
  ASSERT_GT(editor.voxels(), 4'000'000U) << "stepped in another thread";
  editor.setTool(Tool::Erase);
  stroke(kBall, kBall);
  const std::uint64_t erased = editor.voxels();
  EXPECT_TRUE(editor.isUnsaved());
  editor.undo();
  auto due = editor.dueWork();
  ASSERT_TRUE(due);
  const auto apply = (*due)({}); // what the other thread does
  EXPECT_TRUE(editor.isUnsaved()) << "this thread's state is not the other's";
  EXPECT_EQ(editor.voxels(), erased);
  apply();
  EXPECT_FALSE(editor.isUnsaved());
  EXPECT_EQ(editor.voxels(), 164U * 164 * 164);
  editor.redo();
  (*editor.dueWork())({}); // ended, but nobody takes it over
  EXPECT_FALSE(editor.isUnsaved());
  editor.workEnded();
  EXPECT_TRUE(editor.isUnsaved());
  EXPECT_EQ(editor.voxels(), erased);
  EXPECT_TRUE(editor.canUndo());
}

TEST_F(SegmentEditorTest, AStructureThatIsLeftOutAsDamagedCannotBeEdited)
{
  open();
  for (const char* name : {"dura plate", "glomus"})
  {
    editor.setTool(Tool::Paint);
    stroke(kBall, kBall + Vector3d(name[0] == 'g' ? 3 : 0, 0, 0));
    editor.setName(name);
    editor.create();
  }
  model.save();
  std::string object;
  for (const scene::LabelPart& part : model.value().labels)
    if (part.structures.front().name == "glomus")
      object = part.object;
  ASSERT_FALSE(object.empty());
  std::filesystem::remove(folder / "objects" / object);
  model.open("ball");
  editor.caseChanged();
  model.prepareNow();
  ASSERT_EQ(model.leftOut().size(), 1U);
  EXPECT_EQ(editor.editable(), std::vector<std::string>{"dura plate"});
  EXPECT_THROW(editor.edit("glomus"), core::InvalidParameter);
}

TEST_F(SegmentEditorTest, ALargeDraftIsShownInCoarserCells)
{
  scene::Case value = ballCase();
  const core::GridGeometry large({212, 212, 212}, Vector3d::Constant(0.5), Vector3d(-3, 5, 7));
  value.ct.geometry = large;
  auto ct = std::make_shared<volume::Volume<std::int16_t>>(large, std::int16_t{0});
  for (int k = 4; k < 208; ++k)
    for (int j = 4; j < 208; ++j)
      for (int i = 4; i < 208; ++i)
        ct->at(i, j, k) = 100;
  value.ct.volume = std::make_shared<const volume::IntensityVolume>(
      std::shared_ptr<const volume::Volume<std::int16_t>>(ct));
  model.adopt(std::move(value));
  editor.caseChanged();
  editor.setTool(Tool::Threshold);
  set(
      [](SegmentValues& values)
      {
        values.lower = 50.0;
        values.upper = 150.0;
      });
  ASSERT_GT(editor.voxels(), SegmentEditor::kMostSurfaceVoxels);
  editor.surfaceWork()({})();
  ASSERT_TRUE(editor.surface());
  EXPECT_EQ(editor.surfaceStep(), 2);
  Vector3d least = Vector3d::Constant(1e9), most = Vector3d::Constant(-1e9);
  for (const auto& vertex : editor.surface()->vertices)
  {
    const Vector3d at{double(vertex[0]), double(vertex[1]), double(vertex[2])};
    least = least.cwiseMin(at);
    most = most.cwiseMax(at);
  }
  const Vector3d first = large.patientFromVoxel(Vector3d::Constant(3.5));
  const Vector3d last = large.patientFromVoxel(Vector3d::Constant(207.5));
  EXPECT_LE((least - first).cwiseAbs().maxCoeff(), 0.5) << "within half a cell";
  EXPECT_LE((most - last).cwiseAbs().maxCoeff(), 0.5);
  // What is drawn lies half a voxel farther out, so that bone of the same place does not cover it.
  ASSERT_TRUE(editor.raisedSurface());
  EXPECT_TRUE(editor.raisedSurface()->isClosed());
  EXPECT_GT(editor.raisedSurface()->signedVolume(), editor.surface()->signedVolume());
  for (std::size_t n = 0; n < editor.surface()->vertices.size(); ++n)
    ASSERT_NEAR((editor.raisedSurface()->vertices[n] - editor.surface()->vertices[n]).norm(),
                0.5 * large.spacing().maxCoeff(), 1e-4);
}

TEST_F(SegmentEditorTest, AnMrMustBeRegisteredAndIsReadOnTheCtsGrid)
{
  scene::Case value = ballCase();
  scene::ImagePart mr = value.ct;
  mr.name = "T2";
  // The same image 3 mm to the left of where the CT has it.
  auto moved = std::make_shared<volume::Volume<std::int16_t>>(
      core::GridGeometry(grid().dims(), grid().spacing(), grid().origin() + Vector3d(3, 0, 0)));
  value.ct.volume.get()->visit(
      [&](const auto& ct)
      {
        for (std::size_t n = 0; n < ct.size(); ++n)
          moved->data()[n] = static_cast<std::int16_t>(ct.data()[n]);
      });
  mr.geometry = moved->geometry();
  mr.volume = std::make_shared<const volume::IntensityVolume>(
      std::shared_ptr<const volume::Volume<std::int16_t>>(moved));
  value.mr.push_back(mr);
  model.adopt(std::move(value));
  editor.caseChanged();
  ASSERT_EQ(editor.sources().size(), 2U);
  EXPECT_NE(editor.sources().back().why, "");
  try
  {
    editor.setSource("T2");
    FAIL() << "not registered";
  }
  catch (const core::InvalidParameter& error)
  {
    EXPECT_NE(std::string(error.what()).find("not registered"), std::string::npos);
  }
  model.changeMr(
      [](scene::Case& with)
      {
        with.mr.front().registered = true;
        with.mr.front().mrFromCt =
            core::RigidTransform(Eigen::Quaterniond::Identity(), Vector3d(3, 0, 0));
      });
  editor.mrMoved();
  editor.setSource("T2");
  editor.setTool(Tool::Threshold);
  work();
  set(
      [](SegmentValues& values)
      {
        values.lower = 1960.0;
        values.upper = 2000.0;
      });
  EXPECT_EQ(editor.voxels(), count(inBall)) << "where the CT has it";
}

// The case with its image as an MR too, 3 mm to the left of where the CT has it, and registered so.
namespace
{
scene::Case withMr(scene::Case value)
{
  scene::ImagePart mr = value.ct;
  mr.name = "T2";
  const core::GridGeometry& ct = value.ct.geometry;
  auto moved = std::make_shared<volume::Volume<std::int16_t>>(
      core::GridGeometry(ct.dims(), ct.spacing(), ct.origin() + Vector3d(3, 0, 0)));
  value.ct.volume.get()->visit(
      [&](const auto& voxels)
      {
        for (std::size_t n = 0; n < voxels.size(); ++n)
          moved->data()[n] = static_cast<std::int16_t>(voxels.data()[n]);
      });
  mr.geometry = moved->geometry();
  mr.volume = std::make_shared<const volume::IntensityVolume>(
      std::shared_ptr<const volume::Volume<std::int16_t>>(moved));
  mr.registered = true;
  mr.mrFromCt = core::RigidTransform(Eigen::Quaterniond::Identity(), Vector3d(3, 0, 0));
  value.mr.push_back(mr);
  return value;
}
} // namespace

// As of a disk that was taken away, until it is there again.
TEST_F(SegmentEditorTest, AnMrThatCannotBeReadIsRefusedAndNothingIsMadeOfIt)
{
  scene::Case value = withMr(ballCase());
  const auto isLost = std::make_shared<bool>(true);
  value.mr.front().volume = core::Lazy<volume::IntensityVolume>(
      [isLost, voxels = value.mr.front().volume.get()]
      {
        if (*isLost)
          throw core::InvalidParameter("the MR 'T2' is missing");
        return voxels;
      });
  model.adopt(std::move(value));
  editor.caseChanged();
  editor.setShown({true, "T2"});
  editor.setSource("T2");
  editor.setTool(Tool::Threshold);
  for (const double lower : {100.0, 200.0}) // the second time, too
  {
    set(
        [lower](SegmentValues& values)
        {
          values.lower = lower;
          values.upper = 3000.0;
        });
    EXPECT_EQ(editor.warning(), "the MR 'T2' is missing");
    EXPECT_EQ(editor.voxels(), 0U);
    EXPECT_THROW(editor.press(kBall, SliceOrientation::Axial), core::InvalidParameter);
    editor.release();
    EXPECT_TRUE(editor.seeds().empty());
    EXPECT_THROW(editor.stepWork(), core::InvalidParameter);
    EXPECT_FALSE(editor.stepping());
  }
  *isLost = false;
  set([](SegmentValues& values) { values.lower = 1500.0; });
  EXPECT_EQ(editor.warning(), "");
  EXPECT_GT(editor.voxels(), 0U);
}

TEST_F(SegmentEditorTest, AnMrThatMovesIsReadWhereItIsNow)
{
  model.adopt(withMr(ballCase()));
  editor.caseChanged();
  const auto move = [this](double millimetres)
  {
    model.changeMr(
        [&](scene::Case& with)
        {
          with.mr.front().mrFromCt =
              core::RigidTransform(Eigen::Quaterniond::Identity(), Vector3d(millimetres, 0, 0));
        });
    editor.mrMoved();
  };
  editor.setShown({true, "T2"});
  editor.setSource("T2");
  editor.setTool(Tool::Threshold);
  const auto limits = [](SegmentValues& values)
  {
    values.lower = 1960.0;
    values.upper = 2000.0;
    values.connected = false;
  };
  work();
  set(limits);
  editor.discard();
  editor.setTool(Tool::None);
  editor.setTool(Tool::Threshold);
  set(limits);
  // A preview is under way while the MR moves by 2 mm.
  editor.setValues(editor.values());
  SegmentValues other = editor.values();
  other.upper = 2001.0;
  editor.setValues(other);
  auto running = editor.dueWork();
  ASSERT_TRUE(running);
  auto late = (*running)({});
  move(1.0);
  late();
  EXPECT_TRUE(editor.previewPending());
  EXPECT_NE(editor.whyNotCreate(), "");
  work();
  const Vector3d there = kBall + Vector3d(2, 0, 0);
  EXPECT_TRUE(drawn(there + Vector3d(3.4, 0, 0)));
  EXPECT_FALSE(drawn(there - Vector3d(4.4, 0, 0)));
  // A brush that is limited to a range does not wait for ever, nor paint where the MR was.
  editor.setTool(Tool::Paint);
  set([](SegmentValues& values) { values.within = true; });
  running = editor.dueWork();
  move(3.0);
  work();
  stroke(kBall, kBall);
  EXPECT_EQ(editor.warning(), "");
  EXPECT_TRUE(drawn(kBall));
  // A step that was begun before says so.
  editor.setTool(Tool::Threshold);
  work();
  auto step = editor.stepWork();
  ASSERT_TRUE(step) << editor.whyNotStep();
  late = (*step)({});
  move(0.0);
  late();
  EXPECT_NE(editor.warning().find("moved"), std::string::npos);
}

TEST_F(SegmentEditorTest, ARenamedMrStaysTheSourceAndOneThatIsGoneLeavesNothingBehind)
{
  model.adopt(withMr(ballCase()));
  editor.caseChanged();
  model.events.partsChanged = [this] { editor.partsChanged(); };
  editor.setShown({true, "T2"});
  editor.setSource("T2");
  editor.setTool(Tool::Threshold);
  work();
  const double lower = editor.values().lower;
  model.renamePart("T2", "T2 axial");
  work();
  EXPECT_EQ(editor.source(), "T2 axial");
  EXPECT_EQ(editor.values().lower, lower);
  EXPECT_GT(editor.voxels(), 0U);
  set(
      [](SegmentValues& values)
      {
        values.lower = 123.0;
        values.upper = 130.0;
      });
  model.removePart("T2 axial");
  EXPECT_EQ(editor.source(), "ct");
  work();
  EXPECT_NE(editor.values().lower, 123.0) << "those of the MR";
}

TEST_F(SegmentEditorTest, ANerveIsTracedAnewWhenItsNameSaysHowWideItMayBe)
{
  open();
  editor.setTool(Tool::Nerve);
  stroke(kBall + Vector3d(-8, 0, 0), kBall + Vector3d(-8, 0, 0));
  stroke(kBall + Vector3d(-8, 4, 0), kBall + Vector3d(-8, 4, 0));
  work();
  editor.setName("my tube");
  EXPECT_FALSE(editor.previewPending());
  editor.setName("facial nerve");
  EXPECT_TRUE(editor.previewPending());
  EXPECT_NE(editor.whyNotCreate(), "");
  work();
  EXPECT_NE(editor.note().find("by its name at most 1.30 mm"), std::string::npos) << editor.note();
  ASSERT_TRUE(editor.shownRadius());
  EXPECT_LE(*editor.shownRadius(), 1.3);
  EXPECT_NE(editor.note().find("radius " + core::fixedText(*editor.shownRadius(), 2) + " mm"),
            std::string::npos)
      << editor.note();
  set([](SegmentValues& values) { values.tubeRadius = 0.5; });
  EXPECT_DOUBLE_EQ(editor.shownRadius().value_or(0.0), 0.5);
  EXPECT_EQ(editor.note().find("by its name"), std::string::npos) << editor.note();
  editor.setName("chorda tympani");
  EXPECT_FALSE(editor.previewPending()) << "the radius is given";
}

TEST_F(SegmentEditorTest, UndoOfAConnectedThresholdBringsItsPointsBack)
{
  open();
  editor.setTool(Tool::Threshold);
  set(
      [](SegmentValues& values)
      {
        values.lower = 1950.0;
        values.upper = 2000.0;
      });
  editor.press(kBall, SliceOrientation::Axial);
  editor.release();
  work();
  step();
  EXPECT_TRUE(editor.seeds().empty());
  editor.undo();
  work();
  ASSERT_EQ(editor.seeds().size(), 1U);
  EXPECT_EQ(editor.voxels(), count(inBall));
  editor.redo();
  work();
  EXPECT_TRUE(editor.seeds().empty());
  editor.undo();
  work();
  set([](SegmentValues& values) { values.connected = false; });
  EXPECT_TRUE(editor.seeds().empty());
  editor.undo();
  work();
  EXPECT_EQ(editor.seeds().size(), 1U);
  EXPECT_TRUE(editor.values().connected);
}

TEST_F(SegmentEditorTest, AnEditedStructureKeepsItsLookUnlessItsNewNameIsOfAnotherKind)
{
  open();
  editor.setTool(Tool::Paint);
  stroke(kBall, kBall);
  editor.setName("cochlea");
  editor.create();
  appearance::StructureAppearance look = scene::findStructure(model.value(), "cochlea")->look;
  look.color = {0.1F, 0.9F, 0.2F};
  look.drillable = !look.drillable;
  model.setLook("cochlea", look);
  model.prepareNow();
  editor.edit("cochlea")({})();
  editor.setTool(Tool::Paint);
  stroke(kBall + Vector3d(2, 0, 0), kBall + Vector3d(2, 0, 0));
  editor.setName("spiral thing");
  EXPECT_EQ(editor.color(), look.color);
  editor.create();
  EXPECT_EQ(scene::findStructure(model.value(), "spiral thing")->look.color, look.color);
  EXPECT_EQ(scene::findStructure(model.value(), "spiral thing")->look.drillable, look.drillable);
  model.prepareNow();
  editor.edit("spiral thing")({})();
  editor.setTool(Tool::Paint);
  stroke(kBall, kBall);
  stroke(kBall + Vector3d(4, 0, 0), kBall + Vector3d(4, 0, 0));
  editor.setName("facial nerve");
  const auto color = editor.color();
  EXPECT_NE(color, look.color);
  editor.create();
  EXPECT_EQ(scene::findStructure(model.value(), "facial nerve")->look.preset, "nerve");
  EXPECT_EQ(scene::findStructure(model.value(), "facial nerve")->look.color, color);
}

TEST_F(SegmentEditorTest, AFailedPreviewLeavesNoFormerOneToBeCreated)
{
  open();
  editor.setTool(Tool::Threshold);
  work();
  ASSERT_GT(editor.voxels(), 0U);
  editor.setName("ball");
  SegmentValues values = editor.values();
  values.lower += 10.0;
  editor.setValues(values);
  ASSERT_TRUE(editor.dueWork());
  editor.workFailed("out of memory");
  EXPECT_EQ(editor.voxels(), 0U);
  EXPECT_NE(editor.whyNotCreate().find("out of memory"), std::string::npos);

  // What was changed while it was computed is computed all the same.
  values.lower += 10.0;
  editor.setValues(values);
  ASSERT_TRUE(editor.dueWork());
  values.lower -= 20.0;
  editor.setValues(values);
  editor.workFailed("out of memory");
  work();
  EXPECT_GT(editor.voxels(), 0U);
  EXPECT_EQ(editor.whyNotCreate(), "");
}

TEST_F(SegmentEditorTest, OnAnMrTheBrightestRegionIsProposed)
{
  model.adopt(withMr(ballCase()));
  editor.caseChanged();
  editor.setShown({true, "T2"});
  editor.setSource("T2");
  editor.setTool(Tool::Threshold);
  work();
  ASSERT_EQ(editor.seeds().size(), 1U);
  EXPECT_TRUE(inBall(editor.seeds().front())) << editor.seeds().front().transpose();
  EXPECT_TRUE(drawn(kBall));
  EXPECT_EQ(editor.undoText(), "proposed region");
  // All of the range.
  set([](SegmentValues& values) { values.connected = false; });
  EXPECT_TRUE(editor.seeds().empty());
  EXPECT_TRUE(drawn(kBall));
}

// What a tool proposes by itself is nobody's work: nothing is asked, and it goes with the tool.
TEST_F(SegmentEditorTest, AProposalIsNoDraftUntilTheUserDoesSomethingAboutIt)
{
  open();
  editor.setTool(Tool::Threshold);
  work();
  EXPECT_GT(editor.voxels(), 0U);
  EXPECT_FALSE(editor.isUnsaved()) << "a range of the CT";
  set([](SegmentValues& values) { values.lower += 1.0; });
  EXPECT_TRUE(editor.isUnsaved()) << "entered";

  model.adopt(withMr(ballCase()));
  editor.caseChanged();
  editor.setShown({true, "T2"});
  editor.setSource("T2");
  editor.setTool(Tool::Threshold);
  work();
  const std::uint64_t proposed = editor.voxels();
  EXPECT_GT(proposed, 0U);
  EXPECT_FALSE(editor.isUnsaved());
  editor.setTool(Tool::None);
  EXPECT_FALSE(editor.hasDraft());
  EXPECT_TRUE(editor.seeds().empty());
  EXPECT_FALSE(editor.canUndo());
  editor.setTool(Tool::Threshold);
  work();
  EXPECT_EQ(editor.voxels(), proposed) << "again";
  editor.setName("tumour");
  EXPECT_TRUE(editor.isUnsaved());
  editor.setName({});
  EXPECT_FALSE(editor.isUnsaved());
  editor.press(kBall + Vector3d(1, 0, 0), SliceOrientation::Axial);
  editor.release();
  work();
  EXPECT_TRUE(editor.isUnsaved()) << "clicked";
  editor.setTool(Tool::None);
  EXPECT_EQ(editor.seeds().size(), 2U) << "the draft stays";
}

TEST_F(SegmentEditorTest, APointOutsideOfTheImageIsRefused)
{
  const Vector3d outside = grid().patientFromVoxel(Vector3d(-3, 20, 20));
  open();
  editor.setTool(Tool::Nerve);
  stroke(outside, outside);
  EXPECT_TRUE(editor.tubePoints().empty());
  EXPECT_NE(editor.warning().find("outside of the image"), std::string::npos) << editor.warning();
  EXPECT_FALSE(editor.hasDraft());
  const Vector3d inside = kBall + Vector3d(-8, 0, 0);
  stroke(inside, inside);
  EXPECT_EQ(editor.warning(), "");
  stroke(inside, outside);
  ASSERT_EQ(editor.tubePoints().size(), 1U);
  EXPECT_EQ(editor.tubePoints().front().patient, inside) << "dragged no farther";
  editor.moveTubePoint(0, outside);
  EXPECT_EQ(editor.tubePoints().front().patient, inside);
  editor.discard();
  editor.setTool(Tool::Threshold);
  work();
  stroke(outside, outside);
  EXPECT_TRUE(editor.seeds().empty());
  EXPECT_FALSE(editor.values().connected);
}

TEST_F(SegmentEditorTest, ARefusalGoesWithWhatItWasAbout)
{
  open();
  editor.setTool(Tool::Threshold);
  set(
      [](SegmentValues& values)
      {
        values.lower = 2100.0;
        values.upper = 2200.0;
      });
  stroke(kBall, kBall);
  EXPECT_NE(editor.warning().find("2000"), std::string::npos) << editor.warning();
  SegmentValues values = editor.values();
  values.lower = 1950.0;
  editor.setValues(values);
  EXPECT_EQ(editor.warning(), "") << "while the preview is due";
  work();
  EXPECT_EQ(editor.warning(), "");
  EXPECT_EQ(editor.voxels(), count(inBall));
}

TEST_F(SegmentEditorTest, TheSourceIsWhatTheSlicesShowOrSaysThatItIsNot)
{
  scene::Case value = ballCase();
  scene::ImagePart mr = value.ct;
  mr.name = "T2";
  value.mr.push_back(mr);
  model.adopt(std::move(value));
  editor.caseChanged();
  editor.setShown({false, "T2"});
  EXPECT_EQ(editor.source(), "ct") << "not registered";
  EXPECT_EQ(editor.notShown(), "The slices show the MR 'T2', but the tools work on the CT.");
  EXPECT_EQ(editor.shownInstead(), "");
  model.changeMr([](scene::Case& with) { with.mr.front().registered = true; });
  editor.mrMoved();
  EXPECT_EQ(editor.source(), "T2") << "what is shown";
  EXPECT_EQ(editor.notShown(), "");
  editor.setShown({true, "T2"});
  EXPECT_EQ(editor.source(), "T2") << "both are shown";
  editor.setShown({true, {}});
  EXPECT_EQ(editor.source(), "ct");

  // With a tool nothing follows in silence: no click counts on an image that is not seen.
  for (const Tool tool : {Tool::Threshold, Tool::Nerve, Tool::Grow})
  {
    editor.setTool(tool);
    work();
    editor.setShown({false, "T2"});
    EXPECT_EQ(editor.source(), "ct");
    EXPECT_EQ(editor.shownInstead(), "T2");
    stroke(kBall, kBall);
    EXPECT_TRUE(editor.seeds().empty());
    EXPECT_TRUE(editor.tubePoints().empty());
    EXPECT_FALSE(editor.canUndo());
    EXPECT_NE(editor.warning(), "");
    editor.setShown({true, {}});
    EXPECT_EQ(editor.warning(), "");
    editor.setTool(Tool::None);
    editor.discard();
  }
  // What is painted depends on no image, unless it is limited to a range of intensities.
  editor.setTool(Tool::Paint);
  editor.setShown({false, "T2"});
  stroke(kBall, kBall);
  const std::uint64_t painted = editor.voxels();
  EXPECT_GT(painted, 0U);
  set(
      [](SegmentValues& values)
      {
        values.within = true;
        values.upper = 3000.0;
      });
  stroke(kBall + Vector3d(3, 0, 0), kBall);
  EXPECT_EQ(editor.voxels(), painted);
  EXPECT_NE(editor.warning(), "");
  editor.setTool(Tool::None);
  EXPECT_EQ(editor.source(), "ct") << "a draft of the CT";
  EXPECT_NE(editor.notShown(), "");
  editor.discard();
  EXPECT_EQ(editor.source(), "T2");
  EXPECT_EQ(editor.notShown(), "");
}

TEST_F(SegmentEditorTest, UndoAndRedoNameTheirTarget)
{
  open();
  EXPECT_EQ(editor.undoText(), "");
  editor.setTool(Tool::Paint);
  stroke(kBall, kBall);
  EXPECT_EQ(editor.undoText(), "paint stroke");
  editor.undo();
  EXPECT_EQ(editor.undoText(), "");
  EXPECT_EQ(editor.redoText(), "paint stroke");
  editor.redo();
  editor.setTool(Tool::Margin);
  step();
  EXPECT_EQ(editor.undoText(), "margin");
  editor.setName("Sigmoid sinus");
  editor.create();
  EXPECT_EQ(editor.undoText(), "create Sigmoid sinus");
  editor.undo();
  EXPECT_EQ(editor.undoText(), "margin") << "the draft as it was";
  EXPECT_EQ(editor.redoText(), "create Sigmoid sinus");
  editor.redo();
  model.prepareNow();
  auto edit = editor.edit("Sigmoid sinus");
  edit({})();
  editor.setTool(Tool::Paint);
  stroke(kBall, kBall + Vector3d(4, 0, 0));
  editor.create();
  EXPECT_EQ(editor.undoText(), "change of Sigmoid sinus");
  editor.setTool(Tool::Nerve);
  stroke(kBall, kBall);
  EXPECT_EQ(editor.undoText(), "point");
  editor.removeTubePoint(0);
  EXPECT_EQ(editor.undoText(), "removal of a point");
}

TEST_F(SegmentEditorTest, NothingIsLostOrTakenWhileAStepIsUnderWay)
{
  open();
  editor.setTool(Tool::Paint);
  stroke(kBall, kBall);
  const std::uint64_t voxels = editor.voxels();
  editor.setTool(Tool::Margin);
  auto work = editor.stepWork();
  ASSERT_TRUE(work);
  EXPECT_TRUE(editor.stepping());
  EXPECT_FALSE(editor.stepWork());
  EXPECT_FALSE(editor.canUndo());
  editor.setTool(Tool::Paint);
  editor.press(kBall + Vector3d(4, 0, 0), SliceOrientation::Axial);
  editor.release();
  EXPECT_EQ(editor.voxels(), voxels);
  editor.workEnded(); // stopped
  EXPECT_EQ(editor.voxels(), voxels);
  EXPECT_TRUE(editor.canUndo());

  editor.setTool(Tool::Margin);
  work = editor.stepWork();
  ASSERT_TRUE(work);
  const auto late = (*work)({});
  model.adopt(ballCase());
  editor.caseChanged();
  late(); // of the previous case
  EXPECT_EQ(editor.voxels(), 0U);
  EXPECT_FALSE(editor.hasDraft());
}

TEST_F(SegmentEditorTest, PointsOfANerveAreAddedMovedRemovedAndUndone)
{
  open();
  editor.setTool(Tool::Nerve);
  const auto click = [this](const Vector3d& at) { stroke(at, at); };
  click(kBall + Vector3d(-8, 0, 0));
  EXPECT_EQ(editor.tubePoints().size(), 1U);
  EXPECT_FALSE(editor.stepWork());
  click(kBall + Vector3d(-8, 4, 0));
  stroke(kBall + Vector3d(-8, 4, 0.4), kBall + Vector3d(-8, 5, 0)); // moved
  ASSERT_EQ(editor.tubePoints().size(), 2U);
  EXPECT_NEAR((editor.tubePoints()[1].patient - (kBall + Vector3d(-8, 5, 0))).norm(), 0.0, 1e-9);
  editor.undo();
  EXPECT_NEAR((editor.tubePoints()[1].patient - (kBall + Vector3d(-8, 4, 0))).norm(), 0.0, 1e-9);
  editor.removeTubePoint(0);
  editor.removeTubePoint(7);
  EXPECT_EQ(editor.tubePoints().size(), 1U);
  editor.undo();
  EXPECT_EQ(editor.tubePoints().size(), 2U);
  const auto orderOf = [this]
  {
    std::vector<double> y;
    for (const auto& point : editor.tubePoints())
      y.push_back(std::round(10.0 * (point.patient - kBall).y()) / 10.0);
    return y;
  };
  click(kBall + Vector3d(-7, 6, 0)); // goes on where the last one was
  EXPECT_EQ(orderOf(), (std::vector<double>{0.0, 4.0, 6.0}));
  click(kBall + Vector3d(-8, 2, 0)); // between two
  EXPECT_EQ(orderOf(), (std::vector<double>{0.0, 2.0, 4.0, 6.0}));
  editor.undo();
  EXPECT_EQ(orderOf(), (std::vector<double>{0.0, 4.0, 6.0})) << "one click";
  editor.reorderTubePoint(2, 0);
  EXPECT_EQ(orderOf(), (std::vector<double>{6.0, 0.0, 4.0}));
  editor.moveTubePoint(0, kBall + Vector3d(-8, -3, 0));
  EXPECT_EQ(orderOf(), (std::vector<double>{-3.0, 0.0, 4.0}));
  editor.moveTubePoint(3, kBall);
  editor.reorderTubePoint(0, 3);
  editor.reorderTubePoint(3, 0);
  EXPECT_EQ(orderOf(), (std::vector<double>{-3.0, 0.0, 4.0})) << "there is no such point";
  editor.undo();
  editor.undo();
  EXPECT_EQ(orderOf(), (std::vector<double>{0.0, 4.0, 6.0}));
  while (editor.canUndo())
  {
    editor.undo();
    work();
  }
  EXPECT_FALSE(editor.hasDraft());
}

TEST_F(SegmentEditorTest, TheNerveToolFindsThePhantomsFacialNerve)
{
  // Tympanic and mastoid segment of the phantom at 0.3 mm, with noise. The points are knots of its
  // axis (PhantomEar.cpp), clicked there and half a millimetre beside it; its radius is 0.6 mm.
  const phantom::Phantom patient;
  const std::size_t nerve = patient.indexOf("facial_nerve");
  constexpr double kRadius = 0.6;
  const std::vector<Vector3d> axis{{-41.8, -2.1, 4.1},
                                   {-44.8, 3.2, 2.1},
                                   {-45.5, 4.7, 0.2},
                                   {-46.0, 5.4, -4.0},
                                   {-46.6, 6.0, -10.0}};
  scene::Case value;
  value.name = "ear";
  value.ct.name = "ct";
  value.ct.geometry =
      core::GridGeometry({60, 70, 90}, Vector3d::Constant(0.3), Vector3d(-54, -10, -16));
  value.ct.volume = std::make_shared<const volume::IntensityVolume>(
      std::make_shared<const volume::Volume<std::int16_t>>(
          phantom::samplePhantom(patient, value.ct.geometry, {})));
  value.ct.range = value.ct.volume.get()->range();
  model.adopt(std::move(value));
  editor.caseChanged();
  for (const Vector3d& beside : {Vector3d(0, 0, 0), Vector3d(0.3, 0.4, 0.0)})
  {
    editor.discard();
    editor.setTool(Tool::None);
    editor.setTool(Tool::Nerve);
    for (const Vector3d& point : axis)
    {
      ASSERT_NEAR(patient.signedDistance(nerve, point), -kRadius, 0.02);
      stroke(point + beside, point + beside);
    }
    ASSERT_FALSE(editor.path().empty()) << editor.warning();
    double sum = 0.0, most = 0.0;
    for (const Vector3d& at : editor.path())
    {
      const double off = kRadius + patient.signedDistance(nerve, at); // from the axis
      sum += off;
      most = std::max(most, off);
    }
    EXPECT_LT(sum / static_cast<double>(editor.path().size()), 0.15);
    EXPECT_LT(most, 0.44);
    EXPECT_EQ(editor.warning(), "");
    for (const auto& point : editor.tubePoints())
    {
      ASSERT_TRUE(point.distance);
      EXPECT_LT(std::abs(*point.distance - beside.norm()), 0.35);
      EXPECT_EQ(point.problem, "");
    }
  }
  EXPECT_NE(editor.note(), "");
  EXPECT_GT(editor.voxels(), 0U);
  editor.moveTubePoint(3, axis[3] + Vector3d(1.2, 0, 0)); // out of the nerve
  work();
  for (std::size_t n = 0; n < axis.size(); ++n)
  {
    EXPECT_EQ(editor.tubePoints()[n].isOutside, n == 3) << n;
    EXPECT_EQ(editor.tubePoints()[n].problem.empty(), n != 3) << n;
  }
  editor.undo();
  work();
  step();
  EXPECT_TRUE(editor.tubePoints().empty()) << "the tube is in the draft now";
  const std::uint64_t tube = editor.voxels();
  EXPECT_GT(tube, 0U);
  editor.undo();
  EXPECT_EQ(editor.tubePoints().size(), axis.size());
  editor.redo();
  EXPECT_EQ(editor.voxels(), tube);
  work();
  editor.setName("traced");
  work();
  editor.create();
  double polyline = 0.0;
  for (std::size_t n = 1; n < axis.size(); ++n)
    polyline += (axis[n] - axis[n - 1]).norm();
  const auto tubesOf = [this](const char* name)
  {
    const scene::StructurePart* made = scene::findStructure(model.value(), name);
    return made ? made->tubes : scene::TracedTubes{-1.0, -1.0, 0};
  };
  EXPECT_GT(tubesOf("traced").length, 0.95 * polyline);
  EXPECT_LT(tubesOf("traced").unresolved, 0.05 * tubesOf("traced").length) << "as nothing warned";

  // Once it is undone, what is made is of no tube.
  editor.setTool(Tool::Nerve);
  for (const Vector3d& point : axis)
    stroke(point, point);
  step();
  editor.undo();
  editor.setTool(Tool::Paint);
  stroke(axis[2], axis[2]);
  editor.setName("painted");
  work();
  editor.create();
  EXPECT_TRUE(tubesOf("painted") == scene::TracedTubes());
}
