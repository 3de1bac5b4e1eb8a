#pragma once

#include "petrous/Core/GridGeometry.h"

namespace petrous::presenters
{

/// The box around the centres of some voxels of `grid`, in voxels of `onto`.
Eigen::AlignedBox3d boxOn(const core::GridGeometry& onto, const core::GridGeometry& grid,
                          const core::IndexBox& box);

/// Whether each of these centres lies in a voxel of `onto`.
bool isWithin(const core::GridGeometry& onto, const core::GridGeometry& grid,
              const core::IndexBox& box);

} // namespace petrous::presenters
