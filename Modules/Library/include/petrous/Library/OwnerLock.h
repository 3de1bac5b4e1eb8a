#pragma once

#include <filesystem>
#include <functional>

namespace petrous::library
{

/// Marks a folder as in use by this process: flock on the folder itself, which ends with the
/// process however it ends. Where the file system has no such locks, nothing is marked.
class OwnerLock
{
public:
  explicit OwnerLock(const std::filesystem::path& folder);
  ~OwnerLock();
  OwnerLock(const OwnerLock&) = delete;
  OwnerLock& operator=(const OwnerLock&) = delete;

  /// False if another process took the folder for abandoned before it was locked, and removed it:
  /// make another.
  bool isThere() const noexcept { return m_isThere; }

private:
  int m_descriptor = -1;
  bool m_isThere = false;
};

/// Removes files and folders in `folder` that this user's processes left when they were killed:
/// those of which `isOwn` is true and which nobody has locked (OwnerLock, core::OutputFile). What
/// cannot be removed stays. Never throws what `isOwn` does not.
void removeAbandoned(const std::filesystem::path& folder,
                     const std::function<bool(const std::filesystem::path&)>& isOwn);

} // namespace petrous::library
