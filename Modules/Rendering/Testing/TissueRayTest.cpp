#include <cmath>

#include <gtest/gtest.h>

#include "ReferenceScenes.h"
#include "petrous/Rendering/RenderingError.h"

using namespace petrous;
using namespace petrous::rendering;
using namespace petrous::rendering::synthetic;

namespace
{

using Vector = Eigen::Vector3d;

const std::array<float, 3> kRed{0.9F, 0.1F, 0.05F};
const std::array<float, 3> kGreen{0.1F, 0.8F, 0.2F};

Vector vectorOf(const std::array<float, 3>& color)
{
  return {color[0], color[1], color[2]};
}

// Transmittance of d mm of a tissue whose opacity per 1 mm is given.
double through(float opacity, double d)
{
  return std::pow(1.0 - static_cast<double>(opacity), d);
}

// A block of uniform intensity, 16 mm wide.
SceneContents block(double value = 1000.0, int samples = 33)
{
  SceneContents contents;
  contents.ct = image(cube(samples, 16.0 / (samples - 1)), [=](const Vector&) { return value; });
  return contents;
}

// Path length of a ray in the cube of half width 8 mm.
double chord(const PixelRay& ray)
{
  double first = 0.0;
  double last = 1e9;
  for (int axis = 0; axis < 3; ++axis)
    if (ray.direction[axis] != 0.0)
    {
      const double a = (-8.0 - ray.origin[axis]) / ray.direction[axis];
      const double b = (8.0 - ray.origin[axis]) / ray.direction[axis];
      first = std::max(first, std::min(a, b));
      last = std::min(last, std::max(a, b));
    }
  return std::max(0.0, last - first);
}

// The same colour in every pixel, to float precision.
void expectEverywhere(const ReferencePicture& picture, const Vector& expected,
                      double tolerance = 2e-6)
{
  for (int row = 0; row < kHeight; ++row)
    for (int column = 0; column < kWidth; ++column)
      ASSERT_LT((rgbOf(picture, column, row) - expected).cwiseAbs().maxCoeff(), tolerance)
          << rgbOf(picture, column, row).transpose() << " but " << expected.transpose();
}

// Red structure on the far (sign 1) or near (-1) side of the plane x = 2 mm.
std::shared_ptr<const volume::LabelField> halfSpace(double sign)
{
  return labelField(
      cube(33, 0.5), [=](const Vector& p) { return sign * (p.x() - 2.0); },
      [](const Vector&) { return 1; });
}

} // namespace

TEST(TissueRay, FadesExponentiallyInAHomogeneousBlock)
{
  SceneContents contents = block();
  contents.materials = {fog(kRed, 0.2F)};
  const double left = through(0.2F, 16.0);
  expectEverywhere(see(contents, along({1.0, 0.0, 0.0}, 40.0)),
                   (1.0 - left) * kInside * vectorOf(kRed) + left * background());
}

TEST(TissueRay, FadesWithTheObliquePathOfEachRay)
{
  SceneContents contents = block();
  contents.materials = {fog(kRed, 0.15F)};
  core::CameraPose pose = sideCamera();
  const ReferencePicture picture = see(contents, pose);
  int compared = 0;
  forEachRay(pose,
             [&](int column, int row, const PixelRay& ray)
             {
               const double left = through(0.15F, chord(ray));
               const Vector expected =
                   (1.0 - left) * kInside * vectorOf(kRed) + left * background();
               EXPECT_LT((rgbOf(picture, column, row) - expected).norm(), 1e-5);
               compared += left < 0.9;
             });
  EXPECT_GT(compared, 250);
}

TEST(TissueRay, IntegratesALinearRampAsTheIntegralSays)
{
  // Opacity a u over u = 0..1 along 16 mm: the integral of -ln(1 - a u) is 16 ((1 - a) ln(1 - a) +
  // a) / a.
  SceneContents contents = block();
  contents.ct = image(cube(33, 0.5), [](const Vector& p) { return 400.0 + 100.0 * p.x(); });
  contents.iso = -1e4;
  const float a = 0.4F;
  contents.materials = {
      {appearance::TransferFunction({{-400.0, kRed, 0.0F, 0.0F}, {1200.0, kRed, a, 0.0F}}),
       appearance::IntensitySource::Ct, 0.0F}};
  const double left = std::exp(-16.0 * ((1.0 - a) * std::log1p(-a) + a) / a);
  const Vector expected = (1.0 - left) * kInside * vectorOf(kRed) + left * background();
  expectEverywhere(see(contents, along({1.0, 0.0, 0.0}, 40.0)), expected, 1e-5);
  expectEverywhere(see(contents, along({-1.0, 0.0, 0.0}, 40.0)), expected, 1e-5);
}

