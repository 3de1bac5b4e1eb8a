#include <algorithm>
#include <chrono>
#include <cmath>
#include <functional>
#include <memory>
#include <ostream>
#include <utility>

#include "PictureComparison.h"
#include "PictureScenes.h"
#include "RandomScenes.h"
#include "petrous/Rendering/ScenePicture.h"

using namespace petrous;
using namespace petrous::rendering;
using namespace petrous::rendering::synthetic;
namespace strokes = petrous::rendering::testing;

namespace
{

constexpr int kColumns = 64;
constexpr int kRows = 48;

// White without highlight: of a light that is all ambient the picture is the sky that is seen, of
// one that is not at all, the lamp's part times the cosine.
SceneContents white(SceneContents contents, double ambient)
{
  for (appearance::Material& material : contents.materials)
    material.transfer = appearance::TransferFunction::constant({1.0F, 1.0F, 1.0F}, 1.0F, 0.0F);
  for (MeshContents& mesh : contents.meshes)
    mesh.look.color = {1.0F, 1.0F, 1.0F};
  contents.light.shadows = true;
  contents.light.ambient = ambient;
  contents.light.specular = 0.0;
  return contents;
}

// Bone behind y = -9, in which `hole(patient)` is the distance from what is missing; drilled, or so
// in the CT.
SceneContents holed(const std::function<double(const Vector&)>& hole, bool drilled,
                    const core::GridGeometry& grid)
{
  const auto block = [](const Vector& p) { return 9.0 + p.y(); };
  SceneContents contents;
  if (drilled)
  {
    contents = boneScene(ct<std::int16_t>(grid, block));
    contents.mask = cut(grid, hole);
  }
  else
    contents = boneScene(
        ct<std::int16_t>(grid, [&](const Vector& p) { return std::min(block(p), hole(p)); }));
  return contents;
}

// Two burr holes and a cavity between them, in the surface y = -9.
double holes(const Vector& p)
{
  return std::min({(p - Vector(0.0, -9.0, 0.0)).norm() - 6.0,
                   (p - Vector(8.5, -9.0, 3.0)).norm() - 2.0,
                   (p - Vector(-8.5, -8.0, -3.0)).norm() - 2.5});
}

// A shaft of 8 mm, 14 mm deep, widened at its floor.
double shaft(const Vector& p)
{
  const double aside = std::hypot(p.x(), p.z());
  return std::min(std::max(aside - 4.0, p.y() - 5.0), (p - Vector(0.0, 3.0, 2.0)).norm() - 5.0);
}

// A burr that touches the surface y = -9 beside the holes, or stands over it or in the shaft.
ToolPose tool(const Vector& center, double radius = 2.0)
{
  ToolPose pose;
  pose.center = center;
  pose.radius = radius;
  pose.axisToHand = Vector(0.6, -1.0, -0.2);
  return pose;
}

SceneContents with(SceneContents contents, const ToolPose& pose)
{
  contents.tool = pose;
  return contents;
}

ToolPose instrument(const Vector& tip)
{
  ToolPose pose = tool(tip);
  pose.instrument = boxMesh({-1.0, -1.5, 0.0}, {1.0, 1.5, 30.0});
  pose.rotation = Eigen::Quaterniond::FromTwoVectors(Vector::UnitZ(), pose.axisToHand) *
                  Eigen::AngleAxisd(0.7, Vector::UnitZ());
  return pose;
}

SceneContents with(SceneContents contents, std::shared_ptr<const core::TriangleMesh> mesh,
                   bool drilled = false)
{
  MeshContents added;
  added.name = "mesh";
  added.mesh = std::move(mesh);
  added.drilled = drilled;
  contents.meshes.push_back(std::move(added));
  return contents;
}

core::CameraPose above()
{
  core::CameraPose pose = from({10.0, -80.0, 14.0}, {0.0, -5.0, 0.0}, 20.0);
  return pose;
}

// Of a channel.
int greatestDifference(const Picture& a, const Picture& b)
{
  int most = 0;
  for (std::size_t n = 0; n < a.rgb.size(); ++n)
    most = std::max(most, std::abs(int{a.rgb[n]} - int{b.rgb[n]}));
  return most;
}

// An instrument that stands straight on the bone, beside what is seen: it is known by its shadow
// alone. The coarse picture of a window is the fine one.
struct BesideAnInstrument
{
  static constexpr int kWide = 320;
  static constexpr int kHigh = 240;

