#include <gtest/gtest.h>

#include "petrous/Scene/CaseField.h"

using namespace petrous;
using Eigen::Vector3d;

namespace
{

// Air with one cube of a structure.
scene::Case cubeInAir(bool solid, bool touchable)
{
  const core::GridGeometry grid({24, 24, 24}, Vector3d::Constant(0.5), Vector3d::Zero());
  scene::Case value;
  value.name = "cube";
  value.ct.geometry = grid;
  value.ct.volume = std::make_shared<const volume::IntensityVolume>(
      std::make_shared<const volume::Volume<std::int16_t>>(grid, std::int16_t{-1000}));
  auto labels = std::make_shared<volume::Volume<std::uint16_t>>(grid, std::uint16_t{0});
  for (int k = 8; k < 16; ++k)
    for (int j = 8; j < 16; ++j)
      for (int i = 8; i < 16; ++i)
        labels->at(i, j, k) = 5;
  scene::LabelPart part;
  part.labels =
      std::make_shared<const volume::LabelMap>(volume::makeLabelMap(std::move(labels), {}));
  scene::StructurePart s;
  s.name = "cube";
  s.index = 5;
  s.look.solid = solid;
  s.look.touchable = touchable;
  part.structures = {s};
  value.labels = {part};
  return value;
}

const Vector3d kInside(5.75, 5.75, 5.75);

} // namespace

TEST(CaseField, HoldsSolidTouchableStructuresOnly)
{
  EXPECT_GT(scene::tissueField(cubeInAir(true, true)).value(kInside), 0.0);
  EXPECT_LT(scene::tissueField(cubeInAir(false, true)).value(kInside), 0.0) << "a lumen";
  EXPECT_LT(scene::tissueField(cubeInAir(true, false)).value(kInside), 0.0) << "not touchable";
}

TEST(CaseField, FollowsTheCutAsItGoesOn)
{
  scene::Case value = cubeInAir(true, true);
  value.dissection = std::make_shared<dissection::Dissection>(value.ct.geometry);
  const auto field = scene::tissueField(value);
  EXPECT_GT(field.value(kInside), 0.0);
  value.dissection->beginStroke({});
  value.dissection->cut({kInside, kInside, 1.5});
  EXPECT_LT(field.value(kInside), 0.0);
  scene::endStroke(value);
  scene::undo(value, 1);
  EXPECT_GT(field.value(kInside), 0.0);
}

TEST(CaseField, LoadsNoLabelsWhereNoneIsTouchable)
{
  scene::Case value = cubeInAir(true, false);
  bool loaded = false;
  value.labels[0].labels = core::Lazy<volume::LabelMap>(
      [&loaded]()
      {
        loaded = true;
        return std::make_shared<const volume::LabelMap>();
      });
  scene::tissueField(value);
  EXPECT_FALSE(loaded);
}
