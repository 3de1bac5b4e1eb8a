#include "PictureComparison.h"
#include "PictureScenes.h"
#include "petrous/Rendering/PixelRays.h"
#include "petrous/Rendering/RenderingError.h"
#include "petrous/Rendering/ScenePicture.h"
#include "petrous/Rendering/ThicknessColor.h"

using namespace petrous;
using namespace petrous::rendering;
using namespace petrous::rendering::synthetic;

namespace
{

// The structure: a ball behind the bite.
const Vector kNerve(2.0, -2.5, 1.5);
constexpr double kNerveRadius = 1.5;

double toNerve(const Vector& p)
{
  return (p - kNerve).norm() - kNerveRadius;
}

ThicknessOverlay overNerve()
{
  const core::GridGeometry grid = cube(64, 0.25, obliqueMirrored(), kNerve);
  return {sampled<float>(grid, toNerve), 5.0};
}

SceneContents thin(SceneContents contents)
{
  contents.thickness = overNerve();
  return contents;
}

// Light under which every colour appears unchanged.
SceneContents evenlyLit(SceneContents contents)
{
  contents.light.ambient = 1.0;
  contents.light.specular = 0.0;
  return contents;
}

// Checks pixels for the colour of the analytic distance; returns the number of the other pixels.
int checkColors(const SceneContents& contents, const Shot& shot, const Shot& plain,
                const core::CameraPose& pose)
{
  const PixelRays rays(pose, kWidth, kHeight);
  int colored = 0;
  for (int row = 0; row < kHeight; ++row)
    for (int column = 0; column < kWidth; ++column)
    {
      const auto pixel = static_cast<std::size_t>(row * kWidth + column);
      const auto depth = static_cast<double>(shot.depth.millimetres[pixel]);
      if (std::isnan(depth))
        continue;
      const PixelRay ray = rays.through(column, row);
      const double distance = toNerve(ray.origin + depth * ray.direction);
      if (std::abs(distance - contents.thickness.farthest) < 0.1)
        continue; // the contour
      const std::uint8_t* drawn = shot.picture.pixel(column, row);
      const auto wanted = thicknessColor(distance / contents.thickness.farthest);
      const bool near = distance < contents.thickness.farthest;
      for (std::size_t c = 0; c < 3; ++c)
      {
        // On the steepest part of the scale 4/255 correspond to 0.03 mm.
        if (near)
          EXPECT_NEAR(drawn[c], 255.0 * wanted[c], 4.0) << distance << " mm";
        else
          EXPECT_EQ(int{drawn[c]}, int{plain.picture.pixel(column, row)[c]}) << distance << " mm";
      }
      colored += near;
      if (::testing::Test::HasFailure())
        return colored;
    }
  return colored;
}

} // namespace

TEST(ThicknessPicture, ShowsTheAnalyticDistanceAsColor)
{
  for (const SceneContents& bare : {hollowBall(), cutBall()})
  {
    const SceneContents plain = evenlyLit(bare);
    const SceneContents contents = thin(plain);
    const int colored =
        checkColors(contents, shoot(contents, slanting()), shoot(plain, slanting()), slanting());
    EXPECT_GT(colored, 800);
    EXPECT_LT(colored, kWidth * kHeight / 3);
  }
}

TEST(ThicknessPicture, IsThatOfTheReference)
{
  SceneContents clipped = thin(cutBall());
  clipped.clipping.push_back({{0.0, 0.0, 2.0}, Vector(0.0, 0.3, -1.0).normalized()});
  for (const SceneContents& contents :
       {thin(hollowBall()), thin(cutBall()), thin(translucentBall()), thin(fullScene()), clipped})
  {
    const Shot shot = shoot(contents, slanting());
    expectAgreement(
        compare(shot, truthOf(contents, slanting()), contents.ct->geometry().minSpacing()));
    SceneContents plain = contents;
    plain.thickness = {};
    EXPECT_GT(countDifferentPixels(shot.picture, draw(plain, slanting())), 500U);
  }
}

