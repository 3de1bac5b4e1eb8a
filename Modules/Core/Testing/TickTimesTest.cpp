#include <chrono>
#include <thread>

#include <gtest/gtest.h>

#include "petrous/Core/TickTimes.h"

using petrous::core::BenchmarkPoint;
using petrous::core::TickTimes;

TEST(TickTimes, GivesWhatTheTickGivesAndCountsIt)
{
  TickTimes times;
  EXPECT_EQ(times.wall(0.5), 0.0);
  int value = 3;
  EXPECT_EQ(&times.take([&]() -> int& { return value; }), &value);
  EXPECT_THROW(times.take([]() { throw 1; }), int);
  EXPECT_EQ(times.count(), 2u);
}

TEST(TickTimes, SetsTheWallApartFromTheProcessor)
{
  using std::chrono::milliseconds;
  TickTimes times;
  for (const int length : {1, 1, 1, 20})
    times.take([length] { std::this_thread::sleep_for(milliseconds(length)); });
  // A sleep lasts at least as long as requested and uses almost no CPU time.
  EXPECT_GE(times.wall(1.0), 0.020);
  EXPECT_GE(times.wall(0.0), 0.001);
  EXPECT_LE(times.wall(0.5), times.wall(1.0));
  EXPECT_LT(times.processor(1.0), times.wall(1.0));
  EXPECT_GE(times.wallSum(), 0.023);
  TickTimes all;
  all.add(times);
  all.add(times);
  BenchmarkPoint point;
  all.enter(point);
  EXPECT_EQ(point.extra.at("ticks"), 8.0);
  EXPECT_EQ(point.extra.at("wall_us_max"), 1e6 * times.wall(1.0));
  EXPECT_EQ(point.seconds, times.processor(0.5));
}