  BesideAnInstrument()
  {
    contents = holed(holes, true, cube(56, 0.5));
    contents.light.setShadows(true);
    pose = from({-5.0, -80.0, 9.0}, {-5.0, -9.0, 9.0}, 4.0);
    pose.viewUp = {0.0, 0.0, 1.0};
    quality.imageScale = InteractionQuality::kSmallestScale;
    quality.step = InteractionQuality::kMaxStep;
    quality.exactSamples = false;
    scene.setContents(contents);
    scene.setCamera(pose);
    scene.setQuality(quality);
    without = view.render(scene);
    scene.setProgressive(true);
  }

  static ToolPose standing(double x)
  {
    ToolPose tool = instrument({x, -9.5, 9.0});
    tool.axisToHand = -Vector::UnitY();
    tool.rotation = Eigen::Quaterniond::FromTwoVectors(Vector::UnitZ(), tool.axisToHand);
    return tool;
  }

  Picture atOnce(const ToolPose& tool) const
  {
    SceneContents wanted = contents;
    wanted.tool = tool;
    return shoot(wanted, pose, quality, kWide, kHigh).picture;
  }

  // The frames of a window.
  Picture shown()
  {
    const auto start = std::chrono::steady_clock::now();
    Picture picture = view.render(scene);
    while (scene.statistics().pendingShadow)
    {
      if (std::chrono::steady_clock::now() - start > std::chrono::minutes(2))
      {
        ADD_FAILURE() << "the shadow does not come";
        break;
      }
      scene.refine(5.0);
      picture = view.render(scene);
    }
    return picture;
  }

