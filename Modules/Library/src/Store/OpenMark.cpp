#include "petrous/Library/OpenMark.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <optional>
#include <system_error>
#include <utility>

#include <fcntl.h>
#include <nlohmann/json.hpp>
#include <sys/stat.h>
#include <unistd.h>

#include "petrous/Core/InputFile.h"
#include "petrous/Core/OpenedLock.h"
#include "petrous/Core/OutputFile.h"

namespace petrous::library
{

namespace fs = std::filesystem;

namespace
{

constexpr const char* kFolder = "open";
constexpr std::size_t kLongest = 4096; // bytes of a mark

std::string thisComputer()
{
  std::array<char, 256> name{};
  return ::gethostname(name.data(), name.size() - 1) == 0 ? name.data() : "";
}

// Of which case a file of this name is the mark (OpenMark::OpenMark); empty: of none.
std::string idOf(const fs::path& path)
{
  constexpr std::size_t kDigits = 16; // core::temporaryBeside
  const std::string name = path.filename().string();
  const std::size_t dot = name.rfind('.');
  if (dot == std::string::npos || !core::isLeftover(name.substr(dot)))
    return {};
  const std::size_t digits = name.find_last_not_of("0123456789abcdef") + 1;
  const bool isWhole = name.size() - digits == kDigits && name[digits - 1] == '-';
  return isWhole ? name.substr(0, dot) : std::string();
}

// nullopt: it is no mark, but some file that lies there. One that was not written yet is one, and
// one that another computer's lock keeps from being read; of both the process stays 0.
std::optional<Opener> openerIn(int descriptor)
{
  Opener opener;
  struct stat status = {};
  if (::fstat(descriptor, &status) != 0 || !S_ISREG(status.st_mode))
    return std::nullopt;
  std::string text(kLongest, '\0');
  const ssize_t got = ::pread(descriptor, text.data(), text.size(), 0);
  if (got <= 0)
    return opener;
  text.resize(static_cast<std::size_t>(got));
  const nlohmann::json mark = nlohmann::json::parse(text, nullptr, false);
  if (!mark.is_object())
    return std::nullopt;
  const auto process = mark.find("process");
  if (process == mark.end() || !process->is_number_integer())
    return std::nullopt;
  opener.process = process->get<long>();
  if (const auto computer = mark.find("computer"); computer != mark.end() && computer->is_string())
    opener.computer = computer->get<std::string>();
  return opener;
}

// Who has this mark; nullopt, and it is gone, if he was killed.
std::optional<Opener> openerAt(const fs::path& path)
{
  constexpr int flags = O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC;
  int descriptor = ::open(path.c_str(), O_RDWR | flags); // NFS locks only what can be written
  if (descriptor < 0)
    descriptor = ::open(path.c_str(), O_RDONLY | flags);
  if (descriptor < 0)
    return std::nullopt;
  std::optional<Opener> opener = openerIn(descriptor);
  if (!opener)
  {
    ::close(descriptor);
    return std::nullopt;
  }
  const core::LockState lock = core::lockOpened(descriptor);
  // Where a file system has no locks, a process of this computer can still be asked for.
  const bool isGone = lock == core::LockState::Ours ||
                      (lock == core::LockState::NoLocks && opener->process > 0 &&
                       opener->computer == thisComputer() &&
                       ::kill(static_cast<pid_t>(opener->process), 0) != 0 && errno == ESRCH);
  if (isGone && core::isOpenedAt(descriptor, path))
    ::unlink(path.c_str());
  ::close(descriptor);
  return isGone ? std::nullopt : opener;
}

// Of the case of this ID; empty: of all.
std::vector<fs::path> marksIn(const fs::path& library, const std::string& id)
{
  std::vector<fs::path> found;
  std::error_code error;
  for (fs::directory_iterator entry(library / kFolder, error), end; !error && entry != end;
       entry.increment(error))
    if (const std::string of = idOf(entry->path()); !of.empty() && (id.empty() || of == id))
      found.push_back(entry->path());
  std::sort(found.begin(), found.end());
  return found;
}

// Other processes that have the case of this ID open; empty: any case.
std::vector<Opener> othersWith(const fs::path& library, const std::string& id)
{
  std::vector<Opener> openers;
  const std::string computer = thisComputer();
  // One without a process cannot be told from one's own.
  for (const fs::path& path : marksIn(library, id))
    if (std::optional<Opener> opener = openerAt(path);
        opener && opener->process > 0 &&
        (opener->process != ::getpid() || opener->computer != computer))
      openers.push_back(std::move(*opener));
  return openers;
}

} // namespace

OpenMark::OpenMark(const fs::path& library, std::string id)
  : m_id(std::move(id))
{
  constexpr int kAttempts = 10;
  constexpr std::chrono::milliseconds kPatience{100};
  const fs::path folder = library / kFolder;
  std::error_code error;
  if (m_id.empty() || m_id.find('/') != std::string::npos || !fs::is_directory(library, error))
    return;
  fs::create_directory(folder, error);
  for (int n = 0; n < kAttempts && m_descriptor < 0; ++n)
  {
    m_path = folder / (m_id + core::temporaryBeside(folder).filename().string());
    m_descriptor = ::open(m_path.c_str(), O_RDWR | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC, 0666);
    if (m_descriptor < 0)
    {
      if (errno != EEXIST)
        return;
      continue;
    }
    // Who looks at it just now has it locked for a moment, and may take it for a killed one's.
    // Where there are no locks, it is as good as locked.
    const bool isLocked = core::lockOpened(m_descriptor, kPatience) != core::LockState::Anothers;
    const bool isThere = core::isOpenedAt(m_descriptor, m_path);
    if (!isLocked || !isThere)
    {
      if (isThere)
        ::unlink(m_path.c_str());
      ::close(m_descriptor);
      m_descriptor = -1;
    }
  }
  if (m_descriptor < 0)
    return;
  const std::string text =
      nlohmann::json{{"process", ::getpid()}, {"computer", thisComputer()}}.dump(
          -1, ' ', false, nlohmann::json::error_handler_t::replace) +
      "\n";
  [[maybe_unused]] const ssize_t written = ::pwrite(m_descriptor, text.data(), text.size(), 0);
}

OpenMark::~OpenMark()
{
  if (m_descriptor < 0)
    return;
  if (core::isOpenedAt(m_descriptor, m_path))
    ::unlink(m_path.c_str());
  ::close(m_descriptor);
}

std::vector<Opener> openersOf(const fs::path& library, const std::string& id)
{
  return id.empty() ? std::vector<Opener>() : othersWith(library, id);
}

std::vector<Opener> openersOfAny(const fs::path& library)
{
  return othersWith(library, "");
}

std::string toString(const std::vector<Opener>& openers)
{
  std::string text;
  for (const Opener& one : openers)
    text += (text.empty() ? "" : ", ") + ("process " + std::to_string(one.process)) + " on '" +
            core::printable(one.computer) + "'";
  return text;
}

void removeStaleMarks(const fs::path& library) noexcept
{
  try
  {
    for (const fs::path& path : marksIn(library, ""))
      openerAt(path);
  }
  catch (const std::exception&)
  {
    // they are looked at again when their cases are opened
  }
}

} // namespace petrous::library
