#include <random>

#include <gtest/gtest.h>

#include "LabelPainting.h"

using namespace petrous;
using namespace petrous::testing;
using Eigen::Matrix3d;
using Eigen::Vector3d;

namespace
{

// A speck on its own grid, only to force resampling of the others to that grid.
volume::LabelSource speck(double spacing, const Vector3d& at, const Matrix3d& direction)
{
  return {paintBox(cube(5, spacing, at, direction), {{2, 2, 2}, {3, 3, 3}}), 1, 255, true};
}

// Length of the segment inside.
double insideAlong(const volume::LabelField& field, const Vector3d& from, const Vector3d& to)
{
  constexpr int n = 2000;
  int inside = 0;
  for (int s = 0; s < n; ++s)
    inside += occupancyAt(field, from + (to - from) * ((s + 0.5) / n)) > 0.5 ? 1 : 0;
  return (to - from).norm() * inside / n;
}

struct Radius
{
  double bias = 0.0;
  double deviation = 0.0;
  double cubed = 0.0; // mean of r^3: the volume up to 4/3 pi
};

// Radius of a ball of radius R around `center`, from its surface along random directions.
Radius radiusOf(const volume::LabelField& field, const Vector3d& center, double R)
{
  std::mt19937 random(3);
  std::normal_distribution<double> normal;
  Radius result;
  constexpr int n = 2000;
  double squares = 0.0;
  for (int s = 0; s < n; ++s)
  {
    const Vector3d u = Vector3d(normal(random), normal(random), normal(random)).normalized();
    double in = 0.5 * R;
    double out = 1.5 * R;
    while (out - in > 1e-4)
    {
      const double middle = 0.5 * (in + out);
      (occupancyAt(field, center + middle * u) > 0.5 ? in : out) = middle;
    }
    result.bias += (in - R) / n;
    squares += (in - R) * (in - R) / n;
    result.cubed += in * in * in / n;
  }
  result.deviation = std::sqrt(squares - result.bias * result.bias);
  return result;
}

} // namespace

TEST(LabelResampling, KeepsABallsSize)
{
  const double R = 2.0;
  for (const double h : {0.1, 0.2, 0.4})
    for (const bool other : {false, true})
    {
      const Vector3d center(0.03, -0.05, 0.02);
      const Labels ball =
          paint(cube(static_cast<int>(2 * R / h) + 8, h, Vector3d::Zero(), turned()),
                [&](const Vector3d& p) { return (p - center).norm() < R ? 1 : 0; });
      std::vector<volume::LabelSource> sources{{ball, 1, 1, true}};
      if (other)
        sources.push_back(speck(0.6 * h, {0.0, 0.0, R + 1.0}, Matrix3d::Identity()));
      const auto field = volume::makeLabelField(sources);
      const Radius radius = radiusOf(*field, center, R);
      EXPECT_NEAR(radius.bias, 0.0, 0.04 * h) << h << " " << other;
      EXPECT_LT(radius.deviation, 0.12 * h) << h << " " << other;
      EXPECT_NEAR(std::cbrt(radius.cubed), R, 0.04 * h) << "volume";
    }
}

TEST(LabelResampling, KeepsATubeOfACoarserMapAtItsWidth)
{
  const double h = 0.4;
  const double R = 1.0;
  const Labels tube = paint(cube(40, h, Vector3d::Zero(), turned()), [&](const Vector3d& p)
                            { return std::hypot(p[0], p[1]) < R && std::abs(p[2]) < 4 ? 1 : 0; });
  const auto field = volume::makeLabelField(
      {{tube, 1, 1, true}, speck(0.15, {0.0, 0.0, 7.0}, Matrix3d::Identity())});
  double mean = 0.0;
  constexpr int n = 900;
  for (int s = 0; s < n; ++s)
  {
    const double angle = 0.7 * s;
    const double z = -3.0 + 6.0 * s / n;
    const Vector3d u(std::cos(angle), std::sin(angle), 0.0);
    mean += insideAlong(*field, {0, 0, z}, Vector3d(0, 0, z) + 2.0 * u) / n;
  }
  EXPECT_NEAR(mean, R, 0.1 * h);
}

TEST(LabelResampling, KeepsASheetOneVoxelThin)
{
  // Plane and thickness of the sheet, and orientation of the common grid to it.
  const double h = 0.4;
  for (const double spacing : {0.4, 0.39, 0.3, 0.2, 0.15})
    for (const bool turn : {false, true})
    {
      const Matrix3d direction = turn ? turned() : Matrix3d::Identity();
      const auto grid = cube(24, h, {0.1, 0.07, 0.0}, direction);
      const Labels sheet = paintBox(grid, {{0, 0, 12}, {24, 24, 13}});
      const auto field = volume::makeLabelField(
          {{sheet, 1, 1, true}, speck(spacing * 0.999, {0.0, 0.0, 9.0}, Matrix3d::Identity())});
      double thickness = 0.0;
      int count = 0;
      for (double i = 3.0; i < 20.0; i += 0.37)
        for (double j = 3.0; j < 20.0; j += 0.41)
        {
          const Vector3d low = grid.patientFromVoxel({i, j, 10});
          const Vector3d high = grid.patientFromVoxel({i, j, 14});
          const double length = insideAlong(*field, low, high);
          ASSERT_GT(length, 0.0) << spacing << " " << turn << " at " << i << " " << j;
          thickness += length;
          ++count;
        }
      thickness /= count;
      EXPECT_GT(thickness, 0.5 * h) << spacing << " " << turn;
      EXPECT_LT(thickness, 1.4 * h) << spacing << " " << turn;
    }
}

