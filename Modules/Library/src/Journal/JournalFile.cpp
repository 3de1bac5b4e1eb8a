#include "JournalFile.h"

#include <cerrno>
#include <chrono>
#include <fstream>
#include <limits>
#include <utility>

#include <fcntl.h>
#include <nlohmann/json.hpp>
#include <sys/stat.h>
#include <unistd.h>

#include "LibraryFolder.h"
#include "petrous/Core/OpenedLock.h"
#include "petrous/Core/WriteAll.h"
#include "petrous/Library/LibraryError.h"
#include "petrous/Library/ObjectStore.h"
#include "petrous/Scene/HistoryText.h"

namespace petrous::library
{

namespace fs = std::filesystem;

namespace
{

using nlohmann::json;

// Frame: u64 length of the rest, its SHA-256 in hexadecimal, then the rest: kind, u32 length of the
// text, text, bytes. Little endian.
constexpr std::size_t kHash = 64;
constexpr std::size_t kBefore = 8 + kHash;
constexpr std::size_t kMin = 5;
constexpr std::uint64_t kMaxHead = 1 << 24;

void putNumber(std::string& to, std::uint64_t value, int bytes)
{
  for (int n = 0; n < bytes; ++n)
    to += static_cast<char>(value >> (8 * n) & 255U);
}

std::uint64_t numberIn(std::string_view from, int bytes)
{
  std::uint64_t value = 0;
  for (int n = 0; n < bytes; ++n)
    value |=
        static_cast<std::uint64_t>(static_cast<unsigned char>(from[static_cast<std::size_t>(n)]))
        << (8 * n);
  return value;
}

std::string hashOf(std::string_view bytes)
{
  return sha256Of(reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size());
}

// Parses the frame at the start of `bytes`; returns its length, or 0 if it is invalid.
std::size_t frameIn(std::string_view bytes, JournalFrame& frame)
{
  if (bytes.size() < kBefore + kMin)
    return 0;
  const std::uint64_t length = numberIn(bytes, 8);
  if (length < kMin || length > bytes.size() - kBefore)
    return 0;
  const std::string_view rest = bytes.substr(kBefore, static_cast<std::size_t>(length));
  const std::size_t text = static_cast<std::size_t>(numberIn(rest.substr(1), 4));
  if (hashOf(rest) != bytes.substr(8, kHash) || text > rest.size() - kMin)
    return 0;
  frame.kind = static_cast<JournalFrame::Kind>(rest[0]);
  frame.text = rest.substr(kMin, text);
  const std::string_view voxels = rest.substr(kMin + text);
  frame.bytes.assign(voxels.begin(), voxels.end());
  return kBefore + rest.size();
}

// 0 unless the head is one that a newer program wrote.
int newerFormatOf(const JournalFrame& frame)
{
  const json j = json::parse(frame.text, nullptr, false);
  const auto format = j.is_object() ? j.find("petrous_journal") : j.end();
  return frame.kind == JournalFrame::Kind::Head && format != j.end() &&
                 format->is_number_integer() && format->get<std::int64_t>() > kJournalFormat &&
                 format->get<std::int64_t>() <= std::numeric_limits<int>::max()
             ? format->get<int>()
             : 0;
}

bool headIn(const JournalFrame& frame, JournalHead& head)
{
  const json j = json::parse(frame.text, nullptr, false);
  if (frame.kind != JournalFrame::Kind::Head || !j.is_object() ||
      j.value("petrous_journal", json()) != kJournalFormat)
    return false;
  const auto name = j.find("case"), revision = j.find("revision"), strokes = j.find("strokes");
  if (name == j.end() || revision == j.end() || strokes == j.end() || !name->is_string() ||
      !revision->is_number_unsigned() || !strokes->is_number_unsigned())
    return false;
  head.caseName = name->get<std::string>();
  head.revision = revision->get<std::uint64_t>();
  head.strokes = strokes->get<std::size_t>();
  const auto text = [&j](const char* key)
  {
    const auto found = j.find(key);
    return found != j.end() && found->is_string() ? found->get<std::string>() : std::string();
  };
  head.ct = text("ct");
  head.strokesHash = text("strokes_sha256");
  head.history = text("history");
  head.caseId = text("case_id");
  return true;
}

// Whether the bytes are only the start of a head.
bool endsInHead(std::string_view bytes)
{
  return bytes.size() < kBefore + kMin ||
         (numberIn(bytes, 8) < kMaxHead && numberIn(bytes, 8) > bytes.size() - kBefore);
}

// A drilling process holds the lock for as long as it drills; an inspecting process only briefly.
// Brief locks are waited for, or an inspecting process would be taken for a drilling one.
bool lockSoon(int descriptor)
{
  constexpr std::chrono::milliseconds kPatience{100};
  return core::lockOpened(descriptor, kPatience) == core::LockState::Ours;
}

} // namespace

std::string hashOfNames(const std::vector<std::string>& strokes)
{
  std::string all;
  for (const std::string& object : strokes)
    all += object + '\n';
  return hashOf(all);
}

JournalHead::JournalHead(const SavedState& base)
  : caseName(base.name)
  , revision(base.revision)
  , strokes(base.strokes.size())
  , ct(base.ct)
  , strokesHash(hashOfNames(base.strokes))
  , history(scene::toText(base.history))
  , caseId(base.id)
{
}

bool JournalHead::isOf(const scene::Case& value) const
{
  return caseId.empty() ? caseName == value.name : caseId == value.id;
}

JournalFrame frameOf(JournalFrame::Kind kind, dissection::Stroke stroke)
{
  stroke.object.clear(); // the voxels are here
  return {kind, scene::toText(stroke), *stroke.packed.get()};
}

std::string encoded(const JournalFrame& frame)
{
  std::string rest(1, static_cast<char>(frame.kind));
  putNumber(rest, frame.text.size(), 4);
  rest += frame.text;
  rest.append(frame.bytes.begin(), frame.bytes.end());
  std::string bytes;
  putNumber(bytes, rest.size(), 8);
  return bytes + hashOf(rest) + rest;
}

std::string encoded(const JournalHead& head)
{
  json j{{"petrous_journal", kJournalFormat},
         {"case", head.caseName},
         {"revision", head.revision},
         {"strokes", head.strokes}};
  if (!head.history.empty())
  {
    j["ct"] = head.ct;
    j["strokes_sha256"] = head.strokesHash;
    j["history"] = head.history;
  }
  if (!head.caseId.empty())
    j["case_id"] = head.caseId;
  return encoded(JournalFrame{JournalFrame::Kind::Head, j.dump(), {}});
}

JournalContent journalFrom(std::string_view bytes)
{
  JournalContent content;
  JournalFrame frame;
  std::size_t length = frameIn(bytes, frame);
  content.started = !endsInHead(bytes);
  content.headed = length > 0 && headIn(frame, content.head);
  content.newerFormat = length > 0 ? newerFormatOf(frame) : 0;
  while (content.headed && length > 0)
  {
    bytes.remove_prefix(length);
    frame = {};
    length = frameIn(bytes, frame);
    if (length > 0)
      content.frames.push_back(std::move(frame));
  }
  content.leftOver = bytes.size();
  return content;
}

fs::path journalPath(const fs::path& library, const std::string& name)
{
  return library / "cases" / (name + ".journal");
}

std::string caseIdIn(const fs::path& journal) noexcept
try
{
  if (!fs::is_regular_file(journal)) // a pipe would be waited for
    return {};
  std::ifstream file(journal, std::ios::binary);
  std::string bytes(kBefore, '\0');
  if (!file.read(bytes.data(), kBefore) || numberIn(bytes, 8) > kMaxHead)
    return {};
  bytes.resize(kBefore + static_cast<std::size_t>(numberIn(bytes, 8)));
  file.read(&bytes[kBefore], static_cast<std::streamsize>(bytes.size() - kBefore));
  return file ? journalFrom(bytes).head.caseId : std::string();
}
catch (const std::exception&)
{
  return {};
}

bool isOfOtherCase(const fs::path& journal, const std::string& id) noexcept
{
  const std::string other = id.empty() ? std::string() : caseIdIn(journal);
  return !other.empty() && other != id;
}

fs::path setAside(const fs::path& journal)
{
  for (int n = 1;; ++n)
  {
    const fs::path aside = journal.string() + ".aside-" + std::to_string(n);
    if (fs::exists(fs::symlink_status(aside)))
      continue;
    moveFile(journal, aside);
    return aside;
  }
}

JournalFile::JournalFile(const fs::path& path, const JournalHead& head)
  : m_path(path)
{
  // A reader may take the empty file for a stale one and remove it: then try again.
  struct stat info
  {
  };
  do
  {
    if (m_descriptor >= 0)
      ::close(m_descriptor);
    m_descriptor = ::open(path.c_str(), O_RDWR | O_CREAT | O_EXCL | O_APPEND | O_CLOEXEC, 0666);
    if (m_descriptor < 0 && errno == EEXIST)
      throw LibraryError(LibraryError::Reason::Conflict,
                         "case '" + head.caseName +
                             "' is being drilled by another process; end that first");
    if (m_descriptor < 0)
      throwForErrno(errno, path);
    core::lockOpened(m_descriptor, std::chrono::hours(1)); // who looks at it has it for a moment
  } while (::fstat(m_descriptor, &info) == 0 && info.st_nlink == 0);
  m_held = true;
  try
  {
    append(encoded(head));
    if (!core::syncFolder(path.parent_path()))
      throwForErrno(EIO, path);
  }
  catch (...)
  {
    remove();
    throw;
  }
}

JournalFile::JournalFile(const fs::path& path)
  : m_path(path)
{
  m_descriptor = ::open(path.c_str(), O_RDWR | O_APPEND | O_NONBLOCK | O_CLOEXEC);
  if (m_descriptor < 0 && (errno == EROFS || errno == EACCES))
    m_descriptor = ::open(path.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC);
  if (m_descriptor < 0 && errno == ENOENT)
    return;
  if (m_descriptor < 0)
    throwForErrno(errno, path);
  struct stat info
  {
  };
  if (::fstat(m_descriptor, &info) == 0 && !S_ISREG(info.st_mode))
  {
    ::close(m_descriptor);
    throw LibraryError(LibraryError::Reason::Damaged,
                       core::printable(path) + ": is not a regular file; remove it");
  }
  m_held = lockSoon(m_descriptor);
  if (::fstat(m_descriptor, &info) == 0 && info.st_nlink > 0)
  {
    m_size = static_cast<std::size_t>(info.st_size);
    return;
  }
  ::close(m_descriptor); // its owner has just removed it
  m_descriptor = -1;
}

JournalFile::~JournalFile()
{
  if (m_descriptor >= 0)
    ::close(m_descriptor);
}

JournalFile::JournalFile(JournalFile&& other) noexcept
  : m_path(std::move(other.m_path))
  , m_descriptor(std::exchange(other.m_descriptor, -1))
  , m_held(other.m_held)
  , m_size(other.m_size)
  , m_hasRemains(other.m_hasRemains)
{
}

JournalFile& JournalFile::operator=(JournalFile&& other) noexcept
{
  std::swap(m_path, other.m_path);
  std::swap(m_descriptor, other.m_descriptor);
  std::swap(m_held, other.m_held);
  std::swap(m_size, other.m_size);
  std::swap(m_hasRemains, other.m_hasRemains);
  return *this;
}

std::string JournalFile::read() const
{
  std::string bytes(m_size, '\0');
  std::size_t got = 0;
  while (got < bytes.size())
  {
    const ssize_t count =
        ::pread(m_descriptor, &bytes[got], bytes.size() - got, static_cast<off_t>(got));
    if (count < 0 && errno == EINTR)
      continue;
    if (count <= 0)
      break;
    got += static_cast<std::size_t>(count);
  }
  bytes.resize(got);
  return bytes;
}

void JournalFile::append(std::string_view frames)
{
  // What follows the remains of a failed append would be lost, as reading ends there.
  if (m_hasRemains && ::ftruncate(m_descriptor, static_cast<off_t>(m_size)) != 0)
    throwForErrno(errno, m_path);
  m_hasRemains = true;
  try
  {
    write(frames);
  }
  catch (...)
  {
    m_hasRemains = ::ftruncate(m_descriptor, static_cast<off_t>(m_size)) != 0;
    throw;
  }
  m_hasRemains = false;
  m_size += frames.size();
}

void JournalFile::write(std::string_view bytes)
{
  if (const int error = core::writeAll(m_descriptor, bytes.data(), bytes.size()))
    throwForErrno(error, m_path);
  if (::fdatasync(m_descriptor) != 0)
    throwForErrno(errno, m_path);
}

void JournalFile::moveTo(const fs::path& path)
{
  moveFile(m_path, path);
  m_path = path;
}

void JournalFile::remove() noexcept
{
  struct stat own = {}, there = {};
  if (::fstat(m_descriptor, &own) == 0 && ::lstat(m_path.c_str(), &there) == 0 &&
      own.st_dev == there.st_dev && own.st_ino == there.st_ino)
    ::unlink(m_path.c_str());
  if (m_descriptor >= 0)
    ::close(std::exchange(m_descriptor, -1));
}

} // namespace petrous::library
