#include "petrous/Volume/SurfaceDistance.h"

#include <functional>
#include <random>

#include <Eigen/Geometry>

#include <gtest/gtest.h>

#include "TurnedGrid.h"
#include "petrous/Volume/Sampling.h"
#include "petrous/Volume/SmoothedUnion.h"

using namespace petrous;
using namespace petrous::volume;
using Eigen::Vector3d;
using petrous::volume::testing::filled;
using petrous::volume::testing::turnedGrid;

namespace
{

using Distance = std::function<double(const Vector3d&)>; // mm, negative inside

constexpr double kFar = 1000.0;

// Occupancy linear across the surface.
std::shared_ptr<const Volume<float>> occupancyOf(const Distance& distance,
                                                 const core::GridGeometry& grid)
{
  return filled<float>(grid,
                       [&](const Vector3d& p) {
                         return std::clamp(0.5 - distance(p) / (6.0 * grid.minSpacing()), 0.0, 1.0);
                       });
}

// The smoothed union of a labelled shape, as in a case.
std::shared_ptr<const Volume<float>> labelled(const Distance& distance,
                                              const core::GridGeometry& grid)
{
  return makeSmoothedUnion(
      makeLabelMap(
          filled<std::uint16_t>(grid, [&](const Vector3d& p) { return distance(p) < 0.0 ? 1 : 0; }),
          {}),
      [](std::uint16_t index) { return index == 1; });
}

Vector3d randomIn(std::mt19937& random, double half)
{
  std::uniform_real_distribution<double> uniform(-half, half);
  const double x = uniform(random);
  const double y = uniform(random);
  return {x, y, uniform(random)};
}

// Dense points on the surface occupancy = 1/2, where the lines of a lattice of `parts` per voxel
// meet it. No part of the surface is farther from one than half the diagonal of a lattice cell.
std::vector<Vector3d> pointsOf(const Volume<float>& occupancy, int parts)
{
  std::vector<Vector3d> points;
  const core::Index3& dims = occupancy.geometry().dims();
  const auto value = [&](const Vector3d& v) { return sampleTrilinear(occupancy, v) - 0.5; };
  for (int k = 0; k < (dims[2] - 1) * parts; ++k)
    for (int j = 0; j < (dims[1] - 1) * parts; ++j)
      for (int i = 0; i < (dims[0] - 1) * parts; ++i)
      {
        const Vector3d from = Vector3d(i, j, k) / parts;
        const double here = value(from);
        if (std::abs(here) > 0.499)
          continue;
        for (int a = 0; a < 3; ++a)
        {
          const double there = value(from + Vector3d::Unit(a) / parts);
          if ((here > 0.0) != (there > 0.0))
            points.push_back(occupancy.geometry().patientFromVoxel(
                from + Vector3d::Unit(a) * (here / (here - there) / parts)));
        }
      }
  return points;
}

} // namespace

TEST(SurfaceDistance, IsThatOfABallNearAndFar)
{
  const double h = 0.3;
  const Distance ball = [](const Vector3d& p) { return p.norm() - 4.0; };
  const SurfaceDistance surface(occupancyOf(ball, turnedGrid({33, 33, 33}, Vector3d::Constant(h))));
  std::mt19937 random(3);
  for (int n = 0; n < 20000; ++n)
  {
    const Vector3d p = randomIn(random, n % 2 == 0 ? 4.7 : 80.0);
    ASSERT_NEAR(surface.at(p, kFar), ball(p), 0.02 * h) << p.transpose();
  }
}

TEST(SurfaceDistance, IsThatOfAPlaneInLongVoxels)
{
  const Vector3d normal = Vector3d(0.3, -0.5, 0.8).normalized();
  const Distance plane = [&](const Vector3d& p) { return normal.dot(p) - 0.1; };
  const SurfaceDistance surface(occupancyOf(plane, turnedGrid({61, 61, 31}, {0.4, 0.4, 1.0})));
  std::mt19937 random(5);
  int seen = 0;
  for (int n = 0; n < 5000; ++n)
  {
    const Vector3d p = randomIn(random, 6.0);
    if ((p - plane(p) * normal).norm() > 8.0)
      continue; // the plane ends with its grid
    ++seen;
    ASSERT_NEAR(surface.at(p, kFar), plane(p), 0.002) << p.transpose();
  }
  EXPECT_GT(seen, 3000);
}

// From the centre of the hole all sides are equally near, and the tree cannot be pruned.
TEST(SurfaceDistance, IsThatOfARing)
{
  const Distance ring = [](const Vector3d& p)
  { return std::hypot(std::hypot(p.x(), p.y()) - 6.0, p.z()) - 2.0; };
  const SurfaceDistance surface(
      occupancyOf(ring, turnedGrid({49, 49, 49}, Vector3d::Constant(0.4))));
  std::mt19937 random(7);
  for (int n = 0; n < 10000; ++n)
  {
    const Vector3d p =
        randomIn(random, 9.0) + (n % 3 == 0 ? Vector3d(0.0, 30.0, 5.0) : Vector3d(0.0, 0.0, 0.0));
    ASSERT_NEAR(surface.at(p, kFar), ring(p), 0.02) << p.transpose();
  }
  EXPECT_NEAR(surface.at({0.0, 0.0, 0.0}, kFar), 4.0, 0.02);
}

