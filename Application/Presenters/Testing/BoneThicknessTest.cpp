#include "petrous/Presenters/BoneThickness.h"

#include <gtest/gtest.h>

#include "BoneCase.h"
#include "petrous/Presenters/SceneAssembly.h"
#include "petrous/Volume/Sampling.h"

using namespace petrous;
using namespace petrous::presenters;
using Eigen::Vector3d;

namespace
{

const Vector3d kNerve(6.0, 6.0, 3.0);
constexpr double kRadius = 1.8;

// A spherical structure in the block of bone.
scene::Case nerveInBone()
{
  scene::Case value = presenters::testing::block();
  const core::GridGeometry& grid = value.ct.geometry;
  auto voxels = std::make_shared<volume::Volume<std::uint16_t>>(grid, std::uint16_t{0});
  for (int k = 0; k < 40; ++k)
    for (int j = 0; j < 40; ++j)
      for (int i = 0; i < 40; ++i)
        if ((grid.patientFromVoxel({1.0 * i, 1.0 * j, 1.0 * k}) - kNerve).norm() < kRadius)
          voxels->at(i, j, k) = 2;
  scene::LabelPart part;
  part.labels = std::make_shared<const volume::LabelMap>(volume::makeLabelMap(voxels, {}));
  scene::StructurePart nerve;
  nerve.name = "nerve";
  nerve.index = 2;
  part.structures = {nerve};
  value.labels = {part};
  return value;
}

} // namespace

TEST(BoneThickness, IsTheDistanceToTheStructure)
{
  const auto field = boneThickness(nerveInBone(), "nerve");
  for (const double away : {0.2, 1.0, 3.1, 4.8})
    for (const Vector3d& way : {Vector3d(0.0, 0.0, 1.0), Vector3d(0.6, 0.0, 0.8)})
    {
      const Vector3d voxel = field->geometry().voxelFromPatient(kNerve + (kRadius + away) * way);
      ASSERT_TRUE(field->geometry().hullContains(voxel));
      // The surface of a voxelized sphere is within a fifth of a voxel of the sphere.
      EXPECT_NEAR(volume::sampleTrilinear(*field, voxel), away, 0.06 + 0.04);
    }
}

TEST(BoneThickness, NamesTheStructuresWhereItKnowsNone)
{
  try
  {
    boneThickness(nerveInBone(), "sinus");
    FAIL();
  }
  catch (const core::InvalidParameter& error)
  {
    EXPECT_NE(std::string(error.what()).find("it has nerve"), std::string::npos) << error.what();
  }
  EXPECT_THROW(boneThickness(presenters::testing::block(), "nerve"), core::InvalidParameter);
}

TEST(BoneThickness, IsMadeOnceForThePicturesThatShowIt)
{
  const scene::Case value = nerveInBone();
  SceneAssembly assembly;
  EXPECT_FALSE(assembly.contents(value).thickness.distance);
  assembly.showThickness("nerve");
  const auto field = assembly.contents(value).thickness.distance;
  ASSERT_TRUE(field);
  EXPECT_EQ(assembly.contents(value).thickness.distance, field);
  assembly.renamed("sinus", "nerve");
  EXPECT_EQ(assembly.thicknessOver(), "nerve") << "of another structure";
  scene::Case renamed = value;
  scene::findStructure(renamed, "nerve")->name = "facial";
  assembly.renamed("nerve", "facial");
  EXPECT_EQ(assembly.contents(renamed).thickness.distance, field);
  assembly.showThickness("");
  EXPECT_FALSE(assembly.contents(value).thickness.distance);
  assembly.showThickness("sinus");
  EXPECT_THROW(assembly.contents(value), core::InvalidParameter);
}
