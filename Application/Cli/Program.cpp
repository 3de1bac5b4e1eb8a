#include "Program.h"

#include <algorithm>
#include <cctype>
#include <csignal>
#include <iostream>
#include <memory>
#include <new>
#include <sstream>

#include <fcntl.h>
#include <unistd.h>

#include "CommandDefinitions.h"
#include "petrous/Core/Error.h"
#include "petrous/Core/FileSizeLimit.h"
#include "petrous/Core/Log.h"
#include "petrous/Core/StandardStreams.h"

namespace petrous::cli
{

namespace
{

enum ExitCode
{
  kDone = 0,
  kOurFault = 1,
  kUsage = 2,
  kBadInput = 3,
  kRefused = 4
};

struct Failure
{
  const char* kind; ///< as named by --json
  int exitCode;
};

constexpr Failure kUsageFailure{"usage", kUsage};
constexpr Failure kRefusal{"refused", kRefused};
constexpr Failure kInternalFailure{"internal", kOurFault};
constexpr Failure kInterruption{"interrupted", 128 + SIGINT};

Failure failureOf(core::Fault fault)
{
  switch (fault)
  {
  case core::Fault::BadInput:
    return {"bad-input", kBadInput};
  case core::Fault::Refused:
    return kRefusal;
  case core::Fault::Cancelled:
    return kInterruption;
  case core::Fault::Internal:
    break;
  }
  return kInternalFailure;
}

Failure failureOf(const std::exception& error)
{
  if (dynamic_cast<const UsageError*>(&error))
    return kUsageFailure;
  if (const auto* known = dynamic_cast<const core::Error*>(&error))
    return failureOf(known->fault());
  if (dynamic_cast<const std::filesystem::filesystem_error*>(&error) ||
      dynamic_cast<const std::bad_alloc*>(&error))
    return kRefusal;
  return kInternalFailure;
}

// With --json the single object on stdout describes the failure, unless the result was printed
// there.
int complain(const Program& program, const std::string& text, const Failure& failure, bool json)
{
  std::cerr << program.name << ": " << terminalText(text) << '\n';
  if (json)
    std::cout << jsonText(
                     {{"error",
                       {{"kind", failure.kind}, {"text", text}, {"exit_code", failure.exitCode}}}})
              << std::flush;
  if (failure.exitCode != kInterruption.exitCode)
    return failure.exitCode;
  // A shell stops a loop of commands only if the process was ended by the signal itself.
  std::signal(SIGINT, SIG_DFL);
  std::raise(SIGINT);
  return failure.exitCode;
}

bool isBlank(const std::string& text)
{
  return text.find_first_not_of(" \t") == std::string::npos;
}

// An empty value is not an omitted option (an unset variable in a script), and the next option is
// not a value. Also checks both sides of NAME=VALUE.
std::string emptyValue(const std::string& value, bool pair, bool mayBeEmpty)
{
  if (value.empty() && mayBeEmpty)
    return "";
  if (isBlank(value))
    return "the value is empty; give one, or leave it out";
  if (value.size() > 2 && value.compare(0, 2, "--") == 0 &&
      std::isalpha(static_cast<unsigned char>(value[2])) != 0)
    return "a value is missing before '" + value + "'";
  const bool oneSided = pair && (value.front() == '=' || value.back() == '=');
  return oneSided ? "'" + value + "' is empty on one side of '='" : "";
}

bool mayBeEmpty(CLI::Option& option)
{
  try
  {
    option.get_validator(kMayBeEmpty);
    return true;
  }
  catch (const CLI::OptionNotFound&)
  {
    return false;
  }
}

// For every option and argument of the program and of every subcommand.
void refuseEmptyValues(CLI::App& app)
{
  const auto all = [](const auto*) { return true; };
  for (CLI::Option* option : app.get_options(all))
    if (option->get_items_expected_max() > 0)
    {
      const bool pair = option->get_type_name().find('=') != std::string::npos;
      // before other checks, such as ranges
      option->transform(CLI::Validator([pair, isOwn = mayBeEmpty(*option)](std::string& value)
                                       { return emptyValue(value, pair, isOwn); },
                                       ""));
    }
  for (CLI::App* command : app.get_subcommands(all))
    refuseEmptyValues(*command);
}

// "--option=" followed by nothing would take the next argument as its value.
std::string optionWithoutValue(const std::vector<std::string>& words)
{
  for (const std::string& word : words)
  {
    if (word == "--")
      break;
    if (word.size() > 3 && word.compare(0, 2, "--") == 0 && word.find('=') == word.size() - 1)
      return word.substr(0, word.size() - 1);
  }
  return {};
}

// A flag that switches something off has no value: the parser would negate it, or take it for that
// of the flag that switches on.
std::string negationWithValue(const CLI::App& command, const std::vector<std::string>& words)
{
  for (const std::string& word : words)
  {
    if (word == "--")
      break;
    const std::size_t end = word.find('=');
    if (word.compare(0, 5, "--no-") != 0 || end == std::string::npos)
      continue;
    const CLI::Option* option = command.get_option_no_throw(word.substr(0, end));
    if (option && option->get_items_expected_max() == 0)
      return word.substr(0, end);
  }
  return {};
}

// A flag and the one that switches it off: the parser would take the last, or neither.
std::string contradiction(const CLI::App& command, const std::vector<std::string>& words)
{
  const auto end = std::find(words.begin(), words.end(), "--");
  for (auto word = words.begin(); word != end; ++word)
  {
    const std::string off = word->substr(0, word->find('='));
    if (off.compare(0, 5, "--no-") != 0)
      continue;
    const std::string on = "--" + off.substr(5);
    const bool isGiven = std::any_of(words.begin(), end,
                                     [&on](const std::string& other)
                                     { return other.substr(0, other.find('=')) == on; });
    if (isGiven && command.get_option_no_throw(on) && command.get_option_no_throw(off))
      return on + " and " + off;
  }
  return {};
}

// Empty list items are dropped by the parser before they can be checked.
std::string listWithGap(CLI::App& command, const std::vector<std::string>& words)
{
  for (const CLI::Option* option : command.get_options([](const auto*) { return true; }))
    for (std::size_t n = 0; option->get_delimiter() != '\0' && n < words.size(); ++n)
    {
      const std::string name = option->get_name();
      std::string list;
      if (words[n] == name && n + 1 < words.size())
        list = words[n + 1];
      else if (words[n].compare(0, name.size() + 1, name + "=") == 0)
        list = words[n].substr(name.size() + 1);
      else
        continue;
      if (isBlank(list)) // reported as for any option
        continue;
      std::istringstream items(list + option->get_delimiter());
      for (std::string item; std::getline(items, item, option->get_delimiter());)
        if (isBlank(item))
          return name;
    }
  return {};
}

// As the parser's own, but for "--shadows,--no-shadows{false}" and "FLOAT:0 to 1".
class HelpFormatter : public CLI::Formatter
{
public:
  std::string make_option_name(const CLI::Option* option, bool isPositional) const override
  {
    std::string names = CLI::Formatter::make_option_name(option, isPositional);
    for (auto brace = names.find('{'); brace != names.npos; brace = names.find('{'))
      names.erase(brace, names.find('}', brace) - brace + 1);
    return names;
  }

