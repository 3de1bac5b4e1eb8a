#include <algorithm>
#include <array>
#include <functional>
#include <ostream>
#include <random>
#include <string>
#include <vector>

#include "PictureComparison.h"
#include "PictureScenes.h"

using namespace petrous;
using namespace petrous::rendering;
using namespace petrous::rendering::synthetic;

namespace
{

constexpr int kColumns = 160;
constexpr int kRows = 120;

struct View
{
  SceneContents contents;
  core::CameraPose pose = slanting();
};

struct Case
{
  const char* name;
  std::function<View()> make;
};

std::ostream& operator<<(std::ostream& os, const Case& value)
{
  return os << value.name;
}

template <class Tissue>
View shape(const Tissue& tissue, double spacing = 0.5)
{
  return {boneScene(
      ct<std::int16_t>(cube(static_cast<int>(24.0 / spacing), spacing, oblique()), tissue))};
}

View lit(View view, double falloff, double wetness)
{
  view.contents.light.falloff = falloff;
  view.contents.light.wetness = wetness;
  return view;
}

View toned(View view, double exposure, bool toneCurve)
{
  view.contents.light.exposure = exposure;
  view.contents.light.toneCurve = toneCurve;
  return view;
}

View edged(View view, double edges)
{
  view.contents.light.edges = edges;
  return view;
}

// Bone with scanner noise of a fifth of the intensity rise per voxel at the surface.
SceneContents noisy(float surfaceOpacity)
{
  std::mt19937 random(7);
  std::normal_distribution<double> noise(0.0, 25.0);
  const core::GridGeometry grid = cube(48, 0.5, oblique());
  SceneContents contents = boneScene(
      image(grid, [&](const Vector& p)
            { return std::clamp(kIso + 240.0 * bittenBall(p), -1000.0, 1900.0) + noise(random); }),
      surfaceOpacity);
  return contents;
}

// Cells of an atlas in a ball within translucent bone, each nearest to a place of its own.
SceneContents atlas(int count)
{
  SceneContents contents = translucentBall();
  std::mt19937 random(11);
  std::uniform_real_distribution<double> any(-5.0, 5.0);
  std::uniform_real_distribution<float> tint(0.05F, 0.95F);
  std::vector<Vector> seeds;
  for (int n = 0; n < count; ++n)
  {
    seeds.emplace_back(any(random), any(random), any(random));
    const std::array<float, 3> color{tint(random), tint(random), tint(random)};
    contents.materials.push_back({appearance::TransferFunction::constant(color, 0.4F),
                                  appearance::IntensitySource::Ct, n % 3 == 0 ? 0.5F : 1.0F});
  }
  contents.labels = labelField(
      cube(64, 0.35, obliqueMirrored()), [](const Vector& p) { return 6.0 - p.norm(); },
      [&](const Vector& p)
      {
        const auto nearest = std::min_element(seeds.begin(), seeds.end(),
                                              [&](const Vector& a, const Vector& b)
                                              { return (a - p).norm() < (b - p).norm(); });
        return 1 + static_cast<int>(nearest - seeds.begin());
      });
  return contents;
}

std::vector<Case> cases()
{
  const auto plane = [](const Vector& p)
  { return 1.3 - p.dot(Vector(0.3, -0.8, 0.5).normalized()); };
  return {
      {"Plane", [=] { return shape(plane); }},
      {"Sphere", [] { return shape([](const Vector& p) { return 9.0 - p.norm(); }); }},
      {"HollowBall", [] { return View{hollowBall()}; }},
      {"Torus",
       []
       {
         return shape(
             [](const Vector& p)
             { return 2.0 - std::hypot(Eigen::Vector2d(p.x(), p.z()).norm() - 7.0, p.y()); });
       }},
      {"ThinShell",
       []
       {
         return shape([](const Vector& p)
                      { return std::min(0.6 - std::abs(p.norm() - 9.0), 6.0 + p.y()); });
       }},
      {"MirroredGrid", [] { return View{hollowBall(obliqueMirrored())}; }},
      {"AnisotropicGrid",
       []
       {
         const core::GridGeometry grid({110, 110, 23}, {0.2, 0.2, 1.0}, {-10.9, -10.9, -11.0});
         return View{boneScene(ct<std::int16_t>(grid, bittenBall))};
       }},
      {"UnsignedShort", [] { return View{hollowBall<std::uint16_t>(oblique())}; }},
      {"Float", [] { return View{hollowBall<float>(oblique())}; }},
      {"Translucent", [] { return View{translucentBall()}; }},
      {"OnlyTheInside",
       []
       {
         View view{translucentBall()};
         view.contents.materials = {boneMaterial(0.0F)};
         return view;
       }},
      {"Noise", [] { return View{noisy(1.0F)}; }},
      {"TranslucentNoise", [] { return View{noisy(0.35F)}; }},
      {"LabelsOfTheSameGrid", [] { return View{labelledBall(cube(48, 0.5, oblique()))}; }},
      {"LabelsOfAFinerTurnedGrid",
       [] { return View{labelledBall(cube(64, 0.35, obliqueMirrored()))}; }},
      {"LabelsInOpaqueBone",
       []
       {
         View view{labelledBall(cube(64, 0.35), 1.0F)};
         view.contents.mask = cut(view.contents.ct->geometry(), cavity);
         return view;
       }},
      {"LabelsWithoutBone",
       []
       {
         View view{labelledBall(cube(64, 0.35, obliqueMirrored()))};
         view.contents.boneShown = false;
         return view;
       }},
      {"Lumen",
       []
       {
         View view{labelledBall(cube(48, 0.5, oblique()), 1.0F)};
         view.contents.labels = labelField(
             cube(48, 0.5, oblique()), [](const Vector&) { return -5.0; },
             [](const Vector& p) { return (p - Vector(4.0, -6.0, 3.0)).norm() < 5.2 ? 2 : 0; });
         view.contents.materials[2].lumen = true;
         return view;
       }},
      {"Cut", [] { return View{cutBall()}; }},
      {"TranslucentCut", [] { return View{cutBall(0.35F)}; }},
      {"SecondImage",
       []
       {
         View view{translucentBall()};
         view.contents.second = movedWaves();
         view.contents.materials = {waveMaterial(0.3F)};
         return view;
       }},
      {"ThirdImage",
       []
       {
         View view{translucentBall()};
         view.contents.third = movedRipples();
         view.contents.materials = {waveMaterial(0.3F)};
         view.contents.materials.front().source = appearance::IntensitySource::Third;
         return view;
       }},
      {"Everything", [] { return View{fullScene()}; }},
      {"EverythingOfThreeImages", [] { return View{fullSceneOfThree()}; }},
      {"ClippingPlanes",
       []
       {
         View view{fullScene()};
         view.contents.clipping = {{{0.0, -2.0, 0.0}, Vector(0.2, 1.0, 0.1).normalized()},
                                   {{-4.0, 0.0, 0.0}, {1.0, 0.0, 0.0}}};
         return view;
       }},
      // A pixel is a fiftieth of a voxel, and a border of tissue in a face as wide as many.
      {"FacesOfTwoPlanesNear",
       []
       {
         View view{labelledBall(cube(64, 0.35, obliqueMirrored())), slanting(60.0)};
         view.contents.clipping = {{{0.0, -2.0, 0.0}, Vector(0.2, 1.0, 0.1).normalized()},
                                   {{-1.0, 0.0, 0.0}, Vector(-1.0, 0.1, 0.2).normalized()}};
         view.contents.section = SectionWindow{};
         view.pose.focalPoint = {0.5, -1.0, 0.2};
         view.pose.viewAngle = 1.4;
         return view;
       }},
      {"ManyLabelsNear",
       []
       {
         View view{atlas(57)};
         view.pose.parallelScale = 0.8;
         return view;
       }},
      {"CropBox",
       []
       {
         View view{translucentBall()};
         view.contents.crop = core::IndexBox{{10, 12, 5}, {33, 40, 41}};
         return view;
       }},
      {"BorderOfTheVolume",
       [] {
         return View{boneScene(ball(cube(24, 0.5), 9.0), 0.35F), slanting(40.0)};
       }},
      {"ParallelProjection",
       []
       {
         View view{fullScene()};
         view.pose.parallelScale = 12.0;
         return view;
       }},
      {"LensShift",
       []
       {
         View view{fullScene()};
         view.pose.lensShift = 0.25;
         return view;
       }},
      {"LensShiftInParallel",
       []
       {
         View view{cutBall()};
         view.pose.parallelScale = 12.0;
         view.pose.lensShift = -0.2;
         return view;
       }},
      {"EyeInTheVolume",
       [] {
         return View{fullScene(), from({2.0, -7.0, 3.0}, {-1.0, 0.0, 0.0}, 80.0)};
       }},
      {"EyeInTheTissue",
       [] {
         return View{translucentBall(), from({-4.0, 2.0, 0.0}, {4.0, -6.0, 3.0}, 70.0)};
       }},
      {"EyeInAStructure",
       []
       {
         return View{labelledBall(cube(64, 0.35, obliqueMirrored())),
                     from({0.0, -1.0, 0.5}, {4.0, -6.0, 3.0}, 70.0)};
       }},
      {"Edges", [] { return edged(View{translucentBall()}, 1.0); }},
      {"EdgesOfNoise", [] { return edged(View{noisy(0.12F)}, 1.0); }},
      {"EdgesOfEverything", [] { return edged(View{fullScene()}, 0.5); }},
      // A pixel is a fifth of a cell of the grain.
      {"GrainOfEverything",
       []
       {
         View view{fullScene(), from(slanting(45.0).position, {0.6, -3.4, 1.2}, 7.0)};
         view.contents.light.grain = 1.0;
         return view;
       }},
      {"FalloffAndWetness", [] { return lit(View{fullScene()}, 50.0, 0.5); }},
      {"FalloffInTheInside",
       [] {
         return lit({translucentBall(), from({3.0, -19.0, 3.0}, {1.5, -9.5, 1.5}, 60.0)}, 12.0,
                    0.0);
       }},
      {"Sections",
       []
       {
         View view{fullScene()};
         view.contents.clipping = {{{0.0, -2.0, 0.0}, Vector(0.2, 1.0, 0.1).normalized()}};
         view.contents.section = SectionWindow{3200.0, 700.0};
         view.contents.light.exposure = 1.0;
         return view;
       }},
      {"SectionOfOpaqueBone",
       []
       {
         View view{hollowBall(oblique())};
         view.contents.crop = core::IndexBox{{10, 12, 5}, {33, 40, 41}};
         view.contents.section = SectionWindow{};
         return view;
       }},
      {"SectionOfBoneInASecondImage",
       []
       {
         View view{translucentBall()};
         view.contents.second = movedWaves();
         view.contents.materials = {waveMaterial(0.6F)};
         view.contents.crop = core::IndexBox{{10, 12, 5}, {33, 40, 41}};
         view.contents.section = SectionWindow{};
         return view;
       }},
      {"Exposed", [] { return toned(lit(View{fullScene()}, 0.0, 0.5), 1.0, false); }},
      {"UnderexposedToneCurve", [] { return toned(lit(View{fullScene()}, 0.0, 0.5), -1.0, true); }},
      {"ToneCurve", [] { return toned(lit(View{cutBall()}, 0.0, 1.0), 0.0, true); }},
      {"OverexposedToneCurve", [] { return toned(lit(View{fullScene()}, 0.0, 0.5), 1.0, true); }},
      {"OverexposedInside", [] { return toned(View{translucentBall()}, 1.0, true); }},
  };
}

} // namespace

