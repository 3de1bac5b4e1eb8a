#pragma once

#include <filesystem>
#include <functional>

namespace petrous::core
{

/// Exclusive lock between processes during its lifetime (flock), on a file that is made if it is
/// missing and stays. Waits for it, or throws, if another holds it. Throws OutputFileError, also
/// where the file system has no locks, as some network drives: two programs would overwrite each
/// other there.
class FileLock
{
public:
  enum class IfHeld
  {
    Wait,
    Throw
  };
  explicit FileLock(const std::filesystem::path& file, IfHeld ifHeld = IfHeld::Wait);
  /// Waits, and calls `waiting` ten times a second with the time that it has waited, s. What that
  /// throws ends it.
  FileLock(const std::filesystem::path& file, const std::function<void(double)>& waiting);
  ~FileLock();
  FileLock(const FileLock&) = delete;
  FileLock& operator=(const FileLock&) = delete;

private:
  int m_descriptor;
};

} // namespace petrous::core
