#include <algorithm>
#include <cmath>

#include "PictureComparison.h"
#include "PictureScenes.h"
#include "petrous/Appearance/AppearanceMaterial.h"
#include "petrous/Appearance/StructurePresets.h"
#include "petrous/Rendering/ScenePicture.h"

using namespace petrous;
using namespace petrous::rendering;
using namespace petrous::rendering::synthetic;

namespace
{

bool hasTone(const Shot& shot)
{
  const auto& names = shot.statistics.variant;
  return std::count(names.begin(), names.end(), "tone") > 0;
}

MeshContents sheet(const std::array<float, 3>& color, float y = 0.0F)
{
  core::TriangleMesh mesh;
  mesh.vertices = {{-14.0F, y, -14.0F}, {14.0F, y, -14.0F}, {0.0F, y, 14.0F}};
  mesh.triangles = {{0, 1, 2}};
  MeshContents contents{"sheet", std::make_shared<core::TriangleMesh>(mesh), {}};
  contents.look.color = color;
  return contents;
}

/// Of one colour without highlight, and a sheet.
SceneContents matt(float grey)
{
  SceneContents contents = hollowBall();
  contents.materials = {
      {appearance::TransferFunction::constant({grey, 0.5F * grey, 0.2F}, 1.0F, 0.0F)}};
  contents.meshes = {sheet({grey, 0.2F, 0.1F})};
  contents.light.specular = 0.0;
  return contents;
}

} // namespace

TEST(TonePicture, IsCompiledWhereItIsWantedAndGoesAgain)
{
  SceneContents contents = fullScene();
  contents.meshes = {sheet({0.9F, 0.2F, 0.1F})};
  contents.light.wetness = 1.0;
  ScenePicture scene;
  scene.setCamera(slanting());
  scene.setContents(contents);
  OffscreenView view(kWidth, kHeight);
  const Shot plain = shoot(view, scene);
  EXPECT_FALSE(hasTone(plain));
  contents.light.toneCurve = true;
  contents.light.exposure = 0.5;
  scene.setContents(contents);
  const Shot toned = shoot(view, scene);
  EXPECT_TRUE(hasTone(toned));
  EXPECT_GT(countDifferentPixels(plain.picture, toned.picture), 1000U);
  contents.light.toneCurve = false;
  contents.light.exposure = 0.0;
  scene.setContents(contents);
  const Shot again = shoot(view, scene);
  EXPECT_FALSE(hasTone(again));
  EXPECT_EQ(countDifferentPixels(plain.picture, again.picture), 0U);
}

TEST(TonePicture, MidTonesAreAsWithoutItToTheBit)
{
  for (const float grey : {0.4F, 0.78F})
  {
    SceneContents contents = matt(grey);
    const Picture plain = draw(contents, slanting());
    contents.light.toneCurve = true;
    EXPECT_EQ(countDifferentPixels(draw(contents, slanting()), plain), 0U) << grey;
  }
}

TEST(TonePicture, HighlightsKeepTheirShapeWhereTheyWereFlatWhite)
{
  SceneContents contents = hollowBall();
  contents.light.wetness = 1.0;
  contents.light.exposure = 1.0;
  const auto white = [](const Picture& picture)
  {
    int count = 0;
    for (std::size_t p = 0; p < picture.rgb.size(); p += 3)
      count += *std::min_element(picture.rgb.begin() + static_cast<std::ptrdiff_t>(p),
                                 picture.rgb.begin() + static_cast<std::ptrdiff_t>(p + 3)) == 255;
    return count;
  };
  EXPECT_GT(white(draw(contents, slanting())), 30);
  contents.light.toneCurve = true;
  EXPECT_EQ(white(draw(contents, slanting())), 0);
}

