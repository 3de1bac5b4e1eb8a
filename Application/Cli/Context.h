#pragma once

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

/// The words of the command line are wrong (exit 2).
class UsageError : public std::runtime_error
{
public:
  using std::runtime_error::runtime_error;
};

/// Version of the JSON that every subcommand prints: raised when a key changes its meaning or goes.
constexpr int kSchemaVersion = 1;

/// Closes the help texts.
extern const char* const kExitCodes;

/// What every subcommand shares: where the library is and how to speak.
class Context
{
public:
  /// Adds --library, --json and --quiet to the program, so that they may stand before the
  /// subcommand too.
  void addOptions(CLI::App& app);

  /// Adds a subcommand with --library, --json and --quiet; `run` is called when it was chosen.
  CLI::App* addCommand(CLI::App& parent, const std::string& name, const std::string& text,
                       std::function<void()> run);

  /// $PETROUS_LIBRARY, else the user's data folder, unless --library was given.
  library::Library openLibrary() const;

  bool json() const noexcept { return m_json; }

  /// Waits for the checks of what was read of the library: throws LibraryError (Damaged) where that
  /// is not what was stored, CancelledError. For a command before it writes a file or saves; `say`
  /// and `give` do it by themselves.
  void refuseDamaged() const;

  /// Words for a person on stdout; nothing with --json or --quiet.
  void print(const std::string& line) const;

  /// The one JSON object on stdout, with "notices" where the library had something to say; nothing
  /// without --json.
  void printJson(const nlohmann::json& object) const;

  /// Whether the one JSON object was given: a failure after it has no second one.
  bool gave() const noexcept { return m_gave; }

  /// A remark on stderr, e.g. what was accepted in a file; nothing with --quiet.
  void warn(const std::string& line) const;

  /// Bar on stderr when it is a terminal. Ctrl+C asks the work to stop, a second one ends it.
  core::Progress progress() const;

private:
  std::filesystem::path libraryFolder() const;

  // CLI11 reads numbers as the C library does: with a point until the command runs.
  std::optional<core::PlainNumbers> m_parsing{std::in_place};
  std::string m_library;
  mutable std::optional<library::Library> m_opened;
  mutable std::vector<std::string> m_notices; ///< of the library
  bool m_json = false;
  bool m_quiet = false;
  mutable bool m_gave = false;
};

/// `object` as --json prints it, with its schema version.
std::string jsonText(nlohmann::json object);

/// Text for an option that is in the contract and not built yet.
[[noreturn]] void notBuiltYet(const std::string& what);

/// The most that a file of options, points or poses may hold, bytes.
constexpr std::uintmax_t kLargestInput = std::uintmax_t{1} << 30;
constexpr std::uintmax_t kLargestJson = std::uintmax_t{1} << 20;

/// UsageError where `path`, the value of `option`, does not end in `suffix` (".png"), in any case:
/// a file whose name promises another format than it holds is opened by no program.
void requireSuffix(const std::string& option, const std::filesystem::path& path,
                   const std::string& suffix);

} // namespace petrous::cli
