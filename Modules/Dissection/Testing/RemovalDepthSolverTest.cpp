#include "petrous/Dissection/RemovalDepthSolver.h"

#include <cmath>
#include <random>

#include <gtest/gtest.h>

#include "petrous/Core/Error.h"
#include "petrous/Dissection/RemovedVolume.h"

using namespace petrous;
using dissection::RemovalDepthSolver;
using dissection::RemovalStep;
using dissection::TissueResistance;
using Eigen::Vector3d;

namespace
{

constexpr double kPi = 3.14159265358979323846;
constexpr double kRadius = 2.0;
constexpr double kResistance = 2000.0; // N/mm^2

// Bone below z = 0, with its surface between voxels.
class BoneBelow
{
public:
  explicit BoneBelow(double h, dissection::ProtectedTissue keep = {},
                     std::vector<TissueResistance::Structure> structures = {})
    : grid(gridOf(h))
    , tissue(boneOn(grid))
    , resistance(tissue.ct(), {300.0, 1800.0, kResistance, kResistance}, std::move(structures))
    , search(tissue, resistance, std::move(keep), kRadius)
    , mask(grid)
  {
  }

  static core::GridGeometry gridOf(double h)
  {
    const int n = static_cast<int>(std::ceil(8.0 / h));
    return {{n, n, n}, Vector3d::Constant(h), {-4.0, -4.0, -4.0 - 0.3 * h}};
  }

  // Applies the step and returns the removed volume by an independent quadrature.
  double take(const RemovalStep& step)
  {
    const volume::CutMask before = mask;
    const auto bricks = dissection::cut(mask, step.burr);
    return dissection::measureRemoved(tissue, before, mask, bricks, {}).total;
  }

  static RemovalDepthSolver::Wish down(double height, double volume, double deepest = 1.0)
  {
    return {{0.03, -0.05, height}, -Vector3d::UnitZ(), kResistance * volume, deepest};
  }

  core::GridGeometry grid;
  volume::TissueField tissue;
  TissueResistance resistance;
  RemovalDepthSolver search;
  volume::CutMask mask;

private:
  static volume::TissueField boneOn(const core::GridGeometry& grid)
  {
    auto voxels = std::make_shared<volume::Volume<std::int16_t>>(grid);
    const double h = grid.minSpacing();
    for (int k = 0; k < grid.dims()[2]; ++k)
    {
      const double z = grid.patientFromVoxel({0.0, 0.0, 1.0 * k}).z();
      for (int j = 0; j < grid.dims()[1]; ++j)
        for (int i = 0; i < grid.dims()[0]; ++i)
          voxels->at(i, j, k) = static_cast<std::int16_t>(
              std::lround(std::clamp(300.0 - 700.0 * z / h, -900.0, 1500.0)));
    }
    return {std::make_shared<volume::IntensityVolume>(
                std::shared_ptr<const volume::Volume<std::int16_t>>(voxels)),
            {},
            nullptr,
            {}};
  }
};

} // namespace

// A ball advanced by d into a half-space removes the cap pi d^2 (r - d/3).
TEST(RemovalDepthSolver, GoesAsDeepAsACapOfTheVolumeIs)
{
  for (const double h : {0.15, 0.3})
    for (const double depth : {0.05, 0.2})
    {
      SCOPED_TRACE(h);
      SCOPED_TRACE(depth);
      BoneBelow bone(h);
      const double r = kRadius + RemovalDepthSolver::kClearance * h;
      const double volume = kPi * depth * depth * (r - depth / 3.0);
      double left = volume;
      double end = 0.0;
      int bites = 0;
      for (; left > 0.05 * volume && bites < 20; ++bites)
      {
        const auto step = bone.search.find(bone.mask, BoneBelow::down(kRadius, left));
        ASSERT_TRUE(step);
        EXPECT_LE(step->work, kResistance * left * (1.0 + 1e-9));
        EXPECT_NEAR(step->work, kResistance * step->volume, 1e-4 * step->work);
        if (bites > 0)
        {
          EXPECT_LE(step->depth - end, 0.251 * h);
        }
        end = step->depth;
        bone.take(*step);
        left -= step->volume;
      }
      EXPECT_LT(left, 0.1 * volume);
      EXPECT_GE(left, 0.0);
      // At most a tenth of the volume remains; depth goes with its square root.
      EXPECT_NEAR(end + RemovalDepthSolver::kClearance * h, depth, 0.06 * depth + 0.01 * h);
    }
}

