#include "SurfaceShadows.h"

#include <cmath>

#include <gtest/gtest.h>

#include "PictureScenes.h"
#include "petrous/Rendering/Stereo.h"

using namespace petrous;
using namespace petrous::rendering;
using namespace petrous::rendering::synthetic;

namespace
{

struct Seer
{
  TissueOptics optics;
  ClippedRegion drawn;
  SurfaceShadows shadows;

  explicit Seer(const SceneContents& contents)
    : optics(contents)
    , drawn(contents.ct->geometry(), contents.crop, contents.clipping)
    , shadows(optics, drawn, contents)
  {
  }
};

// The surface at a point of it that is known but for the interpolation.
Vector surfaceNear(const Seer& seer, const Vector& point, const Vector& normal)
{
  const Vector start = point + 0.3 * normal;
  return start - seer.optics.field().firstHit(start, point - 0.3 * normal).value_or(0.3) * normal;
}

// A far lamp.
optics::Lamp towards(const Vector& direction)
{
  optics::Lamp lamp;
  lamp.at = direction.normalized();
  lamp.isFar = true;
  return lamp;
}

// Bone below z = 0, with the part of a ball of radius `a` missing that reaches `depth` below it.
SceneContents pit(double a, double depth, double spacing = 0.25)
{
  return boneScene(ct<std::int16_t>(
      cube(static_cast<int>(24.0 / spacing), spacing, oblique()), [=](const Vector& p)
      { return std::min(-p.z(), (p - Vector(0.0, 0.0, a - depth)).norm() - a); }));
}

} // namespace

TEST(SurfaceShadows, OfAPlaneThereAreNone)
{
  const Vector normal = Vector(0.3, -0.8, 0.5).normalized();
  const Seer seer(boneScene(
      ct<std::int16_t>(cube(48, 0.5, oblique()), [&](const Vector& p) { return -p.dot(normal); })));
  const optics::Seen seen = seer.shadows.at({0.0, 0.0, 0.0}, normal, towards(normal));
  EXPECT_EQ(seen.sky, 1.0);
  EXPECT_EQ(seen.lamp, 1.0);
  EXPECT_NEAR(seer.shadows.at({0.0, 0.0, 0.0}, normal, towards(normal.unitOrthogonal())).lamp, 0.5,
              0.05); // half of the disc is below the horizon
}

// From the bottom, the rim is at cos^2 = depth / 2a off the axis, and what is seen at an angle t is
// 2a cos t away: 1 - s0 + 2 (a s0 / r)^2.
TEST(SurfaceShadows, AtTheBottomOfABallShapedPitTheSkyIsThatOfTheClosedForm)
{
  for (const double a : {2.0, 4.0})
    for (const double depth : {0.5 * a, a, 1.5 * a})
    {
      const Seer seer(pit(a, depth));
      const double rim = 0.5 * depth / a;
      const double reach = a * rim / optics::kOcclusionReach;
      const Vector up(0.0, 0.0, 1.0);
      EXPECT_NEAR(seer.shadows.at(surfaceNear(seer, -depth * up, up), up, towards(up)).sky,
                  1.0 - rim + 2.0 * reach * reach, 0.045) // the rim is rounded by voxels
          << a << " " << depth;
    }
}

// The form factor of any part of a sphere, from anywhere on it, is its share of the sphere's area.
TEST(SurfaceShadows, EveryPlaceOfASmallPitSeesTheSameSky)
{
  constexpr double kRadius = 2.0;
  const Seer seer(pit(kRadius, kRadius));
  for (const double angle : {0.3, 0.8, 1.2})
  {
    const Vector out(std::sin(angle) * 0.6, std::sin(angle) * 0.8, -std::cos(angle));
    const Vector place = surfaceNear(seer, kRadius * out, -out);
    const double sky = seer.shadows.at(place, -out, towards({0.0, 0.0, 1.0})).sky;
    EXPECT_GE(sky, 0.5 - 0.03) << angle;
    EXPECT_LE(sky, 0.5 + 2.0 * std::pow(kRadius / optics::kOcclusionReach, 2.0) + 0.03) << angle;
  }
}

