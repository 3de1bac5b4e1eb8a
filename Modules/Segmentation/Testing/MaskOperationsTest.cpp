#include <cmath>
#include <random>

#include <gtest/gtest.h>

#include "petrous/Segmentation/MaskOperations.h"

using namespace petrous;
using namespace petrous::segmentation;
using Eigen::Vector3d;

namespace
{

constexpr double kPi = 3.14159265358979323846;

core::GridGeometry turnedGrid()
{
  const Eigen::Matrix3d turn =
      (Eigen::AngleAxisd(0.4, Vector3d::UnitZ()) * Eigen::AngleAxisd(0.3, Vector3d::UnitX()))
          .toRotationMatrix();
  return {{60, 52, 44}, Vector3d(0.4, 0.5, 0.7), Vector3d(-5.0, 6.0, -7.0), turn};
}

/// The voxels whose centre `isIn` says.
template <class Test>
Mask maskOf(const core::GridGeometry& grid, const Test& isIn)
{
  auto voxels = volume::makeZeroVolume<std::uint8_t>(grid);
  for (int k = 0; k < grid.dims()[2]; ++k)
    for (int j = 0; j < grid.dims()[1]; ++j)
      for (int i = 0; i < grid.dims()[0]; ++i)
        if (isIn(grid.patientFromVoxel(Vector3d(i, j, k))))
          voxels->at(i, j, k) = 1;
  return makeMask(voxels, grid.fullBox());
}

Mask ball(const core::GridGeometry& grid, const Vector3d& center, double radius)
{
  return maskOf(grid, [&](const Vector3d& p) { return (p - center).norm() <= radius; });
}

std::vector<std::uint8_t> bytesOf(const Mask& mask)
{
  return {mask.voxels->data(), mask.voxels->data() + mask.voxels->size()};
}

template <class T, class Value>
volume::IntensityVolume image(const core::GridGeometry& grid, const Value& value,
                              std::optional<double> padding = std::nullopt)
{
  auto voxels = std::make_shared<volume::Volume<T>>(grid);
  for (int k = 0; k < grid.dims()[2]; ++k)
    for (int j = 0; j < grid.dims()[1]; ++j)
      for (int i = 0; i < grid.dims()[0]; ++i)
        voxels->at(i, j, k) = static_cast<T>(value(grid.patientFromVoxel(Vector3d(i, j, k))));
  return volume::IntensityVolume(std::shared_ptr<const volume::Volume<T>>(voxels), padding);
}

double dice(const Mask& a, const Mask& b)
{
  return 2.0 * static_cast<double>(combined(a, b, Combination::Intersection).count) /
         static_cast<double>(a.count + b.count);
}

} // namespace

TEST(Threshold, TakesBothLimitsAndLeavesPaddingOut)
{
  const core::GridGeometry grid({10, 10, 10}, Vector3d::Ones(), Vector3d::Zero());
  const auto ramp = image<std::int16_t>(
      grid, [](const Vector3d& p) { return 100.0 * p[0] + 10.0 * p[1] - 200.0; }, -200.0);
  const Mask mask = threshold(ramp, {-200.0, 300.0});
  for (int j = 0; j < 10; ++j)
    for (int i = 0; i < 10; ++i)
    {
      const double value = 100.0 * i + 10.0 * j - 200.0;
      EXPECT_EQ(mask.at({i, j, 3}), value > -200.0 && value <= 300.0) << i << " " << j;
    }
  EXPECT_EQ(threshold(ramp, {-190.5, -189.5}).count, 10U);
  EXPECT_EQ(threshold(ramp, {-189.5, -180.5}).count, 0U);
  EXPECT_EQ(threshold(ramp, {-1e30, 1e30}).count, 990U);
  EXPECT_EQ(threshold(ramp, {1e6, 1e7}).count, 0U);
  EXPECT_THROW(threshold(ramp, {1.0, 0.0}), core::InvalidParameter);
  EXPECT_THROW(threshold(ramp, {std::nan(""), 0.0}), core::InvalidParameter);
}

