#include "petrous/Core/Log.h"

#include <array>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <ctime>
#include <memory>
#include <typeinfo>
#include <utility>

#include <cxxabi.h>
#include <fcntl.h>
#include <spdlog/sinks/base_sink.h>
#include <spdlog/sinks/dup_filter_sink.h>
#include <spdlog/spdlog.h>
#include <sys/file.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

#include "petrous/Core/Error.h"

namespace petrous::core::log
{

namespace fs = std::filesystem;

namespace
{

constexpr const char* kName = "petrous"; // in spdlog's registry
constexpr std::array<const char*, 6> kLevels{"trace", "debug", "info", "warning", "error", "off"};
constexpr std::chrono::seconds kRepeats{5}; // a failing picture reports itself with every frame

spdlog::level::level_enum toSpdlog(Level level)
{
  return level == Level::Off ? spdlog::level::off
                             : static_cast<spdlog::level::level_enum>(static_cast<int>(level));
}
static_assert(static_cast<int>(Level::Error) == spdlog::level::err);

// spdlog's rotating file belongs to one process: it caches the size, and renames the file under the
// others.
class SharedFile final : public spdlog::sinks::base_sink<spdlog::details::null_mutex>
{
public:
  explicit SharedFile(const Setup& setup)
    : m_setup(setup)
  {
  }
  ~SharedFile() override { close(); }

protected:
  void sink_it_(const spdlog::details::log_msg& message) override
  {
    spdlog::memory_buf_t line;
    formatter_->format(message, line);
    // One write with O_APPEND is not torn by other processes' lines.
    if (ready(line.size()) &&
        ::write(m_descriptor, line.data(), line.size()) == static_cast<ssize_t>(line.size()))
      return;
    const std::string where = m_setup.file.empty()
                                  ? "there is no home folder for it"
                                  : m_setup.file.string() + " cannot be written; check the folder, "
                                                            "or use --log-level off";
    if (const auto warn = std::exchange(m_setup.warn, nullptr))
      warn("no log: " + where);
  }
  void flush_() override {}

private:
  void close()
  {
    if (m_descriptor >= 0)
      ::close(m_descriptor);
    m_descriptor = -1;
  }

  bool open()
  {
    close();
    std::error_code error;
    const fs::path folder = m_setup.file.parent_path();
    if (m_setup.file.empty())
      return false;
    if (fs::create_directories(folder, error))
      fs::permissions(folder, fs::perms::owner_all, error);
    // Non-blocking: a pipe without a reader is refused instead of waited for.
    m_descriptor =
        ::open(m_setup.file.c_str(), O_WRONLY | O_APPEND | O_CREAT | O_CLOEXEC | O_NONBLOCK, 0600);
    struct stat status = {};
    if (m_descriptor >= 0 && (::fstat(m_descriptor, &status) != 0 || !S_ISREG(status.st_mode)))
      close();
    return m_descriptor >= 0;
  }

  bool isCurrent() const // not renamed by another process
  {
    struct stat mine = {};
    struct stat named = {};
    return m_descriptor >= 0 && ::fstat(m_descriptor, &mine) == 0 &&
           ::stat(m_setup.file.c_str(), &named) == 0 && mine.st_ino == named.st_ino &&
           mine.st_dev == named.st_dev;
  }

  std::uintmax_t size() const
  {
    struct stat status = {};
    return ::fstat(m_descriptor, &status) == 0 ? static_cast<std::uintmax_t>(status.st_size) : 0;
  }

