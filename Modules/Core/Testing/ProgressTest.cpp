#include <atomic>
#include <chrono>
#include <future>
#include <thread>
#include <vector>

#include <gtest/gtest.h>

#include "petrous/Core/Error.h"
#include "petrous/Core/Lazy.h"
#include "petrous/Core/Progress.h"

using namespace petrous::core;

TEST(Progress, PartsMapOnTheWhole)
{
  std::vector<double> seen;
  const Progress whole([&seen](double fraction, const std::string&) { seen.push_back(fraction); });
  const Progress part = whole.part(0.5, 1.0).part(0.0, 0.5);
  part.report(0.0, "a");
  part.report(1.0, "a");
  part.report(7.0, "a");
  EXPECT_EQ(seen, (std::vector<double>{0.5, 0.75, 0.75}));
}

TEST(Progress, StopsWorkThatWasCancelled)
{
  auto token = std::make_shared<CancelToken>();
  const Progress progress(nullptr, token);
  EXPECT_NO_THROW(progress.report(0.1, "reading"));
  token->cancel();
  try
  {
    progress.part(0, 1).report(0.2, "reading");
    FAIL() << "went on";
  }
  catch (const CancelledError& error)
  {
    EXPECT_EQ(error.fault(), Fault::Cancelled);
    EXPECT_NE(std::string(error.what()).find("reading"), std::string::npos);
  }
}

TEST(Lazy, MakesItsValueOnceAndOnlyWhenAsked)
{
  int made = 0;
  const Lazy<int> lazy(
      [&made]
      {
        ++made;
        return std::make_shared<const int>(7);
      });
  const Lazy<int> copy = lazy;
  EXPECT_EQ(lazy.peek(), nullptr);
  EXPECT_EQ(made, 0);
  EXPECT_EQ(*lazy.get(), 7);
  EXPECT_EQ(*copy.get(), 7);
  EXPECT_EQ(made, 1);
  EXPECT_EQ(*copy.peek(), 7);
}

TEST(Lazy, TriesAgainAfterAFailure)
{
  int calls = 0;
  const Lazy<int> lazy(
      [&calls]() -> std::shared_ptr<const int>
      {
        if (++calls == 1)
          throw InvalidParameter("first time");
        return std::make_shared<const int>(1);
      });
  EXPECT_THROW(lazy.get(), InvalidParameter);
  EXPECT_EQ(*lazy.get(), 1);
}

TEST(Lazy, IsPeekedAtWhileItIsMade)
{
  std::future<std::shared_ptr<const int>> peeked; // outlives the maker: waits when destroyed
  std::future_status status = std::future_status::timeout;
  Lazy<int> lazy;
  lazy = Lazy<int>(Lazy<int>::Maker(
      [&]
      {
        peeked = std::async(std::launch::async, [&lazy] { return lazy.peek(); });
        status = peeked.wait_for(std::chrono::seconds(20));
        return std::make_shared<const int>(7);
      }));
  EXPECT_EQ(*lazy.get(), 7);
  EXPECT_EQ(status, std::future_status::ready) << "who peeked waited for the maker";
  EXPECT_EQ(peeked.get(), nullptr);
  EXPECT_EQ(*lazy.peek(), 7);
}

TEST(Lazy, IsMadeOnceForManyThreadsAndPeekedAtByOthers)
{
  std::atomic<int> made{0};
  const Lazy<int> lazy(Lazy<int>::Maker(
      [&made]
      {
        ++made;
        return std::make_shared<const int>(7);
      }));
  std::atomic<int> wrong{0};
  std::vector<std::thread> threads;
  for (int n = 0; n < 4; ++n)
    threads.emplace_back(
        [&lazy, &wrong, n]
        {
          for (int turn = 0; turn < 1000; ++turn)
          {
            const auto value = n % 2 == 0 ? lazy.get() : lazy.peek();
            if ((value && *value != 7) || (n % 2 == 0 && !value))
              ++wrong;
          }
        });
  for (std::thread& thread : threads)
    thread.join();
  EXPECT_EQ(wrong, 0);
  EXPECT_EQ(made, 1);
}
