#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <memory>
#include <string>
#include <vector>

#include "petrous/Core/GridGeometry.h"
#include "petrous/Core/Progress.h"

namespace petrous::imaging
{

/// How the bytes of voxels are encoded.
enum class Packing
{
  None,
  Zlib, ///< gzip or zlib
  Bzip2,
  Hex ///< two hexadecimal digits a byte; white space is skipped
};

/// Where the voxels of an image are: one file, or several of equal share, one after the other.
struct VoxelPlace
{
  struct Part
  {
    std::filesystem::path file;
    std::uint64_t offset = 0; ///< in the file, before decoding
  };
  std::vector<Part> parts;
  std::uint64_t partBytes = 0;    ///< decoded bytes of voxels in each part
  std::uint64_t packedOffset = 0; ///< decoded bytes before the voxels of each part
  Packing packing = Packing::None;
};

/// The decoded bytes of voxels. A truncated file or a checksum mismatch is an error, unlike in ITK
/// 5.2, which would silently return undefined voxels. Throws FileError (Unreadable).
class VoxelStream
{
public:
  explicit VoxelStream(VoxelPlace place);
  ~VoxelStream();
  VoxelStream(const VoxelStream&) = delete;
  VoxelStream& operator=(const VoxelStream&) = delete;

  void read(void* out, std::size_t count);
  void skip(std::uint64_t count);

  /// Reads a compressed stream to its end, where the last checksum is. Far more bytes than voxels
  /// indicate a mismatched header, and are rejected.
  void finish(const core::Progress& progress);

  class Decoder; ///< in the implementation

private:
  void open(std::size_t part);
  [[noreturn]] void failDamaged() const;

  VoxelPlace m_place;
  std::size_t m_part = 0;
  std::uint64_t m_left = 0; ///< bytes of voxels of this part that are still to be read
  std::ifstream m_file;
  std::unique_ptr<Decoder> m_decoder;
};

/// Reads a box of a grid whose voxels of `voxelBytes` follow in `stream`, first axis fastest,
/// storing only the box. A compressed stream is read to its end, so that damage anywhere is
/// detected.
void readBox(VoxelStream& stream, const core::Index3& dims, const core::IndexBox& box,
             std::size_t voxelBytes, void* out, const core::Progress& progress);

/// Reverses the byte order of each of `count` numbers.
void swapBytes(void* numbers, std::size_t count, std::size_t numberBytes);

} // namespace petrous::imaging
