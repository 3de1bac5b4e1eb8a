#include "Thumbnail.h"

#include <algorithm>
#include <cstring>
#include <memory>
#include <string_view>

#include <libdeflate.h>

#include "LibraryFolder.h"
#include "ManifestFile.h"
#include "petrous/Library/Library.h"
#include "petrous/Library/ThumbnailAge.h"

namespace petrous::library
{

namespace fs = std::filesystem;

namespace
{

constexpr std::size_t kRowBytes = 1 + 3 * kThumbnailWidth; // with the row's filter
constexpr std::size_t kImageBytes = kRowBytes * kThumbnailHeight;

std::uint32_t number(const std::uint8_t* from)
{
  return std::uint32_t{from[0]} << 24U | std::uint32_t{from[1]} << 16U |
         std::uint32_t{from[2]} << 8U | from[3];
}

// The compressed pixels; empty unless the chunks are IHDR, IDAT (one or several) and IEND, each
// with its checksum [PNG, 2nd edition, 5 and 11.2].
std::vector<std::uint8_t> pixelsOf(const std::vector<std::uint8_t>& png)
{
  constexpr std::size_t kAround = 12; // length, type and checksum of a chunk
  constexpr std::uint8_t kHeader[] = {
      0, 0, kThumbnailWidth >> 8, kThumbnailWidth & 0xff, 0, 0, 0, kThumbnailHeight, 8, 2, 0, 0, 0};
  static_assert(kThumbnailHeight < 256);
  std::vector<std::uint8_t> pixels;
  if (png.size() > kLargestThumbnail || png.size() < 8 ||
      std::memcmp(png.data(), "\x89PNG\r\n\x1a\n", 8) != 0)
    return {};
  std::string_view before;
  for (std::size_t at = 8; at < png.size();)
  {
    if (png.size() - at < kAround)
      return {};
    const std::size_t length = number(png.data() + at);
    if (length > png.size() - at - kAround)
      return {};
    const std::uint8_t* const body = png.data() + at + 8;
    const std::string_view type(reinterpret_cast<const char*>(png.data() + at + 4), 4);
    if (libdeflate_crc32(0, png.data() + at + 4, 4 + length) != number(body + length))
      return {};
    at += kAround + length;
    if (type == "IHDR" && before.empty() && length == sizeof kHeader &&
        std::equal(body, body + length, kHeader))
      before = type;
    else if (type == "IDAT" && (before == "IHDR" || before == "IDAT"))
    {
      pixels.insert(pixels.end(), body, body + length);
      before = type;
    }
    else
      return type == "IEND" && before == "IDAT" && length == 0 && at == png.size()
                 ? pixels
                 : std::vector<std::uint8_t>();
  }
  return {};
}

} // namespace

bool isThumbnail(const std::vector<std::uint8_t>& png) noexcept
try
{
  const std::vector<std::uint8_t> packed = pixelsOf(png);
  const std::unique_ptr<libdeflate_decompressor, decltype(&libdeflate_free_decompressor)> unpacker(
      libdeflate_alloc_decompressor(), &libdeflate_free_decompressor);
  if (packed.empty() || !unpacker)
    return false;
  std::vector<std::uint8_t> rows(kImageBytes);
  std::size_t consumed = 0;
  if (libdeflate_zlib_decompress_ex(unpacker.get(), packed.data(), packed.size(), rows.data(),
                                    rows.size(), &consumed, nullptr) != LIBDEFLATE_SUCCESS ||
      consumed != packed.size())
    return false;
  constexpr std::uint8_t kFilters = 5;
  for (std::size_t row = 0; row < kThumbnailHeight; ++row)
    if (rows[row * kRowBytes] >= kFilters)
      return false;
  return true;
}
catch (const std::bad_alloc&)
{
  return false;
}

fs::path thumbnailPath(const fs::path& library, const std::string& id)
{
  constexpr std::size_t kDigits = 32;
  const auto isHex = [](char c) { return (c >= '0' && c <= '9') || (c >= 'a' && c <= 'f'); };
  if (id.size() != kDigits || !std::all_of(id.begin(), id.end(), isHex))
    return {};
  return library / kThumbnailFolder / (id + ".png");
}

std::set<std::string> thumbnailIds(const fs::path& library)
{
  std::set<std::string> ids;
  std::error_code error;
  for (fs::directory_iterator entry(library / kThumbnailFolder, error), end; !error && entry != end;
       entry.increment(error))
    if (const std::string id = entry->path().stem().string();
        thumbnailPath(library, id) == entry->path())
      ids.insert(id);
  return ids;
}

std::vector<std::uint8_t> readThumbnail(const fs::path& library, const std::string& id) noexcept
try
{
  const fs::path path = thumbnailPath(library, id);
  std::error_code error;
  if (path.empty() || !fs::is_regular_file(path, error))
    return {};
  const std::string bytes = core::readFile(path, kLargestThumbnail);
  std::vector<std::uint8_t> png(bytes.begin(), bytes.end());
  return isThumbnail(png) ? png : std::vector<std::uint8_t>();
}
catch (const std::exception&) // a picture that cannot be read is none
{
  return {};
}

void writeThumbnail(const fs::path& library, const std::string& id,
                    const std::vector<std::uint8_t>& png)
try
{
  makeFolder(library / kThumbnailFolder);
  removeLeftovers(library / kThumbnailFolder);
  core::writeFile(thumbnailPath(library, id),
                  std::string_view(reinterpret_cast<const char*>(png.data()), png.size()));
}
catch (const core::OutputFileError& error)
{
  throw libraryError(error, "the thumbnail is as it was");
}

std::vector<std::uint8_t> Library::thumbnail(const CaseSummary& summary) const
{
  return readThumbnail(m_folder, summary.id);
}

std::vector<std::uint8_t> Library::thumbnail(const std::string& name) const
{
  scene::checkCaseName(name);
  checkedManifestPath(name);
  return readThumbnail(m_folder, readManifest(name).id);
}

bool needsThumbnail(const Library& library, const CaseSummary& summary) noexcept
try
{
  const fs::path& folder = library.folder();
  const fs::path picture = thumbnailPath(folder, summary.id);
  std::error_code error;
  if (summary.damaged || picture.empty())
    return false;
  const auto drawn = fs::last_write_time(picture, error);
  const bool isDrawn = !error;
  const auto saved = fs::last_write_time(folder / "cases" / (summary.name + ".json"), error);
  return (!isDrawn || (!error && saved > drawn)) &&
         journalOf(folder, summary.name, summary.id).empty();
}
catch (const std::exception&)
{
  return false;
}

void Library::setThumbnail(const std::string& name, const std::vector<std::uint8_t>& png)
{
  scene::checkCaseName(name);
  if (!isThumbnail(png))
    throw core::InvalidParameter("thumbnail: must be a PNG of " + std::to_string(kThumbnailWidth) +
                                 " x " + std::to_string(kThumbnailHeight) +
                                 " pixels, RGB, without metadata");
  checkedManifestPath(name);
  const core::FileLock lock = lockForWriting();
  checkedManifestPath(name);
  const std::string id = readManifest(name).id;
  if (thumbnailPath(m_folder, id).empty())
    throw core::InvalidParameter("case '" + name +
                                 "' is of a first version of this program and has no id, by which "
                                 "a thumbnail goes; a copy of it has ('petrous library copy')");
  writeThumbnail(m_folder, id, png);
}

} // namespace petrous::library