  SceneContents contents;
  core::CameraPose pose;
  RenderQuality quality;
  ScenePicture scene;
  OffscreenView view{kWide, kHigh};
  Picture without;
};

struct Error
{
  double rms = 0.0;
  double mean = 0.0;
  int pixels = 0;
};

Error errorOf(const Shot& shot, const ReferencePicture& truth)
{
  Error error;
  for (std::size_t p = 0; p < truth.depth.millimetres.size(); ++p)
  {
    if (!(std::abs(shot.depth.millimetres[p] - truth.depth.millimetres[p]) < 0.1F))
      continue;
    const double difference =
        shot.picture.rgb[3 * p] / 255.0 - static_cast<double>(truth.rgb[3 * p]);
    error.rms += difference * difference;
    error.mean += difference;
    ++error.pixels;
  }
  error.rms = std::sqrt(error.rms / std::max(error.pixels, 1));
  error.mean /= std::max(error.pixels, 1);
  return error;
}

// Of the pixels that show an opaque mesh or tool, as their neighbours do; with `shadowedIn`, of
// those that this picture has 20 levels brighter than the truth.
Error errorOfPolygons(const Picture& picture, const ReferencePicture& truth,
                      const Picture* shadowedIn = nullptr)
{
  const auto isPolygon = [&](int column, int row)
  {
    const std::size_t p = static_cast<std::size_t>(column + kColumns * row);
    const auto isDark = [](double value)
    { return std::abs(value - optics::kBackground[0]) < 0.01; };
    return std::isnan(truth.depth.millimetres[p]) &&
           !isDark(static_cast<double>(truth.rgb[3 * p])) && !isDark(picture.rgb[3 * p] / 255.0);
  };
  Error error;
  for (int row = 1; row + 1 < kRows; ++row)
    for (int column = 1; column + 1 < kColumns; ++column)
    {
      bool isInner = true;
      for (int n = 0; n < 9; ++n)
        isInner = isInner && isPolygon(column + n % 3 - 1, row + n / 3 - 1);
      const std::size_t p = static_cast<std::size_t>(column + kColumns * row);
      const double wanted = static_cast<double>(truth.rgb[3 * p]);
      if (!isInner || (shadowedIn && shadowedIn->rgb[3 * p] - 255.0 * wanted < 20.0))
        continue;
      const double difference = picture.rgb[3 * p] / 255.0 - wanted;
      error.rms += difference * difference;
      error.mean += difference;
      ++error.pixels;
    }
  error.rms = std::sqrt(error.rms / std::max(error.pixels, 1));
  error.mean /= std::max(error.pixels, 1);
  return error;
}

struct Case
{
  const char* name;
  std::function<SceneContents()> make;
};

std::ostream& operator<<(std::ostream& os, const Case& value)
{
  return os << value.name;
}

std::vector<Case> cases()
{
  return {
      {"Holes", [] { return holed(holes, false, cube(56, 0.5)); }},
      {"DrilledHoles", [] { return holed(holes, true, cube(56, 0.5, oblique())); }},
      {"DrilledShaft", [] { return holed(shaft, true, cube(56, 0.5)); }},
      {"AnisotropicGrid",
       []
       {
         return holed(holes, true,
                      core::GridGeometry({90, 90, 31}, {0.3, 0.3, 0.9}, {-13.35, -13.35, -13.5}));
       }},
      {"Structures", [] { return labelledBall(cube(64, 0.35, obliqueMirrored()), 1.0F); }},
      {"TranslucentStructure",
       []
       {
         SceneContents contents = labelledBall(cube(64, 0.35, obliqueMirrored()), 1.0F);
         contents.materials[2].surfaceOpacity = 0.4F;
         return contents;
       }},
      {"TranslucentBone",
       []
       {
         SceneContents contents = holed(holes, true, cube(56, 0.5));
         contents.materials = {boneMaterial(0.6F)};
         return contents;
       }},
      {"ClippingPlane",
       []
       {
         SceneContents contents = holed(holes, true, cube(56, 0.5));
         contents.clipping = {{{2.0, 0.0, 0.0}, Vector(-0.8, 0.0, 0.6)}};
         return contents;
       }},
      {"BurrOnTheSurface",
       [] {
         return with(holed(holes, true, cube(56, 0.5)), tool({0.0, -11.0, 9.0}, 2.0));
       }},
      {"BurrAboveTheSurface",
       [] {
         return with(holed(holes, true, cube(56, 0.5, oblique())), tool({-6.0, -14.0, 6.0}, 3.0));
       }},
      {"BurrInAShaft",
       [] {
         return with(holed(shaft, true, cube(56, 0.5)), tool({0.0, 1.0, 0.0}, 1.5));
       }},
      {"InstrumentOnTheSurface",
       [] {
         return with(holed(holes, true, cube(56, 0.5)), instrument({0.0, -9.5, 9.0}));
       }},
      {"MeshOverTheSurface",
       [] {
         return with(holed(holes, true, cube(56, 0.5)), ballMesh({-3.0, -12.0, 7.0}, 2.0));
       }},
      {"MeshInAShaft",
       [] {
         return with(holed(shaft, true, cube(56, 0.5, oblique())), ballMesh({0.5, 1.0, 1.0}, 2.0));
       }},
      {"DrilledMesh",
       []
       {
         // A plate on the bone, with the burr holes through it.
         return with(holed(holes, true, cube(56, 0.5)),
                     boxMesh({-12.0, -10.5, -4.0}, {12.0, -8.5, 4.0}), true);
       }},
      {"CropBox",
       []
       {
         SceneContents contents = holed(holes, true, cube(56, 0.5));
         contents.crop = core::IndexBox{{0, 0, 0}, {56, 56, 30}};
         return contents;
       }},
  };
}

} // namespace

class ShadowPicture : public ::testing::TestWithParam<Case>
{
};

INSTANTIATE_TEST_SUITE_P(Scenes, ShadowPicture, ::testing::ValuesIn(cases()),
                         [](const auto& test) { return std::string(test.param.name); });

TEST_P(ShadowPicture, SeesAboutAsMuchOfTheSkyAsManyRays)
{
  SceneContents contents = white(GetParam().make(), 1.0);
  const ReferencePicture truth = truthOf(contents, above(), kColumns, kRows);
  const Error error = errorOf(shoot(contents, above(), {}, kColumns, kRows), truth);
  EXPECT_GT(error.pixels, 500);
  EXPECT_LE(error.rms, 0.06);
  EXPECT_LE(std::abs(error.mean), 0.035);
  contents.light.shadows = false;
  EXPECT_GT(errorOf(shoot(contents, above(), {}, kColumns, kRows), truth).rms, 2.0 * error.rms);
}

