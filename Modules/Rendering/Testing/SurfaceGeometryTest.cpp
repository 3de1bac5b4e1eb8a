#include "SurfaceGeometry.h"

#include <gtest/gtest.h>

#include "ReferenceScenes.h"

using namespace petrous;
using namespace petrous::rendering;
using namespace petrous::rendering::synthetic;

namespace
{

// A square of 20 mm perpendicular to x, at x = `at`.
MeshContents wall(double at, const std::array<float, 3>& color)
{
  auto mesh = std::make_shared<core::TriangleMesh>();
  const auto x = static_cast<float>(at);
  mesh->vertices = {{x, -10, -10}, {x, 10, -10}, {x, 10, 10}, {x, -10, 10}};
  mesh->triangles = {{0, 1, 2}, {0, 2, 3}};
  MeshContents contents{"wall", mesh, {}};
  contents.look.color = color;
  return contents;
}

SceneContents dull()
{
  SceneContents contents;
  contents.light.specular = 0.0;
  return contents;
}

const core::CameraPose kAlongX = along({1.0, 0.0, 0.0}, 40.0);

} // namespace

TEST(SurfaceGeometry, HideWhatLiesBehindThem)
{
  SceneContents contents = dull();
  contents.ct = image(cube(33, 0.5), [](const Eigen::Vector3d&) { return 1000.0; });
  contents.meshes = {wall(-9.0, {0.0F, 0.0F, 0.75F})};
  const ReferencePicture picture = see(contents, kAlongX);
  EXPECT_LT((rgbOf(picture, 20, 20) - Eigen::Vector3d(0.0, 0.0, 0.75)).norm(), 1e-6);
  EXPECT_TRUE(std::isnan(picture.depth.at(20, 20)));
}

TEST(SurfaceGeometry, AreSeenThroughTheTissueBeforeThem)
{
  SceneContents contents = dull();
  contents.ct = image(cube(33, 0.5), [](const Eigen::Vector3d&) { return 1000.0; });
  contents.materials = {fog({0.0F, 1.0F, 0.0F}, 0.1F)};
  contents.meshes = {wall(-3.0, {0.0F, 0.0F, 0.75F})};
  const ReferencePicture picture = see(contents, kAlongX);
  const double left = std::pow(0.9, 5.0); // from -8 to -3 mm
  EXPECT_LT(
      (rgbOf(picture, 20, 20) - Eigen::Vector3d(0.0, (1.0 - left) * kInside, 0.75 * left)).norm(),
      1e-6);
  EXPECT_NEAR(static_cast<double>(picture.depth.at(20, 20)), 32.0, 1e-5);
}

TEST(SurfaceGeometry, CoverTheShareOfAScreenDoor)
{
  SceneContents contents = dull();
  contents.meshes = {wall(2.0, {0.0F, 0.5F, 0.0F}), wall(-3.0, {0.0F, 0.0F, 0.75F})};
  contents.meshes[1].look.opacity = 0.25F;
  const ReferencePicture picture = see(contents, kAlongX);
  EXPECT_LT((rgbOf(picture, 20, 20) - Eigen::Vector3d(0.0, 0.375, 0.1875)).norm(), 1e-6);
  contents.meshes[0].look.shown = false;
  EXPECT_LT((rgbOf(see(contents, kAlongX), 20, 20) -
             (0.75 * background() + Eigen::Vector3d(0.0, 0.0, 0.1875)))
                .norm(),
            1e-6);
}

TEST(SurfaceGeometry, LightAMeshByItsNormal)
{
  SceneContents contents = dull();
  contents.meshes = {wall(0.0, {0.5F, 0.5F, 0.5F})};
  const core::CameraPose pose = along({1.0, 1.0, 0.0}, 40.0);
  EXPECT_NEAR(rgbOf(see(contents, pose), kWidth / 2, kHeight / 2)[0], 0.5 * lambert(std::sqrt(0.5)),
              1e-6);
}

TEST(SurfaceGeometry, ShowAnInstrumentInPlaceOfTheDrillAsItIsHeld)
{
  SceneContents contents = dull();
  ToolPose tool;
  tool.center = {3.0, 0.0, 0.0};
  tool.instrument = boxMesh({-1.0, -2.0, 0.0}, {1.0, 2.0, 30.0});
  contents.tool = tool;
  const auto distance = [&contents](double y, double z)
  {
    const auto hits = SurfaceGeometry(contents).along({{-200.0, y, z}, {1.0, 0.0, 0.0}});
    return hits.empty() ? 0.0 : hits.front().distance;
  };
  EXPECT_NEAR(distance(0.3, 20.0), 200.0 + 3.0 - 1.0, 1e-6);
  EXPECT_EQ(distance(2.1, 20.0), 0.0);
  EXPECT_EQ(distance(0.3, -0.1), 0.0) << "no ball";
  EXPECT_EQ(distance(0.3, 30.1), 0.0) << "no handpiece";
  contents.tool->rotation = Eigen::AngleAxisd(std::acos(-1.0) / 2.0, Eigen::Vector3d::UnitZ());
  EXPECT_NEAR(distance(0.3, 20.0), 200.0 + 3.0 - 2.0, 1e-6) << "turned about its shaft";
  EXPECT_EQ(distance(1.1, 20.0), 0.0);
  contents.tool->rotation = Eigen::AngleAxisd(std::acos(-1.0) / 2.0, Eigen::Vector3d::UnitX());
  EXPECT_NEAR(distance(-20.0, 0.3), 200.0 + 3.0 - 1.0, 1e-6) << "its shaft along -y";
}

TEST(SurfaceGeometry, ShowTheToolWhereItIs)
{
  SceneContents contents = dull();
  ToolPose tool;
  tool.radius = 2.5;
  tool.axisToHand = {0.0, 0.0, 3.0};
  contents.tool = tool;
  const SurfaceGeometry shapes(contents);
  const auto distance = [&](double y, double z)
  {
    const auto hits = shapes.along({{-200.0, y, z}, {1.0, 0.0, 0.0}});
    return hits.empty() ? 0.0 : hits.front().distance;
  };
  EXPECT_NEAR(distance(1.5, 0.0), 200.0 - 2.0, 1e-9);    // burr: 1.5, 2, 2.5
  EXPECT_NEAR(distance(0.72, 10.0), 200.0 - 0.96, 1e-9); // shaft of radius 1.2 mm
  EXPECT_NEAR(distance(3.6, 60.0), 200.0 - 4.8, 1e-9);   // handpiece of radius 6 mm
  EXPECT_EQ(distance(1.5, 10.0), 0.0);
  EXPECT_EQ(distance(0.0, 91.0), 0.0); // beyond its end
  const auto end = shapes.along({{1.0, 0.0, 200.0}, {0.0, 0.0, -1.0}});
  ASSERT_EQ(end.size(), 1U);
  EXPECT_NEAR(end[0].distance, 110.0, 1e-9);
}
