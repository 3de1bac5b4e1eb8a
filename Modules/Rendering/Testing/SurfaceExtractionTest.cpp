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

// Blobs of 1 to some thousand voxels, at the border too, oblique and left-handed: closed, and of
// the volume of the voxels.
TEST(SurfaceExtraction, EnclosesAStructuresVoxelsByVolume)
{
  const core::GridGeometry grids[] = {synthetic::cube(32, 0.4),
                                      core::GridGeometry({32, 32, 32}, {0.3, 0.3, 0.8},
                                                         {90.0, -70.0, 800.0},
                                                         synthetic::obliqueMirrored())};
  for (const core::GridGeometry& grid : grids)
    for (const double radius : {0.3, 1.2, 2.4, 5.0, 9.0})
      for (const Eigen::Vector3d& centre :
           {Eigen::Vector3d(16.0, 15.0, 14.0), Eigen::Vector3d(0.0, 16.0, 31.0)})
      {
        volume::Volume<std::uint16_t> labels(grid, std::uint16_t{0});
        std::size_t count = 0;
        for (int k = 0; k < 32; ++k)
          for (int j = 0; j < 32; ++j)
            for (int i = 0; i < 32; ++i)
            {
              const bool isInside = (Eigen::Vector3d(i, j, k) - centre).norm() <= radius;
              labels.at(i, j, k) = isInside ? 7 : (i + j) % 2 == 0 ? 3 : 0;
              count += isInside ? 1 : 0;
            }
        ASSERT_GT(count, 0U);
        const core::TriangleMesh mesh = extractLabel(labels, 7);
        const double wanted = static_cast<double>(count) * grid.spacing().prod();
        EXPECT_TRUE(mesh.isClosed()) << radius;
        EXPECT_NEAR(mesh.signedVolume(), wanted, 1e-3 * wanted) << radius;
        for (const Eigen::Vector3f& vertex : mesh.vertices)
        {
          // Between an inner and an outer voxel's centres.
          const double off = (grid.voxelFromPatient(vertex.cast<double>()) - centre).norm();
          EXPECT_LT(off, radius + 1.0);
          if (centre[0] > 0.0) // not cut flat by the border
          {
            EXPECT_GT(off, radius - 1.0);
          }
        }
      }
  const volume::Volume<std::uint16_t> none(grids[0], std::uint16_t{0});
  EXPECT_TRUE(extractLabel(none, 1).triangles.empty());
}

