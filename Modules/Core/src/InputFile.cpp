#include "petrous/Core/InputFile.h"

#include <algorithm>
#include <cerrno>
#include <utility>

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

namespace petrous::core
{

namespace
{

using Reason = InputFileError::Reason;

[[noreturn]] void failOpening(int error, const std::filesystem::path& path)
{
  switch (error)
  {
  case ENOENT:
  case ENOTDIR:
    throw InputFileError(Reason::NotFound, path, "there is no such file; check the name");
  case EACCES:
  case EPERM:
    throw InputFileError(Reason::Denied, path, "may not be opened; allow reading it");
  case ENXIO: // a socket
    throw InputFileError(Reason::NotRegular, path, "is not a regular file; name one");
  default:
    throw InputFileError(Reason::Unreadable, path,
                         "cannot be opened (system error " + std::to_string(error) + ")");
  }
}

void checkRegular(const struct stat& status, const std::filesystem::path& path)
{
  if (S_ISDIR(status.st_mode))
    throw InputFileError(Reason::NotRegular, path, "is a folder; name a file in it");
  if (S_ISFIFO(status.st_mode))
    throw InputFileError(Reason::NotRegular, path,
                         "is a named pipe and not a regular file; save the data to a file first");
  if (!S_ISREG(status.st_mode))
    throw InputFileError(Reason::NotRegular, path,
                         "is a device or socket and not a regular file; name a file");
}

std::string sizeText(std::uintmax_t bytes)
{
  static constexpr const char* kUnits[] = {"bytes", "KiB", "MiB", "GiB", "TiB"};
  std::size_t unit = 0;
  for (; bytes >= 10240 && unit + 1 < std::size(kUnits); ++unit)
    bytes /= 1024;
  return std::to_string(bytes) + ' ' + kUnits[unit];
}

} // namespace

std::string printable(const std::filesystem::path& path)
{
  std::string text = path.string();
  std::replace_if(
      text.begin(), text.end(), [](unsigned char c) { return c < 32 || c == 127; }, '?');
  return text;
}

InputFileError::InputFileError(Reason why, const std::filesystem::path& path,
                               const std::string& what)
  : InvalidParameter(printable(path) + ": " + what)
  , reason(why)
  , problem(what)
{
}

InputFile::InputFile(const std::filesystem::path& path, std::uintmax_t limit)
  : m_path(path)
{
  // Stat before open: opening a device can have side effects.
  struct stat status = {};
  if (::stat(path.c_str(), &status) != 0)
    failOpening(errno, path);
  checkRegular(status, path);
  m_descriptor = ::open(path.c_str(), O_RDONLY | O_NONBLOCK | O_NOCTTY | O_CLOEXEC);
  if (m_descriptor < 0)
    failOpening(errno, path);
  try
  {
    if (::fstat(m_descriptor, &status) != 0)
      failOpening(errno, path);
    checkRegular(status, path);
    m_size = static_cast<std::uintmax_t>(status.st_size);
    if (m_size > limit)
      throw InputFileError(Reason::TooLarge, path,
                           "holds " + sizeText(m_size) + ", more than the " + sizeText(limit) +
                               " that such a file may have");
  }
  catch (...)
  {
    ::close(m_descriptor);
    throw;
  }
}

InputFile::~InputFile()
{
  if (m_descriptor >= 0)
    ::close(m_descriptor);
}

InputFile::InputFile(InputFile&& other) noexcept
  : m_path(std::move(other.m_path))
  , m_descriptor(std::exchange(other.m_descriptor, -1))
  , m_size(other.m_size)
{
}

InputFile& InputFile::operator=(InputFile&& other) noexcept
{
  std::swap(m_path, other.m_path);
  std::swap(m_descriptor, other.m_descriptor);
  std::swap(m_size, other.m_size);
  return *this;
}

std::string InputFile::read(std::uintmax_t count) const
{
  std::string bytes(static_cast<std::size_t>(std::min(count, m_size)), '\0');
  std::size_t done = 0;
  while (done < bytes.size())
  {
    const ssize_t got =
        ::pread(m_descriptor, &bytes[done], bytes.size() - done, static_cast<off_t>(done));
    if (got < 0 && errno == EINTR)
      continue;
    if (got <= 0)
      throw InputFileError(Reason::Unreadable, m_path,
                           "broke off while it was read; check the disk");
    done += static_cast<std::size_t>(got);
  }
  return bytes;
}

std::string readFile(const std::filesystem::path& path, std::uintmax_t limit)
{
  return InputFile(path, limit).read();
}

std::ifstream openInput(const std::filesystem::path& path, std::uintmax_t limit)
{
  const InputFile checked(path, limit);
  std::ifstream stream(path, std::ios::binary);
  if (!stream)
    throw InputFileError(Reason::Denied, path, "may not be opened; allow reading it");
  return stream;
}

} // namespace petrous::core
