#pragma once

#include <cstdint>
#include <vector>

#include "petrous/Volume/IntensityVolume.h"

namespace petrous::volume
{

/// Histogram of an image's intensities, without padding, NaN and infinities.
///
/// Bins are of equal width and normally cover all values. If few outliers (at most one in 10 000 at
/// either end) would compress the rest into a sixteenth of the bins, the bins cover the rest, and
/// outliers count in the first and the last bin. Bins of integer images have integer width, so that
/// each contains the same number of possible values.
class IntensityHistogram
{
public:
  static constexpr int kBins = 1024;

  /// Reads every voxel, in parallel. bins: maximum number, >= 2, else InvalidParameter.
  explicit IntensityHistogram(const IntensityVolume& image, int bins = kBins);

  std::uint64_t count() const noexcept { return m_count; }     ///< voxels counted
  const ValueRange& range() const noexcept { return m_range; } ///< of these; both 0 if none

  const std::vector<std::uint64_t>& bins() const noexcept { return m_bins; } ///< empty if none
  double lower() const noexcept { return m_lower; } ///< edge of the first bin
  double binWidth() const noexcept { return m_width; }
  double center(std::size_t bin) const noexcept
  {
    return m_lower + (static_cast<double>(bin) + 0.5) * m_width;
  }

  /// The `share` quantile (0 to 1) of the voxels, linear within a bin; of those above `above`, if
  /// given. 0 if there is no voxel.
  double percentile(double share) const;
  double percentile(double share, double above) const;

private:
  template <class T>
  void countExactly(const Volume<T>& volume, int bins, const std::optional<double>& padding);
  void countInBins(const Volume<float>& volume, int bins, const std::optional<double>& padding);

  std::uint64_t m_count = 0;
  ValueRange m_range;
  double m_lower = 0.0;
  double m_width = 1.0;
  std::vector<std::uint64_t> m_bins;
};

} // namespace petrous::volume
