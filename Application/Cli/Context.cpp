#include "Context.h"

#include <atomic>
#include <csignal>
#include <cstdlib>
#include <iostream>
#include <mutex>
#include <thread>
#include <type_traits>
#include <utility>

#include <unistd.h>

#include "Numbers.h"
#include "petrous/Core/Log.h"
#include "petrous/Library/DefaultFolder.h"
#include "petrous/Library/LibraryFiles.h"
#include "petrous/Presenters/TimeLeft.h"
#include "petrous/Scene/PlainText.h"

namespace petrous::cli
{

namespace
{

// Of numbers, as the user set it: the program's own stays "C".
std::string usersLocale()
{
  for (const char* name : {"LC_ALL", "LC_NUMERIC", "LANG"})
    if (const char* value = std::getenv(name); value && *value)
      return value;
  return "C";
}

// A signal handler can reach nothing else. Constant-initialized and never destroyed, so it is valid
// whenever the signal arrives.
core::CancelToken interrupted;
static_assert(std::is_trivially_destructible_v<core::CancelToken>);
static_assert(std::atomic<bool>::is_always_lock_free);

void onInterrupt(int)
{
  interrupted.cancel();
}

std::shared_ptr<const core::CancelToken> interruptToken()
{
  return {std::shared_ptr<void>(), &interrupted};
}

// A second Ctrl+C kills the process at once. A closed terminal and `kill` leave no more behind than
// Ctrl+C: temporary files hold the hospital's identified images.
void watchInterrupt()
{
  struct sigaction action = {};
  action.sa_handler = onInterrupt;
  action.sa_flags = static_cast<int>(SA_RESETHAND);
  ::sigemptyset(&action.sa_mask);
  for (const int signal : {SIGINT, SIGTERM, SIGHUP})
  {
    struct sigaction before = {};
    ::sigaction(signal, nullptr, &before);
    if (before.sa_handler != SIG_IGN) // nohup
      ::sigaction(signal, &action, nullptr);
  }
}

} // namespace

const char* const kExitCodes =
    "Exit codes: 0 done; 1 a fault of the program or the machine, or done but the answer could not "
    "be written to stdout; 2 wrong usage; 3 bad input; 4 refused to prevent data loss, or as this "
    "machine lacks the room; 130 interrupted by Ctrl+C";

void Context::addOptions(CLI::App& app)
{
  app.add_option("--library", m_library, "Folder of the library")->type_name("DIR");
  app.add_flag("--json", m_json, "Print one JSON object on stdout and nothing else there");
  app.add_flag("--quiet", m_quiet, "No remarks and no progress");
  app.add_option("--log-level", m_logLevel,
                 "Level of the log: trace, debug, info, warning, error or off (info)")
      ->type_name("LEVEL")
      ->check(offers({"trace", "debug", "info", "warning", "error", "off"}));
}

CLI::App* Context::addCommand(CLI::App& parent, const std::string& name, const std::string& text,
                              std::function<void()> run)
{
  CLI::App* command = parent.add_subcommand(name, text);
  addOptions(*command);
  command->footer(kExitCodes);
  command->callback(
      [this, program = parent.get_name(), name, command, run = std::move(run)]
      {
        m_parsing.reset();
        startLog(program, name);
        try
        {
          run();
        }
        catch (const library::StructureError& error)
        {
          if (!command->get_option_no_throw(kWithoutDamaged))
            throw;
          throw library::StructureError(error.reason,
                                        std::string(error.what()) +
                                            "; or go on without it: " + kWithoutDamaged);
        }
        refuseDamaged(); // if nothing was printed
      });
  return command;
}

void Context::startLog(const std::string& program, const std::string& command)
{
  core::log::Setup setup;
  try
  {
    setup.level = core::log::levelFrom(m_logLevel);
  }
  catch (const core::InvalidParameter& error)
  {
    throw UsageError(error.what());
  }
  setup.warn = [program, quiet = m_quiet](const std::string& text)
  {
    if (!quiet)
      std::cerr << program << ": " << terminalText(text) << '\n';
  };
  core::log::start(setup);
  m_command = command;
  m_started = std::chrono::steady_clock::now();
  core::log::info(command + ": start, " + program + " " PETROUS_VERSION ", locale " +
                  usersLocale() + ", " + std::to_string(std::thread::hardware_concurrency()) +
                  " processors");
}

void Context::logEnd(int exitCode, const std::string& why) const
{
  if (m_command.empty())
    return;
  const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - m_started;
  using core::log::Level;
  core::log::write(exitCode == 0   ? Level::Info
                   : exitCode == 1 ? Level::Error
                                   : Level::Warning,
                   m_command + ": exit " + std::to_string(exitCode) + " after " +
                       core::fixedText(seconds.count(), 3) + " s" +
                       (why.empty() ? "" : ", " + why));
}

void Context::refuseDamaged() const
{
  if (m_opened)
    m_opened->checkAllRead(core::Progress(nullptr, interruptToken()));
}

namespace
{

namespace fs = std::filesystem;

bool isSameFile(const fs::path& a, const fs::path& b)
{
  std::error_code error;
  return library::resolvedPath(a) == library::resolvedPath(b) || fs::equivalent(a, b, error);
}

} // namespace

void Context::refuseOverwriting(const std::vector<std::string>& outputs,
                                const std::vector<std::string>& inputs) const
{
  const auto refuse = [](const std::string& file, const std::string& why)
  { throw core::Error(core::Fault::Refused, file + ": " + why + "; name another file"); };
  for (auto out = outputs.begin(); out != outputs.end(); ++out)
  {
    if (out->empty())
      continue;
    library::refuseOverwriting(*out, libraryFolder());
    for (const std::string& in : inputs)
      if (!in.empty() && isSameFile(*out, in))
        refuse(*out, "is also read by this command, and would be replaced");
    for (auto other = outputs.begin(); other != out; ++other)
      if (!other->empty() && isSameFile(*out, *other))
        refuse(*out, "is named for two outputs");
  }
}

library::Library Context::openLibrary() const
{
  library::Library library(libraryFolder());
  library.onNotice(
      [this](const std::string& words)
      {
        m_notices.push_back(words);
        warn(words);
      });
  library.onWait(
      [this, told = std::make_shared<bool>(false)](double seconds)
      {
        constexpr double kSay = 1.0; // s
        if (seconds >= kSay && !std::exchange(*told, true))
          warn(
              "another program is using the library; waiting for it (Ctrl+C ends this, and nothing "
              "is changed)");
        core::Progress(nullptr, interruptToken()).check("waiting for the library");
      });
  library.noticeOpeners();
  m_opened = library;
  return library;
}

std::filesystem::path Context::libraryFolder() const
{
  std::filesystem::path named = m_library;
  if (const char* path = std::getenv("PETROUS_LIBRARY"); named.empty() && path && *path)
    named = path;
  if (!named.empty())
  {
    library::checkLibraryFolder(named);
    return named;
  }
  if (const auto path = library::defaultFolder(); !path.empty())
    return path;
  throw UsageError("no home folder for the library; give --library DIR");
}

void Context::print(const std::string& line) const
{
  refuseDamaged();
  if (!m_json && !m_quiet)
    std::cout << terminalText(line) << '\n';
}

void Context::printJson(const nlohmann::json& object) const
{
  refuseDamaged();
  if (!m_json)
    return;
  m_gave = true;
  nlohmann::json whole = object;
  if (!m_notices.empty())
    whole["notices"] = m_notices;
  std::cout << jsonText(std::move(whole));
}

std::string terminalText(const std::string& text)
{
  return scene::withVisibleControls(text, "\n\t");
}

std::string jsonLine(const nlohmann::json& object, int indent)
{
  return object.dump(indent, ' ', true, nlohmann::json::error_handler_t::replace);
}

std::string jsonText(nlohmann::json object)
{
  object["schema_version"] = kSchemaVersion;
  return jsonLine(object, 1) + "\n";
}

void Context::warn(const std::string& line) const
{
  if (!m_quiet)
    std::cerr << terminalText(line) << '\n';
}

core::Progress Context::progress(core::Progress::Listener listener) const
{
  watchInterrupt();
  return core::Progress(std::move(listener), interruptToken());
}

core::Progress Context::progress() const
{
  watchInterrupt();
  if (m_quiet || ::isatty(STDERR_FILENO) == 0)
    return core::Progress(nullptr, interruptToken());
  struct Bar
  {
    std::mutex mutex;
    presenters::TimeLeft time;
    int shown = -1;
    std::string left;
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
        const double now = presenters::steadySeconds();
        bar->time.report(fraction, now);
        std::string left = presenters::timeLeftText(bar->time.shown(now));
        if (percent == bar->shown && left == bar->left)
          return;
        bar->shown = percent;
        bar->left = std::move(left);
        std::cerr << '\r' << percent << " % " << terminalText(text);
        if (!bar->left.empty())
          std::cerr << ", " << bar->left;
        std::cerr << "\033[K" << std::flush;
      },
      interruptToken());
}

} // namespace petrous::cli
