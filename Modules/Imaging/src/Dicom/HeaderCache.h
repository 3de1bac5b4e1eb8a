#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
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

/// What comparing the pixels or bytes of slices and files showed, by what was compared.
using KnownComparisons = std::map<std::string, std::uint64_t>;

/// The headers of a scan and what comparing files in it showed, kept in a DerivedStore for the next
/// scan of the same files.
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

  struct Entry
  {
    std::vector<FileHeader> headers; ///< in the order of `files`
    KnownComparisons comparisons;
  };
  std::optional<Entry> find();

  /// The headers as put keeps them. nullopt: nothing is to be kept, as a file could not be read, or
  /// was modified less than two seconds before `listed` (or after it): clocks of file systems are
  /// that coarse, and a second change would not be seen.
  ///
  /// listed  when listing the files began, ns since 1970
  std::optional<std::string> packed(const std::vector<FileHeader>& headers,
                                    std::int64_t listed) const;

  void put(std::string packed, const KnownComparisons& comparisons);

private:
  core::DerivedStore& m_store;
  const std::vector<ListedFile>& m_files;
  std::string m_name;   ///< of the entry
  std::string m_secret; ///< 32 bytes
};

/// ns since 1970.
std::int64_t timeNow();

} // namespace petrous::imaging
