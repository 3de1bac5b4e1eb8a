#include "petrous/Rendering/PixelRays.h"

#include <cmath>

#include <Eigen/Geometry>

#include "petrous/Core/Error.h"

namespace petrous::rendering
{

namespace
{
constexpr double kDegree = 3.14159265358979323846 / 180.0;
} // namespace

PixelRays::PixelRays(const core::CameraPose& camera, int width, int height)
  : m_camera(camera)
{
  const Eigen::Vector3d towards = camera.focalPoint - camera.position;
  m_forward = towards.normalized();
  const Eigen::Vector3d across = m_forward.cross(camera.viewUp);
  if (!camera.position.allFinite() || !(towards.norm() > 0.0) ||
      !(across.norm() > 1e-9 * camera.viewUp.norm()))
    throw core::InvalidParameter(
        "camera: position and focal point must differ, and view up must not point along the view");
  m_right = across.normalized();
  m_down = m_forward.cross(m_right);
  const double halfHeight =
      camera.parallelScale ? *camera.parallelScale : std::tan(0.5 * camera.viewAngle * kDegree);
  const bool valid = camera.parallelScale ? *camera.parallelScale > 0.0
                                          : camera.viewAngle > 0.0 && camera.viewAngle < 180.0;
  if (!valid || !std::isfinite(halfHeight) || !std::isfinite(camera.lensShift))
    throw core::InvalidParameter("camera: the angle must lie between 0 and 180 degrees, the "
                                 "parallel scale above 0 mm, and the lens shift be finite");
  m_pixel = 2.0 * halfHeight / height;
  m_centerColumn = 0.5 * (width - 1.0) - camera.lensShift * 0.5 * height;
  m_centerRow = 0.5 * (height - 1.0);
}

PixelRay PixelRays::through(double column, double row) const
{
  const Eigen::Vector3d aside =
      m_pixel * ((column - m_centerColumn) * m_right + (row - m_centerRow) * m_down);
  if (m_camera.parallelScale)
    return {m_camera.position + aside, m_forward, m_pixel, 0.0};
  return {m_camera.position, (m_forward + aside).normalized(), 0.0, m_pixel};
}

} // namespace petrous::rendering