TEST(ThicknessPicture, LeavesStructuresInTheirOwnColor)
{
  // Only a structure is visible; then a lumen's wall, which is bone.
  SceneContents contents = hollowBall();
  contents.labels = labelField(
      contents.ct->geometry(), [](const Vector& p) { return 11.0 - p.norm(); },
      [](const Vector&) { return 1; });
  contents.materials.push_back(blue());
  EXPECT_EQ(countDifferentPixels(draw(thin(contents), slanting()), draw(contents, slanting())), 0U);
  auto lumen = std::make_shared<volume::LabelField>(*contents.labels);
  lumen->occupancy =
      std::make_shared<const volume::Volume<float>>(lumen->occupancy->geometry(), 0.0F);
  contents.labels = lumen;
  contents.materials[1].lumen = true;
  const SceneContents colored = thin(contents);
  EXPECT_GT(countDifferentPixels(draw(colored, slanting()), draw(contents, slanting())), 500U);
  expectAgreement(compare(shoot(colored, slanting()), truthOf(colored, slanting()), 0.5));
}

TEST(ThicknessPicture, IsCompiledAndHeldOnlyWhileItIsShown)
{
  ScenePicture scene;
  OffscreenView view(kWidth, kHeight);
  scene.setCamera(slanting());
  scene.setContents(hollowBall());
  const Picture bare = view.render(scene);
  EXPECT_EQ(scene.resources().count("labels.thickness"), 0U);
  scene.setContents(thin(hollowBall()));
  view.render(scene);
  EXPECT_EQ(scene.statistics().variant, (std::vector<std::string>{"ct", "bone", "thickness"}));
  EXPECT_EQ(scene.resources().at("labels.thickness"), 2U * 64U * 64U * 64U);
  scene.setContents(hollowBall());
  EXPECT_EQ(countDifferentPixels(view.render(scene), bare), 0U);
  EXPECT_EQ(scene.statistics().variant, (std::vector<std::string>{"ct", "bone"}));
  EXPECT_EQ(scene.resources().count("labels.thickness"), 0U);
}

TEST(ThicknessPicture, FollowsACutThatIsToldBrickByBrick)
{
  SceneContents contents = thin(hollowBall(oblique()));
  const core::GridGeometry grid = contents.ct->geometry();
  ScenePicture scene;
  OffscreenView view(kWidth, kHeight);
  scene.setCamera(slanting());
  contents.mask = std::make_shared<volume::CutMask>(grid);
  scene.setContents(contents);
  view.render(scene);
  contents.mask = cut(grid, cavity);
  scene.maskChanged(contents.mask, grid.fullBox());
  EXPECT_EQ(countDifferentPixels(view.render(scene), draw(contents, slanting())), 0U);
}

TEST(ThicknessPicture, RefusesAFarthestThatIsNone)
{
  SceneContents contents = thin(hollowBall());
  contents.thickness.farthest = 0.0;
  ScenePicture scene;
  EXPECT_THROW(scene.setContents(contents), RenderingError);
  EXPECT_THROW(ReferenceRayCaster{contents}, RenderingError);
}

// L* of CIE 1976 for sRGB.
double lightness(const std::array<double, 3>& rgb)
{
  const double weights[3] = {0.2126, 0.7152, 0.0722};
  double y = 0.0;
  for (std::size_t c = 0; c < 3; ++c)
    y +=
        weights[c] * (rgb[c] <= 0.04045 ? rgb[c] / 12.92 : std::pow((rgb[c] + 0.055) / 1.055, 2.4));
  return y > 216.0 / 24389.0 ? 116.0 * std::cbrt(y) - 16.0 : y * 24389.0 / 27.0;
}

TEST(ThicknessColor, GrowsLighterByEvenSteps)
{
  for (int n = 0; n <= 8; ++n)
    EXPECT_NEAR(lightness(thicknessColor(n / 8.0)), 28.0 + 60.0 * n / 8.0, 0.5) << n;
  double before = 0.0;
  for (int n = 0; n <= 100; ++n)
  {
    const double here = lightness(thicknessColor(n / 100.0));
    EXPECT_GT(here, before) << n;
    before = here;
  }
  EXPECT_EQ(thicknessColor(-1.0), thicknessColor(0.0));
  EXPECT_EQ(thicknessColor(2.0), thicknessColor(1.0));
}
