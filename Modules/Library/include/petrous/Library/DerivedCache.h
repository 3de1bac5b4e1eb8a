#pragma once

#include <cstdint>
#include <filesystem>

#include "petrous/Core/DerivedStore.h"

namespace petrous::library
{

/// Derived data as files in a folder of the library, for all programs that use it: each file is
/// written under a name of its own and renamed, holds its key and a checksum, and never changes.
/// One that is not what it should be is removed and counts as none. A disk that is full or may not
/// be written to is no fault: nothing is kept then.
///
/// Where the files would take more than `limit` bytes, those go first that were not used for the
/// longest time.
class DerivedCache : public core::DerivedStore
{
public:
  static constexpr std::uintmax_t kLimit = std::uintmax_t{4} << 30; ///< bytes

  explicit DerivedCache(std::filesystem::path folder, std::uintmax_t limit = kLimit);

  std::optional<Bytes> find(const std::string& key) noexcept override;
  void put(const std::string& key, const Bytes& bytes) noexcept override;

  std::uintmax_t bytes() const noexcept override; ///< on disk

  /// Removes what was not used for the longest time until no more than `most` bytes are left, and
  /// what a killed writer left an hour ago or longer. Returns the bytes that are free now.
  std::uintmax_t prune(std::uintmax_t most) noexcept;

private:
  std::filesystem::path fileOf(const std::string& key) const;

  std::filesystem::path m_folder;
  std::uintmax_t m_limit;
};

/// The one of a library.
std::filesystem::path derivedFolder(const std::filesystem::path& library);

} // namespace petrous::library
