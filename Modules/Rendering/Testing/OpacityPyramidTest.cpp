#include "OpacityPyramid.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include <gtest/gtest.h>

#include "petrous/Core/CameraPose.h"

#include "PictureScenes.h"
#include "RandomScenes.h"

using namespace petrous;
using namespace petrous::rendering;
using namespace petrous::rendering::synthetic;
namespace strokes = petrous::rendering::testing;

namespace
{

struct Built
{
  SceneContents contents;
  OccupancyGrid grid;
  OpacityPyramid pyramid;
  std::vector<OpacityPyramid::Mesh> meshes;

  explicit Built(SceneContents scene)
    : contents(std::move(scene))
    , grid(*contents.ct, 4)
    , pyramid(contents.ct->geometry())
  {
    OccupancyGrid::Rules rules;
    rules.iso = contents.iso;
    grid.rebuild(rules, contents.labels.get(), contents.mask.get());
    takeMeshes();
    pyramid.rebuild(scene_(), grid);
  }

  void takeMeshes()
  {
    meshes.clear();
    for (const MeshContents& mesh : contents.meshes)
      meshes.push_back({std::make_shared<const MeshShares>(pyramid.sharesOf(*mesh.mesh)),
                        static_cast<double>(mesh.look.opacity), mesh.drilled});
  }

  OpacityPyramid::Scene scene_() const
  {
    return {*contents.ct,
            contents.labels.get(),
            contents.mask.get(),
            contents.materials,
            contents.iso,
            contents.boneShown,
            &meshes};
  }

  OpacityPyramid::Texel at(std::size_t level, int i, int j, int k) const
  {
    const OpacityPyramid::Level& l = pyramid.levels()[level];
    return l.texels[static_cast<std::size_t>(i + l.dims[0] * (j + l.dims[1] * k))];
  }

  // What the texel that holds a point stops.
  double near(const Vector& patient) const
  {
    const Vector voxel = contents.ct->geometry().voxelFromPatient(patient);
    const auto texel = [&](int a)
    { return static_cast<int>(voxel[a] + 0.5) / pyramid.factor()[static_cast<std::size_t>(a)]; };
    return at(0, texel(0), texel(1), texel(2)).stopped / 255.0;
  }
};

} // namespace

TEST(OpacityPyramid, HoldsTheShareOfEachTexelBelowAPlane)
{
  const Vector normal = Vector(0.3, -0.8, 0.5).normalized();
  const core::GridGeometry grid = cube(64, 0.25, oblique());
  const Built built(
      boneScene(ct<std::int16_t>(grid, [&](const Vector& p) { return 0.4 - p.dot(normal); })));
  ASSERT_EQ(built.pyramid.factor(), (core::Index3{2, 2, 2}));
  for (std::size_t level = 0; level < 3; ++level)
  {
    const int voxels = 2 << level;
    double farthest = 0.0;
    strokes::forEach(
        {{4, 4, 4}, {32 >> level, 32 >> level, 32 >> level}},
        [&](int i, int j, int k)
        {
          constexpr int kFine = 16; // points of the texel along each axis
          int below = 0;
          strokes::forEach({{0, 0, 0}, {kFine, kFine, kFine}},
                           [&](int x, int y, int z)
                           {
                             const Vector voxel =
                                 Vector(i, j, k) * voxels +
                                 (Vector(x, y, z).array() + 0.5).matrix() * voxels / kFine -
                                 Vector::Constant(0.5);
                             below += grid.patientFromVoxel(voxel).dot(normal) < 0.4 ? 1 : 0;
                           });
          const double share = below / std::pow(1.0 * kFine, 3);
          farthest = std::max(farthest, std::abs(built.at(level, i, j, k).tissue / 255.0 - share));
        });
    EXPECT_LE(farthest, level == 0 ? 0.06 : 0.03) << level;
  }
}

TEST(OpacityPyramid, StopsWhatTheMaterialsSurfacesDo)
{
  SceneContents contents = labelledBall(cube(64, 0.35, obliqueMirrored()), 0.4F);
  contents.materials[1].surfaceOpacity = 0.8F;
  const Built translucent(contents);
  EXPECT_NEAR(translucent.near({-6.0, 2.0, 0.0}), 0.4, 0.01); // bone
  EXPECT_NEAR(translucent.near({0.0, -1.0, 0.0}), 0.8, 0.01); // the rod
  EXPECT_NEAR(translucent.near({4.0, -1.5, 2.0}), 0.5, 0.01); // the red ball
  EXPECT_EQ(translucent.near({4.0, -6.0, 3.0}), 0.0);         // the bite
  contents.materials[1].lumen = true;
  EXPECT_NEAR(Built(contents).near({0.0, -1.0, 0.0}), 0.4, 0.01);
  contents.boneShown = false;
  EXPECT_EQ(Built(contents).near({-6.0, 2.0, 0.0}), 0.0);
}

