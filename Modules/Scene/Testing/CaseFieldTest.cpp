#include <gtest/gtest.h>

#include "petrous/Appearance/StructurePresets.h"
#include "petrous/Scene/CaseField.h"
#include "petrous/Volume/Sampling.h"

using namespace petrous;
using Eigen::Vector3d;

namespace
{

// Air with a single cube-shaped structure.
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
constexpr double kBulge = 0.26 * 0.5; // mm, of the faces of such a small cube (adr/0001)

} // namespace

TEST(CaseField, HoldsSolidTouchableStructuresOnly)
{
  EXPECT_GT(scene::tissueField(cubeInAir(true, true)).value(kInside), 0.0);
  EXPECT_LT(scene::tissueField(cubeInAir(false, true)).value(kInside), 0.0) << "a lumen";
  EXPECT_LT(scene::tissueField(cubeInAir(true, false)).value(kInside), 0.0) << "not touchable";
}

TEST(CaseField, LeavesSoftStructuresOutOfWhatIsRigidAndMeasuresThem)
{
  scene::Case value = cubeInAir(true, true);
  const auto whole = scene::tissueField(value);
  const auto hard = scene::touchTissue(value, whole);
  EXPECT_TRUE(hard.soft.empty());
  EXPECT_EQ(hard.rigid.solids(), whole.solids()) << "nothing is made twice";

  value.labels[0].structures[0].look.stiffness = 0.4;
  const auto soft = scene::touchTissue(value, scene::tissueField(value));
  EXPECT_GT(scene::tissueField(value).value(kInside), 0.0) << "it stays tissue to eye and drill";
  EXPECT_LT(soft.rigid.value(kInside), 0.0);
  ASSERT_EQ(soft.soft.size(), 1U);
  EXPECT_EQ(soft.soft[0].name, "cube");
  EXPECT_EQ(soft.soft[0].stiffness, 0.4);
  // Eight voxels of 0.5 mm: 2 mm to each face. At the exact centre, equidistant from six faces,
  // quadratic splines with nodes 0.25 mm apart reduce that distance by at most (1 - 0.75^3).
  EXPECT_NEAR(soft.soft[0].depth->depth(kInside), 2.0,
              kBulge + 0.25 * (1.0 - 0.75 * 0.75 * 0.75) + 1e-3);
  EXPECT_NEAR(soft.soft[0].depth->depth({3.75, 5.75, 5.75}), 0.0, kBulge);
  EXPECT_NEAR(soft.soft[0].depth->depth({4.75, 5.75, 5.75}), 1.0, kBulge);

  value.labels[0].structures[0].look.touchable = false;
  EXPECT_TRUE(scene::touchTissue(value, scene::tissueField(value)).soft.empty());
  value.labels[0].structures[0].look.touchable = true;
  value.labels[0].structures[0].look.solid = false;
  EXPECT_TRUE(scene::touchTissue(value, scene::tissueField(value)).soft.empty()) << "a lumen";
}

// A soft structure does not affect an adjacent rigid one.
TEST(CaseField, KeepsRigidStructuresBesideSoftOnes)
{
  scene::Case value = cubeInAir(true, true);
  auto labels =
      std::make_shared<volume::Volume<std::uint16_t>>(value.ct.geometry, std::uint16_t{0});
  for (int k = 8; k < 16; ++k)
    for (int j = 8; j < 16; ++j)
      for (int i = 8; i < 16; ++i)
        labels->at(i, j, k) = i < 12 ? 1 : 2;
  value.labels[0].labels =
      std::make_shared<const volume::LabelMap>(volume::makeLabelMap(std::move(labels), {}));
  scene::StructurePart hard = value.labels[0].structures[0];
  hard.name = "hard";
  hard.index = 1;
  scene::StructurePart soft = hard;
  soft.name = "soft";
  soft.index = 2;
  soft.look.stiffness = 1.0;
  value.labels[0].structures = {hard, soft};
  const auto tissue = scene::touchTissue(value, scene::tissueField(value));
  EXPECT_GT(tissue.rigid.value({4.75, 5.75, 5.75}), 0.0);
  EXPECT_LT(tissue.rigid.value({6.75, 5.75, 5.75}), 0.0);
  // Both end half-way between their voxels.
  EXPECT_NEAR(tissue.rigid.value({5.75, 5.75, 5.75}), 0.0, kBulge / 0.5 / 3.0);
  ASSERT_EQ(tissue.soft.size(), 1U);
  EXPECT_NEAR(tissue.soft[0].depth->depth({5.75, 5.75, 5.75}), 0.0, kBulge);
}

