#include "VoxelStream.h"

#include <algorithm>
#include <new>
#include <optional>
#include <utility>
#include <vector>

#include <bzlib.h>
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

/// Decodes what follows in a file.
class VoxelStream::Decoder
{
public:
  explicit Decoder(std::ifstream& file)
    : m_file(file)
  {
  }
  virtual ~Decoder() = default;
  Decoder(const Decoder&) = delete;
  Decoder& operator=(const Decoder&) = delete;

  /// Up to `count` bytes, fewer only at the end of the stream; nullopt where it is damaged.
  virtual std::optional<std::size_t> decode(char* out, std::size_t count) = 0;
  /// Whether the end was reached, and the checksum is correct.
  bool isWhole() const noexcept { return m_ended; }

protected:
  /// The next bytes of the file; none at its end.
  std::size_t refill()
  {
    m_file.read(m_in.data(), static_cast<std::streamsize>(m_in.size()));
    return static_cast<std::size_t>(m_file.gcount());
  }

  std::vector<char> m_in = std::vector<char>(kPart);
  bool m_ended = false;

private:
  std::ifstream& m_file;
};

namespace
{

class Inflater : public VoxelStream::Decoder
{
public:
  explicit Inflater(std::ifstream& file)
    : Decoder(file)
  {
    if (inflateInit2(&m_stream, kEitherWindow) != Z_OK)
      throw std::bad_alloc();
  }
  ~Inflater() override { inflateEnd(&m_stream); }

  std::optional<std::size_t> decode(char* out, std::size_t count) override
  {
    std::size_t done = 0;
    while (done < count)
    {
      if (m_stream.avail_in == 0)
      {
        m_stream.avail_in = static_cast<uInt>(refill());
        m_stream.next_in = reinterpret_cast<Bytef*>(m_in.data());
        if (m_stream.avail_in == 0)
          return done;
      }
      if (m_ended)
      {
        // Parallel compressors write several streams in sequence; zeros may pad the file's end.
        if (*m_stream.next_in != 0x1f)
          return done;
        inflateReset(&m_stream);
        m_ended = false;
      }
      const std::size_t part = std::min(count - done, std::size_t{1} << 30);
      m_stream.next_out = reinterpret_cast<Bytef*>(out + done);
      m_stream.avail_out = static_cast<uInt>(part);
      const int state = inflate(&m_stream, Z_NO_FLUSH);
      if (state != Z_OK && state != Z_STREAM_END && state != Z_BUF_ERROR)
        return std::nullopt;
      done += part - m_stream.avail_out;
      m_ended = state == Z_STREAM_END;
    }
    return done;
  }

private:
  z_stream m_stream{};
};

class Bunzipper : public VoxelStream::Decoder
{
public:
  explicit Bunzipper(std::ifstream& file)
    : Decoder(file)
  {
    start();
  }
  ~Bunzipper() override { BZ2_bzDecompressEnd(&m_stream); }

  std::optional<std::size_t> decode(char* out, std::size_t count) override
  {
    std::size_t done = 0;
    while (done < count)
    {
      if (m_stream.avail_in == 0)
      {
        m_stream.avail_in = static_cast<unsigned>(refill());
        m_stream.next_in = m_in.data();
      }
      if (m_ended)
      {
        if (m_stream.avail_in == 0 || *m_stream.next_in != 'B') // several streams in sequence
          return done;
        bz_stream rest = m_stream;
        BZ2_bzDecompressEnd(&m_stream);
        m_stream = {};
        start();
        m_stream.next_in = rest.next_in;
        m_stream.avail_in = rest.avail_in;
        m_ended = false;
      }
      const std::size_t part = std::min(count - done, std::size_t{1} << 30);
      m_stream.next_out = out + done;
      m_stream.avail_out = static_cast<unsigned>(part);
      // Without further input, as decoded bytes of a block may still be inside.
      const bool dry = m_stream.avail_in == 0;
      const int state = BZ2_bzDecompress(&m_stream);
      if (state != BZ_OK && state != BZ_STREAM_END)
        return std::nullopt;
      const std::size_t got = part - m_stream.avail_out;
      done += got;
      m_ended = state == BZ_STREAM_END;
      if (dry && got == 0 && !m_ended)
        return done;
    }
    return done;
  }

private:
  void start()
  {
    if (BZ2_bzDecompressInit(&m_stream, 0, 0) != BZ_OK)
      throw std::bad_alloc();
  }

  bz_stream m_stream{};
};

class HexReader : public VoxelStream::Decoder
{
public:
  using Decoder::Decoder;

