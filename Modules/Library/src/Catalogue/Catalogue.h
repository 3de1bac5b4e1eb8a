#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>

#include "petrous/Library/Library.h"

namespace petrous::library
{

/// The SQLite index over the manifests. It only saves time: an entry holds while the manifest's
/// size and time of change are those it was made from, and where the database cannot be opened or
/// written, everything is read from the manifests. A damaged one is made anew by `put`.
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

  struct Entry
  {
    CaseSummary summary;
    Stamp stamp;
  };

  /// By name; as one reader sees it who locks writers out. Leaves no file behind.
  std::map<std::string, Entry> entries() const noexcept;
  void put(const CaseSummary& summary, const Stamp& stamp) noexcept;
  void remove(const std::string& name) noexcept;

private:
  std::filesystem::path m_file;
};

} // namespace petrous::library
