#include "petrous/Rendering/SurfaceExtraction.h"

#include <gtest/gtest.h>

#include "SyntheticScenes.h"

using namespace petrous;
using namespace petrous::rendering;

namespace
{

constexpr double kRadius = 9.0; // mm
constexpr double kSphereVolume = 4.0 / 3.0 * M_PI * kRadius * kRadius * kRadius;

SceneContents ballScene(const Eigen::Matrix3d& direction,
                        const Eigen::Vector3d& center = Eigen::Vector3d::Zero())
{
  SceneContents contents;
  contents.ct = synthetic::ball(synthetic::cube(48, 0.5, direction, center), kRadius, center);
  return contents;
}

core::TriangleMesh extractWhole(const SceneContents& contents)
{
  return extractSurface(synthetic::field(contents), contents.ct->geometry().fullBox());
}

} // namespace

TEST(SurfaceExtraction, EnclosesASphereWithinOnePercentFacingOutwards)
{
  const core::TriangleMesh mesh = extractWhole(ballScene(Eigen::Matrix3d::Identity()));
  EXPECT_NEAR(mesh.signedVolume(), kSphereVolume, 0.01 * kSphereVolume);
  EXPECT_TRUE(mesh.isClosed());
}

TEST(SurfaceExtraction, FacesOutwardsInObliqueAndLeftHandedGrids)
{
  for (const Eigen::Matrix3d& direction : {synthetic::oblique(), synthetic::obliqueMirrored()})
  {
    const core::TriangleMesh mesh = extractWhole(ballScene(direction, {80.0, -120.0, 1100.0}));
    EXPECT_NEAR(mesh.signedVolume(), kSphereVolume, 0.01 * kSphereVolume);
    for (const Eigen::Vector3f& vertex : mesh.vertices)
      EXPECT_NEAR((vertex.cast<double>() - Eigen::Vector3d(80.0, -120.0, 1100.0)).norm(), kRadius,
                  0.01);
  }
}

TEST(SurfaceExtraction, ClosesWhatTheBoxCutsOff)
{
  const SceneContents contents = ballScene(Eigen::Matrix3d::Identity());
  core::IndexBox half = contents.ct->geometry().fullBox();
  half.lower[0] = 24;
  const core::TriangleMesh mesh = extractSurface(synthetic::field(contents), half);
  EXPECT_TRUE(mesh.isClosed());
  // The first plane of samples is 0.25 mm beyond the sphere's centre.
  const double cap = kSphereVolume / 2.0 - 0.25 * M_PI * kRadius * kRadius;
  EXPECT_NEAR(mesh.signedVolume(), cap, 0.01 * cap);
}

TEST(SurfaceExtraction, ClosesTissueAtTheBorderOfTheGrid)
{
  SceneContents contents;
  contents.ct = synthetic::ct<std::int16_t>(synthetic::cube(16, 1.0),
                                            [](const Eigen::Vector3d&) { return 5.0; });
  const core::TriangleMesh mesh = extractWhole(contents);
  EXPECT_TRUE(mesh.isClosed());
  EXPECT_NEAR(mesh.signedVolume(), 15.0 * 15.0 * 15.0, 0.01 * 15.0 * 15.0 * 15.0);
}

TEST(SurfaceExtraction, FollowsTheMask)
{
  SceneContents contents = ballScene(Eigen::Matrix3d::Identity());
  contents.mask =
      synthetic::cut(contents.ct->geometry(), [](const Eigen::Vector3d& p) { return -p.x(); });
  EXPECT_NEAR(extractWhole(contents).signedVolume(), kSphereVolume / 2.0, 0.01 * kSphereVolume);
}

TEST(SurfaceExtraction, IsEmptyWhereThereIsNoTissueOrNoBox)
{
  SceneContents contents = ballScene(Eigen::Matrix3d::Identity());
  const core::TriangleMesh corner =
      extractSurface(synthetic::field(contents), {{0, 0, 0}, {4, 4, 4}});
  EXPECT_TRUE(corner.triangles.empty());
  EXPECT_TRUE(extractSurface(synthetic::field(contents), {}).triangles.empty());
}

TEST(SurfaceExtraction, StopsWhenCancelled)
{
  const SceneContents contents = ballScene(Eigen::Matrix3d::Identity());
  auto token = std::make_shared<core::CancelToken>();
  token->cancel();
  EXPECT_THROW(extractSurface(synthetic::field(contents), contents.ct->geometry().fullBox(),
                              core::Progress({}, token)),
               core::CancelledError);
}
