#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <vector>

#include "petrous/Imaging/SeriesGeometry.h"

struct stat;

namespace petrous::imaging
{

FileStamp stampOf(const struct stat& status);

/// Whether both are of the same file with the same contents; a change of rights or links is none.
bool sameContents(const FileStamp& a, const FileStamp& b);

/// The bytes of a regular file, or of a file inflated in memory. Not open if the file is missing,
/// or is a pipe or device. Reading beyond the end fails; throws nothing but bad_alloc.
class ByteSource
{
public:
  explicit ByteSource(const std::filesystem::path& file);
  ~ByteSource();
  ByteSource(const ByteSource&) = delete;
  ByteSource& operator=(const ByteSource&) = delete;

  bool isOpen() const noexcept { return m_descriptor >= 0; }
  std::uint64_t size() const noexcept { return m_size; }
  const FileStamp& stamp() const noexcept { return m_stamp; } ///< when it was opened

  /// Whether the file still is as it was when it was opened: same size and time of modification.
  bool isUnchanged() const;

  /// Whether reading failed although the file should have had the bytes: the medium was removed or
  /// is bad, or the file was made shorter meanwhile.
  bool hasFailed() const noexcept { return m_hasFailed; }

  /// Reads exactly `count` bytes from `offset`, or returns false.
  bool read(std::uint64_t offset, void* bytes, std::size_t count);

  /// Like `read`, buffered: for many small reads close together.
  bool readNear(std::uint64_t offset, void* bytes, std::size_t count);

  /// Replaces everything after `start` by its raw DEFLATE decompression (DICOM PS3.5 A.5). False if
  /// it is damaged or larger than any slice can be.
  bool inflateFrom(std::uint64_t start);

private:
  int m_descriptor = -1;
  std::uint64_t m_size = 0;
  FileStamp m_stamp;
  bool m_hasFailed = false;
  std::vector<unsigned char> m_memory; ///< the inflated file; if empty, the file is read
  std::vector<unsigned char> m_window;
  std::uint64_t m_windowStart = 0;
};

} // namespace petrous::imaging
