#pragma once

#include <filesystem>
#include <memory>

#include "petrous/Library/OwnerLock.h"

namespace petrous::library
{

/// A folder for files on their way that may identify a patient: below the temporary folder,
/// readable by this user only, and removed with this. The next one removes those that killed
/// processes left. Throws Error (Refused) if it cannot be made.
class ScratchFolder
{
public:
  ScratchFolder();
  ~ScratchFolder();
  ScratchFolder(const ScratchFolder&) = delete;
  ScratchFolder& operator=(const ScratchFolder&) = delete;

  const std::filesystem::path& path() const noexcept { return m_path; }

private:
  std::filesystem::path m_path;
  std::unique_ptr<OwnerLock> m_lock;
};

} // namespace petrous::library
