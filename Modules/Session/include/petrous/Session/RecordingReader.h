#pragma once

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "petrous/Session/Recording.h"

namespace petrous::session
{

/// Reads a recording block by block; doubles are bit-identical to those written.
class RecordingReader
{
public:
  /// Reads the header. Throws RecordingError.
  explicit RecordingReader(const std::filesystem::path& file);

  const RecordingSetup& setup() const noexcept { return m_setup; }

  /// Reads the next block; false and an empty block at the end. A truncated file ends after its
  /// last complete block, with `complete` false. Throws RecordingError (Corrupt) for damaged data.
  bool next(RecordingBlock& block);

  std::uint64_t ticks() const noexcept { return m_ticks; } ///< read so far

  /// After the end: whether the writer closed the file.
  bool complete() const noexcept { return m_complete; }

  /// After the end of an incomplete file: a warning, for display. Empty otherwise.
  std::string warning() const;

private:
  bool read(std::vector<std::uint8_t>& bytes, std::size_t count);
  [[noreturn]] void corrupt(const std::string& what) const;

  std::string m_name;
  std::ifstream m_file;
  RecordingSetup m_setup;
  std::uint64_t m_ticks = 0;
  std::uint64_t m_edits = 0;
  std::uint64_t m_blocks = 0;
  bool m_complete = false;
  bool m_ended = false;
};

} // namespace petrous::session
