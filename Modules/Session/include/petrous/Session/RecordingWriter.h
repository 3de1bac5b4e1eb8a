#pragma once

#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <vector>

#include "petrous/Session/Recording.h"

namespace petrous::session
{

/// Writes ticks to a file, block by block: a file is readable up to its last complete block, even
/// if the program was killed. Layout: src/Recording/RecordingFormat.h.
///
/// Called by the thread that empties the ring, never by the servo. Not thread-safe.
class RecordingWriter
{
public:
  static constexpr std::size_t kBlock = 1000;  ///< ticks
  static constexpr std::size_t kEdits = 10000; ///< or edits, whichever comes first

  /// Creates or overwrites the file. Throws RecordingError, InvalidParameter.
  RecordingWriter(const std::filesystem::path& file, const RecordingSetup& setup);
  RecordingWriter(const RecordingWriter&) = delete;
  RecordingWriter& operator=(const RecordingWriter&) = delete;

  /// Writes the rest, like close(), but ignores errors.
  ~RecordingWriter();

  /// Throws RecordingError (NotWritten), after which nothing more is written.
  void add(const TickRecord& record);

  /// To be called before adding the first tick that felt the edit. Throws as above.
  void add(const MaskEdit& edit);

  /// Writes the rest and the end mark, and waits for the disk. Throws RecordingError.
  void close();

  std::uint64_t ticks() const noexcept { return m_ticks; }
  std::uint64_t bytes() const noexcept { return m_bytes; } ///< on disk so far

private:
  struct CloseFile
  {
    void operator()(std::FILE* file) const noexcept { std::fclose(file); }
  };
  void write(const std::vector<std::uint8_t>& bytes);
  void writeBlock();
  [[noreturn]] void fail();

  std::string m_name;
  std::filesystem::path m_folder;
  std::unique_ptr<std::FILE, CloseFile> m_file; // null after close
  RecordingBlock m_block;
  std::uint64_t m_ticks = 0;
  std::uint64_t m_edits = 0;
  std::uint64_t m_bytes = 0;
};

} // namespace petrous::session
