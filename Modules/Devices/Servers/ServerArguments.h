#pragma once

#include <charconv>
#include <cstdio>
#include <cstring>
#include <map>
#include <string>

namespace petrous::devices
{

/// Arguments of a device server: options with one value each, then the name of the block.
class ServerArguments
{
public:
  /// `options` maps each option to its default. False, with the usage on stderr, for others.
  bool parse(int argc, char** argv, std::map<std::string, std::string> options)
  {
    m_options = std::move(options);
    int i = 1;
    for (; i + 2 < argc; i += 2)
    {
      const auto option = m_options.find(argv[i]);
      if (option == m_options.end())
        break;
      option->second = argv[i + 1];
    }
    if (i + 1 == argc && argv[i][0] == '/')
    {
      m_block = argv[i];
      return true;
    }
    const char* slash = std::strrchr(argv[0], '/');
    std::fprintf(stderr, "usage: %s", slash ? slash + 1 : argv[0]);
    for (const auto& [name, value] : m_options)
      std::fprintf(stderr, " [%s VALUE]", name.c_str());
    std::fprintf(stderr, " BLOCK\n");
    return false;
  }

  const std::string& block() const { return m_block; }
  const std::string& text(const std::string& option) const { return m_options.at(option); }

  /// False, with a message on stderr, unless the option is a number in [least, most].
  bool number(const std::string& option, double least, double most, double& value) const
  {
    const std::string& given = text(option);
    const char* end = given.data() + given.size();
    const auto [rest, error] = std::from_chars(given.data(), end, value);
    if (error == std::errc() && rest == end && value >= least && value <= most)
      return true;
    std::fprintf(stderr, "%s %s: must be a number from %s to %s\n", option.c_str(), given.c_str(),
                 asText(least).c_str(), asText(most).c_str());
    return false;
  }

private:
  static std::string asText(double number)
  {
    char digits[32] = {};
    std::to_chars(digits, digits + sizeof digits - 1, number);
    return digits;
  }

  std::map<std::string, std::string> m_options;
  std::string m_block;
};

} // namespace petrous::devices
