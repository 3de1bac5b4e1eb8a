#pragma once

#include <string>
#include <vector>

#include "LabelOccupancy.h"

namespace petrous::volume
{

/// Structures of several grids on one.
struct ResampledLabels
{
  LabelPriority ranks;
  std::shared_ptr<Volume<float>> occupancy; ///< on the same grid
  std::vector<std::string> notes;
};

/// Brings labels of several grids onto the finest, over all of them.
///
/// Each grid has its smoothed occupancy S, by the voxels of that grid as if it were alone. At a voxel
/// of the common grid
///
///   occupancy = max over the grids of S
///
/// averaged over the voxel where it is larger than theirs. The voxel belongs to the structure with
/// the largest part of T, the trilinear occupancy of the grid's voxels taken as 0 and 1, where T or
/// occupancy reach 1/2; between grids the first rank wins. A grid that is a part of the same lattice is
/// taken over unchanged.
///
/// What is too thin to show in any common voxel that it touches is given all of those, at
/// kInsideFloor.
///
/// Where the common grid would have more than `maxVoxels`, its finest axes are coarsened until it
/// has not, which a note says.
ResampledLabels resampleLabels(const std::vector<LabelPriority>& grids, const LabelOrder& order,
                               std::size_t maxVoxels, const core::Progress& progress);

} // namespace petrous::volume
