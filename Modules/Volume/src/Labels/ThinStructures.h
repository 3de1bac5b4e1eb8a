#pragma once

#include <vector>

#include "LabelOccupancy.h"

namespace petrous::volume
{

/// A voxel of the common grid that must be given to a structure.
struct ThinVoxel
{
  core::Index3 voxel;
  LabelRank rank;
};

/// Common voxels for what is too thin to show in them: for each voxel of `source` no common voxel
/// of which shows its structure, all common voxels that it touches. One shows a structure when it
/// carries its rank or one that goes before it, and for a solid an occupancy above 1/2.
std::vector<ThinVoxel> findThin(const LabelPriority& source, const LabelPriority& common,
                                const Volume<float>& occupancy, const LabelOrder& order,
                                const core::Progress& progress);

} // namespace petrous::volume
