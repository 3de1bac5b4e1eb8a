#include "petrous/Segmentation/MaskOperations.h"

#include <atomic>
#include <cmath>
#include <limits>

#include "MaskBuilding.h"
#include "petrous/Core/NumberText.h"

namespace petrous::segmentation
{

namespace
{

void requireRange(const volume::ValueRange& range)
{
  if (!(range.min <= range.max)) // NaN too
    throw core::InvalidParameter("threshold: the lower limit (" + core::fixedText(range.min, 1) +
                                 ") is above the upper one (" + core::fixedText(range.max, 1) +
                                 "); give them in ascending order");
}

/// The range and the padding in the voxels' own type, so that rows are compared without conversion.
template <class T>
struct RowTest
{
  RowTest(const volume::IntensityVolume& image, const volume::ValueRange& range)
    : lower(static_cast<T>(0))
    , upper(static_cast<T>(0))
    , hasPadding(image.padding().has_value())
    , padding(hasPadding ? static_cast<T>(*image.padding()) : T{})
  {
    constexpr double kLeast = static_cast<double>(std::numeric_limits<T>::lowest());
    constexpr double kMost = static_cast<double>(std::numeric_limits<T>::max());
    const double from = std::is_integral_v<T> ? std::ceil(range.min) : range.min;
    const double to = std::is_integral_v<T> ? std::floor(range.max) : range.max;
    possible = from <= to && from <= kMost && to >= kLeast;
    lower = static_cast<T>(std::clamp(from, kLeast, kMost));
    upper = static_cast<T>(std::clamp(to, kLeast, kMost));
    // A float nearest to the limit may lie beyond it.
    if constexpr (std::is_floating_point_v<T>)
    {
      if (static_cast<double>(lower) < from)
        lower = std::nextafter(lower, std::numeric_limits<T>::infinity());
      if (static_cast<double>(upper) > to)
        upper = std::nextafter(upper, -std::numeric_limits<T>::infinity());
    }
  }
  bool operator()(T value) const noexcept
  {
    return value >= lower && value <= upper && !(hasPadding && value == padding);
  }
  T lower, upper;
  bool hasPadding;
  T padding;
  bool possible = false;
};

} // namespace

Mask threshold(const volume::IntensityVolume& image, const volume::ValueRange& range,
               const core::Progress& progress)
{
  requireRange(range);
  auto voxels = volume::makeZeroVolume<std::uint8_t>(image.geometry());
  const core::IndexBox all = image.geometry().fullBox();
  const int width = all.upper[0];
  image.visit(
      [&](const auto& volume)
      {
        using T = typename std::decay_t<decltype(volume)>::Value;
        const RowTest<T> test(image, range);
        if (test.possible)
          forEachRow(all, progress, "threshold",
                     [&](int j, int k)
                     {
                       const T* from = &volume.at(0, j, k);
                       int i = 0; // empty rows take no memory
                       while (i < width && !test(from[i]))
                         ++i;
                       if (i == width)
                         return;
                       std::uint8_t* to = &voxels->at(0, j, k);
                       for (; i < width; ++i)
                         to[i] = test(from[i]) ? 1 : 0;
                     });
      });
  return makeMask(std::move(voxels), all);
}

std::vector<double> otsuThresholds(const volume::IntensityHistogram& histogram, int classes)
{
  if (classes < 2 || classes > 4)
    throw core::InvalidParameter("Otsu: give 2 to 4 classes");
  const auto& bins = histogram.bins();
  const std::size_t count = bins.size();
  if (count < static_cast<std::size_t>(classes))
    throw core::InvalidParameter("Otsu: the image has too few different intensities");
  // Sums up to each bin, of voxels and of their bins' numbers.
  std::vector<double> voxels(count + 1, 0.0);
  std::vector<double> moments(count + 1, 0.0);
  for (std::size_t n = 0; n < count; ++n)
  {
    voxels[n + 1] = voxels[n] + static_cast<double>(bins[n]);
    moments[n + 1] = moments[n] + static_cast<double>(bins[n]) * static_cast<double>(n);
  }
  const auto worth = [&](std::size_t from, std::size_t to) // of a class; their sum is maximised
  {
    const double in = voxels[to] - voxels[from];
    const double moment = moments[to] - moments[from];
    return in > 0.0 ? moment * moment / in : 0.0;
  };
  // best[c][n]: the first n bins in c + 1 classes. The optimal partition by dynamic programming.
  const auto classCount = static_cast<std::size_t>(classes);
  std::vector<std::vector<double>> best(classCount, std::vector<double>(count + 1, 0.0));
  std::vector<std::vector<std::size_t>> cut(classCount, std::vector<std::size_t>(count + 1, 0));
  for (std::size_t n = 0; n <= count; ++n)
    best[0][n] = worth(0, n);
  for (std::size_t c = 1; c < classCount; ++c)
    for (std::size_t n = 0; n <= count; ++n)
    {
      best[c][n] = -1.0;
      for (std::size_t from = 0; from <= n; ++from)
        if (const double sum = best[c - 1][from] + worth(from, n); sum > best[c][n])
        {
          best[c][n] = sum;
          cut[c][n] = from;
        }
    }
  std::vector<double> thresholds(classCount - 1);
  std::size_t at = count;
  for (std::size_t c = classCount - 1; c > 0; --c)
  {
    at = cut[c][at];
    std::size_t empty = at; // any threshold between two classes without voxels is as good
    while (empty < count && bins[empty] == 0)
      ++empty;
    thresholds[c - 1] =
        histogram.lower() + 0.5 * static_cast<double>(at + empty) * histogram.binWidth();
  }
  return thresholds;
}

volume::ValueRange proposedRange(const volume::IntensityHistogram& histogram,
                                 std::optional<double> iso)
{
  const double top = histogram.range().max;
  if (iso)
    return {*iso, std::max(*iso, top)};
  return {std::min(otsuThresholds(histogram, 3).back(), top), top};
}

std::optional<ProposedRegion> proposedRegion(const volume::IntensityVolume& image,
                                             const core::Progress& progress)
{
  constexpr double kRadius = 1.5;      // mm
  constexpr double kMostVolume = 20e3; // mm^3; a larger region has run into its surroundings
  constexpr int kBorder = 2;           // voxels
  constexpr double kMostVoxels = 16.0; // of the radius; all of it down to voxels of 0.1 mm
  const volume::IntensityHistogram histogram(image);
  if (histogram.bins().size() < 3 || !(histogram.range().max > histogram.range().min))
    return std::nullopt;
  const std::vector<double> limits = otsuThresholds(histogram, 3);
  const core::GridGeometry& grid = image.geometry();
  const Mask bright =
      threshold(image, {limits.back(), histogram.range().max}, progress.part(0.0, 0.2));
  core::IndexBox inner = grid.fullBox();
  core::Index3 reach;
  for (std::size_t a = 0; a < 3; ++a)
  {
    const int border = inner.size()[a] > 2 * kBorder ? kBorder : 0;
    inner.lower[a] += border;
    inner.upper[a] -= border;
    reach[a] = static_cast<int>(
        std::min(kRadius / grid.spacing()[static_cast<Eigen::Index>(a)], kMostVoxels));
  }
  // The ball as rows along the first axis.
  struct Row
  {
    int j, k, half;
  };
  std::vector<Row> ball;
  for (int k = -reach[2]; k <= reach[2]; ++k)
    for (int j = -reach[1]; j <= reach[1]; ++j)
    {
      int half = -1;
      while (half < reach[0] &&
             Eigen::Vector3d(half + 1, j, k).cwiseProduct(grid.spacing()).norm() <= kRadius)
        ++half;
      if (half >= 0)
        ball.push_back({j, k, half});
    }
  struct Brightest
  {
    double mean = 0.0;
    std::optional<core::Index3> place;
  };
  const core::IndexBox box = bright.extent.intersected(inner);
  std::vector<Brightest> bySlice(static_cast<std::size_t>(std::max(box.upper[2] - box.lower[2], 0)),
                                 {histogram.range().min, std::nullopt});
  std::atomic<int> done{0};
  image.visit(
      [&](const auto& volume)
      {
        using T = typename std::decay_t<decltype(volume)>::Value;
        const auto meanAbout = [&](const core::Index3& at)
        {
          double sum = 0.0;
          int count = 0;
          for (const Row& row : ball)
          {
            const int j = at[1] + row.j;
            const int k = at[2] + row.k;
            if (j < 0 || k < 0 || j >= grid.dims()[1] || k >= grid.dims()[2])
              continue;
            const T* values = &volume.at(0, j, k);
            const int last = std::min(at[0] + row.half, grid.dims()[0] - 1);
            for (int i = std::max(at[0] - row.half, 0); i <= last; ++i)
            {
              const auto value = static_cast<double>(values[i]);
              if (std::isfinite(value) && value != image.padding())
              {
                sum += value;
                ++count;
              }
            }
          }
          return count > 0 ? sum / count : histogram.range().min;
        };
        tbb::parallel_for(box.lower[2], box.upper[2],
                          [&](int k)
                          {
                            progress.part(0.2, 0.7).report(static_cast<double>(done++) /
                                                               box.size()[2],
                                                           "looking for the brightest region");
                            Brightest& slice = bySlice[static_cast<std::size_t>(k - box.lower[2])];
                            for (int j = box.lower[1]; j < box.upper[1]; ++j)
                              for (int i = box.lower[0]; i < box.upper[0]; ++i)
                                if (bright.at({i, j, k}))
                                  if (const double mean = meanAbout({i, j, k}); mean > slice.mean)
                                    slice = {mean, core::Index3{i, j, k}};
                          });
      });
  double peak = histogram.range().min;
  std::optional<core::Index3> place;
  for (const Brightest& slice : bySlice) // the first of equal ones, whatever the threads did
    if (slice.place && slice.mean > peak)
    {
      peak = slice.mean;
      place = slice.place;
    }
  if (!place)
    return std::nullopt;
  struct Class // of the histogram
  {
    double count = 0.0, sum = 0.0, squares = 0.0;
    double mean() const { return sum / count; }
    double deviation() const { return std::sqrt(std::max(squares / count - mean() * mean(), 0.0)); }
  };
  Class dark, brightest;
  for (std::size_t n = 0; n < histogram.bins().size(); ++n)
  {
    const double value = histogram.center(n);
    if (value >= limits.front() && value < limits.back())
      continue;
    Class& one = value < limits.front() ? dark : brightest;
    const auto count = static_cast<double>(histogram.bins()[n]);
    one.count += count;
    one.sum += count * value;
    one.squares += count * value * value;
  }
  ProposedRegion region;
  region.seed = grid.patientFromVoxel(Eigen::Vector3d((*place)[0], (*place)[1], (*place)[2]));
  const double own = image.at((*place)[0], (*place)[1], (*place)[2]);
  const auto isSeparate = [&](const Class& beside, const core::Progress& part)
  {
    if (beside.count == 0.0)
      return false;
    region.range = {std::min(0.5 * (peak + beside.mean()), own), histogram.range().max};
    return connectedThreshold(image, region.range, {region.seed}, part).volume() <= kMostVolume;
  };
  if (isSeparate(dark, progress.part(0.7, 0.85)))
    return region;
  constexpr double kOutlier = 3.0; // deviations; nearer to the class's mean it is one of its voxels
  if (brightest.count > 0.0 && peak > brightest.mean() + kOutlier * brightest.deviation() &&
      isSeparate(brightest, progress.part(0.85, 1.0)))
    return region;
  return std::nullopt;
}

Mask combined(const Mask& a, const Mask& b, Combination how)
{
  requireSameGrid(a.geometry(), b.geometry(), "combining");
  auto voxels = volume::makeZeroVolume<std::uint8_t>(a.geometry());
  const core::IndexBox box = how == Combination::Union          ? a.extent.united(b.extent)
                             : how == Combination::Intersection ? a.extent.intersected(b.extent)
                                                                : a.extent;
  forEachRow(box, {}, "combining",
             [&](int j, int k)
             {
               for (int i = box.lower[0]; i < box.upper[0]; ++i)
               {
                 const bool inA = a.voxels->at(i, j, k) != 0;
                 const bool inB = b.voxels->at(i, j, k) != 0;
                 const bool in = how == Combination::Union          ? inA || inB
                                 : how == Combination::Intersection ? inA && inB
                                                                    : inA && !inB;
                 if (in)
                   voxels->at(i, j, k) = 1;
               }
             });
  return makeMask(std::move(voxels), box);
}

namespace
{

/// One piece of a stroke; the brush is a sound one.
core::IndexBox paintPiece(EditableMask& mask, const Brush& brush, bool value)
{
  const core::GridGeometry& grid = mask.geometry();
  // The voxel box of the ball swept from `from` to `to`: a ball's extent along voxel axis a is
  // radius / spacing[a], since the axes are orthonormal.
  const Eigen::Vector3d start = grid.voxelFromPatient(brush.from);
  const Eigen::Vector3d end = grid.voxelFromPatient(brush.to);
  core::IndexBox box;
  for (int a = 0; a < 3; ++a)
  {
    const double reach = brush.radius / grid.spacing()[a];
    const auto bounded = [&](double at)
    { return static_cast<int>(std::clamp(at, -1.0, static_cast<double>(grid.dims()[a]) + 1.0)); };
    box.lower[a] = bounded(std::floor(std::min(start[a], end[a]) - reach));
    box.upper[a] = bounded(std::ceil(std::max(start[a], end[a]) + reach)) + 1;
  }
  box = box.intersected(grid.fullBox());
  if (box.empty())
    return {};

  const Eigen::Vector3d along = brush.to - brush.from;
  const double length2 = along.squaredNorm();
  const double radius2 = brush.radius * brush.radius;
  std::optional<Eigen::Vector3d> normal;
  double half = 0.0; // mm, of the slice's thickness
  if (brush.normal)
  {
    normal = brush.normal->normalized();
    if (!normal->allFinite() || brush.normal->norm() == 0.0)
      throw core::InvalidParameter("brush: the slice's normal has no direction");
    // The distance of neighbouring voxel centres along the grid's axis nearest to the normal.
    int axis = 0;
    (grid.direction().transpose() * *normal).cwiseAbs().maxCoeff(&axis);
    half = 0.5 * grid.spacing()[axis] * std::abs(grid.direction().col(axis).dot(*normal));
  }
  return mask.change(box,
                     [&](Voxels& voxels)
                     {
                       for (int k = box.lower[2]; k < box.upper[2]; ++k)
                         for (int j = box.lower[1]; j < box.upper[1]; ++j)
                           for (int i = box.lower[0]; i < box.upper[0]; ++i)
                           {
                             const Eigen::Vector3d p =
                                 grid.patientFromVoxel(Eigen::Vector3d(i, j, k)) - brush.from;
                             const double t =
                                 length2 > 0.0 ? std::clamp(p.dot(along) / length2, 0.0, 1.0) : 0.0;
                             if ((p - t * along).squaredNorm() > radius2)
                               continue;
                             if (normal)
                             {
                               // Half-open, so that a plane midway between two slices is in one of
                               // them.
                               const double off = p.dot(*normal);
                               if (!(off > -half - 1e-9 * half && off <= half - 1e-9 * half))
                                 continue;
                             }
                             if (brush.range)
                             {
                               const double at = brush.image->at(i, j, k);
                               if (!(at >= brush.range->min && at <= brush.range->max) ||
                                   at == brush.image->padding())
                                 continue;
                             }
                             voxels.at(i, j, k) = value ? 1 : 0;
                           }
                     });
}

} // namespace

core::IndexBox paint(EditableMask& mask, const Brush& brush, bool value)
{
  if (!(brush.radius > 0.0) || !std::isfinite(brush.radius) || !brush.from.allFinite() ||
      !brush.to.allFinite())
    throw core::InvalidParameter("brush: give a radius above 0 mm, and finite positions");
  if (brush.range && !brush.image)
    throw core::InvalidParameter("brush: a range of intensities needs an image");
  if (brush.range)
    requireRange(*brush.range);
  if (brush.image)
    requireSameGrid(brush.image->geometry(), mask.geometry(), "brush");

  // The box of a long oblique stroke is mostly empty: it is painted in pieces of a few radii.
  constexpr double kLongest = 4.0; // radii
  const double pieces = std::ceil((brush.to - brush.from).norm() / (kLongest * brush.radius));
  if (pieces > 1.0)
  {
    constexpr double kMost = 1e5;
    const int count = static_cast<int>(std::min(pieces, kMost));
    core::IndexBox changed;
    for (int n = 0; n < count; ++n)
    {
      Brush piece = brush;
      piece.from = brush.from + (brush.to - brush.from) * (static_cast<double>(n) / count);
      piece.to = brush.from + (brush.to - brush.from) * (static_cast<double>(n + 1) / count);
      if (brush.normal && n > 0) // all in the slice of the first
        piece.from -=
            brush.normal->normalized() * (piece.from - brush.from).dot(brush.normal->normalized());
      changed = changed.united(paintPiece(mask, piece, value));
    }
    return changed;
  }
  return paintPiece(mask, brush, value);
}

} // namespace petrous::segmentation