TEST(Threshold, OfFloatsKeepsTheLimitsExact)
{
  const core::GridGeometry grid({8, 1, 1}, Vector3d::Ones(), Vector3d::Zero());
  const auto ramp =
      image<float>(grid, [](const Vector3d& p) { return p[0] == 7.0 ? NAN : 0.1F * p[0]; });
  const double third = static_cast<double>(0.1F * 3.0F);
  EXPECT_EQ(threshold(ramp, {third, third}).count, 1U);
  EXPECT_EQ(threshold(ramp, {third + 1e-12, 10.0}).count, 3U);
  EXPECT_EQ(threshold(ramp, {-1.0, third - 1e-12}).count, 3U);
}

TEST(ConnectedThreshold, TakesTheBallOfTheSeedAndNotItsNeighbour)
{
  const core::GridGeometry grid = turnedGrid();
  const Vector3d center = grid.center();
  const Vector3d other = center + grid.direction().col(0) * 9.0;
  const auto balls = image<std::int16_t>(
      grid, [&](const Vector3d& p)
      { return (p - center).norm() <= 4.0 || (p - other).norm() <= 4.0 ? 1000.0 : -50.0; });
  const Mask one = connectedThreshold(balls, {500.0, 1500.0}, {center});
  EXPECT_EQ(bytesOf(one), bytesOf(ball(grid, center, 4.0)));
  EXPECT_EQ(connectedThreshold(balls, {500.0, 1500.0}, {center, other}).count,
            threshold(balls, {500.0, 1500.0}).count);
  // What a seed means is said.
  for (const Vector3d& wrong : {Vector3d(center + grid.direction().col(1) * 8.0),
                                Vector3d(center + Vector3d(500, 0, 0)), Vector3d(NAN, 0, 0)})
    EXPECT_THROW(connectedThreshold(balls, {500.0, 1500.0}, {wrong}), core::InvalidParameter);
}

TEST(ConnectedThreshold, FollowsAThinWindingPath)
{
  // A staircase one voxel thick through the whole grid, and a parallel one that touches nothing.
  const core::GridGeometry grid({40, 40, 40}, Vector3d::Ones(), Vector3d::Zero());
  auto voxels = std::make_shared<volume::Volume<std::int16_t>>(grid, std::int16_t{0});
  std::uint64_t count = 0;
  const auto set = [&](int i, int j, int k)
  {
    count += voxels->at(i, j, k) == 0 ? 1 : 0;
    voxels->at(i, j, k) = 7;
  };
  for (int n = 0; n < 39; ++n)
  {
    set(n, n, n);
    set(n + 1, n, n);
    set(n + 1, n + 1, n);
    set(n + 1, n + 1, n + 1);
  }
  for (int n = 0; n < 30; ++n)
    voxels->at(n, n + 8, n) = 7;
  const volume::IntensityVolume volume{std::shared_ptr<const volume::Volume<std::int16_t>>(voxels)};
  EXPECT_EQ(connectedThreshold(volume, {7, 7}, {Vector3d(39, 39, 39)}).count, count);
}

TEST(RangeAround, FindsTheTissueOfTheSeedInNoise)
{
  const core::GridGeometry grid = turnedGrid();
  const Vector3d center = grid.center();
  std::mt19937 random(1);
  std::normal_distribution<double> noise(0.0, 30.0);
  const auto noisy =
      image<std::int16_t>(grid, [&](const Vector3d& p)
                          { return ((p - center).norm() <= 5.0 ? 400.0 : 0.0) + noise(random); });
  const volume::ValueRange range = rangeAround(noisy, center, std::nullopt, 2.5);
  EXPECT_GT(range.min, 200.0);
  EXPECT_LT(range.min, 370.0);
  EXPECT_GT(range.max, 430.0);
  const Mask found = filled(connectedThreshold(noisy, range, {center}));
  EXPECT_GT(dice(found, ball(grid, center, 5.0)), 0.98);
}

