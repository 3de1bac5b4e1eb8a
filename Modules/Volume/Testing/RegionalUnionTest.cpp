// Smoothing by region against the whole, bit by bit.

#include <cmath>
#include <cstring>
#include <random>

#include <gtest/gtest.h>

#include "LabelPainting.h"
#include "petrous/Volume/RegionalUnion.h"

using namespace petrous;
using Eigen::Vector3d;

namespace
{

const core::GridGeometry kLong({330, 44, 44}, Vector3d(0.3, 0.3, 0.4), Vector3d(-40, 10, 5));

// A tube that winds along the grid, longer than the support of a voxel; a tilted sheet one voxel
// thin; an oblique rod of one voxel; grains that touch by edges and corners; a ball.
petrous::testing::Labels windingLabels()
{
  auto voxels = std::make_shared<volume::Volume<std::uint16_t>>(kLong, std::uint16_t{0});
  const auto& n = kLong.dims();
  std::mt19937 random(7);
  for (int k = 0; k < n[2]; ++k)
    for (int j = 0; j < n[1]; ++j)
      for (int i = 0; i < n[0]; ++i)
      {
        const double y = 14 + 5 * std::sin(0.07 * i);
        const double z = 14 + 5 * std::cos(0.05 * i);
        std::uint16_t& label = voxels->at(i, j, k);
        if (std::hypot(j - y, k - z) < 4.3 + 1.5 * std::sin(0.31 * i))
          label = 1;
        else if (std::lround(30 + 0.02 * i + 0.1 * k) == j && i > 20 && i < 310)
          label = 2;
        else if (j == 38 && k == 8 + i / 13)
          label = 3;
        else if (k > 30 && k < 35 && j < 6 && random() % 3 == 0)
          label = 4;
        else if ((Vector3d(i, j, k) - Vector3d(160, 38, 38)).norm() < 4.0)
          label = 5;
      }
  return std::make_shared<const volume::LabelMap>(volume::makeLabelMap(std::move(voxels), {}));
}

std::vector<volume::LabelSource> sourcesOf(const petrous::testing::Labels& labels)
{
  std::vector<volume::LabelSource> sources;
  for (std::uint16_t segment = 1; segment <= 5; ++segment)
    sources.push_back({labels, segment, 1, true});
  return sources;
}

// Number of voxels in the box that differ in any bit.
int different(const volume::Volume<float>& a, const volume::Volume<float>& b,
              const core::IndexBox& box)
{
  int count = 0;
  for (int k = box.lower[2]; k < box.upper[2]; ++k)
    for (int j = box.lower[1]; j < box.upper[1]; ++j)
      for (int i = box.lower[0]; i < box.upper[0]; ++i)
        count += std::memcmp(&a.at(i, j, k), &b.at(i, j, k), sizeof(float)) != 0 ? 1 : 0;
  return count;
}

} // namespace

TEST(RegionalUnion, IsTheWholeUnionToTheBitWhereItIsAskedFor)
{
  const auto sources = sourcesOf(windingLabels());
  const auto field = volume::makeLabelField(sources);
  const core::IndexBox full = field->occupancy->geometry().fullBox();
  std::mt19937 random(3);
  for (int turn = 0; turn < 6; ++turn)
  {
    const auto regional = volume::RegionalUnion::make(sources);
    ASSERT_TRUE(regional);
    ASSERT_TRUE(
        core::sameGrid(regional->occupancy()->geometry(), field->occupancy->geometry(), 0.0));
    core::IndexBox box;
    for (std::size_t a = 0; a < 3; ++a)
    {
      box.lower[a] = static_cast<int>(random() % static_cast<unsigned>(full.upper[a]));
      box.upper[a] = box.lower[a] + 1 + static_cast<int>(random() % 12);
    }
    regional->prepare(box);
    EXPECT_EQ(different(*regional->occupancy(), *field->occupancy, box.intersected(full)), 0)
        << turn;
    EXPECT_LT(regional->preparedTiles(), regional->tiles() / 2);
  }
}

