#pragma once

#include <filesystem>
#include <fstream>
#include <memory>
#include <stdexcept>
#include <string>

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

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

/// What every subcommand shares: where the library is and how to speak.
class Context
{
public:
  /// Adds a subcommand with --library, --json and --quiet; `run` is called when it was chosen.
  CLI::App* addCommand(CLI::App& parent, const std::string& name, const std::string& text,
                       std::function<void()> run);

  /// $PETROUS_LIBRARY, else the user's data folder, unless --library was given.
  library::Library openLibrary() const;

  bool json() const noexcept { return m_json; }

  /// Words for a person on stdout; nothing with --json or --quiet.
  void say(const std::string& line) const;

  /// The one JSON object on stdout; nothing without --json.
  void give(const nlohmann::json& object) const;

  /// A remark on stderr, e.g. what was accepted in a file; nothing with --quiet.
  void remark(const std::string& line) const;

  /// Bar on stderr when it is a terminal; Ctrl+C asks the work to stop.
  core::Progress progress() const;

private:
  std::filesystem::path libraryFolder() const;

  std::string m_library;
  bool m_json = false;
  bool m_quiet = false;
};

/// Text for an option that is in the contract and not built yet.
[[noreturn]] void notBuiltYet(const std::string& what);

/// A file to read; InvalidParameter naming it when it is not there, a folder or not readable.
std::ifstream openForReading(const std::filesystem::path& path);

/// Makes `bytes` the file's content, by a temporary file and rename.
void writeTextFile(const std::filesystem::path& path, const std::string& bytes);

} // namespace petrous::cli