  std::optional<std::size_t> decode(char* out, std::size_t count) override
  {
    std::size_t done = 0;
    int high = -1;
    while (done < count)
    {
      if (m_next == m_end)
      {
        m_next = 0;
        m_end = refill();
        if (m_end == 0)
        {
          m_ended = high < 0;
          return done;
        }
      }
      const char c = m_in[m_next++];
      if (c == ' ' || (c >= '\t' && c <= '\r'))
        continue;
      const int digit = c >= '0' && c <= '9'   ? c - '0'
                        : c >= 'a' && c <= 'f' ? c - 'a' + 10
                        : c >= 'A' && c <= 'F' ? c - 'A' + 10
                                               : -1;
      if (digit < 0)
        return std::nullopt;
      if (high < 0)
        high = digit;
      else
      {
        out[done++] = static_cast<char>(high << 4 | digit);
        high = -1;
      }
    }
    return done;
  }

private:
  std::size_t m_next = 0;
  std::size_t m_end = 0;
};

} // namespace

VoxelStream::VoxelStream(VoxelPlace place)
  : m_place(std::move(place))
{
  open(0);
}

VoxelStream::~VoxelStream() = default;

void VoxelStream::open(std::size_t part)
{
  m_decoder.reset();
  m_part = part;
  m_file = std::ifstream(m_place.parts[part].file, std::ios::binary);
  std::uint64_t offset = m_place.parts[part].offset;
  if (m_place.packing == Packing::None)
    offset += m_place.packedOffset;
  m_file.seekg(static_cast<std::streamoff>(offset));
  if (!m_file)
    failDamaged();
  if (m_place.packing == Packing::Zlib)
    m_decoder = std::make_unique<Inflater>(m_file);
  else if (m_place.packing == Packing::Bzip2)
    m_decoder = std::make_unique<Bunzipper>(m_file);
  else if (m_place.packing == Packing::Hex)
    m_decoder = std::make_unique<HexReader>(m_file);
  m_left = m_place.partBytes;
  if (m_decoder)
  {
    m_left += m_place.packedOffset;
    skip(m_place.packedOffset);
  }
}

void VoxelStream::read(void* out, std::size_t count)
{
  auto* next = static_cast<char*>(out);
  while (count > 0)
  {
    if (m_left == 0)
    {
      if (m_part + 1 == m_place.parts.size())
        failDamaged();
      finish({});
      open(m_part + 1);
    }
    const auto now = static_cast<std::size_t>(std::min<std::uint64_t>(count, m_left));
    if (m_decoder)
    {
      if (m_decoder->decode(next, now) != now)
        failDamaged();
    }
    else
    {
      m_file.read(next, static_cast<std::streamsize>(now));
      if (static_cast<std::size_t>(m_file.gcount()) != now)
        failDamaged();
    }
    next += now;
    count -= now;
    m_left -= now;
  }
}

void VoxelStream::skip(std::uint64_t count)
{
  std::vector<char> unused;
  while (count > 0)
  {
    if (m_left == 0 && m_part + 1 < m_place.parts.size())
    {
      finish({});
      open(m_part + 1);
    }
    std::uint64_t now = std::min(count, m_left);
    if (now == 0)
      failDamaged();
    if (m_decoder)
    {
      now = std::min<std::uint64_t>(now, kPart);
      unused.resize(kPart);
      read(unused.data(), static_cast<std::size_t>(now));
    }
    else
    {
      m_file.seekg(static_cast<std::streamoff>(now), std::ios::cur);
      m_left -= now;
    }
    count -= now;
  }
}

void VoxelStream::finish(const core::Progress& progress)
{
  if (!m_decoder)
    return;
  std::vector<char> rest(kPart);
  const std::uint64_t most = m_left + kMaxTail;
  std::uint64_t behind = 0;
  std::optional<std::size_t> count;
  do
  {
    progress.check("reading voxels");
    count = m_decoder->decode(rest.data(), rest.size());
    behind += count.value_or(0);
    if (behind > most)
      fail(FileError::Reason::Unreadable, m_place.parts[m_part].file,
           "holds far more voxels than its header says; export it again from where it came");
  } while (count == rest.size());
  if (!count || !m_decoder->isWhole())
    failDamaged();
}

void VoxelStream::failDamaged() const
{
  const std::filesystem::path& path = m_place.parts[m_part].file;
  if (m_file.bad())
    fail(FileError::Reason::Unreadable, path, "could not be read on; check the disk or network");
  fail(FileError::Reason::Unreadable, path,
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
  stream.finish(progress);
}

void swapBytes(void* numbers, std::size_t count, std::size_t numberBytes)
{
  auto* number = static_cast<char*>(numbers);
  for (std::size_t n = 0; n < count; ++n, number += numberBytes)
    std::reverse(number, number + numberBytes);
}

} // namespace petrous::imaging
