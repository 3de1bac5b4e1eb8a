#pragma once

#include <cstdint>
#include <vector>

#include "petrous/Volume/IntensityVolume.h"

namespace petrous::volume
{

/// How often which intensity occurs in an image; padding, NaN and infinities are left out.
///
/// Bins are of equal width and cover the values, all of them as a rule. Where a few outliers (one
/// in 10 000 at either end at most) would squeeze the rest into a sixteenth of the bins, the bins
/// cover the rest, and the outliers count in the first and the last bin. Bins of integer images are
/// whole numbers wide, so that none of them holds more of the possible values than another.
class IntensityHistogram
{
public:
  static constexpr int kBins = 1024;

  /// Reads every voxel, in parallel. bins: the most there may be, >= 2, else InvalidParameter.
  explicit IntensityHistogram(const IntensityVolume& image, int bins = kBins);

  std::uint64_t count() const noexcept { return m_count; }     ///< voxels that count
  const ValueRange& range() const noexcept { return m_range; } ///< of them; both 0 where none

  const std::vector<std::uint64_t>& bins() const noexcept { return m_bins; } ///< empty where none
  double lower() const noexcept { return m_lower; } ///< edge of the first bin
  double binWidth() const noexcept { return m_width; }
  double center(std::size_t bin) const noexcept
  {
    return m_lower + (static_cast<double>(bin) + 0.5) * m_width;
  }

  /// The value that `share` (0 to 1) of the voxels do not exceed, linear within a bin; of those
  /// voxels only that lie above `above`, where it is given. 0 where there is no voxel.
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
