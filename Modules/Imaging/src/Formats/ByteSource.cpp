#include "ByteSource.h"

#include <algorithm>
#include <cerrno>
#include <cstring>

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>
#include <zlib.h>

namespace petrous::imaging
{

namespace
{

constexpr std::size_t kFirstWindow = 4096;            // the header of most single slices
constexpr std::size_t kWindow = 16384;                // what follows of longer ones
constexpr std::size_t kLargestInflated = 256UL << 20; // bytes; a slice of 8192^2 and its header
constexpr std::size_t kLargestDeflated = kLargestInflated;

} // namespace

FileStamp stampOf(const struct stat& status)
{
  const auto ns = [](const struct timespec& time)
  { return static_cast<std::int64_t>(time.tv_sec) * 1'000'000'000 + time.tv_nsec; };
  return {static_cast<std::uint64_t>(status.st_dev), static_cast<std::uint64_t>(status.st_ino),
          static_cast<std::uint64_t>(status.st_size), ns(status.st_mtim), ns(status.st_ctim)};
}

bool sameContents(const FileStamp& a, const FileStamp& b)
{
  return a.device == b.device && a.inode == b.inode && a.size == b.size && a.modified == b.modified;
}

ByteSource::ByteSource(const std::filesystem::path& file)
  : m_descriptor(::open(file.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC)) // a pipe would block
{
  struct stat status = {};
  if (m_descriptor < 0)
    return;
  if (::fstat(m_descriptor, &status) == 0 && S_ISREG(status.st_mode))
  {
    m_size = static_cast<std::uint64_t>(status.st_size);
    m_stamp = stampOf(status);
    return;
  }
  ::close(m_descriptor);
  m_descriptor = -1;
}

ByteSource::~ByteSource()
{
  if (m_descriptor >= 0)
    ::close(m_descriptor);
}

bool ByteSource::isUnchanged() const
{
  struct stat status = {};
  return ::fstat(m_descriptor, &status) == 0 && sameContents(stampOf(status), m_stamp);
}

bool ByteSource::read(std::uint64_t offset, void* bytes, std::size_t count)
{
  if (offset > m_size || count > m_size - offset)
    return false;
  if (count == 0)
    return true; // `bytes` may be null, which memcpy does not permit
  if (!m_memory.empty())
  {
    std::memcpy(bytes, m_memory.data() + offset, count);
    return true;
  }
  auto* target = static_cast<unsigned char*>(bytes);
  while (count > 0)
  {
    const ssize_t got = ::pread(m_descriptor, target, count, static_cast<off_t>(offset));
    if (got < 0 && errno == EINTR)
      continue;
    if (got <= 0)
    {
      m_hasFailed = true;
      return false;
    }
    target += got;
    offset += static_cast<std::uint64_t>(got);
    count -= static_cast<std::size_t>(got);
  }
  return true;
}

bool ByteSource::readNear(std::uint64_t offset, void* bytes, std::size_t count)
{
  if (count == 0 || count > kWindow || !m_memory.empty())
    return read(offset, bytes, count);
  if (offset > m_size || count > m_size - offset)
    return false;
  if (offset < m_windowStart || offset + count > m_windowStart + m_window.size())
  {
    const std::size_t window = m_window.empty() ? std::max(kFirstWindow, count) : kWindow;
    m_window.resize(static_cast<std::size_t>(std::min<std::uint64_t>(window, m_size - offset)));
    m_windowStart = offset;
    if (!read(offset, m_window.data(), m_window.size()))
    {
      m_window.clear();
      return false;
    }
  }
  std::memcpy(bytes, m_window.data() + (offset - m_windowStart), count);
  return true;
}

bool ByteSource::inflateFrom(std::uint64_t start)
{
  if (start >= m_size || m_size > kLargestDeflated)
    return false;
  std::vector<unsigned char> packed(static_cast<std::size_t>(m_size));
  if (!read(0, packed.data(), packed.size()))
    return false;

  std::vector<unsigned char> plain(packed.begin(),
                                   packed.begin() + static_cast<std::ptrdiff_t>(start));
  z_stream stream = {};
  if (inflateInit2(&stream, -MAX_WBITS) != Z_OK) // negative: raw DEFLATE, no zlib header
    return false;
  stream.next_in = packed.data() + start;
  stream.avail_in = static_cast<uInt>(packed.size() - start);
  int state = Z_OK;
  while (state == Z_OK && plain.size() < kLargestInflated)
  {
    const std::size_t filled = plain.size();
    plain.resize(filled + (1UL << 20));
    stream.next_out = plain.data() + filled;
    stream.avail_out = 1U << 20;
    state = inflate(&stream, Z_NO_FLUSH);
    plain.resize(plain.size() - stream.avail_out);
  }
  inflateEnd(&stream);
  if (state != Z_STREAM_END)
    return false;
  m_memory = std::move(plain);
  m_size = m_memory.size();
  return true;
}

} // namespace petrous::imaging
