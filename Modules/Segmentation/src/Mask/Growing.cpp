#include <cmath>
#include <cstdint>
#include <vector>

#include "MaskBuilding.h"
#include "petrous/Core/NumberText.h"
#include "petrous/Core/PositionText.h"
#include "petrous/Segmentation/MaskOperations.h"

// Regions that grow from points and strokes.
namespace petrous::segmentation
{

core::Index3 seedVoxel(const volume::IntensityVolume& image, const Eigen::Vector3d& seed)
{
  const core::GridGeometry& grid = image.geometry();
  const Eigen::Vector3d voxel = grid.voxelFromPatient(seed);
  if (!voxel.allFinite() || !grid.hullContains(voxel))
    throw core::InvalidParameter("the seed at " + core::positionText(seed) +
                                 " lies outside the image; give a point inside the structure");
  core::Index3 index;
  for (int a = 0; a < 3; ++a)
    index[static_cast<std::size_t>(a)] = std::clamp(static_cast<int>(std::lround(voxel[a])), 0,
                                                    grid.dims()[static_cast<std::size_t>(a)] - 1);
  return index;
}

namespace
{

/// Marks what is connected by faces with the seeds, run by run along the first axis.
template <class Test>
core::IndexBox flood(Voxels& voxels, std::vector<core::Index3> open, const Test& isIn,
                     const core::Progress& progress)
{
  const core::Index3 dims = voxels.geometry().dims();
  core::IndexBox extent;
  std::size_t steps = 0;
  const auto isFree = [&](int i, int j, int k) { return voxels.at(i, j, k) == 0 && isIn(i, j, k); };
  while (!open.empty())
  {
    if (++steps % 4096 == 0)
      progress.check("growing");
    const auto [i, j, k] = open.back();
    open.pop_back();
    if (!isFree(i, j, k))
      continue;
    int first = i;
    while (first > 0 && isFree(first - 1, j, k))
      --first;
    int last = i;
    while (last + 1 < dims[0] && isFree(last + 1, j, k))
      ++last;
    std::fill(&voxels.at(first, j, k), &voxels.at(last, j, k) + 1, std::uint8_t{1});
    extent = extent.united({{first, j, k}, {last + 1, j + 1, k + 1}});
    const std::array<std::array<int, 2>, 4> rows{{{j - 1, k}, {j + 1, k}, {j, k - 1}, {j, k + 1}}};
    for (const auto& [y, z] : rows)
    {
      if (y < 0 || y >= dims[1] || z < 0 || z >= dims[2])
        continue;
      for (int x = first; x <= last; ++x)
        if (isFree(x, y, z))
        {
          open.push_back({x, y, z});
          while (x <= last && isFree(x, y, z)) // one for each run
            ++x;
        }
    }
  }
  return extent;
}

} // namespace

Mask connectedThreshold(const volume::IntensityVolume& image, const volume::ValueRange& range,
                        const std::vector<Eigen::Vector3d>& seeds, const core::Progress& progress,
                        const std::string& unit)
{
  if (!(range.min <= range.max))
    throw core::InvalidParameter("threshold: the lower limit (" + core::plainText(range.min) +
                                 unit + ") is above the upper one (" + core::plainText(range.max) +
                                 unit + "); give them in ascending order");
  if (seeds.empty())
    throw core::InvalidParameter("region: give a point inside the structure");
  std::vector<core::Index3> open;
  for (const Eigen::Vector3d& seed : seeds)
  {
    const core::Index3 index = seedVoxel(image, seed);
    const double value = image.at(index[0], index[1], index[2]);
    if (!(value >= range.min && value <= range.max) || value == image.padding())
      throw core::InvalidParameter("the voxel at the seed (" + core::positionText(seed) + ") has " +
                                   core::plainText(value) + unit + ", which is not between " +
                                   core::plainText(range.min) + " and " +
                                   core::plainText(range.max) + unit +
                                   "; choose a point inside the structure, or other limits");
    open.push_back(index);
  }
  auto voxels = volume::makeZeroVolume<std::uint8_t>(image.geometry());
  const core::IndexBox extent = image.visit(
      [&](const auto& volume)
      {
        const double padding = image.padding().value_or(std::nan(""));
        return flood(
            *voxels, open,
            [&](int i, int j, int k)
            {
              const auto value = static_cast<double>(volume.at(i, j, k));
              return value >= range.min && value <= range.max && value != padding;
            },
            progress);
      });
  return makeMask(std::move(voxels), extent);
}

volume::ValueRange rangeAround(const volume::IntensityVolume& image, const Eigen::Vector3d& seed,
                               const std::optional<SeedSurroundings>& surroundings,
                               double deviations, const core::Progress& progress)
{
  if (!(deviations > 0.0) || !std::isfinite(deviations))
    throw core::InvalidParameter("region: give a number of standard deviations above 0");
  const core::Index3 at = seedVoxel(image, seed);
  const auto within = [&](double value)
  { return std::isfinite(value) && value != image.padding(); };
  struct Moments
  {
    double count = 0.0, sum = 0.0, squares = 0.0;
    void add(double value)
    {
      count += 1.0;
      sum += value;
      squares += value * value;
    }
    volume::ValueRange range(double deviations, double least) const
    {
      const double mean = sum / count;
      const double width =
          deviations * std::sqrt(std::max(squares / count - mean * mean, least * least));
      return {mean - width, mean + width};
    }
  };
  Moments near;
  core::IndexBox box{at, {at[0] + 1, at[1] + 1, at[2] + 1}};
  box = padded(box, {2, 2, 2}, image.geometry());
  const std::vector<std::uint8_t> isOwn = surroundings ? ownVoxels(image, at, box, *surroundings)
                                                       : std::vector<std::uint8_t>(box.count(), 1);
  std::size_t place = 0;
  for (int k = box.lower[2]; k < box.upper[2]; ++k)
    for (int j = box.lower[1]; j < box.upper[1]; ++j)
      for (int i = box.lower[0]; i < box.upper[0]; ++i)
        if (const double value = image.at(i, j, k); isOwn[place++] != 0 && within(value))
          near.add(value);
  if (near.count == 0.0 || !within(image.at(at[0], at[1], at[2])))
    throw core::InvalidParameter("region: the image has no value at the seed; choose a point "
                                 "inside the structure");
  constexpr double kLeastDeviation = 1e-6;
  volume::ValueRange range = near.range(deviations, kLeastDeviation);
  const double own = image.at(at[0], at[1], at[2]);
  for (int round = 0; round < 3; ++round)
  {
    range = {std::min(range.min, own), std::max(range.max, own)};
    const Mask region = connectedThreshold(image, range, {seed}, progress);
    Moments all;
    const core::IndexBox& extent = region.extent;
    for (int k = extent.lower[2]; k < extent.upper[2]; ++k)
      for (int j = extent.lower[1]; j < extent.upper[1]; ++j)
        for (int i = extent.lower[0]; i < extent.upper[0]; ++i)
          if (region.voxels->at(i, j, k) != 0)
            all.add(image.at(i, j, k));
    range = all.range(deviations, kLeastDeviation);
  }
  return {std::min(range.min, own), std::max(range.max, own)};
}

Mask grownFromSeeds(const volume::IntensityVolume& image, const Mask& inside, const Mask& outside,
                    const core::IndexBox& wanted, const core::Progress& progress)
{
  const core::GridGeometry& grid = image.geometry();
  requireSameGrid(inside.geometry(), grid, "growing");
  requireSameGrid(outside.geometry(), grid, "growing");
  if (inside.count == 0 || outside.count == 0)
    throw core::InvalidParameter(inside.count == 0
                                     ? "growing: draw a stroke inside the structure first"
                                     : "growing: draw a stroke beside the structure, in what does "
                                       "not belong to it");
  core::IndexBox box = wanted.intersected(grid.fullBox());
  if (wanted.empty())
  {
    box = inside.extent.united(outside.extent);
    core::Index3 quarter = box.size();
    for (int& voxels : quarter)
      voxels = voxels / 4 + 4;
    box = padded(box, quarter, grid);
  }
  if (box.count() > kMostGrowVoxels)
    throw core::InvalidParameter(
        "growing: the strokes span " + std::to_string(box.count() / 1'000'000) +
        " million voxels, more than the " + std::to_string(kMostGrowVoxels / 1'000'000) +
        " million possible; draw them closer to the structure");

  // Intensities in 8 bits, between the 0.5 and 99.5 percentiles of the box. A step to a neighbour
  // costs their difference and its length in mm, a millimetre as much as kLevelsPerMm; in whole
  // kPerLevel-ths of a level.
  const core::Index3 size = box.size();
  const std::size_t count = box.count();
  const std::array<std::size_t, 3> steps{1, static_cast<std::size_t>(size[0]),
                                         static_cast<std::size_t>(size[0]) *
                                             static_cast<std::size_t>(size[1])};
  const auto placeOf = [&](int i, int j, int k)
  {
    return static_cast<std::size_t>(i - box.lower[0]) +
           static_cast<std::size_t>(j - box.lower[1]) * steps[1] +
           static_cast<std::size_t>(k - box.lower[2]) * steps[2];
  };
  std::vector<float> values(count);
  forEachRow(box, progress, "growing",
             [&](int j, int k)
             {
               for (int i = box.lower[0]; i < box.upper[0]; ++i)
                 values[placeOf(i, j, k)] = static_cast<float>(image.at(i, j, k));
             });
  std::vector<float> some;
  for (std::size_t n = 0; n < count; n += std::max<std::size_t>(1, count / 100'000))
    if (std::isfinite(values[n]) && static_cast<double>(values[n]) != image.padding())
      some.push_back(values[n]);
  if (some.empty())
    throw core::InvalidParameter("growing: the image has no values around the strokes");
  std::sort(some.begin(), some.end());
  const float low = some[some.size() / 200];
  const float high = some[some.size() - 1 - some.size() / 200];
  const float scale = high > low ? 255.0F / (high - low) : 0.0F;
  std::vector<std::uint8_t> levels(count);
  tbb::parallel_for(std::size_t{0}, static_cast<std::size_t>(size[2]),
                    [&](std::size_t k)
                    {
                      for (std::size_t n = k * steps[2]; n < (k + 1) * steps[2]; ++n)
                        levels[n] = std::isfinite(values[n])
                                        ? static_cast<std::uint8_t>(std::lround(
                                              std::clamp((values[n] - low) * scale, 0.0F, 255.0F)))
                                        : std::uint8_t{0};
                    });
  std::vector<float>().swap(values);

  // Dijkstra with a ring of buckets [Dial 1969, doi 10.1145/363269.363610]: costs are integers.
  constexpr double kLevelsPerMm = 2.0;
  constexpr std::uint32_t kPerLevel = 32;
  constexpr double kLongestStep = 64.0; // levels
  struct Step
  {
    core::Index3 offset;
    std::ptrdiff_t places;
    std::uint32_t cost;
  };
  std::vector<Step> neighbors;
  std::uint32_t longest = 0;
  for (int n = 0; n < 27; ++n)
  {
    const core::Index3 offset{n % 3 - 1, n / 3 % 3 - 1, n / 9 - 1};
    if (offset == core::Index3{0, 0, 0})
      continue;
    std::ptrdiff_t places = 0;
    double squares = 0.0;
    for (std::size_t a = 0; a < 3; ++a)
    {
      places += offset[a] * static_cast<std::ptrdiff_t>(steps[a]);
      squares += std::pow(offset[a] * grid.spacing()[static_cast<Eigen::Index>(a)], 2);
    }
    const double levelsLong = std::min(kLevelsPerMm * std::sqrt(squares), kLongestStep);
    const auto cost =
        std::max(std::uint32_t{1}, static_cast<std::uint32_t>(std::lround(kPerLevel * levelsLong)));
    neighbors.push_back({offset, places, cost});
    longest = std::max(longest, cost);
  }
  constexpr std::uint32_t kFar = 0xffffffffU;
  const std::uint32_t ringSize = 255 * kPerLevel + longest + 1;
  std::vector<std::uint32_t> costs(count, kFar);
  std::vector<std::uint8_t> owner(count, 0); // 1: inside, 2: outside
  std::vector<std::vector<std::uint32_t>> ring(ringSize);
  std::size_t waiting = 0;
  const auto addSeeds = [&](const Mask& seeds, std::uint8_t label)
  {
    const core::IndexBox own = seeds.extent.intersected(box);
    for (int k = own.lower[2]; k < own.upper[2]; ++k)
      for (int j = own.lower[1]; j < own.upper[1]; ++j)
        for (int i = own.lower[0]; i < own.upper[0]; ++i)
          if (seeds.voxels->at(i, j, k) != 0)
          {
            const std::size_t at = placeOf(i, j, k);
            owner[at] = label; // a voxel in both kinds: outside, drawn last
            if (costs[at] != 0)
            {
              costs[at] = 0;
              ring[0].push_back(static_cast<std::uint32_t>(at));
              ++waiting;
            }
          }
  };
  addSeeds(inside, 1);
  addSeeds(outside, 2);
  if (std::find(owner.begin(), owner.end(), 1) == owner.end() ||
      std::find(owner.begin(), owner.end(), 2) == owner.end())
    throw core::InvalidParameter("growing: draw strokes of both kinds inside the box");
  std::size_t done = 0;
  for (std::uint32_t cost = 0; waiting > 0; ++cost)
  {
    auto& bucket = ring[cost % ringSize];
    for (std::size_t n = 0; n < bucket.size(); ++n) // none is added to it meanwhile
    {
      const std::uint32_t at = bucket[n];
      --waiting;
      if (costs[at] != cost)
        continue; // reached at less since
      if (++done % 1'000'000 == 0)
        progress.report(std::min(1.0, static_cast<double>(done) / static_cast<double>(count)),
                        "growing");
      const core::Index3 place{static_cast<int>(at % steps[1]),
                               static_cast<int>(at % steps[2] / steps[1]),
                               static_cast<int>(at / steps[2])};
      bool inner = true; // so that no neighbour need be checked
      for (std::size_t a = 0; a < 3; ++a)
        inner = inner && place[a] > 0 && place[a] + 1 < size[a];
      for (const Step& step : neighbors)
      {
        bool within = true;
        for (std::size_t a = 0; !inner && a < 3; ++a)
          within = within && place[a] + step.offset[a] >= 0 && place[a] + step.offset[a] < size[a];
        if (!within)
          continue;
        const auto to = static_cast<std::size_t>(static_cast<std::ptrdiff_t>(at) + step.places);
        const auto change = static_cast<std::uint32_t>(
            std::abs(static_cast<int>(levels[at]) - static_cast<int>(levels[to])));
        const std::uint32_t total = cost + step.cost + kPerLevel * change;
        if (total < costs[to])
        {
          costs[to] = total;
          owner[to] = owner[at];
          ring[total % ringSize].push_back(static_cast<std::uint32_t>(to));
          ++waiting;
        }
      }
    }
    bucket.clear();
  }
  auto voxels = volume::makeZeroVolume<std::uint8_t>(grid);
  forEachRow(box, progress, "growing",
             [&](int j, int k)
             {
               for (int i = box.lower[0]; i < box.upper[0]; ++i)
                 if (owner[placeOf(i, j, k)] == 1)
                   voxels->at(i, j, k) = 1;
             });
  return makeMask(std::move(voxels), box);
}

} // namespace petrous::segmentation
