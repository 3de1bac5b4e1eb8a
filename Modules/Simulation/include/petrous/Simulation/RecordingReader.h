#pragma once

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "petrous/Simulation/Recording.h"

namespace petrous::simulation
{

/// Reads a recording block by block, each double as it was written to the last bit.
class RecordingReader
{
public:
  /// Reads the head. Throws RecordingError.
  explicit RecordingReader(const std::filesystem::path& file);

  const RecordingSetup& setup() const noexcept { return m_setup; }

  /// What comes next; false, and nothing, at the end. A file that ends too early ends after its
  /// last whole block, and `complete` is false. Throws RecordingError (Corrupt) where bytes were
  /// changed.
  bool next(RecordingBlock& block);

  std::uint64_t ticks() const noexcept { return m_ticks; } ///< read so far

  /// After the end: the writer closed the file.
  bool complete() const noexcept { return m_complete; }

  /// After the end of a file that is not complete: that, in words. Empty otherwise.
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

} // namespace petrous::simulation