// Cap removed by a ball from a half-space: the middle is the surface normal, the spread the mean of
// r sin(t) over the cap's volume, between the surface at (r - d)/cos(t) and r.
TEST(RemovalDepthSolver, SaysWhereTheBurrTakesIt)
{
  for (const double h : {0.1, 0.15, 0.3, 0.4})
    for (const double volume : {0.005, 0.05, 0.3})
    {
      SCOPED_TRACE(h);
      SCOPED_TRACE(volume);
      BoneBelow bone(h);
      const auto step = bone.search.find(bone.mask, BoneBelow::down(kRadius, volume));
      ASSERT_TRUE(step);
      ASSERT_GT(step->volume, 0.0);
      const double r = kRadius + RemovalDepthSolver::kClearance * h;
      const double depth = step->depth + RemovalDepthSolver::kClearance * h;
      double all = 0.0, moment = 0.0;
      const int steps = 2000;
      const double widest = std::acos(1.0 - depth / r);
      for (int n = 0; n < steps; ++n)
      {
        const double t = widest * (n + 0.5) / steps;
        const double part = std::sin(t) * (r * r * r - std::pow((r - depth) / std::cos(t), 3));
        all += part;
        moment += part * r * std::sin(t);
      }
      EXPECT_LT(std::acos(step->patch.middle.dot(-Vector3d::UnitZ())), 0.02);
      EXPECT_NEAR(step->patch.spread, moment / all, 0.05 * moment / all + 0.02 * h);
    }
}

// The same cap, by Monte Carlo sampling of the removed volume.
TEST(RemovalDepthSolver, SaysHowFarFromTheSpindleTheBurrTakesIt)
{
  const double h = 0.15;
  std::mt19937 random(8);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  for (const double degrees : {0.0, 45.0, 73.0, 80.0, 85.0, 90.0})
    for (const double volume : {0.005, 0.05, 0.3})
    {
      SCOPED_TRACE(::testing::Message() << degrees << " degrees, " << volume << " mm^3");
      BoneBelow bone(h);
      RemovalDepthSolver::Wish wish = BoneBelow::down(kRadius, volume);
      const double theta = degrees * kPi / 180.0;
      wish.spindle = Vector3d(0.6 * std::cos(theta), 0.8 * std::cos(theta), std::sin(theta));
      const auto step = bone.search.find(bone.mask, wish);
      ASSERT_TRUE(step);
      const double r = kRadius + RemovalDepthSolver::kClearance * h;
      const double depth = step->depth + RemovalDepthSolver::kClearance * h;
      const double widest = std::sqrt(2.0 * r * depth);
      double sum = 0.0;
      int places = 0;
      for (int n = 0; n < 400000; ++n)
      {
        const Vector3d p(widest * uniform(random), widest * uniform(random),
                         -r + 0.5 * depth * (1.0 + uniform(random)));
        if (p.norm() > r)
          continue;
        sum += kRadius * p.normalized().cross(wish.spindle).norm();
        ++places;
      }
      EXPECT_NEAR(step->patch.arm, sum / places, 0.02 * sum / places + 0.01 * h);
    }
}

TEST(RemovalDepthSolver, TakesNothingFromAirNorBeyondItsReach)
{
  BoneBelow bone(0.3);
  const auto high = bone.search.find(bone.mask, BoneBelow::down(3.5, 1.0, 0.1));
  ASSERT_TRUE(high);
  EXPECT_EQ(high->volume, 0.0);
  EXPECT_TRUE(high->capped);
  EXPECT_FALSE(bone.search.find(bone.mask, BoneBelow::down(kRadius, 0.0)));
  EXPECT_FALSE(bone.search.ahead(bone.mask, {0.0, 0.0, 3.5}, -Vector3d::UnitZ()));
  EXPECT_NEAR(*bone.search.ahead(bone.mask, {0.0, 0.0, 2.1}, -Vector3d::UnitZ()), kResistance,
              1e-9);
  // Outside the grid, across its border, and far larger than the grid.
  for (const double x : {-4.0, 30.0})
  {
    auto wish = BoneBelow::down(kRadius, 0.1);
    wish.place.x() = x;
    const auto step = bone.search.find(bone.mask, wish);
    ASSERT_TRUE(step);
    EXPECT_EQ(step->volume > 0.0, x < 0.0);
  }
  RemovalDepthSolver huge(bone.tissue, bone.resistance, {}, 500.0);
  auto wish = BoneBelow::down(500.0, 0.5);
  const auto step = huge.find(bone.mask, wish);
  ASSERT_TRUE(step);
  EXPECT_GT(step->volume, 0.0);
  EXPECT_LE(step->volume, 0.5);
}

TEST(RemovalDepthSolver, LeavesWhatIsProtected)
{
  const core::GridGeometry grid = BoneBelow::gridOf(0.3);
  auto all = std::make_shared<const volume::Volume<float>>(grid, 1.0F);
  BoneBelow bone(0.3, {all});
  const auto step = bone.search.find(bone.mask, BoneBelow::down(kRadius, 0.1));
  ASSERT_TRUE(step);
  EXPECT_EQ(step->volume, 0.0);
  EXPECT_TRUE(step->capped);
}

