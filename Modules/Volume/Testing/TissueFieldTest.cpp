#include <cmath>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include "petrous/Volume/NearestSurface.h"
#include "petrous/Volume/SmoothedUnion.h"
#include "petrous/Volume/TissueField.h"

using namespace petrous;
using Eigen::Vector3d;
using volume::TissueField;

namespace
{

// A ball of bone whose HU fall linearly through the surface threshold at `radius`.
std::shared_ptr<const volume::IntensityVolume> ball(const core::GridGeometry& grid,
                                                    const Vector3d& center, double radius)
{
  auto v = std::make_shared<volume::Volume<float>>(grid);
  for (int k = 0; k < grid.dims()[2]; ++k)
    for (int j = 0; j < grid.dims()[1]; ++j)
      for (int i = 0; i < grid.dims()[0]; ++i)
      {
        const Vector3d p = grid.patientFromVoxel({1.0 * i, 1.0 * j, 1.0 * k});
        v->at(i, j, k) = static_cast<float>(300.0 + 400.0 * (radius - (p - center).norm()));
      }
  return std::make_shared<const volume::IntensityVolume>(
      std::shared_ptr<const volume::Volume<float>>(v));
}

core::GridGeometry obliqueGrid()
{
  const Eigen::Matrix3d direction =
      Eigen::AngleAxisd(0.5, Vector3d(3, 1, 2).normalized()).toRotationMatrix();
  return {{60, 60, 60}, Vector3d::Constant(0.3), {5, -7, 11}, direction};
}

} // namespace

TEST(TissueField, FindsASphereWhereItIs)
{
  const auto grid = obliqueGrid();
  const Vector3d c = grid.center();
  const TissueField field(ball(grid, c, 5.0), {}, nullptr, {});
  for (const Vector3d& direction : {Vector3d(1, 0, 0), Vector3d(0, -1, 1), Vector3d(1, 2, 3)})
  {
    const Vector3d n = direction.normalized();
    const auto hit = field.firstHit(c + 8.0 * n, c);
    ASSERT_TRUE(hit);
    EXPECT_NEAR(8.0 - *hit, 5.0, 0.006); // h^2/(8 R) 2, the interpolation error
    EXPECT_GT(field.normal(c + 5.0 * n).dot(n), 0.9998);
  }
}

TEST(TissueField, IsAirOutsideTheHull)
{
  const auto grid = obliqueGrid();
  const TissueField field(ball(grid, grid.center(), 50.0), {}, nullptr, {});
  EXPECT_GT(field.value(grid.patientFromVoxel({0, 0, 0})), 0.0);
  EXPECT_DOUBLE_EQ(field.value(grid.patientFromVoxel({-0.01, 0, 0})), TissueField::kAir);
  EXPECT_TRUE(field.normal(grid.patientFromVoxel({-1, 0, 0})).isZero());
  const auto hit = field.firstHit(grid.patientFromVoxel({-10, 30, 30}), grid.center());
  ASSERT_TRUE(hit);
  EXPECT_NEAR(*hit, 3.0, 1e-3) << "the hull's face is the surface there";
}

TEST(TissueField, SeesAThinWallBetweenTwoAirPoints)
{
  const core::GridGeometry grid({80, 8, 8}, Vector3d::Constant(0.25), Vector3d::Zero());
  auto v = std::make_shared<volume::Volume<std::int16_t>>(grid, std::int16_t{-1000});
  for (int k = 0; k < 8; ++k)
    for (int j = 0; j < 8; ++j)
      v->at(40, j, k) = 2000;
  const TissueField field(std::make_shared<const volume::IntensityVolume>(
                              std::shared_ptr<const volume::Volume<std::int16_t>>(v)),
                          {}, nullptr, {});
  const auto hit = field.firstHit({0, 1, 1}, {19, 1, 1});
  ASSERT_TRUE(hit);
  // -1000 + 3000 w = 300: w = 1300/3000 of the voxel before the wall.
  EXPECT_NEAR(*hit, 0.25 * (39.0 + 1300.0 / 3000.0), 1e-4);
}

