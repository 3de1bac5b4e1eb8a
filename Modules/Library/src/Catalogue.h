#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

#include "petrous/Library/Library.h"

namespace petrous::library
{

/// The SQLite index over the manifests (WAL). It only saves time: an entry holds while the
/// manifest's size and time of change are those it was made from, and where the database cannot be
/// opened or written, everything is read from the manifests.
class Catalogue
{
public:
  /// Which state of a manifest an entry was made from.
  struct Stamp
  {
    std::uintmax_t size = 0;
    std::int64_t changed = 0; ///< file time, ticks
  };

  explicit Catalogue(std::filesystem::path file);

  std::optional<CaseSummary> find(const std::string& name, const Stamp& stamp) const noexcept;
  void put(const CaseSummary& summary, const Stamp& stamp) noexcept;

private:
  std::filesystem::path m_file;
};

} // namespace petrous::library
