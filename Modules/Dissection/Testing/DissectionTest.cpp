#include <algorithm>
#include <map>
#include <random>

#include <gtest/gtest.h>

#include "petrous/Dissection/Dissection.h"

using namespace petrous;
using dissection::Dissection;
using dissection::History;
using Eigen::Vector3d;

namespace
{

const core::GridGeometry kGrid({48, 48, 48}, Vector3d::Constant(0.3), Vector3d::Zero());

std::vector<std::uint16_t> voxels(const volume::CutMask& mask)
{
  const auto dense = mask.dense();
  return {dense.data(), dense.data() + dense.size()};
}

void drill(Dissection& work, const Vector3d& from, const Vector3d& to, double radius = 1.5)
{
  work.beginStroke({});
  work.cut({from, to, radius});
  work.endStroke();
}

} // namespace

// Whatever the path through the tree, a state is bit-identical to when it was drilled.
TEST(Dissection, UndoThenRedoRestoresEveryVoxelInTenThousandRandomSequences)
{
  const core::GridGeometry grid({20, 18, 17}, Vector3d::Constant(0.3), Vector3d::Zero());
  std::mt19937 random(17);
  std::uniform_real_distribution<double> at(0.0, 6.0);
  const auto point = [&] { return Vector3d(at(random), at(random), at(random)); };
  const auto checksum = [](const volume::CutMask& mask)
  {
    std::uint64_t sum = 14695981039346656037U;
    for (const std::uint16_t voxel : voxels(mask))
      sum = (sum ^ voxel) * 1099511628211U;
    return sum;
  };
  std::size_t visited = 0, branched = 0;
  for (int sequence = 0; sequence < 10000; ++sequence)
  {
    Dissection work(grid);
    std::map<std::size_t, std::uint64_t> states{{History::kStart, checksum(work.mask())}};
    for (int n = 0; n < 12; ++n)
    {
      History next = work.history();
      const std::size_t known = states.size();
      switch (random() % 6)
      {
      case 0:
      case 1:
        drill(work, point(), point(), 0.8);
        if (work.strokes().size() == known)
          states[work.history().position()] = checksum(work.mask());
        break;
      case 2:
        work.undo();
        break;
      case 3:
        work.redo();
        break;
      case 4:
        next.start(std::to_string(n), random() % (next.size() + 1) - 1);
        work.follow(next);
        break;
      default:
        next.goTo(next.branches()[random() % next.branches().size()].name);
        work.follow(next);
      }
      ASSERT_EQ(checksum(work.mask()), states.at(work.history().position()))
          << "sequence " << sequence << " step " << n;
    }
    visited += states.size();
    branched += work.history().branches().size() > 1;
  }
  EXPECT_GT(visited, 30000u);
  EXPECT_GT(branched, 5000u);
}

TEST(Dissection, UndoStopsAtTheUntouchedBone)
{
  Dissection work(kGrid);
  drill(work, {5, 5, 5}, {7, 5, 5});
  EXPECT_TRUE(work.undo());
  EXPECT_TRUE(work.mask().untouched());
  EXPECT_FALSE(work.undo());
  EXPECT_TRUE(work.redo());
  EXPECT_FALSE(work.redo());
}

TEST(Dissection, AStrokeInTheAirIsNoStroke)
{
  Dissection work(kGrid);
  drill(work, {5, 5, 5}, {7, 5, 5});
  work.undo();
  drill(work, {90, 90, 90}, {95, 90, 90});
  EXPECT_EQ(work.strokes().size(), 1u);
  EXPECT_EQ(work.history().branches().size(), 1u);
  EXPECT_TRUE(work.redo());
}

TEST(Dissection, ANewStrokeAfterAnUndoLosesNothing)
{
  Dissection work(kGrid);
  drill(work, {5, 5, 5}, {7, 5, 5});
  drill(work, {5, 9, 5}, {7, 9, 5});
  const auto first = voxels(work.mask());
  work.undo();
  drill(work, {5, 5, 9}, {7, 5, 9});
  EXPECT_EQ(work.applied(), 2u);
  EXPECT_FALSE(work.redo());
  EXPECT_NE(voxels(work.mask()), first);
  History next = work.history();
  next.goTo("main~1");
  work.follow(next);
  EXPECT_EQ(voxels(work.mask()), first);
}

