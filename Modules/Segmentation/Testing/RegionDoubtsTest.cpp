#include <algorithm>
#include <cmath>
#include <memory>
#include <random>

#include <gtest/gtest.h>

#include "petrous/Core/Error.h"
#include "petrous/Segmentation/MaskOperations.h"
#include "petrous/Segmentation/RegionDoubts.h"

using namespace petrous;
using namespace petrous::segmentation;
using Eigen::Vector3d;

namespace
{

constexpr double kAir = -1000.0, kTissue = 50.0, kBone = 1200.0, kNoise = 30.0;

core::GridGeometry grid(double spacing = 0.5)
{
  return {{60, 40, 40}, Vector3d::Constant(spacing), Vector3d::Zero()};
}

/// Air to x = 10 mm, tissue to 20 mm, then bone, with noise; a voxel's width of partial volume. The
/// same voxels of another size where `spacing` is not 0.5 mm.
volume::IntensityVolume layers(double spacing = 0.5)
{
  std::mt19937 random(4);
  std::normal_distribution<double> noise(0.0, kNoise);
  auto voxels = std::make_shared<volume::Volume<std::int16_t>>(grid(spacing));
  const auto share = [](double depth) { return std::min(1.0, std::max(0.0, 0.5 + depth / 0.5)); };
  for (int k = 0; k < 40; ++k)
    for (int j = 0; j < 40; ++j)
      for (int i = 0; i < 60; ++i)
      {
        const double x = 0.5 * i;
        const double value = kAir + (kTissue - kAir) * share(x - 10.0) +
                             (kBone - kTissue) * share(x - 20.0) + noise(random);
        voxels->at(i, j, k) = static_cast<std::int16_t>(std::lround(value));
      }
  return volume::IntensityVolume(std::shared_ptr<const volume::Volume<std::int16_t>>(voxels),
                                 std::nullopt);
}

/// A canal of fluid along z in bone, two voxels wide, and from the voxel `air` on along x a cell.
volume::IntensityVolume canalBesideAir(int air)
{
  std::mt19937 random(5);
  std::normal_distribution<double> noise(0.0, kNoise);
  auto voxels = std::make_shared<volume::Volume<std::int16_t>>(grid());
  for (int k = 0; k < 40; ++k)
    for (int j = 0; j < 40; ++j)
      for (int i = 0; i < 60; ++i)
      {
        const bool isFluid = i >= 30 && i < 32 && j >= 20 && j < 22;
        const bool isAir = i >= air && i < air + 10 && j >= 12 && j < 30 && k >= 12 && k < 30;
        voxels->at(i, j, k) = static_cast<std::int16_t>(std::lround((isFluid ? kTissue
                                                                     : isAir ? kAir
                                                                             : kBone) +
                                                                    noise(random)));
      }
  return volume::IntensityVolume(std::shared_ptr<const volume::Volume<std::int16_t>>(voxels),
                                 std::nullopt);
}

} // namespace

// The cell is darker than the bone as the fluid is, and wide enough for a neighbourhood of its own.
TEST(SurroundingsOf, NoPlaceInAnotherTissueLiesInside)
{
  const auto image = canalBesideAir(33);
  const Vector3d seed(15.0, 10.0, 10.0);
  const auto found = surroundingsOf(image, seed);
  ASSERT_TRUE(found);
  EXPECT_TRUE(found->isBorder);
  EXPECT_FALSE(found->isBrighter);
  EXPECT_FALSE(found->isNearOwn(kAir)) << found->darker << ' ' << found->width;
  EXPECT_FALSE(found->inside) << "the canal is too thin";
}

TEST(RangeAround, IsThatOfACanalAndNotOfTheAirBehindItsWall)
{
  for (const int air : {33, 34})
  {
    const auto image = canalBesideAir(air);
    const Vector3d seed(15.5, 10.0, 10.0);
    const volume::ValueRange range = rangeAround(image, seed, surroundingsOf(image, seed));
    EXPECT_GT(range.min, 0.5 * (kAir + kTissue)) << air;
    EXPECT_LT(range.max, 0.5 * (kTissue + kBone)) << air;
  }
}

TEST(SurroundingsOf, TheKnownRangeOfTheImageIsTaken)
{
  const auto image = layers();
  const Vector3d seed(10.5, 10.0, 10.0);
  const volume::ValueRange usual = usualRange(image);
  EXPECT_NEAR(usual.min, kAir, 4.0 * kNoise);
  EXPECT_NEAR(usual.max, kBone, 4.0 * kNoise);
  EXPECT_TRUE(surroundingsOf(image, seed, usual));
  EXPECT_FALSE(surroundingsOf(image, seed, volume::ValueRange{-1e6, 1e6})) << "a small step of it";
}

