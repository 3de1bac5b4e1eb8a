#include <cmath>

#include <gtest/gtest.h>

#include "petrous/Core/TickHistogram.h"

using petrous::core::TickHistogram;

TEST(TickHistogram, IsEmptyAtFirst)
{
  const TickHistogram times;
  EXPECT_EQ(times.count(), 0u);
  EXPECT_EQ(times.max(), 0.0);
  EXPECT_EQ(times.quantile(0.5), 0.0);
  EXPECT_EQ(times.quantile(1.0), 0.0);
}

// 1000 durations of 0.5, 1.5, ... 999.5 us: one in each of the first thousand bins.
TEST(TickHistogram, GivesEachQuantileToAMicrosecond)
{
  TickHistogram times;
  for (int n = 999; n >= 0; --n)
    times.add(1e-6 * (n + 0.5));
  EXPECT_EQ(times.count(), 1000u);
  EXPECT_NEAR(times.quantile(0.0), 1e-6, 1e-12);
  EXPECT_NEAR(times.quantile(0.5), 500e-6, 1e-12);
  EXPECT_NEAR(times.quantile(0.999), 999e-6, 1e-12);
  EXPECT_EQ(times.quantile(0.9999), times.max()) << "the last one's bin ends above it";
  EXPECT_EQ(times.quantile(1.0), times.max());
  EXPECT_EQ(times.max(), 1e-6 * 999.5);
}

TEST(TickHistogram, CountsWhatIsBeyondItsBinsAndKnowsTheLongest)
{
  TickHistogram times;
  for (int n = 0; n < 9; ++n)
    times.add(100.5e-6);
  times.add(3.25);
  times.add(-1.0);
  times.add(std::nan(""));
  EXPECT_EQ(times.count(), 11u);
  EXPECT_NEAR(times.quantile(0.05), 1e-6, 1e-12) << "a negative one counts as none";
  EXPECT_NEAR(times.quantile(0.9), 101e-6, 1e-12);
  EXPECT_EQ(times.quantile(1.0), 3.25);
  EXPECT_EQ(times.max(), 3.25);
}