class RayCasterAccuracy : public ::testing::TestWithParam<Case>
{
};

TEST_P(RayCasterAccuracy, KeepsToTheReference)
{
  const View view = GetParam().make();
  const Shot shot = shoot(view.contents, view.pose, {}, kColumns, kRows);
  const ReferencePicture truth = truthOf(view.contents, view.pose, kColumns, kRows);
  const Agreement agreement = compare(shot, truth, view.contents.ct->geometry().minSpacing());
  EXPECT_GT(agreement.hits, 900);
  expectAgreement(agreement);
  RecordProperty("rms_255", std::to_string(agreement.rms));
  RecordProperty("others_percent", std::to_string(agreement.others));
  RecordProperty("depth_median_voxels", std::to_string(agreement.median));
}

INSTANTIATE_TEST_SUITE_P(Scenes, RayCasterAccuracy, ::testing::ValuesIn(cases()),
                         [](const auto& entry) { return std::string(entry.param.name); });

// Pearls of 1.4 voxels: most rays that meet one have part of it between two samples, and many only
// graze it.
TEST(RayCasterGrazing, FindsWhatLiesBetweenSamples)
{
  const auto pearls = [](const Vector& p)
  {
    constexpr double apart = 2.1;
    const Vector nearest = apart * (p / apart).array().round().matrix();
    return 0.7 - (p - nearest).norm();
  };
  for (const float opacity : {1.0F, 0.35F})
  {
    View view = shape(pearls);
    view.contents.materials = {boneMaterial(opacity)};
    const Shot shot = shoot(view.contents, view.pose, {}, kColumns, kRows);
    const ReferencePicture truth = truthOf(view.contents, view.pose, kColumns, kRows);
    const Agreement agreement = compare(shot, truth, view.contents.ct->geometry().minSpacing());
    EXPECT_GT(agreement.hits, 5000);
    EXPECT_LE(agreement.others, 0.12) << opacity; // 0.65 with a single search between two samples
    EXPECT_LE(agreement.rms, 1.15) << opacity;    // with more surfaces than in anatomy
  }
}
