#include "petrous/Volume/DistanceMap.h"

#include <functional>
#include <random>

#include <Eigen/Geometry>

#include <gtest/gtest.h>

#include "petrous/Volume/Sampling.h"
#include "petrous/Volume/SmoothedUnion.h"

using namespace petrous;
using namespace petrous::volume;
using Eigen::Vector3d;

namespace
{

using Distance = std::function<double(const Vector3d&)>;

core::GridGeometry turnedGrid(int edge, const Vector3d& spacing)
{
  const Eigen::Matrix3d turn =
      Eigen::AngleAxisd(0.7, Vector3d(1.0, -0.4, 0.5).normalized()).toRotationMatrix();
  const Vector3d half = 0.5 * (edge - 1) * spacing;
  return {{edge, edge, edge}, spacing, -(turn * half), turn};
}

// Occupancy linear across the surface.
Volume<float> occupancyOf(const Distance& distance, const core::GridGeometry& grid)
{
  Volume<float> occupancy(grid);
  const core::Index3& n = grid.dims();
  for (int k = 0; k < n[2]; ++k)
    for (int j = 0; j < n[1]; ++j)
      for (int i = 0; i < n[0]; ++i)
        occupancy.at(i, j, k) = static_cast<float>(
            std::clamp(0.5 + distance(grid.patientFromVoxel({double(i), double(j), double(k)})) /
                                 (6.0 * grid.minSpacing()),
                       0.0, 1.0));
  return occupancy;
}

Vector3d randomIn(std::mt19937& random, double half)
{
  std::uniform_real_distribution<double> uniform(-half, half);
  const double x = uniform(random);
  const double y = uniform(random);
  return {x, y, uniform(random)};
}

double ball(const Vector3d& p, double radius)
{
  return radius - p.norm();
}

// The smoothed union of a labelled shape, as in a case.
std::shared_ptr<const Volume<float>> labelled(const Distance& distance,
                                              const core::GridGeometry& grid)
{
  auto voxels = std::make_shared<Volume<std::uint16_t>>(grid);
  const core::Index3& n = grid.dims();
  for (int k = 0; k < n[2]; ++k)
    for (int j = 0; j < n[1]; ++j)
      for (int i = 0; i < n[0]; ++i)
        voxels->at(i, j, k) =
            distance(grid.patientFromVoxel({double(i), double(j), double(k)})) > 0.0 ? 1 : 0;
  return makeSmoothedUnion(makeLabelMap(voxels, {}),
                           [](std::uint16_t index) { return index == 1; });
}

} // namespace

TEST(DistanceMap, IsTheDistanceInsideAndOutsideABall)
{
  const double h = 0.3;
  const auto grid = turnedGrid(41, Vector3d::Constant(h));
  const auto map =
      makeDistanceMap(occupancyOf([](const Vector3d& p) { return ball(p, 4.0); }, grid), grid);
  std::mt19937 random(3);
  int deep = 0;
  for (int n = 0; n < 20000; ++n)
  {
    const Vector3d p = randomIn(random, 4.4);
    const Vector3d voxel = map->geometry().voxelFromPatient(p);
    const double truth = ball(p, 4.0);
    if (truth < -0.5)
      continue;
    ASSERT_EQ(map->away(voxel), 0.0);
    const DistanceMap::Sample sample = map->at(voxel);
    EXPECT_EQ(sample.depth, map->depth(p));
    if (p.norm() < h)
    {
      // The ridge in the middle is rounded.
      EXPECT_NEAR(sample.depth, truth, h);
      ++deep;
      continue;
    }
    ASSERT_NEAR(sample.depth, truth, 0.02 * h + 0.01 * std::max(truth, 0.0)) << p.transpose();
    ASSERT_LT((sample.gradient + p.normalized()).norm(), 0.04 + 0.1 * h / p.norm());
  }
  EXPECT_GT(deep, 0);
  EXPECT_NEAR(map->deepest(), 4.0, 0.5 * h);
}

TEST(DistanceMap, IsTheDistanceOfAPlaneInLongVoxels)
{
  const Vector3d normal = Vector3d(0.3, -0.5, 0.8).normalized();
  const auto grid = turnedGrid(25, {0.4, 0.4, 0.9});
  const auto map = makeDistanceMap(
      occupancyOf([&](const Vector3d& p) { return 0.1 - normal.dot(p); }, grid), grid);
  std::mt19937 random(5);
  int seen = 0;
  for (int n = 0; n < 5000; ++n)
  {
    const Vector3d p = randomIn(random, 2.0);
    const double truth = 0.1 - normal.dot(p);
    if (std::abs(truth) > 0.8)
      continue;
    ++seen;
    const DistanceMap::Sample sample = map->at(map->geometry().voxelFromPatient(p));
    ASSERT_NEAR(sample.depth, truth, 0.004);
    ASSERT_LT((sample.gradient + normal).norm(), 0.02);
  }
  EXPECT_GT(seen, 500);
}

