#include "petrous/Volume/IntensityHistogram.h"

#include <limits>
#include <numeric>

#include <gtest/gtest.h>

using namespace petrous;
using volume::IntensityHistogram;

namespace
{

template <class T>
volume::IntensityVolume line(const std::vector<T>& values,
                             std::optional<double> padding = std::nullopt)
{
  const core::GridGeometry grid({static_cast<int>(values.size()), 1, 1}, Eigen::Vector3d::Ones(),
                                Eigen::Vector3d::Zero());
  auto v = std::make_shared<volume::Volume<T>>(grid);
  std::copy(values.begin(), values.end(), v->data());
  return volume::IntensityVolume(std::shared_ptr<const volume::Volume<T>>(v), padding);
}

std::uint64_t sum(const IntensityHistogram& histogram)
{
  return std::accumulate(histogram.bins().begin(), histogram.bins().end(), std::uint64_t{0});
}

} // namespace

TEST(IntensityHistogram, CountsEveryVoxelOnceAndNoneWithoutAValue)
{
  const float nan = std::numeric_limits<float>::quiet_NaN();
  const float inf = std::numeric_limits<float>::infinity();
  const IntensityHistogram floats(line<float>({1, nan, 2, inf, -inf, -5, -5, 9}, -5.0), 4);
  EXPECT_EQ(floats.count(), 3u);
  EXPECT_EQ(sum(floats), 3u);
  EXPECT_EQ(floats.range().min, 1.0);
  EXPECT_EQ(floats.range().max, 9.0);

  const IntensityHistogram shorts(line<std::int16_t>({-2000, 3, 3, 4, -2000, 40}, -2000.0), 4);
  EXPECT_EQ(shorts.count(), 4u);
  EXPECT_EQ(shorts.bins(), (std::vector<std::uint64_t>{3, 0, 0, 1}));
  EXPECT_EQ(shorts.binWidth(), 10.0);
  EXPECT_EQ(shorts.center(0), 7.5); // 3 to 12
}

TEST(IntensityHistogram, HoldsTheWholeRangeOfSixteenBits)
{
  const IntensityHistogram plus(line<std::uint16_t>({0, 65535, 65535}));
  EXPECT_EQ(plus.bins().front(), 1u);
  EXPECT_EQ(plus.bins().back(), 2u);
  const IntensityHistogram both(line<std::int16_t>({-32768, 32767}));
  EXPECT_EQ(both.range().min, -32768.0);
  EXPECT_EQ(both.bins().size(), 1024u);
  EXPECT_EQ(both.bins().back(), 1u);
}

TEST(IntensityHistogram, GivesThePercentilesOfARamp)
{
  std::vector<float> ramp(100000);
  std::iota(ramp.begin(), ramp.end(), 0.0F);
  const IntensityHistogram histogram(line(ramp));
  for (const double share : {0.0, 0.01, 0.25, 0.5, 0.999, 1.0})
    EXPECT_NEAR(histogram.percentile(share), share * 99999.0, 3.0);
  EXPECT_NEAR(histogram.percentile(0.5, 80000.0), 90000.0, 3.0);
  EXPECT_NEAR(histogram.percentile(0.5, -7.0), 50000.0, 3.0);
  EXPECT_EQ(histogram.percentile(0.5, 1e9), 99999.0);

  std::vector<std::uint16_t> whole(50000);
  std::iota(whole.begin(), whole.end(), std::uint16_t{100});
  EXPECT_NEAR(IntensityHistogram(line(whole)).percentile(0.3), 15100.0, 3.0);
}

TEST(IntensityHistogram, KeepsItsBinsForTheBulkWhenAFewValuesAreFarOut)
{
  std::vector<float> values(100000);
  for (std::size_t i = 0; i < values.size(); ++i)
    values[i] = static_cast<float>(i % 1000);
  values[77] = 1e30F;
  values[78] = -3e38F;
  const IntensityHistogram histogram(line(values));
  EXPECT_EQ(sum(histogram), values.size());
  EXPECT_LT(histogram.binWidth(), 17.0);
  EXPECT_NEAR(histogram.percentile(0.5), 500.0, 17.0);
  EXPECT_EQ(histogram.range().max, static_cast<double>(1e30F));

  std::vector<std::uint16_t> whole(100000, 9);
  whole[5] = 60000;
  EXPECT_EQ(IntensityHistogram(line(whole)).bins().size(), 1u);
}

TEST(IntensityHistogram, StandsForOneValueAndForNone)
{
  const IntensityHistogram one(line<float>({42.5F, 42.5F}));
  EXPECT_EQ(one.count(), 2u);
  EXPECT_EQ(one.percentile(0.3), 42.5);
  const IntensityHistogram none(line<std::int16_t>({-1, -1}, -1.0));
  EXPECT_EQ(none.count(), 0u);
  EXPECT_TRUE(none.bins().empty());
  EXPECT_EQ(none.percentile(0.3), 0.0);
  EXPECT_EQ(IntensityHistogram(line<float>({std::nanf("")})).count(), 0u);
  EXPECT_THROW(IntensityHistogram(line<float>({1.0F}), 1), core::InvalidParameter);
}