TEST_P(ShadowPicture, SeesAboutAsMuchOfTheLampAsManyRays)
{
  SceneContents contents = white(GetParam().make(), 0.0);
  const ReferencePicture truth = truthOf(contents, above(), kColumns, kRows);
  const Shot shot = shoot(contents, above(), {}, kColumns, kRows);
  const Error error = errorOf(shot, truth);
  EXPECT_LE(error.rms, 0.04);
  EXPECT_LE(std::abs(error.mean), 0.01);
  contents.light.shadows = false;
  const Shot plain = shoot(contents, above(), {}, kColumns, kRows);
  double drawn = 0.0; // where there is shadow
  double without = 0.0;
  int shadowed = 0;
  for (std::size_t p = 0; p < truth.depth.millimetres.size(); ++p)
  {
    const double wanted = 255.0 * static_cast<double>(truth.rgb[3 * p]);
    if (std::isnan(truth.depth.millimetres[p]) || plain.picture.rgb[3 * p] - wanted < 20.0)
      continue;
    ++shadowed;
    drawn += std::abs(shot.picture.rgb[3 * p] - wanted);
    without += plain.picture.rgb[3 * p] - wanted;
  }
  EXPECT_GT(shadowed, 0);
  EXPECT_LE(drawn, 0.6 * without);
}

TEST(ShadowPicture, APlaneIsDrawnAsWithoutShadowsToTheBit)
{
  strokes::Random random(11);
  for (int n = 0; n < 12; ++n)
  {
    Vector normal(strokes::between(random, -1.0, 1.0), strokes::between(random, -1.0, 1.0),
                  strokes::between(random, -1.0, 1.0));
    if (n == 0)
      normal = {0.0, 0.0, 1.0};
    if (n == 1)
      normal = {1.0, 1.0, 1.0};
    normal.normalize();
    const double level = strokes::between(random, -1.0, 1.0);
    const double spacing = n % 2 == 0 ? 0.5 : 0.3;
    SceneContents contents =
        boneScene(ct<std::int16_t>(cube(static_cast<int>(28.0 / spacing), spacing),
                                   [&](const Vector& p) { return level - p.dot(normal); }));
    const Vector aside = normal.unitOrthogonal();
    core::CameraPose pose = from(60.0 * (normal + 0.5 * aside), {0.0, 0.0, 0.0}, 12.0);
    pose.viewUp = normal.cross(aside);
    const Picture plain = shoot(contents, pose, {}, kColumns, kRows).picture;
    contents.light.shadows = true;
    EXPECT_EQ(countDifferentPixels(plain, shoot(contents, pose, {}, kColumns, kRows).picture), 0U)
        << n;
  }
}

// In a shaft of 14 mm.
TEST(ShadowPicture, MeshAndToolSeeAboutAsMuchAsManyRays)
{
  const auto deep = [] { return holed(shaft, true, cube(56, 0.5)); };
  struct Scene
  {
    const char* name;
    SceneContents contents;
    double least; // ratio of the error without shadows
    double rms, mean;
  };
  // A mesh is in the field itself: what is taken for its own is more than a small ball's.
  const Scene scenes[] = {
      {"mesh", with(deep(), ballMesh({0.5, 1.5, 0.5}, 2.5, 96)), 2.0, 0.16, 0.15},
      {"burr", with(deep(), tool({0.0, 1.0, 0.0}, 2.0)), 1.0, 0.1, 0.06},
      {"instrument", with(deep(), instrument({0.0, 2.0, 0.0})), 1.0, 0.1, 0.06}};
  core::CameraPose into = from({6.0, -80.0, 6.0}, {0.0, -2.0, 0.0}, 9.0);
  into.viewUp = {0.0, 0.0, 1.0};
  for (const Scene& scene : scenes)
  {
    SceneContents contents = white(scene.contents, 1.0);
    const ReferencePicture truth = truthOf(contents, into, kColumns, kRows);
    const Error error = errorOfPolygons(shoot(contents, into, {}, kColumns, kRows).picture, truth);
    EXPECT_GT(error.pixels, 100) << scene.name;
    EXPECT_LE(error.rms, scene.rms) << scene.name;
    EXPECT_LE(std::abs(error.mean), scene.mean) << scene.name;
    contents.light.shadows = false;
    EXPECT_GT(errorOfPolygons(shoot(contents, into, {}, kColumns, kRows).picture, truth).rms,
              scene.least * error.rms)
        << scene.name;
  }
}

