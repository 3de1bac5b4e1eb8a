#include <array>
#include <cmath>

#include "PictureComparison.h"
#include "PictureScenes.h"

using namespace petrous;
using namespace petrous::rendering;
using namespace petrous::rendering::synthetic;

namespace
{

/// Skin, fat and muscle over the intensities that the shells of the scenes' bones have.
appearance::Material shells(double scale = 1.0)
{
  const auto opacity = [scale](double of) { return static_cast<float>(of * scale); };
  return {appearance::TransferFunction({{-900.0, {0.9F, 0.7F, 0.6F}, 0.0F},
                                        {-500.0, {0.9F, 0.7F, 0.6F}, opacity(0.3)},
                                        {-300.0, {0.9F, 0.85F, 0.5F}, opacity(0.02)},
                                        {0.0, {0.6F, 0.2F, 0.15F}, opacity(0.2)},
                                        {200.0, {0.5F, 0.15F, 0.1F}, opacity(0.25)}})};
}

SceneContents withShells(SceneContents contents)
{
  contents.softTissue = shells();
  return contents;
}

/// All of one intensity, 16 mm wide.
SceneContents block(double value, float opacity, const core::GridGeometry& grid)
{
  SceneContents contents;
  contents.ct = image(grid, [value](const Vector&) { return value; });
  contents.softTissue =
      appearance::Material{appearance::TransferFunction::constant({0.8F, 0.4F, 0.2F}, opacity)};
  return contents;
}

/// RMS of all pixels, 1/255, and the largest difference of a channel.
struct Error
{
  double rms = 0.0;
  double most = 0.0;
};

Error errorOf(const Picture& picture, const ReferencePicture& truth)
{
  Error error;
  for (std::size_t n = 0; n < truth.rgb.size(); ++n)
  {
    const double off = std::abs(picture.rgb[n] - 255.0 * static_cast<double>(truth.rgb[n]));
    error.rms += off * off;
    error.most = std::max(error.most, off);
  }
  error.rms = std::sqrt(error.rms / static_cast<double>(truth.rgb.size()));
  return error;
}

struct Named
{
  const char* name;
  SceneContents contents;
};

SceneContents softSecond()
{
  SceneContents contents = hollowBall(oblique());
  contents.second = movedWaves();
  contents.softTissue = waveMaterial(0.0F);
  contents.softTissue->transfer =
      appearance::TransferFunction({{200.0, {0.1F, 0.1F, 0.9F}, 0.0F},
                                    {500.0, {0.2F, 0.9F, 0.3F}, 0.05F},
                                    {800.0, {0.9F, 0.9F, 0.2F}, 0.15F}});
  return contents;
}

SceneContents softThird()
{
  SceneContents contents = fullSceneOfThree();
  contents.softTissue = softSecond().softTissue;
  contents.softTissue->source = appearance::IntensitySource::Third;
  return contents;
}

SceneContents clipped()
{
  SceneContents contents = cutBall(0.35F);
  contents.clipping = {{Vector(0.0, 0.0, 2.0), Vector(0.2, -0.3, -1.0).normalized()}};
  contents.crop = core::IndexBox{{4, 0, 0}, {44, 48, 48}};
  return contents;
}

SceneContents shadowed()
{
  SceneContents contents = cutBall();
  contents.light.setShadows(true);
  return contents;
}

SceneContents withoutBone()
{
  SceneContents contents = labelledBall(cube(48, 0.5));
  contents.boneShown = false;
  return contents;
}

std::vector<Named> scenes()
{
  return {{"opaque", withShells(hollowBall())},
          {"translucent", withShells(translucentBall())},
          {"structures", withShells(labelledBall(cube(48, 0.5), 1.0F))},
          {"cut", withShells(cutBall())},
          {"all", withShells(fullScene())},
          {"clipped", withShells(clipped())},
          {"shadows", withShells(shadowed())},
          {"noBone", withShells(withoutBone())},
          {"secondImage", softSecond()},
          {"thirdImage", softThird()}};
}

} // namespace

class SoftTissue : public ::testing::TestWithParam<Named>
{
};

