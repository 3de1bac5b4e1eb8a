#pragma once

#include "LawScene.h"

namespace petrous::simulation
{

/// How far the surface of a cut lies from the balls that made it, in voxels.
struct SurfaceError
{
  double rms = 0.0;
  double most = 0.0;
  double mean = 0.0; ///< signed: above 0 where too much is gone
  std::size_t points = 0;
};

/// Of the groove that the scene's bites have made: from their centres rays go in all directions to
/// the 1/2 level of the mask; the distance of that point from the union of the balls is
/// min |p - c| - R over all bites, exact outside the union, and inside it but for the ridges
/// between neighbours, which stand s^2 / (8 R) high for a step s: below 1e-4 mm here. Points
/// outside the bone do not count.
///
/// centers     bites from which rays go, evenly over all of them
/// directions  of each
SurfaceError surfaceErrorOf(const testing::LawScene& scene, int centers, int directions);

} // namespace petrous::simulation
