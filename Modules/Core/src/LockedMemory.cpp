#include "petrous/Core/LockedMemory.h"

#include <cstdint>

#include <sys/mman.h>
#include <sys/resource.h>
#include <unistd.h>

namespace petrous::core
{

LockedMemory::LockedMemory(std::vector<Range> ranges)
{
  const auto page = static_cast<std::size_t>(sysconf(_SC_PAGESIZE));
  m_locked.reserve(ranges.size());
  for (const Range& range : ranges)
  {
    if (!range.start || range.bytes == 0)
      continue;
    ++m_count;
    m_bytes += range.bytes;
    if (mlock(range.start, range.bytes) == 0)
    {
      m_locked.push_back(range);
      continue;
    }
    const auto* bytes = static_cast<const volatile unsigned char*>(range.start);
    for (std::size_t at = 0; at < range.bytes; at += page)
      static_cast<void>(bytes[at]);
    static_cast<void>(bytes[range.bytes - 1]);
  }
}

LockedMemory::~LockedMemory()
{
  for (const Range& range : m_locked)
    munlock(range.start, range.bytes);
}

long majorPageFaults() noexcept
{
  rusage usage{};
  return getrusage(RUSAGE_THREAD, &usage) == 0 ? usage.ru_majflt : 0;
}

} // namespace petrous::core
