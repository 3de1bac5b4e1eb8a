#include "petrous/Library/OwnerLock.h"

#include <system_error>
#include <vector>

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include "petrous/Core/OpenedLock.h"

namespace petrous::library
{

namespace fs = std::filesystem;

OwnerLock::OwnerLock(const fs::path& folder)
  : m_descriptor(::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_NOFOLLOW | O_CLOEXEC))
{
  if (m_descriptor < 0)
    return;
  core::lockOpened(m_descriptor);
  m_isThere = core::isOpenedAt(m_descriptor, folder);
}

OwnerLock::~OwnerLock()
{
  if (m_descriptor >= 0)
    ::close(m_descriptor);
}

void removeAbandoned(const fs::path& folder, const std::function<bool(const fs::path&)>& isOwn)
{
  std::vector<fs::path> found;
  std::error_code error;
  for (fs::directory_iterator entry(folder, error), end; !error && entry != end;
       entry.increment(error))
    if (isOwn(entry->path()))
      found.push_back(entry->path());
  for (const fs::path& path : found)
  {
    const int descriptor = ::open(path.c_str(), O_RDONLY | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC);
    if (descriptor < 0)
      continue;
    struct stat status = {};
    if (::fstat(descriptor, &status) == 0 && status.st_uid == ::geteuid() &&
        core::lockOpened(descriptor) == core::LockState::Ours && core::isOpenedAt(descriptor, path))
      fs::remove_all(path, error);
    ::close(descriptor);
  }
}

} // namespace petrous::library
