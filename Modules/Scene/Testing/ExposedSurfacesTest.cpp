#include "petrous/Scene/ExposedSurfaces.h"

#include <gtest/gtest.h>

using namespace petrous;
using Eigen::Vector3d;

namespace
{

constexpr double kPi = 3.14159265358979323846;

// A 12 mm block of bone with two ball-shaped structures, 2 mm in radius.
const Vector3d kLeft(3.5, 6.0, 6.0);
const Vector3d kRight(8.5, 6.0, 6.0);
constexpr double kRadius = 2.0;

scene::Case twoBalls()
{
  const core::GridGeometry grid({61, 61, 61}, Vector3d::Constant(0.2), Vector3d::Zero());
  auto labels = std::make_shared<volume::Volume<std::uint16_t>>(grid, std::uint16_t{0});
  for (int k = 0; k < 61; ++k)
    for (int j = 0; j < 61; ++j)
      for (int i = 0; i < 61; ++i)
      {
        const Vector3d p = grid.patientFromVoxel({1.0 * i, 1.0 * j, 1.0 * k});
        labels->at(i, j, k) = (p - kLeft).norm() < kRadius    ? 4
                              : (p - kRight).norm() < kRadius ? 9
                                                              : 0;
      }
  scene::Case value;
  value.name = "two";
  value.ct.geometry = grid;
  value.ct.volume = std::make_shared<const volume::IntensityVolume>(
      std::make_shared<const volume::Volume<std::int16_t>>(grid, std::int16_t{1200}));
  scene::LabelPart part;
  part.labels = std::make_shared<const volume::LabelMap>(volume::makeLabelMap(labels, {}));
  for (const auto& [name, index] : {std::pair("left", 4), std::pair("right", 9)})
  {
    scene::StructurePart structure;
    structure.name = name;
    structure.index = static_cast<std::uint16_t>(index);
    part.structures.push_back(structure);
  }
  value.labels = {part};
  value.dissection = dissection::Dissection(grid);
  return value;
}

} // namespace

TEST(ExposedSurfaces, TellTheStructureThatWasReachedAndItsArea)
{
  scene::Case value = twoBalls();
  EXPECT_TRUE(scene::exposedSurfaces(value).empty());
  value.dissection.beginStroke({});
  // A large burr: nearly a plane 1 mm above the centre of the left ball.
  const double reach = 4.0;
  const Vector3d burr = kLeft + Vector3d(0.0, 0.0, 1.0 + reach);
  value.dissection.cut({burr, burr, reach});
  const auto stroke = value.dissection.endStroke();
  ASSERT_TRUE(stroke);
  const auto exposed = scene::exposedSurfaces(value);
  ASSERT_EQ(exposed.size(), 1U);
  EXPECT_EQ(exposed[0].name, "left");
  // Intersection of two spheres: the cap of the ball inside the burr.
  const double d = 1.0 + reach;
  const double height = (d * d + kRadius * kRadius - reach * reach) / (2.0 * d);
  EXPECT_NEAR(exposed[0].area / (2.0 * kPi * kRadius * (kRadius - height)), 1.0, 0.08);
  const volume::CutMask before(value.ct.geometry);
  const auto both = scene::exposedSurfaces(value, {&before, &value.dissection.mask()});
  ASSERT_EQ(both.size(), 2u);
  EXPECT_TRUE(both[0].empty()) << "another state";
  ASSERT_EQ(both[1].size(), exposed.size());
  EXPECT_EQ(both[1].front().area, exposed.front().area);
  value.dissection.undo();
  EXPECT_TRUE(scene::exposedSurfaces(value).empty());
  value.dissection.unload();
  EXPECT_THROW(scene::exposedSurfaces(value), core::InvalidParameter);
}
