#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "Context.h"

namespace petrous::cli
{

/// A program of subcommands.
struct Program
{
  std::string name; ///< as typed
  std::string text; ///< of its help
  std::function<void(CLI::App&, Context&)> addCommands;
};

/// Parses the words (without the program's own name) and runs the subcommand that they choose. What
/// that throws becomes a line on stderr, with --json one object on stdout, and the exit code that
/// kExitCodes lists.
int run(const Program& program, const std::vector<std::string>& words);

/// The words after the program's name. `help` and `help COMMAND` become `--help` and
/// `COMMAND --help`.
std::vector<std::string> wordsOf(int argc, char** argv);

/// The first word that is neither an option nor the value of --library; empty: there is none.
std::string subcommandIn(const std::vector<std::string>& words);

/// Another program of ours: in the folder of this one, or where a build tree has it, relative to
/// that folder. Empty: neither.
std::filesystem::path programBeside(const std::string& name, const std::string& inBuildTree);

} // namespace petrous::cli
