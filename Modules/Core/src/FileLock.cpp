#include "petrous/Core/FileLock.h"

#include <cerrno>
#include <chrono>
#include <thread>

#include <fcntl.h>
#include <unistd.h>

#include "petrous/Core/OpenedLock.h"
#include "petrous/Core/OutputFile.h"

namespace petrous::core
{

namespace
{

int opened(const std::filesystem::path& file)
{
  const int descriptor =
      ::open(file.c_str(), O_RDWR | O_CREAT | O_CLOEXEC | O_NOFOLLOW | O_NONBLOCK, 0666);
  if (descriptor < 0)
    throwOutputError(errno, file);
  return descriptor;
}

// False if another holds it. Closes it before it throws.
bool take(int descriptor, const std::filesystem::path& file,
          std::chrono::milliseconds patience = {})
{
  const LockState state = lockOpened(descriptor, patience);
  if (state != LockState::NoLocks)
    return state == LockState::Ours;
  const int error = errno;
  ::close(descriptor);
  if (error == ENOLCK || error == ENOSYS || error == EOPNOTSUPP || error == EINVAL)
    throw OutputFileError(OutputFileError::Reason::WrongPlace, file,
                          "cannot be locked: this drive has no file locks, as some network "
                          "drives; choose a folder on a local disk");
  throwOutputError(error, file);
}

} // namespace

FileLock::FileLock(const std::filesystem::path& file, IfHeld ifHeld)
  : m_descriptor(opened(file))
{
  if (!take(m_descriptor, file,
            ifHeld == IfHeld::Wait ? kWaitForLock : std::chrono::milliseconds{}))
  {
    ::close(m_descriptor);
    throw OutputFileError(OutputFileError::Reason::NotPermitted, file,
                          "is in use by another program; wait until it has ended");
  }
}

FileLock::FileLock(const std::filesystem::path& file, const std::function<void(double)>& waiting)
  : m_descriptor(opened(file))
{
  constexpr std::chrono::milliseconds kEvery(100);
  const auto begun = std::chrono::steady_clock::now();
  while (!take(m_descriptor, file))
    try
    {
      waiting(std::chrono::duration<double>(std::chrono::steady_clock::now() - begun).count());
      std::this_thread::sleep_for(kEvery);
    }
    catch (...)
    {
      ::close(m_descriptor);
      throw;
    }
}

FileLock::~FileLock()
{
  ::close(m_descriptor);
}

} // namespace petrous::core
