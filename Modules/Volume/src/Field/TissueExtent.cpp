#include "petrous/Volume/TissueExtent.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <numeric>
#include <vector>

#include <tbb/blocked_range.h>
#include <tbb/parallel_reduce.h>

namespace petrous::volume
{

namespace
{

constexpr int kStride = 2;
constexpr double kOutliers = 0.01; // fraction excluded at each end of an axis
constexpr double kMargin = 1.05;

using Counts = std::array<std::vector<std::uint64_t>, 3>;

// In several threads: a view waits for it when a case is opened.
template <class T>
Counts countPlanes(const Volume<T>& v, double iso)
{
  constexpr int kPart = 8; // of the slices that are read
  const core::Index3& n = v.geometry().dims();
  Counts none;
  for (std::size_t a = 0; a < 3; ++a)
    none[a].resize(static_cast<std::size_t>(n[a]));
  return tbb::parallel_reduce(
      tbb::blocked_range<int>(0, (n[2] + kStride - 1) / kStride, kPart), none,
      [&](const tbb::blocked_range<int>& slices, Counts counts)
      {
        for (int k = kStride * slices.begin(); k < kStride * slices.end(); k += kStride)
          for (int j = 0; j < n[1]; j += kStride)
          {
            const T* row = &v.at(0, j, k);
            std::uint64_t inRow = 0;
            for (int i = 0; i < n[0]; i += kStride)
            {
              const std::uint64_t is = static_cast<double>(row[i]) > iso ? 1 : 0; // no branch
              inRow += is;
              counts[0][static_cast<std::size_t>(i)] += is;
            }
            counts[1][static_cast<std::size_t>(j)] += inRow;
            counts[2][static_cast<std::size_t>(k)] += inRow;
          }
        return counts;
      },
      [](Counts sum, const Counts& other)
      {
        for (std::size_t a = 0; a < 3; ++a)
          std::transform(sum[a].begin(), sum[a].end(), other[a].begin(), sum[a].begin(),
                         std::plus<>());
        return sum;
      });
}

// How much of each plane across the axis lies below `air`.
template <class T>
std::vector<double> airOfPlanes(const Volume<T>& v, double air, int axis)
{
  const core::Index3& n = v.geometry().dims();
  const auto across = static_cast<std::size_t>(axis);
  std::vector<double> below(static_cast<std::size_t>(n[across]), 0.0);
  std::vector<double> all(below.size(), 0.0);
  for (int k = 0; k < n[2]; k += kStride)
    for (int j = 0; j < n[1]; j += kStride)
      for (int i = 0; i < n[0]; i += kStride)
      {
        const auto plane = static_cast<std::size_t>(std::array<int, 3>{i, j, k}[across]);
        below[plane] += static_cast<double>(v.at(i, j, k)) < air ? 1.0 : 0.0;
        all[plane] += 1.0;
      }
  for (std::size_t p = 0; p < below.size(); ++p)
    below[p] = all[p] > 0.0 ? below[p] / all[p] : -1.0; // not read
  return below;
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

namespace
{

struct VoxelRange
{
  Eigen::Vector3d lower, upper; ///< indices
};

VoxelRange tissueRange(const IntensityVolume& image, double iso, double outliers)
{
  const core::Index3& dims = image.geometry().dims();
  const Counts counts = image.visit([iso](const auto& v) { return countPlanes(v, iso); });
  VoxelRange range{Eigen::Vector3d::Zero(), {dims[0] - 1.0, dims[1] - 1.0, dims[2] - 1.0}};
  if (std::accumulate(counts[0].begin(), counts[0].end(), std::uint64_t{0}) > 0)
    for (int axis = 0; axis < 3; ++axis)
    {
      const auto& planes = counts[static_cast<std::size_t>(axis)];
      range.lower[axis] = quantile(planes, outliers);
      range.upper[axis] = quantile(planes, 1.0 - outliers);
    }
  return range;
}

} // namespace

TissueExtent tissueExtent(const IntensityVolume& image, double iso)
{
  const core::GridGeometry& grid = image.geometry();
  const auto [lower, upper] = tissueRange(image, iso, kOutliers);
  const double halfDiagonal = 0.5 * (upper - lower).cwiseProduct(grid.spacing()).norm();
  return {grid.patientFromVoxel(0.5 * (lower + upper)),
          std::max(kMargin * halfDiagonal, grid.minSpacing())};
}

core::PatientBox tissueBox(const IntensityVolume& image, double iso, double outliers)
{
  const auto [lower, upper] = tissueRange(image, iso, outliers);
  core::PatientBox box;
  for (const double i : {lower[0], upper[0]})
    for (const double j : {lower[1], upper[1]})
      for (const double k : {lower[2], upper[2]})
        box.extend(image.geometry().patientFromVoxel(Eigen::Vector3d(i, j, k)));
  return box;
}

int openSide(const IntensityVolume& image, double air)
{
  constexpr double kOuter = 1.0 / 6.0;
  constexpr double kTelling = 0.1;
  const core::GridGeometry& grid = image.geometry();
  Eigen::Index axis = 0;
  grid.direction().row(0).cwiseAbs().maxCoeff(&axis);
  const auto planes =
      image.visit([&](const auto& v) { return airOfPlanes(v, air, static_cast<int>(axis)); });
  const auto outer = static_cast<std::ptrdiff_t>(
      std::max<double>(kStride, kOuter * static_cast<double>(planes.size())));
  const auto mean = [](auto from, auto to)
  {
    double sum = 0.0;
    std::size_t count = 0;
    for (; from != to; ++from)
      if (*from >= 0.0)
      {
        sum += *from;
        ++count;
      }
    return count > 0 ? sum / static_cast<double>(count) : 0.0;
  };
  if (static_cast<std::ptrdiff_t>(planes.size()) < 2 * outer)
    return 0;
  const double more =
      mean(planes.end() - outer, planes.end()) - mean(planes.begin(), planes.begin() + outer);
  if (std::abs(more) < kTelling)
    return 0;
  return (more > 0.0) == (grid.direction()(0, axis) > 0.0) ? 1 : -1;
}

} // namespace petrous::volume
