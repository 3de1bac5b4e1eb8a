#include "petrous/Core/FileLock.h"

#include <cerrno>

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include "petrous/Core/OutputFile.h"

namespace petrous::core
{

FileLock::FileLock(const std::filesystem::path& file, IfHeld ifHeld)
  : m_descriptor(::open(file.c_str(), O_RDWR | O_CREAT | O_CLOEXEC | O_NOFOLLOW | O_NONBLOCK, 0666))
{
  if (m_descriptor < 0)
    throwOutputError(errno, file);
  while (::flock(m_descriptor, ifHeld == IfHeld::Wait ? LOCK_EX : LOCK_EX | LOCK_NB) != 0)
    if (const int error = errno; error != EINTR)
    {
      ::close(m_descriptor);
      if (error == EWOULDBLOCK)
        throw OutputFileError(OutputFileError::Reason::NotPermitted, file,
                              "is in use by another program; wait until it has ended");
      if (error == ENOLCK || error == ENOSYS || error == EOPNOTSUPP || error == EINVAL)
        throw OutputFileError(OutputFileError::Reason::WrongPlace, file,
                              "cannot be locked: this drive has no file locks, as some network "
                              "drives; choose a folder on a local disk");
      throwOutputError(error, file);
    }
}

FileLock::~FileLock()
{
  ::close(m_descriptor);
}

} // namespace petrous::core