TEST(OpacityPyramid, TakesVoxelsWithoutAValueForAir)
{
  const float nan = std::numeric_limits<float>::quiet_NaN();
  const Built built(boneScene(image(cube(32, 0.5), [nan](const Vector& p)
                                    { return p.x() < 0.0 ? static_cast<double>(nan) : 900.0; })));
  EXPECT_EQ(built.near({-3.0, 0.0, 0.0}), 0.0);
  EXPECT_EQ(built.near({3.0, 0.0, 0.0}), 1.0);
}

// After a rebuild the smallest box, and of what is cut away and comes back never too small.
TEST(OpacityPyramid, KnowsTheBoxOfWhatStopsLight)
{
  const auto boxOf = [](const OpacityPyramid& pyramid)
  {
    core::IndexBox box;
    const OpacityPyramid::Level& first = pyramid.levels().front();
    strokes::forEach({{0, 0, 0}, first.dims},
                     [&](int i, int j, int k)
                     {
                       const auto n =
                           static_cast<std::size_t>(i + first.dims[0] * (j + first.dims[1] * k));
                       if (first.texels[n].tissue > 0)
                         box = box.united({{i, j, k}, {i + 1, j + 1, k + 1}});
                     });
    return box;
  };
  Built built(hollowBall(oblique()));
  const core::IndexBox whole = boxOf(built.pyramid);
  EXPECT_FALSE(whole.empty());
  EXPECT_TRUE(built.pyramid.stopping() == whole);
  const core::GridGeometry& grid = built.contents.ct->geometry();
  const auto cutBy = [&](std::shared_ptr<volume::CutMask> mask)
  {
    built.contents.mask = std::move(mask);
    built.grid.maskChanged(built.contents.mask.get(), grid.fullBox());
  };
  cutBy(cut(grid, [](const Vector& p) { return -p.x(); })); // half of it is gone
  built.pyramid.rebuild(built.scene_(), built.grid);
  const core::IndexBox half = boxOf(built.pyramid);
  EXPECT_LT(half.count(), whole.count());
  EXPECT_TRUE(built.pyramid.stopping() == half);
  cutBy(std::make_shared<volume::CutMask>(grid)); // undone
  built.pyramid.maskChanged(built.scene_(), built.grid, grid.fullBox());
  EXPECT_TRUE(boxOf(built.pyramid) == whole);
  EXPECT_TRUE(built.pyramid.stopping() == whole.united(half));
}

TEST(OpacityPyramid, AnEditEqualsARebuild)
{
  strokes::Random random(5);
  for (const SceneContents& scene :
       {cutBall(0.35F), labelledBall(cube(64, 0.35, obliqueMirrored())),
        hollowBall(oblique(), 0.25)})
  {
    Built built(scene);
    const core::GridGeometry& grid = built.contents.ct->geometry();
    auto mask = built.contents.mask ? std::make_shared<volume::CutMask>(*built.contents.mask)
                                    : std::make_shared<volume::CutMask>(grid);
    built.contents.mask = mask;
    for (int stroke = 0; stroke < 20; ++stroke)
    {
      core::Index3 at;
      for (std::size_t a = 0; a < 3; ++a)
        at[a] = strokes::below(random, grid.dims()[a]);
      const core::IndexBox box =
          strokes::brush(*mask, at, 2.0 + strokes::below(random, 6), stroke % 3 == 2);
      const auto before = built.pyramid.levels();
      built.grid.maskChanged(mask.get(), box);
      const core::IndexBox changed = built.pyramid.maskChanged(built.scene_(), built.grid, box);
      for (std::size_t level = 0; level < before.size(); ++level)
      {
        const core::IndexBox own = OpacityPyramid::boxAt(level, changed);
        const core::Index3& dims = before[level].dims;
        strokes::forEach({{0, 0, 0}, dims},
                         [&](int i, int j, int k)
                         {
                           const auto n = static_cast<std::size_t>(i + dims[0] * (j + dims[1] * k));
                           if (!own.contains({i, j, k}))
                           {
                             ASSERT_TRUE(before[level].texels[n] ==
                                         built.pyramid.levels()[level].texels[n]);
                           }
                         });
      }
    }
    const Built fresh(built.contents);
    for (std::size_t level = 0; level < fresh.pyramid.levels().size(); ++level)
      EXPECT_TRUE(fresh.pyramid.levels()[level].texels == built.pyramid.levels()[level].texels)
          << level;
  }
}

