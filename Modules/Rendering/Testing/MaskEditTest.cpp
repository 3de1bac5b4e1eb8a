#include <algorithm>

#include "PictureComparison.h"
#include "PictureScenes.h"
#include "RandomScenes.h"
#include "SceneTextures.h"
#include "petrous/Rendering/ScenePicture.h"

using namespace petrous;
using namespace petrous::rendering;
using namespace petrous::rendering::synthetic;
namespace strokes = petrous::rendering::testing;

namespace
{

std::shared_ptr<volume::CutMask> ballsCut(const core::GridGeometry& grid, int count)
{
  return cut(grid,
             [=](const Vector& p)
             {
               double left = (p - Vector(0.0, -8.0, 0.0)).norm() - 3.0;
               if (count > 1)
                 left = std::min(left, (p - Vector(5.0, -5.0, 4.0)).norm() - 3.0);
               return left;
             });
}

core::IndexBox touched(const volume::CutMask& mask)
{
  core::IndexBox box;
  for (std::size_t b = 0; b < mask.brickCount(); ++b)
    if (mask.brick(b))
      box = box.united(mask.brickBox(b));
  return box;
}

std::size_t differentFromFresh(const Picture& picture, SceneContents contents,
                               std::shared_ptr<const volume::CutMask> mask,
                               const RenderQuality& quality = {})
{
  contents.mask = std::move(mask);
  return countDifferentPixels(picture, draw(contents, slanting(), quality));
}

} // namespace

TEST(MaskEdit, DrawsABoxAsItWouldFromTheStart)
{
  SceneContents contents = labelledBall(cube(64, 0.35, obliqueMirrored()));
  const core::GridGeometry grid = contents.ct->geometry();
  const auto first = ballsCut(grid, 1);
  const auto second = ballsCut(grid, 2);
  for (const int bits : {8, 16})
    for (const int brick : {4, 16})
    {
      RenderQuality quality;
      quality.maskBits = bits;
      quality.brick = brick;
      contents.mask = first;
      ScenePicture scene;
      scene.setContents(contents);
      scene.setCamera(slanting());
      scene.setQuality(quality);
      OffscreenView view(kWidth, kHeight);
      const Picture before = view.render(scene);
      scene.maskChanged(second, touched(*second));
      const Picture after = view.render(scene);
      EXPECT_EQ(differentFromFresh(after, contents, second, quality), 0U);
      EXPECT_GT(countDifferentPixels(after, before), 100U);
      scene.maskChanged(first, touched(*second));
      EXPECT_EQ(countDifferentPixels(view.render(scene), before), 0U);
    }
}

TEST(MaskEdit, UndoOfEverythingRestoresEveryPixelAndEveryResource)
{
  const SceneContents contents = labelledBall(cube(64, 0.35, obliqueMirrored()));
  const core::GridGeometry grid = contents.ct->geometry();
  ScenePicture scene;
  scene.setContents(contents);
  scene.setCamera(slanting());
  OffscreenView view(kWidth, kHeight);
  const Picture before = view.render(scene);
  const auto resources = scene.resources();
  const auto variant = scene.statistics().variant;
  scene.maskChanged(ballsCut(grid, 2), grid.fullBox());
  EXPECT_GT(countDifferentPixels(view.render(scene), before), 100U);
  EXPECT_EQ(scene.resources().count("mask.texture"), 1U);
  for (const auto& undone :
       {std::make_shared<volume::CutMask>(grid), decltype(ballsCut(grid, 1))()})
  {
    scene.maskChanged(undone, grid.fullBox());
    EXPECT_EQ(countDifferentPixels(view.render(scene), before), 0U);
    EXPECT_EQ(scene.resources(), resources);
    EXPECT_EQ(scene.statistics().variant, variant);
  }
}