TEST_P(SoftTissue, KeepsToTheReference)
{
  const SceneContents& contents = GetParam().contents;
  const ReferencePicture truth = truthOf(contents, slanting());
  const Shot shot = shoot(contents, slanting());
  const Error error = errorOf(shot.picture, truth);
  RecordProperty("rms", std::to_string(error.rms));
  RecordProperty("most", std::to_string(error.most));
  SceneContents without = contents;
  without.softTissue.reset();
  const ReferencePicture surfacesAlone = truthOf(without, slanting());
  // Shadows have an error of their own (record 33).
  const double shadows =
      contents.light.shadows ? errorOf(shoot(without, slanting()).picture, surfacesAlone).rms : 0.0;
  EXPECT_LE(error.rms, 1.0 + shadows) << "largest " << error.most;
  const Agreement agreement = compare(shot, truth, contents.ct->geometry().minSpacing());
  EXPECT_LE(agreement.others, 0.2);
  // It is there, and hides no surface from the depth.
  EXPECT_GT(errorOf(shot.picture, surfacesAlone).rms, 5.0);
  const Agreement surfaces = compare(shot, surfacesAlone, contents.ct->geometry().minSpacing());
  EXPECT_LE(surfaces.others, 0.2);
}

INSTANTIATE_TEST_SUITE_P(Scenes, SoftTissue, ::testing::ValuesIn(scenes()),
                         [](const auto& named) { return std::string(named.param.name); });

// Uniform tissue of extinction s: the light of it and what it lets through, 1 - exp(-s d).
TEST(SoftTissueBlock, IsTheIntegralOfItsTransferFunction)
{
  constexpr float kOpacity = 0.08F;
  const SceneContents contents = block(40.0, kOpacity, cube(33, 0.5));
  core::CameraPose ahead;
  ahead.position = {0.0, -200.0, 0.0};
  ahead.focalPoint = {0.0, 0.0, 0.0};
  ahead.viewUp = {0.0, 0.0, 1.0};
  ahead.viewAngle = 2.0; // all rays are through both faces
  const double opacity = 1.0 - std::pow(1.0 - static_cast<double>(kOpacity), 16.0);
  const LightSettings light;
  const double lamp = light.ambient + (1.0 - light.ambient) * optics::kInteriorFacing;
  const Picture picture = draw(contents, ahead);
  const ReferencePicture truth = truthOf(contents, ahead);
  const double color[] = {0.8, 0.4, 0.2};
  for (std::size_t c = 0; c < 3; ++c)
  {
    const double expected = opacity * lamp * color[c] + (1.0 - opacity) * optics::kBackground[c];
    const std::size_t middle =
        3 * (static_cast<std::size_t>(kHeight / 2) * kWidth + kWidth / 2) + c;
    EXPECT_NEAR(static_cast<double>(truth.rgb[middle]), expected, 1e-3);
    EXPECT_NEAR(picture.rgb[middle], 255.0 * expected, 1.0);
  }
}

// A half of the block is cut away: rays pass through the other 8 mm.
TEST(SoftTissueBlock, IsNotWhereItWasCutAway)
{
  SceneContents contents = block(40.0, 0.08F, cube(33, 0.5));
  contents.mask = cut(contents.ct->geometry(), [](const Vector& p) { return p.y(); });
  core::CameraPose ahead;
  ahead.position = {0.0, -200.0, 0.0};
  ahead.focalPoint = {0.0, 0.0, 0.0};
  ahead.viewUp = {0.0, 0.0, 1.0};
  ahead.viewAngle = 2.0;
  const double opacity = 1.0 - std::pow(1.0 - 0.08, 8.0);
  const LightSettings light;
  const double lamp = light.ambient + (1.0 - light.ambient) * optics::kInteriorFacing;
  const double expected = opacity * lamp * 0.8 + (1.0 - opacity) * optics::kBackground[0];
  const std::size_t middle = 3 * (static_cast<std::size_t>(kHeight / 2) * kWidth + kWidth / 2);
  EXPECT_NEAR(static_cast<double>(truthOf(contents, ahead).rgb[middle]), expected, 2e-3);
  EXPECT_NEAR(draw(contents, ahead).rgb[middle], 255.0 * expected, 1.5);
}

