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

/// The bytes of a file from an offset on, unpacked where they are gzip or zlib. A file that breaks
/// off or fails its checksum is refused: ITK 5.2 would give voxels from nothing there, in silence.
/// Throws FileError (Unreadable).
class VoxelStream
{
public:
  /// `offset` counts bytes on the disk.
  VoxelStream(const std::filesystem::path& path, std::uint64_t offset, bool packed);
  ~VoxelStream();
  VoxelStream(const VoxelStream&) = delete;
  VoxelStream& operator=(const VoxelStream&) = delete;

  void read(void* out, std::size_t count);
  void skip(std::uint64_t count);

  /// Reads a packed stream on to its end, where the last checksum stands. More than `most` bytes
  /// beyond what was asked for belong to another header, and are refused.
  void finish(std::uint64_t most, const core::Progress& progress);

private:
  struct Inflater;
  [[noreturn]] void failDamaged() const;
  std::size_t unpack(char* out, std::size_t count);

  std::filesystem::path m_path;
  std::ifstream m_file;
  std::unique_ptr<Inflater> m_inflater;
};

/// Reads a box of a grid whose voxels of `voxelBytes` follow on `stream`, first axis fastest, and
/// keeps only it. A packed stream is read to its end, so that damage anywhere is known.
void readBox(VoxelStream& stream, const core::Index3& dims, const core::IndexBox& box,
             std::size_t voxelBytes, void* out, const core::Progress& progress);

/// Turns the bytes of each of `count` numbers round.
void swapBytes(void* numbers, std::size_t count, std::size_t numberBytes);

} // namespace petrous::imaging
