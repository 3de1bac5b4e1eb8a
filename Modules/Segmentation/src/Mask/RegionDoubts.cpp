#include "petrous/Segmentation/RegionDoubts.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <vector>

#include "MaskBuilding.h"
#include "petrous/Segmentation/MaskOperations.h"
#include "petrous/Volume/IntensityHistogram.h"

namespace petrous::segmentation
{

namespace
{

template <class Visit> // of (voxel, value); false ends it
bool forEachIn(const volume::IntensityVolume& image, const core::IndexBox& box, const Visit& visit)
{
  for (int k = box.lower[2]; k < box.upper[2]; ++k)
    for (int j = box.lower[1]; j < box.upper[1]; ++j)
      for (int i = box.lower[0]; i < box.upper[0]; ++i)
        if (const double value = image.at(i, j, k);
            std::isfinite(value) && value != image.padding())
          if (!visit(core::Index3{i, j, k}, value))
            return false;
  return true;
}

core::IndexBox around(const core::Index3& at, const core::Index3& reach,
                      const core::GridGeometry& grid)
{
  return padded({at, {at[0] + 1, at[1] + 1, at[2] + 1}}, reach, grid);
}

std::size_t placeIn(const core::IndexBox& box, const core::Index3& at)
{
  const core::Index3 size = box.size();
  std::size_t place = 0;
  for (std::size_t a = 3; a-- > 0;)
    place =
        place * static_cast<std::size_t>(size[a]) + static_cast<std::size_t>(at[a] - box.lower[a]);
  return place;
}

std::optional<Eigen::Vector3d> insideOf(const volume::IntensityVolume& image,
                                        const core::Index3& seed,
                                        const SeedSurroundings& surroundings)
{
  constexpr double kReach = SeedSurroundings::kReach;
  const core::GridGeometry& grid = image.geometry();
  core::Index3 reach;
  for (std::size_t a = 0; a < 3; ++a)
    reach[a] = static_cast<int>(std::min(kReach / grid.spacing()[static_cast<Eigen::Index>(a)],
                                         double{SeedSurroundings::kMostVoxels}));
  const core::IndexBox box = around(seed, reach, grid);
  const std::vector<std::uint8_t> own = ownVoxels(image, seed, box, surroundings);
  double nearest = kReach;
  std::optional<Eigen::Vector3d> inside;
  forEachIn(image, box,
            [&](const core::Index3& at, double)
            {
              const double distance =
                  Eigen::Vector3d(at[0] - seed[0], at[1] - seed[1], at[2] - seed[2])
                      .cwiseProduct(grid.spacing())
                      .norm();
              if (distance <= nearest && own[placeIn(box, at)] != 0 &&
                  forEachIn(image, around(at, {2, 2, 2}, grid),
                            [&](const core::Index3&, double value)
                            { return surroundings.isNearOwn(value); }))
              {
                nearest = distance;
                inside = grid.patientFromVoxel(Eigen::Vector3d(at[0], at[1], at[2]));
              }
              return true;
            });
  return inside;
}

} // namespace

volume::ValueRange usualRange(const volume::IntensityVolume& image)
{
  constexpr double kOutlying = 0.01;
  const volume::IntensityHistogram whole(image);
  return {whole.percentile(kOutlying), whole.percentile(1.0 - kOutlying)};
}

std::vector<std::uint8_t> ownVoxels(const volume::IntensityVolume& image, const core::Index3& seed,
                                    const core::IndexBox& box, const SeedSurroundings& surroundings)
{
  std::vector<std::uint8_t> isCandidate(box.count(), 0);
  forEachIn(image, box,
            [&](const core::Index3& at, double value)
            {
              isCandidate[placeIn(box, at)] = surroundings.isNearOwn(value);
              return true;
            });
  std::vector<std::uint8_t> own(box.count(), 0);
  std::vector<core::Index3> open{seed};
  own[placeIn(box, seed)] = 1;
  while (!open.empty())
  {
    const core::Index3 at = open.back();
    open.pop_back();
    for (std::size_t a = 0; a < 3; ++a)
      for (const int step : {-1, 1})
      {
        core::Index3 next = at;
        next[a] += step;
        if (!box.contains(next))
          continue;
        const std::size_t place = placeIn(box, next);
        if (isCandidate[place] != 0 && own[place] == 0)
        {
          own[place] = 1;
          open.push_back(next);
        }
      }
  }
  return own;
}

std::optional<SeedSurroundings> surroundingsOf(const volume::IntensityVolume& image,
                                               const Eigen::Vector3d& seed,
                                               const std::optional<volume::ValueRange>& usual)
{
  constexpr double kLeastShare = 0.05; // of the voxels, in either class
  constexpr double kLeastStep = 0.1;   // of the image's range
  constexpr double kLeastRatio = 3.0;  // of the step and the deviation within the classes
  const core::GridGeometry& grid = image.geometry();
  const core::Index3 at = seedVoxel(image, seed);
  const core::IndexBox box = around(at, {2, 2, 2}, grid);
  auto near = std::make_shared<volume::Volume<float>>(grid.cropped(box),
                                                      std::numeric_limits<float>::quiet_NaN());
  forEachIn(image, box,
            [&](const core::Index3& voxel, double value)
            {
              near->at(voxel[0] - box.lower[0], voxel[1] - box.lower[1], voxel[2] - box.lower[2]) =
                  static_cast<float>(value);
              return true;
            });
  const volume::IntensityHistogram histogram(
      volume::IntensityVolume(std::shared_ptr<const volume::Volume<float>>(std::move(near))));
  if (histogram.bins().size() < 2 || !(histogram.range().max > histogram.range().min))
    return std::nullopt;

  SeedSurroundings found;
  found.limit = otsuThresholds(histogram, 2).front();
  struct Class
  {
    double count = 0.0, sum = 0.0, squares = 0.0;
    double mean() const { return sum / count; }
  };
  Class classes[2];
  forEachIn(image, box,
            [&](const core::Index3&, double value)
            {
              Class& of = classes[value >= found.limit ? 1 : 0];
              of.count += 1.0;
              of.sum += value;
              of.squares += value * value;
              return true;
            });
  const double all = classes[0].count + classes[1].count;
  if (std::min(classes[0].count, classes[1].count) < std::max(kLeastShare * all, 1.0))
    return std::nullopt;
  found.darker = classes[0].mean();
  found.brighter = classes[1].mean();
  double within = 0.0;
  for (const Class& of : classes)
    within += of.squares - of.count * of.mean() * of.mean();
  const double step = found.brighter - found.darker;
  const double deviation = std::sqrt(std::max(within / all, 0.0));
  if (step <= kLeastRatio * deviation)
    return std::nullopt;
  const volume::ValueRange whole = usual ? *usual : usualRange(image);
  if (step < kLeastStep * (whole.max - whole.min))
    return std::nullopt;
  found.width = std::max(0.5 * step, kLeastRatio * deviation);

  found.isBrighter = image.at(at[0], at[1], at[2]) >= found.limit;
  found.isBorder =
      !forEachIn(image, around(at, {1, 1, 1}, grid),
                 [&](const core::Index3&, double value) { return found.isOwn(value); });
  if (found.isBorder)
    found.inside = insideOf(image, at, found);
  return found;
}

RegionDoubts doubtsOf(const Mask& region)
{
  RegionDoubts doubts;
  if (region.volume() > RegionDoubts::kMostVolume)
    doubts.volume = region.volume();
  if (region.count > 0)
  {
    const core::IndexBox all = region.geometry().fullBox();
    int faces = 0;
    for (std::size_t a = 0; a < 3; ++a)
      faces += (region.extent.lower[a] == all.lower[a] ? 1 : 0) +
               (region.extent.upper[a] == all.upper[a] ? 1 : 0);
    if (faces > RegionDoubts::kMostFaces)
      doubts.faces = faces;
  }
  return doubts;
}

} // namespace petrous::segmentation