TEST(TissueRay, SeesThroughAStructureIntoBoneWithoutASurfaceBetween)
{
  SceneContents contents = block();
  contents.labels = halfSpace(-1.0); // 10 mm of structure, then 6 mm of bone
  contents.materials = {fog(kGreen, 0.3F), fog(kRed, 0.1F)};
  contents.materials[0].surfaceOpacity = 0.7F; // no effect: only the structure borders air
  const double a = through(0.1F, 10.0);
  const double b = through(0.3F, 6.0);
  expectEverywhere(see(contents, along({1.0, 0.0, 0.0}, 40.0)),
                   (1.0 - a) * kInside * vectorOf(kRed) +
                       a * (1.0 - b) * kInside * vectorOf(kGreen) + a * b * background(),
                   2e-5);
}

TEST(TissueRay, MeetsTheSurfaceOfAStructureInsideBone)
{
  SceneContents contents = block();
  contents.labels = halfSpace(1.0); // 10 mm of bone, then 6 mm of structure
  contents.materials = {fog(kGreen, 0.1F), fog(kRed, 0.3F)};
  contents.materials[1].surfaceOpacity = 0.4F;
  const double a = through(0.1F, 10.0);
  const double b = through(0.3F, 6.0);
  const double s = 0.4F;
  expectEverywhere(see(contents, along({1.0, 0.0, 0.0}, 40.0)),
                   (1.0 - a) * kInside * vectorOf(kGreen) + a * s * vectorOf(kRed) +
                       a * (1.0 - s) * ((1.0 - b) * kInside * vectorOf(kRed) + b * background()),
                   2e-5);
}

TEST(TissueRay, LetsTheBackgroundThroughAHalfOpaqueSurface)
{
  SceneContents contents = block();
  contents.materials = {fog(kRed, 0.0F)};
  contents.materials[0].surfaceOpacity = 0.5F;
  const ReferencePicture picture = see(contents, along({1.0, 0.0, 0.0}, 40.0));
  expectEverywhere(picture, 0.5 * vectorOf(kRed) + 0.5 * background());
  EXPECT_NEAR(static_cast<double>(picture.depth.at(5, 5)), 32.0, 1e-5);
}

// A chord of a sphere meets it at the same angle where it enters and where it leaves.
TEST(TissueRay, WithExitSurfacesSeesTheFarWallsOfAShell)
{
  constexpr double kInner = 6.0;
  constexpr double kOpacity = 0.3F;
  SceneContents contents;
  contents.ct = ct<float>(cube(64, kSpacing, oblique()), [](const Vector& p)
                          { return std::min(kRadius - p.norm(), p.norm() - kInner); });
  contents.iso = kIso;
  contents.materials = {fog(kRed, 0.0F)};
  contents.materials[0].surfaceOpacity = kOpacity;
  for (const bool exits : {false, true})
  {
    contents.light.exitSurfaces = exits;
    const ReferencePicture picture = see(contents, sideCamera());
    std::array<int, 2> compared{};
    forEachRay(sideCamera(),
               [&](int column, int row, const PixelRay& ray)
               {
                 const double aside = ray.origin.cross(ray.direction).norm();
                 const bool isInner = aside < 0.9 * kInner;
                 if (aside > 0.93 * kRadius || (!isInner && aside < 1.1 * kInner))
                   return;
                 const auto light = [&](double radius)
                 { return lambert(std::sqrt(1.0 - aside * aside / (radius * radius))); };
                 std::vector<double> met{light(kRadius)};
                 if (isInner && exits)
                   met.push_back(light(kInner));
                 if (isInner)
                   met.push_back(light(kInner));
                 if (exits)
                   met.push_back(light(kRadius));
                 Vector expected = Vector::Zero();
                 double left = 1.0;
                 for (const double lit : met)
                 {
                   expected += left * kOpacity * lit * vectorOf(kRed);
                   left *= 1.0 - kOpacity;
                 }
                 expected += left * background();
                 EXPECT_LT((rgbOf(picture, column, row) - expected).cwiseAbs().maxCoeff(), 4e-3);
                 ++compared[isInner ? 0 : 1];
               });
    EXPECT_GT(compared[0], 60);
    EXPECT_GT(compared[1], 100);
  }
}