// With a tool in the scene the first cut changes no shader; without one an untouched mask is
// unused.
TEST(MaskEdit, IsReadyForTheFirstCutWhileThereIsATool)
{
  SceneContents contents = labelledBall(cube(64, 0.35, obliqueMirrored()));
  const core::GridGeometry grid = contents.ct->geometry();
  contents.mask = std::make_shared<volume::CutMask>(grid);
  ScenePicture scene;
  scene.setContents(contents);
  scene.setCamera(slanting());
  OffscreenView view(kWidth, kHeight);
  const Picture plain = view.render(scene);
  EXPECT_EQ(scene.resources().count("mask.texture"), 0U);
  const auto variant = scene.statistics().variant;

  ToolPose away; // behind the camera
  away.center = slanting().position + (slanting().position - slanting().focalPoint);
  scene.setTool(away);
  EXPECT_EQ(countDifferentPixels(view.render(scene), plain), 0U);
  EXPECT_EQ(scene.resources().count("mask.texture"), 1U);
  const auto ready = scene.statistics().variant;
  EXPECT_EQ(std::count(ready.begin(), ready.end(), "mask"), 1);

  const auto balls = ballsCut(grid, 2);
  scene.maskChanged(balls, touched(*balls));
  const Picture cut = view.render(scene);
  EXPECT_EQ(scene.statistics().variant, ready);
  EXPECT_EQ(differentFromFresh(cut, contents, balls), 0U);

  scene.maskChanged(contents.mask, touched(*balls));
  EXPECT_EQ(countDifferentPixels(view.render(scene), plain), 0U);
  EXPECT_EQ(scene.statistics().variant, ready);
  scene.setTool(std::nullopt);
  EXPECT_EQ(countDifferentPixels(view.render(scene), plain), 0U);
  EXPECT_EQ(scene.statistics().variant, variant);
  EXPECT_EQ(scene.resources().count("mask.texture"), 0U);
}

TEST(MaskEdit, GivesBackBricksThatHadBecomeEmpty)
{
  for (const SceneContents& contents : {hollowBall(oblique()), translucentBall()})
  {
    const core::GridGeometry grid = contents.ct->geometry();
    const auto small = ballsCut(grid, 1); // remains, so that the mask stays in use
    const auto block = cut(grid,
                           [](const Vector& p) {
                             return std::min((p - Vector(0.0, -8.0, 0.0)).norm() - 3.0,
                                             p.cwiseAbs().maxCoeff() - 7.0);
                           });
    ScenePicture scene;
    SceneContents now = contents;
    now.mask = small;
    scene.setContents(now);
    scene.setCamera(slanting());
    OffscreenView view(kWidth, kHeight);
    const Picture before = view.render(scene);
    scene.maskChanged(block, touched(*block));
    const Picture hollow = view.render(scene);
    EXPECT_EQ(differentFromFresh(hollow, contents, block), 0U);
    EXPECT_GT(countDifferentPixels(hollow, before), 1000U);
    scene.maskChanged(small, touched(*block));
    EXPECT_EQ(countDifferentPixels(view.render(scene), before), 0U);
  }
}

TEST(MaskEdit, ManyStrokesAndUndosEndAsDrawnFromTheStart)
{
  const SceneContents contents = translucentBall();
  const core::GridGeometry grid = contents.ct->geometry();
  auto mask = std::make_shared<volume::CutMask>(grid);
  strokes::Random random(3);
  ScenePicture scene;
  scene.setContents(contents);
  scene.setCamera(slanting());
  OffscreenView view(kWidth, kHeight);
  view.render(scene);
  for (int round = 0; round < 4; ++round)
  {
    for (int stroke = 0; stroke < 12; ++stroke)
    {
      core::Index3 at;
      for (int& index : at)
        index = 8 + strokes::below(random, 32);
      const bool giveBack = strokes::below(random, 3) == 0;
      // Includes the support of interpolation: one more voxel on each side.
      core::IndexBox box = strokes::brush(*mask, at, 3.0 + strokes::below(random, 4), giveBack);
      for (std::size_t a = 0; a < 3; ++a)
      {
        box.lower[a] = std::max(box.lower[a] - 1, 0);
        box.upper[a] = std::min(box.upper[a] + 1, grid.dims()[a]);
      }
      scene.maskChanged(mask, box);
      if (stroke % 5 == 4)
        view.render(scene); // frames interleaved with strokes
    }
    const Picture drawn = view.render(scene);
    EXPECT_EQ(differentFromFresh(drawn, contents, std::make_shared<volume::CutMask>(*mask)), 0U)
        << round;
  }
}