// The rendered surface is the 1/2 level of the labels' smoothed union, including its ripples.
TEST(DistanceMap, IsZeroOnTheSurfaceThatIsSeen)
{
  const double h = 0.4;
  const auto grid = turnedGrid(45, Vector3d::Constant(h));
  struct Shape
  {
    const char* name;
    Distance distance;
  };
  const std::vector<Shape> shapes{
      {"ball", [](const Vector3d& p) { return ball(p, 5.0); }},
      {"small ball", [](const Vector3d& p) { return ball(p, 1.5); }},
      {"tube",
       [](const Vector3d& p) { return std::min(1.2 - p.head<2>().norm(), 6.0 - std::abs(p.z())); }},
      {"plate", [](const Vector3d& p)
       { return std::min(0.9 - std::abs(p.x() + 0.3 * p.y()), 6.0 - p.norm()); }},
  };
  std::mt19937 random(8);
  for (const Shape& shape : shapes)
  {
    SCOPED_TRACE(shape.name);
    const auto occupancy = labelled(shape.distance, grid);
    const auto map = makeDistanceMap(*occupancy, grid);
    double sum = 0.0;
    double most = 0.0;
    int count = 0;
    for (int n = 0; n < 1000000 && count < 3000; ++n)
    {
      const Vector3d from = randomIn(random, 7.0);
      const Vector3d to = from + h * randomIn(random, 1.0);
      const auto inside = [&](const Vector3d& p)
      {
        const Vector3d voxel = occupancy->geometry().voxelFromPatient(p);
        return occupancy->geometry().hullContains(voxel) &&
               sampleTrilinear(*occupancy, voxel) > 0.5;
      };
      if (!inside(from) || inside(to))
        continue;
      Vector3d in = from;
      Vector3d out = to;
      for (int turn = 0; turn < 40; ++turn)
      {
        const Vector3d middle = 0.5 * (in + out);
        (inside(middle) ? in : out) = middle;
      }
      ++count;
      const double error = std::abs(map->depth(in)) / h;
      sum += error;
      most = std::max(most, error);
    }
    EXPECT_GT(count, 300);
    EXPECT_LE(sum / count, 0.02);
    EXPECT_LE(most, 0.08); // at the rims of tube and plate
  }
}

TEST(DistanceMap, ItsGradientIsItsOwn)
{
  const double h = 0.3;
  const auto grid = turnedGrid(31, Vector3d::Constant(h));
  const auto map = makeDistanceMap(
      occupancyOf([](const Vector3d& p) { return std::min(ball(p, 3.0), 0.8 - std::abs(p.x())); },
                  grid),
      grid);
  std::mt19937 random(4);
  for (int n = 0; n < 3000; ++n)
  {
    const Vector3d p = randomIn(random, 2.0);
    const Vector3d voxel = map->geometry().voxelFromPatient(p);
    if (map->away(voxel) > 0.0)
      continue;
    const Vector3d gradient = map->at(voxel).gradient;
    const double step = 1e-5;
    for (int a = 0; a < 3; ++a)
    {
      const Vector3d by = step * Vector3d::Unit(a);
      ASSERT_NEAR((map->depth(p + by) - map->depth(p - by)) / (2.0 * step), gradient[a], 2e-3);
    }
    EXPECT_LE(gradient.norm(), 1.3);
  }
}

TEST(DistanceMap, BoundsTheWayToTheStructureFarFromIt)
{
  const auto grid = turnedGrid(31, Vector3d::Constant(0.3));
  const auto map =
      makeDistanceMap(occupancyOf([](const Vector3d& p) { return ball(p, 2.0); }, grid), grid);
  std::mt19937 random(4);
  int far = 0;
  for (int n = 0; n < 3000; ++n)
  {
    const Vector3d p = randomIn(random, 20.0);
    const double away = map->away(map->geometry().voxelFromPatient(p));
    EXPECT_LE(away, std::max(0.0, p.norm() - 2.0) + 1e-3);
    far += away > 5.0;
  }
  EXPECT_GT(far, 500);
}

TEST(DistanceMap, EndsWhereTheGridsEnd)
{
  const auto grid = turnedGrid(21, Vector3d::Constant(0.5));
  const auto all = makeDistanceMap(occupancyOf([](const Vector3d&) { return 3.0; }, grid), grid);
  EXPECT_NEAR(all->depth(grid.center()), 5.0, 0.3);
  EXPECT_NEAR(all->depth(grid.patientFromVoxel({0.0, 10.0, 10.0})), 0.0, 0.03);
  EXPECT_NEAR(all->depth(grid.patientFromVoxel({2.0, 10.0, 10.0})), 1.0, 0.03);
  EXPECT_NEAR(all->depth(grid.patientFromVoxel({-1.0, 10.0, 10.0})), -0.5, 0.03);
  const auto domain = grid.cropped({{5, 0, 0}, {21, 21, 21}});
  const auto part = makeDistanceMap(occupancyOf([](const Vector3d&) { return 3.0; }, grid), domain);
  EXPECT_NEAR(part->depth(grid.patientFromVoxel({7.0, 10.0, 10.0})), 1.0, 0.03);
}

TEST(DistanceMap, KeepsToItsMemoryAndSaysNothingOfNothing)
{
  const auto grid = turnedGrid(41, Vector3d::Constant(0.3));
  const Volume<float> occupancy = occupancyOf([](const Vector3d& p) { return ball(p, 4.0); }, grid);
  const auto coarse = makeDistanceMap(occupancy, grid, {}, 20000);
  EXPECT_LE(coarse->bytes(), 20000 * sizeof(float));
  EXPECT_NEAR(coarse->depth({0.0, 2.0, 0.0}), 2.0, 0.1);
  EXPECT_NEAR(coarse->depth({0.0, 0.0, 4.0}), 0.0, 0.1);
  EXPECT_EQ(makeDistanceMap(occupancyOf([](const Vector3d&) { return -3.0; }, grid), grid),
            nullptr);
}
