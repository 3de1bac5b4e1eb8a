#include "Context.h"

#include <csignal>
#include <cstdlib>
#include <fstream>
#include <iostream>
#include <mutex>

#include <unistd.h>

namespace petrous::cli
{

namespace
{

// A signal handler can reach nothing else; the token's flag is a lock-free atomic.
std::shared_ptr<core::CancelToken>& interruptToken()
{
  static auto token = std::make_shared<core::CancelToken>();
  return token;
}

void onInterrupt(int)
{
  interruptToken()->cancel();
}

} // namespace

CLI::App* Context::addCommand(CLI::App& parent, const std::string& name, const std::string& text,
                              std::function<void()> run)
{
  CLI::App* command = parent.add_subcommand(name, text);
  command->add_option("--library", m_library, "Folder of the library")->type_name("DIR");
  command->add_flag("--json", m_json, "One JSON object on stdout and nothing else there");
  command->add_flag("--quiet", m_quiet, "No remarks and no progress");
  command->callback(std::move(run));
  return command;
}

library::Library Context::openLibrary() const
{
  library::Library library(libraryFolder());
  library.onNotice([this](const std::string& words) { remark(words); });
  return library;
}

std::filesystem::path Context::libraryFolder() const
{
  if (!m_library.empty())
    return m_library;
  const auto fromEnvironment = [](const char* name)
  {
    const char* value = std::getenv(name);
    return std::filesystem::path(value ? value : "");
  };
  if (const auto path = fromEnvironment("PETROUS_LIBRARY"); !path.empty())
    return path;
  if (const auto path = fromEnvironment("XDG_DATA_HOME"); !path.empty())
    return path / "petrous";
  if (const auto path = fromEnvironment("HOME"); !path.empty())
    return path / ".local/share/petrous";
  throw UsageError("no home folder for the library; give --library DIR");
}

void Context::say(const std::string& line) const
{
  if (!m_json && !m_quiet)
    std::cout << line << '\n';
}

void Context::give(const nlohmann::json& object) const
{
  if (m_json)
    std::cout << object.dump(1, ' ', false, nlohmann::json::error_handler_t::replace) << '\n';
}

void Context::remark(const std::string& line) const
{
  if (!m_quiet)
    std::cerr << line << '\n';
}

core::Progress Context::progress() const
{
  std::signal(SIGINT, onInterrupt);
  if (m_quiet || ::isatty(STDERR_FILENO) == 0)
    return core::Progress(nullptr, interruptToken());
  struct Bar
  {
    std::mutex mutex;
    int shown = -1;
    ~Bar()
    {
      if (shown >= 0)
        std::cerr << "\r\033[K";
    }
  };
  return core::Progress(
      [bar = std::make_shared<Bar>()](double fraction, const std::string& text)
      {
        const std::lock_guard<std::mutex> lock(bar->mutex);
        const int percent = static_cast<int>(100.0 * fraction);
        if (percent == bar->shown)
          return;
        bar->shown = percent;
        std::cerr << '\r' << percent << " % " << text << "\033[K" << std::flush;
      },
      interruptToken());
}

void notBuiltYet(const std::string& what)
{
  throw UsageError(what + " is not built yet");
}

std::ifstream openForReading(const std::filesystem::path& path)
{
  std::error_code error;
  std::ifstream file(path, std::ios::binary);
  if (!file || std::filesystem::is_directory(path, error))
    throw core::InvalidParameter(path.string() +
                                 ": not there, a folder or not readable; give a file");
  return file;
}

void writeTextFile(const std::filesystem::path& path, const std::string& bytes)
{
  const std::filesystem::path temporary =
      path.parent_path() / (".tmp-" + std::to_string(::getpid()) + "-" + path.filename().string());
  std::ofstream file(temporary, std::ios::binary);
  file << bytes;
  file.close();
  std::error_code error;
  if (file)
    std::filesystem::rename(temporary, path, error);
  if (!file || error)
  {
    std::error_code ignored;
    std::filesystem::remove(temporary, ignored);
    throw core::Error(core::Fault::Refused,
                      path.string() + ": cannot be written (no such folder, no permission or a "
                                      "full disk); choose another place");
  }
}

} // namespace petrous::cli
