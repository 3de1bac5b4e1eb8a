#pragma once

#include <cmath>
#include <cstdint>

#include "petrous/Core/SplitMix64.h"

namespace petrous::registration
{

/// Counter-based random numbers: the n-th number of a seed, the same on every machine and thread.
class CounterNoise
{
public:
  explicit CounterNoise(std::uint64_t seed)
    : m_seed(core::splitMix64(seed ^ 0x9E3779B97F4A7C15ULL))
  {
  }

  std::uint64_t bits(std::uint64_t n) const noexcept { return core::splitMix64(m_seed + n); }

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
  std::uint64_t m_seed;
};

} // namespace petrous::registration
