#include "petrous/Rendering/ReferenceRayCaster.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <random>

#include <gtest/gtest.h>

#include "ReferenceScenes.h"
#include "petrous/Rendering/RenderingError.h"

using namespace petrous;
using namespace petrous::rendering;
using namespace petrous::rendering::synthetic;

namespace
{

// Maximum depth error against the analytic sphere, mm, away from the silhouette, where rays meet
// the surface at a grazing angle.
double depthError(const SceneContents& contents, const core::CameraPose& pose)
{
  const DepthImage depth = see(contents, pose).depth;
  double worst = 0.0;
  int compared = 0;
  forEachRay(pose,
             [&](int column, int row, const PixelRay& ray)
             {
               if (raySphere(ray.origin, ray.direction, {0, 0, 0}, 0.75 * kRadius) < 0.0)
                 return;
               const double truth = raySphere(ray.origin, ray.direction, {0, 0, 0}, kRadius);
               worst =
                   std::max(worst, std::abs(static_cast<double>(depth.at(column, row)) - truth));
               ++compared;
             });
  EXPECT_GT(compared, 120);
  return worst;
}

// A ball of 11 mm with cortex 2 mm thick at 12 % of opacity before white, and below it 2 mm of
// diploe: noise about the iso value.
SceneContents ballWithDiploe(double edges)
{
  std::mt19937 random(11);
  std::normal_distribution<double> noise(0.0, 30.0);
  SceneContents contents;
  contents.ct =
      image(cube(64, kSpacing),
            [&](const Eigen::Vector3d& p)
            {
              const double depth = 11.0 - p.norm();
              const double diploe = kIso + 600.0 * std::abs(depth - 3.0) - 600.0;
              return std::min(kIso + 600.0 * depth, std::max(kIso, diploe)) + noise(random);
            });
  contents.iso = kIso;
  contents.materials = {{appearance::TransferFunction::constant({0.86F, 0.76F, 0.68F}, 0.0F, 0.0F),
                         appearance::IntensitySource::Ct, 0.12F}};
  contents.background = {1.0, 1.0, 1.0};
  contents.light.edges = edges;
  return contents;
}

struct Darkness
{
  int specks = 0;   // pixels away from the rim, darker by 0.2 than the median of their neighbours
  double rim = 0.0; // mean of pixels at the rim, 0 to 1
};

Darkness darknessOf(const SceneContents& contents)
{
  constexpr int kSide = 96;
  const core::CameraPose pose = sideCamera();
  const ReferencePicture picture = ReferenceRayCaster(contents).render(pose, kSide, kSide);
  const PixelRays rays(pose, kSide, kSide);
  const auto green = [&](int column, int row) { return rgbOf(picture, column, row).y(); };
  Darkness darkness;
  int atRim = 0;
  for (int row = 1; row < kSide - 1; ++row)
    for (int column = 1; column < kSide - 1; ++column)
    {
      const PixelRay ray = rays.through(column, row);
      const double aside = ray.origin.cross(ray.direction).norm();
      if (aside > 10.2 && aside < 10.9)
      {
        darkness.rim += green(column, row);
        ++atRim;
      }
      std::array<double, 9> near{};
      for (int n = 0; n < 9; ++n)
        near[static_cast<std::size_t>(n)] = green(column + n % 3 - 1, row + n / 3 - 1);
      std::nth_element(near.begin(), near.begin() + 4, near.end());
      if (aside < 6.0 && green(column, row) < near[4] - 0.2)
        ++darkness.specks;
    }
  EXPECT_GT(atRim, 50);
  darkness.rim /= std::max(atRim, 1);
  return darkness;
}

} // namespace

// One in some hundred surfaces of noise is seen from the side: were it as opaque as the rim, a dark
// pixel would stand where nothing is.
TEST(ReferenceRayCaster, EdgesDarkenTheRimAndNotTheNoise)
{
  const Darkness plain = darknessOf(ballWithDiploe(0.0));
  const Darkness edged = darknessOf(ballWithDiploe(0.7));
  EXPECT_LT(edged.rim, plain.rim - 0.06);
  EXPECT_LE(edged.specks, plain.specks + 2);
}

TEST(ReferenceRayCaster, FindsASphereWithinTwoHundredthsOfAVoxel)
{
  EXPECT_LE(depthError(ballScene(Eigen::Matrix3d::Identity()), sideCamera()), 0.02 * kSpacing);
}