TEST(CaseField, FollowsTheCutAsItGoesOn)
{
  scene::Case value = cubeInAir(true, true);
  value.dissection = dissection::Dissection(value.ct.geometry);
  const auto field = scene::tissueField(value);
  EXPECT_GT(field.value(kInside), 0.0);
  value.dissection.beginStroke({});
  value.dissection.cut({kInside, kInside, 1.5});
  EXPECT_LT(field.value(kInside), 0.0);
  value.dissection.endStroke();
  value.dissection.undo();
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

namespace
{

// Structures side by side in one map, with volumes decreasing with the index.
scene::Case caseOf(const std::vector<appearance::StructureAppearance>& looks)
{
  const core::GridGeometry grid({static_cast<int>(looks.size()) + 1, 3, 3}, Vector3d::Constant(0.5),
                                Vector3d::Zero());
  auto labels = std::make_shared<volume::Volume<std::uint16_t>>(grid, std::uint16_t{0});
  scene::Case value;
  value.name = "row";
  scene::LabelPart part;
  for (std::size_t n = 0; n < looks.size(); ++n)
  {
    scene::StructurePart s;
    s.index = static_cast<std::uint16_t>(n + 1);
    s.name = looks[n].preset + " " + std::to_string(s.index);
    s.volume = 1000.0 - static_cast<double>(n);
    s.look = looks[n];
    part.structures.push_back(s);
    labels->at(static_cast<int>(n), 1, 1) = s.index;
  }
  part.labels =
      std::make_shared<const volume::LabelMap>(volume::makeLabelMap(std::move(labels), {}));
  value.labels = {part};
  return value;
}

bool all(const appearance::StructureAppearance&)
{
  return true;
}

} // namespace

TEST(CaseField, OrdersStructuresByPresetThenSmallerFirstAndLumensLast)
{
  const auto presets = appearance::StructurePresets::builtIn();
  std::vector<appearance::StructureAppearance> looks;
  for (const char* name :
       {"air_cells", "skull", "masseter_muscle", "blob", "dura", "cholesteatoma", "schwannoma",
        "cochlea", "incus", "jugular_vein", "carotid_artery", "facial_nerve", "chorda"})
    looks.push_back(presets.lookFor(name));
  appearance::StructureAppearance urgentLumen = looks.front();
  urgentLumen.priority = 0;
  looks.push_back(urgentLumen);

  const scene::Case value = caseOf(looks);
  const auto labels = scene::labelSources(value, all);
  std::vector<std::string> names;
  for (const scene::StructurePart* structure : labels.structures)
    names.push_back(structure->name);
  EXPECT_EQ(names, (std::vector<std::string>{"nerve 13", "nerve 12", "artery 11", "vein 10",
                                             "ossicle 9", "inner-ear 8", "tumour 7",
                                             "cholesteatoma 6", "dura 5", "other 4", "muscle 3",
                                             "bone 2", "air-cells 14", "air-cells 1"}));
  ASSERT_EQ(labels.sources.size(), names.size());
  for (std::size_t n = 0; n < names.size(); ++n)
  {
    EXPECT_EQ(labels.sources[n].material, n + 1);
    EXPECT_EQ(labels.sources[n].segment, labels.structures[n]->index);
    EXPECT_EQ(labels.sources[n].solid, labels.structures[n]->look.solid);
    EXPECT_EQ(labels.sources[n].labels, value.labels[0].labels.get());
  }
}

TEST(CaseField, LeavesOutWhatIsNotWanted)
{
  std::vector<appearance::StructureAppearance> looks(3);
  looks[1].shown = false;
  const scene::Case value = caseOf(looks);
  const auto labels = scene::labelSources(value, [](const auto& look) { return look.shown; });
  ASSERT_EQ(labels.structures.size(), 2u);
  EXPECT_EQ(labels.structures[1], &value.labels[0].structures[0]) << "the smaller first";
}

TEST(CaseField, SaysWhenThereAreMoreStructuresThanMaterials)
{
  EXPECT_EQ(scene::labelSources(caseOf(std::vector<appearance::StructureAppearance>(255)), all)
                .sources.back()
                .material,
            255);
  try
  {
    scene::labelSources(caseOf(std::vector<appearance::StructureAppearance>(256)), all);
    FAIL() << "256 structures";
  }
  catch (const core::InvalidParameter& error)
  {
    EXPECT_NE(std::string(error.what()).find("at most 255"), std::string::npos);
  }
}

TEST(CaseField, IsTheSameForHandAndEye)
{
  scene::Case value = cubeInAir(true, true);
  scene::LabelPart lumen = cubeInAir(false, true).labels[0];
  lumen.structures[0].name = "lumen";
  value.labels.push_back(lumen);
  const auto eye = volume::makeLabelField(scene::labelSources(value, all).sources);
  const auto hand = scene::tissueField(value);
  for (double x = 2.0; x < 10.0; x += 0.13)
    for (double y = 2.0; y < 10.0; y += 0.17)
    {
      const Vector3d p(x, y, 4.1);
      const Vector3d voxel = eye->occupancy->geometry().voxelFromPatient(p);
      const double occupancy = eye->occupancy->geometry().hullContains(voxel)
                                   ? volume::sampleTrilinear(*eye->occupancy, voxel)
                                   : 0.0;
      EXPECT_NEAR(hand.value(p), std::max(occupancy - 0.5, (-1000.0 - 300.0) / scene::kFieldScale),
                  1e-9);
    }
}

TEST(CaseField, ProtectsWhatMayNotBeDrilledAlsoWhereItIsALumen)
{
  scene::Case value = cubeInAir(false, true);
  EXPECT_TRUE(scene::protectedTissue(value).empty());
  value.labels[0].structures[0].look.drillable = false;
  const auto keep = scene::protectedTissue(value);
  ASSERT_EQ(keep.size(), 1u);
  EXPECT_DOUBLE_EQ(
      volume::sampleTrilinear(*keep.occupancies()[0],
                              keep.occupancies()[0]->geometry().voxelFromPatient(kInside)),
      1.0);
}
