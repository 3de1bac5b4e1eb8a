#pragma once

#include <cstdint>
#include <utility>

#include "LabelScenes.h"
#include "petrous/Appearance/Material.h"

/// Scenes for renderer tests, each with one feature to be drawn as by the reference.
namespace petrous::rendering::synthetic
{

using Vector = Eigen::Vector3d;

inline core::CameraPose from(const Vector& eye, const Vector& at, double angle = 30.0)
{
  core::CameraPose pose;
  pose.position = eye;
  pose.focalPoint = at;
  pose.viewAngle = angle;
  return pose;
}

/// Bone whose colour and density depend on the intensity.
inline appearance::TransferFunction boneTransfer()
{
  return appearance::TransferFunction({{kIso, {0.80F, 0.60F, 0.42F}, 0.02F, 0.4F},
                                       {kIso + 500.0, {0.90F, 0.75F, 0.60F}, 0.15F, 0.7F},
                                       {kIso + 1500.0, {0.97F, 0.95F, 0.88F}, 0.5F, 1.0F}});
}

inline appearance::Material boneMaterial(float surfaceOpacity = 1.0F)
{
  return {boneTransfer(), appearance::IntensitySource::Ct, surfaceOpacity};
}

inline appearance::Material blue(float surfaceOpacity = 1.0F)
{
  return {appearance::TransferFunction::constant({0.1F, 0.15F, 0.9F}, 0.4F),
          appearance::IntensitySource::Ct, surfaceOpacity};
}

inline appearance::Material red(float surfaceOpacity = 1.0F)
{
  return {appearance::TransferFunction::constant({0.85F, 0.1F, 0.1F}, 0.6F, 0.3F),
          appearance::IntensitySource::Ct, surfaceOpacity, 40.0F};
}

/// Signed distance into a ball with a bite taken out, which makes its orientation visible.
inline double bittenBall(const Vector& p)
{
  return std::min(9.0 - p.norm(), (p - Vector(4.0, -6.0, 3.0)).norm() - 4.0);
}

inline SceneContents boneScene(std::shared_ptr<const volume::IntensityVolume> ct,
                               float surfaceOpacity = 1.0F)
{
  SceneContents contents;
  contents.ct = std::move(ct);
  contents.iso = kIso;
  contents.materials = {boneMaterial(surfaceOpacity)};
  return contents;
}

/// The ball with the bite, 24 mm wide.
template <class T = std::int16_t>
SceneContents hollowBall(const Eigen::Matrix3d& direction = Eigen::Matrix3d::Identity(),
                         double spacing = 0.5)
{
  return boneScene(ct<T>(cube(static_cast<int>(24.0 / spacing), spacing, direction), bittenBall));
}

/// The same, translucent.
inline SceneContents translucentBall(const Eigen::Matrix3d& direction = oblique())
{
  SceneContents contents = hollowBall(direction);
  contents.materials = {boneMaterial(0.35F)};
  return contents;
}

/// A blue rod through the ball's centre, and a red ball behind the bite; index 1 and 2.
inline std::shared_ptr<const volume::LabelField> rodAndBall(const core::GridGeometry& grid)
{
  const auto rod = [](const Vector& p)
  { return std::min(2.0 - Vector(p.x(), p.y() + 1.0, 0.0).norm(), 6.5 - std::abs(p.z())); };
  const auto ball = [](const Vector& p) { return 2.6 - (p - Vector(4.0, -1.5, 2.0)).norm(); };
  return labelField(
      grid, [=](const Vector& p) { return std::max(rod(p), ball(p)); },
      [=](const Vector& p) { return ball(p) > rod(p) ? 2 : 1; });
}

inline SceneContents labelledBall(const core::GridGeometry& grid, float surfaceOpacity = 0.35F)
{
  SceneContents contents = translucentBall();
  contents.labels = rodAndBall(grid);
  contents.materials = {boneMaterial(surfaceOpacity), blue(), red(0.5F)};
  return contents;
}

/// Removes everything in front of an oblique plane, and a ball as by a burr.
inline double cavity(const Vector& p)
{
  return std::min((p - Vector(2.0, -7.0, 3.0)).norm() - 4.5,
                  (p - Vector(-3.0, -6.5, 1.0)).norm() - 3.2);
}

inline SceneContents cutBall(float surfaceOpacity = 1.0F)
{
  SceneContents contents = hollowBall(oblique());
  contents.materials = {boneMaterial(surfaceOpacity)};
  contents.mask = cut(contents.ct->geometry(), cavity);
  return contents;
}

/// Smooth waves in a coordinate frame moved relative to the CT's.
inline SecondImage movedWaves()
{
  SecondImage second;
  second.secondFromCt = core::RigidTransform(
      Eigen::Quaterniond(Eigen::AngleAxisd(0.7, Vector(1.0, -1.0, 2.0).normalized())),
      Vector(5.0, -3.0, 8.0));
  second.volume = image(
      cube(36, 0.9, Eigen::Matrix3d::Identity(), Vector(5.0, -3.0, 8.0)), [](const Vector& p)
      { return 500.0 + 300.0 * std::sin(0.6 * p.x()) * std::cos(0.5 * p.y()) + 20.0 * p.z(); });
  return second;
}

/// Other waves, in a frame of their own.
inline SecondImage movedRipples()
{
  SecondImage third;
  third.secondFromCt = core::RigidTransform(
      Eigen::Quaterniond(Eigen::AngleAxisd(-0.4, Vector(2.0, 1.0, -1.0).normalized())),
      Vector(-4.0, 6.0, 2.0));
  third.volume = image(
      cube(40, 0.8, Eigen::Matrix3d::Identity(), Vector(-4.0, 6.0, 2.0)), [](const Vector& p)
      { return 500.0 + 350.0 * std::cos(0.7 * p.z()) * std::sin(0.4 * p.y()) - 15.0 * p.x(); });
  return third;
}

inline appearance::Material waveMaterial(float surfaceOpacity)
{
  return {appearance::TransferFunction({{100.0, {0.1F, 0.1F, 0.9F}, 0.05F, 0.2F},
                                        {500.0, {0.2F, 0.9F, 0.3F}, 0.3F, 0.8F},
                                        {900.0, {0.9F, 0.9F, 0.2F}, 0.7F, 1.0F}}),
          appearance::IntensitySource::Second, surfaceOpacity};
}

/// All features combined.
inline SceneContents fullScene()
{
  SceneContents contents = labelledBall(cube(64, 0.35, obliqueMirrored()));
  contents.mask = cut(contents.ct->geometry(), cavity);
  contents.second = movedWaves();
  contents.materials[1] = waveMaterial(0.6F);
  return contents;
}

/// The same with a third image, for the red ball.
inline SceneContents fullSceneOfThree()
{
  SceneContents contents = fullScene();
  contents.third = movedRipples();
  contents.materials[2] = waveMaterial(0.4F);
  contents.materials[2].source = appearance::IntensitySource::Third;
  return contents;
}

} // namespace petrous::rendering::synthetic
