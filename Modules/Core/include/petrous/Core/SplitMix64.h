#pragma once

#include <cstdint>

namespace petrous::core
{

/// SplitMix64: a pseudorandom bijection of 64 bits (Steele, Lea, Flood 2014), for random numbers
/// that are independent of library and machine.
constexpr std::uint64_t splitMix64(std::uint64_t x) noexcept
{
  x += 0x9E3779B97F4A7C15ULL;
  x = (x ^ (x >> 30)) * 0xBF58476D1CE4E5B9ULL;
  x = (x ^ (x >> 27)) * 0x94D049BB133111EBULL;
  return x ^ (x >> 31);
}

} // namespace petrous::core
