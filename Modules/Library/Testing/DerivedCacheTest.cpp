#include <chrono>
#include <fstream>
#include <thread>
#include <vector>

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include "TestCase.h"
#include "petrous/Library/DerivedCache.h"

using namespace petrous::library;
namespace fs = std::filesystem;
using test::TemporaryFolder;

namespace
{

using Bytes = DerivedCache::Bytes;

// Incompressible.
Bytes noise(std::size_t count, std::uint32_t seed)
{
  Bytes bytes(count);
  for (std::uint8_t& byte : bytes)
  {
    seed = seed * 1664525U + 1013904223U;
    byte = static_cast<std::uint8_t>(seed >> 24U);
  }
  return bytes;
}

std::vector<fs::path> filesIn(const fs::path& folder)
{
  std::vector<fs::path> files;
  for (const auto& entry : fs::directory_iterator(folder))
    files.push_back(entry.path());
  return files;
}

void age(const fs::path& path, std::chrono::minutes by)
{
  fs::last_write_time(path, fs::file_time_type::clock::now() - by);
}

} // namespace

TEST(DerivedCache, GivesBackWhatWasPutUnderItsKey)
{
  const TemporaryFolder folder;
  DerivedCache cache(folder.path() / "derived");
  EXPECT_FALSE(cache.find("a"));
  cache.put("a", noise(10000, 1));
  cache.put("b", {});
  DerivedCache other(folder.path() / "derived"); // as another program would
  EXPECT_EQ(other.find("a"), noise(10000, 1));
  EXPECT_EQ(other.find("b"), Bytes());
  EXPECT_FALSE(other.find("c"));
  EXPECT_GT(cache.bytes(), 10000U);
}

TEST(DerivedCache, NoticesEveryFlippedBitAndEveryLostEnd)
{
  const TemporaryFolder folder;
  DerivedCache cache(folder.path());
  const Bytes good = noise(300, 2);
  for (int bit = 0; bit < 8 * 300; bit += 7)
  {
    cache.put("key", good);
    const fs::path file = filesIn(folder.path()).at(0);
    std::fstream stream(file, std::ios::in | std::ios::out | std::ios::binary);
    stream.seekg(bit / 8);
    const char byte = static_cast<char>(stream.get() ^ (1 << bit % 8));
    stream.seekp(bit / 8);
    stream.put(byte);
    stream.close();
    // A bit without meaning for the format may be flipped; other content must not be returned.
    const auto found = cache.find("key");
    EXPECT_TRUE(!found || *found == good) << bit;
    if (bit >= 160)
    {
      EXPECT_FALSE(found) << bit;
    }
    if (!found)
    {
      EXPECT_FALSE(fs::exists(file)) << "what is damaged is removed";
    }
  }
  cache.put("key", good);
  const fs::path file = filesIn(folder.path()).at(0);
  fs::resize_file(file, fs::file_size(file) / 2);
  EXPECT_FALSE(cache.find("key"));
  cache.put("key", good);
  fs::resize_file(file, 0);
  EXPECT_FALSE(cache.find("key"));
}

TEST(DerivedCache, DoesNotTakeAnotherKeysFileForItsOwn)
{
  const TemporaryFolder folder;
  DerivedCache cache(folder.path());
  cache.put("one", noise(100, 1));
  const fs::path one = filesIn(folder.path()).at(0);
  cache.put("two", noise(100, 2));
  for (const fs::path& file : filesIn(folder.path()))
    if (file != one)
      fs::copy_file(one, file, fs::copy_options::overwrite_existing);
  EXPECT_FALSE(cache.find("two"));
  EXPECT_TRUE(cache.find("one"));
}

TEST(DerivedCache, RemovesFirstWhatWasNotUsedForTheLongestTime)
{
  const TemporaryFolder folder;
  DerivedCache cache(folder.path(), 35000);
  for (const char* key : {"a", "b", "c"})
  {
    cache.put(key, noise(10000, static_cast<std::uint32_t>(key[0])));
    for (const fs::path& file : filesIn(folder.path()))
      fs::last_write_time(file, fs::last_write_time(file) - std::chrono::minutes(10));
  }
  EXPECT_TRUE(cache.find("a")); // used now, so "b" is the oldest
  cache.put("d", noise(10000, 4));
  EXPECT_TRUE(cache.find("a"));
  EXPECT_FALSE(cache.find("b"));
  EXPECT_TRUE(cache.find("c"));
  EXPECT_TRUE(cache.find("d"));
  EXPECT_LE(cache.bytes(), 35000U);
  cache.put("larger than all", noise(40000, 5));
  EXPECT_FALSE(cache.find("larger than all"));
  EXPECT_TRUE(cache.find("a"));
}

TEST(DerivedCache, IsPrunedAndLeavesWhatOthersWriteNow)
{
  const TemporaryFolder folder;
  DerivedCache cache(folder.path());
  cache.put("a", noise(1000, 1));
  std::ofstream(folder.path() / ".petrous-1") << "half";
  std::ofstream(folder.path() / ".petrous-2") << "left";
  std::ofstream(folder.path() / "notes.txt") << "not ours";
  age(folder.path() / ".petrous-2", std::chrono::minutes(90));
  EXPECT_GT(cache.prune(0), 1000U);
  EXPECT_FALSE(cache.find("a"));
  EXPECT_TRUE(fs::exists(folder.path() / ".petrous-1"));
  EXPECT_FALSE(fs::exists(folder.path() / ".petrous-2"));
  EXPECT_TRUE(fs::exists(folder.path() / "notes.txt"));
}

TEST(DerivedCache, IsNoFaultWhereNothingCanBeWritten)
{
  const TemporaryFolder folder;
  std::ofstream(folder.path() / "file") << "in the way";
  DerivedCache cache(folder.path() / "file");
  cache.put("a", noise(10, 1));
  EXPECT_FALSE(cache.find("a"));
  EXPECT_EQ(cache.bytes(), 0U);
  EXPECT_EQ(cache.prune(0), 0U);
}

TEST(DerivedCache, IsSharedByThreadsAndPrograms)
{
  const TemporaryFolder folder;
  const auto work = [&folder](std::uint32_t seed)
  {
    DerivedCache cache(folder.path(), 60000);
    for (std::uint32_t turn = 0; turn < 60; ++turn)
    {
      const std::uint32_t which = (seed + turn) % 8;
      const auto found = cache.find(std::to_string(which));
      if (found && *found != noise(9000 + which, which))
        return false;
      cache.put(std::to_string(which), noise(9000 + which, which));
    }
    return true;
  };
  std::vector<pid_t> programs;
  for (std::uint32_t n = 0; n < 3; ++n)
  {
    const pid_t child = ::fork();
    if (child == 0)
      ::_exit(work(n) ? 0 : 1);
    programs.push_back(child);
  }
  EXPECT_TRUE(work(5));
  for (const pid_t program : programs)
  {
    int status = 1;
    ASSERT_EQ(::waitpid(program, &status, 0), program);
    EXPECT_TRUE(WIFEXITED(status) && WEXITSTATUS(status) == 0);
  }
  EXPECT_LE(DerivedCache(folder.path()).bytes(), 70000U);
  for (const fs::path& file : filesIn(folder.path()))
    EXPECT_EQ(file.extension(), ".derived");
}
