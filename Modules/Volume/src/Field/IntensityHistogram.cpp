#include "petrous/Volume/IntensityHistogram.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <type_traits>

#include <tbb/blocked_range.h>
#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>

namespace petrous::volume
{

namespace
{

constexpr double kOutliers = 1e-4; // at either end
constexpr std::size_t kSqueezed = 16;
constexpr std::size_t kGrain = std::size_t{1} << 18;

using Counts = std::vector<std::uint64_t>;

// Calls visit(value, counts) for every voxel; returns the sum of all threads' counts.
template <class T, class Visit>
Counts countInParallel(const Volume<T>& volume, std::size_t size, const Visit& visit)
{
  tbb::enumerable_thread_specific<Counts> parts([size] { return Counts(size, 0); });
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, volume.size(), kGrain),
                    [&](const tbb::blocked_range<std::size_t>& part)
                    {
                      Counts& counts = parts.local();
                      for (std::size_t i = part.begin(); i != part.end(); ++i)
                        visit(volume.data()[i], counts);
                    });
  Counts sum(size, 0);
  for (const Counts& part : parts)
    std::transform(part.begin(), part.end(), sum.begin(), sum.begin(), std::plus<>());
  return sum;
}

struct BinRange
{
  std::size_t first = 0;
  std::size_t last = 0;
};

// The bins without the outliers at both ends.
BinRange bulkOf(const Counts& counts)
{
  std::uint64_t total = 0;
  for (const std::uint64_t n : counts)
    total += n;
  const auto spare = static_cast<std::uint64_t>(kOutliers * static_cast<double>(total));
  BinRange bulk{0, counts.size() - 1};
  for (std::uint64_t n = counts[bulk.first]; n <= spare && bulk.first < bulk.last;)
    n += counts[++bulk.first];
  for (std::uint64_t n = counts[bulk.last]; n <= spare && bulk.first < bulk.last;)
    n += counts[--bulk.last];
  return bulk;
}

} // namespace

IntensityHistogram::IntensityHistogram(const IntensityVolume& image, int bins)
{
  if (bins < 2)
    throw core::InvalidParameter("histogram: " + std::to_string(bins) +
                                 " bins; at least 2 are needed");
  image.visit(
      [&](const auto& volume)
      {
        using T = typename std::decay_t<decltype(volume)>::Value;
        if constexpr (std::is_integral_v<T>)
          countExactly(volume, bins, image.padding());
        else
        {
          m_range = image.range();
          countInBins(volume, bins, image.padding());
        }
      });
}

// 16 bits: one counter per value, so that one pass gives range and bins.
template <class T>
void IntensityHistogram::countExactly(const Volume<T>& volume, int bins,
                                      const std::optional<double>& padding)
{
  constexpr int least = std::numeric_limits<T>::lowest();
  constexpr std::size_t values = std::size_t{1} << 16;
  Counts exact = countInParallel(volume, values,
                                 [](T value, Counts& counts)
                                 { ++counts[static_cast<std::size_t>(value - least)]; });
  if (padding && *padding >= least && *padding < least + static_cast<double>(values) &&
      *padding == std::floor(*padding))
    exact[static_cast<std::size_t>(*padding - least)] = 0;
  BinRange all{0, values - 1};
  while (all.first < values && exact[all.first] == 0)
    ++all.first;
  if (all.first == values)
    return;
  while (exact[all.last] == 0)
    --all.last;
  m_range = {static_cast<double>(all.first) + least, static_cast<double>(all.last) + least};

  const BinRange bulk = bulkOf(exact);
  const bool squeezed = (bulk.last - bulk.first + 1) * kSqueezed < all.last - all.first + 1;
  const BinRange used = squeezed ? bulk : all;
  const std::size_t wanted = used.last - used.first + 1;
  const std::size_t width = (wanted - 1) / static_cast<std::size_t>(bins) + 1;
  m_lower = static_cast<double>(used.first) + least - 0.5;
  m_width = static_cast<double>(width);
  m_bins.assign((wanted - 1) / width + 1, 0);
  for (std::size_t value = all.first; value <= all.last; ++value)
  {
    m_bins[(std::clamp(value, used.first, used.last) - used.first) / width] += exact[value];
    m_count += exact[value];
  }
}

void IntensityHistogram::countInBins(const Volume<float>& volume, int bins,
                                     const std::optional<double>& padding)
{
  const double left = padding.value_or(std::numeric_limits<double>::quiet_NaN());
  const auto size = static_cast<std::size_t>(bins);
  ValueRange used = m_range;
  for (;;)
  {
    m_lower = used.min;
    m_width = (used.max - used.min) / bins;
    if (!(m_width > 0.0)) // one value, or indistinguishable values
      m_width = std::max(1.0, std::abs(used.min));
    Counts counts = countInParallel(volume, size,
                                    [&](float value, Counts& sum)
                                    {
                                      const auto v = static_cast<double>(value);
                                      if (!std::isfinite(v) || v == left)
                                        return;
                                      const double bin =
                                          std::clamp((v - m_lower) / m_width, 0.0, bins - 1.0);
                                      ++sum[static_cast<std::size_t>(bin)];
                                    });
    m_count = 0;
    for (const std::uint64_t n : counts)
      m_count += n;
    if (m_count == 0)
      return;
    m_bins = std::move(counts);
    const BinRange bulk = bulkOf(m_bins);
    const bool squeezed = (bulk.last - bulk.first + 1) * kSqueezed < size;
    const ValueRange narrower{m_lower + static_cast<double>(bulk.first) * m_width,
                              m_lower + static_cast<double>(bulk.last + 1) * m_width};
    // One value, or adjacent numbers: cannot be narrowed further.
    if (!squeezed || !(narrower.max - narrower.min < 0.5 * (used.max - used.min)) ||
        narrower.max - narrower.min <= 1e-6 * std::abs(narrower.max))
      return;
    used = narrower;
  }
}

double IntensityHistogram::percentile(double share) const
{
  return percentile(share, -std::numeric_limits<double>::infinity());
}

double IntensityHistogram::percentile(double share, double above) const
{
  if (m_bins.empty())
    return 0.0;
  const auto part = [&](std::size_t bin) // fraction of the bin above `above`
  {
    return std::clamp((m_lower + static_cast<double>(bin + 1) * m_width - above) / m_width, 0.0,
                      1.0);
  };
  double total = 0.0;
  for (std::size_t bin = 0; bin < m_bins.size(); ++bin)
    total += part(bin) * static_cast<double>(m_bins[bin]);
  if (!(total > 0.0))
    return m_range.max;
  const double wanted = std::clamp(share, 0.0, 1.0) * total;
  double sum = 0.0;
  for (std::size_t bin = 0; bin < m_bins.size(); ++bin)
  {
    const double own = part(bin) * static_cast<double>(m_bins[bin]);
    if (own > 0.0 && sum + own >= wanted)
    {
      const double right = m_lower + static_cast<double>(bin + 1) * m_width;
      const double value = right - (1.0 - (wanted - sum) / own) * part(bin) * m_width;
      return std::clamp(value, m_range.min, m_range.max);
    }
    sum += own;
  }
  return m_range.max;
}

} // namespace petrous::volume