TEST(Otsu, SeparatesThreeTissues)
{
  const core::GridGeometry grid({40, 40, 40}, Vector3d::Ones(), Vector3d::Zero());
  std::mt19937 random(2);
  std::normal_distribution<double> noise(0.0, 10.0);
  const auto three =
      image<std::uint16_t>(grid,
                           [&](const Vector3d& p) {
                             return (p[0] < 25 ? 100.0 : p[0] < 36 ? 300.0 : 600.0) + noise(random);
                           });
  const volume::IntensityHistogram histogram(three);
  const auto thresholds = otsuThresholds(histogram, 3);
  ASSERT_EQ(thresholds.size(), 2U);
  EXPECT_NEAR(thresholds[0], 200.0, 60.0);
  EXPECT_NEAR(thresholds[1], 450.0, 100.0);
  const volume::ValueRange proposed = proposedRange(histogram, std::nullopt);
  EXPECT_EQ(threshold(three, proposed).count, 4U * 40U * 40U) << "the brightest";
  EXPECT_EQ(proposedRange(histogram, 300.0).min, 300.0);
}

// A head as diffusion-weighted MR shows it: brain, dark bone, and a lesion in the mastoid that is
// brighter than brain, blurred by 0.8 mm and noisy.
TEST(ProposedRegion, IsTheBrightLesionBesideBrain)
{
  const core::GridGeometry grid({96, 80, 24}, Vector3d(0.8, 0.8, 2.5), Vector3d(-40, -30, -20));
  const Vector3d lesion(-28.0, 5.0, 6.0);
  const double radius = 5.0;
  for (const double contrast : {400.0, 150.0})
  {
    std::mt19937 random(3);
    std::normal_distribution<double> noise(0.0, 15.0);
    const auto step = [](double inside)
    { return 0.5 * std::erfc(-inside / (0.8 * std::sqrt(2.0))); };
    const auto mr = image<std::uint16_t>(
        grid,
        [&](const Vector3d& p)
        {
          const double brain = step(22.0 - (p - Vector3d(5, 0, 5)).norm());
          const double in = step(radius - (p - lesion).norm());
          return std::max(0.0, 60.0 + 240.0 * brain + (240.0 + contrast) * in + noise(random));
        });
    const auto region = proposedRegion(mr);
    ASSERT_TRUE(region);
    EXPECT_LT((region->seed - lesion).norm(), radius);
    const Mask found = connectedThreshold(mr, region->range, {region->seed});
    EXPECT_GT(dice(found, ball(grid, lesion, radius)), 0.9) << contrast;
    EXPECT_NEAR(found.volume(), 4.0 / 3.0 * kPi * std::pow(radius, 3), 60.0) << contrast;
  }
}

TEST(ProposedRegion, BeginsWhereTheMeanOfABallIsLargest)
{
  // Sparse, noisy voxels of which some are padding; every ball is looked at from its definition.
  const core::GridGeometry grid({30, 26, 22}, Vector3d(0.5, 0.6, 0.9), Vector3d(-7, 2, 3));
  constexpr std::int16_t kPadding = -1;
  for (const unsigned seed : {1U, 2U, 3U})
  {
    std::mt19937 random(seed);
    std::uniform_int_distribution<int> noise(0, 90);
    std::bernoulli_distribution isPadding(0.05);
    auto voxels = std::make_shared<volume::Volume<std::int16_t>>(grid);
    const Vector3d lesion = grid.patientFromVoxel(Vector3d(8.0 + seed, 12.0, 5.0 + 4.0 * seed));
    for (int k = 0; k < 22; ++k)
      for (int j = 0; j < 26; ++j)
        for (int i = 0; i < 30; ++i)
        {
          const double away = (grid.patientFromVoxel(Vector3d(i, j, k)) - lesion).norm();
          voxels->at(i, j, k) = static_cast<std::int16_t>(isPadding(random) ? kPadding
                                                                            : (away < 2.5   ? 900
                                                                               : away < 6.0 ? 300
                                                                                            : 20) +
                                                                                  noise(random));
        }
    const volume::IntensityVolume mr(std::shared_ptr<const volume::Volume<std::int16_t>>(voxels),
                                     double{kPadding});
    const auto region = proposedRegion(mr);
    ASSERT_TRUE(region);
    double largest = 0.0;
    Vector3d there = Vector3d::Zero();
    for (int k = 2; k < 20; ++k)
      for (int j = 2; j < 24; ++j)
        for (int i = 2; i < 28; ++i)
        {
          if (voxels->at(i, j, k) < 600)
            continue;
          double sum = 0.0;
          int count = 0;
          for (int c = 0; c < 22; ++c)
            for (int b = 0; b < 26; ++b)
              for (int a = 0; a < 30; ++a)
                if (Vector3d(0.5 * (a - i), 0.6 * (b - j), 0.9 * (c - k)).norm() <= 1.5 &&
                    voxels->at(a, b, c) != kPadding)
                {
                  sum += voxels->at(a, b, c);
                  ++count;
                }
          if (sum / count > largest)
          {
            largest = sum / count;
            there = grid.patientFromVoxel(Vector3d(i, j, k));
          }
        }
    EXPECT_TRUE(region->seed.isApprox(there, 1e-12)) << region->seed << "\n\n" << there;
  }
}

