#include "petrous/Rendering/SurfaceExtraction.h"

#include <gtest/gtest.h>

#include "SyntheticScenes.h"
#include "petrous/Volume/MeshDecimation.h"

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

// Two grid edges are on one cell's face, and at most two cells have both: in no pair of neighboring
// cells, of any configuration, do more than two triangles meet at an edge.
TEST(SurfaceExtraction, HasNoEdgeOfMoreThanTwoTrianglesInAnyTwoNeighboringCells)
{
  constexpr int kTiles = 16; // along each axis, one for each of the 2^12 configurations
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    core::Index3 size{2, 2, 2};
    size[axis] = 3;
    core::Index3 dims{};
    for (std::size_t a = 0; a < 3; ++a)
      dims[a] = kTiles * (size[a] + 1); // a layer between them is empty
    volume::Volume<std::uint16_t> labels(
        core::GridGeometry(dims, Eigen::Vector3d::Ones(), Eigen::Vector3d::Zero()),
        std::uint16_t{0});
    for (int tile = 0; tile < kTiles * kTiles * kTiles; ++tile)
    {
      int bit = 0;
      for (int k = 0; k < size[2]; ++k)
        for (int j = 0; j < size[1]; ++j)
          for (int i = 0; i < size[0]; ++i, ++bit)
            labels.at(tile % kTiles * (size[0] + 1) + i, tile / kTiles % kTiles * (size[1] + 1) + j,
                      tile / kTiles / kTiles * (size[2] + 1) + k) =
                static_cast<std::uint16_t>(tile >> bit & 1);
      ASSERT_EQ(bit, 12);
    }
    EXPECT_TRUE(extractLabel(labels, 1).isClosed()) << axis;
  }
}

// A ball full of holes, as noise makes them, and two balls that touch in the corner of a voxel.
TEST(SurfaceExtraction, CanBeDecimatedToTheTrianglesAskedFor)
{
  volume::Volume<std::uint16_t> noisy(synthetic::cube(32, 0.5), std::uint16_t{0});
  volume::Volume<std::uint16_t> touching(noisy.geometry(), std::uint16_t{0});
  std::uint32_t random = 1;
  for (int k = 2; k < 30; ++k)
    for (int j = 2; j < 30; ++j)
      for (int i = 2; i < 30; ++i)
      {
        random = random * 1664525U + 1013904223U; // Numerical Recipes' generator
        const double r = std::hypot(i - 15.5, j - 15.5, k - 15.5);
        noisy.at(i, j, k) = r < 12.0 && (random >> 8) % 100 < 80 ? 1 : 0;
        // Voxel (15, 15, 15) is the outermost of one towards the other's (16, 16, 16).
        const double low = std::hypot(i - 10, j - 10, k - 10);
        const double high = std::hypot(i - 21, j - 21, k - 21);
        touching.at(i, j, k) = low < 8.7 || high < 8.7 ? 1 : 0;
      }
  ASSERT_EQ(touching.at(15, 15, 15), 1);
  ASSERT_EQ(touching.at(16, 16, 16), 1);
  ASSERT_EQ(touching.at(15, 15, 16) + touching.at(15, 16, 16), 0);
  for (const auto* labels : {&noisy, &touching})
  {
    const core::TriangleMesh whole = extractLabel(*labels, 1);
    ASSERT_TRUE(whole.isClosed());
    const auto euler = [](const core::TriangleMesh& mesh) {
      return static_cast<long>(mesh.vertices.size()) - static_cast<long>(mesh.triangles.size()) / 2;
    };
    for (const std::size_t part : {2U, 4U})
    {
      const std::size_t wanted = whole.triangles.size() / part;
      const volume::DecimatedMesh fewer = volume::decimated(whole, wanted);
      EXPECT_TRUE(fewer.mesh.isClosed());
      EXPECT_LE(fewer.mesh.triangles.size(), wanted);
      EXPECT_GE(fewer.mesh.triangles.size() + 1, wanted);
      EXPECT_EQ(euler(fewer.mesh), euler(whole));
      EXPECT_NEAR(fewer.mesh.signedVolume(), whole.signedVolume(), 1e-3 * whole.signedVolume());
      if (labels == &touching)
      {
        EXPECT_LT(fewer.hausdorff(), 0.5) << "a voxel";
      }
    }
  }
}
