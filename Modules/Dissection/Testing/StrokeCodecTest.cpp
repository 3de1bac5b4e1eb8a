#include <random>

#include <gtest/gtest.h>

#include "petrous/Dissection/Dissection.h"
#include "petrous/Dissection/StrokeCodec.h"

using namespace petrous;
using Eigen::Vector3d;

namespace
{

const core::GridGeometry kGrid({64, 64, 64}, Vector3d::Constant(0.3), Vector3d::Zero());

std::shared_ptr<const dissection::Stroke> strokeOf(dissection::Dissection& work)
{
  work.beginStroke({});
  for (int n = 0; n < 40; ++n)
    work.cut({Vector3d(5 + 0.1 * n, 9, 9), Vector3d(5.1 + 0.1 * n, 9, 9), 2.0});
  return work.endStroke();
}

} // namespace

TEST(StrokeCodec, GivesEveryVoxelBack)
{
  dissection::Dissection work(kGrid);
  const auto stroke = strokeOf(work);
  const auto bytes = dissection::encodeDeltas(stroke->deltas);
  const auto back = dissection::decodeDeltas(bytes, volume::CutMask(kGrid));
  ASSERT_EQ(back.size(), stroke->deltas.size());
  for (std::size_t n = 0; n < back.size(); ++n)
  {
    EXPECT_EQ(back[n].brick, stroke->deltas[n].brick);
    EXPECT_EQ(*back[n].after, *stroke->deltas[n].after);
    EXPECT_EQ(back[n].before, nullptr);
  }
}

TEST(StrokeCodec, IsSmallAndTheSameEveryTime)
{
  dissection::Dissection work(kGrid);
  const auto stroke = strokeOf(work);
  const auto bytes = dissection::encodeDeltas(stroke->deltas);
  EXPECT_EQ(bytes, dissection::encodeDeltas(stroke->deltas));
  EXPECT_LT(bytes.size(), stroke->deltas.size() * sizeof(volume::CutMask::Brick) / 4);
}

TEST(StrokeCodec, RefusesEveryTruncation)
{
  dissection::Dissection work(kGrid);
  const auto bytes = dissection::encodeDeltas(strokeOf(work)->deltas);
  for (std::size_t size = 0; size < bytes.size(); size += 1 + bytes.size() / 50)
    EXPECT_THROW(
        dissection::decodeDeltas({bytes.begin(), bytes.begin() + size}, volume::CutMask(kGrid)),
        core::InvalidParameter)
        << size;
}

TEST(StrokeCodec, SurvivesDamageWithoutACrash)
{
  dissection::Dissection work(kGrid);
  const auto bytes = dissection::encodeDeltas(strokeOf(work)->deltas);
  std::mt19937 random(11);
  for (int n = 0; n < 500; ++n)
  {
    auto damaged = bytes;
    for (int flips = 0; flips < 3; ++flips)
      damaged[random() % damaged.size()] ^= static_cast<std::uint8_t>(1u << (random() % 8));
    try
    {
      for (const auto& delta : dissection::decodeDeltas(damaged, volume::CutMask(kGrid)))
        ASSERT_LT(delta.brick, volume::CutMask(kGrid).brickCount());
    }
    catch (const core::InvalidParameter&)
    {
    }
  }
}

TEST(StrokeCodec, RefusesAStrokeOfAnotherGrid)
{
  dissection::Dissection work(kGrid);
  const auto bytes = dissection::encodeDeltas(strokeOf(work)->deltas);
  const core::GridGeometry small({20, 20, 20}, Vector3d::Constant(0.3), Vector3d::Zero());
  EXPECT_THROW(dissection::decodeDeltas(bytes, volume::CutMask(small)), core::InvalidParameter);
}
