#include "petrous/Rendering/ScenePicture.h"

#include <gtest/gtest.h>

#include "PictureComparison.h"
#include "petrous/Rendering/RenderingError.h"
#include "petrous/Rendering/StandardViews.h"

using namespace petrous;
using namespace petrous::rendering;
using namespace petrous::rendering::synthetic;

TEST(ScenePicture, AgreesWithTheReference)
{
  expectAgreement(hollowBall(Eigen::Matrix3d::Identity()), slanting());
}

TEST(ScenePicture, AgreesWithTheReferenceInObliqueAndMirroredGrids)
{
  expectAgreement(hollowBall(synthetic::oblique()), slanting());
  expectAgreement(hollowBall(synthetic::obliqueMirrored()), slanting());
}

TEST(ScenePicture, AgreesWithTheReferenceInParallelProjection)
{
  core::CameraPose pose = slanting();
  pose.parallelScale = 13.0;
  expectAgreement(hollowBall(synthetic::oblique()), pose);
}

TEST(ScenePicture, AgreesWithTheReferenceForEveryVoxelType)
{
  SceneContents contents;
  contents.ct = synthetic::ball<std::uint16_t>(synthetic::cube(48, 0.5), 9.0);
  expectAgreement(contents, slanting());
  contents.ct = synthetic::ball<float>(synthetic::cube(48, 0.5), 9.0);
  expectAgreement(contents, slanting());
}

TEST(ScenePicture, AgreesWithTheReferenceOnCutWallsForEveryVoxelType)
{
  const auto slab = [](const Eigen::Vector3d& p) { return 2.0 - p.z(); };
  SceneContents contents = hollowBall(synthetic::oblique());
  contents.mask = synthetic::cut(contents.ct->geometry(), slab);
  expectAgreement(contents, slanting());
  contents.ct = synthetic::ball<std::uint16_t>(contents.ct->geometry(), 9.0);
  expectAgreement(contents, slanting());
  contents.ct = synthetic::ball<float>(contents.ct->geometry(), 9.0);
  expectAgreement(contents, slanting());
}

TEST(ScenePicture, DrawsTissueThatTheBorderCutsOff)
{
  SceneContents contents;
  contents.ct = synthetic::ball(synthetic::cube(24, 0.5), 9.0);
  expectAgreement(contents, slanting(40.0));
}

TEST(ScenePicture, ShowsThePatientsLeftOnTheRightFromAnterior)
{
  const core::GridGeometry grid = synthetic::cube(48, 0.5, synthetic::obliqueMirrored());
  SceneContents contents;
  contents.ct = synthetic::ct<std::int16_t>(grid, [](const Eigen::Vector3d&) { return -5.0; });
  contents.structures.push_back(blueMarker(synthetic::labels(
      grid,
      [](const Eigen::Vector3d& p)
      {
        return (p - Eigen::Vector3d(6.0, 0.0, 5.0)).norm() < 2.0; // left (LPS x > 0) and above
      })));
  const Picture picture = draw(contents, standardCamera(StandardView::Anterior, grid));
  double columns = 0.0;
  double rows = 0.0;
  int count = 0;
  for (int row = 0; row < kHeight; ++row)
    for (int column = 0; column < kWidth; ++column)
      if (isBlue(picture.pixel(column, row)))
      {
        columns += column;
        rows += row;
        ++count;
      }
  ASSERT_GT(count, 20);
  EXPECT_GT(columns / count, 0.55 * kWidth);
  EXPECT_LT(rows / count, 0.45 * kHeight);
}

TEST(ScenePicture, ChangesInABoxAsItWouldFromTheStart)
{
  SceneContents contents = hollowBall(Eigen::Matrix3d::Identity());
  const core::GridGeometry grid = contents.ct->geometry();
  contents.structures.push_back(
      blueMarker(synthetic::labels(grid, [](const Eigen::Vector3d& p) { return p.norm() < 6.0; })));
  const auto first = synthetic::cut(grid, [](const Eigen::Vector3d& p)
                                    { return (p - Eigen::Vector3d(0, -8, 0)).norm() - 3.0; });
  const auto second =
      synthetic::cut(grid,
                     [](const Eigen::Vector3d& p)
                     {
                       return std::min((p - Eigen::Vector3d(0, -8, 0)).norm() - 3.0,
                                       (p - Eigen::Vector3d(5, -5, 4)).norm() - 3.0);
                     });
  core::IndexBox box;
  for (std::size_t b = 0; b < first->brickCount(); ++b)
    if (second->brick(b))
      box = box.united(second->brickBox(b));

  contents.mask = first;
  ScenePicture scene;
  scene.setContents(contents);
  scene.setCamera(slanting());
  OffscreenView view(kWidth, kHeight);
  const Picture before = view.render(scene);
  scene.maskChanged(second, box);
  const Picture after = view.render(scene);
  contents.mask = second;
  EXPECT_EQ(countDifferentPixels(after, draw(contents, slanting())), 0U);
  EXPECT_GT(countDifferentPixels(after, before), 100U);
  scene.maskChanged(first, box);
  EXPECT_EQ(countDifferentPixels(view.render(scene), before), 0U);
}

