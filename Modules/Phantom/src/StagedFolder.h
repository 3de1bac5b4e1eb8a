#pragma once

#include <filesystem>

namespace petrous::phantom
{

/// A folder that appears whole or not at all: written under another name, then renamed.
///
/// The target may exist as an empty folder. Until commit() the destructor removes everything
/// that was made, parents included.
class StagedFolder
{
public:
  /// Throws Error: Refused where the target is a file or a folder that is not empty, or
  /// where nothing can be written there.
  explicit StagedFolder(const std::filesystem::path& target);
  ~StagedFolder();
  StagedFolder(const StagedFolder&) = delete;
  StagedFolder& operator=(const StagedFolder&) = delete;

  const std::filesystem::path& path() const noexcept ///< where to write
  {
    return m_staging;
  }

  /// Throws Error (Refused) naming the target when it cannot be put in place.
  void commit();

private:
  std::filesystem::path m_target;
  std::filesystem::path m_staging;
  std::filesystem::path m_made; ///< the topmost folder that was not there before; may be empty
  bool m_inside = false;        ///< staged inside the empty target
  bool m_done = false;
};

} // namespace petrous::phantom
