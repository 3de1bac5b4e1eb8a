#include <filesystem>

#include <unistd.h>

#include <gtest/gtest.h>

#include "ShapeCase.h"
#include "petrous/Presenters/MeasurementEditor.h"

using namespace petrous;
using namespace petrous::presenters;
using namespace petrous::presenters::testing;
using Eigen::Vector3d;
using Tool = MeasurementEditor::Tool;
using Kind = scene::Measurement::Kind;

namespace
{

class Measures : public ::testing::Test
{
protected:
  Measures()
    : m_folder(std::filesystem::temp_directory_path() /
               ("petrous-measure-" + std::to_string(::getpid())))
    , m_model(library::Library(m_folder))
    , m_editor(m_model)
  {
    const core::GridGeometry grid({61, 41, 41}, Vector3d::Constant(0.5), Vector3d(-15, -10, -10));
    m_model.adopt(shapeCase(grid, {{"nerve", cylinder({-10, 0, -5}, {10, 0, -5}, 1.5)}},
                            [](const Vector3d& at) { return at.z() < 2.1; }));
    m_model.prepareNow();
    m_editor.caseChanged();
  }
  ~Measures() override { std::filesystem::remove_all(m_folder); }

  const std::vector<scene::Measurement>& all() { return m_model.value().measurements; }
  double value(std::size_t n) { return *scene::valueOf(all()[n].kind, all()[n].points); }

  /// The voxels of a case's structures, the first of them as a new "nerve".
  static volume::LabelMap named(const scene::Case& value)
  {
    return volume::makeLabelMap(value.labels[0].labels.get()->voxels,
                                {{"nerve", 1, {1.0F, 0.8F, 0.1F}, 0}});
  }

  std::filesystem::path m_folder;
  WorkstationModel m_model;
  MeasurementEditor m_editor;
};

} // namespace

TEST_F(Measures, ADistanceIsTwoPointsAndTheNextOneIsNumbered)
{
  m_editor.setTool(Tool::Distance);
  m_editor.set({0, 0, 0});
  EXPECT_TRUE(all().empty());
  m_editor.hover(Vector3d(1, 0, 0));
  ASSERT_TRUE(m_editor.draft());
  EXPECT_EQ(m_editor.draft()->points.size(), 2U);
  m_editor.set({3, 4, 0});
  ASSERT_EQ(all().size(), 1U);
  EXPECT_EQ(all()[0].name, "distance 1");
  EXPECT_DOUBLE_EQ(value(0), 5.0);
  EXPECT_EQ(m_editor.tool(), Tool::Distance) << "for the next one";
  EXPECT_TRUE(m_model.unsaved());
  m_editor.set({0, 0, 0});
  m_editor.set({0, 0, 1});
  EXPECT_EQ(all()[1].name, "distance 2");
}

TEST_F(Measures, ANewOneIsNamedInTheUsersLanguage)
{
  m_editor.inLanguage = [](const std::string& name)
  { return name == "distance" ? std::string("Abstand") : name; };
  for (const double at : {3.0, 5.0})
  {
    m_editor.setTool(Tool::Distance);
    m_editor.set({0, 0, 0});
    m_editor.set({at, 4, 0});
  }
  ASSERT_EQ(all().size(), 2U);
  EXPECT_EQ(all()[0].name, "Abstand 1");
  EXPECT_EQ(all()[1].name, "Abstand 2");
}

TEST_F(Measures, APolygonEndsWhenItIsAskedTo)
{
  m_editor.setTool(Tool::Area);
  for (const Vector3d& corner : {Vector3d(0, 0, 0), Vector3d(4, 0, 0), Vector3d(4, 3, 0)})
  {
    EXPECT_FALSE(m_editor.canFinish());
    m_editor.set(corner);
  }
  m_editor.set({0, 3, 0});
  m_editor.set({0, 3, 0}); // of a double click
  m_editor.finish();
  ASSERT_EQ(all().size(), 1U);
  EXPECT_EQ(all()[0].points.size(), 4U);
  EXPECT_DOUBLE_EQ(value(0), 12.0);
}

