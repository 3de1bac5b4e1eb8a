#pragma once

#include <cstddef>
#include <vector>

namespace petrous::core
{

/// Prefaults memory that a real-time thread reads and locks it against paging (mlock) for the
/// lifetime of this object: a page fault on a mapped file is disk I/O inside a tick.
///
/// A page covered by several instances is unlocked with the last of them. All pages are faulted in;
/// if RLIMIT_MEMLOCK does not permit locking, they may be paged out again.
class LockedMemory
{
public:
  struct Range
  {
    const void* start = nullptr;
    std::size_t bytes = 0;
  };

  /// Reads every page. The ranges must stay mapped for the lifetime of this object.
  explicit LockedMemory(std::vector<Range> ranges);
  LockedMemory(const LockedMemory&) = delete;
  LockedMemory& operator=(const LockedMemory&) = delete;
  ~LockedMemory();

  std::size_t bytes() const noexcept { return m_bytes; }              ///< total of all ranges
  bool locked() const noexcept { return m_locked.size() == m_count; } ///< all ranges

private:
  std::vector<Range> m_locked;
  std::size_t m_count = 0; // number of non-empty ranges
  std::size_t m_bytes = 0;
};

/// Major page faults of the calling thread since it started.
long majorPageFaults() noexcept;

} // namespace petrous::core
