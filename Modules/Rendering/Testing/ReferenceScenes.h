#pragma once

#include <array>

#include "LabelScenes.h"
#include "OpticalModel.h"
#include "petrous/Rendering/ReferenceRayCaster.h"

/// Scenes for the reference picture whose radiance is known in closed form.
namespace petrous::rendering::synthetic
{

constexpr int kWidth = 48;
constexpr int kHeight = 36;
constexpr double kSpacing = 0.5; // mm
constexpr double kRadius = 11.3; // mm
const Eigen::Vector3d kBump(7.0, -7.0, 4.0);

inline core::CameraPose sideCamera()
{
  core::CameraPose pose;
  pose.position = {50.0, -60.0, 25.0};
  pose.focalPoint = {1.0, 0.5, -0.5};
  pose.viewAngle = 24.0;
  return pose;
}

/// Parallel rays along `direction`, starting `distance` mm in front of the origin.
inline core::CameraPose along(const Eigen::Vector3d& direction, double distance)
{
  core::CameraPose pose;
  pose.position = -distance * direction.normalized();
  pose.focalPoint = {0.0, 0.0, 0.0};
  pose.viewUp = direction.normalized().unitOrthogonal();
  pose.parallelScale = 6.0;
  return pose;
}

inline SceneContents ballScene(const Eigen::Matrix3d& direction)
{
  SceneContents contents;
  contents.ct = ball(cube(64, kSpacing, direction), kRadius);
  contents.iso = kIso;
  return contents;
}

/// A single opaque colour without highlight.
inline appearance::Material flat(const std::array<float, 3>& color)
{
  return {appearance::TransferFunction::constant(color, 1.0F, 0.0F)};
}

/// No surface; opacity `opacity` per mm inside.
inline appearance::Material fog(const std::array<float, 3>& color, float opacity)
{
  return {appearance::TransferFunction::constant(color, opacity, 0.0F),
          appearance::IntensitySource::Ct, 0.0F};
}

/// Ambient and diffuse terms of the default light, 16 % of which is ambient.
inline double lambert(double cosine)
{
  return 0.16 + 0.84 * std::abs(cosine);
}

/// Light inside tissue: the mean cosine is 2/3.
constexpr double kInside = 0.16 + 0.84 * 2.0 / 3.0;

inline Eigen::Vector3d background()
{
  return {0.105, 0.115, 0.130};
}

inline ReferencePicture see(const SceneContents& contents, const core::CameraPose& pose)
{
  return ReferenceRayCaster(contents).render(pose, kWidth, kHeight);
}

inline Eigen::Vector3d rgbOf(const ReferencePicture& picture, int column, int row)
{
  const float* rgb = picture.rgb.data() + 3 * (row * picture.picture.width + column);
  return {rgb[0], rgb[1], rgb[2]};
}

/// visit(column, row, ray) for every pixel.
template <class Visit>
void forEachRay(const core::CameraPose& pose, const Visit& visit)
{
  const PixelRays rays(pose, kWidth, kHeight);
  for (int row = 0; row < kHeight; ++row)
    for (int column = 0; column < kWidth; ++column)
      visit(column, row, rays.through(column, row));
}

} // namespace petrous::rendering::synthetic
