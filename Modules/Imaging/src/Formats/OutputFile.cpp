#include "OutputFile.h"

#include <algorithm>
#include <memory>
#include <new>
#include <vector>

#include <itk_zlib.h>

#include "FileHelpers.h"

namespace petrous::imaging
{

namespace
{
constexpr std::size_t kPart = std::size_t{4} << 20;
// Higher levels take twice the time for a few per cent on CT voxels.
constexpr int kLevel = 5;
constexpr int kGzipWindow = 15 + 16; // zlib: 32 KiB window, gzip header and trailer

template <class Action>
auto inFileErrors(const Action& action)
{
  try
  {
    return action();
  }
  catch (const core::OutputFileError& error)
  {
    throw FileError(FileError::Reason::Unwritable, error.what(), error.fault());
  }
}
} // namespace

OutputFile::OutputFile(const std::filesystem::path& path)
  : m_file(inFileErrors([&] { return core::OutputFile(path); }))
{
}

void OutputFile::write(const void* bytes, std::size_t count)
{
  inFileErrors([&] { m_file.write(bytes, count); });
}

void OutputFile::commit()
{
  inFileErrors([&] { m_file.commit(); });
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
    throw std::bad_alloc();
  const std::unique_ptr<z_stream, int (*)(z_stream*)> closer(&stream, deflateEnd);
  std::vector<Bytef> out(std::size_t{1} << 18);
  const auto feed = [&](const void* data, std::size_t size, int flush)
  {
    stream.next_in = static_cast<Bytef*>(const_cast<void*>(data)); // zlib does not write to it
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

} // namespace petrous::imaging