TEST(SurfaceShadows, AnEdgeHidesHalfOfALampBehindIt)
{
  // A floor at z = -6 beside a wall up to z = 4.
  SceneContents contents = boneScene(
      ct<std::int16_t>(cube(120, 0.2), [](const Vector& p)
                       { return std::max(-6.0 - p.z(), std::min(-p.x(), 4.0 - p.z())); }));
  const Vector up(0.0, 0.0, 1.0);
  const auto lampAt = [&](double x, const SceneContents& scene) {
    return Seer(scene).shadows.at({x, 0.0, -6.0}, up, towards({-0.3, 0.0, 1.0})).lamp;
  };
  EXPECT_NEAR(lampAt(3.0, contents), 0.5, 0.06);          // 10 mm below the edge, at a slope of 0.3
  const double half = 10.0 * 1.09 * optics::kLampTangent; // of the penumbra
  EXPECT_EQ(lampAt(3.0 + 1.1 * half, contents), 1.0);
  EXPECT_EQ(lampAt(3.0 - 1.1 * half, contents), 0.0);
  contents.materials = {boneMaterial(0.3F)};
  EXPECT_NEAR(lampAt(1.0, contents), 0.7, 1e-6);
  contents.materials = {boneMaterial()};
  contents.clipping = {{{0.3, 0.0, 0.0}, {1.0, 0.0, 0.0}}};
  EXPECT_EQ(lampAt(3.0, contents), 1.0); // the wall is not drawn
}

TEST(SurfaceShadows, NothingBehindTheLampKeepsItsLight)
{
  // A canal of 3 mm radius along z, closed at its lower end: the camera is in it.
  const Seer seer(boneScene(
      ct<std::int16_t>(cube(80, 0.3), [](const Vector& p)
                       { return std::max(std::hypot(p.x(), p.y()) - 3.0, -8.0 - p.z()); })));
  core::CameraPose camera = from({0.0, 0.0, 0.0}, {0.0, 0.0, -3.0}, 80.0);
  camera.viewUp = {0.0, 1.0, 0.0};
  const optics::Lamp lamp = optics::lampOf(camera);
  EXPECT_LT((lamp.at - camera.position).norm(), 1e-12);
  const Vector up(0.0, 0.0, 1.0);
  EXPECT_GT(seer.shadows.at(surfaceNear(seer, {0.0, 0.0, -8.0}, up), up, lamp).lamp, 0.999);
  for (const double z : {-3.0, -6.0})
  {
    const Vector wall(3.0, 0.0, z);
    const Vector inward(-1.0, 0.0, 0.0);
    EXPECT_GT(seer.shadows.at(surfaceNear(seer, wall, inward), inward, lamp).lamp, 0.95) << z;
  }
  // The bottom sees a lamp that far in the wall only through bone.
  optics::Lamp behind = lamp;
  behind.at = {0.0, 6.0, 0.0};
  EXPECT_LT(seer.shadows.at(surfaceNear(seer, {0.0, 0.0, -8.0}, up), up, behind).lamp, 0.05);
}

TEST(SurfaceShadows, TheLampComesOffTheAxisAsTheCameraBecomesAMicroscope)
{
  const auto offset = [](double focus)
  {
    const core::CameraPose camera = from({0.0, -focus, 0.0}, {0.0, 0.0, 0.0});
    return (optics::lampOf(camera).at - camera.position).norm() / focus;
  };
  EXPECT_EQ(offset(3.0), 0.0);
  EXPECT_NEAR(offset(17.5), 0.5 * optics::kLampTilt, 1e-12);
  EXPECT_NEAR(offset(30.0), optics::kLampTilt, 1e-12);
  EXPECT_NEAR(offset(250.0), optics::kLampTilt, 1e-12);
}

