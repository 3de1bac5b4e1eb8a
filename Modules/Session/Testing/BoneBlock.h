#pragma once

#include <algorithm>
#include <cstdint>
#include <memory>

#include "LoopScene.h"
#include "petrous/Haptics/HapticField.h"

namespace petrous::session::testing
{

/// Bone of 1500 HU below z = 0, otherwise air, on the block's grid.
inline std::shared_ptr<haptics::HapticField>
boneOf(const std::shared_ptr<volume::PublishedMask>& mask,
       std::vector<haptics::SoftStructure> soft = {})
{
  const core::GridGeometry grid = gridOfTheBlock();
  auto voxels = std::make_shared<volume::Volume<std::int16_t>>(grid);
  for (int k = 0; k < grid.dims()[2]; ++k)
    for (int j = 0; j < grid.dims()[1]; ++j)
      for (int i = 0; i < grid.dims()[0]; ++i)
      {
        const double z = grid.patientFromVoxel({1.0 * i, 1.0 * j, 1.0 * k}).z();
        voxels->at(i, j, k) =
            static_cast<std::int16_t>(std::clamp(300.0 - 2000.0 * z, -1000.0, 1500.0));
      }
  const volume::TissueField tissue(std::make_shared<volume::IntensityVolume>(
                                       std::shared_ptr<const volume::Volume<std::int16_t>>(voxels)),
                                   {}, nullptr, {});
  return std::make_shared<haptics::HapticField>(tissue, mask, std::move(soft));
}

/// A layer of 1.5 mm on that bone with a stiffness of 0.3 N/mm.
inline haptics::SoftStructure softLayer()
{
  const core::GridGeometry grid = gridOfTheBlock();
  volume::Volume<float> occupancy(grid);
  for (int k = 0; k < grid.dims()[2]; ++k)
    for (int j = 0; j < grid.dims()[1]; ++j)
      for (int i = 0; i < grid.dims()[0]; ++i)
      {
        const double z = grid.patientFromVoxel({1.0 * i, 1.0 * j, 1.0 * k}).z();
        occupancy.at(i, j, k) =
            static_cast<float>(std::clamp(0.5 + std::min(1.5 - z, z + 0.3), 0.0, 1.0));
      }
  return {volume::makeDistanceMap(occupancy, grid), 0.3};
}

} // namespace petrous::session::testing