TEST(TissueRay, WithExitSurfacesSeesTheFarWallOfAStructureInItsOwnColour)
{
  SceneContents contents = block();
  contents.boneShown = false;
  contents.labels = labelField(
      cube(65, 0.25), [](const Vector& p) { return 3.0 - std::abs(p.x()); },
      [](const Vector&) { return 1; });
  contents.materials = {fog(kGreen, 0.0F), fog(kRed, 0.0F)};
  contents.materials[1].surfaceOpacity = 0.4F;
  contents.light.exitSurfaces = true;
  const ReferencePicture picture = see(contents, along({1.0, 0.0, 0.0}, 40.0));
  const double left = (1.0 - 0.4) * (1.0 - 0.4);
  EXPECT_LT((rgbOf(picture, kWidth / 2, kHeight / 2) -
             ((1.0 - left) * vectorOf(kRed) + left * background()))
                .norm(),
            1e-4);
}

// Neither the border of the image nor a plane or the box is a surface that is left.
TEST(TissueRay, HasNoExitSurfaceWhereTheDrawnRegionEnds)
{
  SceneContents contents = block();
  contents.materials = {fog(kRed, 0.1F)};
  contents.materials[0].surfaceOpacity = 0.5F;
  const auto expectNone = [](SceneContents scene, const core::CameraPose& pose)
  {
    const ReferencePicture without = see(scene, pose);
    scene.light.exitSurfaces = true;
    EXPECT_EQ(see(scene, pose).rgb, without.rgb);
  };
  for (const Vector& direction : {Vector(1.0, 0.0, 0.0), Vector(0.3, -0.5, 0.8)})
    expectNone(contents, along(direction, 40.0));
  expectNone(contents, sideCamera());
  contents.clipping = {{{0.3, 0.0, 0.0}, Vector(-1.0, 0.2, 0.0).normalized()}};
  expectNone(contents, along({1.0, 0.0, 0.0}, 40.0));
  expectNone(contents, sideCamera());
  contents.clipping.clear();
  contents.crop = core::IndexBox{{5, 6, 7}, {25, 22, 28}};
  expectNone(contents, along({0.3, -0.5, 0.8}, 40.0));
  expectNone(contents, sideCamera());
}

TEST(TissueRay, MeasuresTheDepthOfASurfaceThatIsNotSeen)
{
  SceneContents contents = ballScene(Eigen::Matrix3d::Identity());
  contents.materials = {fog(kRed, 0.0F)};
  const core::CameraPose pose = along({1.0, 0.2, -0.1}, 40.0);
  const ReferencePicture picture = see(contents, pose);
  expectEverywhere(picture, background());
  forEachRay(pose,
             [&](int column, int row, const PixelRay& ray)
             {
               if (raySphere(ray.origin, ray.direction, {0, 0, 0}, 0.75 * kRadius) < 0.0)
                 return;
               EXPECT_NEAR(static_cast<double>(picture.depth.at(column, row)),
                           raySphere(ray.origin, ray.direction, {0, 0, 0}, kRadius),
                           0.02 * kSpacing);
             });
}

