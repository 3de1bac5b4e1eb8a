#include "PictureComparison.h"
#include "PictureScenes.h"
#include "petrous/Rendering/ScenePicture.h"

using namespace petrous;
using namespace petrous::rendering;
using namespace petrous::rendering::synthetic;

namespace
{

// Adds one blue structure as a label map.
template <class Inside>
void addMarker(SceneContents& contents, const core::GridGeometry& grid, const Inside& inside,
               float surfaceOpacity = 1.0F)
{
  contents.labels = volume::makeLabelField({{labels(grid, inside), 1, 1, true}});
  contents.materials.resize(1);
  contents.materials.push_back(blue(surfaceOpacity));
}

} // namespace

TEST(StructurePicture, ShowsACutStructureInItsColorWhereTheWallCrossesIt)
{
  SceneContents contents = hollowBall();
  const core::GridGeometry grid = contents.ct->geometry();
  addMarker(contents, grid,
            [](const Vector& p) { return p.head<2>().norm() < 3.0 && p.norm() < 8.0; });
  EXPECT_EQ(countBlue(draw(contents, slanting())), 0); // inside solid bone

  contents.mask = cut(grid, [](const Vector& p) { return 1.0 - p.z(); });
  core::CameraPose pose = slanting();
  pose.position = {8.3, -15.2, 44.9};
  const ReferencePicture truth = truthOf(contents, pose);
  const Shot shot = shoot(contents, pose);
  EXPECT_GT(countBlue(truth.picture), 300);
  EXPECT_NEAR(countBlue(shot.picture), countBlue(truth.picture), 2);
  expectAgreement(compare(shot, truth, grid.minSpacing()));
}

TEST(StructurePicture, ShowsAStructureThroughTranslucentBone)
{
  SceneContents contents = hollowBall();
  addMarker(contents, contents.ct->geometry(), [](const Vector& p) { return p.norm() < 3.0; });
  const Picture opaque = draw(contents, slanting());
  contents.materials[0] = boneMaterial(0.2F);
  const Picture translucent = draw(contents, slanting());
  const auto blueness = [](const Picture& picture)
  {
    const std::uint8_t* middle = picture.pixel(kWidth / 2, kHeight / 2);
    return middle[2] - middle[0];
  };
  EXPECT_LT(blueness(opaque), 0);
  EXPECT_GT(blueness(translucent), blueness(opaque) + 20);
}

TEST(StructurePicture, KeepsARemnantThinnerThanAVoxel)
{
  const core::GridGeometry grid = cube(40, 0.6);
  SceneContents contents = boneScene(ct<std::int16_t>(grid, [](const Vector&) { return -5.0; }));
  addMarker(contents, grid, [](const Vector& p) { return std::abs(p.z()) < 4.0; });
  // The structure's lower face is half-way between samples, at about z = -4.2 mm.
  contents.mask = cut(grid, [](const Vector& p) { return -3.9 - p.z(); });
  core::CameraPose pose = slanting();
  pose.position = {0.0, -10.0, 60.0};
  const Picture picture = draw(contents, pose);
  for (int column = 70; column < 130; column += 3)
    EXPECT_TRUE(isBlue(picture.pixel(column, kHeight / 2))) << column;
}

TEST(StructurePicture, KeepsAThreadThinnerThanAVoxel)
{
  // A nerve one row of 1 mm voxels wide.
  const core::GridGeometry grid = cube(24, 1.0);
  SceneContents contents = boneScene(ct<std::int16_t>(grid, [](const Vector&) { return -5.0; }));
  addMarker(contents, grid,
            [](const Vector& p)
            { return p.x() > 0.0 && p.x() < 1.0 && p.y() > 0.0 && p.y() < 1.0; });
  const auto rowsSeen = [](const Picture& picture)
  {
    int rows = 0;
    for (int row = 0; row < kHeight; ++row)
      for (int column = 0; column < kWidth; ++column)
        if (isBlue(picture.pixel(column, row)))
        {
          ++rows;
          break;
        }
    return rows;
  };
  // Where it is a fifth of a step thick, a ray may miss it between two samples.
  const int truth = rowsSeen(truthOf(contents, slanting()).picture);
  EXPECT_GT(truth, 80);
  EXPECT_GE(rowsSeen(draw(contents, slanting())), truth * 3 / 4);
}

