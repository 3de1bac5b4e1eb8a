#pragma once

#include <Eigen/Core>

#include "petrous/Core/CameraPose.h"

namespace petrous::rendering
{

/// The ray through a pixel's centre, patient LPS mm.
struct PixelRay
{
  Eigen::Vector3d origin;    ///< perspective: the camera; parallel: on the camera's plane
  Eigen::Vector3d direction; ///< unit
};

/// Rays of a camera for a picture of width x height, rows from the top. The angle is vertical and
/// the parallel scale half the height; pixels are square.
class PixelRays
{
public:
  /// Throws InvalidParameter for a camera without direction, up or extent.
  PixelRays(const core::CameraPose& camera, int width, int height);
  PixelRay through(double column, double row) const; ///< 0, 0 is the centre of the first pixel

private:
  core::CameraPose m_camera;
  Eigen::Vector3d m_right;
  Eigen::Vector3d m_down;
  Eigen::Vector3d m_forward;
  double m_pixel; // edge of a pixel at distance 1 mm (perspective), or in mm
  double m_centerColumn;
  double m_centerRow;
};

} // namespace petrous::rendering
