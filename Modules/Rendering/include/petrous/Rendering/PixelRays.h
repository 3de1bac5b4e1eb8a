#pragma once

#include <Eigen/Core>

#include "petrous/Core/CameraPose.h"

namespace petrous::rendering
{

/// Ray through a pixel's centre, patient LPS mm.
struct PixelRay
{
  Eigen::Vector3d origin;    ///< perspective: the camera; parallel: on the camera plane
  Eigen::Vector3d direction; ///< unit
  double edge = 0.0;         ///< of the pixel at the origin, mm
  double spread = 0.0;       ///< by which that grows per mm along the ray

  /// Edge of the pixel at a distance along the ray, both mm.
  double pixelAt(double distance) const { return edge + spread * distance; }
};

/// A camera's rays for a picture of width x height, top row first. The view angle is vertical and
/// the parallel scale is half the height; pixels are square.
class PixelRays
{
public:
  /// Throws InvalidParameter for a camera without direction, view-up or extent.
  PixelRays(const core::CameraPose& camera, int width, int height);
  PixelRay through(double column, double row) const; ///< (0, 0) is the centre of the first pixel

private:
  core::CameraPose m_camera;
  Eigen::Vector3d m_right;
  Eigen::Vector3d m_down;
  Eigen::Vector3d m_forward;
  double m_pixel; // pixel edge at distance 1 mm (perspective), or in mm (parallel)
  double m_centerColumn;
  double m_centerRow;
};

} // namespace petrous::rendering
