#include "Script.h"

#include <algorithm>
#include <random>
#include <sstream>

namespace standin
{

namespace
{

using Kind = Command::Kind;

class Parser
{
public:
  bool line(const std::string& text)
  {
    std::istringstream words(text.substr(0, text.find('#')));
    std::string verb;
    if (!(words >> verb))
      return true;
    if (verb == "repeat")
    {
      const bool good = m_repeat == 0 && words >> m_repeat && m_repeat > 0;
      m_begin = m_commands.size();
      return good;
    }
    if (verb == "end")
      return endRepeat();
    if (verb == "jitter")
      return static_cast<bool>(words >> m_jitter) && m_jitter >= 0.0;
    Command command;
    if (!parse(verb, words, command))
      return false;
    m_commands.push_back(command);
    return true;
  }

  bool complete() const { return m_repeat == 0; }

  std::vector<Command> commands()
  {
    std::mt19937 random(1);
    for (Command& command : m_commands)
      if (command.kind == Kind::Wait && m_jitter > 0.0)
        command.milliseconds =
            std::max(0.0, command.milliseconds +
                              std::uniform_real_distribution<double>(-m_jitter, m_jitter)(random));
    return m_commands;
  }

private:
  bool endRepeat()
  {
    if (m_repeat == 0)
      return false;
    const std::vector<Command> body(m_commands.begin() + static_cast<std::ptrdiff_t>(m_begin),
                                    m_commands.end());
    for (int i = 1; i < m_repeat; ++i)
      m_commands.insert(m_commands.end(), body.begin(), body.end());
    m_repeat = 0;
    return true;
  }

  static bool parse(const std::string& verb, std::istringstream& words, Command& command)
  {
    if (verb == "wait")
      return static_cast<bool>(words >> command.milliseconds);
    if (!(words >> command.node))
      return false;
    static const std::pair<const char*, Kind> kPlain[] = {{"deny", Kind::Deny},
                                                          {"allow", Kind::Allow},
                                                          {"await", Kind::Await},
                                                          {"error", Kind::Error},
                                                          {"unplug", Kind::Unplug}};
    for (const auto& [name, kind] : kPlain)
      if (verb == name)
      {
        command.kind = kind;
        return true;
      }
    if (verb == "report")
    {
      command.kind = Kind::Report;
      for (unsigned value = 0; words >> std::hex >> value;)
        command.bytes.push_back(static_cast<unsigned char>(value));
      return words.eof();
    }
    if (verb != "plug")
      return false;
    command.kind = Kind::Plug;
    for (unsigned short& number : command.numbers)
      if (!(words >> std::hex >> number))
        return false;
    std::string name;
    std::getline(words >> std::ws, name);
    command.name.assign(name.begin(), name.end());
    return true;
  }

  std::vector<Command> m_commands;
  std::size_t m_begin = 0;
  int m_repeat = 0;
  double m_jitter = 0.0;
};

} // namespace

std::vector<Command> parseScript(const std::string& text, int& badLine)
{
  Parser parser;
  std::istringstream lines(text);
  std::string line;
  int number = 0;
  badLine = 0;
  while (std::getline(lines, line))
  {
    ++number;
    if (!parser.line(line))
    {
      badLine = number;
      return {};
    }
  }
  if (!parser.complete())
  {
    badLine = number;
    return {};
  }
  return parser.commands();
}

} // namespace standin