// A plate on the bone, below a burr, an instrument and a ball.
TEST(ShadowPicture, ShadowsFallOnAMeshAsByManyRays)
{
  const auto plateIn = [](const core::GridGeometry& grid)
  {
    return with(holed([](const Vector&) { return 50.0; }, false, grid),
                boxMesh({-12.0, -10.0, -12.0}, {12.0, -8.0, 12.0}));
  };
  const SceneContents plate = plateIn(cube(56, 0.5));
  // The ball must lie in the image, and hides most of its shadow.
  const SceneContents high = plateIn(cube(80, 0.5));
  const std::pair<const char*, SceneContents> scenes[] = {
      {"burr", with(plate, tool({-3.0, -16.0, 5.0}, 3.0))},
      {"instrument", with(plate, instrument({0.0, -13.0, 5.0}))},
      {"mesh", with(high, ballMesh({-3.0, -16.5, 5.0}, 3.0, 96))}};
  for (const auto& [name, scene] : scenes)
  {
    SceneContents contents = white(scene, 0.0);
    core::CameraPose pose = above();
    if (scene.meshes.size() > 1)
      pose = from({10.0, -80.0, 14.0}, {0.0, -5.0, 0.0}, 12.0);
    const ReferencePicture truth = truthOf(contents, pose, kColumns, kRows);
    const Picture shadowed = shoot(contents, pose, {}, kColumns, kRows).picture;
    EXPECT_LE(errorOfPolygons(shadowed, truth).rms, 0.08) << name;
    contents.light.shadows = false;
    const Picture plain = shoot(contents, pose, {}, kColumns, kRows).picture;
    const Error without = errorOfPolygons(plain, truth, &plain);
    EXPECT_GT(without.pixels, 10) << name;
    EXPECT_LE(errorOfPolygons(shadowed, truth, &plain).rms, 0.6 * without.rms) << name;
  }
}

// It is convex.
TEST(ShadowPicture, ABallOfTrianglesSeesAllOfTheSky)
{
  const auto nothing = [](const Vector&) { return -50.0; };
  SceneContents contents = white(
      with(holed(nothing, true, cube(56, 0.5, oblique())), ballMesh({0.0, 0.0, 0.0}, 6.0, 96)),
      1.0);
  const Picture shadowed = shoot(contents, above(), {}, kColumns, kRows).picture;
  contents.light.shadows = false;
  const Picture plain = shoot(contents, above(), {}, kColumns, kRows).picture;
  EXPECT_LE(greatestDifference(plain, shadowed), 1);
  EXPECT_EQ(*std::max_element(plain.rgb.begin(), plain.rgb.end()), 255);
}

// As a structure of the label field there.
TEST(ShadowPicture, AMeshInTranslucentBoneIsAsBrightAsWithoutShadows)
{
  SceneContents contents =
      boneScene(ct<std::int16_t>(cube(56, 0.5), [](const Vector& p) { return 12.0 - p.norm(); }));
  contents = white(with(std::move(contents), ballMesh({0.0, 0.0, 0.0}, 4.0, 96)), 1.0);
  // Green through a white surface.
  contents.materials = {{appearance::TransferFunction::constant({1.0F, 1.0F, 1.0F}, 0.0F, 0.0F),
                         appearance::IntensitySource::Ct, 0.2F}};
  contents.meshes[0].look.color = {0.0F, 1.0F, 0.0F};
  core::CameraPose pose = above();
  pose.focalPoint = {0.0, 0.0, 0.0};
  const Shot shot = shoot(contents, pose, {}, kColumns, kRows);
  const std::uint8_t* pixel = shot.picture.pixel(kColumns / 2, kRows / 2);
  EXPECT_NEAR(pixel[0], 0.2 * 255.0, 2.0);
  EXPECT_NEAR(pixel[1], 255.0, 2.0);
}

