#pragma once

#include <string>
#include <vector>

namespace standin
{

/// One line of a script, taken apart.
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

/// The commands in the order in which they are played, repetitions written out and jitter worked
/// into the waits. Sets `badLine` to the first line that is not understood, otherwise to 0.
std::vector<Command> parseScript(const std::string& text, int& badLine);

} // namespace standin