TEST(ReferenceRayCaster, FindsASphereInAnObliqueMirroredGrid)
{
  EXPECT_LE(depthError(ballScene(obliqueMirrored()), sideCamera()), 0.02 * kSpacing);
}

TEST(ReferenceRayCaster, MeasuresParallelDepthFromTheCameraPlane)
{
  core::CameraPose pose = sideCamera();
  pose.parallelScale = 15.0;
  EXPECT_LE(depthError(ballScene(oblique()), pose), 0.02 * kSpacing);
}

TEST(ReferenceRayCaster, ErrorOnASphereFallsWithTheSquareOfTheSpacing)
{
  // Error of trilinear interpolation of a smooth field; rounding to whole HU would mask it.
  const auto errorAt = [](double spacing)
  {
    SceneContents contents;
    contents.ct = ball<float>(cube(static_cast<int>(30.0 / spacing), spacing), kRadius);
    return depthError(contents, sideCamera());
  };
  const double coarse = errorAt(1.2);
  const double fine = errorAt(0.6);
  EXPECT_GT(std::log2(coarse / fine), 1.7);
}

TEST(ReferenceRayCaster, FindsAPlaneWhereItIs)
{
  const Eigen::Vector3d normal = Eigen::Vector3d(0.6, -1.0, 0.3).normalized();
  SceneContents contents;
  contents.ct = image(cube(64, kSpacing, oblique()), [&](const Eigen::Vector3d& p)
                      { return kIso - 200.0 * (p.dot(normal) - 1.0); });
  const DepthImage depth = see(contents, sideCamera()).depth;
  int compared = 0;
  forEachRay(sideCamera(),
             [&](int column, int row, const PixelRay& ray)
             {
               const double plane = (1.0 - ray.origin.dot(normal)) / ray.direction.dot(normal);
               if ((ray.origin + plane * ray.direction).norm() > 14.0)
                 return; // outside the grid
               EXPECT_NEAR(static_cast<double>(depth.at(column, row)), plane, 1e-4 * kSpacing);
               ++compared;
             });
  EXPECT_GT(compared, 120);
}

TEST(ReferenceRayCaster, LeavesNaNWhereNothingIsHit)
{
  const DepthImage depth = see(ballScene(Eigen::Matrix3d::Identity()), sideCamera()).depth;
  EXPECT_TRUE(std::isnan(depth.at(0, 0)));
  EXPECT_FALSE(std::isnan(depth.at(kWidth / 2, kHeight / 2)));
}

TEST(ReferenceRayCaster, HitsWhatTheTissueFieldHits)
{
  SceneContents contents = ballScene(oblique());
  contents.labels = labelField(
      cube(30, 0.8), [](const Eigen::Vector3d& p) { return 4.0 - (p - kBump).norm(); },
      [](const Eigen::Vector3d&) { return 1; });
  contents.materials.resize(2);
  contents.mask = cut(contents.ct->geometry(),
                      [](const Eigen::Vector3d& p) { return 5.0 - p.dot(kBump.normalized()); });
  const volume::TissueField hand = field(contents, {contents.labels->occupancy});
  const DepthImage depth = see(contents, sideCamera()).depth;
  int hits = 0;
  int different = 0; // where a ray grazes the surface, half-voxel steps may miss it
  forEachRay(sideCamera(),
             [&](int column, int row, const PixelRay& ray)
             {
               const auto hit = hand.firstHit(ray.origin, ray.origin + 200.0 * ray.direction);
               const double seen = depth.at(column, row);
               if (hit && !std::isnan(seen) && std::abs(seen - *hit) < 2e-4 * kSpacing)
                 ++hits;
               else if (hit || !std::isnan(seen))
                 ++different;
             });
  EXPECT_GT(hits, 370);
  EXPECT_LE(different, hits / 100);
}

