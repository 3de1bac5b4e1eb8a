#pragma once

#include "SyntheticScenes.h"

/// Label fields whose surfaces are known in closed form.
namespace petrous::rendering::synthetic
{

/// Labels of which `inside(patient)` is the signed distance into what is solid, mm, and
/// `index(patient)` the material. The share is linear over four voxels across the surface.
template <class Inside, class Index>
std::shared_ptr<const volume::LabelField> labelField(const core::GridGeometry& grid,
                                                     const Inside& inside, const Index& index)
{
  auto share = std::make_shared<volume::Volume<float>>(grid);
  auto indices = std::make_shared<volume::Volume<std::uint8_t>>(grid);
  const core::Index3& n = grid.dims();
  for (int k = 0; k < n[2]; ++k)
    for (int j = 0; j < n[1]; ++j)
      for (int i = 0; i < n[0]; ++i)
      {
        const Eigen::Vector3d p = grid.patientFromVoxel(Eigen::Vector3d(i, j, k));
        share->at(i, j, k) =
            static_cast<float>(std::clamp(0.5 + 0.25 * inside(p) / grid.minSpacing(), 0.0, 1.0));
        indices->at(i, j, k) = static_cast<std::uint8_t>(index(p));
      }
  auto labels = std::make_shared<volume::LabelField>();
  labels->share = share;
  labels->index = indices;
  labels->hasSolid = labels->hasLumen = true;
  return labels;
}

/// The same material wherever there is a share.
inline std::shared_ptr<const volume::LabelField>
oneStructure(std::shared_ptr<const volume::Volume<float>> share)
{
  auto labels = std::make_shared<volume::LabelField>();
  labels->index =
      std::make_shared<volume::Volume<std::uint8_t>>(share->geometry(), std::uint8_t{1});
  labels->share = std::move(share);
  labels->hasSolid = true;
  return labels;
}

} // namespace petrous::rendering::synthetic
