#include <thread>
#include <vector>

#include <gtest/gtest.h>

#include "petrous/Session/SpscRing.h"

using petrous::core::InvalidParameter;
using petrous::session::SpscRing;

TEST(SpscRing, GivesItemsInOrderManyTimesRound)
{
  SpscRing<int> ring(5);
  EXPECT_EQ(ring.capacity(), 8u);
  int next = 0;
  for (int n = 0; n < 100; ++n)
  {
    EXPECT_TRUE(ring.push(2 * n));
    EXPECT_TRUE(ring.push(2 * n + 1));
    std::vector<int> items(3);
    const std::size_t count = ring.pop(items.data(), items.size());
    for (std::size_t i = 0; i < count; ++i)
      EXPECT_EQ(items[i], next++);
  }
  int item = 0;
  while (ring.pop(item))
    EXPECT_EQ(item, next++);
  EXPECT_EQ(next, 200);
  EXPECT_EQ(ring.dropped(), 0u);
}

TEST(SpscRing, CountsWhatItCannotHoldAndKeepsTheOldest)
{
  SpscRing<int> ring(4);
  for (int n = 0; n < 7; ++n)
    EXPECT_EQ(ring.push(n), n < 4);
  EXPECT_EQ(ring.dropped(), 3u);
  int item = -1;
  for (int n = 0; n < 4; ++n)
  {
    ASSERT_TRUE(ring.pop(item));
    EXPECT_EQ(item, n);
  }
  EXPECT_FALSE(ring.pop(item));
  EXPECT_TRUE(ring.push(9));
  EXPECT_TRUE(ring.pop(item));
  EXPECT_EQ(item, 9);
}

TEST(SpscRing, RefusesSizesThatItCannotHave)
{
  EXPECT_THROW(SpscRing<int>(0), InvalidParameter);
  EXPECT_THROW(SpscRing<int>((std::size_t{1} << 24) + 1), InvalidParameter);
}

TEST(SpscRing, HandsWholeItemsFromThreadToThread)
{
  struct Item
  {
    std::uint64_t values[16];
  };
  constexpr std::uint64_t kItems = 100000;
  SpscRing<Item> ring(64);
  std::thread producer(
      [&ring]
      {
        for (std::uint64_t n = 0; n < kItems; ++n)
        {
          Item item;
          for (std::uint64_t& value : item.values)
            value = n;
          while (!ring.push(item))
            std::this_thread::yield();
        }
      });
  std::uint64_t wrong = 0;
  for (std::uint64_t n = 0; n < kItems;)
  {
    Item item;
    if (!ring.pop(item))
    {
      std::this_thread::yield();
      continue;
    }
    for (const std::uint64_t value : item.values)
      wrong += value != n;
    ++n;
  }
  producer.join();
  EXPECT_EQ(wrong, 0u);
}
