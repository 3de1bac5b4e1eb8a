#pragma once

#include <string>
#include <vector>

#include "LabelOccupancy.h"

namespace petrous::volume
{

/// Structures of several grids, resampled to one.
struct ResampledLabels
{
  LabelPriority ranks;
  std::shared_ptr<Volume<float>> occupancy; ///< on the same grid
  std::vector<std::string> notes;
};

/// Resamples labels of several grids to the finest, extended over all of them.
///
/// Each grid has its smoothed occupancy S, from the voxels of that grid alone. At a voxel of the
/// common grid
///
///   occupancy = max over the grids of S
///
/// averaged over the voxel if it is larger than theirs. The voxel belongs to the structure with the
/// largest part of T, the trilinear occupancy of the grid's voxels taken as 0 and 1, where T or
/// occupancy reach 1/2; between grids the first rank wins. A grid that is part of the same lattice
/// is copied unchanged.
///
/// A structure too thin to show in any common voxel that it touches gets all of these, with an
/// occupancy of kInsideFloor.
///
/// If the common grid would have more than `maxVoxels`, its finest axes are coarsened until it does
/// not, and a note is added.
ResampledLabels resampleLabels(const std::vector<LabelPriority>& grids, const LabelOrder& order,
                               std::size_t maxVoxels, const core::Progress& progress);

} // namespace petrous::volume