TEST(TissueField, MaskDoesNotMoveWithTheDensityOfBone)
{
  // The cut surface must be at mask 1/2 whatever the HU beneath: not so for HU times mask.
  for (const std::int16_t hu : {std::int16_t{400}, std::int16_t{2000}})
  {
    const core::GridGeometry grid({32, 16, 16}, Vector3d::Ones(), Vector3d::Zero());
    const auto bone = std::make_shared<const volume::IntensityVolume>(
        std::make_shared<const volume::Volume<std::int16_t>>(grid, hu));
    auto mask = std::make_shared<volume::CutMask>(grid);
    auto brick = std::make_shared<volume::CutMask::Brick>();
    brick->fill(0);
    mask->setBrick(0, brick);
    const TissueField field(bone, {}, mask, {});
    const auto hit = field.firstHit({2, 8, 8}, {30, 8, 8});
    ASSERT_TRUE(hit);
    EXPECT_NEAR(*hit, 13.5, 1e-3);
    EXPECT_GT(field.normal({15.5, 8, 8}).dot(-Vector3d::UnitX()), 0.999);
  }
}

TEST(TissueField, SolidStructureInAirIsTissue)
{
  const core::GridGeometry grid({30, 30, 30}, Vector3d::Constant(0.5), Vector3d::Zero());
  const auto air = std::make_shared<const volume::IntensityVolume>(
      std::make_shared<const volume::Volume<std::int16_t>>(grid, std::int16_t{-1000}));
  auto labels = std::make_shared<volume::Volume<std::uint16_t>>(grid, std::uint16_t{0});
  for (int k = 5; k < 25; ++k)
    for (int j = 5; j < 25; ++j)
      for (int i = 5; i < 25; ++i)
        labels->at(i, j, k) = 1;
  const auto solid = volume::makeSmoothedUnion(volume::makeLabelMap(labels, {}),
                                               [](std::uint16_t) { return true; });
  const TissueField field(air, {solid}, nullptr, {});
  EXPECT_GT(field.value({7.25, 7.25, 7.25}), 0.0);
  EXPECT_LT(field.value({2, 7, 7}), 0.0);
  const auto hit = field.firstHit({0, 7.25, 7.25}, {7.25, 7.25, 7.25});
  ASSERT_TRUE(hit);
  EXPECT_NEAR(*hit, 2.25, 0.05) << "half way between the voxel centres at 2.0 and 2.5";
  EXPECT_GT(field.normal({2.25, 7.25, 7.25}).dot(-Vector3d::UnitX()), 0.999);
}

TEST(NearestSurface, LiesARadiusFromTheCentreOfASphere)
{
  const auto grid = obliqueGrid();
  const Vector3d c = grid.center();
  const TissueField field(ball(grid, c, 5.0), {}, nullptr, {});
  const Vector3d n = Vector3d(1, -2, 0.5).normalized();
  for (const double r : {3.1, 4.6, 5.0, 5.4, 7.2})
  {
    const auto nearest = volume::NearestSurfaceSearch(field, 10.0).find(c + r * n);
    ASSERT_TRUE(nearest) << r;
    EXPECT_NEAR(nearest->distance, r - 5.0, 0.01) << r;
    EXPECT_GT(nearest->normal.dot(n), 0.995) << r;
  }
  EXPECT_FALSE(volume::NearestSurfaceSearch(field, 1.0).find(c));
}

