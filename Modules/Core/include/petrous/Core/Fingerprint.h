#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <type_traits>

namespace petrous::core
{

/// A number by which data are known again: the same for the same values in the same order on every
/// little-endian machine, another one for others but for a chance of about 2^-64. Some GB a second.
/// It is no proof against those who want two data to look the same.
class Fingerprint
{
public:
  /// In order; where one piece ends and the next begins makes a difference.
  void add(const void* data, std::size_t bytes) noexcept
  {
    mix(bytes);
    const auto* from = static_cast<const unsigned char*>(data);
    for (; bytes >= 8; bytes -= 8, from += 8)
    {
      std::uint64_t word;
      std::memcpy(&word, from, 8);
      mix(word);
    }
    std::uint64_t rest = 0;
    if (bytes > 0)
      std::memcpy(&rest, from, bytes);
    mix(rest);
  }

  /// A number; not a struct, whose gaps may hold anything.
  template <typename Number>
  void add(Number value) noexcept
  {
    static_assert(std::is_arithmetic_v<Number>);
    add(&value, sizeof value);
  }

  std::uint64_t value() const noexcept
  {
    Fingerprint end = *this;
    end.mix(0);
    return end.m_state;
  }

private:
  // An odd factor and a shift of half the word: one to one, and every bit reaches all others
  // within three words (finaliser of Murmur3, public domain, by A. Appleby).
  void mix(std::uint64_t word) noexcept
  {
    m_state = (m_state ^ word) * 0xFF51AFD7ED558CCDULL;
    m_state ^= m_state >> 32;
  }

  std::uint64_t m_state = 0x9E3779B97F4A7C15ULL;
};

} // namespace petrous::core
