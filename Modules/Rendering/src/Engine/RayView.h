#pragma once

#include <Eigen/Core>

#include "petrous/Core/RigidTransform.h"

namespace petrous::rendering
{

/// The rays of a picture, affine in the pixel's normalized device coordinates x, y in -1..1:
///   origin    = origin + x originX + y originY              patient mm
///   direction = direction + x directionX + y directionY     patient mm at unit view depth
/// Covers all OpenGL projections: perspective, off-axis, parallel. Composed in double precision, so
/// the picture does not depend on the scene's distance from the world origin.
struct RayView
{
  Eigen::Vector3d origin = Eigen::Vector3d::Zero();
  Eigen::Vector3d originX = Eigen::Vector3d::Zero();
  Eigen::Vector3d originY = Eigen::Vector3d::Zero();
  Eigen::Vector3d direction{0.0, 0.0, 1.0};
  Eigen::Vector3d directionX = Eigen::Vector3d::Zero();
  Eigen::Vector3d directionY = Eigen::Vector3d::Zero();
  bool parallel = false;

  /// View depth from z in -1..1: [1] / (z + [0]) in perspective, [2] + [3] z in parallel.
  Eigen::Vector4d depth = Eigen::Vector4d::Zero();

  /// A point at x, y and view depth t is origin + axes (x t, y t, t); in parallel, at t along
  /// `direction`, origin + axes (x, y, t).
  Eigen::Matrix3d axes() const
  {
    Eigen::Matrix3d axes;
    axes << (parallel ? originX : directionX), (parallel ? originY : directionY), direction;
    return axes;
  }
};

/// From a camera's view and projection matrices (OpenGL conventions, column vectors) and the pose
/// of the patient frame in the world. Throws InvalidParameter if a matrix is singular or not
/// finite.
RayView rayView(const Eigen::Matrix4d& viewFromWorld, const Eigen::Matrix4d& projection,
                const Eigen::Matrix4d& worldFromPatient);

} // namespace petrous::rendering