TEST(StructurePicture, HoldsLabelsOnlyWhileThereAreAny)
{
  SceneContents contents = hollowBall();
  SceneContents labelled = contents;
  addMarker(labelled, contents.ct->geometry(), [](const Vector& p) { return p.norm() < 11.0; });
  ScenePicture scene;
  scene.setContents(contents);
  scene.setCamera(slanting());
  OffscreenView view(kWidth, kHeight);
  const Picture bare = view.render(scene);
  EXPECT_EQ(countBlue(bare), 0);
  EXPECT_EQ(scene.resources().count("labels.texture"), 0U);
  scene.setContents(labelled);
  EXPECT_GT(countBlue(view.render(scene)), 1000);
  EXPECT_EQ(scene.resources().count("labels.texture"), 1U);
  scene.setContents(contents);
  EXPECT_EQ(countDifferentPixels(view.render(scene), bare), 0U);
  EXPECT_EQ(scene.resources().count("labels.texture"), 0U);
}

TEST(StructurePicture, BlendsATranslucentStructureWithWhatLiesBehindIt)
{
  const core::GridGeometry grid = cube(48, 0.5);
  SceneContents contents = boneScene(ct<std::int16_t>(grid, [](const Vector&) { return -5.0; }));
  const auto inside = [](const Vector& p) { return p.norm() < 9.0; };
  addMarker(contents, grid, inside);
  contents.materials[1].transfer =
      appearance::TransferFunction::constant({0.1F, 0.15F, 0.9F}, 0.0F, 0.0F);
  const std::uint8_t opaque = draw(contents, slanting()).pixel(kWidth / 2, kHeight / 2)[2];
  contents.materials[1].surfaceOpacity = 0.5F;
  const std::uint8_t half = draw(contents, slanting()).pixel(kWidth / 2, kHeight / 2)[2];
  EXPECT_NEAR(half, 0.5 * opaque + 0.5 * 255.0 * optics::kBackground[2], 1.0);
}

// A vessel through a tumour: it takes the tumour's voxels, and the two touch.
TEST(StructurePicture, LightsAStructureInsideATranslucentOne)
{
  const core::GridGeometry grid = cube(48, 0.5);
  SceneContents contents = boneScene(ct<std::int16_t>(grid, [](const Vector&) { return -5.0; }));
  contents.labels = labelField(
      grid, [](const Vector& p) { return 9.0 - p.norm(); },
      [](const Vector& p) { return p.norm() < 4.0 ? 2 : 1; });
  contents.materials.push_back(red(0.2F));
  contents.materials[1].transfer =
      appearance::TransferFunction::constant({0.8F, 0.1F, 0.1F}, 0.02F);
  contents.materials.push_back(blue());
  const core::CameraPose pose = slanting();
  const Shot shot = shoot(contents, pose);
  const ReferencePicture truth = truthOf(contents, pose);
  expectAgreement(compare(shot, truth, grid.minSpacing()));
  // Shaded as a ball: darker at the rim than in the centre, and opaque from its surface on.
  const auto blueAt = [&](const Picture& picture, int aside)
  { return picture.pixel(kWidth / 2 + aside, kHeight / 2)[2]; };
  for (const Picture& picture : {shot.picture, truth.picture})
  {
    EXPECT_GT(blueAt(picture, 0), 120);
    EXPECT_LT(blueAt(picture, 15), blueAt(picture, 0) - 20);
  }
}

