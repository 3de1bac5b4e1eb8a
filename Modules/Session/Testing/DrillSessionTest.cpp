#include <gtest/gtest.h>

#include "petrous/Session/DrillSession.h"

using namespace petrous;
using Eigen::Vector3d;

namespace
{

constexpr double kPi = 3.14159265358979323846;

scene::Case boneCase()
{
  scene::Case value;
  value.name = "bone";
  value.ct.geometry = core::GridGeometry({50, 40, 40}, Vector3d::Constant(0.3), Vector3d::Zero());
  value.ct.volume = std::make_shared<const volume::IntensityVolume>(
      std::make_shared<const volume::Volume<std::int16_t>>(value.ct.geometry, std::int16_t{1500}));
  value.dissection = dissection::Dissection(value.ct.geometry);
  return value;
}

} // namespace

TEST(DrillSession, ListsWhatAStrokeRemoved)
{
  scene::Case value = boneCase();
  session::DrillSession session(value);
  EXPECT_EQ(session.end(), nullptr) << "no stroke is open";
  value.dissection.beginStroke({});
  value.dissection.cut({{4.0, 6.0, 6.0}, {9.0, 6.0, 6.0}, 2.0}, session.protectedTissue());
  const double truth = 4.0 / 3.0 * kPi * 8.0 + kPi * 4.0 * 5.0; // a capsule
  EXPECT_NEAR(session.measure(value.dissection).total / truth, 1.0, 0.01);
  const auto stroke = session.end();
  ASSERT_TRUE(stroke);
  EXPECT_NEAR(stroke->info.removed / truth, 1.0, 0.01);
  EXPECT_EQ(value.dissection.strokes().size(), 1u);
  EXPECT_LT(session.field().value({6.0, 6.0, 6.0}), 0.0) << "the field follows the cut";
  value.dissection.beginStroke({});
  EXPECT_EQ(session.end(), nullptr) << "it changed nothing";
}

TEST(DrillSession, LeavesAStructureThatIsNotDrillable)
{
  scene::Case value = boneCase();
  auto labels =
      std::make_shared<volume::Volume<std::uint16_t>>(value.ct.geometry, std::uint16_t{0});
  for (int k = 18; k < 22; ++k)
    for (int j = 18; j < 22; ++j)
      for (int i = 0; i < 50; ++i)
        labels->at(i, j, k) = 1;
  scene::LabelPart part;
  part.labels =
      std::make_shared<const volume::LabelMap>(volume::makeLabelMap(std::move(labels), {}));
  scene::StructurePart nerve;
  nerve.name = "nerve";
  nerve.index = 1;
  nerve.look.drillable = false;
  part.structures = {nerve};
  value.labels = {part};
  session::DrillSession session(value);
  value.dissection.beginStroke({});
  value.dissection.cut({{6, 6, 6}, {6, 6, 6}, 2.0}, session.protectedTissue());
  const auto stroke = session.end();
  ASSERT_TRUE(stroke);
  EXPECT_GT(session.field().value({6, 5.85, 5.85}), 0.0) << "the nerve is whole";
  EXPECT_LT(session.field().value({6, 7.2, 6}), 0.0) << "the bone round it is gone";
}

// A threshold changes bone, not segmented structures: sixty structures are not rebuilt.
TEST(DrillSession, AnotherLikeItSharesWhatWasMadeOfTheStructures)
{
  scene::Case value = boneCase();
  auto labels =
      std::make_shared<volume::Volume<std::uint16_t>>(value.ct.geometry, std::uint16_t{0});
  labels->at(20, 20, 20) = 1;
  scene::LabelPart part;
  part.labels =
      std::make_shared<const volume::LabelMap>(volume::makeLabelMap(std::move(labels), {}));
  part.structures.resize(1);
  part.structures[0].name = "lesion";
  part.structures[0].index = 1;
  value.labels = {part};
  scene::Case copy = value;
  const session::DrillSession like(copy);
  value.iso = 1600.0;
  session::DrillSession session(value, like);
  EXPECT_EQ(session.field().solids(), like.field().solids());
  EXPECT_LT(session.field().value({3, 3, 3}), 0.0) << "bone of 1500 HU below the threshold";
  EXPECT_GT(like.field().value({3, 3, 3}), 0.0);
  value.dissection.beginStroke({});
  value.dissection.cut({{6, 6, 6}, {6, 6, 6}, 1.0}, session.protectedTissue());
  EXPECT_TRUE(session.end()) << "of its own case";
  EXPECT_EQ(value.dissection.strokes().size(), 1u);
  EXPECT_GT(like.field().value({6, 6, 6}), 0.0);
}
