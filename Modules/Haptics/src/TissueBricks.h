#pragma once

#include <cstdint>
#include <vector>

#include "petrous/Volume/TissueField.h"

namespace petrous::haptics
{

constexpr int kTissueBrick = 8; ///< voxels

/// What a servo tick must know of a neighbourhood before it looks at voxels, per brick of 8^3 of
/// the CT's grid, first axis fastest. Whatever is cut, it holds: a cut only takes tissue away.
struct TissueBricks
{
  core::Index3 dims;
  std::vector<std::uint8_t> distance; ///< Chebyshev, bricks, to the next that may hold tissue
  std::vector<float> steepness; ///< |gradient| of interpolated c_CT and unions at most, per mm;
                                ///< of the brick and one voxel around it
};

/// Reads every voxel of the CT once, in parallel; of the unions those where they are.
TissueBricks findTissueBricks(const volume::TissueField& tissue);

} // namespace petrous::haptics