TEST(TissueRay, ShowsAStructureWhereItLiesInsideTranslucentBone)
{
  SceneContents contents = block();
  const Vector center(1.0, -0.5, 0.7);
  constexpr double radius = 4.0;
  contents.labels = labelField(
      cube(65, 0.25), [&](const Vector& p) { return radius - (p - center).norm(); },
      [](const Vector&) { return 1; });
  contents.materials = {fog(kGreen, 0.05F), flat(kRed)};
  const core::CameraPose pose = along({0.8, 0.5, -0.3}, 60.0);
  const ReferencePicture picture = see(contents, pose);
  int compared = 0;
  forEachRay(pose,
             [&](int column, int row, const PixelRay& ray)
             {
               if (raySphere(ray.origin, ray.direction, center, 0.9 * radius) < 0.0)
                 return;
               const double hit = raySphere(ray.origin, ray.direction, center, radius);
               const double face = picture.depth.at(column, row); // of the bone
               const double left = through(0.05F, hit - face);
               const double cosine =
                   (ray.origin + hit * ray.direction - center).normalized().dot(ray.direction);
               const Vector expected = (1.0 - left) * kInside * vectorOf(kGreen) +
                                       left * lambert(cosine) * vectorOf(kRed);
               EXPECT_LT((rgbOf(picture, column, row) - expected).cwiseAbs().maxCoeff(), 4e-3);
               ++compared;
             });
  EXPECT_GT(compared, 250);
}

TEST(TissueRay, TintsTheWallOfALumenButNotTheBoneBehindIt)
{
  SceneContents contents = block();
  // A lumen has an index and no occupancy; it covers the wall where y > 0.
  contents.labels = labelField(
      cube(33, 0.5), [](const Vector&) { return -100.0; },
      [](const Vector& p) { return p.y() > -0.1 ? 1 : 0; });
  contents.materials = {fog(kGreen, 0.3F), fog(kRed, 1.0F)};
  contents.materials[0].surfaceOpacity = contents.materials[1].surfaceOpacity = 0.5F;
  contents.materials[1].lumen = true;
  const core::CameraPose pose = along({1.0, 0.0, 0.0}, 40.0);
  const ReferencePicture picture = see(contents, pose);
  const double left = through(0.3F, 16.0);
  const Vector inside = (1.0 - left) * kInside * vectorOf(kGreen) + left * background();
  forEachRay(pose,
             [&](int column, int row, const PixelRay& ray)
             {
               if (std::abs(ray.origin.y() + 0.25) < 0.01)
                 return; // half-way between the samples at -0.5 and 0
               const Vector wall = vectorOf(ray.origin.y() > -0.25 ? kRed : kGreen);
               EXPECT_LT((rgbOf(picture, column, row) - 0.5 * (wall + inside)).norm(), 1e-5);
             });
}

TEST(TissueRay, ShowsStructuresAloneWhereBoneIsHidden)
{
  SceneContents contents = block();
  contents.boneShown = false;
  contents.labels = halfSpace(1.0);
  contents.materials = {fog(kGreen, 0.9F), flat(kRed)};
  const ReferencePicture picture = see(contents, along({1.0, 0.0, 0.0}, 40.0));
  expectEverywhere(picture, vectorOf(kRed));
  EXPECT_NEAR(static_cast<double>(picture.depth.at(5, 5)), 42.0, 2e-5);
}

TEST(TissueRay, TakesTheLookFromTheSecondImageThroughItsMotion)
{
  SceneContents contents = block();
  const core::RigidTransform motion(
      Eigen::Quaterniond(Eigen::AngleAxisd(0.7, Vector(1.0, -2.0, 0.5).normalized())),
      {3.0, 40.0, -7.0});
  const Vector slope(10.0, -6.0, 14.0); // per mm, of the second image in its own frame
  const Vector center = motion * Vector::Zero();
  const auto value = [&](const Vector& q) { return 500.0 + slope.dot(q - center); };
  contents.second.volume =
      std::make_shared<volume::IntensityVolume>(*image(cube(50, 0.9, oblique(), center), value));
  contents.second.secondFromCt = motion;
  appearance::Material material{appearance::TransferFunction(
      {{0.0, {0.0F, 0.0F, 0.0F}, 1.0F, 0.0F}, {1000.0, {1.0F, 0.0F, 0.5F}, 1.0F, 0.0F}})};
  material.source = appearance::IntensitySource::Second;
  contents.materials = {material};
  const core::CameraPose pose = along({1.0, 0.0, 0.0}, 40.0);
  const ReferencePicture picture = see(contents, pose);
  forEachRay(pose,
             [&](int column, int row, const PixelRay& ray)
             {
               const double share = value(motion * (ray.origin + 32.0 * ray.direction)) / 1000.0;
               EXPECT_LT((rgbOf(picture, column, row) - Vector(share, 0.0, 0.5 * share)).norm(),
                         2e-5);
             });
}

