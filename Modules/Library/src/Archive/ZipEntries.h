#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <string>

#include <zip.h>

#include "petrous/Core/Progress.h"

namespace petrous::library
{

/// Fills a buffer, returns the bytes written, 0 at the end; may throw.
using Produce = std::function<std::size_t(char* buffer, std::size_t room)>;

/// A zip file being written: complete or not at all.
class ZipWriter
{
public:
  /// It grows in the folder `staging`, which must be on the file system of `path`. Throws
  /// core::OutputFileError.
  ZipWriter(const std::filesystem::path& path, const std::filesystem::path& staging);
  ~ZipWriter();
  ZipWriter(const ZipWriter&) = delete;
  ZipWriter& operator=(const ZipWriter&) = delete;

  /// Entries are read, in the order of `add`, by `commit`. `begin` is called when an entry's turn
  /// comes. `deflate`: compressed by the zip, else stored as produced.
  void add(const std::string& name, bool deflate, std::function<Produce()> begin);

  /// Writes, syncs and renames. Throws what producers throw, core::OutputFileError, CancelledError;
  /// returns false if the file is in place but the disk did not confirm it.
  bool commit(const core::Progress& progress);

private:
  struct Entry;
  static zip_int64_t read(void* entry, void* data, zip_uint64_t size, zip_source_cmd_t command);

  std::filesystem::path m_path;
  std::filesystem::path m_temporary;
  zip_t* m_zip = nullptr;
  std::exception_ptr m_failure; ///< of a producer or the progress's listener
};

/// A zip file of any origin, opened for reading and checked as a whole: its central directory
/// agrees with the local headers; names are relative, plain and unique; no links, devices,
/// encryption, or methods other than store and deflate; no entry states more than deflate can
/// unpack.
class ZipReader
{
public:
  struct Entry
  {
    std::uint64_t index = 0;
    std::uint64_t bytes = 0;  ///< unpacked
    std::uint64_t packed = 0; ///< in the file
  };

  /// Throws LibraryError (Damaged, NotFound).
  explicit ZipReader(const std::filesystem::path& path);

  const std::map<std::string, Entry>& entries() const noexcept { return m_entries; }

  /// Reads from an entry; short only at its end. Verifies the entry's CRC-32 there.
  class Stream
  {
  public:
    std::size_t read(char* buffer, std::size_t count); ///< throws LibraryError (Damaged)

  private:
    friend class ZipReader;
    Stream(const ZipReader& zip, const std::string& name);
    const std::filesystem::path* m_path;
    std::string m_name;
    std::unique_ptr<zip_file_t, int (*)(zip_file_t*)> m_file;
  };
  Stream open(const std::string& name) const { return {*this, name}; } ///< throws LibraryError

  /// A whole entry. Throws LibraryError (Damaged), also if it is larger than `limit` bytes.
  std::string text(const std::string& name, std::uint64_t limit) const;

private:
  std::filesystem::path m_path;
  std::unique_ptr<zip_t, void (*)(zip_t*)> m_zip{nullptr, &zip_discard};
  std::map<std::string, Entry> m_entries;
};

/// Throws LibraryError (Damaged): "FILE: is not a sound archive: WHAT; ...".
[[noreturn]] void throwUnsound(const std::filesystem::path& file, const std::string& what);

} // namespace petrous::library
