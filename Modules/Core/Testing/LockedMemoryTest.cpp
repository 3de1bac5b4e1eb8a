#include "petrous/Core/LockedMemory.h"

#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <memory>
#include <string>
#include <vector>

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/mman.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

using petrous::core::LockedMemory;
using petrous::core::majorPageFaults;

namespace
{

constexpr std::size_t kBytes = 4 << 20;
constexpr std::size_t kPage = 4096;

// A file on the disk of the test directory, mapped as the library maps a CT.
class MappedFile
{
public:
  MappedFile()
  {
    std::string name = "locked-memory-XXXXXX";
    const int file = mkstemp(name.data());
    EXPECT_GE(file, 0);
    unlink(name.c_str());
    const std::vector<char> content(kBytes, 1);
    EXPECT_EQ(write(file, content.data(), kBytes), static_cast<ssize_t>(kBytes));
    fsync(file);
    m_start = mmap(nullptr, kBytes, PROT_READ, MAP_SHARED, file, 0);
    close(file);
  }
  ~MappedFile() { munmap(m_start, kBytes); }
  MappedFile(const MappedFile&) = delete;
  MappedFile& operator=(const MappedFile&) = delete;

  LockedMemory::Range range() const { return {m_start, kBytes}; }

  // Pages the file out, as the system does under memory pressure.
  void pageOut() const
  {
    faultsOfReading(); // only mapped pages are paged out
    madvise(m_start, kBytes, MADV_RANDOM);
    static_cast<void>(madvise(m_start, kBytes, MADV_PAGEOUT));
  }

  // Major faults while all pages are read, in non-sequential order.
  long faultsOfReading() const
  {
    const long before = majorPageFaults();
    const auto* bytes = static_cast<const volatile char*>(m_start);
    for (std::size_t n = 0; n < kBytes / kPage; ++n)
      static_cast<void>(bytes[kPage * (n * 389 % (kBytes / kPage))]);
    return majorPageFaults() - before;
  }

private:
  void* m_start = nullptr;
};

} // namespace

TEST(LockedMemory, AReaderHasNoMajorFaultWhateverIsPagedOut)
{
  const MappedFile file;
  file.pageOut();
  if (file.faultsOfReading() == 0)
    GTEST_SKIP() << "this file system pages nothing out";
  rlimit limit{};
  getrlimit(RLIMIT_MEMLOCK, &limit);
  if (limit.rlim_cur < kBytes + kPage && geteuid() != 0)
    GTEST_SKIP() << "the limit of locked memory is below 4 MB";
  {
    file.pageOut();
    const LockedMemory locked({file.range(), {nullptr, 0}});
    EXPECT_TRUE(locked.locked());
    EXPECT_EQ(locked.bytes(), kBytes);
    file.pageOut();
    EXPECT_EQ(file.faultsOfReading(), 0);
  }
  file.pageOut();
  EXPECT_GT(file.faultsOfReading(), 0) << "it is given back";
}

// VmLck: locked memory of the process in kB.
TEST(LockedMemory, APageIsLockedUntilTheLastThatWantsItEnds)
{
  const auto lockedKb = []
  {
    std::ifstream status("/proc/self/status");
    std::string word;
    long value = -1;
    while (status >> word)
      if (word == "VmLck:" && status >> value)
        break;
    return value;
  };
  const MappedFile file;
  const LockedMemory::Range all = file.range();
  const auto* bytes = static_cast<const unsigned char*>(all.start);
  const long before = lockedKb();
  auto whole = std::make_unique<LockedMemory>(std::vector<LockedMemory::Range>{all});
  if (!whole->locked() || lockedKb() <= before)
    GTEST_SKIP() << "nothing may be locked here";
  const long pageKb = static_cast<long>(kPage / 1024);
  // Two ranges that share a page, with borders inside pages.
  auto first =
      std::make_unique<LockedMemory>(std::vector<LockedMemory::Range>{{bytes + 10, 2 * kPage}});
  auto second = std::make_unique<LockedMemory>(
      std::vector<LockedMemory::Range>{{bytes + 2 * kPage + 20, kPage}});
  EXPECT_EQ(lockedKb() - before, static_cast<long>(kBytes / 1024));
  whole.reset();
  EXPECT_EQ(lockedKb() - before, 4 * pageKb);
  first.reset();
  EXPECT_EQ(lockedKb() - before, 2 * pageKb);
  second.reset();
  EXPECT_EQ(lockedKb(), before);
}

// In a process of a user who may not lock memory.
TEST(LockedMemory, BringsInWhatItMayNotLock)
{
  const MappedFile file;
  file.pageOut();
  const pid_t child = fork();
  ASSERT_GE(child, 0);
  if (child == 0)
  {
    const rlimit none{0, 0};
    const bool limited =
        setrlimit(RLIMIT_MEMLOCK, &none) == 0 && (geteuid() != 0 || setuid(65534) == 0);
    const LockedMemory locked({file.range()});
    _exit(!limited ? 77 : locked.locked() ? 1 : file.faultsOfReading() != 0 ? 2 : 0);
  }
  int status = 0;
  ASSERT_EQ(waitpid(child, &status, 0), child);
  ASSERT_TRUE(WIFEXITED(status));
  if (WEXITSTATUS(status) == 77)
    GTEST_SKIP() << "this user's limit cannot be lowered";
  EXPECT_EQ(WEXITSTATUS(status), 0) << "1: it was locked, 2: it was not brought in";
}
