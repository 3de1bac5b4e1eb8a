#pragma once

#include <memory>

#include "petrous/Core/GridGeometry.h"
#include "petrous/Volume/IntensityVolume.h"
#include "petrous/Volume/LabelMap.h"

namespace petrous::volume
{

/// The same voxels, shared and not copied, in another place: on `grid`, which has as many along
/// each axis. Throws InvalidParameter if it has not, or if there are no voxels.
std::shared_ptr<const IntensityVolume> onGrid(const std::shared_ptr<const IntensityVolume>& image,
                                              const core::GridGeometry& grid);
LabelMap onGrid(LabelMap labels, const core::GridGeometry& grid);

} // namespace petrous::volume
