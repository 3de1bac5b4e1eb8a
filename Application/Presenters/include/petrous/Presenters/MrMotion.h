#pragma once

#include <Eigen/Core>

#include "petrous/Core/RigidTransform.h"

namespace petrous::presenters
{

/// Ways to move an MR over the CT by hand. All take and give X_MC (CT patient points to MR patient
/// points, LPS mm), while what moves is the MR's picture over the CT.

/// The MR's picture by `shift` mm.
core::RigidTransform shifted(const core::RigidTransform& mrFromCt, const Eigen::Vector3d& shift);

/// The MR's picture turned about an axis through a CT patient point, degrees, right-handed.
core::RigidTransform turned(const core::RigidTransform& mrFromCt, const Eigen::Vector3d& axis,
                            double degrees, const Eigen::Vector3d& about);

/// The MR's picture moved, not turned, until its patient point `mr` lies at the CT's `ct`.
core::RigidTransform broughtTo(const core::RigidTransform& mrFromCt, const Eigen::Vector3d& mr,
                               const Eigen::Vector3d& ct);

/// How far two placements differ.
struct MrDifference
{
  double shift = 0.0; ///< mm, of the MR's picture at a CT patient point
  double turn = 0.0;  ///< degrees
};
MrDifference difference(const core::RigidTransform& from, const core::RigidTransform& to,
                        const Eigen::Vector3d& at);

} // namespace petrous::presenters
