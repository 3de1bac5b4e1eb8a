#include <gtest/gtest.h>

#include "DrilledCase.h"
#include "MaskComparison.h"
#include "petrous/Scene/Branches.h"

using namespace petrous;
using scene::test::drill;
using scene::test::drilledCase;

namespace
{

void expectTogether(const scene::Case& value)
{
  const dissection::Dissection& work = value.dissection;
  ASSERT_TRUE(work.loaded());
  ASSERT_EQ(work.history().size(), work.strokes().size());
  const dissection::Dissection again(value.ct.geometry, work.strokes(), work.history());
  EXPECT_EQ(volume::differentVoxels(work.mask(), again.mask()), 0u);
}

} // namespace

TEST(Branches, ANewStrokeKeepsTheUndoneInTheList)
{
  scene::Case value = drilledCase(3);
  value.dissection.undo(2);
  drill(value, {4, 4, 8}, 5.0);
  expectTogether(value);
  EXPECT_EQ(value.dissection.strokes().size(), 4u);
  EXPECT_DOUBLE_EQ(value.removedVolume(), 15.0);
  scene::goToBranch(value, "main~1");
  expectTogether(value);
  EXPECT_DOUBLE_EQ(value.removedVolume(), 33.0);
}

TEST(Branches, BeginWhereOneIsOrAfterSoManyStrokes)
{
  scene::Case value = drilledCase(3);
  value.dissection.undo();
  scene::startBranch(value, "here");
  EXPECT_EQ(value.applied(), 2u);
  EXPECT_EQ(value.dissection.history().ahead(), 0u);
  scene::goToBranch(value, "main");
  EXPECT_EQ(value.dissection.history().ahead(), 1u);
  scene::startBranch(value, "all", 3);
  EXPECT_EQ(value.applied(), 3u);
  scene::startBranch(value, "none", 0);
  EXPECT_TRUE(value.dissection.mask().untouched());
  expectTogether(value);
  EXPECT_THROW(scene::startBranch(value, "x", 1), core::InvalidParameter);
  EXPECT_THROW(scene::startBranch(value, "all"), core::InvalidParameter);
  EXPECT_THROW(scene::startBranch(value, "-x"), core::InvalidParameter);
  EXPECT_THROW(scene::startBranch(value, "\xff"), core::InvalidParameter);
  expectTogether(value);
}

TEST(Branches, NeedNoVoxels)
{
  scene::Case value = drilledCase(3);
  value.dissection.unload();
  scene::startBranch(value, "other", 1);
  EXPECT_DOUBLE_EQ(value.removedVolume(), 10.0);
  scene::renameBranch(value, "other", "antrum first");
  EXPECT_EQ(value.dissection.history().branch().name, "antrum first");
}

TEST(Branches, RemovalTakesWhatNothingElseLeadsTo)
{
  scene::Case value = drilledCase(2);
  scene::startBranch(value, "other", 1);
  drill(value, {4, 4, 8}, 7.0);
  scene::goToBranch(value, "main");
  drill(value, {7, 4, 8}, 3.0);
  EXPECT_EQ(scene::removeBranch(value, "other"), 1u);
  expectTogether(value);
  EXPECT_DOUBLE_EQ(value.removedVolume(), 24.0);
  EXPECT_EQ(value.dissection.undo(9), 3u);
  EXPECT_TRUE(value.dissection.mask().untouched());
}

TEST(Branches, TellWhatEachTook)
{
  scene::Case value = drilledCase(2);
  dissection::Dissection& work = value.dissection;
  dissection::Stroke a = *work.strokes()[0];
  dissection::Stroke b = *work.strokes()[1];
  a.info.structures = {{"nerve", 0.25}, {"sinus", 1.0}};
  b.info.structures = {{"nerve", 0.5}};
  work = dissection::Dissection({std::make_shared<const dissection::Stroke>(a),
                                 std::make_shared<const dissection::Stroke>(b)},
                                work.history());
  const auto both = scene::summaryOf(value, 1);
  EXPECT_EQ(both.strokes, 2u);
  EXPECT_DOUBLE_EQ(both.removed, 21.0);
  ASSERT_EQ(both.structures.size(), 2u);
  EXPECT_EQ(both.structures[0].name, "nerve");
  EXPECT_DOUBLE_EQ(both.structures[0].volume, 0.75);
  EXPECT_TRUE(scene::summaryOf(value, dissection::History::kStart).structures.empty());
}
