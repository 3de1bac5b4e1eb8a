#include "ImagePair.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "petrous/Core/Error.h"

namespace petrous::registration
{

namespace
{

constexpr double kCoarsest = 8.0;      // mm, voxel size
constexpr double kVoxelsAcross = 24.0; // of the coarsest level, across the smaller field
constexpr double kMargin = 8.0;        // mm around the image content
constexpr double kFinest = 0.25;       // mm, voxel size; finer does not improve a fit
constexpr std::size_t kFewest = 500;   // voxels with a value

double fieldOf(const core::GridGeometry& grid, const core::IndexBox& box)
{
  return grid.voxelVolume() * static_cast<double>(box.count());
}

// Smallest side of a field of view, mm.
double narrowest(const core::GridGeometry& grid)
{
  double side = 1e9;
  for (std::size_t a = 0; a < 3; ++a)
    side = std::min(side, grid.dims()[a] * grid.spacing()[static_cast<Eigen::Index>(a)]);
  return side;
}

void checkGrid(const core::GridGeometry& grid, const char* name)
{
  if (*std::min_element(grid.dims().begin(), grid.dims().end()) < 2)
    throw core::InvalidParameter(std::string("registration: the ") + name +
                                 " has one slice alone; a rigid fit needs a volume");
}

void checkContent(const LevelImage& level, const char* name)
{
  if (level.valid < kFewest)
    throw core::InvalidParameter(std::string("registration: the ") + name +
                                 " holds next to no voxels with a value");
  if (!(level.high > level.low))
    throw core::InvalidParameter(std::string("registration: the ") + name +
                                 " is the same everywhere; there is nothing to align");
}

Pyramid makePyramid(const volume::IntensityVolume& image, const std::vector<double>& scales,
                    const char* name, const core::Progress& progress)
{
  Pyramid pyramid;
  pyramid.levels.push_back(makeLevel(image, scales.back(), progress));
  checkContent(pyramid.levels.front(), name);
  for (std::size_t n = scales.size() - 1; n-- > 0;)
    pyramid.levels.push_back(makeLevel(pyramid.levels.back(), scales[n]));
  std::reverse(pyramid.levels.begin(), pyramid.levels.end());
  for (const LevelImage& level : pyramid.levels)
    pyramid.content.push_back(contentBox(level, kMargin));
  return pyramid;
}

} // namespace

core::RigidTransform ImagePair::mrFromCt(const core::RigidTransform& movingFromFixed) const
{
  return fixedIsCt ? movingFromFixed : movingFromFixed.inverse();
}

core::RigidTransform ImagePair::movingFromFixed(const core::RigidTransform& mrFromCt) const
{
  return fixedIsCt ? mrFromCt : mrFromCt.inverse();
}

ImagePair ImagePair::swapped() &&
{
  return {std::move(moving), std::move(fixed), !fixedIsCt, std::move(scales)};
}

ImagePair makePair(const volume::IntensityVolume& ct, const volume::IntensityVolume& mr,
                   const std::optional<core::PatientBox>& region, int levels,
                   const core::Progress& progress)
{
  checkGrid(ct.geometry(), "CT");
  checkGrid(mr.geometry(), "MR");
  double side = std::min(narrowest(ct.geometry()), narrowest(mr.geometry()));
  if (region)
    side = std::min(side, region->sizes().minCoeff());
  const double finest = std::max({kFinest, ct.geometry().minSpacing(), mr.geometry().minSpacing()});

  ImagePair pair;
  pair.scales.push_back(finest);
  const double coarsest = std::clamp(2.0 * side / kVoxelsAcross, finest, kCoarsest);
  while (pair.scales.back() * 1.5 < coarsest)
    pair.scales.push_back(std::min(coarsest, 2.0 * pair.scales.back()));
  std::reverse(pair.scales.begin(), pair.scales.end());
  if (levels > 0 && pair.scales.size() > static_cast<std::size_t>(levels))
    pair.scales.erase(pair.scales.begin(), pair.scales.end() - levels);

  pair.fixed = makePyramid(ct, pair.scales, "CT", progress);
  pair.moving = makePyramid(mr, pair.scales, "MR", progress);
  if (region)
  {
    for (std::size_t n = 0; n < pair.levels(); ++n)
    {
      pair.fixed.content[n] = pair.fixed.levels[n].grid().boxCovering(region->min(), region->max());
      if (pair.fixed.content[n].empty())
        throw core::InvalidParameter("registration: the region lies outside the CT");
    }
    return pair;
  }
  if (fieldOf(pair.moving.finest().grid(), pair.moving.content.back()) <
      fieldOf(pair.fixed.finest().grid(), pair.fixed.content.back()))
    return std::move(pair).swapped();
  return pair;
}

} // namespace petrous::registration
