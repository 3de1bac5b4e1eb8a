#include <algorithm>
#include <functional>

#include "PictureComparison.h"
#include "PictureScenes.h"
#include "petrous/Rendering/ScenePicture.h"

using namespace petrous;
using namespace petrous::rendering;
using namespace petrous::rendering::synthetic;

namespace
{

constexpr int kColumns = 160;
constexpr int kRows = 120;

SceneContents withExits(SceneContents contents)
{
  contents.light.exitSurfaces = true;
  return contents;
}

// Two walls of 1.5 mm around a cavity with a rod in it.
SceneContents shell(float opacity)
{
  return boneScene(ct<std::int16_t>(cube(48, 0.5, oblique()),
                                    [](const Vector& p)
                                    {
                                      const double wall = std::min(9.5 - p.norm(), p.norm() - 8.0);
                                      const double rod = 1.2 - Vector(p.x(), p.y(), 0.0).norm();
                                      return std::max(wall, std::min(rod, 8.5 - p.norm()));
                                    }),
                   opacity);
}

bool hasExits(const SceneContents& contents)
{
  const auto names = shoot(contents, slanting(), {}, 32, 24).statistics.variant;
  return std::count(names.begin(), names.end(), "exit surfaces") > 0;
}

RenderStatistics counted(const SceneContents& contents)
{
  ScenePicture scene;
  scene.setContents(contents);
  scene.setCamera(slanting());
  scene.setCounting(true);
  OffscreenView view(kWidth, kHeight);
  view.render(scene);
  return scene.statistics();
}

struct Scene
{
  const char* name;
  std::function<SceneContents()> make;
};

std::ostream& operator<<(std::ostream& os, const Scene& scene)
{
  return os << scene.name;
}

SceneContents soft(SceneContents contents)
{
  contents.softTissue =
      appearance::Material{appearance::TransferFunction({{-900.0, {0.9F, 0.7F, 0.6F}, 0.0F},
                                                         {-500.0, {0.9F, 0.7F, 0.6F}, 0.1F},
                                                         {300.0, {0.6F, 0.2F, 0.15F}, 0.05F}})};
  return contents;
}

const Scene kScenes[] = {
    {"Ball", [] { return translucentBall(); }},
    {"BallWithEdges",
     []
     {
       SceneContents contents = translucentBall();
       contents.light.edges = 1.0;
       return contents;
     }},
    {"Shell", [] { return shell(0.12F); }},
    {"SmoothShell", [] { return shell(0.55F); }},
    {"Cut", [] { return cutBall(0.35F); }},
    {"CutWithGrain",
     []
     {
       SceneContents contents = cutBall(0.35F);
       contents.light.grain = 1.0;
       return contents;
     }},
    {"Everything", [] { return fullScene(); }},
    {"EverythingOfThreeImages", [] { return fullSceneOfThree(); }},
    {"StructuresAlone",
     []
     {
       SceneContents contents = labelledBall(cube(64, 0.35, obliqueMirrored()));
       contents.boneShown = false;
       contents.materials[1].surfaceOpacity = 0.3F;
       return contents;
     }},
    {"SoftTissue", [] { return soft(cutBall(0.35F)); }},
    {"Planes",
     []
     {
       SceneContents contents = fullScene();
       contents.clipping = {{{0.0, -2.0, 0.0}, Vector(0.2, 1.0, 0.1).normalized()},
                            {{3.0, 0.0, 0.0}, {-1.0, 0.0, 0.0}}};
       contents.section = SectionWindow{};
       return contents;
     }},
    {"Box",
     []
     {
       SceneContents contents = translucentBall();
       contents.crop = core::IndexBox{{10, 12, 5}, {33, 40, 41}};
       return contents;
     }},
    {"BorderOfTheImage", [] { return boneScene(ball(cube(24, 0.5), 9.0), 0.35F); }},
};

class ExitSurfaces : public ::testing::TestWithParam<Scene>
{
};

} // namespace

TEST_P(ExitSurfaces, AreThoseOfTheReference)
{
  const SceneContents contents = withExits(GetParam().make());
  ASSERT_TRUE(hasExits(contents));
  const Shot shot = shoot(contents, slanting(), {}, kColumns, kRows);
  const ReferencePicture truth = truthOf(contents, slanting(), kColumns, kRows);
  const Agreement agreement = compare(shot, truth, contents.ct->geometry().minSpacing());
  EXPECT_GT(agreement.hits, 900);
  expectAgreement(agreement);
  RecordProperty("rms_255", std::to_string(agreement.rms));
}

INSTANTIATE_TEST_SUITE_P(Scenes, ExitSurfaces, ::testing::ValuesIn(kScenes),
                         [](const auto& entry) { return std::string(entry.param.name); });

TEST(ExitSurface, IsNotDrawnWhenItIsOff)
{
  EXPECT_FALSE(LightSettings().exitSurfaces);
  const SceneContents plain = shell(0.12F);
  EXPECT_FALSE(hasExits(plain));
  const Picture without = draw(plain, slanting());
  const RenderStatistics before = counted(plain);
  ScenePicture scene;
  scene.setContents(withExits(plain));
  scene.setCamera(slanting());
  OffscreenView view(kWidth, kHeight);
  EXPECT_GT(countDifferentPixels(view.render(scene), without), 2000U);
  scene.setContents(plain);
  EXPECT_EQ(countDifferentPixels(view.render(scene), without), 0U);
  EXPECT_EQ(counted(plain).fetchesPerPixel, before.fetchesPerPixel);
  // Where nothing is translucent there is none to see.
  const SceneContents opaque = cutBall();
  EXPECT_FALSE(hasExits(withExits(opaque)));
  EXPECT_EQ(countDifferentPixels(draw(withExits(opaque), slanting()), draw(opaque, slanting())),
            0U);
}

// Bone without a border to air in the picture: only hull, box and planes end it.
TEST(ExitSurface, IsNotWhereTheDrawnRegionEnds)
{
  SceneContents contents = boneScene(
      image(cube(33, 0.5, oblique()), [](const Vector& p) { return 900.0 + 20.0 * p.x(); }), 0.35F);
  const auto expectNone = [](const SceneContents& scene)
  {
    EXPECT_EQ(countDifferentPixels(draw(withExits(scene), slanting()), draw(scene, slanting())),
              0U);
  };
  expectNone(contents);
  contents.crop = core::IndexBox{{5, 6, 7}, {25, 22, 28}};
  expectNone(contents);
  contents.clipping = {{{0.5, 1.0, 0.0}, Vector(-0.5, 0.8, -0.3).normalized()},
                       {{0.5, 1.0, 0.0}, Vector(-0.5, -0.8, 0.3).normalized()}};
  expectNone(contents);
}
