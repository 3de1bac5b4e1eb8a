#include <random>

#include <gtest/gtest.h>

#include "petrous/Segmentation/MaskOperations.h"

using namespace petrous;
using namespace petrous::segmentation;
using Eigen::Vector3d;

namespace
{

core::GridGeometry grid(int n = 50)
{
  return {{n, n, n}, Vector3d(0.4, 0.5, 0.8), Vector3d(-5.0, 6.0, -7.0)};
}

std::vector<std::uint8_t> bytesOf(const EditableMask& mask)
{
  return {mask.voxels().data(), mask.voxels().data() + mask.voxels().size()};
}

} // namespace

TEST(EditableMask, StepsAreUndoneAndRedoneToTheBit)
{
  EditableMask mask(grid());
  std::mt19937 random(3);
  std::uniform_real_distribution<double> anywhere(-2.0, 30.0);
  std::vector<std::vector<std::uint8_t>> states{bytesOf(mask)};
  std::vector<std::uint64_t> counts{0};
  for (int n = 0; n < 25; ++n)
  {
    mask.beginStep();
    for (int stroke = 0; stroke < 3; ++stroke)
    {
      const Vector3d from =
          grid().origin() + Vector3d(anywhere(random), anywhere(random), anywhere(random));
      paint(mask, {from, from + Vector3d(2.0, 1.0, 0.0), 2.5, {}, {}, nullptr}, n % 4 != 3);
    }
    if (!mask.endStep())
      continue;
    states.push_back(bytesOf(mask));
    counts.push_back(mask.count());
    EXPECT_EQ(mask.count(), static_cast<std::uint64_t>(
                                std::count(states.back().begin(), states.back().end(), 1)));
  }
  ASSERT_GT(states.size(), 15U);
  for (std::size_t n = states.size() - 1; n > 0; --n)
  {
    ASSERT_TRUE(mask.canUndo());
    mask.undo();
    EXPECT_EQ(bytesOf(mask), states[n - 1]);
    EXPECT_EQ(mask.count(), counts[n - 1]);
  }
  EXPECT_FALSE(mask.canUndo());
  for (std::size_t n = 1; n < states.size(); ++n)
  {
    mask.redo();
    EXPECT_EQ(bytesOf(mask), states[n]);
  }
  EXPECT_FALSE(mask.canRedo());
}

TEST(EditableMask, AStepOfThePenTakesLittleMemory)
{
  EditableMask mask(grid(128));
  mask.beginStep();
  const Vector3d middle = grid(128).center();
  paint(mask, {middle, middle + Vector3d(20.0, 0.0, 0.0), 3.0, {}, {}, nullptr}, true);
  ASSERT_TRUE(mask.endStep());
  EXPECT_GT(mask.count(), 0U);
  EXPECT_LE(mask.lastStepBytes(), 128U * 128U * 128U / 20U) << "5 % of the volume";
  EXPECT_EQ(mask.historyBytes(), mask.lastStepBytes());
}

TEST(EditableMask, AStepThatChangesNothingIsNone)
{
  EditableMask mask(grid());
  mask.beginStep();
  const Vector3d middle = grid().center();
  paint(mask, {middle, middle, 2.0, {}, {}, nullptr}, false);
  EXPECT_FALSE(mask.endStep());
  mask.beginStep();
  paint(mask, {middle, middle, 2.0, {}, {}, nullptr}, true);
  paint(mask, {middle, middle, 2.0, {}, {}, nullptr}, false); // there and back
  EXPECT_FALSE(mask.endStep());
  EXPECT_FALSE(mask.canUndo());
  EXPECT_EQ(mask.count(), 0U);
}

TEST(EditableMask, ANewStepLosesTheUndoneOnes)
{
  EditableMask mask(grid());
  const Vector3d middle = grid().center();
  for (int n = 0; n < 2; ++n)
  {
    mask.beginStep();
    paint(
        mask,
        {middle + Vector3d(3.0 * n, 0, 0), middle + Vector3d(3.0 * n, 0, 0), 1.0, {}, {}, nullptr},
        true);
    mask.endStep();
  }
  mask.undo();
  mask.beginStep();
  paint(mask, {middle - Vector3d(3.0, 0, 0), middle - Vector3d(3.0, 0, 0), 1.0, {}, {}, nullptr},
        true);
  mask.endStep();
  EXPECT_FALSE(mask.canRedo());
  EXPECT_THROW(mask.redo(), core::InvalidParameter);
}

TEST(EditableMask, ReplacingGivesTheVoxelsOfAnother)
{
  EditableMask a(grid());
  EditableMask b(grid());
  const Vector3d middle = grid().center();
  a.beginStep();
  paint(a, {middle, middle, 3.0, {}, {}, nullptr}, true);
  a.endStep();
  b.beginStep();
  paint(b, {middle + Vector3d(5, 0, 0), middle + Vector3d(5, 0, 0), 2.0, {}, {}, nullptr}, true);
  b.endStep();
  const auto before = bytesOf(a);
  a.beginStep();
  a.replace(b.snapshot());
  ASSERT_TRUE(a.endStep());
  EXPECT_EQ(bytesOf(a), bytesOf(b));
  EXPECT_EQ(a.count(), b.count());
  a.undo();
  EXPECT_EQ(bytesOf(a), before);
  EXPECT_THROW(EditableMask(grid(20)).replace(b.snapshot()), core::InvalidParameter);
}

TEST(Mask, BecomesALabelMapAndComesBack)
{
  EditableMask drawn(grid());
  const Vector3d middle = grid().center();
  drawn.beginStep();
  paint(drawn, {middle, middle, 3.0, {}, {}, nullptr}, true);
  drawn.endStep();
  const volume::LabelMap labels = labelMapOf(drawn.snapshot(), {"ball", 7, {}, 0});
  ASSERT_EQ(labels.segments.size(), 1U);
  EXPECT_EQ(labels.segments[0].voxels, drawn.count());
  const Mask back = maskOf(labels, 7);
  EXPECT_EQ(back.count, drawn.count());
  EXPECT_TRUE(std::equal(back.voxels->data(), back.voxels->data() + back.voxels->size(),
                         drawn.voxels().data()));
  EXPECT_EQ(maskOf(labels, 6).count, 0U);
  EXPECT_THROW(labelMapOf(back, {"none", 0, {}, 0}), core::InvalidParameter);
}
