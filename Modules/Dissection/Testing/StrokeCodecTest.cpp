#include <random>

#include <gtest/gtest.h>

#include "petrous/Dissection/Dissection.h"
#include "petrous/Dissection/StrokeCodec.h"

using namespace petrous;
using Eigen::Vector3d;

namespace
{

const core::GridGeometry kGrid({64, 64, 64}, Vector3d::Constant(0.3), Vector3d::Zero());

// Deltas of a stroke of overlapping cuts.
std::vector<dissection::BrickDelta> someDeltas()
{
  volume::CutMask mask(kGrid);
  for (int n = 0; n < 40; ++n)
    dissection::cut(mask, {Vector3d(5 + 0.1 * n, 9, 9), Vector3d(5.1 + 0.1 * n, 9, 9), 2.0});
  std::vector<dissection::BrickDelta> deltas;
  for (std::size_t n = 0; n < mask.brickCount(); ++n)
    if (mask.brick(n))
      deltas.push_back({n, nullptr, mask.brick(n)});
  return deltas;
}

volume::CutMask applied(const std::vector<std::uint8_t>& bytes, dissection::Step step,
                        volume::CutMask mask)
{
  dissection::BrickDraft draft(mask);
  dissection::applyDeltas(bytes, step, draft);
  for (auto& delta : draft.take())
    mask.setBrick(delta.brick, delta.after);
  return mask;
}

volume::CutMask applied(const std::vector<std::uint8_t>& bytes)
{
  return applied(bytes, dissection::Step::Redo, volume::CutMask(kGrid));
}

} // namespace

TEST(StrokeCodec, GivesEveryVoxelBack)
{
  const auto deltas = someDeltas();
  const auto bytes = dissection::encodeDeltas(deltas);
  const volume::CutMask after = applied(bytes);
  std::size_t bricks = 0;
  for (std::size_t n = 0; n < after.brickCount(); ++n)
    bricks += after.brick(n) != nullptr;
  ASSERT_EQ(bricks, deltas.size());
  for (const auto& delta : deltas)
    EXPECT_EQ(*after.brick(delta.brick), *delta.after);
  EXPECT_TRUE(applied(bytes, dissection::Step::Undo, after).untouched());
}

// Every 16-bit value, without correlation between voxels.
TEST(StrokeCodec, GivesNoiseBack)
{
  std::mt19937 random(5);
  std::vector<dissection::BrickDelta> deltas;
  for (const std::size_t brick : {3u, 4u, 60u})
  {
    auto before = std::make_shared<volume::CutMask::Brick>();
    auto after = std::make_shared<volume::CutMask::Brick>();
    for (std::size_t n = 0; n < before->size(); ++n)
    {
      (*before)[n] = static_cast<std::uint16_t>(random());
      (*after)[n] = static_cast<std::uint16_t>(random() % ((*before)[n] + 1u));
    }
    deltas.push_back({brick, before, after});
  }
  volume::CutMask mask(kGrid);
  for (const auto& delta : deltas)
    mask.setBrick(delta.brick, delta.before);
  const auto bytes = dissection::encodeDeltas(deltas);
  const auto after = applied(bytes, dissection::Step::Redo, mask);
  const auto back = applied(bytes, dissection::Step::Undo, after);
  for (const auto& delta : deltas)
  {
    EXPECT_EQ(*after.brick(delta.brick), *delta.after);
    EXPECT_EQ(*back.brick(delta.brick), *delta.before);
  }
}

TEST(StrokeCodec, IsSmallAndTheSameEveryTime)
{
  const auto deltas = someDeltas();
  const auto bytes = dissection::encodeDeltas(deltas);
  EXPECT_EQ(bytes, dissection::encodeDeltas(deltas));
  EXPECT_LT(bytes.size(), deltas.size() * sizeof(volume::CutMask::Brick) / 4);
}

TEST(StrokeCodec, RefusesEveryTruncation)
{
  const auto bytes = dissection::encodeDeltas(someDeltas());
  for (std::size_t size = 0; size < bytes.size(); size += 1 + bytes.size() / 50)
    EXPECT_THROW(applied({bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(size)}),
                 core::InvalidParameter)
        << size;
}

TEST(StrokeCodec, SurvivesDamageWithoutACrash)
{
  const auto bytes = dissection::encodeDeltas(someDeltas());
  std::mt19937 random(11);
  int refused = 0;
  for (int n = 0; n < 2000; ++n)
  {
    auto damaged = bytes;
    for (int flips = 0; flips < 3; ++flips)
      damaged[random() % damaged.size()] ^= static_cast<std::uint8_t>(1u << (random() % 8));
    try
    {
      applied(damaged);
    }
    catch (const core::InvalidParameter&)
    {
      ++refused;
    }
  }
  EXPECT_GT(refused, 0);
}

TEST(StrokeCodec, RefusesAStrokeOfAnotherGrid)
{
  const auto bytes = dissection::encodeDeltas(someDeltas());
  const core::GridGeometry small({20, 20, 20}, Vector3d::Constant(0.3), Vector3d::Zero());
  EXPECT_THROW(applied(bytes, dissection::Step::Redo, volume::CutMask(small)),
               core::InvalidParameter);
}

TEST(StrokeCodec, RefusesToGiveBackWhatWasNotTaken)
{
  const auto bytes = dissection::encodeDeltas(someDeltas());
  EXPECT_THROW(applied(bytes, dissection::Step::Undo, volume::CutMask(kGrid)),
               core::InvalidParameter);
}

TEST(StrokeCodec, RefusesVoxelsBeyondTheGrid)
{
  // Bricks of 16 extend beyond 20 voxels.
  const core::GridGeometry grid({20, 20, 20}, Vector3d::Constant(0.3), Vector3d::Zero());
  const volume::CutMask mask(grid);
  for (int axis = 0; axis < 3; ++axis)
    for (const int at : {3, 4, 15}) // 19 is the last voxel
    {
      core::Index3 voxel{0, 0, 0};
      voxel[static_cast<std::size_t>(axis)] = at;
      core::Index3 position{0, 0, 0};
      position[static_cast<std::size_t>(axis)] = 1;
      auto after = std::make_shared<volume::CutMask::Brick>();
      after->fill(volume::CutMask::kUntouched);
      (*after)[static_cast<std::size_t>(voxel[0] + 16 * (voxel[1] + 16 * voxel[2]))] = 7;
      const auto bytes =
          dissection::encodeDeltas({{mask.brickIndex(position), nullptr, std::move(after)}});
      dissection::BrickDraft draft(mask);
      if (at == 3)
        EXPECT_NO_THROW(dissection::applyDeltas(bytes, dissection::Step::Redo, draft));
      else
        EXPECT_THROW(dissection::applyDeltas(bytes, dissection::Step::Redo, draft),
                     core::InvalidParameter)
            << axis << ' ' << at;
    }
}
