#include "petrous/Core/LockedMemory.h"

#include <cstdint>
#include <map>
#include <mutex>
#include <utility>

#include <sys/mman.h>
#include <sys/resource.h>
#include <unistd.h>

namespace petrous::core
{

namespace
{

// mlock does not nest and works on whole pages, so locks are counted per page. Runs of pages with
// equal lock count, keyed by their first page; a run ends where the next begins.
class PageLocks
{
public:
  static PageLocks& ofProcess()
  {
    static PageLocks locks;
    return locks;
  }

  /// Returns false, and locks nothing, if the system does not permit it.
  bool lock(std::uintptr_t from, std::uintptr_t to)
  {
    const std::lock_guard<std::mutex> guard(m_mutex);
    const auto first = split(from);
    const auto last = split(to);
    if (mlock(reinterpret_cast<const void*>(from), to - from) != 0)
    {
      // Undo a partial lock of pages that nobody else has locked.
      unlockFree(first, last);
      join();
      return false;
    }
    for (auto run = first; run != last; ++run)
      ++run->second;
    return true;
  }

  void unlock(std::uintptr_t from, std::uintptr_t to)
  {
    const std::lock_guard<std::mutex> guard(m_mutex);
    const auto first = split(from);
    const auto last = split(to);
    for (auto run = first; run != last; ++run)
      --run->second;
    unlockFree(first, last);
    join();
  }

private:
  using Runs = std::map<std::uintptr_t, std::size_t>;

  Runs::iterator split(std::uintptr_t at)
  {
    const auto after = m_runs.upper_bound(at);
    const std::size_t count = after == m_runs.begin() ? 0 : std::prev(after)->second;
    return m_runs.emplace(at, count).first;
  }

  void unlockFree(Runs::iterator first, Runs::iterator last)
  {
    for (auto run = first; run != last; ++run)
      if (run->second == 0)
        munlock(reinterpret_cast<const void*>(run->first), std::next(run)->first - run->first);
  }

  void join()
  {
    std::size_t count = 0;
    for (auto run = m_runs.begin(); run != m_runs.end();)
    {
      const bool same = run->second == count;
      count = run->second;
      run = same ? m_runs.erase(run) : std::next(run);
    }
  }

  std::mutex m_mutex;
  Runs m_runs;
};

std::size_t pageBytes() noexcept
{
  return static_cast<std::size_t>(sysconf(_SC_PAGESIZE));
}

// The pages that overlap a range.
std::pair<std::uintptr_t, std::uintptr_t> pagesOf(const LockedMemory::Range& range) noexcept
{
  const std::size_t page = pageBytes();
  const auto start = reinterpret_cast<std::uintptr_t>(range.start);
  return {start / page * page, (start + range.bytes + page - 1) / page * page};
}

} // namespace

LockedMemory::LockedMemory(std::vector<Range> ranges)
{
  const std::size_t page = pageBytes();
  m_locked.reserve(ranges.size());
  for (const Range& range : ranges)
  {
    if (!range.start || range.bytes == 0)
      continue;
    ++m_count;
    m_bytes += range.bytes;
    const auto [from, to] = pagesOf(range);
    if (PageLocks::ofProcess().lock(from, to))
      m_locked.push_back(range);
    // Also if locked: the system may map a page only at its first access.
    const auto* bytes = static_cast<const volatile unsigned char*>(range.start);
    for (std::size_t at = 0; at < range.bytes; at += page)
      static_cast<void>(bytes[at]);
    static_cast<void>(bytes[range.bytes - 1]);
  }
}

LockedMemory::~LockedMemory()
{
  for (const Range& range : m_locked)
  {
    const auto [from, to] = pagesOf(range);
    PageLocks::ofProcess().unlock(from, to);
  }
}

long majorPageFaults() noexcept
{
  rusage usage{};
  return getrusage(RUSAGE_THREAD, &usage) == 0 ? usage.ru_majflt : 0;
}

} // namespace petrous::core
