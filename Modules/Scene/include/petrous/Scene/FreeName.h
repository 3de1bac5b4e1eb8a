#pragma once

#include <string>

namespace petrous::scene
{

struct Case;

/// The letters folded to one case and composed (Unicode 3.13, D145: canonical caseless matching),
/// all else as it is: two names that a file system without regard to case or composition holds for
/// one are equal. Bytes that are not UTF-8 stay, but for ASCII capitals.
std::string caseFolded(const std::string& text);

/// What a reader sees of a name: caseFolded, an underscore as the blank that lists show instead,
/// blanks of any kind as one between words, and without what has no width.
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
