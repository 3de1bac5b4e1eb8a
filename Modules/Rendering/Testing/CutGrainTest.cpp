#include <algorithm>
#include <cmath>

#include "PictureComparison.h"
#include "PictureScenes.h"
#include "petrous/Rendering/PixelRays.h"
#include "petrous/Rendering/PrintPicture.h"
#include "petrous/Rendering/ScenePicture.h"

using namespace petrous;
using namespace petrous::rendering;
using namespace petrous::rendering::synthetic;

namespace
{

const Vector kWall(0.2, -3.4, 1.0); // the floor of the cavity is near

// A matt ball with the cavity, whose colour is that of its diffuse light alone.
SceneContents mattBall(double grain)
{
  SceneContents contents = cutBall();
  contents.materials = {{appearance::TransferFunction::constant({0.6F, 0.55F, 0.5F}, 1.0F, 0.0F)}};
  contents.light.grain = grain;
  return contents;
}

// Seen from `eye`, so that a pixel at the focal point is `pixel` mm.
core::CameraPose near(const Vector& eye, double pixel)
{
  core::CameraPose pose = from(eye, kWall);
  const double height = kHeight * pixel;
  pose.viewAngle = 2.0 * std::atan(0.5 * height / (eye - kWall).norm()) * 180.0 / M_PI;
  return pose;
}

core::CameraPose near(double pixel)
{
  return near(kWall + 50.0 * Vector(0.35, -0.85, 0.4).normalized(), pixel);
}

double rmsOf(const Picture& a, const Picture& b)
{
  double squares = 0.0;
  for (std::size_t n = 0; n < a.rgb.size(); ++n)
    squares += std::pow(double(a.rgb[n]) - double(b.rgb[n]), 2.0);
  return std::sqrt(squares / static_cast<double>(a.rgb.size()));
}

bool hasGrain(const SceneContents& contents)
{
  const auto names = shoot(contents, near(0.05), {}, 32, 24).statistics.variant;
  return std::count(names.begin(), names.end(), "grain") > 0;
}

} // namespace

// In a picture from any side each point has the grain of its place in the CT.
TEST(CutGrain, StaysWhereItIsInTheBone)
{
  const SceneContents plain = mattBall(0.0);
  const SceneContents grained = mattBall(1.0);
  const core::GridGeometry& grid = plain.ct->geometry();
  for (const Vector& towards : {Vector(0.35, -0.85, 0.4), Vector(0.7, -0.7, 0.2)})
  {
    const core::CameraPose pose = near(kWall + 45.0 * towards.normalized(), 0.03);
    const Shot without = shoot(plain, pose);
    const Shot with = shoot(grained, pose);
    const PixelRays rays(pose, kWidth, kHeight);
    const volume::TissueField tissue = field(plain);
    int compared = 0;
    int others = 0;
    double squares = 0.0;
    for (int row = 0; row < kHeight; ++row)
      for (int column = 0; column < kWidth; ++column)
      {
        const double depth = with.depth.at(column, row);
        if (std::isnan(depth))
          continue;
        const PixelRay ray = rays.through(column, row);
        const Vector point = ray.origin + depth * ray.direction;
        const Vector voxel = grid.voxelFromPatient(point);
        if (plain.ct->sample(voxel) < kIso + 10.0)
          continue; // not by the mask, or as good as not
        const double cosine = tissue.normal(point).dot(ray.direction);
        const double factor = optics::grainFactor(grid, voxel, cosine, ray.pixelAt(depth), 1.0);
        const double wanted = factor * without.picture.pixel(column, row)[0];
        const double apart = std::abs(with.picture.pixel(column, row)[0] - wanted);
        others += apart > 2.0;
        squares += std::pow(factor - 1.0, 2.0);
        ++compared;
      }
    EXPECT_GT(compared, 20000);
    EXPECT_LE(others, compared / 500);
    EXPECT_GT(std::sqrt(squares / compared), 0.05) << "it is seen";
  }
}

TEST(CutGrain, IsThatOfTheReferenceAtAllDistances)
{
  for (const double pixel : {0.02, 0.07, 0.12})
    for (const bool parallel : {false, true})
    {
      SceneContents contents = cutBall(parallel && pixel > 0.05 ? 0.6F : 1.0F);
      contents.light.grain = 1.0;
      const double voxel = contents.ct->geometry().minSpacing();
      core::CameraPose pose = near(pixel);
      if (parallel)
        pose.parallelScale = 0.5 * pixel * kHeight;
      const Agreement agreement = compare(shoot(contents, pose), truthOf(contents, pose), voxel);
      EXPECT_GT(agreement.hits, 10000);
      expectAgreement(agreement);
    }
}