// The reference is the surface of the label, whatever shape it was drawn from. The slice spacing is
// three times the pixel spacing.
TEST(SurfaceDistance, IsThatToTheSurfaceOfALabel)
{
  const core::GridGeometry grid = turnedGrid({40, 40, 16}, {0.3, 0.3, 0.9});
  const Distance shapes[] = {[](const Vector3d& p) { return p.norm() - 3.1; },
                             [](const Vector3d& p)
                             { return std::hypot(std::hypot(p.x(), p.z()) - 3.4, p.y()) - 0.8; },
                             [](const Vector3d& p) { return p.cwiseAbs().maxCoeff() - 2.0; }};
  for (const Distance& shape : shapes)
  {
    const auto occupancy = labelled(shape, grid);
    const SurfaceDistance surface(occupancy);
    constexpr int parts = 8;
    const auto points = pointsOf(*occupancy, parts);
    ASSERT_GT(points.size(), 1000U);
    const double gap = 0.5 * grid.spacing().norm() / parts;
    std::mt19937 random(11);
    for (int n = 0; n < 300; ++n)
    {
      const Vector3d p = randomIn(random, n % 2 == 0 ? 5.0 : 12.0);
      double nearest = kFar;
      for (const Vector3d& point : points)
        nearest = std::min(nearest, (p - point).norm());
      const Vector3d voxel = occupancy->geometry().voxelFromPatient(p);
      const bool inside =
          occupancy->geometry().hullContains(voxel) && sampleTrilinear(*occupancy, voxel) > 0.5;
      const double found = surface.at(p, kFar);
      ASSERT_EQ(found < 0.0, inside) << p.transpose();
      // The points are on the surface: it is no farther, and nearer by at most their gap.
      ASSERT_LE(std::abs(found), nearest + 0.02) << p.transpose();
      ASSERT_GE(std::abs(found), nearest - std::min(gap, gap * gap / nearest + 0.02))
          << p.transpose();
    }
  }
}

// The truth of the ball, near and far, in voxels that are twice as long as wide.
TEST(SurfaceDistance, BoundsItselfFromBelowByLessThanACell)
{
  const Distance ball = [](const Vector3d& p) { return p.norm() - 4.0; };
  const Vector3d spacing(0.3, 0.3, 0.6);
  const SurfaceDistance surface(occupancyOf(ball, turnedGrid({33, 33, 17}, spacing)));
  std::mt19937 random(4);
  int inside = 0;
  double largest = 0.0;
  for (int n = 0; n < 20000; ++n)
  {
    const Vector3d p = randomIn(random, n % 2 == 0 ? 4.5 : 60.0);
    const double away = ball(p), bound = surface.bound(p, kFar);
    if (std::abs(away) < 0.05) // by the grid it may be on the other side
      continue;
    if (away < 0.0)
    {
      ++inside;
      ASSERT_LE(bound, 0.0) << p.transpose();
      continue;
    }
    ASSERT_LE(bound, away + 0.02) << p.transpose();
    ASSERT_GE(bound, away - spacing.norm() - 0.02) << p.transpose();
    largest = std::max(largest, away - bound);
    ASSERT_LE(surface.bound(p, 5.0), 5.0);
  }
  EXPECT_GT(inside, 500);
  EXPECT_GT(largest, 0.3) << "no cell was looked into";
  EXPECT_EQ(surface.bound({0.0, 30.0, 0.0}, 2.0), 2.0);
}

TEST(SurfaceDistance, SaysNoMoreThanWasAskedFor)
{
  const Distance ball = [](const Vector3d& p) { return p.norm() - 4.0; };
  const core::GridGeometry grid = turnedGrid({33, 33, 33}, Vector3d::Constant(0.3));
  const SurfaceDistance surface(occupancyOf(ball, grid));
  EXPECT_EQ(surface.at({0.0, 9.0, 0.0}, 2.0), 2.0);
  EXPECT_EQ(surface.at({0.0, 0.5, 0.0}, 2.0), -2.0);
  EXPECT_NEAR(surface.at({0.0, 5.0, 0.0}, 2.0), 1.0, 0.01);
  EXPECT_GT(surface.bytes(), grid.voxelCount() * sizeof(float));
  const SurfaceDistance nothing(std::make_shared<const Volume<float>>(grid, 0.0F));
  EXPECT_EQ(nothing.at({0.0, 0.0, 0.0}, 7.0), 7.0);
  EXPECT_THROW(SurfaceDistance(nullptr), core::InvalidParameter);
}

TEST(LabelMap, TellsTheBoxOfEachSegment)
{
  const core::GridGeometry grid({9, 8, 7}, {1.0, 1.0, 1.0}, Vector3d::Zero());
  auto voxels = std::make_shared<Volume<std::uint16_t>>(grid, std::uint16_t{0});
  voxels->at(2, 3, 1) = 7;
  voxels->at(5, 1, 6) = 7;
  voxels->at(8, 7, 0) = 3;
  const auto boxes = boxesOf(makeLabelMap(voxels, {{"gone", 5, {}, 0}}));
  ASSERT_EQ(boxes.size(), 3U);
  EXPECT_EQ(boxes[0], (core::IndexBox{{8, 7, 0}, {9, 8, 1}}));
  EXPECT_TRUE(boxes[1].empty());
  EXPECT_EQ(boxes[2], (core::IndexBox{{2, 1, 1}, {6, 4, 7}}));
}