TEST(ProposedRegion, IsNoneWhereNothingIsBrighter)
{
  const core::GridGeometry grid({60, 60, 30}, Vector3d(1, 1, 2), Vector3d::Zero());
  EXPECT_FALSE(proposedRegion(image<std::int16_t>(grid, [](const Vector3d&) { return 7.0; })));
  std::mt19937 random(4);
  std::normal_distribution<double> noise(0.0, 5.0);
  EXPECT_FALSE(proposedRegion(image<std::int16_t>(
      grid, [&](const Vector3d& p) { return (p[0] < 10 ? 50.0 : 300.0) + noise(random); })))
      << "all of the tissue";
}

TEST(Islands, AreCountedByTheirFaces)
{
  const core::GridGeometry grid({20, 20, 20}, Vector3d(1.0, 1.0, 2.0), Vector3d::Zero());
  const auto box = [](const Vector3d& p, double from, double to)
  { return p.minCoeff() >= from && p.maxCoeff() <= to; };
  // 4 voxels a side and 2 slices; and 2 voxels that touch the large one by an edge only.
  const Mask mask = maskOf(
      grid, [&](const Vector3d& p)
      { return box(p, 4.0, 7.0) || (p[0] == 8.0 && p[1] == 8.0 && p[2] <= 6.0 && p[2] >= 4.0); });
  ASSERT_EQ(mask.count, 32U + 2U);
  EXPECT_EQ(largestIsland(mask).count, 32U);
  EXPECT_EQ(withoutSmallIslands(mask, 4.0).count, 34U) << "2 voxels of 2 mm3";
  EXPECT_EQ(withoutSmallIslands(mask, 4.1).count, 32U);
  EXPECT_EQ(withoutSmallIslands(mask, 100.0).count, 0U);
  EXPECT_EQ(islandsAt(mask, {Vector3d(8, 8, 4)}).count, 2U);
  EXPECT_EQ(islandsAt(mask, {Vector3d(8, 8, 4), Vector3d(5, 5, 5)}).count, 34U);
  EXPECT_EQ(islandsAt(mask, {Vector3d(0, 0, 0), Vector3d(1e6, 0, 0)}).count, 0U);
  EXPECT_EQ(largestIsland(emptyMask(grid)).count, 0U);
}

TEST(Islands, CavitiesAreFilledAndBaysAreNot)
{
  const core::GridGeometry grid = turnedGrid();
  const Vector3d center = grid.center();
  const Mask shell =
      combined(ball(grid, center, 6.0), ball(grid, center, 4.0), Combination::Difference);
  EXPECT_EQ(bytesOf(filled(shell)), bytesOf(ball(grid, center, 6.0)));
  // A channel to the outside.
  const Vector3d axis = grid.direction().col(0);
  const Mask open =
      combined(shell,
               maskOf(grid,
                      [&](const Vector3d& p)
                      {
                        const Vector3d d = p - center;
                        return d.dot(axis) > 0.0 && (d - d.dot(axis) * axis).norm() < 1.0;
                      }),
               Combination::Difference);
  EXPECT_EQ(filled(open).count, open.count);
}

