#pragma once

#include <vector>

#include <Eigen/Core>

#include "petrous/Core/RigidTransform.h"

namespace petrous::registration
{

using PoseVector = Eigen::Matrix<double, 6, 1>;

/// Parametrization of the poses near a base pose by six numbers, all in mm: a rotation vector times
/// `radius`, then a translation of the mapped centre. With the samples' radius, a step of 1 mm in
/// any parameter moves the samples by 1 mm RMS, so that an optimizer needs no parameter scales.
class RigidParametrization
{
public:
  /// Zero is `base`; rotations are about the image of `centre` (fixed patient).
  RigidParametrization(const core::RigidTransform& base, const Eigen::Vector3d& centre,
                       double radius);

  core::RigidTransform pose(const PoseVector& x) const;

  /// Gradient at pose(x) from the gradient for small motions: translation (1/mm) and rotation
  /// (1/rad) about the mapped centre, in the moving patient's axes.
  PoseVector gradient(const PoseVector& x, const Eigen::Vector3d& translation,
                      const Eigen::Vector3d& rotation) const;

private:
  core::RigidTransform m_base;
  Eigen::Vector3d m_centre;
  double m_radius;
};

/// Upper bound of the distance between the positions to which two poses map a point within `radius`
/// mm of `centre`: that of the centre plus 2 radius sin(angle / 2).
double poseDistance(const core::RigidTransform& a, const core::RigidTransform& b,
                    const Eigen::Vector3d& centre, double radius);

/// Mean of poses close to each other, from rotation vectors relative to the first and the mapped
/// positions of `centre`.
core::RigidTransform meanPose(const std::vector<core::RigidTransform>& poses,
                              const Eigen::Vector3d& centre);

} // namespace petrous::registration
