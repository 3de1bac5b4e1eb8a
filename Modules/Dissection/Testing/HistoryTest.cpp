#include <algorithm>
#include <functional>
#include <random>

#include <gtest/gtest.h>

#include "petrous/Core/Error.h"
#include "petrous/Dissection/History.h"
#include "petrous/Dissection/StrokeNumber.h"

using namespace petrous;
using dissection::History;

namespace
{

using Line = std::vector<std::size_t>;
constexpr std::size_t kStart = History::kStart;

History drilled(int strokes)
{
  History history;
  for (int n = 0; n < strokes; ++n)
    history.add();
  return history;
}

std::string message(const std::function<void()>& action)
{
  try
  {
    action();
  }
  catch (const core::InvalidParameter& error)
  {
    return error.what();
  }
  ADD_FAILURE() << "nothing was thrown";
  return {};
}

} // namespace

TEST(History, BeginsOnMainWithNothing)
{
  History history;
  EXPECT_EQ(history.branch().name, "main");
  EXPECT_EQ(history.applied(), 0u);
  EXPECT_EQ(history.ahead(), 0u);
  EXPECT_EQ(history.next(), kStart);
  EXPECT_FALSE(history.undo());
  EXPECT_FALSE(history.redo());
}

TEST(History, UndoAndRedoGoAlongTheBranch)
{
  History history = drilled(3);
  EXPECT_TRUE(history.undo());
  EXPECT_TRUE(history.undo());
  EXPECT_EQ(history.applied(), 1u);
  EXPECT_EQ(history.ahead(), 2u);
  EXPECT_EQ(history.next(), 1u);
  EXPECT_TRUE(history.redo());
  EXPECT_EQ(history.lineTo(history.position()), (Line{0, 1}));
}

TEST(History, DrillingAfterAnUndoKeepsTheUndoneUnderANameOfItsOwn)
{
  History history = drilled(3);
  history.undo();
  history.undo();
  EXPECT_EQ(history.add(), 3u);
  EXPECT_EQ(history.branch().name, "main");
  EXPECT_EQ(history.lineTo(history.position()), (Line{0, 3}));
  EXPECT_EQ(history.ahead(), 0u);
  ASSERT_TRUE(history.find("main~1"));
  EXPECT_TRUE(history.find("main~1")->setAside);
  history.goTo("main~1");
  EXPECT_EQ(history.lineTo(history.position()), (Line{0, 1, 2}));
  history.goTo("main");
  EXPECT_EQ(history.position(), 3u);
}

TEST(History, ALineThatABranchLeadsToGetsNoSecondName)
{
  History history = drilled(3);
  history.start("far", 2);
  history.goTo("main");
  history.undo();
  history.add();
  EXPECT_EQ(history.branches().size(), 2u);
  history.undo();
  history.add();
  EXPECT_EQ(history.branches().size(), 3u) << "this one nothing else leads to";
}

TEST(History, ABranchBeginsAtAnyEarlierState)
{
  History history = drilled(4);
  history.start("second approach", history.lineTo(history.position())[1]);
  EXPECT_EQ(history.branch().name, "second approach");
  EXPECT_EQ(history.applied(), 2u);
  EXPECT_EQ(history.ahead(), 0u);
  history.add();
  EXPECT_EQ(history.lineTo(4), (Line{0, 1, 4}));
  const auto path = history.path(4, 3);
  EXPECT_EQ(path.undone, (Line{4}));
  EXPECT_EQ(path.redone, (Line{2, 3}));
  history.start("from nothing", kStart);
  EXPECT_EQ(history.applied(), 0u);
}

TEST(History, ABranchIsFoundAsItWasLeft)
{
  History history = drilled(4);
  history.undo();
  history.start("other", kStart);
  history.add();
  history.goTo("main");
  EXPECT_EQ(history.applied(), 3u);
  EXPECT_EQ(history.ahead(), 1u);
}

