#include "Catalogue.h"

#include <cctype>
#include <cstring>

#include <SQLiteCpp/SQLiteCpp.h>

namespace petrous::library
{

namespace
{

constexpr int kBusyMilliseconds = 2000;

SQLite::Database openForWriting(const std::filesystem::path& file)
{
  SQLite::Database database(file.string(), SQLite::OPEN_READWRITE | SQLite::OPEN_CREATE,
                            kBusyMilliseconds);
  database.exec("PRAGMA journal_mode=WAL");
  database.exec("PRAGMA synchronous=NORMAL");
  database.exec("CREATE TABLE IF NOT EXISTS cases ("
                "name TEXT PRIMARY KEY, size INTEGER, changed INTEGER, modified TEXT,"
                "nx INTEGER, ny INTEGER, nz INTEGER, structures INTEGER, strokes INTEGER,"
                "removed_mm3 REAL)");
  return database;
}

// Read as it lies on the disk: asking leaves no -wal and -shm files behind. What a writer has not
// brought into the file yet is then read from the manifests.
std::string readOnlyUri(const std::filesystem::path& file)
{
  constexpr const char* kDigits = "0123456789ABCDEF";
  std::string uri = "file:";
  for (const char byte : std::filesystem::absolute(file).string())
  {
    const auto c = static_cast<unsigned char>(byte);
    const bool plain = std::isalnum(c) != 0 || (c != 0 && std::strchr("/._-", c) != nullptr);
    uri += plain ? std::string(1, byte) : std::string{'%', kDigits[c >> 4], kDigits[c & 15]};
  }
  return uri + "?immutable=1";
}

} // namespace

Catalogue::Catalogue(std::filesystem::path file)
  : m_file(std::move(file))
{
}

std::optional<CaseSummary> Catalogue::find(const std::string& name,
                                           const Stamp& stamp) const noexcept
try
{
  if (!std::filesystem::exists(m_file))
    return std::nullopt;
  SQLite::Database database(readOnlyUri(m_file), SQLite::OPEN_READONLY | SQLite::OPEN_URI);
  SQLite::Statement query(database, "SELECT modified, nx, ny, nz, structures, strokes, removed_mm3 "
                                    "FROM cases WHERE name = ? AND size = ? AND changed = ?");
  query.bind(1, name);
  query.bind(2, static_cast<std::int64_t>(stamp.size));
  query.bind(3, stamp.changed);
  if (!query.executeStep())
    return std::nullopt;
  CaseSummary summary;
  summary.name = name;
  summary.modified = query.getColumn(0).getString();
  for (int a = 0; a < 3; ++a)
    summary.dims[static_cast<std::size_t>(a)] = query.getColumn(1 + a).getInt();
  summary.structures = static_cast<std::size_t>(query.getColumn(4).getInt64());
  summary.strokes = static_cast<std::size_t>(query.getColumn(5).getInt64());
  summary.removed = query.getColumn(6).getDouble();
  return summary;
}
catch (const std::exception&)
{
  return std::nullopt;
}

void Catalogue::put(const CaseSummary& summary, const Stamp& stamp) noexcept
try
{
  SQLite::Database database = openForWriting(m_file);
  SQLite::Statement insert(database,
                           "INSERT OR REPLACE INTO cases VALUES (?, ?, ?, ?, ?, ?, ?, ?, ?, ?)");
  insert.bind(1, summary.name);
  insert.bind(2, static_cast<std::int64_t>(stamp.size));
  insert.bind(3, stamp.changed);
  insert.bind(4, summary.modified);
  for (int a = 0; a < 3; ++a)
    insert.bind(5 + a, summary.dims[static_cast<std::size_t>(a)]);
  insert.bind(8, static_cast<std::int64_t>(summary.structures));
  insert.bind(9, static_cast<std::int64_t>(summary.strokes));
  insert.bind(10, summary.removed);
  insert.exec();
}
catch (const std::exception&)
{
  // The manifest is what counts; `find` will not answer for it and it is read again.
}

} // namespace petrous::library
