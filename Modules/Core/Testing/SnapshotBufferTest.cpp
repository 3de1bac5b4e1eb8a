#include <array>
#include <atomic>
#include <chrono>
#include <cstdint>
#include <thread>
#include <vector>

#include <gtest/gtest.h>

#include "petrous/Core/SnapshotBuffer.h"

using petrous::core::SnapshotBuffer;

namespace
{

// Every word carries the same number, so that a torn value is detected.
struct Repeated
{
  std::array<std::uint64_t, 24> words{};

  static Repeated of(std::uint64_t number)
  {
    Repeated value;
    value.words.fill(number);
    return value;
  }
  bool whole() const
  {
    for (const std::uint64_t word : words)
      if (word != words[0])
        return false;
    return true;
  }
};

struct Findings
{
  std::uint64_t read = 0;
  std::uint64_t torn = 0;
  std::uint64_t backward = 0;
  std::uint64_t different = 0;
};

Findings watch(const SnapshotBuffer<Repeated>& buffer, const std::atomic<bool>& done)
{
  Findings findings;
  Repeated value;
  std::uint64_t last = 0;
  while (!done.load())
  {
    if (!buffer.read(value))
      continue;
    ++findings.read;
    findings.torn += !value.whole();
    findings.backward += value.words[0] < last;
    findings.different += value.words[0] != last;
    last = value.words[0];
  }
  return findings;
}

} // namespace

TEST(SnapshotBuffer, HoldsItsInitialValueUntilSomethingIsWritten)
{
  const SnapshotBuffer<int> buffer(7);
  int value = 0;
  ASSERT_TRUE(buffer.read(value));
  EXPECT_EQ(value, 7);
  EXPECT_EQ(buffer.count(), 1U);
}

TEST(SnapshotBuffer, GivesTheLastOfManyWrites)
{
  SnapshotBuffer<double> buffer;
  for (int i = 1; i <= 1000; ++i)
  {
    buffer.write(0.5 * i);
    double value = 0.0;
    ASSERT_TRUE(buffer.read(value));
    ASSERT_EQ(value, 0.5 * i);
  }
  EXPECT_EQ(buffer.count(), 1001U);
}

TEST(SnapshotBuffer, KeepsTypesThatAreNoWholeNumberOfWords)
{
  struct Odd
  {
    char text[11];
  };
  SnapshotBuffer<Odd> buffer(Odd{"0123456789"});
  Odd value{};
  ASSERT_TRUE(buffer.read(value));
  EXPECT_STREQ(value.text, "0123456789");
}

TEST(SnapshotBuffer, NeverGivesHalfAValueToReadersBesideAWriterThatNeverPauses)
{
  SnapshotBuffer<Repeated> buffer;
  std::atomic<bool> done{false};
  std::array<Findings, 2> findings;
  std::vector<std::thread> readers;
  for (Findings& each : findings)
    readers.emplace_back([&] { each = watch(buffer, done); });

  const auto end = std::chrono::steady_clock::now() + std::chrono::milliseconds(500);
  std::uint64_t number = 0;
  while (std::chrono::steady_clock::now() < end)
    for (int i = 0; i < 1000; ++i)
      buffer.write(Repeated::of(++number));
  done = true;
  for (std::thread& reader : readers)
    reader.join();

  for (const Findings& each : findings)
  {
    EXPECT_GT(each.different, 1U) << "the reader never ran beside the writer";
    EXPECT_EQ(each.torn, 0U);
    EXPECT_EQ(each.backward, 0U);
  }
  Repeated last;
  ASSERT_TRUE(buffer.read(last));
  EXPECT_EQ(last.words[0], number);
}

TEST(SnapshotBuffer, LetsManyReadersReadAWriterThatPausesEachTime)
{
  SnapshotBuffer<Repeated> buffer;
  std::atomic<bool> done{false};
  std::atomic<std::uint64_t> refused{0};
  std::thread reader(
      [&]
      {
        Repeated value;
        while (!done.load())
          refused += !buffer.read(value);
      });
  for (std::uint64_t i = 1; i <= 300; ++i)
  {
    buffer.write(Repeated::of(i));
    std::this_thread::sleep_for(std::chrono::microseconds(100));
  }
  done = true;
  reader.join();
  EXPECT_EQ(refused.load(), 0U);
}
