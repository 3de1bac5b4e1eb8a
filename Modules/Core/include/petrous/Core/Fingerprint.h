#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <type_traits>

namespace petrous::core
{

/// 64-bit non-cryptographic hash of a sequence of values, identical on every little-endian machine;
/// collision probability about 2^-64, throughput some GB/s. Not collision-resistant against an
/// adversary.
class Fingerprint
{
public:
  /// Order-dependent; the boundaries between pieces are hashed too.
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

  /// Arithmetic types only; the padding of a struct is indeterminate.
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
  // Multiplication by an odd factor and a shift by half the word: bijective, and every bit reaches
  // all others within three words (Murmur3 finaliser, public domain, by A. Appleby).
  void mix(std::uint64_t word) noexcept
  {
    m_state = (m_state ^ word) * 0xFF51AFD7ED558CCDULL;
    m_state ^= m_state >> 32;
  }

  std::uint64_t m_state = 0x9E3779B97F4A7C15ULL;
};

} // namespace petrous::core