namespace
{

core::CameraPose ahead()
{
  core::CameraPose pose;
  pose.position = {0.0, -200.0, 0.0};
  pose.focalPoint = {0.0, 0.0, 0.0};
  pose.viewUp = {0.0, 0.0, 1.0};
  pose.viewAngle = 2.0;
  return pose;
}

RenderStatistics counted(const SceneContents& contents, const core::CameraPose& pose)
{
  RenderQuality exact;
  exact.filterBits = RenderQuality::kExactFilterBits;
  ScenePicture scene;
  scene.setContents(contents);
  scene.setCamera(pose);
  scene.setQuality(exact);
  scene.setCounting(true);
  OffscreenView view(kWidth, kHeight);
  view.render(scene);
  return scene.statistics();
}

// Of a reference picture, whose rays of a block are slow.
constexpr int kFewColumns = 8;
constexpr int kFewRows = 6;
constexpr std::size_t kMiddle = 3 * (kFewRows / 2 * kFewColumns + kFewColumns / 2);

} // namespace

// 40 HU in the window of 4000 HU about 700 HU, whatever lamp and veil.
TEST(SoftTissueSection, IsTheCtInGreyWhereCropBoxAndPlanesCut)
{
  SceneContents cropped = block(40.0, 0.08F, cube(33, 0.5));
  cropped.section = SectionWindow{4000.0, 700.0};
  cropped.light.exposure = 1.0;
  SceneContents clipped = cropped;
  cropped.crop = core::IndexBox{{0, 4, 0}, {33, 33, 33}};
  clipped.clipping = {{{0.0, -6.0, 0.0}, {0.0, 1.0, 0.0}}};
  for (const SceneContents& contents : {cropped, clipped})
  {
    const ReferencePicture truth = truthOf(contents, ahead(), kFewColumns, kFewRows);
    const Shot shot = shoot(contents, ahead());
    const std::uint8_t* pixel = shot.picture.pixel(kWidth / 2, kHeight / 2);
    for (std::size_t c = 0; c < 3; ++c)
    {
      EXPECT_NEAR(static_cast<double>(truth.rgb[kMiddle + c]), 0.335, 1e-6);
      EXPECT_NEAR(pixel[c], 255.0 * 0.335, 0.6);
    }
    EXPECT_NEAR(static_cast<double>(truth.depth.at(kFewColumns / 2, kFewRows / 2)), 194.0, 0.01);
    EXPECT_NEAR(static_cast<double>(shot.depth.at(kWidth / 2, kHeight / 2)), 194.0, 0.01);
    // The ray ends there: the CT, two texels of the material and two of its table.
    EXPECT_LE(counted(contents, ahead()).fetchesPerPixel, 6.0);
  }
}

// What the MR shows cannot be seen in the CT's grey.
TEST(SoftTissueSection, HasTheColourOfTheMrThatItReads)
{
  SceneContents contents = block(40.0, 0.08F, cube(33, 0.5));
  contents.section = SectionWindow{4000.0, 700.0};
  contents.light.exposure = 1.0;
  contents.second.volume = image(cube(33, 0.5), [](const Vector&) { return 300.0; });
  contents.softTissue->source = appearance::IntensitySource::Second;
  contents.softTissue->transfer = appearance::TransferFunction(
      {{100.0, {0.2F, 0.2F, 0.2F}, 0.05F}, {500.0, {0.8F, 0.8F, 0.8F}, 0.05F}});
  contents.clipping = {{{0.0, -6.0, 0.0}, {0.0, 1.0, 0.0}}};
  const ReferencePicture truth = truthOf(contents, ahead(), kFewColumns, kFewRows);
  const Picture picture = draw(contents, ahead());
  for (std::size_t c = 0; c < 3; ++c)
  {
    EXPECT_NEAR(static_cast<double>(truth.rgb[kMiddle + c]), 0.5, 1e-6);
    EXPECT_NEAR(picture.pixel(kWidth / 2, kHeight / 2)[c], 127.5, 1.0);
  }
}

TEST(SoftTissueSection, IsNoneWhereNothingIsCutOrSeen)
{
  SceneContents contents = block(40.0, 0.08F, cube(33, 0.5));
  const auto drawn = [](const SceneContents& scene, const core::CameraPose& pose)
  {
    const Picture picture = draw(scene, pose);
    const std::uint8_t* pixel = picture.pixel(kWidth / 2, kHeight / 2);
    return std::array<int, 3>{pixel[0], pixel[1], pixel[2]};
  };
  const auto expectNoFace = [&](SceneContents scene, const core::CameraPose& pose)
  {
    const auto without = drawn(scene, pose);
    scene.section = SectionWindow{4000.0, 700.0};
    EXPECT_EQ(drawn(scene, pose), without);
    const ReferencePicture truth = truthOf(scene, pose, kFewColumns, kFewRows);
    for (std::size_t c = 0; c < 3; ++c)
      EXPECT_NEAR(without[c], 255.0 * static_cast<double>(truth.rgb[kMiddle + c]), 1.5);
  };
  expectNoFace(contents, ahead()); // the CT's own border
  contents.clipping = {{{0.0, -6.0, 0.0}, {0.0, 1.0, 0.0}}};
  core::CameraPose within = ahead();
  within.position = {0.0, -3.0, 0.0};
  expectNoFace(contents, within);
  contents.softTissue = block(40.0, 0.001F, cube(33, 0.5)).softTissue;
  expectNoFace(contents, ahead());
}