TEST(TissueRay, DoesNotFadeMoreOnAFinerGrid)
{
  // Trilinear interpolation reproduces a trilinear function exactly: the finer grid holds the same
  // tissue.
  SceneContents coarse = block();
  const core::GridGeometry grid = coarse.ct->geometry();
  coarse.ct =
      image(grid, [](const Vector& p) { return 2000.0 * std::exp(-p.squaredNorm() / 40.0); });
  coarse.iso = 250.0;
  coarse.materials = {
      {appearance::TransferFunction({{300.0, kGreen, 0.02F, 0.0F}, {2000.0, kRed, 0.4F, 0.0F}}),
       appearance::IntensitySource::Ct, 0.0F}};
  SceneContents fine = coarse;
  fine.ct = image(cube(65, 0.25),
                  [&](const Vector& p) { return coarse.ct->sample(grid.voxelFromPatient(p)); });
  const core::CameraPose pose = along({0.3, 1.0, 0.2}, 40.0);
  const ReferencePicture a = see(coarse, pose);
  const ReferencePicture b = see(fine, pose);
  float worst = 0.0F;
  for (std::size_t i = 0; i < a.rgb.size(); ++i)
    worst = std::max(worst, std::abs(a.rgb[i] - b.rgb[i]));
  EXPECT_LT(worst, 1e-4F);
}

TEST(TissueRay, StartsAtAnEyeInsideTissue)
{
  SceneContents contents = block();
  contents.materials = {fog(kRed, 0.2F)};
  const ReferencePicture picture = see(contents, along({1.0, 0.0, 0.0}, 3.0));
  const double left = through(0.2F, 11.0);
  expectEverywhere(picture, (1.0 - left) * kInside * vectorOf(kRed) + left * background());
  EXPECT_NEAR(static_cast<double>(picture.depth.at(5, 5)), 0.0, 1e-5);
  contents.materials = {flat(kGreen)};
  expectEverywhere(see(contents, along({1.0, 0.0, 0.0}, 3.0)), vectorOf(kGreen));
}

// 32 mm to the face, and 40 to the focal point.
TEST(TissueRay, DimsWithTheDistanceFromTheLampAndShinesWhereItIsWet)
{
  SceneContents contents = block();
  contents.materials = {flat({0.5F, 0.5F, 0.5F})};
  contents.light.intensity = 0.5;
  contents.light.falloff = 16.0;
  contents.light.wetness = 0.25;
  expectEverywhere(see(contents, along({1.0, 0.0, 0.0}, 40.0)),
                   Vector::Constant(0.5 * (0.5 + 0.25) * (1.0 + 2.5 * 2.5) / (1.0 + 4.0)));
}

TEST(TissueRay, ShowsTheCtInGreyWhereBoneIsCutOff)
{
  // A plane across a ramp of 50 HU per mm, in a window from -400 to 2800 HU, seen at an angle.
  SceneContents contents;
  contents.ct =
      image(cube(33, 0.5), [](const Vector& p) { return 1000.0 + 50.0 * p.x() + 100.0 * p.y(); });
  contents.iso = -1e4;
  contents.materials = {flat(kRed)};
  contents.light.exposure = 1.0; // of what is lit
  contents.light.wetness = 1.0;
  contents.section = SectionWindow{3200.0, 1200.0};
  const Vector normal = Vector(-1.0, 0.5, 0.2).normalized();
  contents.clipping = {{{0.0, 0.0, 0.0}, normal}};
  const core::CameraPose pose = along({-1.0, 0.2, 0.0}, 40.0);
  const ReferencePicture picture = see(contents, pose);
  int compared = 0;
  forEachRay(pose,
             [&](int column, int row, const PixelRay& ray)
             {
               const double t = -ray.origin.dot(normal) / ray.direction.dot(normal);
               const Vector at = ray.origin + t * ray.direction;
               if (at.cwiseAbs().maxCoeff() > 7.9)
                 return;
               const double value = 1000.0 + 50.0 * at.x() + 100.0 * at.y();
               EXPECT_LT((rgbOf(picture, column, row) - Vector::Constant((value + 400.0) / 3200.0))
                             .cwiseAbs()
                             .maxCoeff(),
                         1e-5);
               ++compared;
             });
  EXPECT_GT(compared, 500);
}

