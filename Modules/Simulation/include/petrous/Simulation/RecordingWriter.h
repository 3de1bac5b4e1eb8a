#pragma once

#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <vector>

#include "petrous/Simulation/Recording.h"

namespace petrous::simulation
{

/// Writes ticks to a file, block by block: what is on disk can be read up to its last whole block,
/// also when the program was killed. Layout: src/Recording/RecordingFormat.h.
///
/// Called by the thread that empties the ring, never by the servo. One thread.
class RecordingWriter
{
public:
  static constexpr std::size_t kBlock = 1000;  ///< ticks
  static constexpr std::size_t kEdits = 10000; ///< or edits, whichever is first

  /// Makes or replaces the file. Throws RecordingError, InvalidParameter.
  RecordingWriter(const std::filesystem::path& file, const RecordingSetup& setup);
  RecordingWriter(const RecordingWriter&) = delete;
  RecordingWriter& operator=(const RecordingWriter&) = delete;

  /// Writes what is left, like close(), but tells nobody when that fails.
  ~RecordingWriter();

  /// Throws RecordingError (NotWritten); then nothing more is written.
  void add(const TickRecord& record);

  /// What was done to the mask, before the first tick that felt it is added. Throws as above.
  void add(const MaskEdit& edit);

  /// Writes what is left and says in the file that it is whole. Throws RecordingError.
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
  std::unique_ptr<std::FILE, CloseFile> m_file; // null once closed
  RecordingBlock m_block;
  std::uint64_t m_ticks = 0;
  std::uint64_t m_edits = 0;
  std::uint64_t m_bytes = 0;
};

} // namespace petrous::simulation