// White behind it is too bright for a display, and the sum of both is not: a stop doubles the light
// of that, too. Only what is displayed is clipped.
TEST(TonePicture, ExposureIsAFactorBehindAVeil)
{
  constexpr double kVeil = 0.06;       // opacity of 1 mm
  constexpr double kThickness = 11.75; // mm
  const double veil[] = {0.5, 0.2, 0.2};
  const double wall[] = {0.9, 0.8, 0.7};
  SceneContents contents = boneScene(
      ct<std::int16_t>(cube(48, 0.5), [](const Vector& p) { return p.y(); })); // bone: y > 0
  contents.materials = {{appearance::TransferFunction::constant({0.9F, 0.8F, 0.7F}, 1.0F, 0.0F)}};
  contents.softTissue = appearance::Material{
      appearance::TransferFunction::constant({0.5F, 0.2F, 0.2F}, static_cast<float>(kVeil), 0.0F)};
  contents.light.specular = 0.0;
  const core::CameraPose ahead = from({0.0, -200.0, 0.0}, {0.0, 0.0, 0.0}, 2.0);
  const double passes = std::pow(1.0 - kVeil, kThickness);
  const double inside = contents.light.ambient + (1.0 - contents.light.ambient) * 2.0 / 3.0;
  const auto see = [&] { return truthOf(contents, ahead, 8, 6); }; // its rays are slow here
  const auto middleOf = [](const ReferencePicture& truth, std::size_t c)
  { return static_cast<double>(truth.rgb[3 * (3 * 8 + 4) + c]); };
  const auto drawn = [&](std::size_t c)
  { return int{draw(contents, ahead).pixel(kWidth / 2, kHeight / 2)[c]}; };
  const ReferencePicture plain = see();
  for (const double stops : {0.0, 1.0, 1.5, 2.5})
  {
    contents.light.exposure = stops;
    const double factor = std::exp2(stops / 2.2);
    const ReferencePicture truth = see();
    for (std::size_t c = 0; c < 3; ++c)
    {
      const double wanted =
          factor * ((1.0 - passes) * inside * veil[c] + passes * wall[c]); // 0.62, 0.46, 0.41
      EXPECT_NEAR(middleOf(truth, c), std::min(wanted, 1.0), 2e-3) << stops << " " << c;
      EXPECT_NEAR(drawn(c), 255.0 * std::min(wanted, 1.0), 1.5) << stops << " " << c;
      if (wanted < 0.99)
      {
        EXPECT_NEAR(std::log2(std::pow(middleOf(truth, c) / middleOf(plain, c), 2.2)), stops, 1e-3)
            << stops << " " << c;
      }
    }
  }
  EXPECT_EQ(drawn(0), 255); // 2.5 EV
}

// A wall of the catalogue's bone across the view axis, 1400 HU at the surface, and a mesh of its
// colour, in the default light: c (1 - 0.18) + 0.18, of which 0.746 is diffuse.
TEST(TonePicture, CortexThatFacesTheLampIsNotBurntOut)
{
  SceneContents contents = boneScene(ct<std::int16_t>(cube(48, 0.5), [](const Vector& p)
                                                      { return p.y() > 0.0 ? 1400.0 : -1000.0; }));
  const appearance::StructureAppearance look = appearance::boneLook();
  contents.materials = {appearance::materialOf(look, {})};
  const auto cortex = look.transfer->at(1400.0).color;
  const auto expectCortex = [&](const char* what)
  {
    const Picture picture = draw(contents, from({0.0, -40.0, 0.0}, {0.0, 0.0, 0.0}, 7.5));
    const std::uint8_t* pixel = picture.pixel(kWidth / 2, kHeight / 2);
    for (std::size_t c = 0; c < 3; ++c)
      EXPECT_NEAR(int{pixel[c]}, 255.0 * (0.82 * cortex[c] + 0.18), 1.5) << what << " " << c;
    EXPECT_EQ(std::count(picture.rgb.begin(), picture.rgb.end(), 255), 0) << what;
  };
  expectCortex("bone");
  contents.light.setShadows(true);
  expectCortex("bone in shadows");
  contents.light.setShadows(false);
  const auto channel = [&cortex](std::size_t c) { return static_cast<float>(cortex[c]); };
  contents.meshes = {sheet({channel(0), channel(1), channel(2)}, -2.0F)};
  expectCortex("mesh");
}

// A wall across the view axis, with the focal point on it.
TEST(TonePicture, FalloffLeavesTheFocalPointAsBrightFromEveryDistance)
{
  SceneContents contents = boneScene(
      ct<std::int16_t>(cube(48, 0.5), [](const Vector& p) { return p.y(); })); // bone: y > 0
  contents.materials = {{appearance::TransferFunction::constant({0.6F, 0.5F, 0.4F}, 1.0F, 0.0F)}};
  contents.light.specular = 0.0;
  const auto middle = [&](double distance)
  {
    const core::CameraPose pose = from({0.0, -distance, 0.0}, {0.0, 0.0, 0.0}, 300.0 / distance);
    const Picture picture = draw(contents, pose);
    const std::uint8_t* pixel = picture.pixel(kWidth / 2, kHeight / 2);
    return std::array<int, 3>{pixel[0], pixel[1], pixel[2]};
  };
  for (const bool isMesh : {false, true})
  {
    contents.meshes.clear();
    if (isMesh)
      contents.meshes = {sheet({0.6F, 0.5F, 0.4F}, -0.01F)};
    contents.light.falloff = 0.0;
    const auto plain = middle(40.0);
    contents.light.falloff = 30.0;
    for (const double distance : {20.0, 40.0, 120.0})
      for (std::size_t c = 0; c < 3; ++c)
        EXPECT_NEAR(middle(distance)[c], plain[c], 1) << distance << " " << isMesh;
  }
}