TEST(ScenePicture, UndoToTheUncutBoneRestoresEveryPixel)
{
  SceneContents contents = hollowBall(synthetic::oblique());
  const core::GridGeometry grid = contents.ct->geometry();
  contents.structures.push_back(
      blueMarker(synthetic::labels(grid, [](const Eigen::Vector3d& p) { return p.norm() < 6.0; })));
  ScenePicture scene;
  scene.setContents(contents);
  scene.setCamera(slanting());
  OffscreenView view(kWidth, kHeight);
  const Picture before = view.render(scene);
  const auto mask = synthetic::cut(grid, [](const Eigen::Vector3d& p)
                                   { return (p - Eigen::Vector3d(3, -6, 0)).norm() - 5.0; });
  scene.maskChanged(mask, grid.fullBox());
  EXPECT_GT(countDifferentPixels(view.render(scene), before), 100U);
  EXPECT_EQ(scene.resources().count("mask.combined"), 1U);
  scene.maskChanged(std::make_shared<volume::CutMask>(grid), grid.fullBox());
  EXPECT_EQ(countDifferentPixels(view.render(scene), before), 0U);
  EXPECT_EQ(scene.resources().count("mask.combined"), 0U);
}

TEST(ScenePicture, HoldsNothingThatTheSceneDoesNotNeed)
{
  ScenePicture scene;
  scene.setContents(hollowBall(Eigen::Matrix3d::Identity()));
  for (const auto& [name, bytes] : scene.resources())
  {
    EXPECT_EQ(name.rfind("ct.", 0), 0U) << name;
    EXPECT_GT(bytes, 0U) << name;
  }
}

TEST(ScenePicture, DrawsFromInsideTheVolumeAndTheBone)
{
  const SceneContents contents = hollowBall(Eigen::Matrix3d::Identity());
  for (const Eigen::Vector3d& eye :
       {Eigen::Vector3d(0, 0, 0), Eigen::Vector3d(4, -6, 3), Eigen::Vector3d(10, 0, 0)})
  {
    core::CameraPose pose = slanting();
    pose.position = eye;
    pose.focalPoint = eye + Eigen::Vector3d(-1, 1, 0);
    EXPECT_EQ(draw(contents, pose).width, kWidth);
  }
}

TEST(ScenePicture, DrawsThinAndEmptyGridsAsAir)
{
  for (const core::Index3& dims :
       {core::Index3{1, 1, 9}, core::Index3{5, 7, 1}, core::Index3{2, 2, 2}, core::Index3{1, 1, 1}})
  {
    const core::GridGeometry grid(dims, {0.5, 0.5, 0.5}, {0.0, 0.0, 0.0});
    SceneContents contents;
    contents.ct = synthetic::ct<std::int16_t>(grid, [](const Eigen::Vector3d&) { return -3.0; });
    const Picture picture = draw(contents, standardCamera(StandardView::Left, grid));
    EXPECT_TRUE(isBackground(picture.pixel(kWidth / 2, kHeight / 2)));
  }
  EXPECT_TRUE(isBackground(draw({}, slanting()).pixel(kWidth / 2, kHeight / 2)));
}

TEST(ScenePicture, RefusesContentsThatContradictEachOther)
{
  ScenePicture scene;
  SceneContents contents = hollowBall(Eigen::Matrix3d::Identity());
  contents.mask = std::make_shared<volume::CutMask>(synthetic::cube(10, 1.0));
  EXPECT_THROW(scene.setContents(contents), RenderingError);
  contents.mask.reset();
  contents.structures.push_back({"nothing", nullptr, 1, {}});
  EXPECT_THROW(scene.setContents(contents), RenderingError);
}

TEST(ScenePicture, DrawsTheToolBeforeTheBone)
{
  SceneContents contents = hollowBall(Eigen::Matrix3d::Identity());
  const Picture without = draw(contents, slanting());
  ToolPose tool;
  tool.center = {3.0, -11.0, 2.0};
  tool.axisToHand = {0.3, -1.0, 0.5};
  contents.tool = tool;
  EXPECT_GT(countDifferentPixels(draw(contents, slanting()), without), 100U);
  contents.tool->center = {0.0, 0.0, 0.0};
  contents.tool->axisToHand = {0.0, 1.0, 0.0}; // away from the eye, hidden up to its end
  contents.tool->radius = 1.0;
  EXPECT_LT(countDifferentPixels(draw(contents, slanting()), without), 3000U);
}

TEST(ScenePicture, CoarsensOnlyWhileInteractive)
{
  ScenePicture scene;
  scene.setContents(hollowBall(Eigen::Matrix3d::Identity()));
  scene.setCamera(slanting());
  OffscreenView view(kWidth, kHeight);
  const Picture still = view.render(scene);
  scene.setInteractive(true);
  EXPECT_GT(countDifferentPixels(view.render(scene), still), 0U);
  scene.setInteractive(false);
  EXPECT_EQ(countDifferentPixels(view.render(scene), still), 0U);
}

TEST(ScenePicture, KeepsItsCameraWithAndWithoutARenderer)
{
  ScenePicture scene;
  core::CameraPose pose = slanting();
  pose.parallelScale = 12.0;
  scene.setCamera(pose);
  EXPECT_TRUE(scene.camera().position.isApprox(pose.position));
  scene.setContents(hollowBall(Eigen::Matrix3d::Identity()));
  OffscreenView view(40, 30);
  view.render(scene);
  EXPECT_TRUE(scene.camera().position.isApprox(pose.position, 1e-9));
  ASSERT_TRUE(scene.camera().parallelScale);
  EXPECT_EQ(*scene.camera().parallelScale, 12.0);
}
