#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "petrous/Core/Error.h"
#include "petrous/Presenters/EditHistory.h"

using namespace petrous;
using presenters::EditHistory;
using std::chrono::milliseconds;

namespace
{

// A number that edits set, and a clock that stands still.
class EditHistoryTest : public ::testing::Test
{
protected:
  void set(int to, const std::string& what = "number", bool continues = true)
  {
    const int from = std::exchange(number, to);
    history.did({what, continues ? what : "", [this, from] { number = from; },
                 [this, to] { number = to; }});
  }
  std::string next() const
  {
    const auto* edit = history.next(strokes);
    return edit ? edit->what : "";
  }

  EditHistory::Clock::time_point now{};
  EditHistory history{[this] { return now; }};
  int number = 0;
  std::size_t strokes = 0; // applied
};

} // namespace

TEST_F(EditHistoryTest, GoesBackAndForthThroughEdits)
{
  set(1, "one");
  set(2, "two");
  EXPECT_EQ(next(), "two");
  EXPECT_TRUE(history.undo(0));
  EXPECT_EQ(number, 1);
  EXPECT_EQ(next(), "one");
  EXPECT_TRUE(history.undo(0));
  EXPECT_EQ(number, 0);
  EXPECT_FALSE(history.undo(0));
  EXPECT_TRUE(history.redo(0));
  EXPECT_EQ(number, 1);
  set(5, "five");
  EXPECT_FALSE(history.redo(0)) << "another way was taken";
  EXPECT_TRUE(history.undo(0));
  EXPECT_EQ(number, 1);
}

TEST_F(EditHistoryTest, ASliderThatMovesIsOneStepUntilItRests)
{
  for (int n = 1; n <= 50; ++n)
  {
    set(n);
    now += milliseconds(20);
  }
  now += EditHistory::kPause;
  set(60);
  EXPECT_TRUE(history.undo(0));
  EXPECT_EQ(number, 50);
  EXPECT_TRUE(history.undo(0));
  EXPECT_EQ(number, 0);
  EXPECT_FALSE(history.undo(0));
  EXPECT_TRUE(history.redo(0));
  EXPECT_EQ(number, 50) << "the whole movement";
}

TEST_F(EditHistoryTest, WhatIsHeldIsOneStepHoweverLongItTakes)
{
  set(1);
  EditHistory::Hold hold(history);
  set(2);
  now += std::chrono::minutes(5);
  set(3);
  hold.release();
  set(4);
  EXPECT_TRUE(history.undo(0));
  EXPECT_EQ(number, 3);
  EXPECT_TRUE(history.undo(0));
  EXPECT_EQ(number, 1) << "what was there before does not belong to it";
}

TEST_F(EditHistoryTest, OnlyEditsOfTheSameKindContinueOneAnother)
{
  set(1, "colour");
  set(2, "opacity");
  set(3, "opacity", false);
  set(4, "opacity");
  for (const int expected : {3, 2, 1, 0})
  {
    EXPECT_TRUE(history.undo(0));
    EXPECT_EQ(number, expected);
  }
}

TEST_F(EditHistoryTest, AnEditAfterAnUndoIsAStepOfItsOwn)
{
  set(1);
  set(2);
  EXPECT_TRUE(history.undo(0));
  set(3);
  set(4);
  EXPECT_TRUE(history.undo(0));
  EXPECT_EQ(number, 0);
}

TEST_F(EditHistoryTest, StrokesKeepTheirPlacesAmongEdits)
{
  set(1, "one");
  history.strokeMade();
  strokes = 1;
  set(2, "two");
  EXPECT_EQ(next(), "two");
  EXPECT_TRUE(history.undo(strokes));
  EXPECT_EQ(next(), "") << "a stroke";
  EXPECT_FALSE(history.undo(strokes));
  history.strokeStepped(true);
  strokes = 0;
  EXPECT_EQ(next(), "one");
  EXPECT_TRUE(history.undo(strokes));
  ASSERT_NE(history.nextRedo(1), nullptr);
  EXPECT_EQ(history.nextRedo(1)->what, "one");
  EXPECT_TRUE(history.redo(1));
  EXPECT_EQ(history.nextRedo(1), nullptr) << "a stroke";
  history.strokeStepped(false);
  EXPECT_EQ(history.nextRedo(0)->what, "two");
}

TEST_F(EditHistoryTest, PassesOverStrokesThatAreNotThereAnyMore)
{
  set(1, "one");
  history.strokeMade();
  EXPECT_EQ(next(), "one") << "none is applied";
}

TEST_F(EditHistoryTest, AStepThatCannotBeTakenBackIsPassedOver)
{
  set(1, "one");
  history.did({"stuck", {}, [] { throw core::InvalidParameter("its name is taken"); }, [] {}});
  EXPECT_THROW(history.undo(0), core::InvalidParameter);
  EXPECT_EQ(next(), "one");
  EXPECT_EQ(history.nextRedo(0), nullptr);
}

TEST_F(EditHistoryTest, AStepTakenBackElsewhereLeavesItsPlace)
{
  const std::uint64_t first = history.did({"create", {}, [] {}, [] {}});
  set(1, "one");
  history.undone(first);
  EXPECT_EQ(next(), "one");
  ASSERT_NE(history.nextRedo(0), nullptr);
  EXPECT_EQ(history.nextRedo(0)->what, "create");
  history.redone(first);
  EXPECT_EQ(next(), "create");
}

