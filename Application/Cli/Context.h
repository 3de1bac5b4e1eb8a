#pragma once

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include "petrous/Core/NumberText.h"
#include "petrous/Core/Progress.h"
#include "petrous/Library/Library.h"

namespace petrous::cli
{

/// Invalid command line (exit 2).
class UsageError : public std::runtime_error
{
public:
  using std::runtime_error::runtime_error;
};

/// Version of the JSON output: incremented when a key changes its meaning or is removed.
constexpr int kSchemaVersion = 1;

/// Option of commands that can do without a damaged structure; see leaveOutDamaged.
constexpr const char* kWithoutDamaged = "--without-damaged";

/// Footer of the help texts.
extern const char* const kExitCodes;

/// Shared by all subcommands: library location and output.
class Context
{
public:
  /// Adds --library, --json, --quiet and --log-level to the program, so that they are also accepted
  /// before the subcommand.
  void addOptions(CLI::App& app);

  /// Adds a subcommand with the same options; `run` is called if it is selected, and logged.
  CLI::App* addCommand(CLI::App& parent, const std::string& name, const std::string& text,
                       std::function<void()> run);

  library::Library openLibrary() const; ///< of libraryFolder

  bool json() const noexcept { return m_json; }

  /// Logs the end of the command that ran, if one did. `why`: what of an error may be logged.
  void logEnd(int exitCode, const std::string& why = {}) const;

  /// Waits for the checks of what was read from the library: throws LibraryError (Damaged) if that
  /// is not what was stored, CancelledError. Call before writing a file or saving; `print` and
  /// `printJson` do it themselves.
  void refuseDamaged() const;

  /// Refuses output files that would replace an input of the command, each other, or what
  /// library::refuseOverwriting refuses; empty names are ignored. Call before anything is computed.
  void refuseOverwriting(const std::vector<std::string>& outputs,
                         const std::vector<std::string>& inputs = {}) const;

  /// Text for the user on stdout; nothing with --json or --quiet.
  void print(const std::string& line) const;

  /// The single JSON object on stdout, with "notices" of the library if there are any; nothing
  /// without --json.
  void printJson(const nlohmann::json& object) const;

  /// Whether the JSON object was printed: a later failure prints no second one.
  bool gave() const noexcept { return m_gave; }

  /// A warning on stderr, e.g. what was accepted in a file; nothing with --quiet.
  void warn(const std::string& line) const;

  /// Progress bar on stderr if it is a terminal. Ctrl+C cancels, a second one kills the process.
  core::Progress progress() const;
  /// The same with a listener of one's own.
  core::Progress progress(core::Progress::Listener listener) const;

  /// --library, else $PETROUS_LIBRARY, else the user's data folder; it need not be there. Throws
  /// LibraryError (library::checkLibraryFolder).
  std::filesystem::path libraryFolder() const;

private:
  void startLog(const std::string& program, const std::string& command);

  // CLI11 parses numbers in the C locale: a decimal point until the command runs.
  std::optional<core::PlainNumbers> m_parsing{std::in_place};
  std::string m_library;
  std::string m_logLevel;
  std::string m_command; ///< that runs
  std::chrono::steady_clock::time_point m_started;
  mutable std::optional<library::Library> m_opened;
  mutable std::vector<std::string> m_notices; ///< of the library
  bool m_json = false;
  bool m_quiet = false;
  mutable bool m_gave = false;
};

/// `text` as a terminal is given it: with U+FFFD in place of control characters other than line
/// ends and tabs, and of those that reorder others. Names come from files of other programs.
std::string terminalText(const std::string& text);

/// `object` in ASCII, the rest as \u escapes: no terminal obeys what a name has in it. In one line
/// if `indent` is -1.
std::string jsonLine(const nlohmann::json& object, int indent = -1);

/// `object` as printed by --json, with its schema version, as jsonLine.
std::string jsonText(nlohmann::json object);

/// Maximum size of an input file of options, points or poses, bytes.
constexpr std::uintmax_t kLargestInput = std::uintmax_t{1} << 30;
constexpr std::uintmax_t kLargestJson = std::uintmax_t{1} << 20;

} // namespace petrous::cli
