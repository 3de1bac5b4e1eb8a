#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "petrous/Library/Library.h"

namespace petrous::library
{

/// Its file, in the library's folder.
constexpr const char* kIndex = "library.sqlite";

/// SQLite index of the manifests. It is only an optimization: an entry is valid while size and
/// modification time of the manifest match, and if the database cannot be opened or written,
/// everything is read from the manifests. A damaged database is recreated by `put`. Notes are not
/// in it (record 23).
class Catalogue
{
public:
  /// The state of the manifest from which an entry was made.
  struct Stamp
  {
    std::uintmax_t size = 0;
    std::int64_t changed = 0; ///< file time, ticks

    bool operator==(const Stamp& other) const noexcept
    {
      return size == other.size && changed == other.changed;
    }
  };

  explicit Catalogue(std::filesystem::path file);

  struct Entry
  {
    CaseSummary summary;
    Stamp stamp;
    std::string
        text; ///< for searches, lower case, a line each: the names of the case and its parts, the
              ///< tags, diagnosis and procedure; not the note, which may name anybody
  };

  /// Keyed by name; one consistent read that locks out writers. Creates no files.
  std::map<std::string, Entry> entries() const noexcept;
  void put(const Entry& entry) noexcept;
  void put(const std::vector<Entry>& entries) noexcept; ///< in one transaction

  /// Like `put`, of many at once; nothing happens without a database.
  void putIfThere(const std::vector<Entry>& entries) noexcept;

  void remove(const std::string& name) noexcept;

private:
  std::filesystem::path m_file;
};

} // namespace petrous::library
