#pragma once

#include <string>

namespace petrous::scene
{

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