TEST(SurfaceShadows, BothEyesHaveTheSameLamp)
{
  core::CameraPose camera = from({30.0, -200.0, 60.0}, {1.0, 2.0, 3.0}, 12.0);
  for (const bool parallel : {false, true})
  {
    if (parallel)
      camera.parallelScale = 20.0;
    const optics::Lamp own = optics::lampOf(camera);
    const EyePair eyes = eyesOf(camera, {40.0, 180.0});
    for (const core::CameraPose& eye : {eyes.left, eyes.right})
    {
      const optics::Lamp lamp = optics::lampOf(eye);
      EXPECT_TRUE(lamp.at.isApprox(own.at, 1e-12));
      EXPECT_EQ(lamp.isFar, parallel);
    }
    const Vector view = (camera.focalPoint - camera.position).normalized();
    const double angle = std::acos(-view.dot(own.from(camera.focalPoint)));
    EXPECT_NEAR(angle, 8.0 * 3.14159265358979 / 180.0, 1e-6);
    EXPECT_GT(own.from(camera.focalPoint).dot(camera.viewUp), 0.0);
  }
}

// By the integral over the polar angle a: d(a) is the distance to the ball.
TEST(SurfaceShadows, ABallOverAPlaneStopsThePartOfItsCap)
{
  const Vector normal = Vector(0.3, -0.8, 0.5).normalized();
  for (const auto& [radius, height] :
       {std::pair(2.0, 2.2), std::pair(2.0, 3.0), std::pair(4.0, 7.0)})
  {
    SceneContents contents = boneScene(ct<std::int16_t>(
        cube(64, 0.4, oblique()), [&](const Vector& p) { return -p.dot(normal); }));
    const Vector at = surfaceNear(Seer(contents), Vector::Zero(), normal);
    ToolPose tool;
    tool.center = at + (height + 1e-3) * normal;
    tool.axisToHand = normal; // behind the ball
    tool.radius = radius;
    contents.tool = tool;
    double stopped = 0.0;
    const double last = std::asin(radius / (height + 1e-3));
    constexpr int kSteps = 2000;
    for (int n = 0; n < kSteps; ++n)
    {
      const double a = last * (n + 0.5) / kSteps;
      const double away = height * std::sin(a);
      const double d =
          (height * std::cos(a) - std::sqrt(std::max(0.0, radius * radius - away * away))) /
          optics::kOcclusionReach;
      stopped += 2.0 * std::sin(a) * std::cos(a) * std::max(0.0, 1.0 - d * d) * last / kSteps;
    }
    EXPECT_NEAR(Seer(contents).shadows.at(at, normal, towards(normal.unitOrthogonal())).sky,
                1.0 - stopped, 0.015)
        << radius << " " << height;
  }
}

// As the ball of a burr, whose closed form is above.
TEST(SurfaceShadows, AClosedMeshStopsWhatTheBallDoesByItsOpacity)
{
  const Vector normal = Vector(0.3, -0.8, 0.5).normalized();
  SceneContents contents = boneScene(
      ct<std::int16_t>(cube(64, 0.4, oblique()), [&](const Vector& p) { return -p.dot(normal); }));
  const Vector at = surfaceNear(Seer(contents), Vector::Zero(), normal);
  const optics::Lamp lamp = towards(normal + 0.2 * normal.unitOrthogonal());
  SceneContents withBall = contents;
  withBall.tool = ToolPose();
  withBall.tool->center = at + 3.0 * normal;
  withBall.tool->axisToHand = normal;
  withBall.tool->radius = 2.0;
  const optics::Seen ball = Seer(withBall).shadows.at(at, normal, lamp);
  ASSERT_LT(ball.sky, 0.7);
  ASSERT_EQ(ball.lamp, 0.0);
  MeshContents mesh;
  mesh.mesh = ballMesh(withBall.tool->center, 2.0, 64);
  for (const float opacity : {1.0F, 0.4F})
  {
    mesh.look.opacity = opacity;
    contents.meshes = {mesh};
    const optics::Seen seen = Seer(contents).shadows.at(at, normal, lamp);
    EXPECT_NEAR(1.0 - seen.sky, static_cast<double>(opacity) * (1.0 - ball.sky), 0.01);
    EXPECT_NEAR(1.0 - seen.lamp, static_cast<double>(opacity), 1e-6);
  }
  mesh.look.shown = false;
  contents.meshes = {mesh};
  EXPECT_EQ(Seer(contents).shadows.at(at, normal, lamp).sky, 1.0);
  core::TriangleMesh open = *mesh.mesh;
  open.triangles.pop_back();
  mesh.mesh = std::make_shared<const core::TriangleMesh>(open);
  mesh.look.shown = true;
  contents.meshes = {mesh};
  EXPECT_EQ(Seer(contents).shadows.at(at, normal, lamp).sky, 1.0);
}

