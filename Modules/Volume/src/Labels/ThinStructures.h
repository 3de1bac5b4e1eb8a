#pragma once

#include <vector>

#include "LabelOccupancy.h"

namespace petrous::volume
{

/// A voxel of the common grid that must be assigned to a structure.
struct ThinVoxel
{
  core::Index3 voxel;
  LabelRank rank;
};

/// Common voxels for structures too thin to show in them: for each voxel of `source` without a
/// common voxel that shows its structure, all common voxels that it touches. A voxel shows a
/// structure if it carries its rank or a prior one and, for a solid, an occupancy above 1/2.
std::vector<ThinVoxel> findThin(const LabelPriority& source, const LabelPriority& common,
                                const Volume<float>& occupancy, const LabelOrder& order,
                                const core::Progress& progress);

} // namespace petrous::volume
