#include <cmath>

#include <gtest/gtest.h>

#include "ShapeCase.h"
#include "petrous/Presenters/PointProbe.h"
#include "petrous/Scene/CaseField.h"

using namespace petrous;
using namespace petrous::presenters;
using namespace petrous::presenters::testing;
using Eigen::Vector3d;

namespace
{

constexpr double kVoxel = 0.4;

core::GridGeometry grid()
{
  return {{51, 51, 51}, Vector3d::Constant(kVoxel), Vector3d::Constant(-25 * kVoxel)};
}

struct Wall
{
  explicit Wall(scene::Case made)
    : value(std::move(made))
    , field(scene::tissueField(value))
    , probe(value, field)
  {
  }
  scene::Case value;
  volume::TissueField field;
  PointProbe probe;
};

double lengthOf(const WallReading& wall, const WallReading::End& end)
{
  return (end.point - wall.surface).norm();
}

} // namespace

// A plate between z = -2 and 3 mm: its surface lies half-way between voxels of bone and of air,
// off by what the threshold of 300 of -1000 to 1000 HU makes of it, less than a voxel.
TEST(Wall, OfAPlateIsItsThickness)
{
  Wall wall(
      shapeCase(grid(), {}, [](const Vector3d& at) { return at.z() > -2.1 && at.z() < 3.1; }));
  const auto reading = wall.probe.wall({1.0, -1.0, 3.4});
  ASSERT_TRUE(reading);
  ASSERT_TRUE(reading->along);
  const auto crossing = [&](double sign)
  {
    double inside = 0.0, outside = 6.0;
    for (int n = 0; n < 40; ++n)
      (wall.field.value({1.0, -1.0, sign * 0.5 * (inside + outside)}) > 0.0 ? inside : outside) =
          0.5 * (inside + outside);
    return inside;
  };
  EXPECT_NEAR(lengthOf(*reading, *reading->along), 5.2, kVoxel);
  EXPECT_NEAR(lengthOf(*reading, *reading->along), crossing(1) + crossing(-1), 0.02);
  EXPECT_NEAR(lengthOf(*reading, *reading->shortest), crossing(1) + crossing(-1), 0.02);
  EXPECT_TRUE(reading->along->behind.empty());
  EXPECT_NEAR(reading->inward.z(), -1.0, 1e-3);
}

// Bone below z = 4 mm with a nerve in it that is as dense: the wall ends at the nerve, and the
// shortest way leads straight to it where the normal misses its nearest point.
TEST(Wall, EndsAtTheNextStructureAndIsShortestTowardsIt)
{
  const Vector3d center(3.0, 0.0, -3.0);
  constexpr double kRadius = 3.0;
  Wall wall(shapeCase(grid(), {{"facial_nerve", ball(center, kRadius)}},
                      [](const Vector3d& at) { return at.z() < 4.1; }));
  const Vector3d above(1.0, 0.0, 4.0);
  const auto reading = wall.probe.wall(above);
  ASSERT_TRUE(reading && reading->along && reading->shortest);
  EXPECT_EQ(reading->along->behind, "facial_nerve");
  EXPECT_EQ(reading->shortest->behind, "facial_nerve");
  const double down = reading->surface.z() - center.z() - std::sqrt(kRadius * kRadius - 4.0);
  EXPECT_NEAR(lengthOf(*reading, *reading->along), down, 0.5 * kVoxel);
  EXPECT_NEAR(lengthOf(*reading, *reading->shortest), (reading->surface - center).norm() - kRadius,
              0.5 * kVoxel);
  EXPECT_LT(lengthOf(*reading, *reading->shortest), lengthOf(*reading, *reading->along) - 0.1);
}

// A labelled bone is the wall itself, and the partitions in a lumen are walls.
TEST(Wall, GoesThroughTheStructureThatItIsOf)
{
  scene::Case value = shapeCase(
      grid(),
      {{"temporal_bone", [](const Vector3d& at) { return at.z() > -1.1 && at.z() < 4.1; }},
       {"sinus", [](const Vector3d& at) { return at.z() < -1.1; }}},
      [](const Vector3d& at) { return at.z() < 4.1; });
  Wall wall(std::move(value));
  const auto reading = wall.probe.wall({0.0, 0.0, 4.2});
  ASSERT_TRUE(reading && reading->along);
  EXPECT_EQ(reading->along->behind, "sinus");
  EXPECT_NEAR(reading->along->point.z(), -1.0, 0.5 * kVoxel); // half-way between two voxels
}

TEST(Wall, IsNoneFarFromASurfaceAndHasNoEndInSolidBone)
{
  Wall wall(shapeCase({{40, 40, 100}, Vector3d::Constant(kVoxel), Vector3d::Zero()}, {},
                      [](const Vector3d& at) { return at.z() < 35.0; }));
  EXPECT_FALSE(wall.probe.wall({8.0, 8.0, 10.0}));
  const auto reading = wall.probe.wall({8.0, 8.0, 35.2});
  ASSERT_TRUE(reading);
  EXPECT_FALSE(reading->along) << "more than 30 mm";
}
