#include "petrous/Rendering/ReferenceRayCaster.h"

#include <gtest/gtest.h>

#include "SyntheticScenes.h"
#include "petrous/Rendering/RenderingError.h"
#include "petrous/Volume/SmoothedUnion.h"

using namespace petrous;
using namespace petrous::rendering;

namespace
{

constexpr int kWidth = 96;
constexpr int kHeight = 72;
constexpr double kSpacing = 0.5; // mm
constexpr double kRadius = 11.3; // mm

core::CameraPose camera()
{
  core::CameraPose pose;
  pose.position = {50.0, -60.0, 25.0};
  pose.focalPoint = {1.0, 0.5, -0.5};
  pose.viewAngle = 24.0;
  return pose;
}

SceneContents ballScene(const Eigen::Matrix3d& direction)
{
  SceneContents contents;
  contents.ct = synthetic::ball(synthetic::cube(64, kSpacing, direction), kRadius);
  contents.iso = synthetic::kIso;
  return contents;
}

// Largest error of the depth against the analytic sphere, in voxels, away from the silhouette,
// where the ray meets the surface at a grazing angle.
double depthError(const SceneContents& contents, const core::CameraPose& pose)
{
  const volume::TissueField field = synthetic::field(contents);
  const DepthImage depth = ReferenceRayCaster(field, contents).render(pose, kWidth, kHeight).depth;
  const PixelRays rays(pose, kWidth, kHeight);
  double worst = 0.0;
  int compared = 0;
  for (int row = 0; row < kHeight; ++row)
    for (int column = 0; column < kWidth; ++column)
    {
      const PixelRay ray = rays.through(column, row);
      const double inner =
          synthetic::raySphere(ray.origin, ray.direction, {0, 0, 0}, 0.75 * kRadius);
      if (inner < 0.0)
        continue;
      const double truth = synthetic::raySphere(ray.origin, ray.direction, {0, 0, 0}, kRadius);
      worst = std::max(worst, std::abs(static_cast<double>(depth.at(column, row)) - truth));
      ++compared;
    }
  EXPECT_GT(compared, 500);
  return worst / kSpacing;
}

} // namespace

TEST(ReferenceRayCaster, FindsASphereWithinTwoHundredthsOfAVoxel)
{
  EXPECT_LE(depthError(ballScene(Eigen::Matrix3d::Identity()), camera()), 0.02);
}

TEST(ReferenceRayCaster, FindsASphereInAnObliqueMirroredGrid)
{
  EXPECT_LE(depthError(ballScene(synthetic::obliqueMirrored()), camera()), 0.02);
}

TEST(ReferenceRayCaster, MeasuresParallelDepthFromTheCameraPlane)
{
  core::CameraPose pose = camera();
  pose.parallelScale = 15.0;
  EXPECT_LE(depthError(ballScene(synthetic::oblique()), pose), 0.02);
}

TEST(ReferenceRayCaster, LeavesNaNWhereNothingIsHit)
{
  const SceneContents contents = ballScene(Eigen::Matrix3d::Identity());
  const volume::TissueField field = synthetic::field(contents);
  const DepthImage depth =
      ReferenceRayCaster(field, contents).render(camera(), kWidth, kHeight).depth;
  EXPECT_TRUE(std::isnan(depth.at(0, 0)));
  EXPECT_FALSE(std::isnan(depth.at(kWidth / 2, kHeight / 2)));
}