TEST(LabelResampling, KeepsWhatIsThinnerThanACommonVoxel)
{
  // The common grid has smaller voxels, but slices of 1 mm; the sheet and the thread have half that
  // thickness, and lie in none of its planes.
  const core::GridGeometry slices({60, 60, 20}, {0.2, 0.2, 1.0}, {-6.0, -6.0, -10.0});
  const auto grid = cube(24, 0.5, {0.13, 0.11, 0.5});
  auto thin = std::make_shared<volume::Volume<std::uint16_t>>(grid, std::uint16_t{0});
  for (int i = 3; i < 20; ++i)
  {
    for (int j = 3; j < 20; ++j)
      thin->at(i, j, 16) = 1;
    thin->at(i, 11, 6) = 2;
  }
  const auto map = std::make_shared<volume::LabelMap>(volume::makeLabelMap(std::move(thin), {}));
  const Labels other = paintBox(slices, {{2, 2, 2}, {4, 4, 4}});
  const auto field =
      volume::makeLabelField({{map, 1, 1, true}, {map, 2, 2, true}, {other, 1, 3, true}});
  ASSERT_NEAR(field->occupancy->geometry().spacing()[2], 1.0, 1e-9);
  for (double i = 4.0; i < 19.0; i += 0.3)
  {
    const auto through = [&](double j, double k)
    {
      return insideAlong(*field, grid.patientFromVoxel({i, j, k - 4}),
                         grid.patientFromVoxel({i, j, k + 4}));
    };
    for (double j = 4.0; j < 19.0; j += 0.7)
      ASSERT_GT(through(j, 16), 0.0) << i << " " << j;
    ASSERT_GT(through(11, 6), 0.0) << i;
    EXPECT_LT(through(11, 6), 2.0) << "mm";
  }
}

TEST(LabelResampling, TakesTheFinestMapOfASolidForItsGrid)
{
  const Labels coarse = paintBox(cube(20, 0.5), {{4, 4, 4}, {10, 10, 10}});
  const Labels fine = paintBox(cube(30, 0.2, {5, 0, 0}), {{4, 4, 4}, {10, 10, 10}});
  const Labels finest = paintBox(cube(30, 0.1, {-5, 0, 0}), {{4, 4, 4}, {10, 10, 10}});
  const volume::LabelSource a{coarse, 1, 1, true};
  const volume::LabelSource b{fine, 1, 2, true};
  const volume::LabelSource lumen{finest, 1, 3, false};
  const auto hand = volume::makeLabelField({a, b});
  const auto eye = volume::makeLabelField({a, lumen, b});
  EXPECT_DOUBLE_EQ(hand->occupancy->geometry().minSpacing(), 0.2);
  // A lumen has no effect on haptics.
  std::mt19937 random(9);
  std::uniform_real_distribution<double> uniform(-6.0, 6.0);
  for (int n = 0; n < 20000; ++n)
  {
    const Vector3d p(uniform(random), uniform(random), uniform(random));
    ASSERT_NEAR(occupancyAt(*hand, p), occupancyAt(*eye, p), 1e-4);
  }
  EXPECT_EQ(indexAt(*eye, finest->voxels->geometry().patientFromVoxel({7, 7, 7})), 3);
}

TEST(LabelResampling, IsCoarserThanTheFinestMapWhereMemoryEndsAndSaysSo)
{
  const Labels fine = paintBox(cube(40, 0.05, {8, 8, 8}), {{5, 5, 20}, {35, 35, 21}});
  const Labels coarse = paintBox(cube(40, 0.5), {{5, 5, 5}, {30, 30, 30}}, 2);
  constexpr std::size_t most = 1'000'000;
  const auto field = volume::makeLabelField({{fine, 1, 1, true}, {coarse, 2, 2, true}}, {}, most);
  EXPECT_LE(field->occupancy->size(), most);
  ASSERT_EQ(field->notes.size(), 1u);
  EXPECT_NE(field->notes.front().find("million voxels"), std::string::npos);
  // The sheet is one voxel of 0.05 mm thick, a common voxel is 0.2 mm or more.
  const core::GridGeometry& grid = fine->voxels->geometry();
  for (double i = 7; i < 33; i += 1.3)
    EXPECT_GT(insideAlong(*field, grid.patientFromVoxel({i, 19.0, 0.0}),
                          grid.patientFromVoxel({i, 19.0, 39.0})),
              0.0);
  EXPECT_TRUE(volume::makeLabelField({{coarse, 2, 2, true}}, {}, 1)->notes.empty())
      << "one map alone stays on its grid";
}
