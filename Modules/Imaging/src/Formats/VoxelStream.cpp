#include "VoxelStream.h"

#include <algorithm>
#include <vector>

#include <itk_zlib.h>

#include "FileHelpers.h"

namespace petrous::imaging
{

namespace
{
constexpr std::size_t kPart = std::size_t{1} << 18;
constexpr int kEitherWindow = 15 + 32;       // zlib: 32 KiB window, gzip or zlib header
constexpr std::uint64_t kMaxTail = 1U << 20; // bytes after the voxels
} // namespace

struct VoxelStream::Inflater
{
  z_stream stream{};
  std::vector<char> in = std::vector<char>(kPart);
  bool ended = false; ///< the checksum was reached, and is correct
};

VoxelStream::VoxelStream(const std::filesystem::path& path, std::uint64_t offset, bool packed)
  : m_path(path)
  , m_file(path, std::ios::binary)
{
  m_file.seekg(static_cast<std::streamoff>(offset));
  if (!m_file)
    failDamaged();
  if (!packed)
    return;
  m_inflater = std::make_unique<Inflater>();
  if (inflateInit2(&m_inflater->stream, kEitherWindow) != Z_OK)
    failDamaged();
}

VoxelStream::~VoxelStream()
{
  if (m_inflater)
    inflateEnd(&m_inflater->stream);
}

void VoxelStream::read(void* out, std::size_t count)
{
  if (m_inflater)
  {
    if (unpack(static_cast<char*>(out), count) != count)
      failDamaged();
    return;
  }
  m_file.read(static_cast<char*>(out), static_cast<std::streamsize>(count));
  if (static_cast<std::size_t>(m_file.gcount()) != count)
    failDamaged();
}

void VoxelStream::skip(std::uint64_t count)
{
  if (!m_inflater)
  {
    m_file.seekg(static_cast<std::streamoff>(count), std::ios::cur);
    return;
  }
  std::vector<char> unused(static_cast<std::size_t>(std::min<std::uint64_t>(count, kPart)));
  while (count > 0)
  {
    const auto part = static_cast<std::size_t>(std::min<std::uint64_t>(count, unused.size()));
    read(unused.data(), part);
    count -= part;
  }
}

void VoxelStream::finish(std::uint64_t most, const core::Progress& progress)
{
  if (!m_inflater)
    return;
  std::vector<char> rest(kPart);
  std::uint64_t behind = 0;
  std::size_t count = 0;
  do
  {
    progress.check("reading voxels");
    count = unpack(rest.data(), rest.size());
    behind += count;
    if (behind > most)
      fail(FileError::Reason::Unreadable, m_path,
           "holds far more voxels than its header says; export it again from where it came");
  } while (count == rest.size());
  if (!m_inflater->ended)
    failDamaged();
}

std::size_t VoxelStream::unpack(char* out, std::size_t count)
{
  z_stream& stream = m_inflater->stream;
  std::size_t done = 0;
  while (done < count)
  {
    if (stream.avail_in == 0)
    {
      m_file.read(m_inflater->in.data(), static_cast<std::streamsize>(m_inflater->in.size()));
      stream.next_in = reinterpret_cast<Bytef*>(m_inflater->in.data());
      stream.avail_in = static_cast<uInt>(m_file.gcount());
      if (stream.avail_in == 0)
        return done;
    }
    if (m_inflater->ended)
    {
      // Parallel compressors write several streams in sequence; zeros may pad the end of the file.
      if (*stream.next_in != 0x1f)
        return done;
      inflateReset(&stream);
      m_inflater->ended = false;
    }
    const std::size_t part = std::min(count - done, std::size_t{1} << 30);
    stream.next_out = reinterpret_cast<Bytef*>(out + done);
    stream.avail_out = static_cast<uInt>(part);
    const int state = inflate(&stream, Z_NO_FLUSH);
    if (state != Z_OK && state != Z_STREAM_END && state != Z_BUF_ERROR)
      failDamaged();
    done += part - stream.avail_out;
    m_inflater->ended = state == Z_STREAM_END;
  }
  return done;
}

void VoxelStream::failDamaged() const
{
  fail(FileError::Reason::Unreadable, m_path,
       "breaks off or is damaged within its voxels; copy it again from where it came");
}

void readBox(VoxelStream& stream, const core::Index3& dims, const core::IndexBox& box,
             std::size_t voxelBytes, void* out, const core::Progress& progress)
{
  const auto bytes = [voxelBytes](int a) { return static_cast<std::uint64_t>(a) * voxelBytes; };
  const std::uint64_t row = bytes(dims[0]);
  const std::uint64_t slice = row * static_cast<std::uint64_t>(dims[1]);
  const core::Index3 size = box.size();
  const bool wholeRows = size[0] == dims[0];
  auto* next = static_cast<char*>(out);
  stream.skip(slice * static_cast<std::uint64_t>(box.lower[2]));
  for (int k = 0; k < size[2]; ++k)
  {
    progress.report(static_cast<double>(k) / size[2], "reading voxels");
    stream.skip(row * static_cast<std::uint64_t>(box.lower[1]));
    const int rows = wholeRows ? 1 : size[1];
    const std::uint64_t run =
        wholeRows ? row * static_cast<std::uint64_t>(size[1]) : bytes(size[0]);
    for (int j = 0; j < rows; ++j)
    {
      stream.skip(bytes(box.lower[0]));
      stream.read(next, static_cast<std::size_t>(run));
      next += run;
      stream.skip(bytes(dims[0] - box.upper[0]));
    }
    stream.skip(row * static_cast<std::uint64_t>(dims[1] - box.upper[1]));
  }
  stream.finish(slice * static_cast<std::uint64_t>(dims[2] - box.upper[2]) + kMaxTail, progress);
}

void swapBytes(void* numbers, std::size_t count, std::size_t numberBytes)
{
  auto* number = static_cast<char*>(numbers);
  for (std::size_t n = 0; n < count; ++n, number += numberBytes)
    std::reverse(number, number + numberBytes);
}

} // namespace petrous::imaging