TEST(SurroundingsOf, OneTissueIsNoBorder)
{
  const auto image = layers();
  for (const double x : {5.0, 15.0, 25.0})
    for (const double y : {3.0, 10.0, 17.0})
      EXPECT_FALSE(surroundingsOf(image, Vector3d(x, y, 10.0))) << x;
}

TEST(SurroundingsOf, ABorderHasTheMeansOfBothAndAPlaceInside)
{
  const auto image = layers();
  const Vector3d seed(10.5, 10.0, 10.0); // the first voxel of tissue
  const auto found = surroundingsOf(image, seed);
  ASSERT_TRUE(found);
  EXPECT_TRUE(found->isBorder);
  EXPECT_TRUE(found->isBrighter);
  EXPECT_NEAR(found->darker, kAir, 300.0);
  EXPECT_NEAR(found->brighter, kTissue, 300.0);
  ASSERT_TRUE(found->inside);
  EXPECT_GT(found->inside->x(), 11.0);
  EXPECT_LE((*found->inside - seed).norm(), 2.5);
  EXPECT_FALSE(surroundingsOf(image, *found->inside));
}

// Down to those of a micro-CT, and to what no scanner makes: the search is one of a few voxels.
TEST(SurroundingsOf, APlaceInsideIsFoundForVoxelsOfAnySize)
{
  for (const double spacing : {0.02, 0.008, 1e-10})
  {
    const auto image = layers(spacing);
    const auto found = surroundingsOf(image, Vector3d(21.0, 20.0, 20.0) * spacing);
    ASSERT_TRUE(found) << spacing;
    EXPECT_TRUE(found->isBorder) << spacing;
    ASSERT_TRUE(found->inside) << spacing;
    EXPECT_GT(found->inside->x(), 22.0 * spacing) << spacing;
    EXPECT_LE((*found->inside - Vector3d(21.0, 20.0, 20.0) * spacing).norm(), 12.0 * spacing);
  }
}

TEST(SurroundingsOf, TwoVoxelsFromABorderTheSeedIsOnNone)
{
  const auto found = surroundingsOf(layers(), Vector3d(11.0, 10.0, 10.0));
  ASSERT_TRUE(found) << "its neighbourhood has both";
  EXPECT_FALSE(found->isBorder);
  EXPECT_FALSE(found->inside);
}

TEST(SurroundingsOf, ASeedOutsideOfTheImageIsRefused)
{
  EXPECT_THROW(surroundingsOf(layers(), Vector3d(-5.0, 10.0, 10.0)), core::InvalidParameter);
}

TEST(RangeAround, IsThatOfTheSeedsTissueBesideABorder)
{
  const auto image = layers();
  for (const double x : {10.5, 19.5})
  {
    const volume::ValueRange range =
        rangeAround(image, Vector3d(x, 10.0, 10.0), surroundingsOf(image, Vector3d(x, 10.0, 10.0)));
    EXPECT_GT(range.min, 0.5 * (kAir + kTissue)) << x;
    EXPECT_LT(range.max, 0.5 * (kTissue + kBone)) << x;
    EXPECT_LT(range.min, kTissue) << x;
    EXPECT_GT(range.max, kTissue) << x;
  }
}

TEST(DoubtsOf, NamesALargeRegionAndFaces)
{
  const core::GridGeometry large({40, 40, 40}, Vector3d::Ones(), Vector3d::Zero()); // 64 cm^3
  const auto maskOf = [&](const core::IndexBox& box)
  {
    auto voxels = volume::makeZeroVolume<std::uint8_t>(large);
    for (int k = box.lower[2]; k < box.upper[2]; ++k)
      for (int j = box.lower[1]; j < box.upper[1]; ++j)
        for (int i = box.lower[0]; i < box.upper[0]; ++i)
          voxels->at(i, j, k) = 1;
    return makeMask(voxels, large.fullBox());
  };
  const RegionDoubts all = doubtsOf(maskOf(large.fullBox()));
  ASSERT_TRUE(all.volume && all.faces);
  EXPECT_DOUBLE_EQ(*all.volume, 64e3);
  EXPECT_EQ(*all.faces, 6);

  const RegionDoubts vessel = doubtsOf(maskOf({{10, 10, 0}, {15, 15, 40}}));
  EXPECT_FALSE(vessel.volume);
  EXPECT_FALSE(vessel.faces) << "it leaves through two";
  EXPECT_EQ(doubtsOf(maskOf({{0, 0, 0}, {5, 5, 5}})).faces, 3);

  const RegionDoubts small = doubtsOf(maskOf({{10, 10, 10}, {15, 15, 15}}));
  EXPECT_FALSE(small.volume || small.faces);
}