namespace
{

MeshContents meshOf(std::shared_ptr<const core::TriangleMesh> mesh, float opacity = 1.0F,
                    bool drilled = false)
{
  MeshContents contents;
  contents.mesh = std::move(mesh);
  contents.look.opacity = opacity;
  contents.drilled = drilled;
  return contents;
}

SceneContents airScene(const core::GridGeometry& grid)
{
  return boneScene(ct<std::int16_t>(grid, [](const Vector&) { return -5.0; }));
}

// mm^3 of what is solid, and of what that stops.
std::array<double, 2> volumesOf(const Built& built)
{
  const core::Index3& factor = built.pyramid.factor();
  const double texel =
      built.contents.ct->geometry().spacing().prod() * factor[0] * factor[1] * factor[2] / 255.0;
  std::array<double, 2> volumes{};
  for (const OpacityPyramid::Texel& each : built.pyramid.levels().front().texels)
  {
    volumes[0] += texel * each.tissue;
    volumes[1] += texel * each.stopped;
  }
  return volumes;
}

} // namespace

TEST(OpacityPyramid, HoldsTheShareOfEachTexelInAClosedMesh)
{
  // Texels of 2 x 2 x 2 voxels of 0.25 mm, the first from the grid's lower corner.
  SceneContents contents =
      airScene(core::GridGeometry({64, 64, 64}, {0.25, 0.25, 0.25}, {0, 0, 0}));
  contents.meshes = {meshOf(boxMesh({2.0, 3.0, 4.0}, {6.0, 5.0, 7.0}), 0.6F)};
  const Built box(contents);
  const auto share = [](double lower, double upper, int texel)
  {
    const double begin = 0.5 * texel - 0.125; // of the texel, mm
    return std::clamp(std::min(upper, begin + 0.5) - std::max(lower, begin), 0.0, 0.5) / 0.5;
  };
  for (int k = 6; k < 17; ++k)
    for (int j = 4; j < 13; ++j)
      for (int i = 2; i < 15; ++i)
      {
        const double wanted = share(2.0, 6.0, i) * share(3.0, 5.0, j) * share(4.0, 7.0, k);
        ASSERT_NEAR(box.at(0, i, j, k).tissue / 255.0, wanted, 0.01) << i << " " << j << " " << k;
        ASSERT_NEAR(box.at(0, i, j, k).stopped / 255.0, 0.6 * wanted, 0.01);
      }
  constexpr double kPi = 3.14159265358979323846;
  for (const Eigen::Matrix3d& direction : {oblique(), obliqueMirrored()})
  {
    SceneContents ball = airScene(cube(64, 0.3, direction));
    ball.meshes = {meshOf(ballMesh({0.4, -0.3, 0.2}, 4.0, 96), 0.25F)};
    const double volume = 4.0 / 3.0 * kPi * 64.0;
    const auto [solid, stopped] = volumesOf(Built(ball));
    EXPECT_NEAR(solid, volume, 0.01 * volume);
    EXPECT_NEAR(stopped, 0.25 * volume, 0.01 * volume);
  }
}

TEST(OpacityPyramid, AMeshOnTheBoneThatItWasMadeOfChangesNothingAndAnOpenOneIsNone)
{
  const auto depth = [](const Vector& p) { return 6.0 - p.norm(); };
  SceneContents contents = boneScene(ct<std::int16_t>(cube(56, 0.3), depth));
  const double bone = volumesOf(Built(contents))[0];
  contents.meshes = {meshOf(ballMesh(Vector::Zero(), 5.9, 96))};
  EXPECT_NEAR(volumesOf(Built(contents))[0], bone, 0.02 * bone);
  core::TriangleMesh open = *ballMesh({0.0, 0.0, 7.0}, 1.0);
  open.triangles.pop_back();
  contents.meshes = {meshOf(std::make_shared<const core::TriangleMesh>(open))};
  EXPECT_EQ(volumesOf(Built(contents))[0], bone);
}

TEST(OpacityPyramid, OfADrilledMeshItHoldsWhatTheMaskLeft)
{
  constexpr double kPi = 3.14159265358979323846;
  for (const bool drilled : {true, false})
  {
    SceneContents contents = airScene(cube(64, 0.3, oblique()));
    contents.mask = cut(contents.ct->geometry(), [](const Vector& p) { return p.x(); });
    contents.meshes = {meshOf(ballMesh(Vector::Zero(), 4.0, 96), 1.0F, drilled)};
    const double volume = (drilled ? 0.5 : 1.0) * 4.0 / 3.0 * kPi * 64.0;
    EXPECT_NEAR(volumesOf(Built(contents))[0], volume, 0.015 * volume);
  }
}

