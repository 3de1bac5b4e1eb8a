#include <gtest/gtest.h>

#include "petrous/Volume/TissueExtent.h"

using namespace petrous;
using Eigen::Vector3d;

namespace
{

volume::IntensityVolume cubeWithSpeck(bool speck, std::int16_t bone)
{
  const core::GridGeometry grid({100, 100, 100}, Vector3d::Constant(0.5), Vector3d(10, 20, 30));
  auto v = std::make_shared<volume::Volume<std::int16_t>>(grid, std::int16_t{-1000});
  for (int k = 20; k <= 40; ++k)
    for (int j = 20; j <= 40; ++j)
      for (int i = 20; i <= 40; ++i)
        v->at(i, j, k) = bone;
  if (speck)
    v->at(98, 98, 98) = bone;
  return volume::IntensityVolume(std::shared_ptr<const volume::Volume<std::int16_t>>(v));
}

} // namespace

TEST(TissueExtent, FramesTheTissueAndNotASpeckFarOff)
{
  for (const bool speck : {false, true})
  {
    const auto extent = volume::tissueExtent(cubeWithSpeck(speck, 1000), 300);
    EXPECT_LT((extent.center - Vector3d(25, 35, 45)).norm(), 1.0);
    EXPECT_NEAR(extent.radius, 1.05 * std::sqrt(3.0) * 5.0, 1.0);
  }
}

TEST(TissueExtent, BoxesTheTissueWithoutWhatIsBesideIt)
{
  for (const bool speck : {false, true})
  {
    const auto box = volume::tissueBox(cubeWithSpeck(speck, 1000), 300, 0.01);
    EXPECT_LT((box.min() - Vector3d(20, 30, 40)).norm(), 1e-9);
    EXPECT_LT((box.max() - Vector3d(30, 40, 50)).norm(), 1e-9);
  }
  const auto whole = volume::tissueBox(cubeWithSpeck(false, 0), 300, 0.01);
  EXPECT_LT((whole.max() - Vector3d(59.5, 69.5, 79.5)).norm(), 1e-9);
}

TEST(TissueExtent, FramesTheWholeGridWhereThereIsNoTissue)
{
  const auto extent = volume::tissueExtent(cubeWithSpeck(false, 0), 300);
  EXPECT_LT((extent.center - Vector3d(34.75, 44.75, 54.75)).norm(), 1e-9);
}

namespace
{

// A head, a ball of 90 mm in air, in a box of 40 mm whose middle is `depth` mm below the skin of
// its `side` (1: left). The rows of the grid run along patient axis `axis`, `flipped` or not.
volume::IntensityVolume earOf(int side, double depth, int axis, bool flipped)
{
  constexpr double kHead = 90.0;
  Eigen::Matrix3d direction = Eigen::Matrix3d::Identity();
  direction.col(0).swap(direction.col(axis));
  if (flipped)
    direction.col(axis) *= -1.0; // the patient's left-right axis
  const Vector3d middle(side * (kHead - depth), 0.0, 0.0);
  const core::GridGeometry centred({40, 40, 40}, Vector3d::Ones(), Vector3d::Zero(), direction);
  const core::GridGeometry grid({40, 40, 40}, Vector3d::Ones(), middle - centred.center(),
                                direction);
  auto v = std::make_shared<volume::Volume<std::int16_t>>(grid);
  for (int k = 0; k < 40; ++k)
    for (int j = 0; j < 40; ++j)
      for (int i = 0; i < 40; ++i)
        v->at(i, j, k) = grid.patientFromVoxel(Vector3d(i, j, k)).norm() < kHead ? 40 : -1000;
  return volume::IntensityVolume(std::shared_ptr<const volume::Volume<std::int16_t>>(v));
}

} // namespace

TEST(TissueExtent, AnEarOpensIntoTheAirOnItsOwnSide)
{
  for (const int side : {1, -1})
    for (const int axis : {0, 1, 2})
      for (const bool flipped : {false, true})
        EXPECT_EQ(volume::openSide(earOf(side, 15.0, axis, flipped), -500.0), side)
            << axis << flipped;
  EXPECT_EQ(volume::openSide(earOf(1, 60.0, 0, false), -500.0), 0) << "no air in it";
  EXPECT_EQ(volume::openSide(earOf(1, 90.0, 0, false), -500.0), 0) << "the middle of the head";
}
