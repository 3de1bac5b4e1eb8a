#include "MemoryCheck.h"

#include "FileHelpers.h"
#include "petrous/Core/SystemMemory.h"

namespace petrous::imaging
{

void requireMemory(const std::filesystem::path& path, std::uint64_t bytes,
                   const std::string& advice, std::uint64_t free)
{
  constexpr std::uint64_t kLarge = std::uint64_t{256}
                                   << 20; // below, asking costs more than it saves
  if (free == 0 && bytes > kLarge)
    free = core::systemMemory().available;
  if (free == 0 || bytes <= free)
    return;
  fail(FileError::Reason::Unreadable, path,
       "needs " + roughText(static_cast<double>(bytes) / 1e9) +
           " GB of memory, which is not free; close programs or " + advice,
       core::Fault::Refused);
}

} // namespace petrous::imaging
