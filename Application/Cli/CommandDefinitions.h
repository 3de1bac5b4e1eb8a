#pragma once

#include <string>
#include <utility>
#include <vector>

namespace CLI
{
class App;
class Option;
} // namespace CLI

namespace petrous::cli
{

/// An option or a positional argument as it was added to the parser.
struct Argument
{
  std::vector<std::string> names; ///< "-h", "--help"; of a positional argument "CASE"
  std::string value;              ///< what it takes, "F.csv"; empty: a flag
  std::string text;               ///< what it does
  std::string range;              ///< of a number; empty: none is stated
  std::string preset;             ///< its default; empty: none is stated
  std::vector<std::string> choices;
  std::vector<std::string> excludes; ///< options that do not go with it
  bool isRequired = false;
  bool isRepeated = false; ///< may be given more than once, or takes a list
  int minValues = 0;       ///< each time
  int maxValues = 0;
};

struct CommandDefinition
{
  std::string name;
  std::string text;
  std::vector<Argument> positionals;
  std::vector<Argument> options;
};

/// What an option takes, and the range that its checks state ("TEXT:0.1 to 20 mm" of the parser).
std::pair<std::string, std::string> typeAndRange(const CLI::Option& option);

CommandDefinition definitionOf(const CLI::App& app);

/// The subcommands, in the order in which they were added; hidden ones are left out.
std::vector<CommandDefinition> commandsOf(const CLI::App& app);

} // namespace petrous::cli
