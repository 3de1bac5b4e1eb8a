#include "StagedFolder.h"

#include <cerrno>
#include <string>
#include <system_error>
#include <vector>

#include <fcntl.h>
#include <unistd.h>

#include "petrous/Core/OutputFile.h"

namespace petrous::phantom
{
namespace
{

namespace fs = std::filesystem;

[[noreturn]] void cannotWrite(const fs::path& path, const std::error_code& fault)
{
  throw core::Error(core::Fault::Refused,
                    path.string() + ": cannot be written: " + fault.message());
}

// Files must be synced before the rename.
void syncFiles(const fs::path& folder, std::error_code& fault)
{
  for (fs::recursive_directory_iterator entry(folder, fault), end; !fault && entry != end;
       entry.increment(fault))
  {
    if (entry->is_directory())
      core::syncFolder(entry->path());
    const int file = ::open(entry->path().c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC);
    if (file < 0 || (::fsync(file) != 0 && errno != EINVAL))
      fault = {errno, std::generic_category()};
    if (file >= 0)
      ::close(file);
    if (fault)
      return;
  }
  core::syncFolder(folder);
}

} // namespace

StagedFolder::StagedFolder(const fs::path& target)
{
  std::error_code fault;
  m_target = fs::absolute(target, fault).lexically_normal();
  if (!m_target.has_filename()) // "folder/"
    m_target = m_target.parent_path();
  const fs::file_status status = fs::status(m_target, fault);
  if (status.type() == fs::file_type::none)
    cannotWrite(m_target, fault);
  if (fs::exists(status))
  {
    if (!fs::is_directory(status))
      throw core::Error(core::Fault::Refused,
                        m_target.string() + ": is a file; name a new or an empty folder");
    const bool empty = fs::is_empty(m_target, fault);
    if (fault)
      cannotWrite(m_target, fault);
    if (!empty)
      throw core::Error(core::Fault::Refused,
                        m_target.string() + ": not empty; name a new or an empty folder");
    m_inside = true;
    m_staging = core::temporaryBeside(m_target / "part");
    m_made = m_staging;
  }
  else
  {
    m_staging = core::temporaryBeside(m_target);
    m_made = m_staging;
    for (fs::path up = m_staging.parent_path(); !up.empty() && !fs::exists(up, fault);
         up = up.parent_path())
      m_made = up;
  }
  fs::create_directories(m_staging, fault);
  if (fault)
  {
    std::error_code ignored;
    fs::remove_all(m_made, ignored);
    cannotWrite(m_target, fault);
  }
}

StagedFolder::~StagedFolder()
{
  std::error_code ignored;
  if (!m_done)
    fs::remove_all(m_made, ignored);
}

void StagedFolder::commit()
{
  std::error_code fault;
  syncFiles(m_staging, fault);
  if (fault)
    cannotWrite(m_target, fault);
  if (m_inside)
  {
    std::vector<fs::path> parts;
    for (const fs::directory_entry& entry : fs::directory_iterator(m_staging, fault))
      parts.push_back(entry.path());
    for (const fs::path& part : parts)
      if (!fault)
        fs::rename(part, m_target / part.filename(), fault);
    if (!fault)
      fs::remove(m_staging, fault);
  }
  else
    fs::rename(m_staging, m_target, fault);
  if (fault)
    cannotWrite(m_target, fault);
  m_done = true;
  core::syncFolder(m_inside ? m_target : m_target.parent_path());
}

} // namespace petrous::phantom