TEST(ReferenceRayCaster, SeesTheWallOfACutWhereTheMaskIsHalf)
{
  SceneContents contents = ballScene(Eigen::Matrix3d::Identity());
  const Eigen::Vector3d normal = Eigen::Vector3d(1.0, -1.0, 0.4).normalized();
  constexpr double offset = 4.2; // mm; what lies beyond this plane is cut away
  contents.mask = synthetic::cut(contents.ct->geometry(),
                                 [&](const Eigen::Vector3d& p) { return offset - p.dot(normal); });
  const volume::TissueField field = synthetic::field(contents);
  const DepthImage depth =
      ReferenceRayCaster(field, contents).render(camera(), kWidth, kHeight).depth;
  const PixelRays rays(camera(), kWidth, kHeight);
  int compared = 0;
  for (int row = 0; row < kHeight; ++row)
    for (int column = 0; column < kWidth; ++column)
    {
      const PixelRay ray = rays.through(column, row);
      const double wall = (offset - ray.origin.dot(normal)) / ray.direction.dot(normal);
      if ((ray.origin + wall * ray.direction).norm() > 0.85 * kRadius)
        continue;
      EXPECT_NEAR(static_cast<double>(depth.at(column, row)), wall, 0.02 * kSpacing);
      ++compared;
    }
  EXPECT_GT(compared, 300);
}

TEST(ReferenceRayCaster, PaintsAStructureInItsColor)
{
  SceneContents contents;
  const core::GridGeometry grid = synthetic::cube(48, kSpacing);
  contents.ct = synthetic::ct<std::int16_t>(grid, [](const Eigen::Vector3d&) { return -5.0; });
  StructureContents marker{
      "marker",
      synthetic::labels(grid, [](const Eigen::Vector3d& p) { return p.norm() < 6; }),
      1,
      {}};
  marker.look.color = {0.0F, 0.0F, 1.0F};
  contents.structures.push_back(marker);
  const auto solid = volume::makeSmoothedUnion(*marker.labels, [](std::uint16_t) { return true; });
  const volume::TissueField field = synthetic::field(contents, {solid});
  const Picture picture =
      ReferenceRayCaster(field, contents).render(camera(), kWidth, kHeight).picture;
  const std::uint8_t* center = picture.pixel(kWidth / 2, kHeight / 2);
  EXPECT_GT(center[2], 3 * center[0]);
}

TEST(ReferenceRayCaster, StopsWhenCancelled)
{
  const SceneContents contents = ballScene(Eigen::Matrix3d::Identity());
  const volume::TissueField field = synthetic::field(contents);
  auto token = std::make_shared<core::CancelToken>();
  token->cancel();
  EXPECT_THROW(ReferenceRayCaster(field, contents)
                   .render(camera(), kWidth, kHeight, core::Progress({}, token)),
               core::CancelledError);
}

TEST(ReferenceRayCaster, RefusesAPictureOfNoPixels)
{
  const SceneContents contents = ballScene(Eigen::Matrix3d::Identity());
  const volume::TissueField field = synthetic::field(contents);
  EXPECT_THROW(ReferenceRayCaster(field, contents).render(camera(), 0, 10), RenderingError);
}

TEST(PixelRays, SpanTheAngleVertically)
{
  const core::CameraPose pose = camera();
  const PixelRays rays(pose, kWidth, kHeight);
  const double middle = 0.5 * (kWidth - 1);
  const Eigen::Vector3d top = rays.through(middle, -0.5).direction;
  const Eigen::Vector3d bottom = rays.through(middle, kHeight - 0.5).direction;
  EXPECT_NEAR(std::acos(top.dot(bottom)) * 180.0 / M_PI, pose.viewAngle, 1e-9);
  EXPECT_GT(top.z(), bottom.z());
}

TEST(PixelRays, SpanTwiceTheParallelScaleVertically)
{
  core::CameraPose pose = camera();
  pose.parallelScale = 17.0;
  const PixelRays rays(pose, kWidth, kHeight);
  const double height =
      (rays.through(3.0, -0.5).origin - rays.through(3.0, kHeight - 0.5).origin).norm();
  EXPECT_NEAR(height, 34.0, 1e-9);
}

TEST(PixelRays, RefuseACameraWithoutDirection)
{
  core::CameraPose pose = camera();
  pose.focalPoint = pose.position;
  EXPECT_THROW(PixelRays(pose, 10, 10), core::InvalidParameter);
  pose = camera();
  pose.viewUp = pose.focalPoint - pose.position;
  EXPECT_THROW(PixelRays(pose, 10, 10), core::InvalidParameter);
}