TEST(ReferenceRayCaster, SeesTheWallOfACutWhereTheMaskIsHalf)
{
  SceneContents contents = ballScene(Eigen::Matrix3d::Identity());
  const Eigen::Vector3d normal = Eigen::Vector3d(1.0, -1.0, 0.4).normalized();
  constexpr double offset = 4.2; // mm; everything beyond this plane is cut away
  contents.mask = cut(contents.ct->geometry(),
                      [&](const Eigen::Vector3d& p) { return offset - p.dot(normal); });
  contents.materials = {flat({0.5F, 0.5F, 0.5F})};
  const ReferencePicture picture = see(contents, sideCamera());
  int compared = 0;
  forEachRay(sideCamera(),
             [&](int column, int row, const PixelRay& ray)
             {
               const double wall = (offset - ray.origin.dot(normal)) / ray.direction.dot(normal);
               if ((ray.origin + wall * ray.direction).norm() > 0.85 * kRadius)
                 return;
               EXPECT_NEAR(static_cast<double>(picture.depth.at(column, row)), wall,
                           0.02 * kSpacing);
               EXPECT_NEAR(rgbOf(picture, column, row)[0], 0.5 * lambert(ray.direction.dot(normal)),
                           1.0 / 255.0);
               ++compared;
             });
  EXPECT_GT(compared, 75);
}

TEST(ReferenceRayCaster, LightsASphereByTheCosineOfItsNormal)
{
  SceneContents contents;
  contents.ct = ball<float>(cube(64, kSpacing, oblique()), kRadius);
  contents.materials = {flat({0.9F, 0.6F, 0.3F})};
  const ReferencePicture picture = see(contents, sideCamera());
  int compared = 0;
  forEachRay(sideCamera(),
             [&](int column, int row, const PixelRay& ray)
             {
               const double truth = raySphere(ray.origin, ray.direction, {0, 0, 0}, kRadius);
               if (raySphere(ray.origin, ray.direction, {0, 0, 0}, 0.95 * kRadius) < 0.0)
                 return;
               const double cosine =
                   (ray.origin + truth * ray.direction).normalized().dot(ray.direction);
               const Eigen::Vector3d expected = lambert(cosine) * Eigen::Vector3d(0.9F, 0.6F, 0.3F);
               EXPECT_LT((rgbOf(picture, column, row) - expected).cwiseAbs().maxCoeff(), 2e-3);
               ++compared;
             });
  EXPECT_GT(compared, 220);
}

TEST(ReferenceRayCaster, CutsTissueAtAClippingPlaneAndLightsTheFace)
{
  SceneContents contents = ballScene(oblique());
  contents.materials = {flat({0.5F, 0.5F, 0.5F})};
  const Eigen::Vector3d normal = Eigen::Vector3d(-0.7, 0.8, -0.2).normalized();
  contents.clipping = {{-3.0 * normal, normal}};
  const ReferencePicture picture = see(contents, sideCamera());
  int compared = 0;
  forEachRay(sideCamera(),
             [&](int column, int row, const PixelRay& ray)
             {
               const double cosine = ray.direction.dot(normal);
               const double face = (-3.0 - ray.origin.dot(normal)) / cosine;
               if ((ray.origin + face * ray.direction).norm() > 0.98 * kRadius)
                 return;
               EXPECT_NEAR(static_cast<double>(picture.depth.at(column, row)), face, 1e-5);
               EXPECT_NEAR(rgbOf(picture, column, row)[0], 0.5 * lambert(cosine), 1e-6);
               ++compared;
             });
  EXPECT_GT(compared, 120);
}

TEST(ReferenceRayCaster, CutsTissueAtTheOutermostVoxelCentresOfTheCropBox)
{
  SceneContents contents = ballScene(Eigen::Matrix3d::Identity());
  contents.materials = {flat({0.5F, 0.5F, 0.5F})};
  contents.crop = core::IndexBox{{20, 28, 16}, {50, 40, 52}};
  const core::GridGeometry& grid = contents.ct->geometry();
  const Eigen::Vector3d corner = grid.patientFromVoxel({20.0, 28.0, 16.0});
  core::CameraPose pose;
  pose.position = {0.5, -60.0, 1.0};
  pose.focalPoint = {0.0, 0.0, 0.0};
  const ReferencePicture picture = see(contents, pose);
  int compared = 0;
  forEachRay(pose,
             [&](int column, int row, const PixelRay& ray)
             {
               const double face = (corner.y() - ray.origin.y()) / ray.direction.y();
               const Eigen::Vector3d voxel =
                   grid.voxelFromPatient(ray.origin + face * ray.direction);
               const bool inside = voxel[0] > 20.0 && voxel[0] < 49.0 && voxel[2] > 16.0 &&
                                   voxel[2] < 51.0 &&
                                   (ray.origin + face * ray.direction).norm() < 0.98 * kRadius;
               if (!inside)
                 return;
               EXPECT_NEAR(static_cast<double>(picture.depth.at(column, row)), face, 1e-5);
               EXPECT_NEAR(rgbOf(picture, column, row)[1], 0.5 * lambert(ray.direction.y()), 1e-6);
               ++compared;
             });
  EXPECT_GT(compared, 75);
  contents.crop = core::IndexBox{{70, 0, 0}, {80, 64, 64}};
  EXPECT_TRUE(std::isnan(see(contents, pose).depth.at(kWidth / 2, kHeight / 2)));
}