  bool ready(std::size_t bytes)
  {
    if (!isCurrent() && !open())
      return false;
    if (size() == 0 || size() + bytes <= m_setup.maxBytes)
      return fits(bytes);
    // Never waits: if another process holds the lock, it is renaming, and this line goes to the
    // full file. File systems without locks are not shared.
    if (::flock(m_descriptor, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK)
      return fits(bytes);
    if (isCurrent() && !rotate())
      return size() + bytes <= 2 * m_setup.maxBytes && fits(bytes);
    return open() && fits(bytes);
  }

  // Beyond the process's limit, a write raises a signal.
  bool fits(std::size_t bytes) const
  {
    struct rlimit limit = {};
    return ::getrlimit(RLIMIT_FSIZE, &limit) != 0 || limit.rlim_cur == RLIM_INFINITY ||
           size() + bytes <= limit.rlim_cur;
  }

  bool rotate()
  {
    const auto numbered = [this](int n)
    {
      fs::path path = m_setup.file;
      return n == 0 ? path : path.replace_extension(std::to_string(n) + ".log");
    };
    std::error_code error;
    for (int n = m_setup.files - 1; n > 0; --n)
      fs::rename(numbered(n - 1), numbered(n), error);
    return !error; // of the last, which frees the name
  }

  Setup m_setup;
  int m_descriptor = -1;
};

// A signal handler can reach nothing else.
std::array<char, 4096> fatalFile{};

void appendNumber(char*& end, unsigned long number)
{
  char digits[24];
  int count = 0;
  do
    digits[count++] = static_cast<char>('0' + number % 10);
  while (number /= 10);
  while (count > 0)
    *end++ = digits[--count];
}

void appendText(char*& end, const char* text)
{
  while (*text)
    *end++ = *text++;
}

// Only async-signal-safe calls. Afterwards the signal's default action ends the process.
void onFatal(int signal)
{
  char line[200];
  char* end = line;
  appendText(end, "unexpected end: process ");
  appendNumber(end, static_cast<unsigned long>(::getpid()));
  appendText(end, ", signal ");
  appendNumber(end, static_cast<unsigned long>(signal));
  appendText(end, ", seconds since 1970: ");
  appendNumber(end, static_cast<unsigned long>(::time(nullptr)));
  *end++ = '\n';
  const int file = ::open(fatalFile.data(), O_WRONLY | O_APPEND | O_NONBLOCK);
  [[maybe_unused]] const ssize_t written =
      ::write(file, line, static_cast<std::size_t>(end - line));
  ::raise(signal);
}

// Leaves handlers of sanitizers and debuggers alone.
void watchFatal(const fs::path& file)
{
  const std::string& path = file.native();
  if (path.size() >= fatalFile.size())
    return;
  path.copy(fatalFile.data(), path.size());
  fatalFile[path.size()] = '\0';
  for (const int signal : {SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT})
  {
    struct sigaction action = {};
    if (::sigaction(signal, nullptr, &action) != 0 || action.sa_handler != SIG_DFL)
      continue;
    action.sa_handler = onFatal;
    action.sa_flags = static_cast<int>(SA_RESETHAND);
    ::sigaction(signal, &action, nullptr);
  }
}

fs::path absoluteFrom(const char* name)
{
  const char* value = std::getenv(name);
  const fs::path path(value ? value : "");
  return path.is_absolute() ? path : fs::path();
}

} // namespace

Level levelFrom(const std::string& option)
{
  const char* variable = std::getenv("PETROUS_LOG_LEVEL");
  const bool given = !option.empty();
  const std::string name = given ? option : variable ? variable : "";
  if (name.empty())
    return Level::Info;
  for (std::size_t n = 0; n < kLevels.size(); ++n)
    if (name == kLevels[n])
      return static_cast<Level>(n);
  throw InvalidParameter(std::string(given ? "--log-level" : "PETROUS_LOG_LEVEL") + ": '" + name +
                         "' is not a level; trace, debug, info, warning, error or off");
}

fs::path defaultFile()
{
  fs::path folder = absoluteFrom("XDG_STATE_HOME");
  if (folder.empty() && !absoluteFrom("HOME").empty())
    folder = absoluteFrom("HOME") / ".local/state";
  return folder.empty() ? fs::path() : folder / "petrous/petrous.log";
}

void start(const Setup& setup)
{
  spdlog::drop(kName);
  if (setup.level == Level::Off)
    return;
  const auto sink = std::make_shared<spdlog::sinks::dup_filter_sink_mt>(kRepeats);
  sink->add_sink(std::make_shared<SharedFile>(setup));
  const auto logger = std::make_shared<spdlog::logger>(kName, sink);
  logger->set_level(toSpdlog(setup.level));
  logger->set_pattern("%Y-%m-%dT%H:%M:%S.%e%z %P %l %v");
  logger->set_error_handler([](const std::string&) {}); // by default it writes to stderr
  spdlog::register_logger(logger);
  watchFatal(setup.file);
}

void write(Level level, std::string_view text) noexcept
{
  try
  {
    const auto logger = spdlog::get(kName);
    if (!logger || !logger->should_log(toSpdlog(level)))
      return;
    std::string line(text);
    for (char& c : line)
      if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f)
        c = ' ';
    logger->log(toSpdlog(level), spdlog::string_view_t(line.data(), line.size()));
  }
  catch (...) // out of memory; the log must not end the program
  {
  }
}

std::string typeOf(const std::exception& error)
{
  const char* mangled = typeid(error).name();
  int status = 0;
  const std::unique_ptr<char, void (*)(void*)> name(
      abi::__cxa_demangle(mangled, nullptr, nullptr, &status), std::free);
  return name ? name.get() : mangled;
}

void foreign(Level level, const std::string& library, std::string_view text) noexcept
{
  try
  {
    // Their macros begin with a kind and the source file; what follows may quote data.
    std::string place;
    for (const std::string_view kind :
         {"ERROR: In ", "Warning: In ", "WARNING: In ", "Generic Warning: In "})
    {
      const std::size_t line = text.find(", line ");
      if (text.substr(0, kind.size()) != kind || line == std::string_view::npos)
        continue;
      const std::string_view file = text.substr(kind.size(), line - kind.size());
      place = ", " + std::string(file.substr(file.rfind('/') + 1)) + ":";
      for (std::size_t at = line + 7; at < text.size() && text[at] >= '0' && text[at] <= '9'; ++at)
        place += text[at];
    }
    write(level, library + " message" + place);
  }
  catch (...)
  {
  }
}

} // namespace petrous::core::log
