#include "DurableFile.h"

#include <cerrno>
#include <cstdio>
#include <random>

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include "petrous/Library/LibraryError.h"

namespace petrous::library
{

namespace fs = std::filesystem;

namespace
{

class Descriptor
{
public:
  Descriptor(const fs::path& path, int flags)
    : m_fd(::open(path.c_str(), flags | O_CLOEXEC, 0644))
  {
    if (m_fd < 0)
      throwForErrno(errno, path);
  }
  ~Descriptor() { ::close(m_fd); }
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  int get() const { return m_fd; }

private:
  int m_fd;
};

} // namespace

void syncFolder(const fs::path& folder)
{
  const Descriptor d(folder.empty() ? fs::path(".") : folder, O_RDONLY | O_DIRECTORY);
  ::fsync(d.get()); // some file systems cannot; the rename itself is atomic either way
}

void throwForErrno(int error, const fs::path& path)
{
  using Reason = LibraryError::Reason;
  const std::string name = path.string();
  switch (error)
  {
  case ENOSPC:
  case EDQUOT:
  case EFBIG: // a limit of this process
    throw LibraryError(Reason::DiskFull, name + ": the disk is full; nothing was changed, free "
                                                "some space and try again");
  case EACCES:
  case EPERM:
  case EROFS:
    throw LibraryError(Reason::Unwritable, name + ": no permission to write there; nothing was "
                                                  "changed, choose a library folder of your own");
  case ENOTDIR:
  case EEXIST:
    throw LibraryError(Reason::Unwritable, name + ": a file stands where the library needs a "
                                                  "folder; choose another library folder");
  case ENOENT:
    throw LibraryError(Reason::NotFound, name + ": not there");
  default:
    throw LibraryError(Reason::Unwritable, name + ": cannot be written (system error " +
                                               std::to_string(error) + "); nothing was changed");
  }
}

fs::path temporaryBeside(const fs::path& path)
{
  std::random_device random;
  char suffix[32];
  std::snprintf(suffix, sizeof suffix, ".tmp-%08x%08x-", random(), random());
  return path.parent_path() / (suffix + path.filename().string());
}

void writeDurably(const fs::path& path, std::string_view bytes)
{
  const Descriptor file(path, O_WRONLY | O_CREAT | O_EXCL);
  try
  {
    while (!bytes.empty())
    {
      const ssize_t written = ::write(file.get(), bytes.data(), bytes.size());
      if (written < 0 && errno == EINTR)
        continue;
      if (written < 0)
        throwForErrno(errno, path);
      bytes.remove_prefix(static_cast<std::size_t>(written));
    }
    if (::fsync(file.get()) != 0)
      throwForErrno(errno, path);
  }
  catch (...)
  {
    ::unlink(path.c_str());
    throw;
  }
}

void renameDurably(const fs::path& from, const fs::path& to)
{
  if (::rename(from.c_str(), to.c_str()) != 0)
    throwForErrno(errno, to);
  syncFolder(to.parent_path());
}

void replaceDurably(const fs::path& path, std::string_view bytes)
{
  const fs::path temporary = temporaryBeside(path);
  writeDurably(temporary, bytes);
  try
  {
    renameDurably(temporary, path);
  }
  catch (...)
  {
    ::unlink(temporary.c_str());
    throw;
  }
}

void makeFolder(const fs::path& path)
{
  std::error_code error;
  fs::create_directories(path, error);
  if (error)
    throwForErrno(error.value(), path);
}

FolderLock::FolderLock(const fs::path& file)
  : m_descriptor(::open(file.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0644))
{
  if (m_descriptor < 0)
    throwForErrno(errno, file);
  while (::flock(m_descriptor, LOCK_EX) != 0)
    if (errno != EINTR)
    {
      ::close(m_descriptor);
      throwForErrno(errno, file);
    }
}

FolderLock::~FolderLock()
{
  ::close(m_descriptor);
}

} // namespace petrous::library
