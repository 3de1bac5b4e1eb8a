#include "ZipEntries.h"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <set>

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include "LibraryFolder.h"
#include "petrous/Core/NumberText.h"

namespace petrous::library
{

namespace fs = std::filesystem;

namespace
{

constexpr std::uint64_t kMostEntries = 1'000'000;
/// Deflate codes at most 258 bytes in 2 bits; the rest is for tiny entries' headers.
constexpr std::uint64_t kMostRatio = 1032;
constexpr std::uint64_t kSlack = 4096;

/// What of an entry's name cannot be trusted, or nothing.
const char* unsafe(const std::string& name)
{
  if (name.empty() || name.size() > 1024)
    return "a name of no or too many bytes";
  if (name.front() == '/' || name.find('\\') != name.npos || name.find(':') != name.npos)
    return "a name that is no relative path";
  for (std::size_t from = 0; from <= name.size();)
  {
    const std::size_t to = std::min(name.find('/', from), name.size());
    const std::string part = name.substr(from, to - from);
    if (part == ".." || part == "." || (part.empty() && to != name.size()))
      return "a name that leads out of its folder";
    from = to + 1;
  }
  if (std::any_of(name.begin(), name.end(),
                  [](char c) { return static_cast<unsigned char>(c) < 32; }))
    return "control characters in a name";
  return nullptr;
}

} // namespace

void throwUnsound(const fs::path& file, const std::string& what)
{
  throw LibraryError(LibraryError::Reason::Damaged,
                     core::printable(file) + ": is not a sound archive of a case: " + what +
                         "; nothing was restored; get the file again from where it was made");
}

struct ZipWriter::Entry
{
  ZipWriter& writer;
  std::function<Produce()> begin;
  Produce produce;
  zip_error_t error;
};

ZipWriter::ZipWriter(const fs::path& path, const fs::path& staging)
  : m_path(core::outputTarget(path))
  , m_temporary(staging / "archive")
{
  int error = 0;
  m_zip = zip_open(m_temporary.c_str(), ZIP_CREATE | ZIP_EXCL, &error);
  if (!m_zip)
    core::throwOutputError(errno, path);
}

ZipWriter::~ZipWriter()
{
  if (m_zip)
    zip_discard(m_zip);
  ::unlink(m_temporary.c_str());
}

zip_int64_t ZipWriter::read(void* data, void* buffer, zip_uint64_t size, zip_source_cmd_t command)
{
  auto& entry = *static_cast<Entry*>(data);
  try
  {
    switch (command)
    {
    case ZIP_SOURCE_OPEN:
      entry.produce = entry.begin();
      return 0;
    case ZIP_SOURCE_READ:
      return static_cast<zip_int64_t>(entry.produce(static_cast<char*>(buffer), size));
    case ZIP_SOURCE_CLOSE:
      entry.produce = nullptr;
      return 0;
    case ZIP_SOURCE_STAT:
      zip_stat_init(static_cast<zip_stat_t*>(buffer));
      return sizeof(zip_stat_t);
    case ZIP_SOURCE_ERROR:
      return zip_error_to_data(&entry.error, buffer, size);
    case ZIP_SOURCE_FREE:
      zip_error_fini(&entry.error);
      delete &entry;
      return 0;
    case ZIP_SOURCE_SUPPORTS:
      return zip_source_make_command_bitmap(ZIP_SOURCE_OPEN, ZIP_SOURCE_READ, ZIP_SOURCE_CLOSE,
                                            ZIP_SOURCE_STAT, ZIP_SOURCE_ERROR, ZIP_SOURCE_FREE, -1);
    default:
      zip_error_set(&entry.error, ZIP_ER_OPNOTSUPP, 0);
      return -1;
    }
  }
  catch (...) // not through libzip's C code
  {
    entry.writer.m_failure = std::current_exception();
    zip_error_set(&entry.error, ZIP_ER_READ, EIO);
    return -1;
  }
}

void ZipWriter::add(const std::string& name, bool deflate, std::function<Produce()> begin)
{
  auto entry = std::make_unique<Entry>(Entry{*this, std::move(begin), nullptr, {}});
  zip_error_init(&entry->error);
  zip_source_t* source = zip_source_function(m_zip, &ZipWriter::read, entry.get());
  if (!source)
    throw std::bad_alloc();
  entry.release(); // by ZIP_SOURCE_FREE
  const zip_int64_t index = zip_file_add(m_zip, name.c_str(), source, ZIP_FL_ENC_UTF_8);
  if (index < 0)
  {
    zip_source_free(source);
    throw core::InvalidParameter("zip entry '" + name + "': is there already");
  }
  const auto at = static_cast<zip_uint64_t>(index);
  zip_set_file_compression(m_zip, at, deflate ? ZIP_CM_DEFLATE : ZIP_CM_STORE, deflate ? 6 : 0);
  // Equal cases give equal archives, and the time of archiving tells nothing.
  zip_file_set_dostime(m_zip, at, 0, 0x21, 0); // 1980-01-01
}

bool ZipWriter::commit(const core::Progress& progress)
{
  struct Listener
  {
    ZipWriter& writer;
    const core::Progress& progress;
    double fraction = 0.0;
  } listener{*this, progress};
  zip_register_progress_callback_with_state(
      m_zip, 1e-3,
      [](zip_t*, double fraction, void* data)
      { static_cast<Listener*>(data)->fraction = fraction; },
      nullptr, &listener);
  zip_register_cancel_callback_with_state(
      m_zip,
      [](zip_t*, void* data)
      {
        auto& own = *static_cast<Listener*>(data);
        try
        {
          own.progress.report(own.fraction, "archiving");
          return 0;
        }
        catch (...)
        {
          own.writer.m_failure = std::current_exception();
          return 1;
        }
      },
      nullptr, &listener);
  const bool closed = zip_close(m_zip) == 0;
  if (!closed)
  {
    zip_error_t* error = zip_get_error(m_zip);
    const int system =
        zip_error_system_type(error) == ZIP_ET_SYS ? zip_error_code_system(error) : EIO;
    zip_discard(m_zip);
    m_zip = nullptr;
    if (m_failure)
      std::rethrow_exception(m_failure);
    core::throwOutputError(system != 0 ? system : EIO, m_path);
  }
  m_zip = nullptr;
  const int file = ::open(m_temporary.c_str(), O_RDONLY | O_CLOEXEC);
  const bool synced = file >= 0 && ::fsync(file) == 0;
  const int error = errno;
  if (file >= 0)
    ::close(file);
  if (!synced)
    core::throwOutputError(error, m_path);
  if (::rename(m_temporary.c_str(), m_path.c_str()) != 0)
    core::throwOutputError(errno, m_path);
  return core::syncFolder(m_path.parent_path());
}

ZipReader::ZipReader(const fs::path& path)
  : m_path(path)
{
  try
  {
    core::InputFile{path}; // a regular file, and allowed to be read
  }
  catch (const core::InputFileError& error)
  {
    throw libraryError(error);
  }
  int error = 0;
  m_zip.reset(zip_open(path.c_str(), ZIP_RDONLY | ZIP_CHECKCONS, &error));
  if (!m_zip)
    throwUnsound(path, error == ZIP_ER_NOZIP    ? "it is no zip file, or is cut short"
                       : error == ZIP_ER_INCONS ? "its directory contradicts its entries"
                       : error == ZIP_ER_EXISTS ? "it has two entries of one name"
                                                : "it cannot be read");
  const zip_int64_t count = zip_get_num_entries(m_zip.get(), 0);
  if (count < 0 || static_cast<std::uint64_t>(count) > kMostEntries)
    throwUnsound(path, "it has more entries than a case can have");
  for (zip_uint64_t n = 0; n < static_cast<zip_uint64_t>(count); ++n)
  {
    const std::string which = "entry " + std::to_string(n + 1);
    zip_stat_t state;
    zip_stat_init(&state);
    constexpr zip_uint64_t kWanted = ZIP_STAT_NAME | ZIP_STAT_SIZE | ZIP_STAT_COMP_SIZE |
                                     ZIP_STAT_COMP_METHOD | ZIP_STAT_ENCRYPTION_METHOD;
    if (zip_stat_index(m_zip.get(), n, 0, &state) != 0 || (state.valid & kWanted) != kWanted)
      throwUnsound(path, which + " is not described completely");
    const std::string name = state.name;
    if (const char* why = unsafe(name))
      throwUnsound(path, which + " has " + why);
    if (state.encryption_method != ZIP_EM_NONE)
      throwUnsound(path, which + " is encrypted");
    if (state.comp_method != ZIP_CM_STORE && state.comp_method != ZIP_CM_DEFLATE)
      throwUnsound(path, which + " is compressed by an unknown method");
    zip_uint8_t system = 0;
    zip_uint32_t attributes = 0;
    zip_file_get_external_attributes(m_zip.get(), n, 0, &system, &attributes);
    const std::uint32_t mode = (attributes >> 16) & S_IFMT;
    const bool folder = name.back() == '/';
    if (system == ZIP_OPSYS_UNIX && mode != 0 && mode != S_IFREG && !(folder && mode == S_IFDIR))
      throwUnsound(path, which + " is a link or a device");
    if (folder && state.size != 0)
      throwUnsound(path, which + " is a folder with content");
    if ((state.comp_method == ZIP_CM_STORE && state.size != state.comp_size) ||
        state.size / kMostRatio > state.comp_size + kSlack / kMostRatio)
      throwUnsound(path, which + " states a size that it cannot have");
    if (folder)
      continue;
    if (!m_entries.try_emplace(name, Entry{n, state.size, state.comp_size}).second)
      throwUnsound(path, "it has two entries of one name");
  }
}

ZipReader::Stream::Stream(const ZipReader& zip, const std::string& name)
  : m_path(&zip.m_path)
  , m_name(name)
  , m_file(nullptr, &zip_fclose)
{
  const auto entry = zip.m_entries.find(name);
  if (entry == zip.m_entries.end())
    throwUnsound(*m_path, "it lacks '" + name + "'");
  m_file.reset(zip_fopen_index(zip.m_zip.get(), entry->second.index, 0));
  if (!m_file)
    throwUnsound(*m_path, "'" + name + "' cannot be read");
}

std::size_t ZipReader::Stream::read(char* buffer, std::size_t count)
{
  std::size_t done = 0;
  while (done < count)
  {
    const zip_int64_t got = zip_fread(m_file.get(), buffer + done, count - done);
    if (got < 0)
      throwUnsound(*m_path, "'" + m_name + "' is damaged");
    if (got == 0)
      break;
    done += static_cast<std::size_t>(got);
  }
  return done;
}

std::string ZipReader::text(const std::string& name, std::uint64_t limit) const
{
  Stream stream = open(name);
  const std::uint64_t bytes = m_entries.at(name).bytes;
  if (bytes > limit)
    throwUnsound(m_path, "'" + name + "' is larger than any that this program writes");
  std::string text(bytes, '\0');
  char end = 0;
  if (stream.read(text.data(), text.size()) != text.size() || stream.read(&end, 1) != 0)
    throwUnsound(m_path, "'" + name + "' has not the size that it states");
  return text;
}

} // namespace petrous::library