TEST(TissueRay, LeavesAStructureItsColourWhereItIsCutOff)
{
  SceneContents contents = block();
  contents.labels = halfSpace(1.0);
  contents.materials = {flat(kGreen), flat(kRed)};
  contents.section = SectionWindow{4000.0, 700.0};
  contents.light.wetness = 1.0;
  expectEverywhere(see(contents, along({-1.0, 0.0, 0.0}, 40.0)), vectorOf(kRed));
  expectEverywhere(see(contents, along({1.0, 0.0, 0.0}, 40.0)),
                   Vector::Constant((1000.0 + 1300.0) / 4000.0));
  contents.section->width = 0.0;
  EXPECT_THROW(see(contents, along({1.0, 0.0, 0.0}, 40.0)), RenderingError);
}

TEST(TissueRay, FindsAChordThatIsShorterThanAStep)
{
  // Tissue is where x y < -0.0002, which trilinear interpolation represents exactly. A ray along
  // (1, 1, 0) at offset s passes through it over 2 sqrt(s^2 - 0.0004) mm, here up to 0.05 mm.
  SceneContents contents;
  contents.ct = image(cube(17, 0.5),
                      [](const Vector& p) { return kIso - 1000.0 * (0.0002 + p.x() * p.y()); });
  core::CameraPose pose = along({1.0, 1.0, 0.0}, 3.0);
  pose.viewUp = {0.0, 0.0, 1.0};
  pose.parallelScale = 0.03;
  const DepthImage depth = ReferenceRayCaster(contents, {1.0}).render(pose, kWidth, kHeight).depth;
  int found = 0;
  forEachRay(pose,
             [&](int column, int row, const PixelRay& ray)
             {
               const double s = ray.origin.dot(Vector(1.0, -1.0, 0.0).normalized());
               const double seen = depth.at(column, row);
               found += !std::isnan(seen);
               if (std::abs(s) < 0.018)
               {
                 EXPECT_TRUE(std::isnan(seen)) << s;
               }
               else if (std::abs(s) > 0.022)
               {
                 EXPECT_NEAR(seen, 3.0 - std::sqrt(s * s - 0.0004), 1e-3) << s;
               }
             });
  EXPECT_GT(found, 400);
}

TEST(TissueRay, HalvingTheStepChangesNoPicture)
{
  // Steep transfer functions, a cut, and a structure in translucent bone.
  SceneContents contents = ballScene(oblique());
  contents.labels = labelField(
      cube(40, 0.5), [](const Vector& p) { return 5.0 - p.norm(); },
      [](const Vector& p) { return p.x() > 0.0 ? 1 : 2; });
  contents.materials = {
      {appearance::TransferFunction({{300.0, kGreen, 0.0F},
                                     {500.0, kRed, 0.02F},
                                     {520.0, kGreen, 0.9F},
                                     {600.0, kRed, 0.1F}}),
       appearance::IntensitySource::Ct, 0.15F},
      {appearance::TransferFunction::constant(kRed, 0.3F), appearance::IntensitySource::Ct, 0.3F},
      {appearance::TransferFunction::constant(kGreen, 1.0F), appearance::IntensitySource::Ct,
       0.5F}};
  contents.mask =
      cut(contents.ct->geometry(), [](const Vector& p) { return 6.0 - p.dot(kBump.normalized()); });
  const ReferencePicture normal = see(contents, sideCamera());
  const ReferencePicture half =
      ReferenceRayCaster(contents, {1.0 / 32.0}).render(sideCamera(), kWidth, kHeight);
  double sum = 0.0;
  for (std::size_t i = 0; i < normal.rgb.size(); ++i)
    sum += std::pow(static_cast<double>(normal.rgb[i]) - static_cast<double>(half.rgb[i]), 2);
  EXPECT_LT(255.0 * std::sqrt(sum / static_cast<double>(normal.rgb.size())), 0.02);
}
