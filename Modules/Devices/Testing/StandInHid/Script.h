#pragma once

#include <string>
#include <vector>

namespace standin
{

/// One parsed line of a script.
struct Command
{
  enum class Kind
  {
    Plug,
    Deny,
    Allow,
    Await,
    Report,
    Error,
    Unplug,
    Wait
  };
  Kind kind = Kind::Wait;
  std::string node;
  std::vector<unsigned char> bytes;
  unsigned short numbers[4] = {0, 0, 0, 0}; // vendor, product, page, usage
  std::wstring name;
  double milliseconds = 0.0;
};

/// The commands in playing order, with repetitions expanded and jitter included in the waits. Sets
/// `badLine` to the first invalid line, otherwise to 0.
std::vector<Command> parseScript(const std::string& text, int& badLine);

} // namespace standin