// Every configuration of neighbours occurs in noise: no edge is left open, none faces inwards.
TEST(SurfaceExtraction, ClosesEveryConfigurationOfVoxels)
{
  volume::Volume<std::uint16_t> labels(synthetic::cube(24, 0.5), std::uint16_t{0});
  std::uint32_t random = 5;
  double count = 0.0;
  for (std::size_t v = 0; v < labels.size(); ++v)
  {
    random = random * 1664525U + 1013904223U;
    labels.data()[v] = (random >> 24) < 90 ? 1 : 0;
    count += labels.data()[v];
  }
  const core::TriangleMesh mesh = extractLabel(labels, 1);
  EXPECT_NEAR(mesh.signedVolume(), count * 0.125, 1e-3 * count * 0.125);
  EXPECT_TRUE(mesh.isClosed());
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

// Against the true sphere, which the whole mesh follows within 0.01 mm.
TEST(SurfaceExtraction, DecimatesAndTellsHowFarTheSurfaceMoved)
{
  const Eigen::Vector3d center(80.0, -120.0, 1100.0);
  const core::TriangleMesh whole = extractWhole(ballScene(Eigen::Matrix3d::Identity(), center));
  double before = 0.0;
  for (const std::size_t triangles : {2000U, 400U, 100U})
  {
    const DecimatedMesh fewer = decimated(whole, triangles);
    EXPECT_TRUE(fewer.mesh.isClosed());
    EXPECT_LE(fewer.mesh.triangles.size(), triangles);
    EXPECT_GE(fewer.mesh.triangles.size(), triangles * 9 / 10);
    EXPECT_NEAR(fewer.mesh.signedVolume(), kSphereVolume,
                (triangles > 100 ? 0.02 : 0.06) * kSphereVolume)
        << triangles;
    // The triangles' centres are among the points farthest off.
    double truth = 0.0;
    for (const auto& t : fewer.mesh.triangles)
    {
      Eigen::Vector3d at = Eigen::Vector3d::Zero();
      for (const std::uint32_t corner : t)
      {
        const Eigen::Vector3d vertex = fewer.mesh.vertices[corner].cast<double>();
        truth = std::max(truth, std::abs((vertex - center).norm() - kRadius));
        at += vertex / 3.0;
      }
      truth = std::max(truth, std::abs((at - center).norm() - kRadius));
    }
    EXPECT_GT(fewer.error, truth - 0.02) << triangles;
    EXPECT_LT(fewer.error, 2.0 * truth + 0.02) << triangles;
    EXPECT_GT(fewer.error, before);
    before = fewer.error;
  }
  EXPECT_EQ(decimated(whole, whole.triangles.size()).error, 0.0);
  // Every piece needs its 4 triangles: 20 tetrahedra cannot become one of 60.
  core::TriangleMesh many;
  for (std::uint32_t n = 0; n < 20; ++n)
  {
    const float x = 5.0F * static_cast<float>(n);
    many.vertices.insert(many.vertices.end(), {{x, 0, 0}, {x + 1, 0, 0}, {x, 1, 0}, {x, 0, 1}});
    const std::uint32_t v = 4 * n;
    many.triangles.insert(
        many.triangles.end(),
        {{v, v + 2, v + 1}, {v, v + 1, v + 3}, {v, v + 3, v + 2}, {v + 1, v + 2, v + 3}});
  }
  EXPECT_EQ(decimated(many, 100).pieces, 20U);
  try
  {
    decimated(many, 60);
    ADD_FAILURE() << "was accepted";
  }
  catch (const core::InvalidParameter& error)
  {
    EXPECT_NE(std::string(error.what()).find("20 pieces"), std::string::npos) << error.what();
  }
  EXPECT_THROW(decimated(whole, 3), core::InvalidParameter);
  core::TriangleMesh open = whole;
  open.triangles.pop_back();
  EXPECT_THROW(decimated(open, 100), core::InvalidParameter);
}

// A ball full of holes, as noise makes them: collapsing edges opens such a surface.
TEST(SurfaceExtraction, DecimatesANoisySurfaceAndStaysClosedOrSaysWhyNot)
{
  volume::Volume<std::uint16_t> labels(synthetic::cube(32, 0.5), std::uint16_t{0});
  std::uint32_t random = 1;
  for (int k = 2; k < 30; ++k)
    for (int j = 2; j < 30; ++j)
      for (int i = 2; i < 30; ++i)
      {
        random = random * 1664525U + 1013904223U; // Numerical Recipes' generator
        const double r = std::hypot(i - 15.5, j - 15.5, k - 15.5);
        labels.at(i, j, k) = r < 12.0 && (random >> 8) % 100 < 80 ? 1 : 0;
      }
  const core::TriangleMesh whole = extractLabel(labels, 1);
  ASSERT_TRUE(whole.isClosed());
  for (const std::size_t part : {2U, 4U})
  {
    const std::size_t wanted = whole.triangles.size() / part;
    const DecimatedMesh fewer = decimated(whole, wanted);
    EXPECT_TRUE(fewer.mesh.isClosed());
    EXPECT_LT(fewer.mesh.triangles.size(), whole.triangles.size());
    EXPECT_EQ(fewer.limit.empty(), fewer.mesh.triangles.size() <= wanted) << fewer.limit;
    if (!fewer.limit.empty())
    {
      EXPECT_NEAR(fewer.mesh.signedVolume(), whole.signedVolume(), 0.01 * whole.signedVolume());
    }
  }
}
