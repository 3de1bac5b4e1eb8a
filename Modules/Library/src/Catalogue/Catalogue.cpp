#include "Catalogue.h"

#include <sstream>

#include <SQLiteCpp/SQLiteCpp.h>
#include <sqlite3.h>

namespace petrous::library
{

namespace
{

constexpr int kWriterWaits = 2000; // ms
constexpr int kReaderWaits = 500;  // ms; the manifests are read instead
constexpr int kVersion = 3;        // of the table: 2 has the text for searches, 3 descriptions

// Rollback journal instead of WAL: WAL can be read from a read-only medium only with `immutable`,
// which is wrong while others write, and leaves files behind even if only read.
SQLite::Database openForWriting(const std::filesystem::path& file)
{
  SQLite::Database database(file.string(), SQLite::OPEN_READWRITE | SQLite::OPEN_CREATE,
                            kWriterWaits);
  database.exec("PRAGMA journal_mode=DELETE");
  database.exec("PRAGMA synchronous=NORMAL");
  database.exec("PRAGMA secure_delete=ON"); // what was taken out of a description is gone
  // Of another version, older or newer: what it holds is in the manifests.
  if (database.execAndGet("PRAGMA user_version").getInt() != kVersion)
  {
    SQLite::Transaction change(database);
    database.exec("DROP TABLE IF EXISTS cases");
    database.exec("CREATE TABLE cases ("
                  "name TEXT PRIMARY KEY, size INTEGER, changed INTEGER, modified TEXT,"
                  "nx INTEGER, ny INTEGER, nz INTEGER, structures INTEGER, strokes INTEGER,"
                  "removed_mm3 REAL, text TEXT, id TEXT, tags TEXT, diagnosis TEXT,"
                  "procedure TEXT, side TEXT, planned_on TEXT, has_note INTEGER)");
    database.exec("PRAGMA user_version = " + std::to_string(kVersion));
    change.commit();
  }
  return database;
}

// SQLite would block on a pipe.
bool isRegular(const std::filesystem::path& file)
{
  std::error_code error;
  return std::filesystem::is_regular_file(file, error);
}

// Applies `change` to the database; to a new one if the old one is damaged.
template <class Change>
void write(const std::filesystem::path& file, const Change& change)
{
  std::error_code error;
  if (std::filesystem::exists(file, error) && !isRegular(file))
    return;
  try
  {
    SQLite::Database database = openForWriting(file);
    change(database);
  }
  catch (const SQLite::Exception& fault)
  {
    if (fault.getErrorCode() != SQLITE_NOTADB && fault.getErrorCode() != SQLITE_CORRUPT)
      throw;
    for (const char* ending : {"", "-journal", "-wal", "-shm"})
      std::filesystem::remove(file.string() + ending, error);
    SQLite::Database database = openForWriting(file);
    change(database);
  }
}

void insertEntry(SQLite::Database& database, const Catalogue::Entry& entry)
{
  SQLite::Statement insert(database, "INSERT OR REPLACE INTO cases VALUES "
                                     "(?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?)");
  const CaseSummary& summary = entry.summary;
  insert.bind(1, summary.name);
  insert.bind(2, static_cast<std::int64_t>(entry.stamp.size));
  insert.bind(3, entry.stamp.changed);
  insert.bind(4, summary.modified);
  for (int a = 0; a < 3; ++a)
    insert.bind(5 + a, summary.dims[static_cast<std::size_t>(a)]);
  insert.bind(8, static_cast<std::int64_t>(summary.structures));
  insert.bind(9, static_cast<std::int64_t>(summary.strokes));
  insert.bind(10, summary.removed);
  insert.bind(11, entry.text);
  insert.bind(12, summary.id);
  std::string tags;
  for (const std::string& tag : summary.description.tags)
    tags += tag + "\n";
  insert.bind(13, tags);
  insert.bind(14, summary.description.diagnosis);
  insert.bind(15, summary.description.procedure);
  insert.bind(16, scene::nameOf(summary.description.side));
  insert.bind(17, summary.description.date);
  insert.bind(18, summary.hasNote ? 1 : 0);
  insert.exec();
}

} // namespace

Catalogue::Catalogue(std::filesystem::path file)
  : m_file(std::move(file))
{
}

std::map<std::string, Catalogue::Entry> Catalogue::entries() const noexcept
try
{
  std::map<std::string, Entry> entries;
  if (!isRegular(m_file))
    return entries;
  SQLite::Database database(m_file.string(), SQLite::OPEN_READONLY, kReaderWaits);
  if (database.execAndGet("PRAGMA user_version").getInt() != kVersion)
    return entries;
  SQLite::Statement query(database, "SELECT name, size, changed, modified, nx, ny, nz, structures, "
                                    "strokes, removed_mm3, text, id, tags, diagnosis, procedure, "
                                    "side, planned_on, has_note FROM cases");
  while (query.executeStep())
  {
    Entry entry;
    CaseSummary& summary = entry.summary;
    summary.name = query.getColumn(0).getString();
    entry.stamp.size = static_cast<std::uintmax_t>(query.getColumn(1).getInt64());
    entry.stamp.changed = query.getColumn(2).getInt64();
    summary.modified = query.getColumn(3).getString();
    for (int a = 0; a < 3; ++a)
      summary.dims[static_cast<std::size_t>(a)] = query.getColumn(4 + a).getInt();
    summary.structures = static_cast<std::size_t>(query.getColumn(7).getInt64());
    summary.strokes = static_cast<std::size_t>(query.getColumn(8).getInt64());
    summary.removed = query.getColumn(9).getDouble();
    entry.text = query.getColumn(10).getString();
    summary.id = query.getColumn(11).getString();
    std::istringstream tags(query.getColumn(12).getString());
    for (std::string tag; std::getline(tags, tag);)
      summary.description.tags.push_back(tag);
    summary.description.diagnosis = query.getColumn(13).getString();
    summary.description.procedure = query.getColumn(14).getString();
    summary.description.side = scene::sideFromName(query.getColumn(15).getString());
    summary.description.date = query.getColumn(16).getString();
    summary.hasNote = query.getColumn(17).getInt() != 0;
    entries[summary.name] = std::move(entry);
  }
  return entries;
}
catch (const std::exception&)
{
  return {};
}

void Catalogue::put(const Entry& entry) noexcept
try
{
  write(m_file, [&](SQLite::Database& database) { insertEntry(database, entry); });
}
catch (const std::exception&)
{
  // The manifest is authoritative; `entries` will not match it, so it is read again.
}

void Catalogue::put(const std::vector<Entry>& entries) noexcept
try
{
  write(m_file,
        [&](SQLite::Database& database)
        {
          SQLite::Transaction change(database);
          for (const Entry& entry : entries)
            insertEntry(database, entry);
          change.commit();
        });
}
catch (const std::exception&)
{
  // As above.
}

void Catalogue::putIfThere(const std::vector<Entry>& entries) noexcept
try
{
  if (!isRegular(m_file))
    return;
  SQLite::Database database(m_file.string(), SQLite::OPEN_READWRITE, kReaderWaits);
  if (database.execAndGet("PRAGMA user_version").getInt() != kVersion)
    return;
  SQLite::Transaction change(database);
  for (const Entry& entry : entries)
    insertEntry(database, entry);
  change.commit();
}
catch (const std::exception&)
{
  // As in `put`; also on a medium that cannot be written.
}

void Catalogue::remove(const std::string& name) noexcept
try
{
  write(m_file,
        [&](SQLite::Database& database)
        {
          SQLite::Statement statement(database, "DELETE FROM cases WHERE name = ?");
          statement.bind(1, name);
          statement.exec();
        });
}
catch (const std::exception&)
{
  // An entry without a manifest is never looked up.
}

} // namespace petrous::library
