#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "petrous/Volume/TissueField.h"

namespace petrous::haptics
{

constexpr int kTissueBrick = 2; ///< voxels

/// Bounds on the neighbourhood of a point for the servo tick, evaluated before voxels are read: per
/// brick of 2^3 voxels of the CT's grid, first axis fastest. Valid for every cut, since cutting
/// only removes tissue.
///
/// The bricks are this small because of soft tissue, which is only a quarter below the threshold,
/// next to cortical bone's steep edges: with larger ones every point in it would count as near.
struct TissueBricks
{
  static constexpr std::uint8_t kUnionHere =
      0x80; ///< a union's occupancy is above 0 somewhere in it
  static constexpr int kMaxDistance = 31;

  core::Index3 dims;

  /// Chebyshev distance in bricks to the next that may contain tissue, at most kMaxDistance; and
  /// kUnionHere.
  std::vector<std::uint8_t> distance;

  /// Code of the bound on |gradient| of interpolated c_CT and unions, per mm, in the brick and one
  /// voxel around it: see `steepnessOf`.
  std::vector<std::uint8_t> steepness;

  /// Upper bound of a code's steepness, per mm: 0 is flat, each further code is 2^(1/16) times the
  /// previous one, up to about 900; infinite for the last.
  static const std::array<float, 256>& steepnessOf() noexcept;
};

/// Of the result of findTissueBricks: incremented with every change of it.
constexpr int kTissueBricksVersion = 1;

struct KeptField;

/// Result of findTissueBricks, from the store if available (HapticField.h).
TissueBricks keptBricks(const volume::TissueField& tissue, const KeptField& kept);

/// Reads every voxel of CT and unions once, in parallel.
TissueBricks findTissueBricks(const volume::TissueField& tissue);

} // namespace petrous::haptics
