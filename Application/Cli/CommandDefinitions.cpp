#include "CommandDefinitions.h"

#include <algorithm>
#include <map>

#include <CLI/CLI.hpp>

#include "Numbers.h"

namespace petrous::cli
{

std::pair<std::string, std::string> typeAndRange(const CLI::Option& option)
{
  const std::string both = option.get_type_name();
  const std::size_t colon = both.find(':');
  std::string type = both.substr(0, colon);
  static const std::map<std::string, std::string> kWords{
      {"FLOAT", "NUMBER"}, {"INT", "NUMBER"}, {"UINT", "NUMBER"}};
  if (const auto word = kWords.find(type); word != kWords.end())
    type = word->second;
  return {type, colon == std::string::npos ? "" : both.substr(colon + 1)};
}

namespace
{

std::vector<std::string> choicesOf(CLI::Option& option)
{
  for (int n = 0;; ++n)
  {
    const CLI::Validator* check = nullptr;
    try
    {
      check = option.get_validator(n);
    }
    catch (const CLI::OptionNotFound&)
    {
      return {};
    }
    if (!check->get_name().empty())
      return CLI::detail::split(check->get_name(), kBetweenChoices);
  }
}

Argument argumentOf(CLI::Option& option)
{
  Argument argument;
  if (option.get_positional())
    argument.names = {option.get_name(true)};
  else
  {
    for (const std::string& name : option.get_snames())
      argument.names.push_back("-" + name);
    for (const std::string& name : option.get_lnames())
      argument.names.push_back("--" + name);
  }
  argument.text = option.get_description();
  if (argument.text.empty() && argument.names.front() == "CASE")
    argument.text = "Name of the case";
  if (option.get_items_expected_max() > 0)
  {
    std::tie(argument.value, argument.range) = typeAndRange(option);
    argument.preset = option.get_default_str();
    argument.choices = choicesOf(option);
    if (!argument.choices.empty())
      argument.value = CLI::detail::join(argument.choices, "|");
  }
  for (const CLI::Option* other : option.get_excludes())
    argument.excludes.push_back(other->get_name());
  std::sort(argument.excludes.begin(), argument.excludes.end());
  argument.isRequired = option.get_required();
  argument.minValues = option.get_items_expected_min();
  argument.maxValues = option.get_items_expected_max();
  argument.isRepeated = option.get_expected_max() == CLI::detail::expected_max_vector_size;
  if (argument.isRepeated && !option.get_positional() && !option.get_allow_extra_args())
    argument.maxValues = argument.minValues;
  return argument;
}

} // namespace

CommandDefinition definitionOf(const CLI::App& app)
{
  CommandDefinition command{app.get_name(), app.get_description(), {}, {}};
  // The check of a value can be asked only of an option that may be changed.
  for (CLI::Option* option :
       const_cast<CLI::App&>(app).get_options([](CLI::Option*) { return true; }))
    if (!option->get_group().empty())
      (option->get_positional() ? command.positionals : command.options)
          .push_back(argumentOf(*option));
  return command;
}

std::vector<CommandDefinition> commandsOf(const CLI::App& app)
{
  std::vector<CommandDefinition> commands;
  for (const CLI::App* command : app.get_subcommands([](const CLI::App*) { return true; }))
    if (!command->get_group().empty())
      commands.push_back(definitionOf(*command));
  return commands;
}

} // namespace petrous::cli
