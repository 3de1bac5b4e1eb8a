#include "OutputFile.h"

#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <memory>
#include <vector>

#include <fcntl.h>
#include <itk_zlib.h>
#include <sys/stat.h>
#include <unistd.h>

#include "FileHelpers.h"

namespace petrous::imaging
{

namespace
{
constexpr std::size_t kPart = std::size_t{4} << 20;
// Levels above cost twice the time for a few per cent on CT voxels.
constexpr int kLevel = 5;
constexpr int kGzipWindow = 15 + 16; // zlib: 32 KiB window, gzip header and trailer

mode_t creationMask()
{
  // The mask can only be read by setting it, which other threads would see; the kernel tells it.
  const int file = open("/proc/self/status", O_RDONLY | O_CLOEXEC);
  std::string text(4096, '\0');
  const ssize_t count = file < 0 ? 0 : read(file, text.data(), text.size());
  if (file >= 0)
    close(file);
  text.resize(static_cast<std::size_t>(std::max<ssize_t>(count, 0)));
  const std::size_t at = text.find("Umask:");
  return at == text.npos ? 022
                         : static_cast<mode_t>(std::strtoul(text.c_str() + at + 6, nullptr, 8));
}
} // namespace

OutputFile::OutputFile(const std::filesystem::path& path)
  : m_path(path)
{
  std::filesystem::path folder = path.parent_path();
  if (folder.empty())
    folder = ".";
  std::error_code error;
  if (!std::filesystem::is_directory(folder, error))
    fail(FileError::Reason::Unwritable, path, "its folder is not there; make the folder first");
  if (std::filesystem::is_directory(path, error))
    fail(FileError::Reason::Unwritable, path, "is a folder; name a file in it");
  m_temporary = (folder / ".petrous-XXXXXX").string();
  m_descriptor = mkostemp(m_temporary.data(), O_CLOEXEC);
  if (m_descriptor < 0)
    failWriting("made", errno);
  fchmod(m_descriptor, 0666 & ~creationMask());
}

OutputFile::~OutputFile()
{
  if (m_descriptor < 0)
    return;
  close(m_descriptor);
  unlink(m_temporary.c_str());
}

void OutputFile::write(const void* bytes, std::size_t count)
{
  const auto* next = static_cast<const char*>(bytes);
  while (count > 0)
  {
    const ssize_t written = ::write(m_descriptor, next, std::min(count, std::size_t{1} << 30));
    if (written < 0 && errno == EINTR)
      continue;
    if (written <= 0)
      failWriting("written", written < 0 ? errno : ENOSPC);
    next += written;
    count -= static_cast<std::size_t>(written);
  }
}

void OutputFile::commit()
{
  if (fsync(m_descriptor) != 0)
    failWriting("written", errno);
  if (rename(m_temporary.c_str(), m_path.c_str()) != 0)
    failWriting("put in place", errno);
  close(m_descriptor);
  m_descriptor = -1;
  // The new name must survive a power failure too. Some file systems cannot sync a folder.
  const std::filesystem::path folder = m_path.parent_path();
  const int handle =
      open(folder.empty() ? "." : folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (handle >= 0)
  {
    fsync(handle);
    close(handle);
  }
}

void OutputFile::writeVoxels(const void* bytes, std::size_t count, const core::Progress& progress)
{
  const auto* data = static_cast<const char*>(bytes);
  for (std::size_t done = 0; done < count; done += kPart)
  {
    progress.report(static_cast<double>(done) / static_cast<double>(count), "writing voxels");
    write(data + done, std::min(kPart, count - done));
  }
}

void OutputFile::writeCompressed(std::string_view first, const void* bytes, std::size_t count,
                                 const core::Progress& progress)
{
  z_stream stream{};
  if (deflateInit2(&stream, kLevel, Z_DEFLATED, kGzipWindow, 8, Z_DEFAULT_STRATEGY) != Z_OK)
    failWriting("written", ENOMEM);
  const std::unique_ptr<z_stream, int (*)(z_stream*)> closer(&stream, deflateEnd);
  std::vector<Bytef> out(std::size_t{1} << 18);
  const auto feed = [&](const void* data, std::size_t size, int flush)
  {
    stream.next_in = static_cast<Bytef*>(const_cast<void*>(data)); // zlib only reads it
    stream.avail_in = static_cast<uInt>(size);
    do
    {
      stream.next_out = out.data();
      stream.avail_out = static_cast<uInt>(out.size());
      deflate(&stream, flush);
      write(out.data(), out.size() - stream.avail_out);
    } while (stream.avail_out == 0);
  };
  feed(first.data(), first.size(), Z_NO_FLUSH);
  const auto* data = static_cast<const char*>(bytes);
  for (std::size_t done = 0; done < count; done += kPart)
  {
    progress.report(static_cast<double>(done) / static_cast<double>(count), "compressing voxels");
    feed(data + done, std::min(kPart, count - done), Z_NO_FLUSH);
  }
  feed(nullptr, 0, Z_FINISH);
}

void OutputFile::failWriting(const char* step, int error) const
{
  const std::string start = std::string("cannot be ") + step;
  switch (error)
  {
  case ENOSPC:
  case EDQUOT:
    fail(FileError::Reason::Unwritable, m_path, start + ", the disk is full; free some space",
         core::Fault::Refused);
  case EACCES:
  case EPERM:
  case EROFS:
    fail(FileError::Reason::Unwritable, m_path,
         start + ", its folder may not be written to; choose another or allow writing",
         core::Fault::Refused);
  case EFBIG:
    fail(FileError::Reason::Unwritable, m_path,
         start + ", it is larger than this disk or user may hold; choose another disk",
         core::Fault::Refused);
  case ENAMETOOLONG:
    fail(FileError::Reason::Unwritable, m_path, start + ", the name is too long; shorten it",
         core::Fault::Refused);
  default:
    fail(FileError::Reason::Unwritable, m_path,
         start + " (system error " + std::to_string(error) + "); check the disk",
         core::Fault::Refused);
  }
}

} // namespace petrous::imaging
