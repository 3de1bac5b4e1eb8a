#pragma once

#include <Eigen/Core>

#include "petrous/Core/RigidTransform.h"

namespace petrous::rendering
{

/// The rays of a picture, affine in the pixel's normalised device coordinates x, y in -1..1:
///   origin    = origin + x originX + y originY              patient mm
///   direction = direction + x directionX + y directionY     patient mm at unit depth of view
/// Any projection that a graphics library makes: perspective, off-axis, parallel. Composed in
/// double precision, so that a scene far from the world's origin draws the same.
struct RayView
{
  Eigen::Vector3d origin = Eigen::Vector3d::Zero();
  Eigen::Vector3d originX = Eigen::Vector3d::Zero();
  Eigen::Vector3d originY = Eigen::Vector3d::Zero();
  Eigen::Vector3d direction{0.0, 0.0, 1.0};
  Eigen::Vector3d directionX = Eigen::Vector3d::Zero();
  Eigen::Vector3d directionY = Eigen::Vector3d::Zero();
  bool parallel = false;

  /// Depth of view from z in -1..1: [1] / (z + [0]) in perspective, [2] + [3] z in parallel.
  Eigen::Vector4d depth = Eigen::Vector4d::Zero();
};

/// From the matrices of a camera (OpenGL's conventions, column vectors) and the pose of the patient
/// frame in the world. Throws InvalidParameter where a matrix is singular or not finite.
RayView rayView(const Eigen::Matrix4d& viewFromWorld, const Eigen::Matrix4d& projection,
                const Eigen::Matrix4d& worldFromPatient);

} // namespace petrous::rendering
