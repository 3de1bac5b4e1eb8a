#include "LabelShare.h"

#include <algorithm>
#include <cmath>

#include "SurfaceNet.h"

namespace petrous::volume
{

namespace
{

constexpr double kSteps = 65535.0;

} // namespace

core::IndexBox grown(const core::IndexBox& box, int voxels) noexcept
{
  core::IndexBox result = box;
  for (std::size_t a = 0; a < 3; ++a)
  {
    result.lower[a] -= voxels;
    result.upper[a] += voxels;
  }
  return result;
}

core::IndexBox moved(const core::IndexBox& box, const core::Index3& by) noexcept
{
  core::IndexBox result = box;
  for (std::size_t a = 0; a < 3; ++a)
  {
    result.lower[a] += by[a];
    result.upper[a] += by[a];
  }
  return result;
}

Eigen::Vector3d toVector(const core::Index3& index) noexcept
{
  return {1.0 * index[0], 1.0 * index[1], 1.0 * index[2]};
}

core::Index3 nearestVoxel(const Eigen::Vector3d& position) noexcept
{
  return flooredVoxel(position + Eigen::Vector3d::Constant(0.5));
}

core::Index3 flooredVoxel(const Eigen::Vector3d& position) noexcept
{
  return {static_cast<int>(std::floor(position[0])), static_cast<int>(std::floor(position[1])),
          static_cast<int>(std::floor(position[2]))};
}

core::GridGeometry gridOf(const core::GridGeometry& grid, const core::IndexBox& box)
{
  return {box.size(), grid.spacing(), grid.patientFromVoxel(toVector(box.lower)), grid.direction()};
}

float quantisedShare(double share) noexcept
{
  return static_cast<float>(std::round(share * kSteps) / kSteps);
}

std::shared_ptr<Volume<float>> smoothRanks(const LabelRanks& ranks, const LabelOrder& order,
                                           const core::Progress& progress)
{
  const core::IndexBox box = grown(ranks.box, kLabelMargin);
  const core::GridGeometry geometry = gridOf(ranks.geometry(), box);
  if (!ranks.hasSolid)
    return makeZeroVolume<float>(geometry);
  const auto inside = makeZeroVolume<std::uint8_t>(geometry);
  const core::IndexBox full = ranks.geometry().fullBox();
  const auto fillTile = [&](const core::Index3&, const core::IndexBox& tile)
  {
    const core::IndexBox source = moved(tile, box.lower).intersected(full);
    if (source.empty() || !ranks.tiles.any(source))
      return;
    for (int k = source.lower[2]; k < source.upper[2]; ++k)
      for (int j = source.lower[1]; j < source.upper[1]; ++j)
      {
        const LabelRank* from = &ranks.voxels->at(source.lower[0], j, k);
        std::uint8_t* row =
            &inside->at(source.lower[0] - box.lower[0], j - box.lower[1], k - box.lower[2]);
        for (int i = 0; i < source.size()[0]; ++i)
          row[i] = order.isSolid(from[i]) ? 1 : 0;
      }
  };
  forEachTile(geometry.dims(), progress.part(0.0, 0.1), "smoothing structures", fillTile);
  return smoothedShare(*inside, progress.part(0.1, 1.0));
}

} // namespace petrous::volume
