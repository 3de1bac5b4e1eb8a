#include <chrono>
#include <future>
#include <mutex>

#include <gtest/gtest.h>

#include "petrous/Scene/CaseField.h"
#include "petrous/Volume/Sampling.h"

using namespace petrous;
using Eigen::Vector3d;

namespace
{

core::TriangleMesh box(const Vector3d& lower, const Vector3d& upper)
{
  core::TriangleMesh mesh;
  for (int n = 0; n < 8; ++n)
    mesh.vertices.push_back(Vector3d(((n & 1) ? upper : lower)[0], ((n & 2) ? upper : lower)[1],
                                     ((n & 4) ? upper : lower)[2])
                                .cast<float>());
  mesh.triangles = {{0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}, {0, 1, 5}, {0, 5, 4},
                    {2, 6, 7}, {2, 7, 3}, {0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}};
  return mesh;
}

// Air with one bar-shaped mesh, thinner than a voxel: x 2 to 10, y and z 0.3 mm around 5.75,
// between the voxel centres at 5.5 and 6.
scene::Case barInAir()
{
  const core::GridGeometry grid({24, 24, 24}, Vector3d::Constant(0.5), Vector3d::Zero());
  scene::Case value;
  value.name = "bar";
  value.ct.geometry = grid;
  value.ct.volume = std::make_shared<const volume::IntensityVolume>(
      std::make_shared<const volume::Volume<std::int16_t>>(grid, std::int16_t{-1000}));
  scene::MeshPart part;
  part.name = "incus";
  part.mesh = std::make_shared<const core::TriangleMesh>(box({2.0, 5.6, 5.6}, {10.0, 5.9, 5.9}));
  part.triangles = 12;
  value.meshes.push_back(std::move(part));
  return value;
}

const Vector3d kInside(5.75, 5.75, 5.75);

// A label with the mesh's name at another position.
void addLabel(scene::Case& value)
{
  auto labels =
      std::make_shared<volume::Volume<std::uint16_t>>(value.ct.geometry, std::uint16_t{0});
  for (int i = 2; i < 5; ++i)
    labels->at(i, 3, 3) = labels->at(i, 4, 3) = labels->at(i, 3, 4) = labels->at(i, 4, 4) = 1;
  scene::LabelPart part;
  part.labels =
      std::make_shared<const volume::LabelMap>(volume::makeLabelMap(std::move(labels), {}));
  scene::StructurePart structure;
  structure.name = "incus";
  structure.index = 1;
  part.structures = {structure};
  value.labels = {part};
}

} // namespace

TEST(MeshField, IsTissueWhereTheCtIsAir)
{
  const scene::Case value = barInAir();
  EXPECT_EQ(scene::untouchable(value, value.meshes[0]), "");
  const auto field = scene::tissueField(value);
  for (double x = 2.2; x < 9.8; x += 0.05)
  {
    EXPECT_GT(field.value({x, 5.75, 5.75}), 0.0) << x;
    EXPECT_LT(field.value({x, 5.75, 6.1}), 0.0) << x;
  }
  const auto hit = field.firstHit({5.8, 5.71, 9.0}, {5.8, 5.71, 5.75});
  ASSERT_TRUE(hit);
  EXPECT_NEAR(*hit, 9.0 - 5.9, 0.05 * 0.5);
  const Vector3d normal = field.normal({5.8, 5.71, 5.9});
  EXPECT_GT(normal[2], 0.98);
}

TEST(MeshField, LeavesOutWhatIsNotTouchableAndSaysWhy)
{
  scene::Case off = barInAir();
  off.meshes[0].look.touchable = false;
  EXPECT_LT(scene::tissueField(off).value(kInside), 0.0);
  EXPECT_EQ(scene::untouchable(off, off.meshes[0]), "its flag 'touchable' is off");
  EXPECT_FALSE(off.meshes[0].touch.resident());

  scene::Case lumen = barInAir();
  lumen.meshes[0].look.solid = false;
  EXPECT_LT(scene::tissueField(lumen).value(kInside), 0.0);
  EXPECT_EQ(scene::untouchable(lumen, lumen.meshes[0]), "it is a space without tissue");

  scene::Case open = barInAir();
  auto mesh = box({2.0, 5.6, 5.6}, {10.0, 5.9, 5.9});
  mesh.triangles.pop_back();
  open.meshes[0].mesh = std::make_shared<const core::TriangleMesh>(std::move(mesh));
  EXPECT_LT(scene::tissueField(open).value(kInside), 0.0);
  EXPECT_NE(scene::untouchable(open, open.meshes[0]).find("not closed"), std::string::npos);
}