TEST_F(Measures, TwoPointsInATubeMeasureAlongItAndElsewhereAlongThePoints)
{
  m_editor.setTool(Tool::Along);
  m_editor.set({-4, 0.5, -5});
  m_editor.set({4, -0.5, -4.5});
  ASSERT_EQ(all().size(), 1U);
  EXPECT_EQ(all()[0].structure, "nerve");
  EXPECT_EQ(all()[0].name, "length of nerve");
  EXPECT_NEAR(value(0), 8.0, 0.2);
  m_editor.set({0, 0, 5});
  m_editor.set({3, 0, 5});
  m_editor.set({3, 4, 5});
  EXPECT_EQ(all().size(), 1U);
  m_editor.finish();
  ASSERT_EQ(all().size(), 2U);
  EXPECT_DOUBLE_EQ(value(1), 7.0);
  EXPECT_TRUE(all()[1].structure.empty());
}

TEST_F(Measures, AThicknessIsMeasuredAtOnceAndRefusedWhereThereIsNoWall)
{
  m_editor.setTool(Tool::Thickness);
  EXPECT_THROW(m_editor.set({0, 0, 9}), core::InvalidParameter);
  m_editor.set({0, 0, 2.0});
  ASSERT_EQ(all().size(), 1U);
  EXPECT_EQ(all()[0].structure, "nerve");
  EXPECT_NEAR(value(0), 2.0 + 3.5, 0.5); // from about z = 2 to the top of the tube at -3.5
  EXPECT_EQ(all()[0].points.size(), 3U);
}

TEST_F(Measures, EachChangeIsUndoneAndRedone)
{
  m_editor.setTool(Tool::Distance);
  m_editor.set({0, 0, 0});
  EXPECT_TRUE(m_editor.canUndo());
  EXPECT_EQ(m_editor.undoText(), "the last point");
  m_editor.undo();
  EXPECT_TRUE(m_editor.points().empty());
  EXPECT_FALSE(m_editor.canUndo());
  m_editor.set({0, 0, 0});
  m_editor.set({1, 0, 0});
  m_editor.rename(0, "Bulb to canal");
  m_editor.take(0, 1);
  m_editor.drag({2, 0, 0});
  m_editor.drag({3, 0, 0});
  m_editor.release();
  m_editor.setShown(0, false);
  m_editor.remove(0);
  EXPECT_TRUE(all().empty());
  EXPECT_EQ(m_editor.undoText(), "remove 'Bulb to canal'");
  m_editor.undo();
  EXPECT_FALSE(all()[0].shown);
  m_editor.undo();
  EXPECT_TRUE(all()[0].shown);
  EXPECT_DOUBLE_EQ(value(0), 3.0);
  EXPECT_EQ(m_editor.undoText(), "move 'Bulb to canal'");
  m_editor.undo(); // the whole drag
  EXPECT_DOUBLE_EQ(value(0), 1.0);
  m_editor.undo();
  EXPECT_EQ(all()[0].name, "distance 1");
  m_editor.undo();
  EXPECT_TRUE(all().empty());
  EXPECT_FALSE(m_editor.canUndo());
  while (m_editor.canRedo())
    m_editor.redo();
  EXPECT_TRUE(all().empty()) << "removed again";
  m_editor.undo();
  EXPECT_EQ(all()[0].name, "Bulb to canal");
}

TEST_F(Measures, TheEndsOfALineStayOnTheStructuresCentreLine)
{
  m_editor.setTool(Tool::Along);
  m_editor.set({-4, 0, -5});
  m_editor.set({4, 0, -5});
  ASSERT_EQ(all().size(), 1U);
  const std::size_t last = all()[0].points.size() - 1;
  EXPECT_TRUE(MeasurementEditor::isHandle(all()[0], last));
  EXPECT_FALSE(MeasurementEditor::isHandle(all()[0], 1));
  m_editor.take(0, last);
  m_editor.drag({7, 3, 0});
  m_editor.release();
  EXPECT_NEAR(value(0), 11.0, 0.2);
  EXPECT_NEAR((all()[0].points.back() - Vector3d(7, 0, -5)).norm(), 0.0, 0.15);
}

TEST_F(Measures, ANameThatIsTakenOrNotSeenIsRefused)
{
  m_editor.setTool(Tool::Mark);
  m_editor.set({0, 0, 0});
  m_editor.set({1, 0, 0});
  ASSERT_EQ(all().size(), 2U);
  EXPECT_THROW(m_editor.rename(1, "MARK 1"), core::InvalidParameter);
  EXPECT_THROW(m_editor.rename(1, "a\xe2\x80\x8b"), core::InvalidParameter);
  EXPECT_THROW(m_editor.rename(1, ""), core::InvalidParameter);
  EXPECT_EQ(all()[1].name, "mark 2");
}