TEST(RegionalUnion, GrowsRegionByRegionToTheWhole)
{
  const auto sources = sourcesOf(windingLabels());
  const auto whole = volume::makeSolidOccupancy(sources);
  const auto regional = volume::RegionalUnion::make(sources);
  const core::IndexBox full = whole->geometry().fullBox();
  for (int i = 0; i < full.upper[0]; i += 50)
  {
    const core::IndexBox part{{i, 0, 0}, {i + 50, full.upper[1], full.upper[2]}};
    regional->prepare(part);
    EXPECT_EQ(different(*regional->occupancy(), *whole, part.intersected(full)), 0) << i;
  }
  EXPECT_EQ(regional->preparedTiles(), regional->tiles());
  EXPECT_EQ(different(*regional->occupancy(), *whole, full), 0);
}

TEST(RegionalUnion, TakesTheWholeIntoTheSameMemory)
{
  const auto sources = sourcesOf(windingLabels());
  const auto whole = volume::makeSolidOccupancy(sources);
  const auto regional = volume::RegionalUnion::make(sources);
  const auto memory = regional->occupancy();
  regional->prepare(core::IndexBox{{0, 0, 0}, {20, 20, 20}});
  regional->prepareAll();
  EXPECT_EQ(regional->occupancy(), memory);
  EXPECT_EQ(different(*memory, *whole, whole->geometry().fullBox()), 0);
}

TEST(RegionalUnion, AsksForTheVoxelsThatInterpolationInABoxNeeds)
{
  const auto sources = sourcesOf(windingLabels());
  const auto field = volume::makeLabelField(sources);
  const auto regional = volume::RegionalUnion::make(sources);
  const Vector3d center = kLong.patientFromVoxel({160, 38, 34.1});
  const core::PatientBox box(center - Vector3d::Constant(0.7), center + Vector3d::Constant(0.7));
  regional->prepare(std::vector<core::PatientBox>{box});
  for (double x = -0.7; x <= 0.7; x += 0.1)
    for (double z = -0.7; z <= 0.7; z += 0.1)
    {
      const Vector3d voxel =
          field->occupancy->geometry().voxelFromPatient(center + Vector3d(x, 0.3, z));
      EXPECT_EQ(volume::sampleTrilinear(*regional->occupancy(), voxel),
                volume::sampleTrilinear(*field->occupancy, voxel));
    }
}

TEST(RegionalUnion, IsNothingWithoutVoxelsAndRefusesWhatALabelFieldRefuses)
{
  const auto labels = windingLabels();
  EXPECT_EQ(volume::RegionalUnion::make({{labels, 77, 1, true}}), nullptr);
  EXPECT_EQ(volume::RegionalUnion::make({}), nullptr);
  EXPECT_THROW(volume::RegionalUnion::make({{labels, 0, 1, true}}), core::InvalidParameter);
  EXPECT_THROW(volume::RegionalUnion::make({{nullptr, 1, 1, true}}), core::InvalidParameter);
}

TEST(RegionalUnion, IsTheOccupancyOfTheLabelFieldOnOneGridAndOnTwo)
{
  const auto labels = windingLabels();
  auto sources = sourcesOf(labels);
  const auto one = volume::makeLabelField(sources);
  const auto oneShare = volume::makeSolidOccupancy(sources);
  ASSERT_TRUE(core::sameGrid(one->occupancy->geometry(), oneShare->geometry(), 0.0));
  EXPECT_EQ(different(*one->occupancy, *oneShare, oneShare->geometry().fullBox()), 0);

  const core::GridGeometry coarse({40, 20, 20}, Vector3d::Constant(0.8), Vector3d(-20, 12, 8));
  sources.push_back({petrous::testing::paintBox(coarse, {{3, 3, 3}, {30, 12, 12}}), 1, 1, true});
  const auto two = volume::makeLabelField(sources);
  const auto twoShare = volume::makeSolidOccupancy(sources);
  ASSERT_TRUE(core::sameGrid(two->occupancy->geometry(), twoShare->geometry(), 0.0));
  EXPECT_EQ(different(*two->occupancy, *twoShare, twoShare->geometry().fullBox()), 0);
  const auto regional = volume::RegionalUnion::make(sources);
  EXPECT_EQ(different(*two->occupancy, *regional->occupancy(), twoShare->geometry().fullBox()), 0);
}
