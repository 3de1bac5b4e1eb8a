#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace petrous::session
{

// 8-byte words encoded to compress well: differences from their predictions, in units in the last
// place, as byte planes.
using Words = std::vector<std::uint64_t>;

// Order-preserving bijection from doubles to integers; defined for every bit pattern.
inline std::uint64_t ordered(std::uint64_t word)
{
  return word >> 63 ? ~word : word | std::uint64_t{1} << 63;
}

inline std::uint64_t unordered(std::uint64_t place)
{
  return place >> 63 ? place & ~(std::uint64_t{1} << 63) : ~place;
}

// Difference of `word` from its prediction; small for near ones on either side.
inline std::uint64_t codeOf(std::uint64_t word, std::uint64_t predicted)
{
  const std::uint64_t difference = ordered(word) - ordered(predicted);
  return difference << 1 ^ (difference >> 63 ? ~std::uint64_t{0} : 0);
}

inline std::uint64_t wordOf(std::uint64_t code, std::uint64_t predicted)
{
  const std::uint64_t difference = code >> 1 ^ (code & 1 ? ~std::uint64_t{0} : 0);
  return unordered(ordered(predicted) + difference);
}

inline int bytesOf(std::uint64_t code)
{
  int bytes = 0;
  for (; code; code >>= 8)
    ++bytes;
  return bytes;
}

// Number of planes needed by all codes, 0 to 8.
inline int planesOf(const Words& codes)
{
  std::uint64_t all = 0;
  for (const std::uint64_t code : codes)
    all |= code;
  return bytesOf(all);
}

inline void putPlanes(const Words& codes, int planes, std::vector<std::uint8_t>& to)
{
  for (int plane = 0; plane < planes; ++plane)
    for (const std::uint64_t code : codes)
      to.push_back(static_cast<std::uint8_t>(code >> (8 * plane)));
}

// Code `n` of `count` whose planes begin at `from`.
inline std::uint64_t codeAt(const std::uint8_t* from, std::size_t planes, std::size_t count,
                            std::size_t n)
{
  std::uint64_t code = 0;
  for (std::size_t plane = 0; plane < planes; ++plane)
    code |= static_cast<std::uint64_t>(from[plane * count + n]) << (8 * plane);
  return code;
}

} // namespace petrous::session
