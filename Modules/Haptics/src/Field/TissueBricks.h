#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "petrous/Volume/TissueField.h"

namespace petrous::haptics
{

constexpr int kTissueBrick = 2; ///< voxels

/// What a servo tick must know of a neighbourhood before it looks at voxels, per brick of 2^3 of
/// the CT's grid, first axis fastest. Whatever is cut, it holds: a cut only takes tissue away.
///
/// Bricks are this small because what keeps a tool from being looked at is soft tissue: it lies
/// only a quarter below the threshold, next to cortical bone's steep edges.
struct TissueBricks
{
  static constexpr std::uint8_t kUnionHere = 0x80; ///< a union's occupancy is above 0 somewhere in it
  static constexpr int kMaxDistance = 31;

  core::Index3 dims;

  /// Chebyshev, bricks, to the next that may hold tissue, at most kMaxDistance; and kUnionHere.
  std::vector<std::uint8_t> distance;

  /// Code of |gradient| of interpolated c_CT and unions at most, per mm, in the brick and one voxel
  /// around it: see `steepnessOf`.
  std::vector<std::uint8_t> steepness;

  /// Upper bound of a code's steepness, per mm: 0 is flat, and each of the others is 2^(1/16) times
  /// the one before, up to some 900; infinite for the last.
  static const std::array<float, 256>& steepnessOf() noexcept;
};

/// Of what findTissueBricks returns: raised with every change of it.
constexpr int kTissueBricksVersion = 1;

struct KeptField;

/// findTissueBricks, or what it returned for the same tissue before (HapticField.h).
TissueBricks keptBricks(const volume::TissueField& tissue, const KeptField& kept);

/// Reads every voxel of CT and unions once, in parallel.
TissueBricks findTissueBricks(const volume::TissueField& tissue);

} // namespace petrous::haptics
