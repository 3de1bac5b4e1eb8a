#include <algorithm>
#include <random>

#include <gtest/gtest.h>

#include "petrous/Dissection/Dissection.h"

using namespace petrous;
using dissection::Dissection;
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

TEST(Dissection, UndoThenRedoRestoresEveryVoxelInRandomSequences)
{
  std::mt19937 random(17);
  std::uniform_real_distribution<double> at(0.0, 14.0);
  const auto point = [&] { return Vector3d(at(random), at(random), at(random)); };
  Dissection work(kGrid);
  std::vector<std::vector<std::uint16_t>> states{voxels(work.mask())}; // by strokes applied
  for (int n = 0; n < 150; ++n)
  {
    switch (random() % 3)
    {
    case 0:
    {
      const std::size_t before = work.applied();
      drill(work, point(), point());
      if (work.applied() == before)
        break;
      states.resize(before + 1);
      states.push_back(voxels(work.mask()));
      break;
    }
    case 1:
      work.undo();
      break;
    default:
      work.redo();
    }
    ASSERT_EQ(voxels(work.mask()), states[work.applied()]) << "step " << n;
  }
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
  EXPECT_EQ(work.strokes().size(), 1u) << "and what can be redone is not lost by it";
  EXPECT_TRUE(work.redo());
}

TEST(Dissection, ANewStrokeGivesUpWhatWasUndone)
{
  Dissection work(kGrid);
  drill(work, {5, 5, 5}, {7, 5, 5});
  drill(work, {5, 9, 5}, {7, 9, 5});
  work.undo();
  drill(work, {5, 5, 9}, {7, 5, 9});
  EXPECT_EQ(work.strokes().size(), 2u);
  EXPECT_FALSE(work.redo());
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