// Anisotropic label maps at an angle to the CT. The first hits are the ball's everywhere; the
// colour shows what a ray meets behind them.
TEST(StructurePicture, AgreesWhereTranslucentStructuresMeet)
{
  SceneContents contents =
      boneScene(ct<std::int16_t>(cube(48, 0.5), [](const Vector&) { return -5.0; }));
  const core::GridGeometry grid({60, 52, 34}, {0.36, 0.42, 0.64}, Vector(-9.5, -9.0, -11.0),
                                oblique());
  const Vector middle = grid.patientFromVoxel({29.5, 25.5, 16.5});
  auto voxels = std::make_shared<volume::Volume<std::uint16_t>>(grid, std::uint16_t{0});
  for (int k = 0; k < 34; ++k)
    for (int j = 0; j < 52; ++j)
      for (int i = 0; i < 60; ++i)
      {
        const Vector p = grid.patientFromVoxel({1.0 * i, 1.0 * j, 1.0 * k}) - middle;
        const bool nerve = p.cross(Vector(0.3, 1.0, 0.4).normalized()).norm() < 1.5;
        if (p.norm() < 8.0)
          voxels->at(i, j, k) = nerve ? 3 : p.x() + 0.3 * p.z() > 1.0 ? 1 : 2;
      }
  const auto labels = std::make_shared<const volume::LabelMap>(volume::makeLabelMap(voxels, {}));
  contents.labels =
      volume::makeLabelField({{labels, 1, 1, true}, {labels, 2, 2, true}, {labels, 3, 3, true}});
  contents.materials.insert(contents.materials.end(), {red(0.3F), blue(0.4F), red()});
  contents.materials[1].transfer =
      appearance::TransferFunction::constant({0.8F, 0.1F, 0.1F}, 0.03F);
  contents.materials[2].transfer =
      appearance::TransferFunction::constant({0.1F, 0.15F, 0.9F}, 0.02F);
  contents.materials[3].transfer = appearance::TransferFunction::constant({0.9F, 0.8F, 0.2F}, 0.5F);
  for (const double distance : {60.0, 30.0})
  {
    const Shot shot = shoot(contents, slanting(distance));
    expectAgreement(compare(shot, truthOf(contents, slanting(distance)), grid.minSpacing()));
  }
  // Without borders the same voxels give another picture: voxel faces.
  const Picture smooth = draw(contents, slanting());
  auto faces = std::make_shared<volume::LabelField>(*contents.labels);
  ASSERT_NE(faces->borders, nullptr);
  faces->borders = nullptr;
  contents.labels = faces;
  EXPECT_GT(countDifferentPixels(draw(contents, slanting()), smooth), 500U);
}

TEST(StructurePicture, DrawsOneOfTwoHundredAndFiftyFiveStructures)
{
  const core::GridGeometry grid = cube(48, 0.5);
  SceneContents contents = boneScene(ct<std::int16_t>(grid, [](const Vector&) { return -5.0; }));
  // Slabs along x, all grey except the 255th.
  contents.labels = labelField(
      grid, [](const Vector& p) { return 9.0 - p.norm(); },
      [](const Vector& p)
      { return p.z() > 4.0 ? 255 : std::clamp(static_cast<int>(127.0 + 12.0 * p.x()), 1, 254); });
  contents.materials.assign(256,
                            {appearance::TransferFunction::constant({0.5F, 0.5F, 0.5F}, 1.0F)});
  contents.materials[255] = blue();
  const Shot shot = shoot(contents, slanting());
  const ReferencePicture truth = truthOf(contents, slanting());
  EXPECT_GT(countBlue(truth.picture), 300);
  expectAgreement(compare(shot, truth, grid.minSpacing()));
}

TEST(StructurePicture, DrawsAMesh)
{
  core::TriangleMesh tetrahedron;
  tetrahedron.vertices = {{11, -11, -11}, {-11, 11, -11}, {-11, -11, 11}, {11, 11, 11}};
  tetrahedron.triangles = {{0, 1, 3}, {0, 2, 1}, {0, 3, 2}, {1, 2, 3}};
  SceneContents contents;
  MeshContents mesh{"marker", std::make_shared<core::TriangleMesh>(tetrahedron), {}};
  mesh.look.color = {0.1F, 0.15F, 0.9F};
  contents.meshes.push_back(mesh);
  ScenePicture scene;
  scene.setContents(contents);
  scene.setCamera(slanting());
  OffscreenView view(kWidth, kHeight);
  EXPECT_GT(countBlue(view.render(scene)), 1000);
  EXPECT_EQ(scene.resources().count("meshes.marker"), 1U);
  scene.setContents({});
  EXPECT_EQ(countBlue(view.render(scene)), 0);
  EXPECT_EQ(scene.resources().count("meshes.marker"), 0U);
}