TEST(ReferenceRayCaster, TakesVoxelsWithoutAValueForAir)
{
  SceneContents contents;
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  const core::GridGeometry grid = cube(33, kSpacing);
  contents.ct = image(grid, [](const Eigen::Vector3d& p) { return p.z() < -2.0 ? nan : 900.0; });
  core::CameraPose pose = along({0.0, 0.0, 1.0}, 50.0);
  const ReferencePicture picture = see(contents, pose);
  // The samples at z >= -2 have a value, and so do the cells between them.
  EXPECT_NEAR(static_cast<double>(picture.depth.at(kWidth / 2, kHeight / 2)), 48.0,
              2e-5 * kSpacing);
  for (const float value : picture.rgb)
    EXPECT_TRUE(std::isfinite(value));
}

TEST(ReferenceRayCaster, SeesNothingInAGridOneSampleThin)
{
  SceneContents contents;
  contents.ct = image({{32, 32, 1}, {0.5, 0.5, 0.5}, {-8.0, -8.0, 0.0}},
                      [](const Eigen::Vector3d&) { return 2000.0; });
  for (const core::CameraPose& pose : {along({0.0, 0.0, 1.0}, 40.0), along({1.0, 0.0, 0.0}, 40.0)})
    for (const float depth : see(contents, pose).depth.millimetres)
      EXPECT_TRUE(std::isnan(depth));
}

TEST(ReferenceRayCaster, DrawsTheBackgroundWithoutACt)
{
  const ReferencePicture picture = see({}, sideCamera());
  EXPECT_TRUE(std::isnan(picture.depth.at(3, 3)));
  EXPECT_LT((rgbOf(picture, 3, 3) - background()).norm(), 1e-6);
  SceneContents contents;
  contents.background = {1.0, 0.5, 0.25};
  const ReferencePicture other = see(contents, sideCamera());
  EXPECT_LT((rgbOf(other, 3, 3) - Eigen::Vector3d(1.0, 0.5, 0.25)).norm(), 1e-6);
}

TEST(ReferenceRayCaster, StopsWhenCancelled)
{
  auto token = std::make_shared<core::CancelToken>();
  token->cancel();
  EXPECT_THROW(ReferenceRayCaster(ballScene(Eigen::Matrix3d::Identity()))
                   .render(sideCamera(), kWidth, kHeight, core::Progress({}, token)),
               core::CancelledError);
}

TEST(ReferenceRayCaster, RefusesAPictureOfNoPixels)
{
  const ReferenceRayCaster caster(ballScene(Eigen::Matrix3d::Identity()));
  EXPECT_THROW(caster.render(sideCamera(), 0, 10), RenderingError);
}

TEST(ReferenceRayCaster, RefusesContentsThatContradictThemselves)
{
  SceneContents contents = ballScene(Eigen::Matrix3d::Identity());
  EXPECT_THROW(ReferenceRayCaster(contents, {0.0}), core::InvalidParameter);
  contents.materials = {{}, {}};
  contents.materials[1].source = appearance::IntensitySource::Second;
  EXPECT_THROW(ReferenceRayCaster{contents}, RenderingError); // no second image
  contents.materials.resize(1);
  contents.labels = labelField(
      cube(8, 1.0), [](const Eigen::Vector3d&) { return 1.0; },
      [](const Eigen::Vector3d&) { return 3; });
  EXPECT_THROW(ReferenceRayCaster{contents}, RenderingError); // no material 3
  contents.labels = nullptr;
  contents.mask = std::make_shared<volume::CutMask>(cube(20, 1.0));
  EXPECT_THROW(ReferenceRayCaster{contents}, RenderingError); // on another grid
  contents.mask = nullptr;
  contents.clipping = {{{0, 0, 0}, {0, 0, 0}}};
  EXPECT_THROW(ReferenceRayCaster{contents}, RenderingError); // a plane without a normal
}
