#pragma once

#include <cstddef>
#include <vector>

namespace petrous::core
{

/// Memory that a real-time thread reads, brought in and kept from being paged out (mlock) as long
/// as this lives: a page fault on a mapped file is disk I/O inside a tick.
///
/// Of several that cover the same page, the last to end unlocks it. All pages are brought in; where
/// the system's limit (RLIMIT_MEMLOCK) allows no lock they may be paged out again.
class LockedMemory
{
public:
  struct Range
  {
    const void* start = nullptr;
    std::size_t bytes = 0;
  };

  /// Reads every page. The ranges must stay mapped as long as this lives.
  explicit LockedMemory(std::vector<Range> ranges);
  LockedMemory(const LockedMemory&) = delete;
  LockedMemory& operator=(const LockedMemory&) = delete;
  ~LockedMemory();

  std::size_t bytes() const noexcept { return m_bytes; }              ///< of all ranges
  bool locked() const noexcept { return m_locked.size() == m_count; } ///< all of them

private:
  std::vector<Range> m_locked;
  std::size_t m_count = 0; // of ranges that hold anything
  std::size_t m_bytes = 0;
};

/// Page faults of the calling thread that needed I/O, since it began.
long majorPageFaults() noexcept;

} // namespace petrous::core
