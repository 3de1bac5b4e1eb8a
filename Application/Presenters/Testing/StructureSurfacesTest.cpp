#include "petrous/Presenters/StructureSurfaces.h"

#include <gtest/gtest.h>

using namespace petrous;
using namespace petrous::presenters;
using Eigen::Vector3d;

namespace
{

const Vector3d kBall(4.0, -3.0, 10.0);
const Vector3d kOther(16.0, -3.0, 10.0);
constexpr double kVoxel = 0.4;  // mm
constexpr double kRadius = 3.0; // mm
// The smoothed voxel surface is within a fifth of a voxel of the sphere.
constexpr double kBias = 0.2 * kVoxel;

// Two spheres, with indices 3 and 7, on a grid rotated about z.
scene::Case balls()
{
  scene::Case value;
  Eigen::Matrix3d axes;
  axes << 0.6, -0.8, 0.0, 0.8, 0.6, 0.0, 0.0, 0.0, 1.0;
  const Vector3d middle = 0.5 * (kBall + kOther);
  const core::GridGeometry grid({70, 70, 40}, Vector3d::Constant(kVoxel),
                                middle - axes * Vector3d(14.0, 14.0, 8.0), axes);
  auto voxels = std::make_shared<volume::Volume<std::uint16_t>>(grid, std::uint16_t{0});
  for (int k = 0; k < 40; ++k)
    for (int j = 0; j < 70; ++j)
      for (int i = 0; i < 70; ++i)
      {
        const Vector3d at = grid.patientFromVoxel({1.0 * i, 1.0 * j, 1.0 * k});
        voxels->at(i, j, k) = (at - kBall).norm() < kRadius    ? 3
                              : (at - kOther).norm() < kRadius ? 7
                                                               : 0;
      }
  scene::LabelPart part;
  part.labels = std::make_shared<const volume::LabelMap>(volume::makeLabelMap(
      voxels, {{"facial_nerve", 3, {1.0F, 1.0F, 0.0F}, 0}, {"carotid", 7, {1.0F, 0.0F, 0.0F}, 0}}));
  for (const auto& [name, index] : {std::pair("facial_nerve", 3), std::pair("carotid", 7)})
  {
    scene::StructurePart structure;
    structure.name = name;
    structure.index = static_cast<std::uint16_t>(index);
    part.structures.push_back(structure);
  }
  value.labels.push_back(part);
  return value;
}

bool any(const std::string&)
{
  return true;
}

} // namespace

TEST(StructureSurfaces, TellTheNearestStructureAndHowFarItIs)
{
  const scene::Case value = balls();
  StructureSurfaces surfaces(value);
  for (const Vector3d& away :
       {Vector3d(0.0, 0.0, 3.3), Vector3d(-4.0, 1.0, 2.0), Vector3d(2.0, 4.0, -3.0),
        Vector3d(-8.0, -7.0, 9.0), Vector3d(5.0, 0.0, 0.0)})
  {
    const auto near = surfaces.nearest(kBall + away, 20.0, any);
    ASSERT_TRUE(near);
    EXPECT_EQ(near->name, "facial_nerve");
    EXPECT_NEAR(near->distance, away.norm() - kRadius, kBias) << away.transpose();
  }
  const auto other = surfaces.nearest(kOther + Vector3d(0.0, 5.0, 0.0), 20.0, any);
  ASSERT_TRUE(other);
  EXPECT_EQ(other->name, "carotid");
}

TEST(StructureSurfaces, LeaveOutWhatIsNotWantedOrTooFar)
{
  const scene::Case value = balls();
  StructureSurfaces surfaces(value);
  const Vector3d place = kBall + Vector3d(-4.0, 0.0, 0.0);
  const auto near =
      surfaces.nearest(place, 20.0, [](const std::string& name) { return name == "carotid"; });
  ASSERT_TRUE(near);
  EXPECT_EQ(near->name, "carotid");
  EXPECT_NEAR(near->distance, 16.0 - kRadius, kBias);
  EXPECT_FALSE(surfaces.nearest(place, 0.5, any));
  EXPECT_FALSE(StructureSurfaces(scene::Case()).nearest(place, 20.0, any));
}
