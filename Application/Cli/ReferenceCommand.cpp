#include <algorithm>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "CommandDefinitions.h"
#include "Commands.h"
#include "Numbers.h"
#include "petrous/Core/AsciiCase.h"
#include "petrous/Core/OutputFile.h"

namespace petrous::cli
{

namespace
{

namespace fs = std::filesystem;

constexpr const char* kDisclaimer =
    "Petrous is for rehearsal, teaching and research. It is not a medical device.";

std::string sentence(std::string text)
{
  return text.empty() || text.back() == '.' ? text : text + ".";
}

// Text, range, default and what it cannot be combined with.
std::string explanation(const Argument& argument)
{
  std::string text = sentence(argument.text);
  const auto add = [&text](const std::string& more) { text += (text.empty() ? "" : " ") + more; };
  if (!argument.range.empty())
    add("Range: " + argument.range + ".");
  if (!argument.preset.empty())
    add("Default: " + argument.preset + ".");
  if (argument.isRepeated)
    add("May be repeated.");
  if (argument.isRequired && argument.names.front().front() == '-')
    add("Required.");
  if (!argument.excludes.empty())
    add("Not together with " + CLI::detail::join(argument.excludes, ", ") + ".");
  return text;
}

std::string inBrackets(const Argument& argument)
{
  const std::string name = argument.names.front() + (argument.isRepeated ? " ..." : "");
  return argument.isRequired ? name : "[" + name + "]";
}

// --- man: roff with the macros of man(7)

std::string roff(const std::string& text)
{
  std::string out;
  for (const char c : text)
    switch (c)
    {
    case '\\':
      out += "\\e";
      break;
    case '-':
      out += "\\-"; // one that can be searched and pasted
      break;
    case '\'':
      out += "\\(aq";
      break;
    case '\n':
      out += "\n.br\n";
      break;
    case '.':
      out += out.empty() || out.back() == '\n' ? "\\&." : ".";
      break;
    default:
      out += c;
    }
  return out;
}

std::string bold(const std::string& text)
{
  return "\\fB" + roff(text) + "\\fR";
}

std::string italic(const std::string& text)
{
  return "\\fI" + roff(text) + "\\fR";
}

std::string heading(const std::string& name, const std::string& text, const std::string& version)
{
  std::string upper = name;
  std::transform(upper.begin(), upper.end(), upper.begin(), core::asciiUpper);
  const std::string firstLine = text.substr(0, text.find('\n'));
  return ".TH " + roff(upper) + " 1 \"\" \"" + roff(version) + "\" Petrous\n.SH NAME\n" +
         roff(name) + " \\- " + roff(firstLine) + "\n";
}

std::string entries(const std::vector<Argument>& arguments)
{
  std::string page;
  for (const Argument& argument : arguments)
  {
    page += ".TP\n";
    for (const std::string& name : argument.names)
      page += (&name == &argument.names.front() ? "" : ", ") +
              (name.front() == '-' ? bold(name) : italic(name));
    if (!argument.value.empty() && argument.names.front().front() == '-')
      page += " " + italic(argument.value);
    const std::string text = roff(explanation(argument));
    page += "\n" + (text.empty() ? "\\&" : text) + "\n";
  }
  return page;
}

std::string closing(const std::vector<std::string>& others)
{
  std::string page = ".SH EXIT STATUS\n" + roff(std::string(kExitCodes).substr(12)) +
                     ".\n.SH NOTES\n" + roff(kDisclaimer) + "\n.SH SEE ALSO\n";
  for (const std::string& other : others)
    page += ".BR " + roff(other) + " (1)" + (&other == &others.back() ? "" : ",") + "\n";
  return page + ".PP\nThe manual: menu Help of the window, or\n.I " +
         roff("/usr/share/doc/petrous/manual/index.html") + "\n";
}

std::string manPage(const CommandDefinition& command, const std::string& program,
                    const std::string& version)
{
  const std::string name = program + "-" + command.name;
  std::string page = heading(name, command.text, version) + ".SH SYNOPSIS\n.B " +
                     roff(program + " " + command.name) + "\n[" + italic("OPTIONS") + "]";
  for (const Argument& positional : command.positionals)
    page += " " + italic(inBrackets(positional));
  page += "\n.SH DESCRIPTION\n" + roff(sentence(command.text)) + "\n";
  if (!command.positionals.empty())
    page += ".SH ARGUMENTS\n" + entries(command.positionals);
  return page + ".SH OPTIONS\n" + entries(command.options) + closing({program});
}

std::string manPage(const CommandDefinition& whole, const std::vector<CommandDefinition>& commands,
                    const std::string& version)
{
  std::string page = heading(whole.name, whole.text, version) + ".SH SYNOPSIS\n.B " +
                     roff(whole.name) + "\n.br\n.B " + roff(whole.name) + "\n[" +
                     italic("OPTIONS") + "] " + italic("COMMAND") + " ...\n.SH DESCRIPTION\n" +
                     roff(whole.text) + "\n.PP\n" + bold(whole.name + " help ") +
                     italic("COMMAND") + " shows the help of a command.\n.SH COMMANDS\n";
  std::vector<std::string> pages;
  for (const CommandDefinition& command : commands)
  {
    page += ".TP\n" + bold(command.name) + "\n" + roff(sentence(command.text)) + "\n";
    pages.push_back(whole.name + "-" + command.name);
  }
  page += ".SH OPTIONS\n" + entries(whole.options) +
          ".SH ENVIRONMENT\n.TP\n.B PETROUS_LIBRARY\nFolder of the library, where " +
          bold("--library") +
          " is not given.\n.TP\n.B PETROUS_LOG_LEVEL\nLevel of the log, where " +
          bold("--log-level") + " is not given.\n";
  return page + closing(pages);
}

// --- Markdown, for the manual

// A cell of a table.
std::string cell(const std::string& text)
{
  std::string out;
  for (const char c : text)
    if (c == '\n')
      out += ' ';
    else
      out +=
          (std::string("|*_<>[]`\\").find(c) == std::string::npos ? "" : "\\") + std::string(1, c);
  return out;
}

// One as it is typed; the bar would end the cell.
std::string code(std::string text)
{
  for (std::size_t at = 0; (at = text.find('|', at)) != std::string::npos; at += 2)
    text.insert(at, "\\");
  return "`" + text + "`";
}

std::string rows(const std::vector<Argument>& arguments)
{
  std::string page = "\n| | |\n|---|---|\n";
  for (const Argument& argument : arguments)
  {
    std::string names = CLI::detail::join(argument.names, ", ");
    if (!argument.value.empty() && argument.names.front().front() == '-')
      names += " " + argument.value;
    page += "| " + code(names) + " | " + cell(explanation(argument)) + " |\n";
  }
  return page;
}

std::string markdown(const CommandDefinition& whole, const std::vector<CommandDefinition>& commands)
{
  const auto shared = [&whole](const Argument& option)
  {
    return std::any_of(whole.options.begin(), whole.options.end(),
                       [&option](const Argument& other) { return other.names == option.names; });
  };
  std::string page = "## Options of every command\n" + rows(whole.options);
  for (CommandDefinition command : commands)
  {
    page += "\n## petrous " + command.name + "\n\n" + cell(sentence(command.text)) + "\n\n    " +
            whole.name + " " + command.name + " [OPTIONS]";
    for (const Argument& positional : command.positionals)
      page += " " + inBrackets(positional);
    page += "\n";
    auto& options = command.options;
    options.erase(std::remove_if(options.begin(), options.end(), shared), options.end());
    std::vector<Argument> all = command.positionals;
    all.insert(all.end(), options.begin(), options.end());
    if (!all.empty())
      page += rows(all);
  }
  return page;
}

void write(const CLI::App& app, Context& context, const std::string& format, const fs::path& folder)
{
  const CommandDefinition whole = definitionOf(app);
  const std::vector<CommandDefinition> commands = commandsOf(app);
  fs::create_directories(folder);
  nlohmann::json files = nlohmann::json::array();
  const auto add = [&](const std::string& name, const std::string& text)
  {
    context.refuseOverwriting({(folder / name).string()});
    core::writeFile(folder / name, text);
    files.push_back(name);
    context.print((folder / name).string());
  };
  if (format == "markdown")
    add(whole.name + ".md", markdown(whole, commands));
  else
  {
    const std::string version = app.version();
    add(whole.name + ".1", manPage(whole, commands, version));
    for (const CommandDefinition& command : commands)
      add(whole.name + "-" + command.name + ".1", manPage(command, whole.name, version));
  }
  context.printJson({{"out", folder.string()}, {"files", std::move(files)}});
}

} // namespace

void addReferenceCommand(CLI::App& app, Context& context)
{
  struct Options
  {
    std::string format, out;
  };
  auto options = std::make_shared<Options>();
  CLI::App* command = context.addCommand(
      app, "reference", "Write the man pages, or the reference of all commands in Markdown",
      [options, &app, &context] { write(app, context, options->format, options->out); });
  command->add_option("FORMAT", options->format, "man or markdown")
      ->check(oneOf({"man", "markdown"}))
      ->required();
  command
      ->add_option("FOLDER", options->out,
                   "Where the files go; those of the same names are "
                   "replaced")
      ->required();
}

} // namespace petrous::cli
