#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>

#include "petrous/Core/DerivedStore.h"

namespace petrous::library
{

/// Derived data as files in a folder of the library, shared by all programs that use it: each file
/// is written under a temporary name and renamed, contains its key and a checksum, and never
/// changes. An invalid file is removed and treated as missing. A full or read-only disk is not an
/// error: nothing is cached then.
///
/// If the files would exceed `limit` bytes, the least recently used are removed first.
class DerivedCache : public core::DerivedStore
{
public:
  static constexpr std::uintmax_t kLimit = std::uintmax_t{4} << 30; ///< bytes

  explicit DerivedCache(std::filesystem::path folder, std::uintmax_t limit = kLimit);

  std::optional<Bytes> find(const std::string& key) noexcept override;
  void put(const std::string& key, const Bytes& bytes) noexcept override;

  std::uintmax_t bytes() const noexcept override; ///< on disk

  /// Removes the least recently used files until at most `most` bytes remain, and files that killed
  /// writers left at least an hour ago. Returns the number of bytes freed.
  std::uintmax_t prune(std::uintmax_t most) noexcept;

private:
  std::filesystem::path fileOf(const std::string& key) const;

  std::filesystem::path m_folder;
  std::uintmax_t m_limit;
};

/// The derived-data folder of a library.
std::filesystem::path derivedFolder(const std::filesystem::path& library);

/// The headers of scanned folders (imaging::scanDicom), at most 256 MB, in the user's cache folder:
/// $XDG_CACHE_HOME/petrous/scans, by default in ~/.cache. Null without a home folder.
std::unique_ptr<core::DerivedStore> scanCache();

} // namespace petrous::library
