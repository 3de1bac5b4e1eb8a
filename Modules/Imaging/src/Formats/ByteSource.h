#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <vector>

namespace petrous::imaging
{

/// The bytes of a regular file, or of one inflated in memory. Not open: nothing there, or a pipe or
/// device. Reading beyond the end fails; nothing
/// throws but bad_alloc.
class ByteSource
{
public:
  explicit ByteSource(const std::filesystem::path& file);
  ~ByteSource();
  ByteSource(const ByteSource&) = delete;
  ByteSource& operator=(const ByteSource&) = delete;

  bool isOpen() const noexcept { return m_descriptor >= 0; }
  std::uint64_t size() const noexcept { return m_size; }

  /// All `count` bytes from `offset`, or false.
  bool read(std::uint64_t offset, void* bytes, std::size_t count);

  /// The same through a window of the file: for many small pieces that lie together.
  bool readNear(std::uint64_t offset, void* bytes, std::size_t count);

  /// Replaces what follows `start` by its raw DEFLATE decompression (DICOM PS3.5 A.5). False
  /// where it is damaged or larger than any slice could be.
  bool inflateFrom(std::uint64_t start);

private:
  int m_descriptor = -1;
  std::uint64_t m_size = 0;
  std::vector<unsigned char> m_memory; ///< the inflated file; empty: read the file
  std::vector<unsigned char> m_window;
  std::uint64_t m_windowStart = 0;
};

} // namespace petrous::imaging
