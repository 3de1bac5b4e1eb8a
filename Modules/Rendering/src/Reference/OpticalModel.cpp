#include "OpticalModel.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include <Eigen/Geometry>

#include "petrous/Rendering/PixelSamples.h"

namespace petrous::rendering::optics
{

double exposureFactor(double exposure)
{
  constexpr double kDisplayGamma = 2.2;
  return std::exp2(exposure / kDisplayGamma);
}

double lightAt(const LightSettings& light, double distance, double focus)
{
  const double intensity = light.intensity * exposureFactor(light.exposure);
  if (!(light.falloff > 0.0))
    return intensity;
  const double ratio = distance / light.falloff;
  const double atFocus = focus / light.falloff;
  return intensity * (1.0 + atFocus * atFocus) / (1.0 + ratio * ratio);
}

Eigen::Vector3d toneCurve(const Eigen::Vector3d& color)
{
  const Eigen::Vector3d lit = color.cwiseMax(0.0);
  const double peak = lit.maxCoeff();
  if (peak <= kToneStart)
    return lit;
  constexpr double kRange = 1.0 - kToneStart;
  const double next = 1.0 - kRange * kRange / (peak - kToneStart + kRange);
  const double weight = 1.0 / (kToneDesaturation * (peak - next) + 1.0);
  return weight * (next / peak) * lit + Eigen::Vector3d::Constant((1.0 - weight) * next);
}

Eigen::Vector3d displayed(const Eigen::Vector3d& color, const LightSettings& light)
{
  return light.toneCurve ? toneCurve(color) : color.cwiseMax(0.0).cwiseMin(1.0).eval();
}

Eigen::Vector3d displayed(const Eigen::Vector3d& color, double share, const LightSettings& light)
{
  return share > 0.0 ? (share * displayed(color / share, light)).eval()
                     : Eigen::Vector3d::Zero().eval();
}

double edgeOpacity(double opacity, double cosine, double edges)
{
  if (!(edges > 0.0) || opacity >= 1.0)
    return opacity;
  const double path = 1.0 + edges * (1.0 / std::clamp(std::abs(cosine), kLeastFacing, 1.0) - 1.0);
  return 1.0 - std::pow(1.0 - opacity, path);
}

double edgeFacing(double cosine, double slope)
{
  const double square = slope * slope;
  const double weight = square / (square + kEdgeSlope * kEdgeSlope);
  return 1.0 + weight * (std::min(std::abs(cosine), 1.0) - 1.0);
}

double grainNoise(const Eigen::Vector3d& at)
{
  const Eigen::Vector3d lower = at.array().floor();
  const Eigen::Array3d within = at - lower;
  const Eigen::Array3d share = within.square() * (3.0 - 2.0 * within);
  double noise = 0.0;
  for (std::uint32_t corner = 0; corner < 8; ++corner)
  {
    constexpr std::uint32_t kPrimes[] = {73856093, 19349663, 83492791};
    std::uint32_t hash = 0;
    double weight = 1.0;
    for (int axis = 0; axis < 3; ++axis)
    {
      const std::uint32_t up = corner >> axis & 1U;
      hash ^=
          (static_cast<std::uint32_t>(static_cast<std::int64_t>(lower[axis])) + up) * kPrimes[axis];
      weight *= up != 0 ? share[axis] : 1.0 - share[axis];
    }
    hash = (hash ^ hash >> 16) * 0x85ebca6bU;
    hash = (hash ^ hash >> 13) * 0xc2b2ae35U;
    hash ^= hash >> 16;
    noise += weight * (2.0 * (hash >> 8) / 16777216.0 - 1.0);
  }
  return noise;
}

Eigen::Matrix3d grainFromVoxel(const core::GridGeometry& grid, int octave)
{
  const Eigen::Quaterniond turns[] = {{9.0, 4.0, 2.0, 5.0}, {7.0, -3.0, 6.0, 1.0}};
  return turns[octave].normalized().toRotationMatrix() *
         (grid.spacing() / kGrainCells[octave]).asDiagonal();
}

double grainFactor(const core::GridGeometry& grid, const Eigen::Vector3d& voxel, double cosine,
                   double pixel, double grain)
{
  const double covered = pixel / std::clamp(std::abs(cosine), kLeastFacing, 1.0);
  double noise = 0.0;
  for (int octave = 0; octave < 2; ++octave)
  {
    const double cells = covered / kGrainCells[octave];
    const double part = std::clamp((cells - kFineGrain) / (kCoarseGrain - kFineGrain), 0.0, 1.0);
    const double left = 1.0 - part * part * (3.0 - 2.0 * part);
    if (left > 0.0)
      noise += kGrainShares[octave] * left * grainNoise(grainFromVoxel(grid, octave) * voxel);
  }
  return 1.0 + grain * kGrainContrast * noise;
}

Eigen::Vector3d asideOf(const core::GridGeometry& grid, int sample)
{
  if (sample < 0)
    return Eigen::Vector3d::Zero();
  const double share = (grid.minSpacing() - kFineSpacing) / (kCoarseSpacing - kFineSpacing);
  const auto [x, y, z] = sampleCorner(sample);
  return kAside * std::clamp(share, 0.0, 1.0) * Eigen::Vector3d(x, y, z);
}

double asideFacing(const Eigen::Vector3d& here, const Eigen::Vector3d& aside,
                   const Eigen::Vector3d& ray)
{
  constexpr double kNothing = 1e-12;
  if (here.norm() <= kNothing)
    return 1.0;
  const auto facing = [&](const Eigen::Vector3d& gradient)
  { return std::min(std::abs(gradient.dot(ray)) / std::max(gradient.norm(), kNothing), 1.0); };
  const double alike = here.dot(aside) / (here.norm() * std::max(aside.norm(), kNothing));
  const double part = std::clamp((alike - kUnlike) / (kAlike - kUnlike), 0.0, 1.0);
  const double share = std::min(aside.norm() / (kAsideSlope * here.norm()), kMostAside);
  const double weight = part * part * (3.0 - 2.0 * part) * share;
  return std::clamp(facing(here) + weight * (facing(aside) - facing(here)), 0.0, 1.0);
}

double sectionGrey(const SectionWindow& window, double value)
{
  return std::clamp((value - window.level) / window.width + 0.5, 0.0, 1.0);
}

Eigen::Vector3d surfaceColor(const appearance::TransferFunction::Optics& optics, double shininess,
                             double cosine, const LightSettings& light, double distance,
                             const Seen& seen, double focus, bool isScale)
{
  const double facing = std::clamp(std::abs(cosine), 0.0, 1.0);
  const double gloss = optics.specular * light.specular;
  const double taken = isScale ? 0.0 : gloss * facing * facing;
  const double diffuse =
      light.ambient * seen.sky + std::max(1.0 - light.ambient - taken, 0.0) * facing * seen.lamp;
  const double highlight = (1.0 - light.wetness) * gloss * std::pow(facing, shininess) +
                           light.wetness * std::pow(facing, kWetShininess);
  const Eigen::Vector3d color(optics.color[0], optics.color[1], optics.color[2]);
  const double reaching = lightAt(light, distance, focus);
  const Eigen::Vector3d lit = (isScale ? std::min(reaching, light.intensity) : reaching) *
                              (color * diffuse + Eigen::Vector3d::Constant(seen.lamp * highlight));
  return isScale ? lit.cwiseMax(0.0).cwiseMin(1.0).eval() : lit;
}

Eigen::Vector3d Lamp::from(const Eigen::Vector3d& point) const
{
  return isFar ? at : (at - point).normalized();
}

double Lamp::reach(const Eigen::Vector3d& point) const
{
  return isFar ? kShadowReach : std::min((at - point).norm(), kShadowReach);
}

Lamp lampOf(const core::CameraPose& camera)
{
  const core::CameraPose::Head head =
      camera.head.value_or(core::CameraPose::Head{camera.position, camera.focalPoint});
  const Eigen::Vector3d view = head.focalPoint - head.position;
  const Eigen::Vector3d forward = view.normalized();
  Lamp lamp;
  lamp.focus = view.norm();
  lamp.right = forward.cross(camera.viewUp).normalized();
  lamp.up = lamp.right.cross(forward);
  lamp.isFar = camera.parallelScale.has_value();
  const double tilt =
      kLampTilt *
      std::clamp((lamp.focus - kEndoscopeFocus) / (kMicroscopeFocus - kEndoscopeFocus), 0.0, 1.0);
  lamp.at = lamp.isFar ? (kLampTilt * lamp.up - forward).normalized().eval()
                       : (head.position + tilt * lamp.focus * lamp.up).eval();
  return lamp;
}

Eigen::Vector3d interiorColor(const Eigen::Vector3d& color, const LightSettings& light,
                              double distance, double focus, double facing)
{
  const double diffuse = light.ambient + (1.0 - light.ambient) * facing;
  return lightAt(light, distance, focus) * diffuse * color;
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
