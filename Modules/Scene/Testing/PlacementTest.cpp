#include <gtest/gtest.h>

#include "petrous/Scene/ApplyRegistration.h"
#include "petrous/Scene/CaseField.h"
#include "petrous/Scene/Placement.h"
#include "petrous/Scene/RemoveMr.h"
#include "petrous/Scene/StructureOccupancy.h"

using namespace petrous;
using Eigen::Vector3d;

namespace
{

const core::GridGeometry kCtGrid({40, 40, 40}, Vector3d::Constant(0.5), {0.0, 0.0, 0.0});
const core::GridGeometry kMrGrid({20, 24, 16}, {0.8, 0.8, 1.2}, {-30.0, 12.0, 7.0});
const core::RigidTransform kMrFromCt(Eigen::Quaterniond(0.9, 0.3, -0.1, 0.2), {-25.0, 11.0, 8.0});
const Vector3d kInMr = kMrGrid.patientFromVoxel({9.0, 11.0, 8.0}); // inside the structure

// Air, an unregistered MR, and a block drawn on the MR's grid.
scene::Case drawnOnMr(int* loads = nullptr)
{
  scene::Case value;
  value.name = "ear";
  value.ct.geometry = kCtGrid;
  value.ct.volume = std::make_shared<const volume::IntensityVolume>(
      std::make_shared<const volume::Volume<std::int16_t>>(kCtGrid, std::int16_t{-1000}));
  scene::ImagePart mr;
  mr.name = "T2";
  mr.geometry = kMrGrid;
  value.mr.push_back(mr);
  auto voxels = std::make_shared<volume::Volume<std::uint16_t>>(kMrGrid, std::uint16_t{0});
  for (int k = 6; k < 11; ++k)
    for (int j = 8; j < 15; ++j)
      for (int i = 6; i < 13; ++i)
        voxels->at(i, j, k) = 4;
  const auto map = std::make_shared<const volume::LabelMap>(volume::makeLabelMap(voxels, {}));
  scene::LabelPart part;
  part.labels = core::Lazy<volume::LabelMap>(
      [map, loads]
      {
        if (loads)
          ++*loads;
        return map;
      });
  part.drawnOn = "T2";
  scene::StructurePart structure;
  structure.name = "cholesteatoma";
  structure.index = 4;
  part.structures = {structure};
  value.labels.push_back(part);
  return value;
}

core::TriangleMesh tetrahedron()
{
  core::TriangleMesh mesh;
  mesh.vertices = {{0, 0, 0}, {6, 0, 0}, {0, 6, 0}, {0, 0, 6}};
  mesh.triangles = {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}};
  return mesh;
}

} // namespace

TEST(Placement, WhatWasDrawnOnAnMrThatIsNotRegisteredIsNowhere)
{
  int loads = 0;
  const scene::Case value = drawnOnMr(&loads);
  const auto placement = scene::placementOf(value, value.labels[0]);
  EXPECT_EQ(placement.drawnOn, "T2");
  EXPECT_EQ(placement.missing, "it was drawn on the MR 'T2', which is not registered with the CT");
  EXPECT_EQ(scene::missingPlace(value, "cholesteatoma"), placement.missing);
  EXPECT_FALSE(scene::labelsOnCt(value, value.labels[0]));
  const auto all = [](const auto&) { return true; };
  EXPECT_TRUE(scene::labelSources(value, all).sources.empty());
  EXPECT_TRUE(scene::structureOccupancies(value).empty());
  EXPECT_TRUE(scene::drillableStructures(value).empty());
  EXPECT_TRUE(scene::protectedTissue(value).empty());
  EXPECT_TRUE(scene::tissueField(value).solids().empty());
  EXPECT_EQ(loads, 0) << "and costs nothing";
}

TEST(Placement, ItComesToTheCtThroughThatMr)
{
  scene::Case value = drawnOnMr();
  scene::applyRegistration(value, "T2", kMrFromCt, {});
  EXPECT_EQ(scene::missingPlace(value, "cholesteatoma"), "");
  const auto placed = scene::labelsOnCt(value, value.labels[0]);
  ASSERT_TRUE(placed);
  const Vector3d inCt = kMrFromCt.inverse() * kInMr;
  EXPECT_LT((placed->voxels->geometry().voxelFromPatient(inCt) - Vector3d(9.0, 11.0, 8.0)).norm(),
            1e-9);
  EXPECT_EQ(placed->voxels->data(), value.labels[0].labels.get()->voxels->data())
      << "no voxel is copied";
  EXPECT_GT(scene::tissueField(value).value(inCt), 0.0);
  EXPECT_LT(scene::tissueField(value).value(kCtGrid.center() + Vector3d(9.0, 9.0, 9.0)), 0.0);

  EXPECT_EQ(scene::labelsOnCt(value, value.labels[0]), placed) << "kept";
  scene::applyRegistration(value, "T2", {}, {});
  const auto elsewhere = scene::labelsOnCt(value, value.labels[0]);
  EXPECT_NE(elsewhere, placed);
  EXPECT_EQ(elsewhere->voxels->geometry().origin(), kMrGrid.origin());
}