// A ball truncated by the scan's face: the rest of its surface counts, the face does not.
TEST(NearestSurface, TheFacesOfTheScanAreNoSurface)
{
  const core::GridGeometry grid({55, 73, 73}, Vector3d::Constant(0.25), {-9.5, -9.0, -9.0});
  const TissueField field(ball(grid, {0.0, 0.0, 0.0}, 6.0), {}, nullptr, {});
  volume::NearestSurfaceSearch search(field, 10.0);
  const double face = 4.0, rim = std::sqrt(36.0 - face * face);
  for (const double x : {2.8, 3.3, 3.7, 3.99, 4.0})
    for (const double out : {0.5, 2.0, 3.0, 4.0})
    {
      const Vector3d p(x, 0.6 * out, 0.8 * out);
      const double radius = p.norm();
      const bool overhead =
          6.0 / radius * x <= face; // the nearest point of the whole ball is there
      const double truth = overhead ? 6.0 - radius : std::hypot(face - x, rim - out);
      const auto nearest = search.find(p);
      ASSERT_TRUE(nearest) << p.transpose();
      EXPECT_NEAR(nearest->distance, -truth, 0.03) << p.transpose();
    }
}

// A wall of 0.3 mm, in voxels of its own, between 1 mm voxels that contain only air.
TEST(NearestSurface, SeesAThinMeshBetweenTheVoxelsOfTheCt)
{
  const core::GridGeometry coarse({24, 24, 24}, Vector3d::Constant(1.0), {0, 0, 0});
  const auto air = std::make_shared<const volume::IntensityVolume>(
      std::shared_ptr<const volume::Volume<std::int16_t>>(
          std::make_shared<volume::Volume<std::int16_t>>(coarse, std::int16_t{-1000})));
  const double e = 0.1;
  const core::GridGeometry fine({181, 181, 181}, Vector3d::Constant(e), Vector3d::Constant(2.5));
  const Vector3d normal = Vector3d(0.2, -0.3, 1.0).normalized();
  const double at = normal.dot(Vector3d(11.5, 11.5, 11.47));
  const auto depth = [&](const Vector3d& p) { return 0.15 - std::abs(normal.dot(p) - at); };
  auto occupancy = std::make_shared<volume::Volume<float>>(fine);
  for (int k = 0; k < 181; ++k)
    for (int j = 0; j < 181; ++j)
      for (int i = 0; i < 181; ++i)
        occupancy->at(i, j, k) = static_cast<float>(std::clamp(
            0.5 + depth(fine.patientFromVoxel({1.0 * i, 1.0 * j, 1.0 * k})) / (6.0 * e), 0.0, 1.0));
  const TissueField field(air, {occupancy}, nullptr, {});
  volume::NearestSurfaceSearch search(field, 6.0);
  for (int n = 0; n < 200; ++n)
  {
    const Vector3d on(8.0 + 0.035 * n, 14.5 - 0.03 * n, 0.0);
    const Vector3d p =
        on + normal * (at + (n % 2 ? -1.0 : 1.0) * (0.3 + 0.02 * n) - normal.dot(on));
    const double truth = 0.3 + 0.02 * n - 0.15;
    const auto nearest = search.find(p);
    ASSERT_TRUE(nearest) << p.transpose();
    EXPECT_NEAR(nearest->distance, truth, 0.02) << p.transpose();
    const Vector3d out = n % 2 ? Vector3d(-normal) : normal;
    EXPECT_GT(nearest->normal.dot(out), 0.99);
    const auto hit = field.firstHit(p, p - 6.0 * out);
    ASSERT_TRUE(hit) << p.transpose();
    EXPECT_NEAR(*hit, truth, 0.005) << p.transpose();
  }
}

TEST(TissueField, RefusesAMaskOfAnotherGrid)
{
  const auto grid = obliqueGrid();
  const core::GridGeometry other({60, 60, 60}, Vector3d::Constant(0.3), {0, 0, 0});
  EXPECT_THROW(
      TissueField(ball(grid, grid.center(), 5.0), {}, std::make_shared<volume::CutMask>(other), {}),
      core::InvalidParameter);
  EXPECT_THROW(TissueField(ball(grid, grid.center(), 5.0), {}, nullptr, {300.0, 0.0}),
               core::InvalidParameter);
}
