#include <cmath>
#include <numeric>
#include <vector>

#include <itkImage.h>
#include <itkSignedMaurerDistanceMapImageFilter.h>

#include "MaskBuilding.h"
#include "petrous/Segmentation/MaskOperations.h"

namespace petrous::segmentation
{

namespace
{

/// Distances from voxel centres to the nearest voxel centre of a set [Maurer et al. 2003,
/// doi 10.1109/TPAMI.2003.1177156], squared, mm^2. Only of voxels outside the set.
template <unsigned int N>
std::vector<float> squaredDistances(const std::vector<std::uint8_t>& set,
                                    const std::array<int, N>& size,
                                    const std::array<double, N>& spacing)
{
  using Image = itk::Image<std::uint8_t, N>;
  using Distances = itk::Image<float, N>;
  typename Image::SizeType extent;
  typename Image::SpacingType step;
  for (unsigned int a = 0; a < N; ++a)
  {
    extent[a] = static_cast<itk::SizeValueType>(size[a]);
    step[a] = spacing[a];
  }
  auto image = Image::New();
  image->SetRegions(typename Image::RegionType(extent));
  image->SetSpacing(step);
  image->GetPixelContainer()->SetImportPointer(const_cast<std::uint8_t*>(set.data()), set.size(),
                                               false);
  using Filter = itk::SignedMaurerDistanceMapImageFilter<Image, Distances>;
  auto filter = Filter::New();
  filter->SetInput(image);
  filter->SetBackgroundValue(0);
  filter->SquaredDistanceOn();
  filter->UseImageSpacingOn();
  filter->InsideIsPositiveOff();
  filter->Update();
  const float* values = filter->GetOutput()->GetBufferPointer();
  return {values, values + set.size()};
}

/// The mask's voxels in a box, first axis fastest; `invert`: those that are not the mask's.
std::vector<std::uint8_t> cropped(const Mask& mask, const core::IndexBox& box, bool invert)
{
  std::vector<std::uint8_t> out(box.count());
  const core::Index3 size = box.size();
  forEachRow(box, {}, "copying",
             [&](int j, int k)
             {
               std::uint8_t* to = out.data() + (static_cast<std::size_t>(k - box.lower[2]) *
                                                    static_cast<std::size_t>(size[1]) +
                                                static_cast<std::size_t>(j - box.lower[1])) *
                                                   static_cast<std::size_t>(size[0]);
               for (int i = 0; i < size[0]; ++i)
                 to[i] = (mask.voxels->at(box.lower[0] + i, j, k) != 0) != invert ? 1 : 0;
             });
  return out;
}

/// A mask from a test of the box's voxels, by their place in `cropped`.
template <class Test>
Mask maskWhere(const core::GridGeometry& grid, const core::IndexBox& box, const Test& isIn)
{
  auto voxels = volume::makeZeroVolume<std::uint8_t>(grid);
  const core::Index3 size = box.size();
  forEachRow(box, {}, "marking",
             [&](int j, int k)
             {
               const std::size_t row =
                   (static_cast<std::size_t>(k - box.lower[2]) * static_cast<std::size_t>(size[1]) +
                    static_cast<std::size_t>(j - box.lower[1])) *
                   static_cast<std::size_t>(size[0]);
               for (int i = 0; i < size[0]; ++i)
                 if (isIn(row + static_cast<std::size_t>(i)))
                   voxels->at(box.lower[0] + i, j, k) = 1;
             });
  return makeMask(std::move(voxels), box);
}

core::Index3 voxelsFor(double millimetres, const core::GridGeometry& grid)
{
  core::Index3 voxels;
  for (int a = 0; a < 3; ++a)
    voxels[static_cast<std::size_t>(a)] =
        static_cast<int>(std::min(std::ceil(millimetres / grid.spacing()[a]) + 1.0,
                                  static_cast<double>(grid.dims()[static_cast<std::size_t>(a)])));
  return voxels;
}

/// One axis of a separable Gaussian over rows of `count` voxels `step` apart, in place. Beyond the
/// ends the last value goes on.
void convolve(float* row, int count, std::size_t step, const std::vector<float>& kernel,
              std::vector<float>& scratch)
{
  const int half = static_cast<int>(kernel.size()) - 1;
  scratch.resize(static_cast<std::size_t>(count + 2 * half));
  for (int n = -half; n < count + half; ++n)
    scratch[static_cast<std::size_t>(n + half)] =
        row[static_cast<std::size_t>(std::clamp(n, 0, count - 1)) * step];
  for (int n = 0; n < count; ++n)
  {
    const float* at = scratch.data() + n + half;
    float sum = kernel[0] * at[0];
    for (int m = 1; m <= half; ++m)
      sum += kernel[static_cast<std::size_t>(m)] * (at[-m] + at[m]);
    row[static_cast<std::size_t>(n) * step] = sum;
  }
}

constexpr double kReach = 3.0; // standard deviations, of a Gaussian

core::IndexBox boxOf(const Mask& mask, double sigma)
{
  return padded(mask.extent, voxelsFor(kReach * sigma, mask.geometry()), mask.geometry());
}

/// The mask as 0 and 1, blurred by a Gaussian of `sigma` mm, in `boxOf`.
std::vector<float> blurredMask(const Mask& mask, double sigma, const core::Progress& progress)
{
  const core::GridGeometry& grid = mask.geometry();
  const core::IndexBox box = boxOf(mask, sigma);
  const core::Index3 size = box.size();
  std::vector<float> blurred;
  {
    const std::vector<std::uint8_t> binary = cropped(mask, box, false);
    blurred.assign(binary.begin(), binary.end());
  }
  const std::array<std::size_t, 3> steps{1, static_cast<std::size_t>(size[0]),
                                         static_cast<std::size_t>(size[0]) *
                                             static_cast<std::size_t>(size[1])};
  for (std::size_t a = 0; a < 3; ++a)
  {
    progress.report(0.25 * static_cast<double>(a), "smoothing");
    const double inVoxels = sigma / grid.spacing()[static_cast<int>(a)];
    std::vector<float> kernel;
    for (int n = 0; n == 0 || n <= kReach * inVoxels; ++n)
      kernel.push_back(static_cast<float>(std::exp(-0.5 * n * n / (inVoxels * inVoxels))));
    const float sum = kernel[0] + 2.0F * std::accumulate(kernel.begin() + 1, kernel.end(), 0.0F);
    for (float& weight : kernel)
      weight /= sum;
    const std::size_t b = a == 0 ? 1 : 0;
    const std::size_t c = a == 2 ? 1 : 2;
    tbb::parallel_for(0, size[c],
                      [&](int m)
                      {
                        progress.check("smoothing");
                        std::vector<float> scratch;
                        for (int n = 0; n < size[b]; ++n)
                          convolve(blurred.data() + static_cast<std::size_t>(m) * steps[c] +
                                       static_cast<std::size_t>(n) * steps[b],
                                   size[a], steps[a], kernel, scratch);
                      });
  }
  return blurred;
}

} // namespace

Mask margin(const Mask& mask, double distance, const core::Progress& progress)
{
  if (!std::isfinite(distance))
    throw core::InvalidParameter("margin: give a distance in mm");
  if (mask.count == 0 || distance == 0.0)
    return mask;
  const core::GridGeometry& grid = mask.geometry();
  const bool grows = distance > 0.0;
  const core::IndexBox box =
      padded(mask.extent, grows ? voxelsFor(distance, grid) : core::Index3{1, 1, 1}, grid);
  const std::vector<std::uint8_t> set = cropped(mask, box, !grows);
  if (!grows && std::find(set.begin(), set.end(), 1) == set.end())
    return mask; // the whole grid, whose border counts as inside
  progress.report(0.1, "margin");
  const core::Index3 size = box.size();
  const auto squared =
      squaredDistances<3>(set, size, {grid.spacing()[0], grid.spacing()[1], grid.spacing()[2]});
  progress.report(0.9, "margin");
  // The distances are floats; a voxel exactly at the distance is within it.
  const auto limit = static_cast<float>(distance * distance * (1.0 + 1e-5));
  return maskWhere(grid, box,
                   [&](std::size_t n)
                   {
                     const bool inSet = set[n] != 0;
                     return grows ? inSet || squared[n] <= limit : !inSet && squared[n] > limit;
                   });
}

Mask smoothed(const Mask& mask, double sigma, const core::Progress& progress)
{
  if (!(sigma >= 0.0) || !std::isfinite(sigma))
    throw core::InvalidParameter("smoothing: give a standard deviation of 0 mm or more");
  if (mask.count == 0 || sigma == 0.0)
    return mask;
  const std::vector<float> blurred = blurredMask(mask, sigma, progress);
  std::vector<float> sorted = blurred;
  const auto nth = sorted.begin() + static_cast<std::ptrdiff_t>(mask.count - 1);
  std::nth_element(sorted.begin(), nth, sorted.end(), std::greater<>());
  const float level = *nth;
  progress.report(0.95, "smoothing");
  return maskWhere(mask.geometry(), boxOf(mask, sigma),
                   [&](std::size_t n) { return blurred[n] >= level && blurred[n] > 0.0F; });
}

Mask smoothedOutline(const Mask& mask, double sigma, const core::Progress& progress)
{
  const Mask whole = filled(mask, progress.part(0.0, 0.2));
  const Mask outline = smoothed(whole, sigma, progress.part(0.2, 0.6));
  if (whole.count == mask.count || sigma == 0.0)
    return sigma == 0.0 ? mask : outline;
  const Mask cavities = combined(whole, mask, Combination::Difference);
  const std::vector<float> blurred = blurredMask(cavities, sigma, progress.part(0.6, 0.8));
  constexpr float kHalf = 0.5F;
  const Mask open = maskWhere(mask.geometry(), boxOf(cavities, sigma),
                              [&](std::size_t n) { return blurred[n] >= kHalf; });
  const Mask large = islandsWith(cavities, open, progress.part(0.8, 0.85));
  return combined(outline, smoothed(large, sigma, progress.part(0.85, 1.0)),
                  Combination::Difference);
}

Mask filledBetweenSlices(const Mask& mask, int axis, const core::Progress& progress)
{
  if (axis < 0 || axis > 2)
    throw core::InvalidParameter("filling between slices: the axis is 0, 1 or 2");
  const core::GridGeometry& grid = mask.geometry();
  const auto a = static_cast<std::size_t>(axis);
  const std::size_t b = a == 0 ? 1 : 0;
  const std::size_t c = a == 2 ? 1 : 2;
  core::IndexBox box = padded(mask.extent, {1, 1, 1}, grid);
  box.lower[a] = mask.extent.lower[a];
  box.upper[a] = mask.extent.upper[a];
  const std::array<int, 2> size{box.size()[b], box.size()[c]};
  const auto pixels = static_cast<std::size_t>(size[0]) * static_cast<std::size_t>(size[1]);
  const std::array<double, 2> spacing{grid.spacing()[static_cast<int>(b)],
                                      grid.spacing()[static_cast<int>(c)]};
  const auto index = [&](int slice, std::size_t pixel)
  {
    core::Index3 at;
    at[a] = slice;
    at[b] = box.lower[b] + static_cast<int>(pixel % static_cast<std::size_t>(size[0]));
    at[c] = box.lower[c] + static_cast<int>(pixel / static_cast<std::size_t>(size[0]));
    return at;
  };
  const auto section = [&](int slice)
  {
    std::vector<std::uint8_t> values(pixels);
    for (std::size_t n = 0; n < pixels; ++n)
    {
      const core::Index3 at = index(slice, n);
      values[n] = mask.voxels->at(at[0], at[1], at[2]);
    }
    return values;
  };
  std::vector<int> painted;
  for (int slice = box.lower[a]; slice < box.upper[a]; ++slice)
  {
    const auto values = section(slice);
    if (std::find(values.begin(), values.end(), 1) != values.end())
      painted.push_back(slice);
  }
  bool isGap = false;
  for (std::size_t n = 1; n < painted.size(); ++n)
    isGap = isGap || painted[n] > painted[n - 1] + 1;
  if (!isGap)
    throw core::InvalidParameter(
        "filling between slices: there are no empty slices between drawn ones; draw the "
        "structure in two or more slices of one direction, leaving some out");

  // Half a pixel's step inwards and outwards, so that the outline lies between the pixels.
  const double half = 0.5 * std::min(spacing[0], spacing[1]);
  const auto signedDistances = [&](int slice)
  {
    std::vector<std::uint8_t> set = section(slice);
    const std::vector<float> outside = squaredDistances<2>(set, size, spacing);
    std::vector<std::uint8_t> inverse(set.size());
    std::transform(set.begin(), set.end(), inverse.begin(),
                   [](std::uint8_t v) { return static_cast<std::uint8_t>(v == 0); });
    const bool whole = std::find(inverse.begin(), inverse.end(), 1) == inverse.end();
    const std::vector<float> inside =
        whole ? std::vector<float>(pixels, 1e6F) : squaredDistances<2>(inverse, size, spacing);
    std::vector<double> distances(pixels);
    for (std::size_t n = 0; n < pixels; ++n)
      distances[n] = set[n] != 0 ? half - std::sqrt(static_cast<double>(inside[n]))
                                 : std::sqrt(static_cast<double>(outside[n])) - half;
    return distances;
  };

  auto voxels = volume::makeZeroVolume<std::uint8_t>(grid);
  forEachRow(mask.extent, progress, "filling between slices",
             [&](int j, int k)
             {
               std::copy_n(&mask.voxels->at(mask.extent.lower[0], j, k), mask.extent.size()[0],
                           &voxels->at(mask.extent.lower[0], j, k));
             });
  for (std::size_t n = 1; n < painted.size(); ++n)
  {
    progress.report(static_cast<double>(n) / static_cast<double>(painted.size()),
                    "filling between slices");
    const int from = painted[n - 1];
    const int to = painted[n];
    if (to == from + 1)
      continue;
    const auto first = signedDistances(from);
    const auto last = signedDistances(to);
    for (int slice = from + 1; slice < to; ++slice)
    {
      const double t = static_cast<double>(slice - from) / (to - from);
      for (std::size_t pixel = 0; pixel < pixels; ++pixel)
        if ((1.0 - t) * first[pixel] + t * last[pixel] <= 0.0)
        {
          const core::Index3 at = index(slice, pixel);
          voxels->at(at[0], at[1], at[2]) = 1;
        }
    }
  }
  return makeMask(std::move(voxels), box);
}

} // namespace petrous::segmentation
