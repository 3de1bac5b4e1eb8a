#include "petrous/Core/OpenedLock.h"

#include <cerrno>
#include <cstdlib>
#include <fstream>
#include <string>
#include <thread>

#include <gtest/gtest.h>

#include <fcntl.h>
#include <unistd.h>

#include "SystemCalls.h"

using namespace petrous::core;
using petrous::testing::SystemCalls;
namespace fs = std::filesystem;

TEST(OpenedLock, WaitsForAnotherAsLongAsItIsTold)
{
  using namespace std::chrono_literals;
  std::string name = (fs::temp_directory_path() / "petrous-lock-XXXXXX").string();
  const int first = ::mkstemp(name.data());
  const fs::path path = name;
  const int second = ::open(path.c_str(), O_RDWR | O_CLOEXEC);
  ASSERT_GE(first, 0);
  ASSERT_GE(second, 0);
  EXPECT_EQ(lockOpened(first), LockState::Ours);
  EXPECT_EQ(lockOpened(first), LockState::Ours) << "again";
  EXPECT_EQ(lockOpened(second), LockState::Anothers);
  EXPECT_EQ(lockOpened(second, 20ms), LockState::Anothers);
  std::thread ends(
      [first]
      {
        std::this_thread::sleep_for(20ms);
        ::close(first);
      });
  EXPECT_EQ(lockOpened(second, 60s), LockState::Ours);
  ends.join();
  EXPECT_TRUE(isOpenedAt(second, path));
  fs::remove(path);
  EXPECT_FALSE(isOpenedAt(second, path));
  std::ofstream(path) << "another";
  EXPECT_FALSE(isOpenedAt(second, path));
  ::close(second);
  fs::remove(path);
  EXPECT_EQ(lockOpened(second), LockState::NoLocks) << "nothing is open";
}

// One that waits as long as another has it does not give up.
TEST(OpenedLock, WaitsUntilItIsItsOwn)
{
  std::string name = (fs::temp_directory_path() / "petrous-lock-XXXXXX").string();
  const int first = ::mkstemp(name.data());
  const int second = ::open(name.c_str(), O_RDWR | O_CLOEXEC);
  fs::remove(name);
  ASSERT_GE(first, 0);
  ASSERT_GE(second, 0);
  ASSERT_EQ(lockOpened(first), LockState::Ours);
  std::thread ends(
      [first]
      {
        std::this_thread::sleep_for(std::chrono::milliseconds(20));
        ::close(first);
      });
  EXPECT_EQ(lockOpened(second, kWaitForLock), LockState::Ours);
  ends.join();
  ::close(second);
}

TEST(OpenedLock, IsAskedForAgainAfterASignalAndTellsWhyThereAreNone)
{
  std::string name = (fs::temp_directory_path() / "petrous-lock-XXXXXX").string();
  const int file = ::mkstemp(name.data());
  fs::remove(name);
  ASSERT_GE(file, 0);
  SystemCalls::fail("flock", 1, ENOLCK);
  const LockState none = lockOpened(file, kWaitForLock);
  const int why = errno;
  EXPECT_EQ(none, LockState::NoLocks);
  EXPECT_EQ(why, ENOLCK);
  SystemCalls::fail("flock", 1, EINTR);
  EXPECT_EQ(lockOpened(file, kWaitForLock), LockState::Ours);
  EXPECT_EQ(SystemCalls::countOfName(), 2);
  SystemCalls::reset();
  ::close(file);
}
