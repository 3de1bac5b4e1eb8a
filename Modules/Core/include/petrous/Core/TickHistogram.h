#pragma once

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace petrous::core
{

/// Distribution of durations in s, in bins of 1 us up to 20 ms: of constant size, however long a
/// real-time thread runs. One thread adds, any thread may read meanwhile. Only the constructor
/// allocates.
class TickHistogram
{
public:
  static constexpr std::size_t kBins = 20000;
  static constexpr double kWidth = 1e-6; ///< s

  TickHistogram()
    : m_bins(kBins + 1)
  {
  }
  TickHistogram(const TickHistogram&) = delete;
  TickHistogram& operator=(const TickHistogram&) = delete;

  /// Negative durations count as 0; NaN is ignored.
  void add(double seconds) noexcept
  {
    if (std::isnan(seconds))
      return;
    const double bin = std::clamp(std::floor(seconds / kWidth), 0.0, double{kBins});
    std::atomic<std::uint32_t>& place = m_bins[static_cast<std::size_t>(bin)];
    place.store(place.load(std::memory_order_relaxed) + 1, std::memory_order_relaxed);
    if (seconds > max())
      m_max.store(seconds, std::memory_order_relaxed);
  }

  std::uint64_t count() const noexcept
  {
    std::uint64_t count = 0;
    for (const auto& bin : m_bins)
      count += bin.load(std::memory_order_relaxed);
    return count;
  }

  double max() const noexcept { return m_max.load(std::memory_order_relaxed); } ///< exact

  /// What the fraction `share` (0 to 1) of the durations does not exceed: the upper edge of its
  /// bin, at most max(); 0 without durations. Of those above 20 ms only max() is known.
  double quantile(double share) const noexcept
  {
    const double wanted = std::max(1.0, std::ceil(share * static_cast<double>(count())));
    double passed = 0.0;
    for (std::size_t n = 0; n < kBins; ++n)
    {
      passed += static_cast<double>(m_bins[n].load(std::memory_order_relaxed));
      if (passed >= wanted)
        return std::min(kWidth * static_cast<double>(n + 1), max());
    }
    return max();
  }

private:
  std::vector<std::atomic<std::uint32_t>> m_bins; // the last: all longer ones
  std::atomic<double> m_max{0.0};
};

} // namespace petrous::core