TEST_F(Measures, EachPointKeepsTheImageOnWhichItWasSet)
{
  m_editor.setTool(Tool::Distance);
  m_editor.set({0, 0, 0});
  m_editor.setImage("T2");
  m_editor.hover(Vector3d(1, 0, 0));
  EXPECT_EQ(m_editor.draft()->images, (std::vector<std::string>{"", "T2"}));
  m_editor.set({3, 4, 0});
  ASSERT_EQ(all().size(), 1U);
  EXPECT_EQ(all()[0].images, (std::vector<std::string>{"", "T2"}));
  m_editor.set({0, 0, 0});
  m_editor.set({3, 4, 0});
  EXPECT_EQ(all()[1].image, "T2");
  EXPECT_TRUE(all()[1].images.empty());
  // A point that is dragged is one of the image over which it was dragged.
  m_editor.setImage({});
  m_editor.take(1, 0);
  m_editor.drag({1, 0, 0});
  m_editor.release();
  EXPECT_EQ(all()[1].images, (std::vector<std::string>{"", "T2"}));
  m_editor.setImage("T2");
  m_editor.take(1, 0);
  m_editor.drag({0, 1, 0});
  m_editor.release();
  EXPECT_EQ(all()[1].image, "T2");
}

// What takes long is handed out, and nothing waits for it.
TEST_F(Measures, ACentreLineIsComputedElsewhereAndGivenUpByAnotherClick)
{
  MeasurementEditor::Work due;
  int handedOut = 0;
  m_editor.inBackground = [&](MeasurementEditor::Work work)
  {
    handedOut += work ? 1 : 0;
    due = std::move(work);
  };
  m_editor.setTool(Tool::Along);
  m_editor.set({-4, 0.5, -5});
  m_editor.set({4, -0.5, -4.5});
  EXPECT_TRUE(all().empty());
  EXPECT_TRUE(m_editor.isComputing());
  EXPECT_FALSE(m_editor.canFinish()) << "by a double click, say";
  ASSERT_TRUE(due);
  m_editor.set({4, 3, 3});
  EXPECT_FALSE(due) << "given up";
  EXPECT_FALSE(m_editor.isComputing());
  EXPECT_EQ(m_editor.points().size(), 3U);
  m_editor.drop();
  m_editor.set({-4, 0.5, -5});
  m_editor.set({4, -0.5, -4.5});
  ASSERT_TRUE(due);
  due({})();
  ASSERT_EQ(all().size(), 1U);
  EXPECT_EQ(all()[0].structure, "nerve");
  EXPECT_NEAR(value(0), 8.0, 0.2);
  EXPECT_EQ(handedOut, 2);
  m_editor.set({-2, 0, -5});
  m_editor.set({2, 0, -5});
  EXPECT_EQ(handedOut, 2) << "the line is known";
  EXPECT_EQ(all().size(), 2U);
}

TEST_F(Measures, AWallThatIsDraggedIsComputedForTheLastPlaceAlone)
{
  m_editor.setTool(Tool::Thickness);
  m_editor.set({0, 0, 2.0});
  ASSERT_EQ(all().size(), 1U);
  const Vector3d before = all()[0].points[0];
  MeasurementEditor::Work due;
  int handedOut = 0;
  m_editor.inBackground = [&](MeasurementEditor::Work work)
  {
    handedOut += work ? 1 : 0;
    due = std::move(work);
  };
  m_editor.take(0, 0);
  for (const double x : {1.0, 2.0, 3.0, 4.0})
    m_editor.drag({x, 0, 2.0});
  EXPECT_EQ(handedOut, 1);
  EXPECT_EQ(all()[0].points[0], before);
  m_editor.release();
  EXPECT_TRUE(m_editor.dragging()) << "until it is computed";
  const auto next = [&due]
  {
    const auto work = std::exchange(due, {});
    work({})();
  };
  next();
  EXPECT_EQ(handedOut, 2);
  next();
  EXPECT_EQ(handedOut, 2);
  EXPECT_FALSE(m_editor.dragging());
  EXPECT_NEAR(all()[0].points[0].x(), 4.0, 0.3);
  m_editor.undo();
  EXPECT_EQ(all()[0].points[0], before) << "one step";
}

