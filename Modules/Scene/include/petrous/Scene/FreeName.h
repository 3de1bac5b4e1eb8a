#pragma once

#include <string>

namespace petrous::scene
{

struct Case;

/// The letters in small (Unicode, as far as one letter becomes one, and German sharp s), all else
/// as it is: two names that a file system without regard to case holds for one are equal.
std::string caseFolded(const std::string& text);

/// What a reader sees of a name: caseFolded, an underscore as the blank that lists show instead,
/// and blanks only one at a time between words.
std::string asRead(const std::string& name);

/// The name of a part of the case that reads as `name` does, itself if there is one; empty: none.
/// New names must not be taken so; a case that holds such names opens all the same.
std::string partReadAs(const Case& value, const std::string& name);

/// Throws InvalidParameter unless the part `name` (empty: one that is added) may be called `to`.
void checkNewPartName(const Case& value, const std::string& name, const std::string& to);

/// `wanted`, with a number appended if it is taken: "nerve 2". `isTaken(name)` says whether it is.
template <class IsTaken>
std::string freeName(const std::string& wanted, const IsTaken& isTaken)
{
  std::string name = wanted;
  for (int n = 2; isTaken(name); ++n)
    name = wanted + " " + std::to_string(n);
  return name;
}

} // namespace petrous::scene
