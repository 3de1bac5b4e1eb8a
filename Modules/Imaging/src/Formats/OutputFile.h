#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>

#include "petrous/Core/OutputFile.h"
#include "petrous/Core/Progress.h"

namespace petrous::imaging
{

/// core::OutputFile for voxels: in chunks, compressed, with FileError (Unwritable) for its errors.
class OutputFile
{
public:
  explicit OutputFile(const std::filesystem::path& path);

  void write(const void* bytes, std::size_t count);
  void write(std::string_view text) { write(text.data(), text.size()); }
  void commit();

  /// Writes voxels uncompressed, in chunks, with progress and cancellation.
  void writeVoxels(const void* bytes, std::size_t count, const core::Progress& progress);

  /// Writes `first`, then the voxels, as one gzip stream without time or name: equal input gives
  /// equal bytes.
  void writeCompressed(std::string_view first, const void* bytes, std::size_t count,
                       const core::Progress& progress);

private:
  core::OutputFile m_file;
};

} // namespace petrous::imaging