TEST_F(EditHistoryTest, WhatWasOnlyTriedLeavesNoTrace)
{
  set(1, "one");
  EditHistory::Hold hold(history);
  set(7, "colour");
  const std::uint64_t tried = history.last();
  set(8, "colour");
  history.takeBack(tried);
  hold.release();
  EXPECT_EQ(number, 1);
  EXPECT_EQ(next(), "one");
  EXPECT_EQ(history.nextRedo(0), nullptr);
  history.takeBack(tried);
  EXPECT_EQ(number, 1) << "it is not the last one";
}

// A colour that is looked at and given up with Esc costs nothing.
TEST_F(EditHistoryTest, WhatCouldBeRedoneComesBackWithWhatWasOnlyTried)
{
  set(1, "one");
  set(2, "two");
  EXPECT_TRUE(history.undo(0));
  {
    const EditHistory::Hold hold(history);
    set(7, "colour");
    set(8, "colour");
    EXPECT_EQ(history.nextRedo(0), nullptr);
    history.takeBack(history.last());
  }
  EXPECT_EQ(number, 1);
  EXPECT_EQ(next(), "one");
  ASSERT_NE(history.nextRedo(0), nullptr);
  EXPECT_TRUE(history.redo(0));
  EXPECT_EQ(number, 2);
  // What is kept is a branch of its own.
  EXPECT_TRUE(history.undo(0));
  {
    const EditHistory::Hold hold(history);
    set(9, "colour");
  }
  EXPECT_EQ(history.nextRedo(0), nullptr);
  history.takeBack(history.last());
  EXPECT_EQ(history.nextRedo(0), nullptr) << "it was not only tried";
}

TEST_F(EditHistoryTest, WhatIsTriedInAFullHistoryForgetsNothing)
{
  for (std::size_t n = 1; n <= EditHistory::kMaxSteps; ++n)
    set(static_cast<int>(n), "number", false);
  {
    const EditHistory::Hold hold(history);
    set(-1, "colour");
    history.takeBack(history.last());
  }
  std::size_t steps = 0;
  while (history.undo(0))
    ++steps;
  EXPECT_EQ(steps, EditHistory::kMaxSteps);
  EXPECT_EQ(number, 0);
}

// Of whatever way it ends, and another case ends it, too.
TEST_F(EditHistoryTest, AHoldEndsWithWhatHoldsIt)
{
  try
  {
    const EditHistory::Hold hold(history);
    set(1);
    throw core::InvalidParameter("refused");
  }
  catch (const core::InvalidParameter&)
  {
  }
  now += std::chrono::minutes(5);
  set(2);
  EXPECT_TRUE(history.undo(0));
  EXPECT_EQ(number, 1) << "a step of its own";
  EditHistory::Hold first(history);
  history.clear();
  EditHistory::Hold second(history);
  set(3);
  first.release(); // of the case before
  now += std::chrono::minutes(5);
  set(4);
  EXPECT_TRUE(history.undo(0));
  EXPECT_EQ(number, 1) << "still held";
}

TEST_F(EditHistoryTest, ForgetsTheEarliestSteps)
{
  for (std::size_t n = 1; n <= EditHistory::kMaxSteps + 5; ++n)
    set(static_cast<int>(n), "number", false);
  std::size_t steps = 0;
  while (history.undo(0))
    ++steps;
  EXPECT_EQ(steps, EditHistory::kMaxSteps);
  EXPECT_EQ(number, 5);
}

TEST_F(EditHistoryTest, TheLastEditOfAGroupIsTakenFromAmongOthers)
{
  const auto grouped = [this](const std::string& what, int& value) {
    history.did({what, {}, [&value] { --value; }, [&value] { ++value; }, false, "pose"});
  };
  int first = 1, second = 1;
  EXPECT_FALSE(history.undoOf("pose"));
  grouped("first", first);
  set(1, "one");
  grouped("second", second);
  history.strokeMade();
  strokes = 1;
  ASSERT_NE(history.nextOf("pose"), nullptr);
  EXPECT_EQ(history.nextOf("pose")->what, "second");
  EXPECT_TRUE(history.undoOf("pose"));
  EXPECT_EQ(second, 0);
  EXPECT_EQ(history.next(strokes), nullptr) << "the stroke stays the last step";
  EXPECT_TRUE(history.undoOf("pose"));
  EXPECT_EQ(first, 0);
  EXPECT_EQ(number, 1);
  EXPECT_FALSE(history.undoOf("pose"));
  EXPECT_EQ(history.nextRedoOf("pose")->what, "first");
  EXPECT_TRUE(history.redoOf("pose"));
  EXPECT_EQ(first, 1);
  EXPECT_EQ(next(), "first") << "it was the last thing done";
  EXPECT_TRUE(history.redo(0));
  EXPECT_EQ(second, 1);
}

TEST_F(EditHistoryTest, AGroupsEditBeforeAChangeOfPartsIsTakenBackInOrderOnly)
{
  history.did({"pose", {}, [] {}, [] {}, false, "pose"});
  history.did({"name", {}, [] {}, [] {}, true});
  EXPECT_EQ(history.nextOf("pose"), nullptr);
  EXPECT_FALSE(history.undoOf("pose"));
  EXPECT_TRUE(history.undo(0));
  EXPECT_TRUE(history.undoOf("pose"));
  EXPECT_EQ(history.nextRedoOf("pose")->what, "pose");
  EXPECT_TRUE(history.redoOf("pose"));
  EXPECT_EQ(history.nextRedo(0)->what, "name");
}
