#include <gtest/gtest.h>

#include "petrous/Core/AxesCorrection.h"
#include "petrous/Volume/OnGrid.h"

using namespace petrous;
using Eigen::Vector3d;

namespace
{

const core::GridGeometry kStated({7, 5, 3}, Vector3d(0.4, 0.5, 1.0), Vector3d(10, 20, 30));

} // namespace

TEST(OnGrid, PlacesTheSameVoxelsElsewhere)
{
  auto voxels = std::make_shared<volume::Volume<std::int16_t>>(kStated, std::int16_t{-1000});
  voxels->at(6, 1, 2) = 1200;
  const void* memory = voxels->data();
  auto stated = std::make_shared<const volume::IntensityVolume>(
      std::shared_ptr<const volume::Volume<std::int16_t>>(voxels), -2000.0);
  const core::GridGeometry mirrored = core::AxesCorrection::parse("RPS").applied(kStated);
  const auto placed = volume::onGrid(stated, mirrored);
  stated.reset();
  voxels.reset(); // the memory is the placed volume's, too
  EXPECT_EQ(placed->at(6, 1, 2), 1200.0);
  EXPECT_EQ(placed->padding(), -2000.0);
  EXPECT_TRUE(core::sameGrid(placed->geometry(), mirrored));
  placed->visit([memory](const auto& volume) { EXPECT_EQ(volume.data(), memory) << "not copied"; });
}

TEST(OnGrid, KeepsStructuresAndTheirVolumes)
{
  auto voxels = volume::makeZeroVolume<std::uint16_t>(kStated);
  voxels->at(1, 2, 0) = 4;
  voxels->at(2, 2, 0) = 4;
  const volume::LabelMap stated = volume::makeLabelMap(voxels, {{"incus", 4}});
  const volume::LabelMap placed =
      volume::onGrid(stated, core::AxesCorrection::parse("SLA").applied(kStated));
  ASSERT_EQ(placed.segments.size(), 1U);
  EXPECT_EQ(placed.segments[0].name, "incus");
  EXPECT_NEAR(placed.volume(placed.segments[0]), 2 * 0.4 * 0.5 * 1.0, 1e-12);
  EXPECT_EQ(placed.voxels->at(1, 2, 0), 4);
}

TEST(OnGrid, RefusesAGridOfAnotherSize)
{
  const auto voxels = volume::makeZeroVolume<std::uint16_t>(kStated);
  EXPECT_THROW(volume::onGrid(volume::LabelMap{voxels, {}},
                              core::GridGeometry({7, 5, 4}, Vector3d::Ones(), Vector3d::Zero())),
               core::InvalidParameter);
  EXPECT_THROW(volume::onGrid(volume::LabelMap(), kStated), core::InvalidParameter);
  EXPECT_THROW(volume::onGrid(std::shared_ptr<const volume::IntensityVolume>(), kStated),
               core::InvalidParameter);
}