// In the colours of another image where soft tissue reads one; air stays open.
TEST(SoftTissueSection, KeepsToTheReference)
{
  const auto cutOpen = [](SceneContents contents)
  {
    contents.clipping = {{Vector(0.0, 0.0, 2.0), Vector(0.2, -0.3, -1.0).normalized()}};
    contents.crop = core::IndexBox{{4, 0, 0}, {44, 48, 48}};
    contents.section = SectionWindow{4000.0, 700.0};
    contents.light.exposure = 0.5;
    return contents;
  };
  const Named scenes[] = {{"opaque", cutOpen(withShells(hollowBall(oblique())))},
                          {"translucent", cutOpen(withShells(translucentBall()))},
                          {"structures", cutOpen(withShells(labelledBall(cube(48, 0.5), 1.0F)))},
                          {"cut", cutOpen(withShells(cutBall(0.35F)))},
                          {"secondImage", cutOpen(softSecond())}};
  for (const Named& scene : scenes)
  {
    const ReferencePicture truth = truthOf(scene.contents, slanting());
    const Shot shot = shoot(scene.contents, slanting());
    const Error error = errorOf(shot.picture, truth);
    EXPECT_LE(error.rms, 1.5) << scene.name << " " << error.most;
    const Agreement agreement = compare(shot, truth, 0.5);
    EXPECT_GT(agreement.hits, 900) << scene.name;
    // Where a face has an edge of its own: to an entry of the table, 0.05 mm here.
    EXPECT_LE(agreement.others, 0.4) << scene.name;
    EXPECT_LE(agreement.rms, 1.5) << scene.name;
    SceneContents open = scene.contents;
    open.section.reset();
    EXPECT_GT(errorOf(shot.picture, truthOf(open, slanting())).rms, 5.0) << scene.name;
    EXPECT_LT(counted(scene.contents, slanting()).fetchesPerPixel,
              counted(open, slanting()).fetchesPerPixel)
        << scene.name;
  }
}

// Skin is lit as a surface: brighter where it faces the lamp than at its silhouette.
TEST(SoftTissueBlock, ASteepChangeIsLitAsASurface)
{
  const appearance::TransferFunction& transfer = shells().transfer;
  const double edge = optics::softEdge(transfer);
  EXPECT_DOUBLE_EQ(edge, 1100.0 / 20.0);
  const Vector ray(0.0, 1.0, 0.0);
  EXPECT_DOUBLE_EQ(optics::softFacing(Vector::Zero(), ray, edge), optics::kInteriorFacing);
  EXPECT_DOUBLE_EQ(optics::softFacing(Vector(0.0, edge, 0.0), ray, edge),
                   0.5 * (optics::kInteriorFacing + 1.0));
  EXPECT_NEAR(optics::softFacing(Vector(1e6, 0.0, 0.0), ray, edge), 0.0, 1e-4);
  EXPECT_NEAR(optics::softFacing(Vector(0.0, -1e6, 0.0), ray, edge), 1.0, 1e-4);
  EXPECT_DOUBLE_EQ(optics::softFacing(Vector(1e6, 0.0, 0.0), ray, 0.0), optics::kInteriorFacing);
}

TEST(SoftTissueVariant, CostsNothingWhereItHasNoOpacity)
{
  SceneContents contents = hollowBall();
  const Shot without = shoot(contents, slanting());
  contents.softTissue = shells(0.0);
  const Shot transparent = shoot(contents, slanting());
  EXPECT_EQ(transparent.statistics.variant, without.statistics.variant);
  EXPECT_EQ(transparent.picture.rgb, without.picture.rgb);
  contents.softTissue = shells();
  EXPECT_EQ(shoot(contents, slanting()).statistics.variant,
            (std::vector<std::string>{"ct", "bone", "interior", "soft tissue"}));
}

