#include "petrous/Library/DerivedCache.h"

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <cstring>
#include <memory>
#include <system_error>

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <zstd.h>

#include "petrous/Core/InputFile.h"
#include "petrous/Core/OutputFile.h"
#include "petrous/Library/ObjectStore.h"

namespace petrous::library
{

namespace fs = std::filesystem;

namespace
{

using Bytes = core::DerivedStore::Bytes;

// A file is one zstd frame with checksum; decompressed: the bytes, the key, u32 length of the key
// (little endian).
constexpr const char* kEnding = ".derived";
constexpr int kLevel = 1;
constexpr std::size_t kLengthBytes = 4;
constexpr unsigned long long kMaxBytes = 1ULL << 32;
constexpr std::chrono::hours kLeftover{1};
constexpr std::uintmax_t kShareOfDisk = 10; // a file may use at most a tenth of the free space

std::string packed(const std::string& key, const Bytes& bytes)
{
  Bytes raw(bytes);
  raw.insert(raw.end(), key.begin(), key.end());
  for (std::size_t byte = 0; byte < kLengthBytes; ++byte)
    raw.push_back(static_cast<std::uint8_t>(key.size() >> (8 * byte)));
  const std::unique_ptr<ZSTD_CCtx, decltype(&ZSTD_freeCCtx)> context(ZSTD_createCCtx(),
                                                                     &ZSTD_freeCCtx);
  if (!context)
    return {};
  ZSTD_CCtx_setParameter(context.get(), ZSTD_c_compressionLevel, kLevel);
  ZSTD_CCtx_setParameter(context.get(), ZSTD_c_checksumFlag, 1);
  std::string frame(ZSTD_compressBound(raw.size()), '\0');
  const std::size_t size =
      ZSTD_compress2(context.get(), frame.data(), frame.size(), raw.data(), raw.size());
  frame.resize(ZSTD_isError(size) ? 0 : size);
  return frame;
}

std::optional<Bytes> unpacked(const std::string& key, const std::string& frame)
{
  const unsigned long long size = ZSTD_getFrameContentSize(frame.data(), frame.size());
  if (size == ZSTD_CONTENTSIZE_ERROR || size == ZSTD_CONTENTSIZE_UNKNOWN || size > kMaxBytes ||
      size < key.size() + kLengthBytes)
    return std::nullopt;
  Bytes raw(static_cast<std::size_t>(size));
  if (ZSTD_decompress(raw.data(), raw.size(), frame.data(), frame.size()) != raw.size())
    return std::nullopt;
  std::size_t length = 0;
  for (std::size_t byte = 0; byte < kLengthBytes; ++byte)
    length |= std::size_t{raw[raw.size() - kLengthBytes + byte]} << (8 * byte);
  const std::size_t end = raw.size() - kLengthBytes - key.size();
  if (length != key.size() || std::memcmp(raw.data() + end, key.data(), key.size()) != 0)
    return std::nullopt;
  raw.resize(end);
  return raw;
}

struct Entry
{
  fs::path path;
  fs::file_time_type used;
  std::uintmax_t bytes;
  bool temporary;
};

std::vector<Entry> entriesOf(const fs::path& folder)
{
  std::vector<Entry> entries;
  std::error_code error;
  for (fs::directory_iterator at(folder, error), end; !error && at != end; at.increment(error))
  {
    // Another program may remove it concurrently.
    std::error_code gone;
    const auto used = at->last_write_time(gone);
    const std::uintmax_t bytes = gone ? 0 : at->file_size(gone);
    const bool temporary = core::isLeftover(at->path());
    if (!gone && (temporary || at->path().extension() == kEnding))
      entries.push_back({at->path(), used, bytes, temporary});
  }
  return entries;
}

} // namespace

fs::path derivedFolder(const fs::path& library)
{
  return library / "derived";
}

std::unique_ptr<core::DerivedStore> scanCache()
{
  constexpr std::uintmax_t kScans = std::uintmax_t{256} << 20;
  const auto folderFrom = [](const char* name)
  {
    const char* value = std::getenv(name);
    const fs::path path(value ? value : "");
    return path.is_absolute() ? path : fs::path();
  };
  fs::path folder = folderFrom("XDG_CACHE_HOME");
  if (folder.empty() && !folderFrom("HOME").empty())
    folder = folderFrom("HOME") / ".cache";
  if (folder.empty())
    return nullptr;
  std::error_code error; // then nothing is cached
  fs::create_directories(folder / "petrous", error);
  return std::make_unique<DerivedCache>(folder / "petrous" / "scans", kScans);
}

DerivedCache::DerivedCache(fs::path folder, std::uintmax_t limit)
  : m_folder(std::move(folder))
  , m_limit(limit)
{
}

fs::path DerivedCache::fileOf(const std::string& key) const
{
  return m_folder /
         (sha256Of(reinterpret_cast<const std::uint8_t*>(key.data()), key.size()) + kEnding);
}

std::optional<Bytes> DerivedCache::find(const std::string& key) noexcept
{
  try
  {
    const fs::path path = fileOf(key);
    auto bytes = unpacked(key, core::readFile(path));
    if (bytes)
      ::utimensat(AT_FDCWD, path.c_str(), nullptr, 0); // mark as used
    else
      ::unlink(path.c_str());
    return bytes;
  }
  catch (...) // missing, or out of memory: recomputed by the caller
  {
    return std::nullopt;
  }
}

void DerivedCache::put(const std::string& key, const Bytes& bytes) noexcept
{
  try
  {
    std::error_code error;
    fs::create_directory(m_folder, error); // only within an existing library
    // Cases have priority in disk space.
    const fs::space_info space = fs::space(m_folder, error);
    if (error || ::access(m_folder.c_str(), W_OK) != 0 ||
        bytes.size() + key.size() + kLengthBytes > kMaxBytes)
      return;
    const std::string frame = packed(key, bytes);
    if (frame.empty() || frame.size() > std::min(m_limit, space.available / kShareOfDisk))
      return;
    core::writeFile(fileOf(key), frame);
    prune(m_limit);
  }
  catch (...)
  {
    return;
  }
}

std::uintmax_t DerivedCache::bytes() const noexcept
{
  try
  {
    std::uintmax_t sum = 0;
    for (const Entry& entry : entriesOf(m_folder))
      sum += entry.bytes;
    return sum;
  }
  catch (...)
  {
    return 0;
  }
}

std::uintmax_t DerivedCache::prune(std::uintmax_t most) noexcept
{
  std::uintmax_t freed = 0;
  try
  {
    std::vector<Entry> entries = entriesOf(m_folder);
    std::sort(entries.begin(), entries.end(),
              [](const Entry& a, const Entry& b) { return a.used < b.used; });
    std::uintmax_t sum = 0;
    for (const Entry& entry : entries)
      sum += entry.bytes;
    const auto now = fs::file_time_type::clock::now();
    for (const Entry& entry : entries)
    {
      // Files being written by another program are left alone.
      if (entry.temporary ? now - entry.used < kLeftover : sum <= most)
        continue;
      std::error_code error;
      if (!fs::remove(entry.path, error))
        continue;
      sum -= entry.bytes;
      freed += entry.bytes;
    }
  }
  catch (...)
  {
    return freed;
  }
  return freed;
}

} // namespace petrous::library
