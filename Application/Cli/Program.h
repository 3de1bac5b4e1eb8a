#pragma once

#include <exception>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "Context.h"

namespace petrous::cli
{

/// A program with subcommands.
struct Program
{
  std::string name; ///< as typed
  std::string text; ///< shown in its help
  std::function<void(CLI::App&, Context&)> addCommands;
};

/// An option with a validator of this name takes an empty value, which others refuse.
constexpr const char* kMayBeEmpty = "may be empty";

/// Adds name, text, options and subcommands to an empty parser; the context must outlive it.
void define(CLI::App& app, const Program& program, Context& context);

/// Parses the arguments (without the program's name) and runs the selected subcommand. Exceptions
/// become a line on stderr, with --json an object on stdout, and the exit code listed in
/// kExitCodes.
int run(const Program& program, const std::vector<std::string>& words);

/// What the user is told of an exception, one line. Messages of other libraries may contain patient
/// data, and are left out.
std::string messageOf(const std::exception& error);

/// The arguments after the program's name. `help` and `help COMMAND` become `--help` and `COMMAND
/// --help`.
std::vector<std::string> wordsOf(int argc, char** argv);

/// The first argument that is neither an option nor the value of --library or --log-level; empty if
/// there is none.
std::string subcommandIn(const std::vector<std::string>& words);

/// Another program of this project: in the folder of this one, or at `inBuildTree`, relative to
/// that folder. Empty if neither exists.
std::filesystem::path programBeside(const std::string& name, const std::string& inBuildTree);

} // namespace petrous::cli
