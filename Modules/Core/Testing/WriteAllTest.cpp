#include "petrous/Core/WriteAll.h"

#include <cerrno>
#include <string>
#include <thread>

#include <gtest/gtest.h>

#include <fcntl.h>
#include <unistd.h>

using petrous::core::writeAll;

TEST(WriteAll, WritesMoreThanAPipeHolds)
{
  int ends[2] = {-1, -1};
  ASSERT_EQ(::pipe(ends), 0);
  std::string bytes(1 << 20, '\0');
  for (std::size_t n = 0; n < bytes.size(); ++n)
    bytes[n] = static_cast<char>(n % 251);
  std::string got;
  std::thread reader(
      [&got, from = ends[0]]
      {
        char block[1000];
        for (ssize_t count = 0; (count = ::read(from, block, sizeof block)) > 0;)
          got.append(block, static_cast<std::size_t>(count));
      });
  EXPECT_EQ(writeAll(ends[1], bytes.data(), bytes.size()), 0);
  ::close(ends[1]);
  reader.join();
  ::close(ends[0]);
  EXPECT_TRUE(got == bytes);
}

TEST(WriteAll, ReturnsWhatTheSystemSays)
{
  const int full = ::open("/dev/full", O_WRONLY | O_CLOEXEC);
  ASSERT_GE(full, 0);
  EXPECT_EQ(writeAll(full, "abc", 3), ENOSPC);
  EXPECT_EQ(writeAll(full, "abc", 0), 0);
  ::close(full);
  EXPECT_EQ(writeAll(-1, "abc", 3), EBADF);
}