// A ball that already penetrates the tissue deeply (like the centre of a burr that is held at the
// surface) removes no more than the work allows.
TEST(RemovalDepthSolver, DrawsASunkenBurrBack)
{
  BoneBelow bone(0.3);
  double taken = 0.0;
  for (int n = 0; n < 400; ++n)
  {
    const auto step = bone.search.find(bone.mask, BoneBelow::down(0.3, 0.05));
    ASSERT_TRUE(step) << n;
    ASSERT_LE(step->volume, 0.05 * (1.0 + 1e-6)) << n;
    if (step->depth > 0.0)
      break;
    taken += bone.take(*step);
  }
  // Everything that the ball overlapped: a cap of 1.7 mm.
  const double r = kRadius + RemovalDepthSolver::kClearance * 0.3;
  EXPECT_NEAR(taken, kPi * 1.7 * 1.7 * (r - 1.7 / 3.0), 0.5);
}

TEST(RemovalDepthSolver, TissuesDivideTheWork)
{
  const core::GridGeometry grid = BoneBelow::gridOf(0.2);
  auto voxels = std::make_shared<volume::Volume<std::uint16_t>>(grid);
  for (int k = 0; k < grid.dims()[2]; ++k)
    for (int j = 0; j < grid.dims()[1]; ++j)
      for (int i = 0; i < grid.dims()[0] / 2; ++i)
        voxels->at(i, j, k) = 1;
  const auto labels = std::make_shared<const volume::LabelMap>(
      volume::makeLabelMap(std::shared_ptr<const volume::Volume<std::uint16_t>>(voxels), {}));
  BoneBelow bone(0.2, {}, {{labels, 1, 0.25 * kResistance}});
  double work = 0.0;
  double spent = 0.0;
  for (int n = 0; n < 12; ++n)
  {
    const auto step = bone.search.find(bone.mask, BoneBelow::down(kRadius - 0.04 * n, 0.1));
    ASSERT_TRUE(step);
    const volume::CutMask before = bone.mask;
    const auto bricks = dissection::cut(bone.mask, step->burr);
    const auto parts =
        dissection::measureRemoved(bone.tissue, before, bone.mask, bricks, {{"soft", labels, 1}});
    ASSERT_EQ(parts.structures.size(), 1u);
    const double soft = parts.structures[0].volume;
    work += kResistance * (0.25 * soft + (parts.total - soft));
    spent += step->work;
  }
  EXPECT_NEAR(work, spent, 0.01 * spent);
}

// A burr that barely touches its own cavity removes almost nothing; its work must match the volume,
// instead of being the rounding error of one of the sums.
TEST(RemovalDepthSolver, AStepOfNextToNothingHasItsWork)
{
  BoneBelow bone(0.5);
  const double r = kRadius + RemovalDepthSolver::kClearance * bone.grid.minSpacing();
  dissection::cut(bone.mask, {{0.0, 0.0, kRadius - 1.0}, {0.0, 0.0, kRadius - 1.0}, r});
  std::mt19937 random(3);
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  int taken = 0;
  for (int n = 0; n < 1000; ++n)
  {
    const Vector3d into = Vector3d(unit(random), unit(random), unit(random)).normalized();
    const double depth = 0.01 * std::pow(10.0, -2.0 * std::abs(unit(random)));
    const Vector3d place = Vector3d(0.0, 0.0, kRadius - 1.0) + 1e-3 * unit(random) * into;
    bone.search.forget();
    const auto step = bone.search.find(bone.mask, {place, into, 1e6, depth});
    if (!step || !(step->volume > 0.0))
      continue;
    ++taken;
    EXPECT_NEAR(step->work, kResistance * step->volume, 0.01 * kResistance * step->volume)
        << n << " " << step->volume;
  }
  EXPECT_GT(taken, 100);
}

TEST(RemovalDepthSolver, FindsTheSameWithoutItsMemory)
{
  BoneBelow bone(0.3);
  for (int n = 0; n < 30; ++n)
  {
    const auto wish = BoneBelow::down(kRadius - 0.01 * n, 0.01);
    RemovalDepthSolver fresh(bone.tissue, bone.resistance, {}, kRadius);
    const auto first = bone.search.find(bone.mask, wish);
    const auto second = fresh.find(bone.mask, wish);
    ASSERT_TRUE(first && second) << n;
    // Both within the tenth of the work that may remain.
    EXPECT_NEAR(first->work, second->work, 0.1 * wish.work) << n;
    EXPECT_NEAR(first->depth, second->depth, 0.02) << n;
    bone.take(*first);
  }
}

TEST(RemovalDepthSolver, RefusesABurrWithoutSize)
{
  BoneBelow bone(0.3);
  EXPECT_THROW(RemovalDepthSolver(bone.tissue, bone.resistance, {}, 0.0), core::InvalidParameter);
  EXPECT_THROW(RemovalDepthSolver(bone.tissue, bone.resistance, {}, std::nan("")),
               core::InvalidParameter);
  EXPECT_THROW(TissueResistance(bone.tissue.ct(), {300.0, 300.0, 1.0, 1.0}, {}),
               core::InvalidParameter);
  EXPECT_THROW(TissueResistance(bone.tissue.ct(), {300.0, 1800.0, 0.0, 1.0}, {}),
               core::InvalidParameter);
}
