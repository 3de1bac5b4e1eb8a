#pragma once

#include <filesystem>

namespace petrous::phantom
{

/// A folder that appears complete or not at all: written under another name, then renamed. Into an
/// empty folder that exists already, the entries are renamed one by one.
///
/// The target may exist as an empty folder. Without commit() the destructor removes everything
/// created, including parent folders.
class StagedFolder
{
public:
  /// Throws Error (Refused) if the target is a file or a folder that is not empty, or if nothing
  /// can be written there.
  explicit StagedFolder(const std::filesystem::path& target);
  ~StagedFolder();
  StagedFolder(const StagedFolder&) = delete;
  StagedFolder& operator=(const StagedFolder&) = delete;

  const std::filesystem::path& path() const noexcept ///< where to write
  {
    return m_staging;
  }

  /// Throws Error (Refused) naming the target if it cannot be renamed into place.
  void commit();

private:
  std::filesystem::path m_target;
  std::filesystem::path m_staging;
  std::filesystem::path m_made; ///< the topmost folder created; may be empty
  bool m_inside = false;        ///< staged inside the empty target
  bool m_done = false;
};

} // namespace petrous::phantom
