#pragma once

#include <array>

#include "SyntheticScenes.h"
#include "petrous/Volume/LabelBorders.h"

/// Label fields with analytic surfaces.
namespace petrous::rendering::synthetic
{

/// Labels for which `inside(patient)` is the signed distance into the solid, mm, and
/// `index(patient)` the material. The occupancy is linear over four voxels across the surface.
template <class Inside, class Index>
std::shared_ptr<const volume::LabelField> labelField(const core::GridGeometry& grid,
                                                     const Inside& inside, const Index& index)
{
  auto labels = std::make_shared<volume::LabelField>();
  labels->occupancy =
      sampled<float>(grid, [&](const Eigen::Vector3d& p)
                     { return std::clamp(0.5 + 0.25 * inside(p) / grid.minSpacing(), 0.0, 1.0); });
  labels->index = sampled<std::uint8_t>(grid, index);
  std::array<bool, 256> solid{};
  solid.fill(true);
  solid[0] = false;
  labels->borders = volume::makeLabelBorders(*labels->occupancy, *labels->index, solid);
  labels->hasSolid = labels->hasLumen = true;
  return labels;
}

/// One material wherever the occupancy is above 0.
inline std::shared_ptr<const volume::LabelField>
oneStructure(std::shared_ptr<const volume::Volume<float>> occupancy)
{
  auto labels = std::make_shared<volume::LabelField>();
  labels->index =
      std::make_shared<volume::Volume<std::uint8_t>>(occupancy->geometry(), std::uint8_t{1});
  labels->occupancy = std::move(occupancy);
  labels->hasSolid = true;
  return labels;
}

} // namespace petrous::rendering::synthetic