TEST(ShadowPicture, FollowsMeshesThatComeChangeAndGo)
{
  SceneContents contents = holed(holes, true, cube(56, 0.5));
  contents.light.setShadows(true);
  ScenePicture scene;
  scene.setContents(contents);
  scene.setCamera(above());
  OffscreenView view(kColumns, kRows);
  const Picture without = view.render(scene);
  SceneContents full = with(contents, ballMesh({-3.0, -12.0, 7.0}, 2.0));
  const auto expectFresh = [&](const SceneContents& wanted)
  {
    scene.setContents(wanted);
    EXPECT_EQ(countDifferentPixels(view.render(scene),
                                   shoot(wanted, above(), {}, kColumns, kRows).picture),
              0U);
  };
  expectFresh(full);
  EXPECT_GT(countDifferentPixels(without, view.render(scene)), 100U);
  full.meshes[0].look.opacity = 0.5F;
  expectFresh(full);
  full.meshes[0].look.shown = false;
  scene.setContents(full);
  EXPECT_EQ(countDifferentPixels(without, view.render(scene)), 0U);
  full.meshes[0].look.shown = true;
  full.meshes[0].look.opacity = 1.0F;
  expectFresh(full);
  scene.setContents(contents);
  EXPECT_EQ(countDifferentPixels(without, view.render(scene)), 0U);
}

TEST(ShadowPicture, AnInstrumentThatIsTakenUpThrowsItsShadowInTheSameFrame)
{
  SceneContents contents = holed(holes, true, cube(56, 0.5));
  contents.light.setShadows(true);
  ScenePicture scene;
  scene.setContents(contents);
  scene.setCamera(above());
  OffscreenView view(kColumns, kRows);
  const Picture without = view.render(scene);
  const ToolPose poses[] = {instrument({0.0, -9.5, 9.0}), tool({0.0, -11.0, 9.0}),
                            instrument({4.0, -9.5, 6.0})};
  for (const ToolPose& pose : poses)
  {
    scene.setTool(pose);
    const Picture picture = view.render(scene);
    EXPECT_GT(countDifferentPixels(without, picture), 300U);
    EXPECT_EQ(countDifferentPixels(
                  picture, shoot(with(contents, pose), above(), {}, kColumns, kRows).picture),
              0U);
  }
  scene.setTool(std::nullopt);
  EXPECT_EQ(countDifferentPixels(without, view.render(scene)), 0U);
}

TEST(ShadowPicture, InAWindowAnInstrumentThrowsItsShadowOnceThatIsMeasured)
{
  BesideAnInstrument window;
  const ToolPose tool = BesideAnInstrument::standing(-0.3);
  const Picture atOnce = window.atOnce(tool);
  ASSERT_GT(greatestDifference(atOnce, window.without), 5);
  window.view.render(window.scene);
  EXPECT_FALSE(window.scene.statistics().pendingShadow);
  window.scene.setTool(tool);
  EXPECT_LE(greatestDifference(window.view.render(window.scene), window.without), 1);
  EXPECT_TRUE(window.scene.statistics().pendingShadow);
  EXPECT_EQ(countDifferentPixels(window.shown(), atOnce), 0U);
  // At rest, too.
  for (Refinement next = Refinement::More; next == Refinement::More;)
    next = window.scene.refine(1000.0);
  EXPECT_GT(2 * greatestDifference(window.view.render(window.scene), window.without),
            greatestDifference(atOnce, window.without));
  EXPECT_EQ(window.scene.restSamples(), 1);
  // It is known when it is taken up again.
  window.scene.setTool(std::nullopt);
  EXPECT_LE(greatestDifference(window.view.render(window.scene), window.without), 1);
  window.scene.setTool(tool);
  EXPECT_EQ(countDifferentPixels(window.view.render(window.scene), atOnce), 0U);
  EXPECT_FALSE(window.scene.statistics().pendingShadow);
}

TEST(ShadowPicture, AnInstrumentThatIsTakenAwayGoesOnBeingMeasured)
{
  BesideAnInstrument window;
  const ToolPose tool = BesideAnInstrument::standing(-0.3);
  window.scene.setTool(tool);
  window.view.render(window.scene);
  ASSERT_TRUE(window.scene.statistics().pendingShadow);
  window.scene.setTool(std::nullopt);
  EXPECT_LE(greatestDifference(window.view.render(window.scene), window.without), 1);
  EXPECT_FALSE(window.scene.statistics().pendingShadow);
  window.scene.setTool(tool);
  EXPECT_EQ(countDifferentPixels(window.shown(), window.atOnce(tool)), 0U);
  // Another context has to upload it.
  window.scene.attach(nullptr);
  OffscreenView next(BesideAnInstrument::kWide, BesideAnInstrument::kHigh);
  next.render(window.scene);
  EXPECT_TRUE(window.scene.statistics().pendingShadow);
  window.scene.setProgressive(false); // waits for it
  EXPECT_EQ(countDifferentPixels(next.render(window.scene), window.atOnce(tool)), 0U);
  EXPECT_FALSE(window.scene.statistics().pendingShadow);
}

