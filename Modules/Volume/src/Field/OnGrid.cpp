#include "petrous/Volume/OnGrid.h"

#include <utility>

namespace petrous::volume
{

namespace
{

template <class T>
std::shared_ptr<const Volume<T>> placed(const std::shared_ptr<const Volume<T>>& voxels,
                                        const core::GridGeometry& grid)
{
  if (!voxels || voxels->geometry().dims() != grid.dims())
    throw core::InvalidParameter("grid: it must have as many voxels along each axis as the volume");
  // Never written to: the volume is const again.
  std::shared_ptr<T> memory(voxels, const_cast<T*>(voxels->data()));
  return std::make_shared<const Volume<T>>(grid, std::move(memory));
}

} // namespace

std::shared_ptr<const IntensityVolume> onGrid(const std::shared_ptr<const IntensityVolume>& image,
                                              const core::GridGeometry& grid)
{
  if (!image)
    throw core::InvalidParameter("grid: there is no image to be placed on it");
  return std::visit(
      [&](const auto& voxels)
      { return std::make_shared<const IntensityVolume>(placed(voxels, grid), image->padding()); },
      image->voxels());
}

LabelMap onGrid(LabelMap labels, const core::GridGeometry& grid)
{
  labels.voxels = placed(labels.voxels, grid);
  return labels;
}

} // namespace petrous::volume