  std::string make_option_opts(const CLI::Option* option) const override
  {
    std::string text = CLI::Formatter::make_option_opts(option);
    const std::string both = option->get_type_name();
    const auto at = both.empty() ? text.npos : text.find(both);
    if (at == text.npos)
      return text;
    const auto [type, range] = typeAndRange(*option);
    return text.replace(at, both.size(), type + (range.empty() ? "" : " (" + range + ")"));
  }
};

int parsed(const Program& program, std::vector<std::string> words, Context& context)
{
  const std::string help = "; see '" + program.name + " --help'";
  CLI::App app;
  define(app, program, context);
  const std::string name = subcommandIn(words);
  const auto isNamed = [&name](const CLI::App* command) { return command->get_name() == name; };
  if (!name.empty() && app.get_subcommands(isNamed).empty())
    throw UsageError("unknown subcommand '" + name + "'" + help);
  if (const std::string option = optionWithoutValue(words); !option.empty())
    throw UsageError(option + ": the value is empty; give one, or leave it out");
  if (!name.empty())
  {
    CLI::App& command = *app.get_subcommand(name);
    if (const std::string option = listWithGap(command, words); !option.empty())
      throw UsageError(option + ": a value of its list is empty; give one, or leave it out");
    if (const std::string option = negationWithValue(command, words); !option.empty())
      throw UsageError(option + " takes no value" + help);
    if (const std::string both = contradiction(command, words); !both.empty())
      throw UsageError(both + " contradict each other; give one of them" + help);
  }
  refuseEmptyValues(app);
  // CLI11 takes no more words of a list after "--" that has some already.
  if (const auto mark = std::find(words.begin(), words.end(), "--");
      mark != words.end() &&
      std::none_of(mark + 1, words.end(),
                   [](const std::string& word) { return !word.empty() && word[0] == '-'; }))
    words.erase(mark);
  try
  {
    std::reverse(words.begin(), words.end()); // the order that CLI11 expects
    app.parse(std::move(words));
  }
  catch (const CLI::Success& asked) // --help, --version
  {
    return app.exit(asked);
  }
  catch (const CLI::ParseError& error)
  {
    throw UsageError(error.what() + help);
  }
  std::cout.flush();
  if (!std::cout)
    throw core::Error(
        core::Fault::Internal,
        "it is done, but the answer could not be written to stdout (is the disk full, "
        "or stdout closed?)");
  return kDone;
}

} // namespace

void define(CLI::App& app, const Program& program, Context& context)
{
  app.name(program.name);
  app.description(program.text);
  app.formatter(std::make_shared<HelpFormatter>()); // commands have it of it
  app.set_version_flag("--version", program.name + " " PETROUS_VERSION);
  app.require_subcommand(1);
  app.footer("'" + program.name + " help COMMAND' shows the help of a command.\n" + kExitCodes);
  context.addOptions(app);
  program.addCommands(app, context);
}

std::string messageOf(const std::exception& error)
{
  if (dynamic_cast<const UsageError*>(&error) || dynamic_cast<const core::Error*>(&error))
    return error.what();
  if (const auto* file = dynamic_cast<const std::filesystem::filesystem_error*>(&error))
    return file->path1().string() +
           ": cannot be read or written; check that it is there and its permissions";
  if (dynamic_cast<const std::bad_alloc*>(&error))
    return "not enough memory; close other programs, or load less with --roi";
  return "an unexpected error; the library is unchanged";
}

std::vector<std::string> wordsOf(int argc, char** argv)
{
  std::vector<std::string> words(argv + 1, argv + argc);
  if (words.empty() || words.front() != "help")
    return words;
  words.erase(words.begin());
  words.push_back("--help");
  return words;
}

std::string subcommandIn(const std::vector<std::string>& words)
{
  for (std::size_t n = 0; n < words.size(); ++n)
    if (words[n] == "--library" || words[n] == "--log-level")
      ++n;
    else if (words[n].empty() || words[n][0] != '-')
      return words[n];
  return {};
}

std::filesystem::path programBeside(const std::string& name, const std::string& inBuildTree)
{
  std::error_code error;
  const auto folder = std::filesystem::read_symlink("/proc/self/exe", error).parent_path();
  for (const auto& candidate : {folder / name, folder / inBuildTree / name})
    if (std::filesystem::exists(candidate, error))
      return candidate;
  return {};
}

int run(const Program& program, const std::vector<std::string>& words)
{
  core::holdStandardStreams();
  core::failBeyondFileSizeLimit();
  Context context;
  // Invalid command lines are answered in JSON too.
  const auto fail = [&](const std::string& text, const Failure& as, const std::exception& error)
  {
    // The text may name files and cases after patients.
    context.logEnd(as.exitCode, as.kind + (", " + core::log::typeOf(error)));
    const bool json = std::find(words.begin(), words.end(), "--json") != words.end();
    return complain(program, text, as, json && !context.gave());
  };
  try
  {
    const int code = parsed(program, words, context);
    context.logEnd(code);
    return code;
  }
  catch (const std::exception& error)
  {
    return fail(messageOf(error), failureOf(error), error);
  }
}

} // namespace petrous::cli
