#include "petrous/Rendering/ScenePicture.h"

#include <gtest/gtest.h>

#include "LabelScenes.h"
#include "PictureComparison.h"
#include "petrous/Volume/SmoothedUnion.h"

using namespace petrous;
using namespace petrous::rendering;
using namespace petrous::rendering::synthetic;

TEST(StructurePicture, ShowsACutStructureInItsColorWhereTheWallCrossesIt)
{
  SceneContents contents = hollowBall(Eigen::Matrix3d::Identity());
  const core::GridGeometry grid = contents.ct->geometry();
  const auto labels = synthetic::labels(grid, [](const Eigen::Vector3d& p)
                                        { return p.head<2>().norm() < 3.0 && p.norm() < 8.0; });
  contents.structures.push_back(blueMarker(labels));
  EXPECT_EQ(countBlue(draw(contents, slanting())), 0); // inside solid bone

  contents.mask = synthetic::cut(grid, [](const Eigen::Vector3d& p) { return 1.0 - p.z(); });
  core::CameraPose pose = slanting();
  pose.position = {8.0, -15.0, 45.0};
  const auto solid = volume::makeSmoothedUnion(*labels, [](std::uint16_t) { return true; });
  SceneContents labelled = contents;
  labelled.labels = synthetic::oneStructure(solid);
  labelled.materials = {
      {}, {appearance::TransferFunction::constant(contents.structures[0].look.color, 1.0F)}};
  const Picture truth = truthOf(labelled, pose).picture;
  const Picture picture = draw(contents, pose);
  EXPECT_GT(countBlue(truth), 300);
  int different = 0;
  for (int row = 0; row < kHeight; ++row)
    for (int column = 0; column < kWidth; ++column)
      different += isBlue(picture.pixel(column, row)) != isBlue(truth.pixel(column, row));
  EXPECT_LE(different, countBlue(truth) / 10);
}

TEST(StructurePicture, KeepsARemnantThinnerThanAVoxel)
{
  SceneContents contents;
  const core::GridGeometry grid = synthetic::cube(40, 0.6);
  contents.ct = synthetic::ct<std::int16_t>(grid, [](const Eigen::Vector3d&) { return -5.0; });
  contents.structures.push_back(blueMarker(
      synthetic::labels(grid, [](const Eigen::Vector3d& p) { return std::abs(p.z()) < 4.0; })));
  // The structure's lower face lies half-way between samples at z = -4.2 mm or so.
  contents.mask = synthetic::cut(grid, [](const Eigen::Vector3d& p) { return -3.9 - p.z(); });
  core::CameraPose pose = slanting();
  pose.position = {0.0, -10.0, 60.0};
  const Picture picture = draw(contents, pose);
  for (int column = 70; column < 130; column += 3)
    EXPECT_TRUE(isBlue(picture.pixel(column, kHeight / 2))) << column;
}

TEST(StructurePicture, MakesAHiddenStructureOnlyWhenItIsShown)
{
  SceneContents contents = hollowBall(Eigen::Matrix3d::Identity());
  contents.structures.push_back(blueMarker(synthetic::labels(
      contents.ct->geometry(), [](const Eigen::Vector3d& p) { return p.norm() < 11.0; })));
  contents.structures[0].look.shown = false;
  ScenePicture scene;
  scene.setContents(contents);
  scene.setCamera(slanting());
  OffscreenView view(kWidth, kHeight);
  EXPECT_EQ(countBlue(view.render(scene)), 0);
  EXPECT_EQ(scene.resources().count("labels.marker"), 0U);
  contents.structures[0].look.shown = true;
  scene.setContents(contents);
  EXPECT_GT(countBlue(view.render(scene)), 1000);
  EXPECT_EQ(scene.resources().count("labels.marker"), 1U);
}

TEST(StructurePicture, DrawsATranslucentStructureThinner)
{
  SceneContents contents = hollowBall(Eigen::Matrix3d::Identity());
  contents.structures.push_back(blueMarker(synthetic::labels(
      contents.ct->geometry(), [](const Eigen::Vector3d& p) { return p.norm() < 11.0; })));
  const int opaque = countBlue(draw(contents, slanting()));
  contents.structures[0].look.opacity = 0.5F;
  const int half = countBlue(draw(contents, slanting()));
  EXPECT_NEAR(half, opaque / 2, opaque / 20);
}

TEST(StructurePicture, DrawsAMeshUnlessALabelVolumeOfItsNameReplacesIt)
{
  core::TriangleMesh tetrahedron;
  tetrahedron.vertices = {{11, -11, -11}, {-11, 11, -11}, {-11, -11, 11}, {11, 11, 11}};
  tetrahedron.triangles = {{0, 1, 3}, {0, 2, 1}, {0, 3, 2}, {1, 2, 3}};
  SceneContents contents;
  MeshContents mesh{"marker", std::make_shared<core::TriangleMesh>(tetrahedron), {}};
  mesh.look.color = {0.1F, 0.15F, 0.9F};
  contents.meshes.push_back(mesh);
  EXPECT_GT(countBlue(draw(contents, slanting())), 1000);

  contents.structures.push_back(blueMarker(synthetic::labels(
      synthetic::cube(24, 1.0), [](const Eigen::Vector3d& p) { return p.norm() < 2.0; })));
  ScenePicture scene;
  scene.setContents(contents);
  EXPECT_EQ(scene.resources().count("meshes.marker"), 0U);
  EXPECT_LT(countBlue(draw(contents, slanting())), 500);
}