TEST(OpacityPyramid, WhereMeshesChangedItEqualsARebuild)
{
  SceneContents contents = cutBall(0.35F);
  contents.meshes = {meshOf(ballMesh({1.0, -9.0, 2.0}, 3.0), 0.7F, true)};
  Built built(contents);
  const core::IndexBox before = built.meshes.front().shares->box;
  built.contents.meshes = {meshOf(boxMesh({-8.0, -10.0, -2.0}, {-4.0, -6.0, 3.0}))};
  built.takeMeshes();
  built.pyramid.meshesChanged(built.scene_(), before.united(built.meshes.front().shares->box));
  const Built fresh(built.contents);
  const Built without(cutBall(0.35F));
  for (std::size_t level = 0; level < fresh.pyramid.levels().size(); ++level)
  {
    EXPECT_TRUE(fresh.pyramid.levels()[level].texels == built.pyramid.levels()[level].texels);
    EXPECT_FALSE(without.pyramid.levels()[level].texels == built.pyramid.levels()[level].texels);
  }
}

// Also of overlapping meshes in a cut, and after the next cut and the last of them.
TEST(OpacityPyramid, WhereOnlyOpacitiesOfMeshesChangedTissueIsNotMeasuredAgain)
{
  SceneContents contents = cutBall(0.35F);
  contents.meshes = {meshOf(ballMesh({1.0, -9.0, 2.0}, 3.0, 96), 0.7F, true),
                     meshOf(ballMesh({0.0, -8.0, 0.0}, 4.0, 96), 0.9F)};
  Built built(contents);
  const core::IndexBox box = built.meshes[0].shares->box.united(built.meshes[1].shares->box);
  const auto expectFresh = [&built](const SceneContents& wanted)
  {
    const Built fresh(wanted);
    EXPECT_EQ(fresh.pyramid.levels().size(), built.pyramid.levels().size());
    for (std::size_t level = 0; level < fresh.pyramid.levels().size(); ++level)
      EXPECT_TRUE(fresh.pyramid.levels()[level].texels == built.pyramid.levels()[level].texels);
    EXPECT_EQ(fresh.pyramid.bytes(), built.pyramid.bytes());
  };
  // Tissue that were measured now would be air.
  built.contents.boneShown = false;
  for (const float opacity : {0.2F, 1.0F, 0.5F})
  {
    contents.meshes[1].look.opacity = opacity;
    built.contents.meshes = contents.meshes;
    built.takeMeshes();
    built.pyramid.meshesChanged(built.scene_(), box);
    expectFresh(contents);
  }
  built.contents.boneShown = true;
  contents.mask = cut(contents.ct->geometry(), [](const Vector& p) { return p.x(); });
  built.contents.mask = contents.mask;
  built.grid.maskChanged(contents.mask.get(), contents.ct->geometry().fullBox());
  built.pyramid.maskChanged(built.scene_(), built.grid, contents.ct->geometry().fullBox());
  expectFresh(contents);
  contents.meshes.clear();
  built.contents.meshes.clear();
  built.takeMeshes();
  built.pyramid.meshesChanged(built.scene_(), box);
  expectFresh(contents);
}

TEST(OpacityPyramid, HasTexelsOfAboutHalfAMillimetreOfAnyVoxels)
{
  const OpacityPyramid fine(core::GridGeometry({90, 60, 40}, {0.1, 0.2, 0.9}, {0.0, 0.0, 0.0}));
  EXPECT_EQ(fine.factor(), (core::Index3{5, 3, 1})); // rounded half up: 2.5 to 3
  for (std::size_t level = 1; level < fine.levels().size(); ++level)
    for (std::size_t a = 0; a < 3; ++a)
      EXPECT_EQ(2 * fine.levels()[level].dims[a], fine.levels()[level - 1].dims[a]);
  EXPECT_GE(fine.levels().front().dims[0] * fine.factor()[0], 90);
}

TEST(OpacityPyramid, AMaskInWhichNothingIsCutChangesNothing)
{
  SceneContents contents = boneScene(ct<std::int16_t>(cube(48, 0.4, oblique()), [](const Vector& p)
                                                      { return 3.0 * (6.0 - p.norm()); }));
  const Built without(contents);
  contents.mask = cut(contents.ct->geometry(), [](const Vector&) { return 1.0; });
  const Built with(contents);
  for (std::size_t level = 0; level < with.pyramid.levels().size(); ++level)
  {
    const auto& texels = with.pyramid.levels()[level].texels;
    for (std::size_t n = 0; n < texels.size(); ++n)
    {
      ASSERT_EQ(texels[n].tissue, without.pyramid.levels()[level].texels[n].tissue);
      ASSERT_EQ(texels[n].stopped, without.pyramid.levels()[level].texels[n].stopped);
    }
  }
}
