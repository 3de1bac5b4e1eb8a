#include "BoneColor.h"

#include <algorithm>
#include <cmath>

namespace petrous::rendering
{

Eigen::Vector3d BoneColor::at(double value) const
{
  const double t = std::clamp((value - cellularValue) / (corticalValue - cellularValue), 0.0, 1.0);
  return cellular + t * (cortical - cellular);
}

Eigen::Vector3d headlight(const Eigen::Vector3d& color, double cosine, double ambient,
                          double specular, double shininess, double intensity)
{
  const double facing = std::clamp(std::abs(cosine), 0.0, 1.0);
  const double diffuse = ambient + (1.0 - ambient) * facing;
  const double highlight = specular * std::pow(facing, shininess);
  return (intensity * (color * diffuse + Eigen::Vector3d::Constant(highlight)))
      .cwiseMax(0.0)
      .cwiseMin(1.0);
}

} // namespace petrous::rendering