// Between the skin and a far bone is nothing to see: it is leapt over.
TEST(SoftTissueVariant, IsLeaptOverWhereItIsTransparent)
{
  const core::GridGeometry grid = cube(96, 0.5);
  const auto counted = [&](const appearance::Material& soft)
  {
    SceneContents contents;
    contents.ct = image(grid,
                        [](const Vector& p)
                        {
                          const double r = p.norm();
                          return r < 4.0 ? 1000.0 : r < 20.0 ? 40.0 : -1000.0;
                        });
    contents.iso = kIso;
    contents.materials = {boneMaterial()};
    contents.softTissue = soft;
    RenderQuality exact;
    exact.filterBits = RenderQuality::kExactFilterBits;
    ScenePicture scene;
    scene.setContents(contents);
    scene.setCamera(slanting());
    scene.setQuality(exact);
    scene.setCounting(true);
    OffscreenView view(kWidth, kHeight);
    view.render(scene);
    return scene.statistics().samplesPerPixel;
  };
  const double everywhere = counted({appearance::TransferFunction(
      {{-900.0, {1.0F, 1.0F, 1.0F}, 0.0F}, {40.0, {1.0F, 1.0F, 1.0F}, 0.01F}})});
  const double skin = counted({appearance::TransferFunction({{-900.0, {1.0F, 1.0F, 1.0F}, 0.0F},
                                                             {-500.0, {1.0F, 1.0F, 1.0F}, 0.02F},
                                                             {0.0, {1.0F, 1.0F, 1.0F}, 0.0F}})});
  EXPECT_LT(skin, 0.5 * everywhere);
}

// It stops no light of the lamp: what does is measured anew only where bone is another.
TEST(SoftTissueVariant, LeavesWhatStopsTheLightAsItWasMeasured)
{
  SceneContents contents = shadowed();
  ScenePicture scene;
  scene.setCamera(slanting());
  OffscreenView view(kWidth, kHeight);
  const auto shown = [&]
  {
    const Picture picture = view.render(scene);
    EXPECT_EQ(countDifferentPixels(picture, draw(contents, slanting())), 0U);
    return scene.statistics().opacityRebuilds;
  };
  const auto set = [&]
  {
    scene.setContents(contents);
    return shown();
  };
  EXPECT_EQ(set(), 1U);
  EXPECT_EQ(set(), 1U);
  contents.softTissue = shells();
  EXPECT_EQ(set(), 1U);
  contents.softTissue->transfer = appearance::TransferFunction(
      {{0.0, {0.6F, 0.2F, 0.15F}, 0.0F}, {200.0, {0.5F, 0.15F, 0.1F}, 0.25F}});
  EXPECT_EQ(set(), 1U) << "other bricks of it have opacity";
  contents.materials.front().transfer =
      appearance::TransferFunction::constant({0.9F, 0.8F, 0.7F}, 0.5F);
  EXPECT_EQ(set(), 1U) << "a colour of bone";
  contents.iso += 200.0;
  EXPECT_EQ(set(), 2U);
  contents.materials.front().surfaceOpacity = 0.5F;
  EXPECT_EQ(set(), 3U);
  contents.boneShown = false;
  EXPECT_EQ(set(), 4U);
  contents.boneShown = true;
  EXPECT_EQ(set(), 5U);
  contents.mask = nullptr;
  EXPECT_EQ(set(), 6U);
  contents.softTissue.reset();
  EXPECT_EQ(set(), 6U);
  // A cut is measured where it is; with bricks that are not known yet, everywhere.
  const core::IndexBox all = contents.ct->geometry().fullBox();
  contents.mask = cut(contents.ct->geometry(), cavity);
  scene.maskChanged(contents.mask, all);
  EXPECT_EQ(shown(), 6U);
  contents.softTissue = shells();
  scene.setContents(contents);
  contents.mask = cut(contents.ct->geometry(),
                      [](const Vector& p) { return (p - Vector(0.0, -8.0, 0.0)).norm() - 4.0; });
  scene.maskChanged(contents.mask, all);
  EXPECT_EQ(shown(), 7U);
  contents.light.setShadows(false);
  EXPECT_EQ(set(), 7U);
  contents.light.setShadows(true);
  EXPECT_EQ(set(), 8U);
}