TEST(Margin, IsExactOnAnAnisotropicTurnedGrid)
{
  const core::GridGeometry grid = turnedGrid();
  const Mask start = ball(grid, grid.center() + Vector3d(0.13, 0.07, 0.0), 3.0);
  std::vector<Vector3d> inside;
  std::vector<Vector3d> outside;
  for (int k = 0; k < grid.dims()[2]; ++k)
    for (int j = 0; j < grid.dims()[1]; ++j)
      for (int i = 0; i < grid.dims()[0]; ++i)
        (start.at({i, j, k}) ? inside : outside)
            .push_back(grid.patientFromVoxel(Vector3d(i, j, k)));
  const auto within = [](const Vector3d& p, const std::vector<Vector3d>& set, double distance)
  {
    return std::any_of(set.begin(), set.end(),
                       [&](const Vector3d& q) { return (p - q).norm() <= distance; });
  };
  for (const double distance : {1.03, -1.03})
  {
    const Mask moved = margin(start, distance);
    for (int k = 0; k < grid.dims()[2]; k += 3)
      for (int j = 0; j < grid.dims()[1]; j += 2)
        for (int i = 0; i < grid.dims()[0]; i += 2)
        {
          const Vector3d p = grid.patientFromVoxel(Vector3d(i, j, k));
          const bool expected =
              distance > 0.0 ? within(p, inside, distance) : !within(p, outside, -distance);
          ASSERT_EQ(moved.at({i, j, k}), expected) << i << " " << j << " " << k << " " << distance;
        }
  }
  EXPECT_EQ(margin(start, 0.0).count, start.count);
  EXPECT_EQ(margin(start, -50.0).count, 0U);
  EXPECT_EQ(margin(start, 1000.0).count, grid.voxelCount());
  EXPECT_EQ(margin(emptyMask(grid), 2.0).count, 0U);
  EXPECT_THROW(margin(start, NAN), core::InvalidParameter);
}

TEST(Smoothing, KeepsTheVolumeAndTakesNoiseAway)
{
  const core::GridGeometry grid = turnedGrid();
  const Mask clean = ball(grid, grid.center(), 5.0);
  std::mt19937 random(5);
  auto voxels = std::make_shared<volume::Volume<std::uint8_t>>(grid);
  for (std::size_t n = 0; n < voxels->size(); ++n)
    voxels->data()[n] = clean.voxels->data()[n] ^ static_cast<std::uint8_t>(random() % 20 == 0);
  const Mask noisy = makeMask(voxels, grid.fullBox());
  const Mask smooth = smoothed(largestIsland(noisy), 0.7);
  EXPECT_NEAR(static_cast<double>(smooth.count), static_cast<double>(largestIsland(noisy).count),
              2.0);
  EXPECT_GT(dice(largestIsland(smooth), clean), 0.97);
  EXPECT_GT(dice(smooth, clean), dice(noisy, clean));
  const Mask same = smoothed(clean, 0.5);
  EXPECT_NEAR(static_cast<double>(same.count), static_cast<double>(clean.count),
              0.005 * static_cast<double>(clean.count));
  EXPECT_GT(dice(same, clean), 0.995);
  EXPECT_EQ(smoothed(clean, 0.0).count, clean.count);
  EXPECT_THROW(smoothed(clean, -1.0), core::InvalidParameter);
}

TEST(Smoothing, CavitiesThatCloseDoNotMakeTheOutlineSmaller)
{
  const core::GridGeometry grid({60, 60, 60}, Vector3d::Constant(0.25), Vector3d::Zero());
  const double radius = 6.0;
  const Mask clean = ball(grid, grid.center(), radius);
  const Mask core = ball(grid, grid.center(), radius - 1.0);
  const Mask cell = ball(grid, grid.center() + Vector3d(2, 0, 0), 2.5); // large, stays
  std::mt19937 random(7);
  auto voxels = std::make_shared<volume::Volume<std::uint8_t>>(grid);
  for (std::size_t n = 0; n < voxels->size(); ++n)
    voxels->data()[n] = clean.voxels->data()[n] != 0 && cell.voxels->data()[n] == 0 &&
                        (core.voxels->data()[n] == 0 || random() % 50 != 0);
  const Mask holed = makeMask(voxels, grid.fullBox());
  const Mask smooth = smoothedOutline(holed, 0.8);
  EXPECT_LT(static_cast<double>(smoothed(holed, 0.8).count),
            0.99 * static_cast<double>(clean.count));
  EXPECT_NEAR(static_cast<double>(filled(smooth).count), static_cast<double>(clean.count),
              0.001 * static_cast<double>(clean.count));
  EXPECT_GT(dice(filled(smooth), clean), 0.995);
  const Mask left = combined(filled(smooth), smooth, Combination::Difference);
  EXPECT_GT(dice(left, cell), 0.95);
  // Without cavities it is the same.
  EXPECT_EQ(dice(smoothedOutline(clean, 0.5), smoothed(clean, 0.5)), 1.0);
  EXPECT_EQ(smoothedOutline(holed, 0.0).count, holed.count);
}

