#include <gtest/gtest.h>

#include "petrous/Volume/CutMask.h"

using namespace petrous;
using Eigen::Vector3d;
using volume::CutMask;

namespace
{

const core::GridGeometry kGrid({40, 20, 17}, Vector3d::Ones(), Vector3d::Zero());

CutMask::BrickVersion filled(std::uint16_t value)
{
  auto brick = std::make_shared<CutMask::Brick>();
  brick->fill(value);
  return brick;
}

} // namespace

TEST(CutMask, StartsUntouchedAndCostsNoVoxels)
{
  const CutMask mask(kGrid);
  EXPECT_TRUE(mask.untouched());
  EXPECT_EQ(mask.brickDims(), (core::Index3{3, 2, 2}));
  EXPECT_EQ(mask.at(39, 19, 16), CutMask::kUntouched);
  EXPECT_DOUBLE_EQ(mask.sample({3.3, 4.4, 5.5}), 1.0);
  EXPECT_LT(mask.residentBytes(), sizeof(CutMask::Brick));
}

TEST(CutMask, TellsWhereItWasCut)
{
  CutMask mask(kGrid);
  EXPECT_TRUE(mask.cutBricks().empty());
  EXPECT_TRUE(mask.untouched(kGrid.fullBox()));
  const std::size_t brick = mask.brickIndex({1, 0, 1});
  mask.setBrick(brick, filled(0));
  EXPECT_EQ(mask.cutBricks(), (std::vector<std::size_t>{brick}));
  EXPECT_FALSE(mask.untouched(kGrid.fullBox()));
  EXPECT_FALSE(mask.untouched({{31, 15, 16}, {33, 16, 17}})) << "its corner";
  EXPECT_TRUE(mask.untouched({{32, 0, 0}, {40, 20, 17}}));
  EXPECT_TRUE(mask.untouched({{0, 0, 0}, {40, 20, 16}}));
  EXPECT_TRUE(mask.untouched({})) << "no voxel";
}

TEST(CutMask, BrickBoxesTileTheGrid)
{
  const CutMask mask(kGrid);
  std::size_t voxels = 0;
  for (std::size_t b = 0; b < mask.brickCount(); ++b)
    voxels += mask.brickBox(b).count();
  EXPECT_EQ(voxels, kGrid.voxelCount());
}

TEST(CutMask, InterpolatesAcrossBricks)
{
  CutMask mask(kGrid);
  mask.setBrick(0, filled(0));
  EXPECT_DOUBLE_EQ(mask.sample({15.0, 3, 3}), 0.0);
  EXPECT_DOUBLE_EQ(mask.sample({15.25, 3, 3}), 0.25);
  EXPECT_DOUBLE_EQ(mask.sample({16.0, 3, 3}), 1.0);
  EXPECT_DOUBLE_EQ(mask.sample({15.5, 15.5, 3}), 0.75);
}

TEST(CutMask, ListsEachDirtyBrickOnce)
{
  CutMask mask(kGrid);
  mask.setBrick(5, filled(1));
  mask.setBrick(2, filled(1));
  mask.setBrick(5, filled(2));
  EXPECT_EQ(mask.takeDirty(), (std::vector<std::size_t>{5, 2}));
  EXPECT_TRUE(mask.takeDirty().empty());
  mask.setBrick(5, nullptr);
  EXPECT_EQ(mask.takeDirty(), (std::vector<std::size_t>{5}));
}

TEST(CutMask, CopiesShareVersionsAndDoNotFollow)
{
  CutMask mask(kGrid);
  mask.setBrick(0, filled(7));
  const CutMask copy = mask;
  EXPECT_EQ(copy.brick(0), mask.brick(0));
  mask.setBrick(0, filled(3));
  EXPECT_EQ(copy.at(0, 0, 0), 7);
  EXPECT_EQ(mask.at(0, 0, 0), 3);
}

TEST(CutMask, DenseAgreesVoxelByVoxel)
{
  CutMask mask(kGrid);
  auto brick = std::make_shared<CutMask::Brick>();
  for (std::size_t n = 0; n < brick->size(); ++n)
    (*brick)[n] = static_cast<std::uint16_t>(n);
  mask.setBrick(mask.brickIndex({2, 1, 0}), brick);
  const auto dense = mask.dense();
  for (int k = 0; k < 17; ++k)
    for (int j = 0; j < 20; ++j)
      for (int i = 0; i < 40; ++i)
        ASSERT_EQ(dense.at(i, j, k), mask.at(i, j, k));
  EXPECT_EQ(dense.at(33, 17, 2), 1 + 16 * (1 + 16 * 2));
}

TEST(CutMask, BoxOfBricksReachesOneVoxelFurther)
{
  const CutMask mask(kGrid);
  EXPECT_EQ(mask.boxOf({mask.brickIndex({1, 0, 0})}), (core::IndexBox{{15, 0, 0}, {33, 17, 17}}));
  EXPECT_TRUE(mask.boxOf({}).empty());
}
