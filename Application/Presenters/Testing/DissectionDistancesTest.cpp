#include "petrous/Presenters/DissectionDistances.h"

#include <cmath>

#include <gtest/gtest.h>

#include "ShapeCase.h"
#include "petrous/Core/Error.h"

using namespace petrous;
using namespace petrous::presenters;
namespace shapes = petrous::presenters::testing;
using Eigen::Vector3d;

namespace
{

constexpr double kVoxel = 0.5; // mm
const Vector3d kNerve(6.0, 10.0, 10.0);
const Vector3d kVessel(22.0, 10.0, 10.0);
constexpr double kNerveRadius = 2.5;

scene::Case twoBalls()
{
  const core::GridGeometry grid({56, 40, 40}, Vector3d::Constant(kVoxel), {0.0, 0.0, 0.0});
  return shapes::shapeCase(grid, {{"nerve", shapes::ball(kNerve, kNerveRadius)},
                                  {"vessel", shapes::ball(kVessel, 3.0)}});
}

void drill(scene::Case& value, const Vector3d& from, const Vector3d& to, double radius)
{
  value.dissection.beginStroke({});
  value.dissection.cut({from, to, radius});
  value.dissection.endStroke();
}

} // namespace

TEST(DissectionDistances, AreThoseOfBallsOfABurrAndStructures)
{
  scene::Case value = twoBalls();
  drill(value, {14.0, 10.0, 10.0}, {14.0, 14.0, 10.0}, 2.0);
  const auto distances = dissectionDistances(value);
  ASSERT_EQ(distances.size(), 2U);
  EXPECT_EQ(distances[0].name, "vessel");
  EXPECT_EQ(distances[1].name, "nerve");
  // The surfaces of voxels drawn as 0 or 1 lie within a third of a voxel of the balls.
  EXPECT_NEAR(*distances[0].distance.value, 8.0 - 2.0 - 3.0, 0.35 * kVoxel);
  EXPECT_NEAR(*distances[1].distance.value, 8.0 - 2.0 - kNerveRadius, 0.35 * kVoxel);
  EXPECT_NEAR(*distances[0].distance.uncertainty, std::hypot(0.25, 0.25), 1e-12);
  // The place on the wall is the one towards the structure.
  EXPECT_LT((distances[0].place - Vector3d(16.0, 10.0, 10.0)).norm(), 1.5 * kVoxel);
  EXPECT_LT((distances[0].onStructure - Vector3d(19.0, 10.0, 10.0)).norm(), 1.5 * kVoxel);
  for (const DissectionDistance& one : distances)
    EXPECT_NEAR((one.onStructure - one.place).norm(), *one.distance.value, 0.01);
  EXPECT_EQ(distances[0].distance.unit, "mm");
}

TEST(DissectionDistances, AreNoneWithoutACavityAndZeroWhereItReaches)
{
  scene::Case value = twoBalls();
  EXPECT_TRUE(dissectionDistances(value).empty());
  drill(value, {8.0, 10.0, 10.0}, {9.0, 10.0, 10.0}, 2.0);
  const auto distances = dissectionDistances(value);
  ASSERT_EQ(distances.size(), 2U);
  EXPECT_EQ(distances[0].name, "nerve");
  EXPECT_EQ(*distances[0].distance.value, 0.0);
  EXPECT_EQ(distances[0].onStructure, distances[0].place);
  value.dissection.unload();
  EXPECT_THROW(dissectionDistances(value), core::InvalidParameter);
}

// A burr on the border of bricks of 16 voxels, between bone to the left and air to the right, as
// near to a structure in each.
TEST(DissectionDistances, AreOfTissueAcrossBricksAndNotOfAir)
{
  const core::GridGeometry grid({48, 40, 40}, Vector3d::Constant(kVoxel), {0.0, 0.0, 0.0});
  const Vector3d middle(7.75, 7.75, 7.75);
  const auto isBone = [&](const Vector3d& at) { return at.x() < middle.x() + 0.9; };
  scene::Case value = shapes::shapeCase(grid,
                                        {{"left", shapes::ball(middle - Vector3d(5, 0, 0), 1.0)},
                                         {"right", shapes::ball(middle + Vector3d(7, 0, 0), 2.0)}},
                                        isBone);
  drill(value, middle, middle, 2.5);
  const auto distances = dissectionDistances(value);
  ASSERT_EQ(distances.size(), 2U);
  EXPECT_EQ(distances[0].name, "left");
  EXPECT_NEAR(*distances[0].distance.value, 5.0 - 1.0 - 2.5, 0.5 * kVoxel);
  EXPECT_EQ(distances[1].name, "right");
  // bone ends 0.9 mm right of the middle, within a voxel; the burr went on to 2.5 mm
  EXPECT_NEAR(*distances[1].distance.value, 7.0 - 2.0 - 0.9, 1.0 * kVoxel);
}