TEST(ShadowPicture, AnInstrumentThatIsChangedWhileItIsMeasuredThrowsTheShadowOfTheOther)
{
  BesideAnInstrument window;
  const ToolPose first = BesideAnInstrument::standing(-0.3);
  ToolPose second = BesideAnInstrument::standing(-0.3);
  second.instrument = boxMesh({-1.2, -0.5, 0.0}, {1.2, 0.5, 30.0});
  const Picture atOnce = window.atOnce(second);
  ASSERT_GT(countDifferentPixels(atOnce, window.atOnce(first)), 100U);
  window.scene.setTool(first);
  window.view.render(window.scene);
  window.scene.setTool(second);
  EXPECT_LE(greatestDifference(window.view.render(window.scene), window.without), 1);
  EXPECT_TRUE(window.scene.statistics().pendingShadow);
  EXPECT_EQ(countDifferentPixels(window.shown(), atOnce), 0U);
  // No shadows, nothing to measure.
  window.scene.setTool(first);
  window.view.render(window.scene);
  EXPECT_TRUE(window.scene.statistics().pendingShadow);
  window.contents.tool = first;
  window.contents.light.setShadows(false);
  window.scene.setContents(window.contents);
  window.view.render(window.scene);
  EXPECT_FALSE(window.scene.statistics().pendingShadow);
}

// The closed form of SurfaceShadowsTest.
TEST(ShadowPicture, AtTheBottomOfAPitTheSkyIsThatOfTheClosedForm)
{
  for (const double a : {2.0, 4.0, 6.0})
  {
    SceneContents contents =
        white(holed([=](const Vector& p) { return (p - Vector(0.0, -9.0, 0.0)).norm() - a; }, true,
                    cube(112, 0.25)),
              1.0);
    core::CameraPose pose = from({0.0, -80.0, 0.0}, {0.0, 0.0, 0.0}, 1.0);
    pose.viewUp = {0.0, 0.0, 1.0};
    const Shot shot = shoot(contents, pose, {}, 8, 8);
    ASSERT_NEAR(shot.depth.at(4, 4), 71.0 + a, 0.1);
    const double reach = 0.5 * a / optics::kOcclusionReach;
    EXPECT_NEAR(shot.picture.pixel(4, 4)[0] / 255.0, 0.5 + 2.0 * reach * reach, 0.14) << a;
  }
}

TEST(ShadowPicture, FollowsTheCutAndItsUndoToTheBit)
{
  SceneContents contents = holed(holes, true, cube(56, 0.5));
  contents.light.setShadows(true);
  const auto first = contents.mask;
  const auto second =
      cut(contents.ct->geometry(), [](const Vector& p) { return std::min(holes(p), shaft(p)); });
  ScenePicture scene;
  scene.setContents(contents);
  scene.setCamera(above());
  OffscreenView view(kColumns, kRows);
  const Picture before = view.render(scene);
  const core::GridGeometry& grid = contents.ct->geometry();
  // In parts, as strokes come.
  const core::IndexBox left{{0, 0, 0}, {20, 56, 56}};
  const core::IndexBox right{{20, 0, 0}, {56, 56, 56}};
  scene.maskChanged(second, left);
  scene.maskChanged(second, right);
  const Picture after = view.render(scene);
  EXPECT_GT(countDifferentPixels(before, after), 100U);
  SceneContents fresh = contents;
  fresh.mask = second;
  EXPECT_EQ(countDifferentPixels(after, shoot(fresh, above(), {}, kColumns, kRows).picture), 0U);
  scene.maskChanged(first, grid.fullBox());
  EXPECT_EQ(countDifferentPixels(before, view.render(scene)), 0U);
  fresh.mask = first;
  fresh.iso += 200.0; // and what is solid
  scene.setContents(fresh);
  EXPECT_EQ(
      countDifferentPixels(view.render(scene), shoot(fresh, above(), {}, kColumns, kRows).picture),
      0U);
}

