#pragma once

#include <cmath>
#include <cstdint>

namespace petrous::registration
{

/// Counter-based random numbers: the n-th number of a seed, the same on every machine and thread.
class CounterNoise
{
public:
  explicit CounterNoise(std::uint64_t seed)
    : m_seed(mixed(seed ^ 0x9E3779B97F4A7C15ULL))
  {
  }

  std::uint64_t bits(std::uint64_t n) const noexcept { return mixed(m_seed + n); }

  /// In [0, 1).
  double uniform(std::uint64_t n) const noexcept
  {
    return static_cast<double>(bits(n) >> 11) * 0x1.0p-53;
  }
  double uniform(std::uint64_t n, double low, double high) const noexcept
  {
    return low + (high - low) * uniform(n);
  }

  /// Standard normal (Box-Muller); uses numbers 2n and 2n + 1.
  double normal(std::uint64_t n) const noexcept
  {
    const double radius = std::sqrt(-2.0 * std::log(1.0 - uniform(2 * n)));
    return radius * std::cos(2.0 * 3.14159265358979323846 * uniform(2 * n + 1));
  }

private:
  // Finalizer of SplitMix64 (Steele, Lea and Flood 2014).
  static std::uint64_t mixed(std::uint64_t x) noexcept
  {
    x += 0x9E3779B97F4A7C15ULL;
    x = (x ^ (x >> 30)) * 0xBF58476D1CE4E5B9ULL;
    x = (x ^ (x >> 27)) * 0x94D049BB133111EBULL;
    return x ^ (x >> 31);
  }

  std::uint64_t m_seed;
};

} // namespace petrous::registration
