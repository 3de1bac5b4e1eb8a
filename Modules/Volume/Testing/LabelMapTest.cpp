#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include "petrous/Volume/LabelMap.h"
#include "petrous/Volume/Sampling.h"
#include "petrous/Volume/SmoothedUnion.h"

using namespace petrous;
using Eigen::Vector3d;

namespace
{

using Labels = volume::Volume<std::uint16_t>;

std::shared_ptr<Labels> emptyLabels(int n)
{
  return std::make_shared<Labels>(
      core::GridGeometry({n, n, n}, Vector3d::Constant(0.5), Vector3d(1, 2, 3)), std::uint16_t{0});
}

volume::Segment named(const std::string& name, std::uint16_t index)
{
  volume::Segment segment;
  segment.name = name;
  segment.index = index;
  return segment;
}

const auto kAll = [](std::uint16_t) { return true; };

} // namespace

TEST(LabelMap, CountsVoxelsAndNamesTheNameless)
{
  auto voxels = emptyLabels(4);
  voxels->at(0, 0, 0) = 7;
  voxels->at(1, 0, 0) = 7;
  voxels->at(2, 0, 0) = 3;
  const auto map = volume::makeLabelMap(voxels, {named("nerve", 7), named("absent", 9)});
  ASSERT_EQ(map.segments.size(), 3u);
  EXPECT_EQ(map.segments[0].name, "label 3");
  EXPECT_EQ(map.segments[1].name, "nerve");
  EXPECT_EQ(map.segments[1].voxels, 2u);
  EXPECT_DOUBLE_EQ(map.volume(map.segments[1]), 0.25);
  EXPECT_EQ(map.segments[2].voxels, 0u);
}

TEST(LabelMap, KnowsTheBoxOfItsVoxels)
{
  auto voxels = emptyLabels(21);
  const core::IndexBox none;
  EXPECT_EQ(volume::makeLabelMap(voxels, {}).extent, none);
  voxels->at(3, 20, 7) = 1;
  voxels->at(20, 4, 0) = 2;
  const auto map = volume::makeLabelMap(voxels, {});
  const core::IndexBox box{{3, 4, 0}, {21, 21, 8}};
  EXPECT_EQ(map.extent, box);
  EXPECT_EQ(volume::extentOf(map), box);
  EXPECT_EQ(volume::extentOf({voxels, {}}), voxels->geometry().fullBox()) << "not known";
  const core::IndexBox first{{3, 20, 7}, {4, 21, 8}};
  const core::IndexBox second{{20, 4, 0}, {21, 5, 1}};
  EXPECT_EQ(volume::boxesOf(map), (std::vector<core::IndexBox>{first, second}));
}

TEST(LabelMap, RefusesIndicesThatMeanNothingOrTwoThings)
{
  EXPECT_THROW(volume::makeLabelMap(emptyLabels(2), {named("none", 0)}), core::InvalidParameter);
  EXPECT_THROW(volume::makeLabelMap(emptyLabels(2), {named("a", 1), named("b", 1)}),
               core::InvalidParameter);
}

TEST(SmoothedUnion, HasNoVoxelStepsOnAnObliquePlane)
{
  const int n = 40;
  auto voxels = emptyLabels(n);
  const Vector3d normal = Vector3d(1, 2, 3).normalized();
  const auto depth = [&](const Vector3d& v) { return (v - Vector3d::Constant(19.5)).dot(normal); };
  for (int k = 0; k < n; ++k)
    for (int j = 0; j < n; ++j)
      for (int i = 0; i < n; ++i)
        voxels->at(i, j, k) = depth({1.0 * i, 1.0 * j, 1.0 * k}) < 0.0 ? 1 : 0;
  const auto field = volume::makeSmoothedUnion(volume::makeLabelMap(voxels, {}), kAll);
  ASSERT_TRUE(field);
  // Along lines through the plane the 1/2 level must be within a voxel of the true plane, with a
  // spread well below the one voxel of the unsmoothed labels.
  double low = 1e9;
  double high = -1e9;
  for (double a = -6; a <= 6; a += 0.37)
    for (double b = -6; b <= 6; b += 0.41)
    {
      const Vector3d across = normal.unitOrthogonal();
      const Vector3d base = Vector3d::Constant(19.5) + a * across + b * normal.cross(across);
      double inside = -3.0;
      double outside = 3.0;
      while (outside - inside > 1e-4)
      {
        const double middle = 0.5 * (inside + outside);
        const Vector3d p = voxels->geometry().patientFromVoxel(base + middle * normal);
        const bool in =
            volume::sampleTrilinear(*field, field->geometry().voxelFromPatient(p)) > 0.5;
        (in ? inside : outside) = middle;
      }
      low = std::min(low, inside);
      high = std::max(high, inside);
    }
  EXPECT_LT(high - low, 0.75);
  EXPECT_LT(std::abs(0.5 * (high + low)), 0.25);
}

TEST(SmoothedUnion, KeepsAStructureOneVoxelThin)
{
  auto voxels = emptyLabels(12);
  for (int i = 2; i < 10; ++i)
    voxels->at(i, 5, 6) = 4;
  const auto field = volume::makeSmoothedUnion(volume::makeLabelMap(voxels, {}), kAll);
  ASSERT_TRUE(field);
  for (double i = 2.0; i <= 9.0; i += 0.25)
  {
    const Vector3d p = voxels->geometry().patientFromVoxel({i, 5, 6});
    EXPECT_GT(volume::sampleTrilinear(*field, field->geometry().voxelFromPatient(p)), 0.5) << i;
  }
}

TEST(SmoothedUnion, IsClosedWhereTheGridCutsTheStructureOff)
{
  auto voxels = emptyLabels(6);
  std::fill_n(voxels->data(), voxels->size(), std::uint16_t{1});
  const auto field = volume::makeSmoothedUnion(volume::makeLabelMap(voxels, {}), kAll);
  EXPECT_LT(field->at(1, 4, 4), 0.5F);
  EXPECT_GT(field->at(2, 4, 4), 0.5F);
  EXPECT_FLOAT_EQ(field->at(4, 4, 4), 1.0F);
}

TEST(SmoothedUnion, IsNothingWhereNothingIsWanted)
{
  auto voxels = emptyLabels(6);
  voxels->at(2, 2, 2) = 1;
  const auto map = volume::makeLabelMap(voxels, {});
  EXPECT_EQ(volume::makeSmoothedUnion(map, [](std::uint16_t) { return false; }), nullptr);
}
