#include "SystemCalls.h"

#include <atomic>
#include <cerrno>
#include <csignal>
#include <cstdarg>
#include <cstddef>
#include <cstring>

#include <dlfcn.h>
#include <fcntl.h>
#include <sys/file.h>
#include <sys/types.h>
#include <unistd.h>

namespace
{

char failingName[32]; // initialized before any constructor, some of which call `fail`
int failingCall = 0;
int failingError = 0;
int killingCall = 0;
std::atomic<int> calls{0};
std::atomic<int> callsOfName{0};

// Whether the call is to fail; sets errno.
bool refused(const char* name)
{
  const int n = ++calls;
  if (killingCall > 0 && n == killingCall)
    ::kill(::getpid(), SIGKILL);
  if (failingCall == 0 || std::strcmp(failingName, name) != 0 || ++callsOfName != failingCall)
    return false;
  errno = failingError;
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

void SystemCalls::fail(const std::string& name, int n, int error)
{
  reset();
  std::strncpy(failingName, name.c_str(), sizeof failingName - 1);
  failingError = error;
  failingCall = n;
}

void SystemCalls::killAt(int n)
{
  reset();
  killingCall = n;
}

int SystemCalls::count()
{
  return calls;
}

int SystemCalls::countOfName()
{
  return callsOfName;
}

void SystemCalls::reset()
{
  failingCall = killingCall = 0;
  calls = callsOfName = 0;
}

} // namespace petrous::testing

extern "C"
{
  int open(const char* path, int flags, ...)
  {
    static const auto real = original<int (*)(const char*, int, ...)>("open");
    va_list rest;
    va_start(rest, flags);
    const mode_t mode = (flags & O_CREAT) != 0 ? va_arg(rest, mode_t) : 0;
    va_end(rest);
    if ((flags & (O_CREAT | O_DIRECTORY)) != 0 && refused("open"))
      return -1;
    return real(path, flags, mode);
  }
  ssize_t write(int file, const void* bytes, std::size_t count)
  {
    static const auto real = original<ssize_t (*)(int, const void*, std::size_t)>("write");
    return refused("write") ? -1 : real(file, bytes, count);
  }
  int fsync(int file)
  {
    static const auto real = original<int (*)(int)>("fsync");
    return refused("fsync") ? -1 : real(file);
  }
  int fdatasync(int file)
  {
    static const auto real = original<int (*)(int)>("fdatasync");
    return refused("fdatasync") ? -1 : real(file);
  }
  int rename(const char* from, const char* to) noexcept
  {
    static const auto real = original<int (*)(const char*, const char*)>("rename");
    return refused("rename") ? -1 : real(from, to);
  }
  int renameat2(int fromFolder, const char* from, int toFolder, const char* to,
                unsigned int flags) noexcept
  {
    static const auto real =
        original<int (*)(int, const char*, int, const char*, unsigned int)>("renameat2");
    return refused("rename") ? -1 : real(fromFolder, from, toFolder, to, flags);
  }
  int unlink(const char* path) noexcept
  {
    static const auto real = original<int (*)(const char*)>("unlink");
    return refused("unlink") ? -1 : real(path);
  }
  int flock(int file, int operation) noexcept
  {
    static const auto real = original<int (*)(int, int)>("flock");
    return refused("flock") ? -1 : real(file, operation);
  }
  int ftruncate(int file, off_t length) noexcept
  {
    static const auto real = original<int (*)(int, off_t)>("ftruncate");
    return refused("ftruncate") ? -1 : real(file, length);
  }
}
