#include <cmath>
#include <limits>
#include <random>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include "petrous/Dissection/RemovedVolume.h"
#include "petrous/Dissection/SweptSphereCut.h"
#include "petrous/Volume/SmoothedUnion.h"

using namespace petrous;
using Eigen::Vector3d;

namespace
{

constexpr double kPi = 3.14159265358979323846;

core::GridGeometry cube(int n, double h)
{
  return {{n, n, n}, Vector3d::Constant(h), Vector3d::Constant(-0.5 * h * (n - 1))};
}

volume::TissueField solidBone(const core::GridGeometry& grid)
{
  return {std::make_shared<const volume::IntensityVolume>(
              std::make_shared<const volume::Volume<std::int16_t>>(grid, std::int16_t{1500})),
          {},
          nullptr,
          {}};
}

double removed(const core::GridGeometry& grid, const dissection::SweptSphere& burr)
{
  const volume::CutMask before(grid);
  volume::CutMask mask = before;
  const auto bricks = dissection::cut(mask, burr);
  return dissection::measureRemoved(solidBone(grid), before, mask, bricks, {}).total;
}

// Distance from the centre at which the interpolated mask crosses 1/2 along a direction.
double surfaceAlong(const volume::CutMask& mask, const Vector3d& center, const Vector3d& direction)
{
  double in = 0.0;
  double out = 4.0;
  while (out - in > 1e-6)
  {
    const double r = 0.5 * (in + out);
    const Vector3d v = mask.geometry().voxelFromPatient(center + r * direction);
    (mask.sample(v) < 0.5 ? in : out) = r;
  }
  return in;
}

} // namespace

TEST(SweptSphereCut, SphereOf4MmAt03MmIsRightWithinHalfAPercent)
{
  std::mt19937 random(3);
  std::uniform_real_distribution<double> shift(-0.15, 0.15);
  const double truth = 4.0 / 3.0 * kPi * 8.0;
  for (int n = 0; n < 10; ++n)
  {
    const Vector3d c(shift(random), shift(random), shift(random));
    EXPECT_NEAR(removed(cube(28, 0.3), {c, c, 2.0}) / truth, 1.0, 0.005) << c.transpose();
  }
}

TEST(SweptSphereCut, CapsuleIsRightWithinHalfAPercent)
{
  const Vector3d from(-1.53, -0.71, 0.2);
  const Vector3d to(1.21, 0.9, -0.8);
  const double truth = 4.0 / 3.0 * kPi * 8.0 + kPi * 4.0 * (to - from).norm();
  EXPECT_NEAR(removed(cube(40, 0.3), {from, to, 2.0}) / truth, 1.0, 0.005);
}

// Voxels exactly on the path's line, where the curvature correction is unbounded.
TEST(SweptSphereCut, LeavesNothingOnALineOfVoxelsThatTheBurrGoesAlong)
{
  volume::CutMask mask(core::GridGeometry({50, 40, 40}, Vector3d::Constant(0.3), Vector3d::Zero()));
  dissection::cut(mask, {{4.5, 6.0, 6.0}, {9.0, 6.0, 6.0}, 2.0});
  for (int i = 12; i <= 33; ++i)
    EXPECT_EQ(mask.at(i, 20, 20), 0) << i;
}

TEST(SweptSphereCut, HoldsOnAnObliqueAnisotropicGrid)
{
  const Eigen::Matrix3d direction =
      Eigen::AngleAxisd(0.6, Vector3d(1, 3, -2).normalized()).toRotationMatrix();
  const core::GridGeometry grid({40, 40, 24}, {0.25, 0.25, 0.5}, {3, 4, 5}, direction);
  const double truth = 4.0 / 3.0 * kPi * 8.0;
  EXPECT_NEAR(removed(grid, {grid.center(), grid.center(), 2.0}) / truth, 1.0, 0.01);
}

