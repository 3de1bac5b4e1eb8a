#include "petrous/Rendering/ScenePicture.h"

#include "PictureComparison.h"
#include "PictureScenes.h"
#include "petrous/Core/Error.h"
#include "petrous/Rendering/RenderingError.h"
#include "petrous/Rendering/StandardViews.h"

using namespace petrous;
using namespace petrous::rendering;
using namespace petrous::rendering::synthetic;

TEST(ScenePicture, ShowsThePatientsLeftOnTheRightFromAnterior)
{
  const core::GridGeometry grid = cube(48, 0.5, obliqueMirrored());
  SceneContents contents = boneScene(ct<std::int16_t>(grid, [](const Vector&) { return -5.0; }));
  // Left is LPS x > 0, up is z > 0.
  const auto marker =
      labels(grid, [](const Vector& p) { return (p - Vector(6.0, 0.0, 5.0)).norm() < 2.0; });
  contents.labels = volume::makeLabelField({{marker, 1, 1, true}});
  contents.materials = {boneMaterial(), blue()};
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

TEST(ScenePicture, SeesTheSurfaceWhereTheHandFeelsIt)
{
  const SceneContents contents = fullScene();
  const double voxel = contents.ct->geometry().minSpacing();
  const volume::TissueField hand = field(contents, {contents.labels->occupancy});
  const PixelRays rays(slanting(), kWidth, kHeight);
  ReferencePicture felt;
  felt.rgb.resize(3 * kWidth * kHeight);
  felt.depth = {kWidth, kHeight, {}};
  for (int row = 0; row < kHeight; ++row)
    for (int column = 0; column < kWidth; ++column)
    {
      const PixelRay ray = rays.through(column, row);
      const auto hit = hand.firstHit(ray.origin, ray.origin + 200.0 * ray.direction);
      felt.depth.millimetres.push_back(hit ? static_cast<float>(*hit)
                                           : std::numeric_limits<float>::quiet_NaN());
    }
  const Agreement agreement = compare(shoot(contents, slanting()), felt, voxel);
  EXPECT_GT(agreement.hits, 4000);
  EXPECT_LE(agreement.median, 0.05);
  EXPECT_LE(agreement.farthest, 0.05); // of those within half a voxel: all
  EXPECT_LE(agreement.others, 0.2);    // grazing rays; the haptics step half a voxel as well
}

TEST(ScenePicture, PicksThePointOfTheFieldInPatientMillimetres)
{
  const SceneContents contents = fullScene();
  const volume::TissueField hand = field(contents, {contents.labels->occupancy});
  for (const bool parallel : {false, true})
  {
    core::CameraPose pose = slanting();
    pose.lensShift = 0.1;
    if (parallel)
      pose.parallelScale = 13.0;
    ScenePicture scene;
    scene.setContents(contents);
    scene.setCamera(pose);
    EXPECT_FALSE(scene.pick(kWidth / 2, kHeight / 2)); // before the first frame
    OffscreenView view(kWidth, kHeight);
    view.render(scene);
    const PixelRays rays(pose, kWidth, kHeight);
    int picked = 0;
    for (int row = 5; row < kHeight; row += 14)
      for (int column = 5; column < kWidth; column += 14)
      {
        const PixelRay ray = rays.through(column, row);
        const auto hit = hand.firstHit(ray.origin, ray.origin + 200.0 * ray.direction);
        const auto point = scene.pick(column, row);
        ASSERT_EQ(hit.has_value(), point.has_value()) << column << " " << row;
        if (!hit)
          continue;
        ++picked;
        EXPECT_LT((*point - (ray.origin + *hit * ray.direction)).norm(), 0.05 * 0.5);
      }
    EXPECT_GT(picked, 15);
    EXPECT_FALSE(scene.pick(-1.0, 10.0));
    EXPECT_FALSE(scene.pick(10.0, kHeight));
  }
}

TEST(ScenePicture, GivesNoDepthOnceTheVolumeIsGone)
{
  ScenePicture scene;
  scene.setContents(hollowBall());
  scene.setCamera(slanting());
  OffscreenView view(kWidth, kHeight);
  view.render(scene);
  EXPECT_TRUE(scene.pick(kWidth / 2, kHeight / 2));
  scene.setContents({});
  EXPECT_TRUE(isBackground(view.render(scene).pixel(kWidth / 2, kHeight / 2)));
  EXPECT_FALSE(scene.pick(kWidth / 2, kHeight / 2));
  EXPECT_TRUE(scene.statistics().variant.empty());
  EXPECT_TRUE(scene.resources().empty());
}

TEST(ScenePicture, DrawsThinAndEmptyGridsAsAir)
{
  for (const core::Index3& dims :
       {core::Index3{1, 1, 9}, core::Index3{5, 7, 1}, core::Index3{2, 2, 2}, core::Index3{1, 1, 1}})
  {
    const core::GridGeometry grid(dims, {0.5, 0.5, 0.5}, {0.0, 0.0, 0.0});
    SceneContents contents;
    contents.ct = ct<std::int16_t>(grid, [](const Vector&) { return -3.0; });
    const Picture picture = draw(contents, standardCamera(StandardView::Left, grid));
    EXPECT_TRUE(isBackground(picture.pixel(kWidth / 2, kHeight / 2)));
  }
  EXPECT_TRUE(isBackground(draw({}, slanting()).pixel(kWidth / 2, kHeight / 2)));
}

// Also while it is shown, in the picture that is there already, and nothing that is lit changes.
TEST(ScenePicture, HasTheBackgroundOfItsContents)
{
  const auto is = [](const std::uint8_t* pixel, int red, int green, int blue)
  {
    return std::abs(pixel[0] - red) <= 1 && std::abs(pixel[1] - green) <= 1 &&
           std::abs(pixel[2] - blue) <= 1;
  };
  SceneContents contents = hollowBall();
  ScenePicture scene;
  scene.setContents(contents);
  scene.setCamera(slanting());
  OffscreenView view(kWidth, kHeight);
  const Picture usual = view.render(scene);
  EXPECT_TRUE(isBackground(usual.pixel(0, 0)));
  contents.background = {1.0, 0.6, 0.2};
  scene.setContents(contents);
  const Picture other = view.render(scene);
  EXPECT_TRUE(is(other.pixel(0, 0), 255, 153, 51));
  const std::uint8_t* before = usual.pixel(kWidth / 2, kHeight / 2);
  EXPECT_TRUE(is(other.pixel(kWidth / 2, kHeight / 2), before[0], before[1], before[2]));
  EXPECT_FALSE(isBackground(before)) << "bone";
}

TEST(ScenePicture, RefusesContentsThatContradictEachOther)
{
  ScenePicture scene;
  SceneContents contents = hollowBall();
  contents.mask = std::make_shared<volume::CutMask>(cube(10, 1.0));
  EXPECT_THROW(scene.setContents(contents), RenderingError);

  contents = hollowBall();
  contents.background = {0.0, 0.0, 1.5};
  EXPECT_THROW(scene.setContents(contents), RenderingError);

  contents = labelledBall(cube(48, 0.5));
  contents.materials.resize(2); // index 2 is missing
  EXPECT_THROW(scene.setContents(contents), RenderingError);

  // Data on another grid would be read out of bounds.
  const core::GridGeometry other = cube(10, 1.0);
  for (const bool index : {true, false})
  {
    contents = labelledBall(cube(48, 0.5));
    volume::LabelField labels = *contents.labels;
    const auto voxels = std::make_shared<volume::Volume<std::uint8_t>>(other, std::uint8_t{1});
    (index ? labels.index : labels.borders) = voxels;
    contents.labels = std::make_shared<volume::LabelField>(labels);
    EXPECT_THROW(scene.setContents(contents), RenderingError) << index;
    EXPECT_THROW(ReferenceRayCaster{contents}, RenderingError) << index;
  }

  contents = hollowBall();
  contents.iso = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(scene.setContents(contents), RenderingError);

  contents = hollowBall();
  contents.materials = {waveMaterial(1.0F)}; // requires a second image
  EXPECT_THROW(scene.setContents(contents), RenderingError);

  contents = hollowBall();
  contents.clipping.resize(7);
  EXPECT_THROW(scene.setContents(contents), RenderingError);

  contents = hollowBall();
  contents.meshes.push_back({"nothing", nullptr, {}});
  EXPECT_THROW(scene.setContents(contents), RenderingError);
}

TEST(ScenePicture, StaysAsItWasWhereContentsAreRefused)
{
  ScenePicture scene;
  scene.setContents(hollowBall());
  scene.setCamera(slanting());
  OffscreenView view(kWidth, kHeight);
  const Picture before = view.render(scene);
  SceneContents broken = translucentBall();
  core::TriangleMesh mesh;
  mesh.vertices = {{0, 0, 0}, {1, 0, 0}};
  mesh.triangles = {{0, 1, 7}};
  broken.meshes.push_back({"broken", std::make_shared<core::TriangleMesh>(mesh), {}});
  EXPECT_THROW(scene.setContents(broken), core::Error);
  EXPECT_EQ(countDifferentPixels(view.render(scene), before), 0U);
}

TEST(ScenePicture, RefusesAQualityOutOfItsRange)
{
  ScenePicture scene;
  const RenderQuality fine;
  const auto refused = [&](auto RenderQuality::*value, auto bad)
  {
    RenderQuality quality;
    quality.*value = bad;
    EXPECT_THROW(scene.setQuality(quality), core::InvalidParameter);
    EXPECT_EQ(scene.quality().*value, fine.*value);
  };
  refused(&RenderQuality::step, 0.0);
  refused(&RenderQuality::step, -1.0);
  refused(&RenderQuality::step, std::numeric_limits<double>::quiet_NaN());
  refused(&RenderQuality::bisections, -1);
  refused(&RenderQuality::bisections, 25);
  refused(&RenderQuality::brick, 5);
  refused(&RenderQuality::termination, -0.1);
  refused(&RenderQuality::tableSize, 1);
  refused(&RenderQuality::tableSize, 100000);
  refused(&RenderQuality::maskBits, 12);
  refused(&RenderQuality::imageScale, 0.0);
  refused(&RenderQuality::imageScale, 1.5);
  refused(&RenderQuality::largestTexture, -4);
}

TEST(ScenePicture, CoarsensOnlyWhileInteractive)
{
  ScenePicture scene;
  scene.setContents(hollowBall());
  scene.setCamera(slanting());
  OffscreenView view(kWidth, kHeight);
  const Picture still = view.render(scene);
  scene.setInteractionRate(30.0); // resets the estimated speed of the machine
  scene.setInteractive(true);
  EXPECT_GT(countDifferentPixels(view.render(scene), still), 0U);
  scene.setInteractive(false);
  EXPECT_EQ(countDifferentPixels(view.render(scene), still), 0U);
}

TEST(ScenePicture, LearnsFromTheFrameAtRestWhatTheMachineCanDo)
{
  ScenePicture scene;
  scene.setContents(hollowBall());
  scene.setCamera(slanting());
  scene.setInteractionRate(1.0); // any machine draws so small a picture at full quality
  OffscreenView view(32, 24);
  view.render(scene);
  view.render(scene);
  scene.setInteractive(true);
  view.render(scene);
  EXPECT_EQ(scene.depth().width, 32) << "not the half of one that has seen no frame";
}

TEST(ScenePicture, KeepsItsBrightnessWhileCoarse)
{
  for (const SceneContents& contents : {translucentBall(), fullScene(), hollowBall()})
  {
    RenderQuality coarse;
    coarse.imageScale = 0.3;
    coarse.step = 1.0;
    const auto brightness = [](const Picture& picture)
    {
      double sum = 0.0;
      for (const std::uint8_t value : picture.rgb)
        sum += value;
      return sum / static_cast<double>(picture.rgb.size());
    };
    const double fine = brightness(draw(contents, slanting(40.0)));
    const double rough = brightness(draw(contents, slanting(40.0), coarse));
    // 1.5 % of the light is a third of the difference visible between two frames.
    EXPECT_NEAR(rough / fine, 1.0, 0.015);
  }
}

TEST(ScenePicture, KeepsItsCameraWithAndWithoutARenderer)
{
  ScenePicture scene;
  core::CameraPose pose = slanting();
  pose.parallelScale = 12.0;
  scene.setCamera(pose);
  EXPECT_TRUE(scene.camera().position.isApprox(pose.position));
  scene.setContents(hollowBall());
  OffscreenView view(40, 30);
  view.render(scene);
  EXPECT_TRUE(scene.camera().position.isApprox(pose.position, 1e-9));
  ASSERT_TRUE(scene.camera().parallelScale);
  EXPECT_EQ(*scene.camera().parallelScale, 12.0);
}
