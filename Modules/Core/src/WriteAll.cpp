#include "petrous/Core/WriteAll.h"

#include <algorithm>
#include <cerrno>

#include <unistd.h>

namespace petrous::core
{

int writeAll(int descriptor, const void* bytes, std::size_t count) noexcept
{
  constexpr std::size_t kAtOnce = std::size_t{1} << 30; // Linux takes less than 2 GiB
  const auto* next = static_cast<const char*>(bytes);
  while (count > 0)
  {
    const ssize_t written = ::write(descriptor, next, std::min(count, kAtOnce));
    if (written < 0 && errno == EINTR)
      continue;
    if (written <= 0)
      return written < 0 ? errno : ENOSPC;
    next += written;
    count -= static_cast<std::size_t>(written);
  }
  return 0;
}

} // namespace petrous::core