TEST(Dissection, SavedStrokesLeadToTheSavedState)
{
  Dissection work(kGrid);
  for (int n = 0; n < 5; ++n)
    drill(work, {5.0 + n, 5, 5}, {7.0 + n, 5, 5});
  work.undo();
  work.undo();
  drill(work, {5, 5, 9}, {7, 5, 9});
  Dissection again(kGrid, work.strokes(), work.history());
  EXPECT_EQ(voxels(again.mask()), voxels(work.mask()));
  EXPECT_TRUE(again.mask().takeDirty().empty());
}

TEST(Dissection, ADamagedStrokeIsRefusedAndNothingChanges)
{
  Dissection work(kGrid);
  drill(work, {5, 5, 5}, {7, 5, 5});
  drill(work, {5, 6, 5}, {7, 6, 5});
  auto strokes = work.strokes();
  strokes[1] = strokes[0]; // removes what is already gone
  History start = work.history();
  while (start.undo())
  {
  }
  Dissection again(kGrid, strokes, start);
  ASSERT_TRUE(again.redo());
  const auto before = voxels(again.mask());
  EXPECT_THROW(again.redo(), core::InvalidParameter);
  EXPECT_EQ(voxels(again.mask()), before);
  EXPECT_EQ(again.applied(), 1u);
  EXPECT_THROW(Dissection(kGrid, strokes, work.history()), core::InvalidParameter);
}

TEST(Dissection, WhatWasTakenElsewhereIsTakenAgainWithinAStroke)
{
  Dissection work(kGrid);
  drill(work, {5, 5, 5}, {7, 5, 5});
  Dissection other(kGrid);
  other.beginStroke({});
  other.cutAgain(*work.strokes()[0]->packed.get());
  EXPECT_EQ(other.openBricks().size(), 8u);
  EXPECT_THROW(other.cutAgain(*work.strokes()[0]->packed.get()), core::InvalidParameter);
  other.endStroke();
  EXPECT_EQ(voxels(other.mask()), voxels(work.mask()));
  EXPECT_TRUE(other.undo());
  EXPECT_TRUE(other.mask().untouched());
}

// 1,000 strokes of 10 mm at 0.15 mm would be 128 GB as copies of a 512^3 mask.
TEST(Dissection, KeepsStrokesPacked)
{
  const core::GridGeometry grid({128, 128, 128}, Vector3d::Constant(0.15), Vector3d::Zero());
  Dissection work(grid);
  work.beginStroke({});
  work.cut({{4, 9, 9}, {14, 9, 9}, 2.0});
  EXPECT_GE(work.historyBytes(), 0u);
  work.endStroke();
  EXPECT_GE(work.historyBytes(), work.strokes()[0]->bytes);
  EXPECT_LT(work.historyBytes(), 64000u);
}

TEST(Dissection, ListsDirtyBricksOfUndo)
{
  Dissection work(kGrid);
  drill(work, {5, 5, 5}, {7, 5, 5});
  auto cut = work.mask().takeDirty();
  work.undo();
  auto undone = work.mask().takeDirty();
  std::sort(cut.begin(), cut.end());
  std::sort(undone.begin(), undone.end());
  EXPECT_EQ(cut, undone);
}

TEST(Dissection, ACopyIsAForkOfItsOwn)
{
  Dissection work(kGrid);
  drill(work, {5, 5, 5}, {7, 5, 5});
  Dissection fork = work;
  drill(fork, {5, 9, 5}, {7, 9, 5});
  EXPECT_EQ(work.applied(), 1u);
  EXPECT_NE(voxels(work.mask()), voxels(fork.mask()));
}

TEST(Dissection, CutsOnlyWithinAStroke)
{
  Dissection work(kGrid);
  EXPECT_THROW(work.cut({{5, 5, 5}, {5, 5, 5}, 1.0}), core::InvalidParameter);
  work.beginStroke({});
  EXPECT_THROW(work.beginStroke({}), core::InvalidParameter);
  EXPECT_FALSE(work.undo());
}