TEST(Smoothing, KeepsBothVolumesOfAHollowSphere)
{
  const core::GridGeometry grid({60, 60, 60}, Vector3d::Constant(0.25), Vector3d::Zero());
  const Vector3d center = grid.center() + Vector3d(0.04, -0.07, 0.02);
  const auto volumeOf = [](double radius) { return 4.0 / 3.0 * kPi * std::pow(radius, 3); };
  const double voxel = grid.spacing().prod();
  const double radius = 6.0;
  for (const double hole : {2.0, 4.0})
    for (const double sigma : {0.3, 0.8})
    {
      const Mask hollow =
          combined(ball(grid, center, radius), ball(grid, center, hole), Combination::Difference);
      const Mask smooth = smoothedOutline(hollow, sigma);
      const Mask whole = filled(smooth);
      const Mask inner = combined(whole, smooth, Combination::Difference);
      EXPECT_NEAR(static_cast<double>(whole.count) * voxel, volumeOf(radius),
                  0.01 * volumeOf(radius))
          << hole << ", " << sigma;
      EXPECT_NEAR(static_cast<double>(inner.count) * voxel, volumeOf(hole), 0.01 * volumeOf(hole))
          << hole << ", " << sigma;
      EXPECT_GT(dice(inner, ball(grid, center, hole)), 0.97) << hole << ", " << sigma;
    }
  // The Gaussian of a ball of radius sigma is erf(1 / sqrt 2) - sqrt(2 / pi) exp(-1 / 2) = 0.20 at
  // its center: it closes.
  const Mask pore =
      combined(ball(grid, center, radius), ball(grid, center, 0.8), Combination::Difference);
  const Mask closed = smoothedOutline(pore, 0.8);
  EXPECT_EQ(filled(closed).count, closed.count);
}

TEST(Islands, AreCounted)
{
  const core::GridGeometry grid({40, 40, 40}, Vector3d::Constant(0.5), Vector3d::Zero());
  const Mask large = ball(grid, Vector3d(6, 6, 6), 3.0);
  const Mask small = ball(grid, Vector3d(15, 15, 15), 1.5);
  EXPECT_EQ(islandsOf(combined(large, small, Combination::Union)).count, 2U);
  EXPECT_EQ(islandsOf(combined(large, small, Combination::Union)).largest, large.count);
  EXPECT_EQ(islandsOf(large).count, 1U);
  EXPECT_EQ(islandsOf(emptyMask(grid)).count, 0U);
  try
  {
    connectedThreshold(volume::IntensityVolume(std::make_shared<const volume::Volume<std::int16_t>>(
                           grid, std::int16_t{24})),
                       {100.0, 200.0}, {Vector3d(3, 3, 3)}, {}, " HU");
    FAIL();
  }
  catch (const core::InvalidParameter& error)
  {
    EXPECT_NE(std::string(error.what()).find("at the seed (L 3.0  P 3.0  S 3.0 mm) has 24 HU"),
              std::string::npos)
        << error.what();
    EXPECT_NE(std::string(error.what()).find("between 100 and 200 HU"), std::string::npos);
  }
}

