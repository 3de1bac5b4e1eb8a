#include "petrous/Volume/PublishedMask.h"

#include <atomic>
#include <thread>

#include <gtest/gtest.h>

using namespace petrous;
using volume::CutMask;

namespace
{

core::GridGeometry grid()
{
  return {{100, 80, 40}, Eigen::Vector3d::Constant(0.5), Eigen::Vector3d::Zero()};
}

CutMask::BrickVersion filled(std::uint16_t value)
{
  auto brick = std::make_shared<CutMask::Brick>();
  brick->fill(value);
  return brick;
}

} // namespace

TEST(PublishedMask, StartsAsTheMaskThatItIsGiven)
{
  CutMask mask(grid());
  mask.setBrick(70, filled(7));
  const volume::PublishedMask published(mask);
  const volume::MaskState* state = published.acquire();
  for (std::size_t n = 0; n < mask.brickCount(); ++n)
    EXPECT_EQ(state->brick(n), mask.brick(n).get());
  published.release();
}

TEST(PublishedMask, KeepsAHeldStateAsItWasWhileTheMaskGoesOn)
{
  CutMask mask(grid());
  mask.setBrick(3, filled(100));
  volume::PublishedMask published(mask);
  const volume::MaskState* before = published.acquire();
  for (std::uint16_t value = 99; value > 0; --value)
  {
    mask.setBrick(3, filled(value));
    mask.setBrick(90, filled(value));
    published.publish(mask, {3, 90}, false);
  }
  EXPECT_EQ((*before->brick(3))[0], 100);
  EXPECT_EQ(before->brick(90), nullptr);
  EXPECT_LE(published.statesHeld(), 2U);
  const volume::MaskState* after = published.acquire();
  EXPECT_EQ((*after->brick(3))[0], 1);
  EXPECT_EQ((*after->brick(90))[0], 1);
  EXPECT_EQ(after->number(), 99U);
  EXPECT_EQ(after->raises(), 0U);
  published.release();
}

TEST(PublishedMask, SharesBlocksThatDidNotChange)
{
  CutMask mask(grid());
  const CutMask::BrickVersion far = filled(5);
  mask.setBrick(0, filled(1));
  mask.setBrick(100, far);
  volume::PublishedMask published(mask);
  const volume::MaskState* before = published.acquire();
  const auto* brick = before->brick(100);
  mask.setBrick(0, nullptr);
  published.publish(mask, {0}, true);
  const volume::MaskState* after = published.acquire();
  EXPECT_EQ(after->brick(100), brick);
  EXPECT_EQ(after->brick(0), nullptr);
  EXPECT_EQ(after->raises(), 1U);
  published.release();
}

// Two bricks always carry the same number; a reader of a partial change would see two.
TEST(PublishedMask, NeverShowsHalfAChangeToAReaderOnAnotherThread)
{
  CutMask mask(grid());
  mask.setBrick(3, filled(60000));
  mask.setBrick(99, filled(60000));
  volume::PublishedMask published(mask);
  std::atomic<bool> stop{false};
  std::size_t torn = 0, backward = 0, reads = 0;
  std::thread reader(
      [&]
      {
        std::uint16_t last = 60000;
        while (!stop.load())
        {
          const volume::MaskState* state = published.acquire();
          const std::uint16_t a = (*state->brick(3))[17];
          const std::uint16_t b = (*state->brick(99))[4000];
          torn += a != b;
          backward += a > last;
          last = a;
          ++reads;
          published.release();
        }
      });
  for (std::uint16_t value = 59999; value > 40000; --value)
  {
    mask.setBrick(3, filled(value));
    mask.setBrick(99, filled(value));
    published.publish(mask, {3, 99}, false);
    EXPECT_LE(published.statesHeld(), 3U);
  }
  stop = true;
  reader.join();
  EXPECT_GT(reads, 0U);
  EXPECT_EQ(torn, 0U);
  EXPECT_EQ(backward, 0U);
}
