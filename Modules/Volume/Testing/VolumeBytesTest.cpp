#include <cmath>
#include <cstring>

#include <gtest/gtest.h>

#include "LabelPainting.h"
#include "petrous/Core/Fingerprint.h"
#include "petrous/Volume/SmoothedUnion.h"
#include "petrous/Volume/VolumeBytes.h"

using namespace petrous;
using Eigen::Vector3d;

namespace
{

// A ball, a box in it with higher priority, and a lumen; rotated against the patient.
petrous::testing::Labels twoSolidsAndALumen()
{
  const auto grid =
      petrous::testing::cube(52, 0.37, Vector3d(3, -70, 211.5), petrous::testing::turned());
  return petrous::testing::paint(grid,
                                 [&grid](const Vector3d& p) -> std::uint16_t
                                 {
                                   const Vector3d v = p - grid.center();
                                   if ((v - Vector3d(2, 0, 0)).cwiseAbs().maxCoeff() < 1.5)
                                     return 2;
                                   if (v.norm() < 5.2)
                                     return 1;
                                   return (v - Vector3d(-5, 4, 0)).norm() < 2.0 ? 300 : 0;
                                 });
}

std::shared_ptr<const volume::LabelField> fieldOf(const petrous::testing::Labels& labels)
{
  return volume::makeLabelField(
      {{labels, 2, 1, true}, {labels, 1, 2, true}, {labels, 300, 3, false}});
}

template <class T>
void expectEqual(const volume::Volume<T>& a, const volume::Volume<T>& b)
{
  ASSERT_TRUE(core::sameGrid(a.geometry(), b.geometry(), 0.0));
  EXPECT_EQ(a.geometry().direction(), b.geometry().direction());
  EXPECT_EQ(std::memcmp(a.data(), b.data(), a.bytes()), 0);
}

} // namespace

TEST(VolumeBytes, BringBackALabelFieldToTheBit)
{
  const auto field = fieldOf(twoSolidsAndALumen());
  const auto bytes = volume::bytesOf(*field);
  ASSERT_TRUE(bytes);
  EXPECT_LT(bytes->size(), field->occupancy->bytes());
  const auto back = volume::labelFieldFrom(*bytes);
  ASSERT_TRUE(back);
  expectEqual(*back->occupancy, *field->occupancy);
  expectEqual(*back->index, *field->index);
  ASSERT_TRUE(field->borders && back->borders);
  expectEqual(*back->borders, *field->borders);
  EXPECT_TRUE(back->hasSolid);
  EXPECT_TRUE(back->hasLumen);

  const auto occupancy = volume::occupancyFrom(*volume::bytesOf(*field->occupancy));
  ASSERT_TRUE(occupancy);
  expectEqual(*occupancy, *field->occupancy);
}

TEST(VolumeBytes, BringBackALabelMapWithItsNames)
{
  auto labels = *twoSolidsAndALumen();
  labels.segments[0].name = "Gehörgang";
  labels.segments[1].color = {0.25F, 0.5F, 1.0F};
  const auto back = volume::labelMapFrom(volume::bytesOf(labels));
  ASSERT_TRUE(back);
  expectEqual(*back->voxels, *labels.voxels);
  ASSERT_TRUE(labels.extent);
  EXPECT_EQ(back->extent, labels.extent);
  ASSERT_EQ(back->segments.size(), labels.segments.size());
  for (std::size_t n = 0; n < labels.segments.size(); ++n)
  {
    EXPECT_EQ(back->segments[n].name, labels.segments[n].name);
    EXPECT_EQ(back->segments[n].index, labels.segments[n].index);
    EXPECT_EQ(back->segments[n].color, labels.segments[n].color);
    EXPECT_EQ(back->segments[n].voxels, labels.segments[n].voxels);
  }
}

TEST(VolumeBytes, AreNoneForAShareThatWouldNotComeBack)
{
  volume::Volume<float> occupancy(petrous::testing::cube(4, 1.0), 0.0F);
  occupancy.at(1, 2, 3) = 0.1234567F;
  EXPECT_FALSE(volume::bytesOf(occupancy));
  occupancy.at(1, 2, 3) = std::nanf("");
  EXPECT_FALSE(volume::bytesOf(occupancy));
  for (int code = 0; code <= 65535; ++code)
  {
    occupancy.at(1, 2, 3) = static_cast<float>(std::round(code / 65535.0 * 65535.0) / 65535.0);
    const auto bytes = volume::bytesOf(occupancy);
    ASSERT_TRUE(bytes) << code;
    if (code % 97 == 0)
    {
      ASSERT_EQ(volume::occupancyFrom(*bytes)->at(1, 2, 3), occupancy.at(1, 2, 3)) << code;
    }
  }
}

TEST(VolumeBytes, ThatAreMalformedGiveNothing)
{
  const auto field = fieldOf(twoSolidsAndALumen());
  const auto good = *volume::bytesOf(*field);
  for (std::size_t length = 0; length < good.size(); length += 1 + good.size() / 50)
    EXPECT_FALSE(volume::labelFieldFrom({good.begin(), good.begin() + length})) << length;
  auto longer = good;
  longer.push_back(0);
  EXPECT_FALSE(volume::labelFieldFrom(longer));
  EXPECT_FALSE(volume::occupancyFrom({}));
  EXPECT_FALSE(volume::labelMapFrom({1, 2, 3}));
}

// If these numbers change, kLabelFieldVersion must be incremented, or caches return the old ones.
TEST(VolumeBytes, HaveTheNumbersOfTheirVersion)
{
  const auto field = fieldOf(twoSolidsAndALumen());
  core::Fingerprint print;
  print.add(field->occupancy->data(), field->occupancy->bytes());
  print.add(field->index->data(), field->index->bytes());
  print.add(field->borders->data(), field->borders->bytes());
  // Structures of two grids, and one alone.
  const auto labels = twoSolidsAndALumen();
  const core::GridGeometry coarse = petrous::testing::cube(24, 0.8, Vector3d(4, -69, 212));
  const auto both = volume::makeSolidOccupancy(
      {{labels, 2, 1, true},
       {petrous::testing::paintBox(coarse, {{3, 3, 3}, {18, 9, 9}}), 1, 1, true}});
  print.add(both->data(), both->bytes());
  const auto one = volume::makeSmoothedUnion(*labels, [](std::uint16_t i) { return i == 1; });
  print.add(one->data(), one->bytes());
  EXPECT_EQ(volume::kLabelFieldVersion, 1);
  EXPECT_EQ(print.value(), 12072252026838527269U);
}
