#pragma once

#include <Eigen/Core>

#include "petrous/Core/RigidTransform.h"

namespace petrous::presenters
{

/// Manual registration of an MR. All functions take and return X_MC (CT patient points to MR
/// patient points, LPS mm), while what moves is the MR overlay on the CT.

/// The MR overlay translated by `shift` mm.
core::RigidTransform shifted(const core::RigidTransform& mrFromCt, const Eigen::Vector3d& shift);

/// The MR overlay rotated about an axis through a CT patient point, degrees, right-handed.
core::RigidTransform turned(const core::RigidTransform& mrFromCt, const Eigen::Vector3d& axis,
                            double degrees, const Eigen::Vector3d& about);

/// The MR overlay translated so that its patient point `mr` coincides with the CT's `ct`.
core::RigidTransform broughtTo(const core::RigidTransform& mrFromCt, const Eigen::Vector3d& mr,
                               const Eigen::Vector3d& ct);

/// How far two registrations differ.
struct MrDifference
{
  double shift = 0.0; ///< mm, of the MR overlay at a CT patient point
  double turn = 0.0;  ///< degrees
};
MrDifference difference(const core::RigidTransform& from, const core::RigidTransform& to,
                        const Eigen::Vector3d& at);

} // namespace petrous::presenters
