#pragma once

#include "LawScene.h"

namespace petrous::session
{

/// Distance of a cut's surface from the balls that made it, in voxels.
struct SurfaceError
{
  double rms = 0.0;
  double most = 0.0;
  double mean = 0.0; ///< signed: positive where too much was removed
  std::size_t points = 0;
};

/// Error of the groove made by the scene's removal steps (bites): rays from their centres in all
/// directions are intersected with the 1/2 level of the mask. The distance of that point from the
/// union of the balls is min |p - c| - R over all bites: exact outside the union, and inside it
/// except for the ridges between neighbours, which are s^2 / (8 R) high for a step s, here below
/// 1e-4 mm. Points outside the bone are ignored.
///
/// centers     number of bites from which rays are cast, evenly spaced
/// directions  per bite
SurfaceError surfaceErrorOf(const testing::LawScene& scene, int centers, int directions);

} // namespace petrous::session