TEST(FillingBetweenSlices, MakesAConeOfTwoDiscs)
{
  for (const int axis : {0, 1, 2})
  {
    core::Index3 dims{60, 60, 60};
    dims[static_cast<std::size_t>(axis)] = 21;
    Vector3d spacing = Vector3d::Constant(0.25);
    spacing[axis] = 1.0;
    const core::GridGeometry grid(dims, spacing, Vector3d::Zero());
    const auto radiusAt = [](double along) { return 2.0 + 0.2 * along; }; // mm, of 20 mm
    const auto cone = [&](const Vector3d& p)
    {
      Vector3d off = p - grid.center();
      off[axis] = 0.0;
      return off.norm() <= radiusAt(p[axis]);
    };
    const Mask full = maskOf(grid, cone);
    const Mask drawn = maskOf(grid, [&](const Vector3d& p)
                              { return cone(p) && static_cast<int>(p[axis]) % 5 == 0; });
    const Mask result = filledBetweenSlices(drawn, axis);
    EXPECT_GT(dice(result, full), 0.985) << axis;
    EXPECT_NEAR(result.volume(), full.volume(), 0.015 * full.volume()) << axis;
    EXPECT_THROW(filledBetweenSlices(result, axis), core::InvalidParameter) << "nothing is empty";
  }
  const core::GridGeometry grid({20, 20, 20}, Vector3d::Ones(), Vector3d::Zero());
  EXPECT_THROW(filledBetweenSlices(emptyMask(grid), 2), core::InvalidParameter);
}

TEST(GrowingFromSeeds, FindsTheBorderOfTwoTissuesInNoise)
{
  const core::GridGeometry grid = turnedGrid();
  const Vector3d center = grid.center();
  std::mt19937 random(4);
  std::normal_distribution<double> noise(0.0, 20.0);
  const auto noisy =
      image<std::int16_t>(grid, [&](const Vector3d& p)
                          { return ((p - center).norm() <= 6.0 ? 300.0 : 100.0) + noise(random); });
  const Vector3d x = grid.direction().col(0);
  const Mask in =
      maskOf(grid, [&](const Vector3d& p)
             { return (p - center).cross(x).norm() < 0.6 && std::abs((p - center).dot(x)) < 4.0; });
  const Mask out =
      maskOf(grid, [&](const Vector3d& p) { return std::abs((p - center).norm() - 9.0) < 0.5; });
  const Mask grown = grownFromSeeds(noisy, in, out, grid.fullBox());
  EXPECT_GT(dice(grown, ball(grid, center, 6.0)), 0.97);
  EXPECT_THROW(grownFromSeeds(noisy, in, emptyMask(grid)), core::InvalidParameter);
  EXPECT_THROW(grownFromSeeds(noisy, emptyMask(grid), out), core::InvalidParameter);
}

// Where the image says nothing, the border lies half way between the strokes in millimetres,
// whichever axis has the larger step. Paths of 26 directions are up to 8 % longer than straight.
TEST(GrowingFromSeeds, CountsMillimetresAndNotVoxels)
{
  const Eigen::Matrix3d turn =
      (Eigen::AngleAxisd(0.4, Vector3d::UnitZ()) * Eigen::AngleAxisd(0.3, Vector3d::UnitX()))
          .toRotationMatrix();
  // Rods along x, one inside, one beside 6 mm along `axis` and 3 mm along the other one. How far
  // along `axis` the structure reaches, mm: 3.75, as 3.75^2 = (6 - 3.75)^2 + 3^2.
  const auto reachOn = [](const core::GridGeometry& grid, Eigen::Index axis)
  {
    const auto rod = [&grid](const Vector3d& offset)
    {
      const Vector3d center = grid.center() + grid.direction() * offset;
      const Vector3d x = grid.direction().col(0);
      return maskOf(grid, [&, center, x](const Vector3d& p)
                    { return (p - center).cross(x).norm() <= 0.1; });
    };
    Vector3d offset(0, 3, 3);
    offset[axis] = 6;
    const auto flat = image<std::int16_t>(grid, [](const Vector3d&) { return 100.0; });
    const Mask grown = grownFromSeeds(flat, rod(Vector3d::Zero()), rod(offset), grid.fullBox());
    core::Index3 at{4, grid.dims()[1] / 2, grid.dims()[2] / 2};
    const auto a = static_cast<std::size_t>(axis);
    const int middle = at[a];
    while (at[a] < grid.dims()[a] && grown.at(at))
      ++at[a];
    return (at[a] - 0.5 - middle) * grid.spacing()[axis];
  };
  const core::GridGeometry fine({8, 61, 61}, Vector3d::Constant(0.3), Vector3d(-3, 4, 5));
  for (const bool turned : {false, true})
    for (const Eigen::Index coarse : {1, 2})
    {
      Vector3d spacing = Vector3d::Constant(0.3);
      core::Index3 dims{8, 61, 61};
      spacing[coarse] = 0.6;
      dims[static_cast<std::size_t>(coarse)] = 31; // the same extent
      const core::GridGeometry grid(dims, spacing, Vector3d(-3, 4, 5),
                                    turned ? turn : Eigen::Matrix3d(Eigen::Matrix3d::Identity()));
      for (const Eigen::Index axis : {1, 2})
      {
        const double reach = reachOn(grid, axis);
        EXPECT_NEAR(reach, reachOn(fine, axis), spacing[axis])
            << "axis " << axis << ", coarse " << coarse << ", turned " << turned;
        EXPECT_NEAR(reach, 3.75, 0.08 * 3.75 + 0.5 * spacing[axis]) << axis;
      }
    }
}

