#include "petrous/Core/OutputFile.h"

#include <cerrno>
#include <cstdio>
#include <random>
#include <system_error>
#include <vector>

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include "petrous/Core/InputFile.h"
#include "petrous/Core/OpenedLock.h"
#include "petrous/Core/WriteAll.h"

namespace petrous::core
{

namespace fs = std::filesystem;

namespace
{

using Reason = OutputFileError::Reason;

constexpr const char* kLeftover = ".petrous-";
constexpr int kAttempts = 100;

fs::path folderOf(const fs::path& path)
{
  return path.has_parent_path() ? path.parent_path() : fs::path(".");
}

// As ::rename, but for an error (EEXIST) where something has the new name.
int renameUnlessThere(const fs::path& from, const fs::path& to) noexcept
{
  const int result = ::renameat2(AT_FDCWD, from.c_str(), AT_FDCWD, to.c_str(), RENAME_NOREPLACE);
  if (result == 0 || (errno != EINVAL && errno != ENOSYS))
    return result;
  // This file system knows no such renaming.
  struct stat status = {};
  if (::lstat(to.c_str(), &status) == 0)
  {
    errno = EEXIST;
    return -1;
  }
  return ::rename(from.c_str(), to.c_str());
}

bool synced(int folder) noexcept
{
  return ::fsync(folder) == 0 || errno == EINVAL || errno == ENOTSUP || errno == ENOSYS;
}

} // namespace

OutputFileError::OutputFileError(Reason why, const fs::path& path, const std::string& what)
  : Error(Fault::Refused, printable(path) + ": " + what)
  , reason(why)
  , problem(what)
{
}

void throwOutputError(int error, const fs::path& path)
{
  switch (error)
  {
  case ENOSPC:
  case EDQUOT:
    throw OutputFileError(Reason::DiskFull, path,
                          "cannot be written, the disk is full; free some space and try again");
  case EFBIG: // also a limit of this process
    throw OutputFileError(Reason::DiskFull, path,
                          "cannot be written, the disk is full or the file too large for it; "
                          "choose another disk");
  case EACCES:
  case EPERM:
    throw OutputFileError(Reason::NotPermitted, path,
                          "cannot be written, no permission; choose another folder or allow "
                          "writing to this one");
  case EROFS:
    throw OutputFileError(Reason::NotPermitted, path,
                          "cannot be written, the medium is read-only; choose another folder");
  case ENOENT:
    throw OutputFileError(Reason::WrongPlace, path,
                          "cannot be written, its folder is not there; make the folder first");
  case EEXIST:
    throw OutputFileError(Reason::WrongPlace, path,
                          "cannot be written, something of one of its names appeared there "
                          "meanwhile; name another folder");
  case ENOTDIR:
    throw OutputFileError(Reason::WrongPlace, path,
                          "cannot be written, a file stands where its folder should be");
  case EISDIR:
    throw OutputFileError(Reason::WrongPlace, path, "is a folder; name a file in it");
  case ENOSYS:
  case EOPNOTSUPP:
    throw OutputFileError(
        Reason::WrongPlace, path,
        "cannot be written: this drive cannot replace a file in one step, as some "
        "network drives; choose a folder on a local disk");
  case ENAMETOOLONG:
    throw OutputFileError(Reason::WrongPlace, path,
                          "cannot be written, the name is too long; shorten it");
  default:
    throw OutputFileError(Reason::Failed, path,
                          "cannot be written (system error " + std::to_string(error) +
                              "); check the disk");
  }
}

fs::path temporaryBeside(const fs::path& path)
{
  std::random_device random;
  char name[32];
  std::snprintf(name, sizeof name, "%s%08x%08x", kLeftover, random(), random());
  return folderOf(path) / name;
}

bool isLeftover(const fs::path& path)
{
  return path.filename().string().rfind(kLeftover, 0) == 0;
}

bool syncFolder(const fs::path& folder) noexcept
{
  const int descriptor =
      ::open(folder.empty() ? "." : folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (descriptor < 0)
    return false;
  const bool done = synced(descriptor);
  ::close(descriptor);
  return done;
}

fs::path outputTarget(const fs::path& path)
{
  struct stat status = {};
  if (::stat(path.c_str(), &status) != 0)
    return path;
  if (S_ISDIR(status.st_mode))
    throw OutputFileError(Reason::WrongPlace, path, "is a folder; name a file in it");
  if (!S_ISREG(status.st_mode))
    throw OutputFileError(Reason::WrongPlace, path,
                          "is a device, pipe or socket; name a regular file");
  std::error_code error;
  if (!fs::is_symlink(path, error))
    return path;
  const fs::path target = fs::canonical(path, error);
  return error ? path : target;
}

OutputFile::OutputFile(const fs::path& path)
  : m_path(outputTarget(path))
{
  m_folder = ::open(folderOf(m_path).c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (m_folder < 0)
    throwOutputError(errno, path);
  for (int n = 0; m_descriptor < 0; ++n)
  {
    m_temporary = temporaryBeside(m_path);
    m_descriptor = ::open(m_temporary.c_str(), O_RDWR | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
    if (m_descriptor >= 0)
    {
      // Tells it from what a killed process left, which others may remove.
      struct stat status = {};
      lockOpened(m_descriptor);
      if (n < kAttempts && ::fstat(m_descriptor, &status) == 0 && status.st_nlink == 0)
      {
        ::close(m_descriptor);
        m_descriptor = -1;
      }
      continue;
    }
    if (errno == EEXIST && n < kAttempts)
      continue;
    const int error = errno;
    ::close(m_folder);
    throwOutputError(error, path);
  }
}

OutputFile::~OutputFile()
{
  if (m_descriptor >= 0)
  {
    ::unlink(m_temporary.c_str());
    ::close(m_descriptor);
  }
  ::close(m_folder);
}

void OutputFile::write(const void* bytes, std::size_t count)
{
  if (const int error = writeAll(m_descriptor, bytes, count))
    throwOutputError(error, m_path);
}

void OutputFile::startSync() noexcept
{
  ::sync_file_range(m_descriptor, 0, 0, SYNC_FILE_RANGE_WRITE); // whether it can or not
}

bool OutputFile::commit()
{
  if (::fsync(m_descriptor) != 0 && errno != EINVAL)
    throwOutputError(errno, m_path);
  if (::rename(m_temporary.c_str(), m_path.c_str()) != 0)
    throwOutputError(errno, m_path);
  ::close(m_descriptor);
  m_descriptor = -1;
  return synced(m_folder);
}

namespace
{

// Of all files and folders below, before a rename publishes them.
void syncTree(const fs::path& folder, const fs::path& target)
{
  std::vector<fs::path> all{folder};
  std::error_code fault;
  for (fs::recursive_directory_iterator entry(folder, fault), end; !fault && entry != end;
       entry.increment(fault))
    all.push_back(entry->path());
  if (fault)
    throwOutputError(fault.value(), target);
  for (const fs::path& path : all)
  {
    const int descriptor = ::open(path.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC);
    if (descriptor < 0)
      throwOutputError(errno, target);
    const bool done = synced(descriptor);
    const int error = errno;
    ::close(descriptor);
    if (!done)
      throwOutputError(error, target);
  }
}

} // namespace

OutputFolder::OutputFolder(const fs::path& target)
{
  std::error_code fault;
  m_target = fs::absolute(target, fault).lexically_normal();
  if (!m_target.has_filename()) // "folder/"
    m_target = m_target.parent_path();
  const fs::file_status status = fs::status(m_target, fault);
  if (status.type() == fs::file_type::none)
    throwOutputError(fault.value(), m_target);
  if (fs::exists(status))
  {
    if (!fs::is_directory(status))
      throw OutputFileError(Reason::WrongPlace, m_target,
                            "is a file; name a new or an empty folder");
    const bool empty = fs::is_empty(m_target, fault);
    if (fault)
      throwOutputError(fault.value(), m_target);
    if (!empty)
      throw OutputFileError(Reason::WrongPlace, m_target,
                            "not empty; name a new or an empty folder");
    m_inside = true;
    m_staging = temporaryBeside(m_target / "part");
    m_made = m_staging;
  }
  else
  {
    m_staging = temporaryBeside(m_target);
    m_made = m_staging;
    for (fs::path up = m_staging.parent_path(); !up.empty() && !fs::exists(up, fault);
         up = up.parent_path())
      m_made = up;
  }
  fs::create_directories(m_staging, fault);
  if (!fault)
    return;
  const int error = fault.value();
  fs::remove_all(m_made, fault);
  throwOutputError(error, m_target);
}

OutputFolder::~OutputFolder()
{
  std::error_code ignored;
  if (!m_done)
    fs::remove_all(m_made, ignored);
}

bool OutputFolder::commit()
{
  syncTree(m_staging, m_target);
  if (!m_inside)
  {
    if (::rename(m_staging.c_str(), m_target.c_str()) != 0)
      throwOutputError(errno, m_target);
    m_done = true;
    bool onDisk = syncFolder(m_target.parent_path());
    for (fs::path up = m_target.parent_path(); m_made != m_staging && up != m_made.parent_path();
         up = up.parent_path())
      onDisk = syncFolder(up.parent_path()) && onDisk;
    return onDisk;
  }
  std::vector<fs::path> parts; // listed before any is moved
  std::error_code fault;
  for (fs::directory_iterator entry(m_staging, fault), end; !fault && entry != end;
       entry.increment(fault))
    parts.push_back(entry->path().filename());
  if (fault)
    throwOutputError(fault.value(), m_target);
  for (std::size_t n = 0; n < parts.size(); ++n)
    if (renameUnlessThere(m_staging / parts[n], m_target / parts[n]) != 0)
    {
      const int error = errno;
      while (n-- > 0)
        ::rename((m_target / parts[n]).c_str(), (m_staging / parts[n]).c_str());
      throwOutputError(error, m_target);
    }
  m_done = true;
  fs::remove(m_staging, fault); // empty; recognised as a leftover if it stays
  return syncFolder(m_target);
}

bool writeFile(const fs::path& path, std::string_view bytes)
{
  OutputFile file(path);
  file.write(bytes);
  return file.commit();
}

} // namespace petrous::core
