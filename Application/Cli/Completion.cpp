#include "Completion.h"

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <iostream>

#include "CommandDefinitions.h"
#include "petrous/Network/NodeList.h"
#include "petrous/Scene/PlainText.h"

namespace petrous::cli
{

namespace
{

bool isOption(const std::string& word)
{
  return word.size() > 1 && word.front() == '-';
}

const Argument* findOption(const CommandDefinition& command, const std::string& name)
{
  for (const Argument& option : command.options)
    if (std::find(option.names.begin(), option.names.end(), name) != option.names.end())
      return &option;
  return nullptr;
}

// "F.csv|auto" and "NAME OUT" name what they take by words.
std::vector<std::string> wordsIn(const std::string& value)
{
  std::vector<std::string> words(1);
  for (const char c : value)
    if (std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '.')
      words.back() += c;
    else
      words.emplace_back();
  return words;
}

void propose(const std::string& candidate, const std::string& meaning = {})
{
  // A line that a shell can neither take apart nor run.
  if (candidate.empty() || scene::hasControls(candidate))
    return;
  std::cout << candidate << (meaning.empty() ? "" : "\t" + meaning) << '\n';
}

void requestFiles(const std::string& suffix)
{
  std::cout << "\tfiles" << (suffix.empty() ? "" : "\t" + suffix) << '\n';
}

// A case has the name of its file: nothing is opened, locked or recovered.
void proposeCases(const std::filesystem::path& library)
{
  std::vector<std::string> names;
  for (const auto& file : std::filesystem::directory_iterator(library / "cases"))
    if (file.path().extension() == ".json")
      names.push_back(file.path().stem().string());
  std::sort(names.begin(), names.end());
  for (const std::string& name : names)
    propose(name);
}

void proposeNodes(const std::filesystem::path& library)
{
  if (!std::filesystem::exists(library / "nodes.json"))
    return;
  const network::NodeList list(library);
  for (const network::Node& node : list.nodes())
    propose(node.name);
}

// What the argument takes as its value, the `n`th of one option.
void proposeValues(const Argument& argument, int n, const std::filesystem::path& library)
{
  for (const std::string& choice : argument.choices)
    if (n == 0)
      propose(choice);
  if (!argument.choices.empty() && n == 0)
    return;
  std::vector<std::string> words = wordsIn(argument.value);
  if (!isOption(argument.names.front()))
    words.push_back(argument.names.front());
  const bool isList = argument.value.find('=') != std::string::npos;
  for (const std::string& word : words)
  {
    const bool isLiteral =
        word.size() > 1 &&
        std::all_of(word.begin(), word.end(), [](char c) { return c >= 'a' && c <= 'z'; });
    if (word == "CASE")
      proposeCases(library);
    else if (word == "NODE")
      proposeNodes(library);
    else if (word == "DIR" || word == "FOLDER")
      std::cout << "\tfolders\n";
    else if (word == "F" || word == "FILE" || word == "PATH" || word == "TABLE" || word == "MAP" ||
             word == "IN" || word == "OUT" || word == "HOW" || word == "OTHER" || word == "COPY")
      requestFiles({});
    else if (word.rfind("F.", 0) == 0 || word.rfind("FILE.", 0) == 0)
      requestFiles(word.substr(word.find('.')));
    else if (isLiteral && !isList && argument.value.find('|') != std::string::npos)
      propose(word);
  }
  if (!argument.choices.empty()) // after the first
    requestFiles({});
}

void proposeOptions(const CommandDefinition& command)
{
  for (const Argument& option : command.options)
    propose(option.names.back(), option.text);
}

// What is known of the command line when its last word begins.
struct Parsed
{
  const Argument* option = nullptr; ///< that takes the last word, or may take it
  int values = 0;                   ///< of that option so far
  bool mayEnd = true;               ///< the last word may be something else
  std::size_t positionals = 0;      ///< so far
  bool onlyPositionals = false;     ///< after "--"
};

Parsed parse(const CommandDefinition& command, const std::vector<std::string>& words)
{
  Parsed parsed;
  for (const std::string& word : words)
  {
    if (parsed.option && (!parsed.mayEnd || !isOption(word)))
    {
      ++parsed.values;
      parsed.mayEnd = parsed.values >= parsed.option->minValues;
      if (parsed.values >= parsed.option->maxValues)
        parsed.option = nullptr;
    }
    else if (word == "--" && !parsed.onlyPositionals)
    {
      parsed.option = nullptr;
      parsed.onlyPositionals = true;
    }
    else if (isOption(word) && !parsed.onlyPositionals)
    {
      parsed.option = findOption(command, word); // "--name=value" is none of them
      parsed.values = 0;
      if (parsed.option && parsed.option->value.empty())
        parsed.option = nullptr;
      parsed.mayEnd = !parsed.option || parsed.option->minValues == 0;
    }
    else
      ++parsed.positionals;
  }
  return parsed;
}

void proposeFor(const CommandDefinition& command, const std::vector<std::string>& before,
                const std::string& word, const std::filesystem::path& library)
{
  const Parsed parsed = parse(command, before);
  const std::size_t equals = word.find('=');
  if (isOption(word) && equals != std::string::npos && parsed.mayEnd)
  {
    if (const Argument* option = findOption(command, word.substr(0, equals)))
      proposeValues(*option, 0, library);
    return;
  }
  if (parsed.option)
    proposeValues(*parsed.option, parsed.values, library);
  if (!parsed.mayEnd)
    return;
  if (isOption(word) || word == "-")
    return proposeOptions(command);
  if (command.positionals.empty())
    return proposeOptions(command);
  const std::size_t last = command.positionals.size() - 1;
  const Argument& positional = command.positionals[std::min(parsed.positionals, last)];
  if (parsed.positionals > last && !positional.isRepeated)
    return proposeOptions(command);
  if (command.name == "new") // a name that is not taken
    return;
  // The actions of the library that take cases.
  if (command.name == "library" && parsed.positionals > 0)
    return proposeCases(library);
  if (command.name == "nodes" && parsed.positionals > 0)
    return proposeNodes(library);
  proposeValues(positional, 0, library);
}

void complete(const Program& program, std::vector<std::string> words)
{
  Context context;
  CLI::App app;
  define(app, program, context);
  const std::string word = words.empty() ? std::string() : words.back();
  if (!words.empty())
    words.pop_back();
  if (const auto at = std::find(words.begin(), words.end(), "--library");
      at != words.end() && at + 1 != words.end() && !(at + 1)->empty())
  {
    CLI::Option* library = app.get_option("--library");
    library->add_result(*(at + 1));
    library->run_callback();
  }

  const CommandDefinition whole = definitionOf(app);
  const std::vector<CommandDefinition> commands = commandsOf(app);
  if (!words.empty() && words.front() == "help")
    words.erase(words.begin());
  const std::string name = subcommandIn(words);
  if (name.empty())
  {
    const Parsed parsed = parse(whole, words);
    if (!parsed.mayEnd || isOption(word) || word == "-")
      return proposeFor(whole, words, word, context.libraryFolder());
    for (const CommandDefinition& command : commands)
      propose(command.name, command.text);
    return;
  }
  const auto command = std::find_if(commands.begin(), commands.end(),
                                    [&name](const auto& one) { return one.name == name; });
  if (command == commands.end())
    return;
  words.erase(words.begin(), std::find(words.begin(), words.end(), name) + 1);
  proposeFor(*command, words, word, context.libraryFolder());
}

} // namespace

int printCompletions(const Program& program, const std::vector<std::string>& words)
{
  try
  {
    complete(program, words);
  }
  catch (const std::exception&) // a folder that cannot be read: nothing is proposed
  {
  }
  return 0;
}

} // namespace petrous::cli