TEST(ShadowPicture, FollowsTheToolInTheSameFrame)
{
  SceneContents contents = holed(holes, true, cube(56, 0.5));
  contents.light.setShadows(true);
  ScenePicture scene;
  scene.setContents(contents);
  scene.setCamera(above());
  OffscreenView view(kColumns, kRows);
  const Picture without = view.render(scene);
  for (const Vector& center : {Vector(0.0, -11.0, 9.0), Vector(4.0, -12.0, 6.0)})
  {
    scene.setTool(tool(center));
    const Picture picture = view.render(scene);
    EXPECT_GT(countDifferentPixels(without, picture), 300U);
    EXPECT_EQ(
        countDifferentPixels(
            picture, shoot(with(contents, tool(center)), above(), {}, kColumns, kRows).picture),
        0U);
  }
  scene.setTool(std::nullopt);
  EXPECT_EQ(countDifferentPixels(without, view.render(scene)), 0U);
}

TEST(ShadowPicture, TakesNothingWhereThereAreNone)
{
  SceneContents contents = holed(holes, true, cube(56, 0.5));
  const auto hasShadows = [](const Shot& shot)
  {
    const auto& names = shot.statistics.variant;
    const bool compiled = std::count(names.begin(), names.end(), "shadows") > 0;
    EXPECT_EQ(shot.statistics.resources.count("light.opacities") > 0, compiled);
    return compiled;
  };
  ScenePicture scene;
  scene.setCamera(above());
  OffscreenView view(kColumns, kRows);
  for (const bool on : {false, true, false})
  {
    contents.light.shadows = on;
    scene.setContents(contents);
    EXPECT_EQ(hasShadows(shoot(view, scene)), on);
  }
}

// A plane near the CT's border: the lamp's cone is left where nothing of the bone is ahead, 3 mm
// and a texel above it, with a look-up each millimetre from 0.6 mm on; with the nine of the sky and
// a fourth towards the lamp that is 13 at most.
TEST(ShadowPicture, LooksTowardsTheLampNoFartherThanThereIsAnythingInItsWay)
{
  const auto fetches = [](SceneContents contents, bool shadows)
  {
    contents.light.shadows = shadows;
    RenderQuality exact;
    exact.filterBits = RenderQuality::kExactFilterBits;
    ScenePicture scene;
    scene.setContents(contents);
    scene.setCamera(above());
    scene.setQuality(exact);
    scene.setCounting(true);
    OffscreenView view(kColumns, kRows);
    view.render(scene);
    return scene.statistics().fetchesPerPixel;
  };
  const auto plane = [](const Vector&) { return 50.0; };
  const SceneContents flat = holed(plane, false, cube(56, 0.5));
  const DepthImage depth = shoot(flat, above(), {}, kColumns, kRows).depth;
  const auto isHit = [](float millimetres) { return !std::isnan(millimetres); };
  const double hit = static_cast<double>(
                         std::count_if(depth.millimetres.begin(), depth.millimetres.end(), isHit)) /
                     static_cast<double>(depth.millimetres.size());
  ASSERT_GT(hit, 0.5);
  const double looks = (fetches(flat, true) - fetches(flat, false)) / hit;
  EXPECT_LE(looks, 13.0);
  EXPECT_GT(looks, 9.0);
  // With a small mesh on the way the cone is followed to it.
  const SceneContents over = with(flat, ballMesh({-3.0, -13.0, 7.0}, 1.0));
  EXPECT_GT(fetches(over, true) - fetches(over, false), hit * looks + 0.5);
}

// The border of what is drawn is none of the patient's.
TEST(ShadowPicture, DoesNotDarkenAFaceOfAClippingPlane)
{
  SceneContents contents = hollowBall();
  contents.clipping = {{{0.0, 0.0, 0.0}, {0.0, 1.0, 0.0}}}; // seen from -y: one face
  const core::CameraPose pose = from({0.0, -60.0, 0.0}, {0.0, 0.0, 0.0}, 8.0);
  const Picture plain = shoot(contents, pose, {}, kColumns, kRows).picture;
  contents.light.shadows = true;
  EXPECT_EQ(countDifferentPixels(plain, shoot(contents, pose, {}, kColumns, kRows).picture), 0U);
}
