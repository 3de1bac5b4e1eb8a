#include "petrous/Volume/TissueExtent.h"

#include <array>
#include <numeric>
#include <vector>

namespace petrous::volume
{

namespace
{

constexpr int kStride = 2;
constexpr double kOutliers = 0.01; // fraction excluded at each end of an axis
constexpr double kMargin = 1.05;

using Counts = std::array<std::vector<std::uint64_t>, 3>;

template <class T>
Counts countPlanes(const Volume<T>& v, double iso)
{
  const core::Index3& n = v.geometry().dims();
  Counts counts;
  for (std::size_t a = 0; a < 3; ++a)
    counts[a].resize(static_cast<std::size_t>(n[a]));
  for (int k = 0; k < n[2]; k += kStride)
    for (int j = 0; j < n[1]; j += kStride)
    {
      const T* row = &v.at(0, j, k);
      std::uint64_t inRow = 0;
      for (int i = 0; i < n[0]; i += kStride)
        if (static_cast<double>(row[i]) > iso)
        {
          ++inRow;
          ++counts[0][static_cast<std::size_t>(i)];
        }
      counts[1][static_cast<std::size_t>(j)] += inRow;
      counts[2][static_cast<std::size_t>(k)] += inRow;
    }
  return counts;
}

// First plane up to which more than the fraction `share` is found.
double quantile(const std::vector<std::uint64_t>& counts, double share)
{
  const auto total = std::accumulate(counts.begin(), counts.end(), std::uint64_t{0});
  std::uint64_t sum = 0;
  for (std::size_t n = 0; n < counts.size(); ++n)
  {
    sum += counts[n];
    if (static_cast<double>(sum) > share * static_cast<double>(total))
      return static_cast<double>(n);
  }
  return static_cast<double>(counts.size()) - 1.0;
}

} // namespace

TissueExtent tissueExtent(const IntensityVolume& image, double iso)
{
  const core::GridGeometry& grid = image.geometry();
  const Counts counts = image.visit([iso](const auto& v) { return countPlanes(v, iso); });
  Eigen::Vector3d lower = Eigen::Vector3d::Zero();
  Eigen::Vector3d upper(grid.dims()[0] - 1.0, grid.dims()[1] - 1.0, grid.dims()[2] - 1.0);
  if (std::accumulate(counts[0].begin(), counts[0].end(), std::uint64_t{0}) > 0)
    for (int axis = 0; axis < 3; ++axis)
    {
      const auto& planes = counts[static_cast<std::size_t>(axis)];
      lower[axis] = quantile(planes, kOutliers);
      upper[axis] = quantile(planes, 1.0 - kOutliers);
    }
  const double halfDiagonal = 0.5 * (upper - lower).cwiseProduct(grid.spacing()).norm();
  return {grid.patientFromVoxel(0.5 * (lower + upper)),
          std::max(kMargin * halfDiagonal, grid.minSpacing())};
}

} // namespace petrous::volume