TEST(CutGrain, IsNowhereButOnBoneThatIsCut)
{
  // Nothing is cut.
  SceneContents contents = mattBall(0.0);
  contents.mask = nullptr;
  const Picture whole = draw(contents, near(0.05));
  EXPECT_FALSE(hasGrain(contents));
  contents.light.grain = 1.0;
  EXPECT_FALSE(hasGrain(contents));
  EXPECT_EQ(countDifferentPixels(draw(contents, near(0.05)), whole), 0U);
  // A structure is cut.
  contents = mattBall(0.0);
  contents.labels = labelField(
      contents.ct->geometry(), [](const Vector& p) { return 9.5 - p.norm(); },
      [](const Vector&) { return 1; });
  contents.materials.push_back(blue());
  const Picture structure = draw(contents, near(0.05));
  contents.light.grain = 1.0;
  EXPECT_TRUE(hasGrain(contents));
  EXPECT_EQ(countDifferentPixels(draw(contents, near(0.05)), structure), 0U);
  // Bone is cut by a plane, behind which nothing was drilled.
  contents = mattBall(0.0);
  contents.clipping = {{kWall + Vector(0.0, 1.5, 0.0), {0.0, 1.0, 0.0}}};
  const Picture clipped = draw(contents, near(0.05));
  contents.light.grain = 1.0;
  EXPECT_EQ(countDifferentPixels(draw(contents, near(0.05)), clipped), 0U);
}

TEST(CutGrain, IsNotDrawnWhenItIsOff)
{
  EXPECT_EQ(LightSettings().grain, 0.0);
  EXPECT_FALSE(hasGrain(mattBall(0.0)));
  EXPECT_TRUE(hasGrain(mattBall(0.01)));
  const Picture plain = draw(mattBall(0.0), near(0.05));
  ScenePicture scene;
  scene.setContents(mattBall(1.0));
  scene.setCamera(near(0.05));
  OffscreenView view(kWidth, kHeight);
  EXPECT_GT(rmsOf(view.render(scene), plain), 5.0);
  scene.setContents(mattBall(0.0));
  EXPECT_EQ(countDifferentPixels(view.render(scene), plain), 0U);
}

TEST(CutGrain, FadesWhereAPixelIsCoarserThanIt)
{
  double last = 1e9;
  for (const double pixel : {0.03, 0.09, 0.12, 0.15})
  {
    const double seen = rmsOf(draw(mattBall(1.0), near(pixel)), draw(mattBall(0.0), near(pixel)));
    EXPECT_LT(seen, last) << pixel;
    last = seen;
  }
  EXPECT_EQ(countDifferentPixels(draw(mattBall(1.0), near(0.25)), draw(mattBall(0.0), near(0.25))),
            0U)
      << "to the bit";
}

// Of a picture with fewer pixels the grain of those counts.
TEST(CutGrain, FadesWithTheResolutionOfTheMovingPicture)
{
  RenderQuality coarse;
  coarse.imageScale = 0.25;
  const core::CameraPose pose = near(0.06); // 0.24 in the picture of a quarter
  EXPECT_GT(countDifferentPixels(draw(mattBall(1.0), pose), draw(mattBall(0.0), pose)), 5000U);
  EXPECT_EQ(
      countDifferentPixels(draw(mattBall(1.0), pose, coarse), draw(mattBall(0.0), pose, coarse)),
      0U);
}

// A tile has the grain of the whole picture, whose pixels it has.
TEST(CutGrain, IsThatOfThePictureInEachTile)
{
  const core::CameraPose pose = near(0.1); // where it fades
  ScenePicture scene;
  scene.setContents(mattBall(1.0));
  scene.setCamera(pose);
  OffscreenView view(kWidth, kHeight);
  const Picture whole = view.render(scene);
  EXPECT_LE(rmsOf(renderTiled(scene, pose, kWidth, kHeight, {}, 64), whole), 0.5);
  EXPECT_GT(rmsOf(draw(mattBall(0.0), pose), whole), 3.0);
}

TEST(CutGrain, FollowsTheCutAndItsUndo)
{
  SceneContents contents = mattBall(1.0);
  const auto first = contents.mask;
  const auto deeper = cut(contents.ct->geometry(), [](const Vector& p)
                          { return std::min(cavity(p), (p - kWall).norm() - 1.5); });
  ScenePicture scene;
  scene.setContents(contents);
  scene.setCamera(near(0.05));
  OffscreenView view(kWidth, kHeight);
  const Picture before = view.render(scene);
  scene.maskChanged(deeper, contents.ct->geometry().fullBox());
  const Picture after = view.render(scene);
  EXPECT_GT(countDifferentPixels(after, before), 500U);
  contents.mask = deeper;
  EXPECT_EQ(countDifferentPixels(after, draw(contents, near(0.05))), 0U);
  scene.maskChanged(first, contents.ct->geometry().fullBox());
  EXPECT_EQ(countDifferentPixels(view.render(scene), before), 0U);
}
