#pragma once

#include <string>
#include <vector>

#include "LabelShare.h"

namespace petrous::volume
{

/// Structures of several grids on one.
struct ResampledLabels
{
  LabelRanks ranks;
  std::shared_ptr<Volume<float>> share; ///< on the same grid
  std::vector<std::string> notes;
};

/// Brings labels of several grids onto the finest, over all of them.
///
/// Each grid has its smoothed share S, by the voxels of that grid as if it were alone, and the
/// trilinear share T of its solid voxels taken as 0 and 1. At a voxel of the common grid
///
///   share = max over the grids of clamp(S, T - 1/4, T + 1/4)
///
/// both averaged over the voxel where it is larger than theirs. S has no steps, and a flat surface
/// is at 1/2 in both; T has the right width where a structure is a voxel thin, which S has not. The
/// voxel belongs to the structure with the largest part of T, where T or share reach 1/2; between
/// grids the first rank wins. A grid that is a part of the same lattice is taken over unchanged.
///
/// What is too thin to show in any common voxel that it touches is given all of those, at
/// kInsideFloor.
///
/// Where the common grid would have more than `mostVoxels`, its finest axes are coarsened until it
/// has not, which a note says.
ResampledLabels resampleLabels(const std::vector<LabelRanks>& grids, const LabelOrder& order,
                               std::size_t mostVoxels, const core::Progress& progress);

} // namespace petrous::volume