TEST(MaskEdit, ShowsChangesOfASharedMaskThatOnlySetContentsTells)
{
  SceneContents contents = translucentBall();
  const core::GridGeometry grid = contents.ct->geometry();
  auto mask = std::make_shared<volume::CutMask>(*ballsCut(grid, 1));
  contents.mask = mask;
  ScenePicture scene;
  scene.setContents(contents);
  scene.setCamera(slanting());
  OffscreenView view(kWidth, kHeight);
  const Picture before = view.render(scene);
  const auto more = ballsCut(grid, 2);
  for (std::size_t b = 0; b < mask->brickCount(); ++b)
    mask->setBrick(b, more->brick(b));
  scene.setContents(contents);
  const Picture after = view.render(scene);
  EXPECT_GT(countDifferentPixels(after, before), 100U);
  EXPECT_EQ(differentFromFresh(after, contents, more), 0U);
}

TEST(MaskEdit, ShowsAnEditToldBeforeTheFirstFrame)
{
  const SceneContents contents = translucentBall();
  const auto mask = ballsCut(contents.ct->geometry(), 2);
  ScenePicture scene;
  scene.setContents(contents);
  scene.setCamera(slanting());
  scene.maskChanged(mask, touched(*mask));
  OffscreenView view(kWidth, kHeight);
  EXPECT_EQ(differentFromFresh(view.render(scene), contents, mask), 0U);
}

TEST(MaskEdit, BringsEditsOverTheCapOverSeveralFrames)
{
  const core::GridGeometry grid = cube(170, 0.14);
  ASSERT_GT(grid.voxelCount(), MaskTexture::kVoxelsPerFrame);
  SceneContents contents = boneScene(ball(grid, 9.0));
  const auto first = ballsCut(grid, 1);
  const auto second = ballsCut(grid, 2);
  contents.mask = first;
  ScenePicture scene;
  scene.setContents(contents);
  scene.setCamera(slanting());
  OffscreenView view(kWidth, kHeight);
  view.render(scene);
  EXPECT_EQ(scene.statistics().pendingEdits, 0U);
  scene.maskChanged(second, grid.fullBox());
  view.render(scene);
  const std::size_t pending = scene.statistics().pendingEdits;
  const std::size_t slice = 170U * 170U; // edits are split into whole slices
  EXPECT_GE(pending + slice, grid.voxelCount() - MaskTexture::kVoxelsPerFrame);
  EXPECT_LT(pending, grid.voxelCount());
  const Picture last = view.render(scene);
  EXPECT_EQ(scene.statistics().pendingEdits, 0U);
  EXPECT_EQ(differentFromFresh(last, contents, second), 0U);
}

TEST(MaskEdit, EightBitsOfTheMaskMoveTheWallByLessThanATenthOfAVoxel)
{
  const SceneContents contents = cutBall();
  RenderQuality quality;
  quality.maskBits = 8;
  const Agreement agreement =
      compare(shoot(contents, slanting(), quality), truthOf(contents, slanting()),
              contents.ct->geometry().minSpacing());
  // One of 255 levels at a slope of half the mask's range per voxel is 0.008 voxel.
  EXPECT_LE(agreement.median, 0.01);
  EXPECT_LE(agreement.farthest, 0.1);
  EXPECT_LE(agreement.others, 0.2);
}
