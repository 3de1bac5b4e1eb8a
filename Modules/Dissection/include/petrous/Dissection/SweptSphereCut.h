#pragma once

#include <memory>
#include <vector>

#include "petrous/Dissection/ProtectedTissue.h"
#include "petrous/Volume/CutMask.h"

namespace petrous::dissection
{

/// The volume swept by a burr between two positions, in patient LPS mm.
struct SweptSphere
{
  Eigen::Vector3d from{0.0, 0.0, 0.0};
  Eigen::Vector3d to{0.0, 0.0, 0.0};
  double radius = 0.0; ///< mm, > 0
};

/// Lowers the mask: mask = min(mask, 1 - coverage), never below what is protected. Idempotent: a
/// burr at rest removes exactly nothing the second time. Returns the bricks that changed; each gets
/// a new version. Parts outside the grid have no effect.
///
/// coverage is the fraction of a voxel covered by the burr, clamped to [0, 1]
/// (Documentation/adr/0006):
///
///   coverage = 1/2 - (d - b) / (2 w)       d  signed distance to the swept sphere, mm
///   b = sum_a h_a^2/12 d2d/dx_a2           mean error of trilinear interpolation of d
///   w = |spacing|                          half width of the ramp: one voxel diagonal
///
/// With this w no corner of a cell that the surface crosses is clamped, so the 1/2 level of the
/// interpolated mask is the sphere, without voxel steps; b corrects the bias due to its curvature.
///
/// Throws InvalidParameter if the radius is not above 0 or a position is not finite.
std::vector<std::size_t> cut(volume::CutMask& mask, const SweptSphere& burr,
                             const ProtectedTissue& keep = {});

} // namespace petrous::dissection
