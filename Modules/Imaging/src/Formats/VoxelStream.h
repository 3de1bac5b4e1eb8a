#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <memory>
#include <string>

#include "petrous/Core/GridGeometry.h"
#include "petrous/Core/Progress.h"

namespace petrous::imaging
{

/// The bytes of a file from an offset onwards, decompressed if gzip or zlib. A truncated file or a
/// checksum mismatch is an error, unlike in ITK 5.2, which would silently return undefined voxels.
/// Throws FileError (Unreadable).
class VoxelStream
{
public:
  /// `offset` is in the file, not the decompressed stream.
  VoxelStream(const std::filesystem::path& path, std::uint64_t offset, bool packed);
  ~VoxelStream();
  VoxelStream(const VoxelStream&) = delete;
  VoxelStream& operator=(const VoxelStream&) = delete;

  void read(void* out, std::size_t count);
  void skip(std::uint64_t count);

  /// Reads a compressed stream to its end, where the last checksum is. More than `most` bytes
  /// beyond those requested indicate a mismatched header, and are rejected.
  void finish(std::uint64_t most, const core::Progress& progress);

private:
  struct Inflater;
  [[noreturn]] void failDamaged() const;
  std::size_t unpack(char* out, std::size_t count);

  std::filesystem::path m_path;
  std::ifstream m_file;
  std::unique_ptr<Inflater> m_inflater;
};

/// Reads a box of a grid whose voxels of `voxelBytes` follow in `stream`, first axis fastest,
/// storing only the box. A compressed stream is read to its end, so that damage anywhere is
/// detected.
void readBox(VoxelStream& stream, const core::Index3& dims, const core::IndexBox& box,
             std::size_t voxelBytes, void* out, const core::Progress& progress);

/// Reverses the byte order of each of `count` numbers.
void swapBytes(void* numbers, std::size_t count, std::size_t numberBytes);

} // namespace petrous::imaging