TEST(Placement, AnOlderCaseKnowsTheMrByItsGrid)
{
  scene::Case value = drawnOnMr();
  value.labels[0].drawnOn.reset();
  EXPECT_EQ(scene::placementOf(value, value.labels[0]).drawnOn, "T2");
  scene::ImagePart second = value.mr[0];
  second.name = "DWI";
  value.mr.push_back(second);
  scene::applyRegistration(value, "T2", kMrFromCt, {});
  scene::applyRegistration(value, "DWI", kMrFromCt, {});
  const std::string missing = scene::missingPlace(value, "cholesteatoma");
  EXPECT_NE(missing.find("any of the MR images 'T2', 'DWI'"), std::string::npos) << missing;
  EXPECT_FALSE(scene::labelsOnCt(value, value.labels[0]));

  value.ct.geometry = kMrGrid;
  EXPECT_EQ(scene::placementOf(value, value.labels[0]).drawnOn, "") << "the CT's own grid";
  value.ct.geometry = kCtGrid;
  value.mr.clear();
  EXPECT_EQ(scene::placementOf(value, value.labels[0]).drawnOn, "");
}

TEST(Placement, MeshesComeAlong)
{
  scene::Case value = drawnOnMr();
  scene::MeshPart mesh;
  mesh.name = "tumour";
  mesh.mesh = std::make_shared<const core::TriangleMesh>(tetrahedron());
  mesh.drawnOn = "T2";
  mesh.look.touchable = true;
  value.meshes.push_back(mesh);
  EXPECT_FALSE(scene::meshOnCt(value, value.meshes[0]));
  EXPECT_EQ(scene::untouchable(value, value.meshes[0]),
            "it was drawn on the MR 'T2', which is not registered with the CT");
  EXPECT_TRUE(scene::tissueField(value).solids().empty());

  // Puts the tetrahedron at the centre of the CT.
  const auto there = [](double shift)
  {
    return core::RigidTransform(Eigen::Quaterniond(0.9, 0.3, -0.1, 0.2), Vector3d::Constant(shift));
  };
  const auto through = [&](double shift)
  {
    const core::RigidTransform turn = there(0.0);
    return core::RigidTransform(turn.rotation(), turn.rotation() * -Vector3d::Constant(shift));
  };
  scene::applyRegistration(value, "T2", through(8.0), {});
  const Vector3d inside = through(8.0).inverse() * Vector3d(1.2, 1.2, 1.2);
  EXPECT_LT((scene::meshOnCt(value, value.meshes[0])->vertices[0].cast<double>() -
             Vector3d::Constant(8.0))
                .norm(),
            1e-5);
  value.labels.clear();
  EXPECT_GT(scene::tissueField(value).value(inside), 0.0);
  ASSERT_EQ(scene::structureOccupancies(value).size(), 1U);

  scene::applyRegistration(value, "T2", through(11.0), {});
  EXPECT_TRUE(scene::structureOccupancies(value).empty()) << "its voxels lay where it was before";
  EXPECT_LT(scene::tissueField(value).value(inside), 0.0);
}

TEST(Placement, AnMrOnWhichSomethingWasDrawnStays)
{
  scene::Case value = drawnOnMr();
  try
  {
    scene::removePart(value, "T2");
    FAIL() << "removed";
  }
  catch (const core::Error& error)
  {
    EXPECT_EQ(error.fault(), core::Fault::Refused);
    EXPECT_NE(std::string(error.what()).find("'cholesteatoma'"), std::string::npos);
  }
  EXPECT_EQ(value.mr.size(), 1U);
  scene::removePart(value, "cholesteatoma");
  scene::removePart(value, "T2");
  EXPECT_TRUE(value.mr.empty());
}

// In an older case, what was drawn on an MR may have its name, and else would lie in the CT where
// it lay in the MR.
TEST(Placement, AnMrOnWhichANamesakeWasDrawnStays)
{
  const auto expectRefused = [](scene::Case& value)
  {
    try
    {
      scene::removeMr(value, "T2");
      FAIL() << "removed";
    }
    catch (const core::Error& error)
    {
      EXPECT_EQ(error.fault(), core::Fault::Refused);
    }
    EXPECT_EQ(value.mr.size(), 1U);
  };
  scene::Case stated = drawnOnMr();
  stated.labels[0].structures[0].name = "T2";
  expectRefused(stated);
  scene::Case byGrid = stated;
  byGrid.labels[0].drawnOn.reset();
  expectRefused(byGrid);
  scene::Case withMesh = stated;
  withMesh.labels.clear();
  withMesh.meshes.emplace_back();
  withMesh.meshes[0].name = "T2";
  withMesh.meshes[0].mesh = std::make_shared<const core::TriangleMesh>(tetrahedron());
  withMesh.meshes[0].drawnOn = "T2";
  expectRefused(withMesh);

  // One of the CT hangs on nothing, and stays.
  withMesh.meshes[0].drawnOn.clear();
  scene::removeMr(withMesh, "T2");
  EXPECT_TRUE(withMesh.mr.empty());
  EXPECT_EQ(withMesh.meshes.size(), 1U);
  stated.labels[0].drawnOn = "";
  scene::removeMr(stated, "T2");
  EXPECT_TRUE(stated.mr.empty());
  EXPECT_EQ(stated.labels.size(), 1U);
}
