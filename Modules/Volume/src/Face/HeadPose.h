#pragma once

#include <vector>

#include "HeadCells.h"

namespace petrous::volume
{

/// Of the head's halves: normal * (axes * patient) = offset. The normal is to the left.
struct SymmetryPlane
{
  Eigen::Vector3d normal{1.0, 0.0, 0.0};
  double offset = 0.0;
  double score = 0.0; ///< 1: the head's surface is its own mirror image; 0: nothing of it fits
};

/// The planes that mirror the head's surface on itself best, the best first; their normals are at
/// least 20 degrees apart. A cranium has one from side to side, too. Of what is mirrored out of the
/// image nothing is known, so that most of an ear alone has none.
std::vector<SymmetryPlane> symmetryPlanes(const HeadCells& head);

/// Axes of a head whose halves the plane parts: x to its left, y to its back, z up. With a pitch of
/// 0 it looks to the front (patient frame, LPS: -y) as much as its turn allows; positive lowers the
/// chin.
Eigen::Matrix3d headAxes(const Eigen::Vector3d& left, double pitch);

} // namespace petrous::volume
