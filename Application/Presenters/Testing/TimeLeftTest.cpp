#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <functional>
#include <optional>
#include <random>
#include <vector>

#include <gtest/gtest.h>

#include "petrous/Presenters/TimeLeft.h"

namespace petrous::presenters
{
namespace
{

// A task that reports at `times`, asked four times a second and with each report; s. Its fraction
// is `fractionAt` of the time.
struct Shown
{
  double now = 0.0;
  std::optional<double> left;
};

std::vector<Shown> run(const std::vector<double>& times, double end,
                       const std::function<double(double)>& fractionAt)
{
  constexpr double kAsked = 0.25;
  TimeLeft time;
  std::vector<Shown> shown;
  std::size_t next = 0;
  for (int n = 0; kAsked * n <= end; ++n)
  {
    const double now = kAsked * n;
    for (; next < times.size() && times[next] <= now; ++next)
    {
      time.report(fractionAt(times[next]), times[next]);
      shown.push_back({times[next], time.shown(times[next])});
    }
    shown.push_back({now, time.shown(now)});
  }
  return shown;
}

std::vector<double> every(double step, double end)
{
  std::vector<double> times;
  for (int n = 0; step * n <= end; ++n)
    times.push_back(step * n);
  return times;
}

// Of texts that are shown one after another.
int changes(const std::vector<Shown>& all, bool upwards)
{
  int count = 0;
  for (std::size_t n = 1; n < all.size(); ++n)
    if (all[n - 1].left && all[n].left)
      count += upwards ? *all[n].left > *all[n - 1].left : *all[n].left < *all[n - 1].left;
  return count;
}

TEST(TimeLeft, IsWhatATaskOfConstantSpeedNeeds)
{
  constexpr double kLength = 100.0; // s
  const auto shown = run(every(0.1, kLength), kLength, [](double now) { return now / kLength; });
  int known = 0;
  for (const Shown& one : shown)
  {
    if (one.now < 3.5 || one.now > 99.5)
      continue;
    ASSERT_TRUE(one.left) << one.now;
    const double truth = kLength - one.now;
    const double step = truth < 20.0 ? 5.0 : truth < 60.0 ? 10.0 : 60.0;
    EXPECT_NEAR(*one.left, truth, 0.51 * step + (truth < 5.0 ? 2.5 : 0.1)) << one.now;
    ++known;
  }
  EXPECT_GT(known, 300);
  EXPECT_EQ(changes(shown, true), 0);
  EXPECT_GE(changes(shown, false), 7); // 1 min, 50 s, ..., 20, 15, 10, 5
}

TEST(TimeLeft, SaysNothingBeforeThereIsSomethingToGoBy)
{
  TimeLeft time;
  EXPECT_FALSE(time.shown(0.0));
  time.report(0.0, 10.0);
  time.report(0.5, 12.9); // too early
  EXPECT_FALSE(time.shown(12.9));
  EXPECT_FALSE(time.shown(20.0)); // nothing was reported since
  time.report(0.6, 13.1);
  EXPECT_TRUE(time.shown(13.1));

  time.restart();
  time.report(0.0, 100.0);
  time.report(0.02, 130.0); // too little
  EXPECT_FALSE(time.shown(130.0));
  time.report(0.04, 160.0); // in 60 s: 24 min
  ASSERT_TRUE(time.shown(160.0));
  EXPECT_EQ(*time.shown(160.0), 24.0 * 60.0);
}

TEST(TimeLeft, SaysNothingOfWhatIsDoneOrWouldTakeDays)
{
  TimeLeft time;
  time.report(0.0, 0.0);
  time.report(0.5, 10.0);
  ASSERT_TRUE(time.shown(10.0));
  EXPECT_EQ(*time.shown(10.0), 10.0);
  time.report(1.0, 20.0);
  EXPECT_FALSE(time.shown(20.0));

  time.restart();
  time.report(0.0, 0.0);
  time.report(0.04, 3600.0 * 24.0);
  EXPECT_FALSE(time.shown(3600.0 * 24.0));
}

TEST(TimeLeft, CountsDownBetweenTheStepsOfATask)
{
  constexpr double kLength = 100.0; // s, in ten steps
  const auto shown = run(every(10.0, kLength), kLength, [](double now) { return now / kLength; });
  for (const Shown& one : shown)
    if (one.now >= 30.0 && one.now < 95.0)
    {
      ASSERT_TRUE(one.left) << one.now;
      EXPECT_NEAR(*one.left, kLength - one.now, kLength - one.now > 60.0 ? 30.1 : 5.1) << one.now;
    }
  EXPECT_EQ(changes(shown, true), 0);
}

TEST(TimeLeft, IsCalmWhereStepsAreIrregular)
{
  constexpr double kLength = 300.0; // s
  std::mt19937 random(7);           // the same in each run and with each compiler
  std::vector<double> times{0.0};
  std::vector<double> fractions{0.0};
  while (times.back() < kLength)
  {
    // Pauses of 0.1 to 4 s, with progress that does not go by them.
    const double pause = 0.1 + 3.9 * (static_cast<double>(random()) / 4294967296.0);
    const double part =
        pause * (0.25 + 1.5 * (static_cast<double>(random()) / 4294967296.0)) / kLength;
    times.push_back(times.back() + pause);
    fractions.push_back(std::min(0.999, fractions.back() + part));
  }
  const double speed = fractions.back() / times.back();
  const auto shown = run(times, kLength,
                         [&](double now)
                         {
                           const auto found = std::lower_bound(times.begin(), times.end(), now);
                           return fractions[static_cast<std::size_t>(found - times.begin())];
                         });
  int known = 0;
  for (const Shown& one : shown)
    if (one.left && one.now > 40.0 && one.now < 0.9 * kLength)
    {
      const double truth = 1.0 / speed - one.now;
      EXPECT_NEAR(*one.left, truth, 0.35 * truth + 31.0) << one.now;
      ++known;
    }
  EXPECT_GT(known, 800);
  EXPECT_LE(changes(shown, true), 3);
}

TEST(TimeLeft, FollowsATaskThatBecomesSlower)
{
  constexpr double kQuick = 20.0; // s, for the first half; the second one takes 100 s
  const auto fractionAt = [](double now)
  { return now < kQuick ? 0.5 * now / kQuick : 0.5 + 0.5 * (now - kQuick) / 100.0; };
  const auto shown = run(every(0.2, 120.0), 119.0, fractionAt);
  double before = 0.0;
  for (const Shown& one : shown)
    if (one.left)
    {
      if (one.now <= kQuick)
        before = *one.left;
      if (one.now > 70.0 && one.now < 115.0)
      {
        EXPECT_NEAR(*one.left, 120.0 - one.now, 6.0) << one.now;
      }
    }
  EXPECT_EQ(before, 20.0);
}

TEST(TimeLeft, GrowsWhileNothingIsReported)
{
  TimeLeft time;
  for (int n = 0; n <= 20; ++n)
  {
    time.report(0.02 * n, n);
    time.shown(n);
  }
  ASSERT_EQ(time.shown(20.0), std::optional<double>(30.0));
  double last = 0.0;
  for (int n = 21; n <= 120; ++n)
  {
    ASSERT_TRUE(time.shown(n));
    last = *time.shown(n);
  }
  EXPECT_GE(last, 120.0); // 0.4 of it took 120 s
}

TEST(TimeLeft, BeginsAnewWithAFractionThatGoesBack)
{
  TimeLeft time;
  time.report(0.0, 0.0);
  time.report(0.8, 8.0);
  ASSERT_TRUE(time.shown(8.0));
  time.report(0.79, 9.0); // of another thread
  EXPECT_TRUE(time.shown(9.0));
  time.report(0.0, 10.0); // another part
  EXPECT_FALSE(time.shown(10.0));
  time.report(0.5, 20.0);
  EXPECT_EQ(time.shown(20.0), std::optional<double>(10.0));
}

TEST(TimeLeft, HasItsText)
{
  EXPECT_EQ(timeLeftText(std::nullopt), "");
  EXPECT_EQ(timeLeftText(5.0), "about 5 s left");
  EXPECT_EQ(timeLeftText(50.0), "about 50 s left");
  EXPECT_EQ(timeLeftText(60.0), "about 1 min left");
  EXPECT_EQ(timeLeftText(59.0 * 60.0), "about 59 min left");
  EXPECT_EQ(timeLeftText(4200.0), "about 1 h 10 min left");
}

} // namespace
} // namespace petrous::presenters