TEST(SweptSphereCut, SurfaceHasNoVoxelSteps)
{
  const double h = 0.3;
  volume::CutMask mask(cube(28, h));
  const Vector3d c(0.04, -0.11, 0.07);
  dissection::cut(mask, {c, c, 2.0});
  std::mt19937 random(5);
  std::normal_distribution<double> normal;
  double squares = 0.0;
  double worst = 0.0;
  const int count = 2000;
  for (int n = 0; n < count; ++n)
  {
    const Vector3d d = Vector3d(normal(random), normal(random), normal(random)).normalized();
    const double error = surfaceAlong(mask, c, d) - 2.0;
    squares += error * error / count;
    worst = std::max(worst, std::abs(error));
  }
  EXPECT_LT(std::sqrt(squares), 0.05 * h);
  EXPECT_LT(worst, 0.25 * h);
}

TEST(SweptSphereCut, RestingBurrRemovesExactlyNothingTheSecondTime)
{
  volume::CutMask mask(cube(28, 0.3));
  const dissection::SweptSphere burr{{0.1, 0, 0}, {0.4, 0.2, 0.1}, 1.5};
  EXPECT_FALSE(dissection::cut(mask, burr).empty());
  EXPECT_TRUE(dissection::cut(mask, burr).empty());
}

TEST(SweptSphereCut, ManySmallStepsCutWhatOneSweepCuts)
{
  const auto grid = cube(32, 0.3);
  const Vector3d from(-2, 0.1, 0.2);
  const Vector3d to(2, -0.3, 0.4);
  volume::CutMask once(grid);
  dissection::cut(once, {from, to, 1.5});
  volume::CutMask often(grid);
  for (int n = 0; n < 200; ++n)
    dissection::cut(often,
                    {from + (to - from) * n / 200.0, from + (to - from) * (n + 1) / 200.0, 1.5});
  const volume::CutMask untouched(grid);
  const auto all = [](const volume::CutMask& m)
  {
    std::vector<std::size_t> bricks(m.brickCount());
    for (std::size_t n = 0; n < bricks.size(); ++n)
      bricks[n] = n;
    return bricks;
  };
  const auto tissue = solidBone(grid);
  const double a = dissection::measureRemoved(tissue, untouched, once, all(once), {}).total;
  const double b = dissection::measureRemoved(tissue, untouched, often, all(often), {}).total;
  EXPECT_NEAR(b / a, 1.0, 0.005);
}

TEST(SweptSphereCut, OutsideTheGridCutsNothing)
{
  volume::CutMask mask(cube(16, 0.3));
  EXPECT_TRUE(dissection::cut(mask, {{50, 0, 0}, {60, 0, 0}, 2.0}).empty());
  EXPECT_TRUE(mask.untouched());
}

TEST(SweptSphereCut, BurrLargerThanTheVolumeTakesItAll)
{
  volume::CutMask mask(cube(16, 0.3));
  dissection::cut(mask, {{0, 0, 0}, {0, 0, 0}, 30.0});
  for (const int i : {0, 7, 15})
    EXPECT_EQ(mask.at(i, 15 - i, i), 0);
}

TEST(SweptSphereCut, LeavesProtectedTissue)
{
  const auto grid = cube(32, 0.3);
  auto labels = std::make_shared<volume::Volume<std::uint16_t>>(grid, std::uint16_t{0});
  for (int k = 12; k < 20; ++k)
    for (int j = 12; j < 20; ++j)
      for (int i = 12; i < 20; ++i)
        labels->at(i, j, k) = 1;
  const auto map = volume::makeLabelMap(labels, {});
  const auto keep = volume::makeSmoothedUnion(map, [](std::uint16_t) { return true; });
  volume::CutMask mask(grid);
  dissection::cut(mask, {{-2, 0, 0}, {2, 0, 0}, 3.0}, {keep});
  for (int k = 12; k < 20; ++k)
    for (int i = 12; i < 20; ++i)
      EXPECT_GT(mask.at(i, 15, k), volume::CutMask::kUntouched / 2);
  EXPECT_EQ(mask.at(9, 15, 15), 0);
}

TEST(SweptSphereCut, RefusesABurrThatIsNone)
{
  volume::CutMask mask(cube(16, 0.3));
  EXPECT_THROW(dissection::cut(mask, {{0, 0, 0}, {0, 0, 0}, 0.0}), core::InvalidParameter);
  EXPECT_THROW(
      dissection::cut(mask, {{0, 0, 0}, {0, std::numeric_limits<double>::quiet_NaN(), 0}, 1.0}),
      core::InvalidParameter);
}
