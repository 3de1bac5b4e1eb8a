#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>

#include "petrous/Core/Progress.h"

namespace petrous::imaging
{

/// A file that appears whole or not at all: bytes go to a temporary name in the same folder,
/// `commit` puts them on the disk and renames. Without a commit nothing is left behind.
/// Everything throws FileError (Unwritable) in words.
class OutputFile
{
public:
  explicit OutputFile(const std::filesystem::path& path);
  ~OutputFile();
  OutputFile(const OutputFile&) = delete;
  OutputFile& operator=(const OutputFile&) = delete;

  void write(const void* bytes, std::size_t count);
  void write(std::string_view text) { write(text.data(), text.size()); }
  void commit();

  /// Writes voxels as they are, in parts, with progress and cancel.
  void writeVoxels(const void* bytes, std::size_t count, const core::Progress& progress);

  /// `first`, then the voxels, as one gzip stream without time or name: equal bytes in, equal
  /// bytes out.
  void writeCompressed(std::string_view first, const void* bytes, std::size_t count,
                       const core::Progress& progress);

private:
  [[noreturn]] void failWriting(const char* step, int error) const;

  std::filesystem::path m_path;
  std::string m_temporary;
  int m_descriptor = -1;
};

} // namespace petrous::imaging
