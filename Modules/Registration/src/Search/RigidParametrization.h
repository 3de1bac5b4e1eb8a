#pragma once

#include <vector>

#include <Eigen/Core>

#include "petrous/Core/RigidTransform.h"

namespace petrous::registration
{

using PoseVector = Eigen::Matrix<double, 6, 1>;

/// Six numbers, all in mm, for the poses about one pose: a rotation vector times `radius`, then a
/// translation of the mapped centre. With the samples' radius a step of 1 mm moves them 1 mm in
/// root mean square whichever number it is of, so that an optimiser needs no scales.
class RigidParametrization
{
public:
  /// Zero is `base`; rotations are about the point that `centre` (fixed patient) is mapped to.
  RigidParametrization(const core::RigidTransform& base, const Eigen::Vector3d& centre, double radius);

  core::RigidTransform pose(const PoseVector& x) const;

  /// A gradient at pose(x) from one for small motions: translation (1/mm) and rotation (1/rad)
  /// about the mapped centre, in the moving patient's axes.
  PoseVector gradient(const PoseVector& x, const Eigen::Vector3d& translation,
                      const Eigen::Vector3d& rotation) const;

private:
  core::RigidTransform m_base;
  Eigen::Vector3d m_centre;
  double m_radius;
};

/// Largest distance between where two poses take a point within `radius` mm of `centre`, bounded
/// from above: that of the centre plus 2 radius sin(angle / 2).
double poseDistance(const core::RigidTransform& a, const core::RigidTransform& b,
                    const Eigen::Vector3d& centre, double radius);

/// The mean of poses that lie close together, by rotation vectors about the first and by where they
/// take `centre`.
core::RigidTransform meanPose(const std::vector<core::RigidTransform>& poses,
                              const Eigen::Vector3d& centre);

} // namespace petrous::registration