TEST(MeshField, CountsAStructureThatIsLabelAndMeshOnce)
{
  scene::Case value = barInAir();
  addLabel(value);
  const auto field = scene::tissueField(value);
  EXPECT_LT(field.value(kInside), 0.0) << "the mesh";
  EXPECT_GT(field.value({1.5, 1.75, 1.75}), 0.0) << "the label, which is what the eye sees";
  EXPECT_EQ(field.solids().size(), 1u);
  EXPECT_EQ(scene::untouchable(value, value.meshes[0]), "");
  EXPECT_EQ(scene::drillableStructures(value).size(), 1u);
  value.labels[0].structures[0].look.drillable = false;
  EXPECT_EQ(scene::protectedTissue(value).size(), 1u);
  value.labels[0].structures[0].look.touchable = false;
  EXPECT_EQ(scene::untouchable(value, value.meshes[0]), "its flag 'touchable' is off");
}

TEST(MeshField, MakesVoxelsOnceAndOnlyWhereTheyAreAskedFor)
{
  const scene::Case value = barInAir();
  const scene::Case copy = value;
  scene::untouchable(value, value.meshes[0]);
  EXPECT_FALSE(value.meshes[0].touch.resident());
  const auto field = scene::tissueField(value);
  ASSERT_EQ(field.solids().size(), 1u);
  EXPECT_EQ(value.meshes[0].touch.resident(), field.solids()[0]);
  EXPECT_EQ(scene::tissueField(copy).solids()[0], field.solids()[0]);

  scene::Case other = value; // another CT, at twice the resolution
  other.ct.geometry = core::GridGeometry({48, 48, 48}, Vector3d::Constant(0.25), Vector3d::Zero());
  other.ct.volume = std::make_shared<const volume::IntensityVolume>(
      std::make_shared<const volume::Volume<std::int16_t>>(other.ct.geometry, std::int16_t{-1000}));
  EXPECT_NE(scene::tissueField(other).solids()[0], field.solids()[0]);
}

TEST(MeshField, LetsTheDrillTakeItAndNamesWhatWasTaken)
{
  scene::Case value = barInAir();
  value.meshes[0].mesh = std::make_shared<const core::TriangleMesh>(
      box({2.0, 5.25, 5.25}, {10.0, 6.25, 6.25})); // eight quadrature points thick
  value.dissection = dissection::Dissection(value.ct.geometry);
  const auto field = scene::tissueField(value);
  const auto structures = scene::drillableStructures(value);
  EXPECT_TRUE(scene::protectedTissue(value).empty());
  auto& work = value.dissection;
  work.beginStroke({});
  work.cut({kInside, kInside, 1.5}, {});
  EXPECT_LT(field.value(kInside), 0.0);
  const auto removed = dissection::measureRemoved(field, work.maskBeforeStroke(), work.mask(),
                                                  work.openBricks(), structures);
  // A bar of 1 x 1 mm within a ball of radius 1.5: the integral of
  // 2 sqrt(1.5^2 - y^2 - z^2) over its cross-section.
  EXPECT_NEAR(removed.total, 2.8858, 0.1);
  ASSERT_EQ(removed.structures.size(), 1u);
  EXPECT_EQ(removed.structures[0].name, "incus");
  EXPECT_NEAR(removed.structures[0].volume, removed.total, 0.15);
}

TEST(MeshField, IsLeftByTheDrillWhereItMayNotBeDrilled)
{
  scene::Case value = barInAir();
  value.meshes[0].look.drillable = false;
  value.dissection = dissection::Dissection(value.ct.geometry);
  const auto field = scene::tissueField(value);
  const auto keep = scene::protectedTissue(value);
  ASSERT_EQ(keep.size(), 1u);
  EXPECT_TRUE(scene::drillableStructures(value).empty());
  value.dissection.beginStroke({});
  value.dissection.cut({kInside - Vector3d(2, 0, 0), kInside + Vector3d(2, 0, 0), 1.5}, keep);
  for (double x = 2.2; x < 9.8; x += 0.05)
    EXPECT_GT(field.value({x, 5.75, 5.75}), 0.0) << x;
}

TEST(MeshField, TellsWhatIsKnownOfAMeshWhileItsVoxelsAreMade)
{
  const scene::Case value = barInAir();
  const scene::MeshPart& part = value.meshes[0];
  const auto mesh = part.mesh.get();
  std::future<std::string> asked; // outlives the computation, for which it would wait
  std::future_status status = std::future_status::timeout;
  std::once_flag once;
  const core::Progress progress(
      [&](double, const std::string&)
      {
        std::call_once(once,
                       [&]
                       {
                         asked = std::async(std::launch::async,
                                            [&]
                                            {
                                              const bool made = part.touch.resident() != nullptr;
                                              return (made ? "made; " : "") +
                                                     part.touch.refusal(mesh, value.ct.geometry);
                                            });
                         status = asked.wait_for(std::chrono::seconds(20));
                       });
      });
  const auto solid = part.touch.solid(mesh, value.ct.geometry, progress);
  ASSERT_TRUE(solid);
  EXPECT_EQ(status, std::future_status::ready) << "who asked waited for the maker";
  EXPECT_EQ(asked.get(), "");
  EXPECT_EQ(part.touch.resident(), solid);
}
