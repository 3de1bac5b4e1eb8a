#include "OpticalModel.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Geometry>

namespace petrous::rendering::optics
{

double lightAt(const LightSettings& light, double distance)
{
  if (!(light.falloff > 0.0))
    return light.intensity;
  const double ratio = distance / light.falloff;
  return light.intensity / (1.0 + ratio * ratio);
}

Eigen::Vector3d surfaceColor(const appearance::TransferFunction::Optics& optics, double shininess,
                             double cosine, const LightSettings& light, double distance,
                             const Seen& seen)
{
  const double facing = std::clamp(std::abs(cosine), 0.0, 1.0);
  const double diffuse = light.ambient * seen.sky + (1.0 - light.ambient) * facing * seen.lamp;
  const double highlight = optics.specular * light.specular * std::pow(facing, shininess) +
                           light.wetness * std::pow(facing, kWetShininess);
  const Eigen::Vector3d color(optics.color[0], optics.color[1], optics.color[2]);
  return (lightAt(light, distance) *
          (color * diffuse + Eigen::Vector3d::Constant(seen.lamp * highlight)))
      .cwiseMax(0.0)
      .cwiseMin(1.0);
}

Eigen::Vector3d Lamp::from(const Eigen::Vector3d& point) const
{
  return isFar ? at : (at - point).normalized();
}

Lamp lampOf(const core::CameraPose& camera)
{
  const core::CameraPose::Head head =
      camera.head.value_or(core::CameraPose::Head{camera.position, camera.focalPoint});
  const Eigen::Vector3d view = head.focalPoint - head.position;
  const Eigen::Vector3d forward = view.normalized();
  Lamp lamp;
  lamp.right = forward.cross(camera.viewUp).normalized();
  lamp.up = lamp.right.cross(forward);
  lamp.isFar = camera.parallelScale.has_value();
  lamp.at = lamp.isFar ? (kLampTilt * lamp.up - forward).normalized().eval()
                       : (head.position + kLampTilt * view.norm() * lamp.up).eval();
  return lamp;
}

Eigen::Vector3d interiorColor(const Eigen::Vector3d& color, const LightSettings& light,
                              double distance, double facing)
{
  const double diffuse = light.ambient + (1.0 - light.ambient) * facing;
  return (lightAt(light, distance) * diffuse * color).cwiseMax(0.0).cwiseMin(1.0);
}

double softEdge(const appearance::TransferFunction& transfer)
{
  constexpr double kThickness = 20.0; // mm
  return (transfer.points().back().value - transfer.points().front().value) / kThickness;
}

double softFacing(const Eigen::Vector3d& gradient, const Eigen::Vector3d& ray, double edge)
{
  const double size = gradient.norm();
  if (!(size > 0.0 && edge > 0.0))
    return kInteriorFacing;
  const double facing = std::min(std::abs(gradient.dot(ray)) / size, 1.0);
  return kInteriorFacing + size / (size + edge) * (facing - kInteriorFacing);
}

} // namespace petrous::rendering::optics