TEST_F(Measures, WhatIsRemovedWhileAWallIsComputedStaysRemoved)
{
  m_editor.setTool(Tool::Thickness);
  m_editor.set({0, 0, 2.0});
  MeasurementEditor::Work due;
  m_editor.inBackground = [&](MeasurementEditor::Work work) { due = std::move(work); };
  m_editor.take(0, 0);
  m_editor.drag({1, 0, 2.0});
  m_editor.release();
  ASSERT_TRUE(due);
  m_editor.remove(0);
  EXPECT_FALSE(due);
  EXPECT_TRUE(all().empty());
  m_model.undo();
  EXPECT_EQ(all().size(), 1U);
}

TEST_F(Measures, AWallIsMeasuredAnewInTissueThatChanged)
{
  m_editor.setTool(Tool::Thickness);
  m_editor.set({0, 0, 2.0});
  m_model.removePart("nerve");
  m_model.prepareNow();
  m_editor.partsChanged();
  try
  {
    m_editor.set({0, 0, 2.0});
  }
  catch (const core::InvalidParameter&) // nothing lies behind it any more
  {
  }
  for (std::size_t n = 1; n < all().size(); ++n)
    EXPECT_NE(all()[n].structure, "nerve");
}

// A structure that was removed, and another one of its name.
TEST_F(Measures, WhatFollowedARemovedStructureFollowsNoOther)
{
  m_editor.setTool(Tool::Along);
  m_editor.set({-4, 0, -5});
  m_editor.set({4, 0, -5});
  ASSERT_EQ(all().size(), 1U);
  const double length = value(0);
  m_model.removePart("nerve");
  EXPECT_TRUE(all()[0].structureGone);
  m_model.undo();
  EXPECT_FALSE(all()[0].structureGone) << "it is back";
  m_model.redo();
  const core::GridGeometry grid({61, 41, 41}, Vector3d::Constant(0.5), Vector3d(-15, -10, -10));
  auto other = shapeCase(grid, {{"nerve", cylinder({-10, 5, 5}, {10, 5, 5}, 1.5)}});
  m_model.addStructure(named(other));
  ASSERT_TRUE(scene::findStructure(m_model.value(), "nerve"));
  EXPECT_TRUE(all()[0].structureGone);
  m_model.prepareNow();
  m_editor.partsChanged();
  m_editor.take(0, all()[0].points.size() - 1);
  m_editor.drag({7, 5, 5});
  m_editor.release();
  EXPECT_DOUBLE_EQ(value(0), length) << "it stays as it was";
  m_model.renamePart("nerve", "another");
  EXPECT_EQ(all()[0].structure, "nerve");
}

// The structure that a tool replaces is the same one.
TEST_F(Measures, AChangedStructureKeepsItsMeasurements)
{
  m_editor.setTool(Tool::Along);
  m_editor.set({-4, 0, -5});
  m_editor.set({4, 0, -5});
  ASSERT_EQ(all().size(), 1U);
  const auto replaced = m_model.addStructure(named(m_model.value()), "nerve");
  ASSERT_TRUE(replaced);
  EXPECT_FALSE(all()[0].structureGone);
  const auto taken = m_model.takeStructure("nerve");
  ASSERT_TRUE(taken);
  EXPECT_TRUE(all()[0].structureGone);
  m_model.putStructure(*replaced, &*taken);
  EXPECT_FALSE(all()[0].structureGone) << "undone";
}

TEST_F(Measures, ARenamedStructureKeepsItsMeasurements)
{
  m_editor.setTool(Tool::Along);
  m_editor.set({-4, 0, -5});
  m_editor.set({4, 0, -5});
  m_model.renamePart("nerve", "facial nerve");
  EXPECT_EQ(all()[0].structure, "facial nerve");
}

TEST_F(Measures, TheChosenOneStaysChosenWhateverIsUndone)
{
  m_model.events.measurementsChanged = [this] { m_editor.measurementsChanged(); };
  m_editor.setTool(Tool::Mark);
  for (const double x : {0.0, 1.0, 2.0})
    m_editor.set({x, 0, 0});
  ASSERT_EQ(all().size(), 3U);
  const std::string third = all()[2].name;
  m_editor.remove(0);
  m_editor.choose(1);
  ASSERT_EQ(all()[1].name, third);
  m_model.undo(); // the first one is back, and the chosen one is the third again
  ASSERT_EQ(all().size(), 3U);
  EXPECT_EQ(m_editor.chosen(), 2U);
  m_editor.rename(2, "round window");
  m_model.undo();
  EXPECT_EQ(all()[2].name, third);
  EXPECT_EQ(m_editor.chosen(), 2U);
  m_model.undo(); // it was not there yet
  EXPECT_EQ(all().size(), 2U);
  EXPECT_FALSE(m_editor.chosen());
}
