#include <algorithm>

#include <gtest/gtest.h>

#include "petrous/Dissection/RemovedVolume.h"
#include "petrous/Dissection/SweptSphereCut.h"

using namespace petrous;
using Eigen::Vector3d;

namespace
{

constexpr double kPi = 3.14159265358979323846;
const core::GridGeometry kGrid({50, 50, 50}, Vector3d::Constant(0.2), Vector3d::Constant(-4.9));

// Bone below z = 0, air above, with the surface exactly at 0.
volume::TissueField halfSpace()
{
  auto v = std::make_shared<volume::Volume<std::int16_t>>(kGrid);
  for (int k = 0; k < 50; ++k)
    for (int j = 0; j < 50; ++j)
      for (int i = 0; i < 50; ++i)
        v->at(i, j, k) = static_cast<std::int16_t>(std::lround(300.0 - 1000.0 * (0.2 * k - 4.9)));
  return {std::make_shared<const volume::IntensityVolume>(
              std::shared_ptr<const volume::Volume<std::int16_t>>(v)),
          {},
          nullptr,
          {}};
}

} // namespace

TEST(RemovedVolume, CountsOnlyTissueNotAir)
{
  const volume::CutMask before(kGrid);
  volume::CutMask mask = before;
  const auto bricks = dissection::cut(mask, {{0, 0, 0}, {0, 0, 0}, 2.0});
  const double half = 2.0 / 3.0 * kPi * 8.0;
  EXPECT_NEAR(dissection::measureRemoved(halfSpace(), before, mask, bricks, {}).total / half, 1.0,
              0.005);
}

TEST(RemovedVolume, ChangedBricksAreThoseThatACutTellsOf)
{
  const volume::CutMask untouched(kGrid);
  volume::CutMask once = untouched;
  auto first = dissection::cut(once, {{-2, -2, -2}, {-2, -2, -2}, 1.0});
  std::sort(first.begin(), first.end());
  EXPECT_EQ(once.cutBricks(), first);
  EXPECT_EQ(dissection::changedBricks(untouched, once), first);
  volume::CutMask twice = once;
  auto second = dissection::cut(twice, {{2, 2, 2}, {2, 2, 2}, 1.0});
  std::sort(second.begin(), second.end());
  EXPECT_EQ(dissection::changedBricks(once, twice), second);
  EXPECT_TRUE(dissection::changedBricks(twice, twice).empty());
}

TEST(RemovedVolume, IsRightForAShallowCut)
{
  // A cap of depth 0.1 mm: here voxel volume times coverage is three times too large.
  const volume::CutMask before(kGrid);
  volume::CutMask mask = before;
  const Vector3d c(0.03, 0.05, 1.9);
  const auto bricks = dissection::cut(mask, {c, c, 2.0});
  const double d = 0.1;
  const double cap = kPi * d * d * (2.0 - d / 3.0);
  EXPECT_NEAR(dissection::measureRemoved(halfSpace(), before, mask, bricks, {}).total / cap, 1.0,
              0.2);
}

TEST(RemovedVolume, CountsASecondCutOnce)
{
  const volume::CutMask untouched(kGrid);
  volume::CutMask first = untouched;
  auto a = dissection::cut(first, {{-0.5, 0, -2}, {-0.5, 0, -2}, 1.5});
  volume::CutMask second = first;
  auto b = dissection::cut(second, {{0.5, 0, -2}, {0.5, 0, -2}, 1.5});
  const auto tissue = halfSpace();
  const double va = dissection::measureRemoved(tissue, untouched, first, a, {}).total;
  const double vb = dissection::measureRemoved(tissue, first, second, b, {}).total;
  std::vector<std::size_t> all = a;
  all.insert(all.end(), b.begin(), b.end());
  const double both = dissection::measureRemoved(tissue, untouched, second, all, {}).total;
  EXPECT_NEAR((va + vb) / both, 1.0, 1e-9);
}

TEST(RemovedVolume, NamesTheStructuresThatWereTouched)
{
  auto labels = std::make_shared<volume::Volume<std::uint16_t>>(kGrid, std::uint16_t{0});
  for (int k = 0; k < 25; ++k)
    for (int j = 0; j < 50; ++j)
      for (int i = 0; i < 50; ++i)
        labels->at(i, j, k) = i < 25 ? 1 : 2; // two halves, split at x = 0
  const auto map = std::make_shared<const volume::LabelMap>(volume::makeLabelMap(labels, {}));
  const volume::CutMask before(kGrid);
  volume::CutMask mask = before;
  const auto bricks = dissection::cut(mask, {{-2, 0, -2}, {-2, 0, -2}, 1.0});
  const auto result = dissection::measureRemoved(halfSpace(), before, mask, bricks,
                                                 {{"left", map, 1}, {"right", map, 2}});
  ASSERT_EQ(result.structures.size(), 1u);
  EXPECT_EQ(result.structures[0].name, "left");
  EXPECT_NEAR(result.structures[0].volume, result.total, 1e-9);
}