TEST(Brush, PaintsTheVoxelsOfABallSweptAlongALine)
{
  const core::GridGeometry grid = turnedGrid();
  const Vector3d from = grid.center() + Vector3d(0.21, -0.1, 0.33);
  const Vector3d to = from + Vector3d(2.0, 3.0, -1.0);
  EditableMask mask(grid);
  mask.beginStep();
  paint(mask, {from, to, 1.7, {}, {}, nullptr}, true);
  mask.endStep();
  const Mask expected =
      maskOf(grid,
             [&](const Vector3d& p)
             {
               const Vector3d along = to - from;
               const double t = std::clamp((p - from).dot(along) / along.squaredNorm(), 0.0, 1.0);
               return (p - from - t * along).norm() <= 1.7;
             });
  EXPECT_EQ(bytesOf(mask.snapshot()), bytesOf(expected));
  EXPECT_NEAR(mask.snapshot().volume(), kPi * 1.7 * 1.7 * ((to - from).norm() + 4.0 / 3.0 * 1.7),
              2.0);
}

TEST(Brush, StaysInOneSliceAndInARange)
{
  const core::GridGeometry grid = turnedGrid();
  const Vector3d at = grid.patientFromVoxel(Vector3d(30, 26, 20.3));
  const Vector3d normal = grid.direction().col(2);
  EditableMask mask(grid);
  mask.beginStep();
  const core::IndexBox changed = paint(mask, {at, at, 2.0, normal, {}, nullptr}, true);
  mask.endStep();
  EXPECT_EQ(changed.lower[2], 20);
  EXPECT_EQ(changed.upper[2], 21);
  EXPECT_GT(mask.count(), 40U);

  const auto ramp = image<std::int16_t>(grid, [&](const Vector3d& p)
                                        { return 100.0 * grid.voxelFromPatient(p)[0]; });
  EditableMask limited(grid);
  limited.beginStep();
  paint(limited, {at, at, 2.0, {}, volume::ValueRange{2950.0, 3050.0}, &ramp}, true);
  limited.endStep();
  EXPECT_EQ(limited.snapshot().extent.lower[0], 30);
  EXPECT_EQ(limited.snapshot().extent.upper[0], 31);

  limited.beginStep();
  EXPECT_TRUE(paint(limited,
                    {at + Vector3d(1e5, 0, 0), at + Vector3d(1e5, 0, 0), 2.0, {}, {}, nullptr},
                    true)
                  .empty());
  EXPECT_THROW(paint(limited, {at, at, 0.0, {}, {}, nullptr}, true), core::InvalidParameter);
  EXPECT_THROW(paint(limited, {at, at, 1.0, Vector3d::Zero().eval(), {}, nullptr}, true),
               core::InvalidParameter);
}

TEST(Operations, CanBeCancelled)
{
  auto token = std::make_shared<core::CancelToken>();
  token->cancel();
  const core::Progress cancelled([](double, const std::string&) {}, token);
  const core::GridGeometry grid = turnedGrid();
  const Mask start = ball(grid, grid.center(), 5.0);
  const auto flat = image<std::int16_t>(grid, [](const Vector3d&) { return 5.0; });
  EXPECT_THROW(threshold(flat, {0, 10}, cancelled), core::CancelledError);
  EXPECT_THROW(largestIsland(start, cancelled), core::CancelledError);
  EXPECT_THROW(margin(start, 1.0, cancelled), core::CancelledError);
  EXPECT_THROW(smoothed(start, 1.0, cancelled), core::CancelledError);
}
