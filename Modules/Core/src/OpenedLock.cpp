#include "petrous/Core/OpenedLock.h"

#include <cerrno>
#include <thread>

#include <sys/file.h>
#include <sys/stat.h>

namespace petrous::core
{

LockState lockOpened(int descriptor, std::chrono::milliseconds patience) noexcept
{
  constexpr std::chrono::milliseconds kPause{2};
  const int operation = patience == kWaitForLock ? LOCK_EX : LOCK_EX | LOCK_NB;
  const auto begun = std::chrono::steady_clock::now();
  while (::flock(descriptor, operation) != 0)
  {
    if (errno == EINTR)
      continue;
    if (errno != EWOULDBLOCK)
      return LockState::NoLocks;
    if (std::chrono::steady_clock::now() - begun >= patience)
      return LockState::Anothers;
    std::this_thread::sleep_for(kPause);
  }
  return LockState::Ours;
}

bool isOpenedAt(int descriptor, const std::filesystem::path& path) noexcept
{
  struct stat opened = {}, found = {};
  return ::fstat(descriptor, &opened) == 0 && ::lstat(path.c_str(), &found) == 0 &&
         opened.st_ino == found.st_ino && opened.st_dev == found.st_dev;
}

} // namespace petrous::core
