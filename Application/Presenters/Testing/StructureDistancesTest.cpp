#include <cmath>

#include <gtest/gtest.h>

#include "petrous/Presenters/StructureDistances.h"

using namespace petrous;
using namespace petrous::presenters;
using Eigen::Vector3d;

namespace
{

// Voxels of 0.5 mm: a plate that fills z < 5 mm, and a sphere of 4 mm radius about (30, 30, 30).
const Vector3d kBall(30.0, 30.0, 30.0);
constexpr double kBallRadius = 4.0;
constexpr double kPlate = 5.0;
constexpr double kRadius = 2.0;

scene::Case twoStructures()
{
  const core::GridGeometry grid({80, 80, 80}, Vector3d::Constant(0.5), Vector3d::Constant(0.25));
  auto labels = std::make_shared<volume::Volume<std::uint16_t>>(grid);
  for (int k = 0; k < 80; ++k)
    for (int j = 0; j < 80; ++j)
      for (int i = 0; i < 80; ++i)
      {
        const Vector3d at = grid.patientFromVoxel({1.0 * i, 1.0 * j, 1.0 * k});
        const bool ball = (at - kBall).norm() < kBallRadius;
        labels->at(i, j, k) = static_cast<std::uint16_t>(at.z() < kPlate ? 1 : ball ? 2 : 0);
      }
  scene::LabelPart part;
  part.labels = std::make_shared<const volume::LabelMap>(volume::makeLabelMap(labels, {}));
  for (const auto& [name, index] : {std::make_pair("plate", 1), std::make_pair("ball", 2)})
  {
    scene::StructurePart structure;
    structure.name = name;
    structure.index = static_cast<std::uint16_t>(index);
    part.structures.push_back(structure);
  }
  scene::Case value;
  value.labels.push_back(part);
  return value;
}

haptics::Pose poseAt(const Vector3d& position)
{
  return {position, Eigen::Quaterniond::Identity()};
}

} // namespace

TEST(StructureDistances, AreThoseOfTheNearestPlaceOnTheWay)
{
  const scene::Case value = twoStructures();
  StructureDistances distances(value, MeasuredTool(kRadius));
  EXPECT_TRUE(distances.smallest().empty());
  // Back and forth over the plate, closest in the middle of the path: 3 mm above it.
  double plate = 1e9, ball = 1e9;
  for (int n = 0; n <= 4000; ++n)
  {
    const double t = 0.001 * n;
    const Vector3d at(20.0 + 6.0 * std::sin(1.3 * t), 20.0 + 6.0 * std::sin(t),
                      kPlate + kRadius + 3.0 + 4.0 * std::abs(std::cos(2.0 * t)));
    distances.add(poseAt(at));
    plate = std::min(plate, at.z() - kPlate - kRadius);
    ball = std::min(ball, (at - kBall).norm() - kBallRadius - kRadius);
  }
  const auto smallest = distances.smallest();
  ASSERT_EQ(smallest.size(), 2u);
  EXPECT_NEAR(smallest.at("plate"), plate, 0.05);
  EXPECT_GT(ball, 3.0);
  EXPECT_NEAR(smallest.at("ball"), ball, 0.1 + 0.05); // its voxels are 0.5 mm
}

TEST(StructureDistances, AreZeroWhereTheBallReachesIn)
{
  const scene::Case value = twoStructures();
  StructureDistances distances(value, MeasuredTool(kRadius));
  distances.add(poseAt({20.0, 20.0, kPlate + kRadius + 0.5}));
  EXPECT_NEAR(distances.smallest().at("plate"), 0.5, 0.01);
  distances.add(poseAt({20.0, 20.0, kPlate + kRadius - 0.5}));
  EXPECT_EQ(distances.smallest().at("plate"), 0.0);
  distances.add(poseAt(kBall)); // deep inside, farther from the surface than its own radius
  EXPECT_EQ(distances.smallest().at("ball"), 0.0);
}

TEST(StructureDistances, ReachAsFarAsAHead)
{
  const scene::Case value = twoStructures();
  StructureDistances distances(value, MeasuredTool(kRadius));
  distances.add(poseAt(kBall + Vector3d(180.0, 0.0, 0.0)));
  EXPECT_NEAR(distances.smallest().at("ball"), 180.0 - kBallRadius - kRadius, 0.15);
}

TEST(StructureDistances, OfAnInstrumentAreThoseOfItsWholeSurface)
{
  const scene::Case value = twoStructures();
  haptics::PointShell needle; // along +z of frame T, its tip at the origin
  for (int n = 0; n <= 100; ++n)
    needle.points.emplace_back(0.0, 0.0, 0.5 * n);
  needle.reach = 50.0;
  needle.burrSpacing = needle.spacing = 0.25;
  StructureDistances distances(value, MeasuredTool(needle));
  // It turns about its tip, which stays 8 mm above the plate; the farthest turn is to 5 degrees
  // below the horizontal, to where the other end is in the plate's direction.
  const Vector3d tip(2.0, 5.0, kPlate + 8.0);
  constexpr double kDegree = 3.14159265358979323846 / 180.0;
  for (int n = 0; n <= 950; ++n)
    distances.add(
        {tip, Eigen::Quaterniond(Eigen::AngleAxisd(0.1 * n * kDegree, Vector3d::UnitY()))});
  // 50 mm long, it would end outside of the grid, over which the plate ends at x = 40.
  const double along = (40.0 - tip.x()) / std::cos(5.0 * kDegree);
  EXPECT_NEAR(distances.smallest().at("plate"), 8.0 - along * std::sin(5.0 * kDegree), 0.3);
  EXPECT_GT(distances.smallest().at("plate"), 4.0);
}
