#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "DicomHeader.h"
#include "petrous/Core/DerivedStore.h"

namespace petrous::imaging
{

struct ListedFile
{
  std::filesystem::path path;
  FileStamp stamp;
};

/// The headers of a scan, kept in a DerivedStore for the next scan of the same files.
///
/// They are found again only if no file was added, removed, renamed, moved or changed (path,
/// device, inode, size, times of modification and of change), and by the same build of the program.
///
/// What is stored tells nothing of the patient to anyone who has it alone: it is sealed by
/// AES-256-GCM, whose key is the SHA-256 of that list and of the beginnings of some of the files.
/// Whoever has the files can open it, and needs it no more. A damaged entry is not found.
class HeaderCache
{
public:
  HeaderCache(core::DerivedStore& store, const std::vector<ListedFile>& files);

  /// The header of each file, in the order of `files`.
  std::optional<std::vector<FileHeader>> find();

  /// Nothing is kept if a file could not be read, or was modified less than two seconds before
  /// `listed` (or after it): clocks of file systems are that coarse, and a second change would not
  /// be seen.
  ///
  /// listed  when listing the files began, ns since 1970
  void put(const std::vector<FileHeader>& headers, std::int64_t listed);

private:
  core::DerivedStore& m_store;
  const std::vector<ListedFile>& m_files;
  std::string m_name;   ///< of the entry
  std::string m_secret; ///< 32 bytes
};

/// ns since 1970.
std::int64_t timeNow();

} // namespace petrous::imaging
