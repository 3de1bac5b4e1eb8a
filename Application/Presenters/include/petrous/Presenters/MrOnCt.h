#pragma once

#include <memory>

#include "petrous/Core/Progress.h"
#include "petrous/Core/RigidTransform.h"
#include "petrous/Volume/IntensityVolume.h"

namespace petrous::presenters
{

/// The MR on the CT's grid, trilinear, in its own voxel type; beyond the MR its padding, or else
/// its smallest value. `mrFromCt` maps CT patient points to those of the MR, LPS mm. In parallel.
/// Throws CancelledError.
std::shared_ptr<const volume::IntensityVolume> mrOnCt(const volume::IntensityVolume& mr,
                                                      const core::GridGeometry& ct,
                                                      const core::RigidTransform& mrFromCt,
                                                      const core::Progress& progress = {});

} // namespace petrous::presenters