TEST(History, RemovesABranchAndOnlyItsOwnStrokes)
{
  History history = drilled(2); // 0 1
  history.start("a", 0);
  history.add(); // 2
  history.goTo("main");
  history.add(); // 3
  EXPECT_EQ(history.remove("a"), (Line{0, 1, 3}));
  EXPECT_EQ(history.size(), 3u);
  EXPECT_EQ(history.lineTo(history.position()), (Line{0, 1, 2}));
  EXPECT_EQ(history.branches().size(), 1u);
}

TEST(History, RefusesInWords)
{
  History history = drilled(2);
  EXPECT_NE(message([&] { history.goTo("x"); }).find("there are: main"), std::string::npos);
  EXPECT_NE(message([&] { history.start("main", 0); }).find("is there already"), std::string::npos);
  EXPECT_NE(message([&] { history.start("b", 2); }).find("only 2"), std::string::npos);
  EXPECT_NE(message([&] { history.remove("main"); }).find("present"), std::string::npos);
  EXPECT_NE(message([&] { history.rename("x", "y"); }).find("no branch"), std::string::npos);
  EXPECT_NE(message([&] { history.start("", 0); }).find("name"), std::string::npos);
}

TEST(History, RefusesWhatContradictsItself)
{
  using Branches = std::vector<History::Branch>;
  EXPECT_THROW(History({0}, Branches{{"main"}}, 0), core::InvalidParameter);
  EXPECT_THROW(History({kStart, 5}, Branches{{"main"}}, 0), core::InvalidParameter);
  EXPECT_THROW(History({kStart}, Branches{{"main", 1, 0, false}}, 0), core::InvalidParameter);
  EXPECT_THROW(History({kStart, kStart}, Branches{{"main", 0, 1, false}}, 0),
               core::InvalidParameter);
  EXPECT_THROW(History({kStart}, Branches{{"a"}, {"a"}}, 0), core::InvalidParameter);
  EXPECT_THROW(History({kStart}, Branches{{"a"}}, 1), core::InvalidParameter);
  EXPECT_THROW(History({}, Branches{}, 0), core::InvalidParameter);
  EXPECT_THROW(History::line(2, 3), core::InvalidParameter);
}

// Under random operations every stroke remains reachable from a branch, and the path between any
// two states is correct.
TEST(History, LosesNoStrokeInRandomUse)
{
  std::mt19937 random(3);
  for (int sequence = 0; sequence < 300; ++sequence)
  {
    History history;
    for (int n = 0; n < 40; ++n)
      switch (random() % 6)
      {
      case 0:
      case 1:
        history.add();
        break;
      case 2:
      case 3:
        random() % 3 ? history.undo() : history.redo();
        break;
      case 4:
        history.start(std::to_string(n), random() % (history.size() + 1) - 1);
        break;
      default:
        history.goTo(history.branches()[random() % history.branches().size()].name);
      }
    std::vector<bool> seen(history.size(), false);
    for (const auto& branch : history.branches())
      for (const std::size_t stroke : history.lineTo(branch.tip))
        seen[stroke] = true;
    EXPECT_EQ(std::count(seen.begin(), seen.end(), false), 0);
    const std::size_t from = random() % (history.size() + 1) - 1;
    const std::size_t to = random() % (history.size() + 1) - 1;
    Line line = history.lineTo(from);
    const auto path = history.path(from, to);
    for (const std::size_t stroke : path.undone)
    {
      ASSERT_EQ(line.back(), stroke);
      line.pop_back();
    }
    line.insert(line.end(), path.redone.begin(), path.redone.end());
    EXPECT_EQ(line, history.lineTo(to));
  }
}

TEST(StrokeNumber, IsTheSameWhicheverBranchTheStrokeIsReachedBy)
{
  History history = drilled(2);
  history.start("above", 0);
  const std::size_t own = history.add(); // the second stroke of its branch, the third of the case
  EXPECT_EQ(dissection::strokeNumber(kStart), 0U);
  EXPECT_EQ(dissection::strokeNumber(history.lineTo(own).front()), 1U);
  EXPECT_EQ(dissection::strokeNumber(own), 3U);
}