TEST(SurfaceShadows, WhatTheDrillTookOfAMeshStopsNothing)
{
  const Vector up(0.0, 0.0, 1.0);
  SceneContents contents =
      boneScene(ct<std::int16_t>(cube(64, 0.4), [](const Vector& p) { return -p.z(); }));
  MeshContents mesh;
  mesh.mesh = boxMesh({-6.0, -6.0, 3.0}, {6.0, 6.0, 8.0});
  mesh.drilled = true;
  contents.meshes = {mesh};
  contents.mask = cut(contents.ct->geometry(), [](const Vector& p)
                      { return std::max(std::hypot(p.x(), p.y()) - 3.0, 1.0 - p.z()); });
  const auto lampAt = [&](double x)
  {
    const Seer seer(contents);
    return seer.shadows.at(surfaceNear(seer, {x, 0.0, 0.0}, up), up, towards(up)).lamp;
  };
  EXPECT_EQ(lampAt(0.0), 1.0); // through the hole
  EXPECT_EQ(lampAt(4.5), 0.0);
  contents.meshes[0].drilled = false;
  EXPECT_EQ(lampAt(0.0), 0.0);
}

TEST(SurfaceShadows, AMeshInTissueAndTheToolSeePastWhatTheyAreIn)
{
  const Vector up(0.0, 0.0, 1.0);
  SceneContents contents = boneScene(
      ct<std::int16_t>(cube(48, 0.5), [](const Vector& p) { return 4.0 - p.norm(); }), 0.3F);
  ToolPose tool;
  tool.center = Vector::Zero();
  tool.radius = 1.0;
  tool.axisToHand = -up;
  using Of = SurfaceShadows::Of;
  const Seer inBone(contents);
  const optics::Seen seen = inBone.shadows.at(Vector::Zero(), up, towards(up), Of::Mesh);
  EXPECT_EQ(seen.sky, 1.0);
  EXPECT_EQ(seen.lamp, 1.0);
  contents.tool = tool;
  const Seer withTool(contents);
  EXPECT_EQ(withTool.shadows.at({0.0, 0.0, 1.0}, up, towards(up), Of::Tool).sky, 1.0);
  EXPECT_EQ(withTool.shadows.at({0.0, 0.0, -2.0}, up, towards(up), Of::Mesh).lamp, 0.0);
}

TEST(SurfaceShadows, ABallHidesALampBehindIt)
{
  const Vector normal(0.0, 0.0, 1.0);
  SceneContents contents =
      boneScene(ct<std::int16_t>(cube(48, 0.5), [&](const Vector& p) { return -p.dot(normal); }));
  const Vector at = surfaceNear(Seer(contents), Vector::Zero(), normal);
  ToolPose tool;
  tool.center = at + Vector(0.0, 6.0, 6.0);
  tool.axisToHand = Vector(1.0, 0.0, 0.0);
  tool.radius = 2.0;
  contents.tool = tool;
  const Seer seer(contents);
  EXPECT_EQ(seer.shadows.at(at, normal, towards({0.0, 1.0, 1.0})).lamp, 0.0);
  EXPECT_EQ(seer.shadows.at(at, normal, towards({0.0, -1.0, 1.0})).lamp, 1.0);
  // Its rim halves the disc.
  const double rim = std::asin(2.0 / std::sqrt(72.0));
  const Vector beside(0.0, std::sin(0.25 * 3.14159265358979 - rim),
                      std::cos(0.25 * 3.14159265358979 - rim));
  EXPECT_NEAR(seer.shadows.at(at, normal, towards(beside)).lamp, 0.5, 0.1);
}
