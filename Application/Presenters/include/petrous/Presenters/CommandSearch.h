#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace petrous::presenters
{

/// What can be done in the window, as the command palette lists it.
struct CommandEntry
{
  std::string name; ///< "Register the MR"
  std::string menu; ///< where it is: "Registration"
  std::string tip;  ///< what it does
};

/// Those that a search finds, best first: each of its words must be in name, menu or tip, whatever
/// the case. A name that begins with the search comes first, then words at the beginning of words
/// of the name, words within it, in name and menu, and in the tip; equals stay in their order. An
/// empty search finds all.
std::vector<std::size_t> findCommands(const std::vector<CommandEntry>& commands,
                                      const std::string& search);

} // namespace petrous::presenters
