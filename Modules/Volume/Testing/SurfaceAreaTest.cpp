#include "petrous/Volume/SurfaceArea.h"

#include <cmath>
#include <functional>

#include <Eigen/Geometry>

#include <gtest/gtest.h>

#include "TurnedGrid.h"
#include "petrous/Volume/SmoothedUnion.h"

using namespace petrous;
using namespace petrous::volume;
using Eigen::Vector3d;
using petrous::volume::testing::filled;
using petrous::volume::testing::turnedGrid;

namespace
{

constexpr double kPi = 3.14159265358979323846;

bool all(const Vector3d&, const Vector3d&)
{
  return true;
}

} // namespace

TEST(SurfaceArea, IsThatOfABallAndOfItsCap)
{
  const core::GridGeometry grid = turnedGrid({45, 45, 23}, {0.3, 0.3, 0.6});
  const auto occupancy = filled<float>(
      grid, [](const Vector3d& p) { return std::clamp(0.5 + (4.0 - p.norm()) / 2.0, 0.0, 1.0); });
  EXPECT_NEAR(surfaceArea(*occupancy, all) / (4.0 * kPi * 16.0), 1.0, 0.01);
  const Vector3d pole = Vector3d(0.2, -0.7, 0.5).normalized();
  const double cap = surfaceArea(*occupancy,
                                 [&](const Vector3d& point, const Vector3d& outward)
                                 {
                                   EXPECT_NEAR(point.norm(), 4.0, 0.03);
                                   EXPECT_LT((outward - point.normalized()).norm(), 0.1);
                                   return point.dot(pole) > 2.5;
                                 });
  // Trilinear interpolation shrinks the ball by some 0.01 mm, which is 0.01 of the cap.
  EXPECT_NEAR(cap / (2.0 * kPi * 4.0 * 1.5), 1.0, 0.02);
}

TEST(SurfaceArea, IsThatOfALabelledBall)
{
  for (const Vector3d& spacing : {Vector3d(0.25, 0.25, 0.25), Vector3d(0.2, 0.2, 0.4)})
  {
    const core::GridGeometry grid = turnedGrid({50, 50, 50}, spacing);
    const double radius = 4.0;
    const auto occupancy = makeSmoothedUnion(
        makeLabelMap(filled<std::uint16_t>(grid, [&](const Vector3d& p)
                                           { return p.norm() < radius ? 1.0 : 0.0; }),
                     {}),
        [](std::uint16_t) { return true; });
    EXPECT_NEAR(surfaceArea(*occupancy, all) / (4.0 * kPi * radius * radius), 1.0, 0.03);
  }
}

TEST(SurfaceArea, IsNothingWithoutASurface)
{
  const core::GridGeometry grid = turnedGrid({5, 5, 5}, Vector3d::Ones());
  EXPECT_EQ(surfaceArea(Volume<float>(grid, 1.0F), all), 0.0);
  EXPECT_EQ(surfaceArea(Volume<float>(grid, 0.0F), all), 0.0);
}
