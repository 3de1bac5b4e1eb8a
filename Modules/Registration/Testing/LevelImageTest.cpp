#include "LevelImage.h"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "FixedSamples.h"
#include "TestBodies.h"

namespace petrous::registration
{
namespace
{

using namespace testing;

const Eigen::Matrix3d kTilted =
    (Eigen::AngleAxisd(0.3, Vector3d::UnitX()) * Eigen::AngleAxisd(-0.2, Vector3d::UnitZ()))
        .toRotationMatrix();

// A linear function of patient position has the same value at the same place at any level.
TEST(LevelImage, LiesWhereItsImageLies)
{
  const Vector3d slope(3.0, -2.0, 5.0);
  const auto image = imageOf(gridAbout({20, -30, 100}, {60, 50, 48}, {0.5, 0.5, 1.5}, kTilted),
                             [&](const Vector3d& p) { return slope.dot(p); });
  for (const double scale : {1.0, 2.0, 4.0})
  {
    const LevelImage level = makeLevel(*image, scale);
    const core::Index3 dims = level.grid().dims();
    EXPECT_LE(level.grid().minSpacing(), scale * 1.01);
    for (int k = dims[2] / 4; k < 3 * dims[2] / 4; ++k) // smoothing alters the border
      for (int j = dims[1] / 4; j < 3 * dims[1] / 4; ++j)
        for (int i = dims[0] / 4; i < 3 * dims[0] / 4; ++i)
          ASSERT_NEAR(level.voxels.at(i, j, k),
                      slope.dot(level.grid().patientFromVoxel(Vector3d(i, j, k))), 0.02 * scale)
              << scale;
    const LevelImage next = makeLevel(level, 2.0 * scale);
    const core::Index3 mid{next.grid().dims()[0] / 2, next.grid().dims()[1] / 2,
                           next.grid().dims()[2] / 2};
    EXPECT_NEAR(next.voxels.at(mid[0], mid[1], mid[2]),
                slope.dot(next.grid().patientFromVoxel(Vector3d(mid[0], mid[1], mid[2]))),
                0.05 * scale);
  }
}

TEST(LevelImage, LeavesOutPaddingAndWhatIsNoNumber)
{
  auto voxels =
      std::make_shared<volume::Volume<float>>(gridAbout({0, 0, 0}, {20, 20, 20}, {1, 1, 1}), 7.0f);
  for (int k = 0; k < 20; ++k)
    for (int j = 0; j < 20; ++j)
      for (int i = 0; i < 8; ++i)
        voxels->at(i, j, k) = k < 10 ? -2000.0f
                                     : (k < 15 ? std::numeric_limits<float>::quiet_NaN()
                                               : std::numeric_limits<float>::infinity());
  const volume::IntensityVolume image(
      std::shared_ptr<const volume::Volume<float>>(std::move(voxels)), -2000.0);
  const LevelImage level = makeLevel(image, 2.0);
  const core::Index3 dims = level.grid().dims();
  std::size_t holes = 0;
  for (int k = 0; k < dims[2]; ++k)
    for (int j = 0; j < dims[1]; ++j)
      for (int i = 0; i < dims[0]; ++i)
        if (std::isnan(level.voxels.at(i, j, k)))
          ++holes;
        else
          ASSERT_NEAR(level.voxels.at(i, j, k), 7.0f, 1e-4f);
  EXPECT_EQ(holes, 4u * 10u * 10u);
  EXPECT_EQ(level.valid, 6u * 10u * 10u);
}

TEST(LevelImage, RangeLeavesOutAnImplant)
{
  const auto image = imageOf(gridAbout({0, 0, 0}, {50, 50, 50}, {1, 1, 1}),
                             [](const Vector3d& p) { return p.norm() < 2.0 ? 30000.0 : p[0]; });
  const LevelImage level = makeLevel(*image, 1.0);
  EXPECT_LT(level.high, 30.0f);
}

TEST(ContentBox, IsWhatTheImageShows)
{
  const auto image = imageOf(gridAbout({0, 0, 0}, {100, 100, 100}, {2, 2, 2}),
                             [](const Vector3d& p) {
                               return 1000.0 * ellipsoid(p, {10, 0, -5}, {20, 15, 10});
                             });
  const LevelImage level = makeLevel(*image, 2.0);
  const core::IndexBox box = contentBox(level, 4.0);
  const Vector3d low =
      level.grid().patientFromVoxel(Vector3d(box.lower[0], box.lower[1], box.lower[2]));
  const Vector3d high =
      level.grid().patientFromVoxel(Vector3d(box.upper[0] - 1, box.upper[1] - 1, box.upper[2] - 1));
  EXPECT_LT((low - Vector3d(-14, -19, -19)).cwiseAbs().maxCoeff(), 5.0) << low.transpose();
  EXPECT_LT((high - Vector3d(34, 19, 9)).cwiseAbs().maxCoeff(), 5.0) << high.transpose();
}

TEST(FixedSamples, CoverTheirBoxEvenlyAndRepeat)
{
  const auto image = imageOf(gridAbout({0, 0, 0}, {40, 40, 40}, {1, 1, 1}),
                             [](const Vector3d& p) { return p[0]; });
  const LevelImage level = makeLevel(*image, 1.0);
  const FixedSamples samples = drawSamples(level, level.grid().fullBox(), 8000, 5, 32);
  ASSERT_EQ(samples.size(), 8000u);
  std::vector<int> octants(8, 0);
  for (const Eigen::Vector3f& p : samples.points)
    ++octants[static_cast<std::size_t>((p[0] > 0) + 2 * (p[1] > 0) + 4 * (p[2] > 0))];
  for (const int count : octants)
    EXPECT_NEAR(count, 1000, 40); // 30 is one standard deviation for independent samples
  // cube of side 39: RMS distance is side / 2
  EXPECT_NEAR(samples.radius, 19.5, 0.1);
  const FixedSamples again = drawSamples(level, level.grid().fullBox(), 8000, 5, 32);
  EXPECT_EQ(samples.points, again.points);
  EXPECT_EQ(samples.bins, again.bins);
  EXPECT_NE(samples.points, drawSamples(level, level.grid().fullBox(), 8000, 6, 32).points);
  for (std::size_t n = 0; n < samples.size(); ++n)
  {
    const double x = samples.centre[0] + samples.points[n][0];
    const int bin = static_cast<int>((x - level.low) / (level.high - level.low) * 32.0);
    ASSERT_NEAR(samples.bins[n], std::clamp(bin, 0, 31), 1);
  }
}

TEST(Bootstrap, DrawsBlocksWithReplacement)
{
  const auto image = imageOf(gridAbout({0, 0, 0}, {40, 40, 40}, {1, 1, 1}),
                             [](const Vector3d& p) { return p[0]; });
  const LevelImage level = makeLevel(*image, 1.0);
  const FixedSamples samples = drawSamples(level, level.grid().fullBox(), 20'000, 5, 32);
  double mean = 0.0;
  double share = 0.0;
  const int rounds = 40;
  for (int n = 0; n < rounds; ++n)
  {
    const FixedSamples drawn = bootstrap(samples, 5, static_cast<std::uint32_t>(n));
    double weight = 0.0;
    for (const float w : drawn.weights)
      weight += w;
    mean += weight / rounds;
    share += static_cast<double>(drawn.size()) / rounds;
  }
  EXPECT_NEAR(mean, 20'000.0, 800.0);
  EXPECT_NEAR(share / 20'000.0, 1.0 - std::exp(-1.0), 0.02); // of blocks that are drawn at all
}

} // namespace
} // namespace petrous::registration
