#include "LevelImage.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include <itkDiscreteGaussianImageFilter.h>
#include <itkHistogram.h>
#include <itkImage.h>
#include <itkOtsuThresholdCalculator.h>
#include <tbb/parallel_for.h>

namespace petrous::registration
{

namespace
{

constexpr double kTail = 0.001;                // fraction clipped at each end of the range
constexpr std::size_t kRangeSamples = 100'000; // of which the range is taken

core::Index3 blockOf(const core::GridGeometry& grid, double scale)
{
  core::Index3 block{1, 1, 1};
  for (std::size_t a = 0; a < 3; ++a)
  {
    const double ratio = scale / grid.spacing()[static_cast<Eigen::Index>(a)];
    block[a] = std::clamp(static_cast<int>(std::floor(ratio + 0.25)), 1, grid.dims()[a]);
  }
  return block;
}

core::GridGeometry reducedGrid(const core::GridGeometry& grid, const core::Index3& block)
{
  core::Index3 dims{};
  Eigen::Vector3d spacing;
  Eigen::Vector3d first;
  for (std::size_t a = 0; a < 3; ++a)
  {
    const auto axis = static_cast<Eigen::Index>(a);
    dims[a] = grid.dims()[a] / block[a];
    spacing[axis] = grid.spacing()[axis] * block[a];
    first[axis] = 0.5 * (block[a] - 1);
  }
  return {dims, spacing, grid.patientFromVoxel(first), grid.direction()};
}

// Block means of the finite values; NaN if fewer than half of a block are finite.
template <class Value>
LevelImage blockMeans(const core::GridGeometry& grid, const core::Index3& block, const Value& value)
{
  LevelImage level{volume::Volume<float>(reducedGrid(grid, block))};
  const core::Index3& dims = level.grid().dims();
  const int whole = block[0] * block[1] * block[2];
  tbb::parallel_for(0, dims[2],
                    [&](int k)
                    {
                      for (int j = 0; j < dims[1]; ++j)
                        for (int i = 0; i < dims[0]; ++i)
                        {
                          double sum = 0.0;
                          int count = 0;
                          for (int c = k * block[2]; c < (k + 1) * block[2]; ++c)
                            for (int b = j * block[1]; b < (j + 1) * block[1]; ++b)
                            {
                              std::size_t at = grid.linearIndex(i * block[0], b, c);
                              for (int a = 0; a < block[0]; ++a, ++at)
                              {
                                const float v = value(at);
                                if (std::isfinite(v))
                                {
                                  sum += v;
                                  ++count;
                                }
                              }
                            }
                          level.voxels.at(i, j, k) = 2 * count >= whole && count > 0
                                                         ? static_cast<float>(sum / count)
                                                         : std::numeric_limits<float>::quiet_NaN();
                        }
                    });
  return level;
}

using FloatImage = itk::Image<float, 3>;

void gaussian(volume::Volume<float>& voxels, const std::array<double, 3>& variance)
{
  const core::GridGeometry& grid = voxels.geometry();
  auto image = FloatImage::New();
  FloatImage::SizeType size;
  FloatImage::SpacingType spacing;
  for (unsigned a = 0; a < 3; ++a)
  {
    size[a] = static_cast<itk::SizeValueType>(grid.dims()[a]);
    spacing[a] = grid.spacing()[a];
  }
  image->SetRegions(size);
  image->SetSpacing(spacing);
  image->GetPixelContainer()->SetImportPointer(voxels.data(), voxels.size(), false);
  auto filter = itk::DiscreteGaussianImageFilter<FloatImage, FloatImage>::New();
  filter->SetInput(image);
  filter->SetVariance(variance.data());
  filter->SetMaximumError(0.02);
  filter->Update();
  const float* out = filter->GetOutput()->GetBufferPointer();
  std::copy_n(out, voxels.size(), voxels.data());
}

// Normalized convolution: NaN have weight 0.
void smooth(LevelImage& level, const std::array<double, 3>& variance)
{
  if (std::all_of(variance.begin(), variance.end(), [](double v) { return v <= 0.0; }))
    return;
  float* values = level.voxels.data();
  std::vector<std::size_t> holes;
  for (std::size_t n = 0; n < level.voxels.size(); ++n)
    if (std::isnan(values[n]))
    {
      values[n] = 0.0f;
      holes.push_back(n);
    }
  gaussian(level.voxels, variance);
  if (holes.empty())
    return;
  volume::Volume<float> there(level.grid(), 1.0f);
  for (const std::size_t n : holes)
    there.data()[n] = 0.0f;
  gaussian(there, variance);
  for (std::size_t n = 0; n < level.voxels.size(); ++n)
    values[n] /= there.data()[n];
  for (const std::size_t n : holes)
    values[n] = std::numeric_limits<float>::quiet_NaN();
}

void measure(LevelImage& level)
{
  const float* values = level.voxels.data();
  const std::size_t size = level.voxels.size();
  const std::size_t stride = std::max<std::size_t>(1, size / kRangeSamples);
  std::vector<float> some;
  some.reserve(size / stride + 1);
  for (std::size_t n = 0; n < size; n += stride)
    if (!std::isnan(values[n]))
      some.push_back(values[n]);
  level.valid = static_cast<std::size_t>(
      std::count_if(values, values + size, [](float v) { return !std::isnan(v); }));
  if (some.empty())
    return;
  const auto nth = [&some](double fraction)
  {
    const auto at = static_cast<std::ptrdiff_t>(fraction * static_cast<double>(some.size() - 1));
    std::nth_element(some.begin(), some.begin() + at, some.end());
    return some[static_cast<std::size_t>(at)];
  };
  level.low = nth(kTail);
  level.high = nth(1.0 - kTail);
}

// Variance still missing after block averaging, mm^2 along each axis. `already` is the standard
// deviation of the finer image's smoothing.
std::array<double, 3> missingVariance(const core::GridGeometry& fine, const core::Index3& block,
                                      double scale, double already)
{
  std::array<double, 3> variance{};
  for (std::size_t a = 0; a < 3; ++a)
  {
    const double h = fine.spacing()[static_cast<Eigen::Index>(a)];
    const double wanted = 0.25 * scale * scale;
    const double had = h * h * (block[a] * block[a] - 1) / 12.0 + already * already;
    // Axes at the file's own resolution are not blurred, so the finest level stays as sharp as it
    // is: blur shifts the optimum of a curved surface (Documentation/adr).
    variance[a] = block[a] == 1 ? 0.0 : std::max(0.0, wanted - had);
  }
  return variance;
}

} // namespace

LevelImage makeLevel(const volume::IntensityVolume& image, double scale,
                     const core::Progress& progress)
{
  progress.check("preparing an image");
  const core::Index3 block = blockOf(image.geometry(), scale);
  LevelImage level = image.visit(
      [&](const auto& voxels)
      {
        const auto padding = image.padding();
        const auto* data = voxels.data();
        if (!padding)
          return blockMeans(image.geometry(), block,
                            [data](std::size_t n) { return static_cast<float>(data[n]); });
        const auto nothing = static_cast<float>(*padding);
        return blockMeans(image.geometry(), block,
                          [data, nothing](std::size_t n)
                          {
                            const auto v = static_cast<float>(data[n]);
                            return v == nothing ? std::numeric_limits<float>::quiet_NaN() : v;
                          });
      });
  progress.check("preparing an image");
  smooth(level, missingVariance(image.geometry(), block, scale, 0.0));
  measure(level);
  return level;
}

LevelImage makeLevel(const LevelImage& finer, double scale)
{
  const core::Index3 block = blockOf(finer.grid(), scale);
  const float* values = finer.voxels.data();
  LevelImage level = blockMeans(finer.grid(), block, [values](std::size_t n) { return values[n]; });
  smooth(level, missingVariance(finer.grid(), block, scale, 0.5 * finer.grid().minSpacing()));
  measure(level);
  return level;
}

LevelImage croppedLevel(const LevelImage& level, const core::IndexBox& box)
{
  const core::GridGeometry& grid = level.grid();
  const Eigen::Vector3d first(box.lower[0], box.lower[1], box.lower[2]);
  LevelImage part{volume::Volume<float>(core::GridGeometry(
      box.size(), grid.spacing(), grid.patientFromVoxel(first), grid.direction()))};
  const std::size_t row = static_cast<std::size_t>(box.size()[0]);
  float* out = part.voxels.data();
  for (int k = box.lower[2]; k < box.upper[2]; ++k)
    for (int j = box.lower[1]; j < box.upper[1]; ++j, out += row)
      std::copy_n(level.voxels.data() + grid.linearIndex(box.lower[0], j, k), row, out);
  measure(part);
  return part;
}

core::IndexBox contentBox(const LevelImage& level, double margin)
{
  const core::Index3& dims = level.grid().dims();
  if (!(level.high > level.low))
    return level.grid().fullBox();
  using Histogram = itk::Statistics::Histogram<double>;
  auto histogram = Histogram::New();
  histogram->SetMeasurementVectorSize(1);
  Histogram::SizeType size(1);
  size[0] = 128;
  Histogram::MeasurementVectorType low(1);
  Histogram::MeasurementVectorType high(1);
  low[0] = level.low;
  high[0] = level.high;
  histogram->Initialize(size, low, high);
  for (std::size_t n = 0; n < level.voxels.size(); ++n)
    if (const float v = level.voxels.data()[n]; !std::isnan(v))
      histogram->IncreaseFrequency(
          std::min<Histogram::InstanceIdentifier>(
              127, static_cast<Histogram::InstanceIdentifier>(
                       std::max(0.0f, 128.0f * (v - level.low) / (level.high - level.low)))),
          1);
  auto otsu = itk::OtsuThresholdCalculator<Histogram, double>::New();
  otsu->SetInput(histogram);
  otsu->Compute();
  const double threshold = otsu->GetThreshold();

  std::array<std::vector<std::size_t>, 3> profile;
  std::size_t total = 0;
  for (std::size_t a = 0; a < 3; ++a)
    profile[a].assign(static_cast<std::size_t>(dims[a]), 0);
  for (int k = 0; k < dims[2]; ++k)
    for (int j = 0; j < dims[1]; ++j)
      for (int i = 0; i < dims[0]; ++i)
        if (level.voxels.at(i, j, k) > threshold)
        {
          ++profile[0][static_cast<std::size_t>(i)];
          ++profile[1][static_cast<std::size_t>(j)];
          ++profile[2][static_cast<std::size_t>(k)];
          ++total;
        }
  core::IndexBox box = level.grid().fullBox();
  if (total == 0)
    return box;
  for (std::size_t a = 0; a < 3; ++a)
  {
    const std::size_t leave = total / 100;
    const int pad =
        static_cast<int>(std::ceil(margin / level.grid().spacing()[static_cast<Eigen::Index>(a)]));
    std::size_t below = 0;
    int first = 0;
    while (first < dims[a] - 1 && (below += profile[a][static_cast<std::size_t>(first)]) <= leave)
      ++first;
    std::size_t above = 0;
    int last = dims[a] - 1;
    while (last > first && (above += profile[a][static_cast<std::size_t>(last)]) <= leave)
      --last;
    box.lower[a] = std::max(0, first - pad);
    box.upper[a] = std::min(dims[a], last + 1 + pad);
  }
  return box;
}

} // namespace petrous::registration
