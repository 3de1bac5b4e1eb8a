#include "ReadFaults.h"

#include <atomic>
#include <cerrno>
#include <climits>
#include <cstdio>
#include <cstring>

#include <dlfcn.h>
#include <sys/types.h>
#include <unistd.h>

namespace
{

char folderName[PATH_MAX];
std::atomic<bool> isArmed{false};
std::atomic<bool> isEnd{false};
std::atomic<int> left{0};
std::atomic<int> failed{0};

bool isBelowFolder(int descriptor)
{
  char link[64];
  char path[PATH_MAX];
  std::snprintf(link, sizeof link, "/proc/self/fd/%d", descriptor);
  const ssize_t length = ::readlink(link, path, sizeof path - 1);
  const std::size_t folder = std::strlen(folderName);
  return length > static_cast<ssize_t>(folder) && std::strncmp(path, folderName, folder) == 0 &&
         path[folder] == '/';
}

bool refused(int descriptor)
{
  if (!isArmed || !isBelowFolder(descriptor) || --left > 0)
    return false;
  ++failed;
  errno = EIO;
  return true;
}

template <class Function>
Function original(const char* name)
{
  return reinterpret_cast<Function>(::dlsym(RTLD_NEXT, name));
}

} // namespace

namespace petrous::testing
{

void ReadFaults::pullOut(const std::filesystem::path& folder, int n, Kind kind)
{
  reset();
  std::strncpy(folderName, std::filesystem::canonical(folder).c_str(), sizeof folderName - 1);
  left = n;
  isEnd = kind == Kind::End;
  isArmed = true;
}

int ReadFaults::failures()
{
  return failed;
}

void ReadFaults::reset()
{
  isArmed = false;
  failed = 0;
}

} // namespace petrous::testing

extern "C"
{
  ssize_t pread(int descriptor, void* bytes, size_t count, off_t offset)
  {
    static const auto real = original<ssize_t (*)(int, void*, size_t, off_t)>("pread");
    return refused(descriptor) ? (isEnd ? 0 : -1) : real(descriptor, bytes, count, offset);
  }

  ssize_t read(int descriptor, void* bytes, size_t count)
  {
    static const auto real = original<ssize_t (*)(int, void*, size_t)>("read");
    return refused(descriptor) ? (isEnd ? 0 : -1) : real(descriptor, bytes, count);
  }
}
