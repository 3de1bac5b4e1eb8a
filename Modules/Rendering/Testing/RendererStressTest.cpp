#include <limits>
#include <utility>

#include "PictureComparison.h"
#include "PictureScenes.h"
#include "petrous/Rendering/ScenePicture.h"
#include "petrous/Volume/LabelField.h"

using namespace petrous;
using namespace petrous::rendering;
using namespace petrous::rendering::synthetic;

namespace
{

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

bool isEmpty(const Shot& shot)
{
  for (int row = 0; row < shot.picture.height; ++row)
    for (int column = 0; column < shot.picture.width; ++column)
      if (!isBackground(shot.picture.pixel(column, row)) || !std::isnan(shot.depth.at(column, row)))
        return false;
  return true;
}

SceneContents uniform(double value, int samples = 24)
{
  return boneScene(image(cube(samples, 0.5), [=](const Vector&) { return value; }));
}

Agreement agreementOf(const SceneContents& contents, const core::CameraPose& pose = slanting(),
                      const RenderQuality& quality = {})
{
  return compare(shoot(contents, pose, quality), truthOf(contents, pose),
                 contents.ct->geometry().minSpacing());
}

// Thickness of tissue from a first hit on, mm, to a thousandth.
double thickness(const volume::TissueField& field, const PixelRay& ray, double hit)
{
  double t = hit + 1e-3;
  while (t < hit + 5.0 && field.value(ray.origin + t * ray.direction) > 0.0)
    t += 1e-3;
  return t - hit;
}

// 255 labels, as many as there can be, each a block above a slab of bone; seen from above.
struct LabelBlocks
{
  static constexpr int kLabels = 255;
  static constexpr int kColumns = 16;
  static constexpr int kCell = 8; // pixels a block and its surroundings
  static constexpr int kPixels = kColumns * kCell;

  LabelBlocks(int edge, int slices)
  {
    constexpr double kWidth = 204.8; // mm
    const double spacing = kWidth / edge;
    const core::GridGeometry grid({edge, edge, slices}, Vector::Constant(spacing), Vector::Zero());
    const std::size_t slice = static_cast<std::size_t>(edge) * static_cast<std::size_t>(edge);
    auto bone = std::make_shared<volume::Volume<std::int16_t>>(grid, std::int16_t{-1000});
    std::fill_n(bone->data(), slice * static_cast<std::size_t>(slices / 6), std::int16_t{1600});
    contents = boneScene(intensities<std::int16_t>(std::move(bone)));
    contents.labels = fieldOf(blocks(grid));
    for (int n = 0; n < kLabels; ++n)
      contents.materials.push_back(
          {appearance::TransferFunction::constant({red(n), green(n), 0.5F}, 0.5F, 0.0F)});
    const double middle = 0.5 * (kWidth - spacing);
    pose = from({middle, middle, 300.0}, {middle, middle, 60.0});
    pose.viewUp = {0.0, 1.0, 0.0};
    pose.parallelScale = 0.5 * kWidth;
  }

  static float red(int n) { return 0.1F + 0.05F * static_cast<float>(n % kColumns); }
  static float green(int n) { return 0.1F + 0.05F * static_cast<float>(n / kColumns); }

  // At 16 levels, so that the label field is large too.
  static std::shared_ptr<const volume::LabelMap> blocks(const core::GridGeometry& grid)
  {
    auto voxels = volume::makeZeroVolume<std::uint16_t>(grid);
    const int cell = grid.dims()[0] / kColumns;
    const int thickness = grid.dims()[2] / 30;
    for (int n = 0; n < kLabels; ++n)
    {
      const int left = n % kColumns * cell + cell / 4;
      const int front = n / kColumns * cell + cell / 4;
      const int first = (6 + n % 16) * thickness;
      for (int k = first; k < first + thickness; ++k)
        for (int j = front; j < front + cell / 2; ++j)
          std::fill_n(&voxels->at(left, j, k), cell / 2, static_cast<std::uint16_t>(n + 1));
    }
    return std::make_shared<volume::LabelMap>(volume::makeLabelMap(std::move(voxels), {}));
  }

  static std::shared_ptr<const volume::LabelField>
  fieldOf(const std::shared_ptr<const volume::LabelMap>& labels)
  {
    std::vector<volume::LabelSource> sources;
    for (int n = 1; n <= kLabels; ++n)
      sources.push_back(
          {labels, static_cast<std::uint16_t>(n), static_cast<std::uint8_t>(n), true});
    return volume::makeLabelField(sources);
  }

  // Every label in its colour, and bone beside it.
  void expectAllIn(const Picture& picture) const
  {
    const auto at = [&](int n)
    {
      return std::pair{kCell * (n % kColumns) + kCell / 2,
                       kPixels - kCell * (n / kColumns) - kCell / 2};
    };
    const auto isBone = [&](int column, int row)
    {
      const std::uint8_t* pixel = picture.pixel(column, row);
      return pixel[0] > pixel[1] && pixel[1] > pixel[2] && pixel[0] > 190;
    };
    for (int n = 0; n < kLabels; ++n)
    {
      const auto [column, row] = at(n);
      const std::uint8_t* pixel = picture.pixel(column, row);
      EXPECT_NEAR(pixel[0], 255.0 * red(n), 3.0) << "label " << n + 1;
      EXPECT_NEAR(pixel[1], 255.0 * green(n), 3.0) << "label " << n + 1;
      EXPECT_NEAR(pixel[2], 127.5, 3.0) << "label " << n + 1;
      EXPECT_TRUE(n % kColumns == 0 || isBone(column - kCell / 2, row)) << "beside label " << n + 1;
    }
    const auto [column, row] = at(kLabels); // no label has this place
    EXPECT_TRUE(isBone(column, row));
  }

  SceneContents contents;
  core::CameraPose pose;
};

} // namespace

TEST(RendererStress, DrawsAVolumeOfOneValue)
{
  EXPECT_TRUE(isEmpty(shoot(uniform(-1000.0), slanting())));
  EXPECT_TRUE(isEmpty(shoot(uniform(kIso), slanting()))); // f = 0 is air
  const Agreement solid = agreementOf(uniform(1200.0));
  EXPECT_GT(solid.hits, 1000);
  expectAgreement(solid);
  SceneContents translucent = uniform(1200.0);
  translucent.materials = {boneMaterial(0.3F)};
  expectAgreement(agreementOf(translucent));
}

TEST(RendererStress, DrawsNoVolumeThatIsOneVoxelThick)
{
  for (const core::Index3& dims : {core::Index3{1, 40, 40}, core::Index3{40, 1, 40},
                                   core::Index3{40, 40, 1}, core::Index3{1, 1, 1}})
  {
    const core::GridGeometry grid(dims, {0.5, 0.5, 0.5}, {-10.0, -10.0, -10.0});
    SceneContents contents = boneScene(image(grid, [](const Vector&) { return 2000.0; }), 0.3F);
    EXPECT_TRUE(isEmpty(shoot(contents, slanting())));
  }
}

TEST(RendererStress, DrawsTwoVoxelsAlongEachAxis)
{
  const core::GridGeometry grid({2, 2, 2}, {9.0, 9.0, 9.0}, {-4.5, -4.5, -4.5});
  SceneContents contents =
      boneScene(image(grid, [](const Vector& p) { return kIso + 60.0 * p.sum(); }), 0.3F);
  const Agreement agreement = agreementOf(contents);
  EXPECT_GT(agreement.hits, 1000);
  expectAgreement(agreement);
}

TEST(RendererStress, DrawsASlabTwoVoxelsThick)
{
  const core::GridGeometry grid({60, 2, 60}, {0.4, 0.4, 0.4}, {-12.0, 0.0, -12.0});
  SceneContents contents =
      boneScene(image(grid, [](const Vector& p)
                      { return kIso + 90.0 * (8.0 - Vector(p.x(), 0.0, p.z()).norm()); }),
                0.3F);
  const Agreement agreement = agreementOf(contents);
  EXPECT_GT(agreement.hits, 1000);
  expectAgreement(agreement);
}

TEST(RendererStress, ShowsNothingButDepthWhereAllIsTransparent)
{
  SceneContents contents = hollowBall();
  contents.materials = {{appearance::TransferFunction::constant({1.0F, 1.0F, 1.0F}, 0.0F),
                         appearance::IntensitySource::Ct, 0.0F}};
  const Shot shot = shoot(contents, slanting());
  int hits = 0;
  for (int row = 0; row < kHeight; ++row)
    for (int column = 0; column < kWidth; ++column)
    {
      ASSERT_TRUE(isBackground(shot.picture.pixel(column, row)));
      hits += !std::isnan(shot.depth.at(column, row));
    }
  // The surface exists for haptics and picking although it is invisible.
  EXPECT_GT(hits, 4000);
  expectAgreement(agreementOf(contents));
}

TEST(RendererStress, TakesVoxelsThatAreNoNumbersForAir)
{
  const core::GridGeometry grid = cube(48, 0.5);
  const SceneContents holed = boneScene(
      image(grid,
            [](const Vector& p)
            {
              const bool hole = (p - Vector(2.0, -8.0, 2.0)).norm() < 3.0;
              return hole ? kNan : std::clamp(kIso + 240.0 * bittenBall(p), -1000.0, 2500.0);
            }),
      0.35F);
  // Every cell with such a corner is air in both engines, so the hole's wall is a staircase. Its
  // shading is undefined: the reference finds no normal, the mapper one pointing out of the hole.
  const core::CameraPose pose = slanting();
  const ReferencePicture truth = truthOf(holed, pose);
  const volume::TissueField f = field(holed);
  const PixelRays rays(pose, kWidth, kHeight);
  for (const double step : {0.25, 0.3, 0.33, 0.36, 0.38, 0.4, 0.45, 0.5})
  {
    RenderQuality quality;
    quality.step = step;
    const Shot shot = shoot(holed, pose, quality);
    const Agreement agreement = compare(shot, truth, grid.minSpacing());
    EXPECT_GT(agreement.hits, 3000);
    EXPECT_LE(agreement.others, 0.05) << step;
    EXPECT_LE(agreement.median, 0.001) << step;
    EXPECT_LE(agreement.rms, 15.0) << step;
    for (int row = 0; row < kHeight; ++row)
      for (int column = 0; column < kWidth; ++column)
      {
        const auto drawn = static_cast<double>(shot.depth.at(column, row));
        const auto wanted = static_cast<double>(truth.depth.at(column, row));
        const bool agree = std::isnan(wanted) ? std::isnan(drawn)
                                              : std::abs(drawn - wanted) < 0.01 * grid.minSpacing();
        if (agree)
          continue;
        // Only a corner of a step that the ray cuts over less than a sampling step may be missed.
        const PixelRay ray = rays.through(column, row);
        EXPECT_FALSE(drawn < wanted || std::isnan(wanted)) << step << ": " << column << " " << row;
        EXPECT_LT(thickness(f, ray, wanted), step * grid.minSpacing())
            << step << ": " << column << " " << row;
      }
  }
  EXPECT_TRUE(isEmpty(shoot(uniform(kNan), slanting())));
  EXPECT_TRUE(isEmpty(shoot(uniform(-std::numeric_limits<double>::infinity()), slanting())));
}

TEST(RendererStress, DrawsSurfacesAtTheEndsOfSixteenBits)
{
  // Half of the range on each side of the border between two voxels.
  const auto step = [](double low, double high)
  { return [=](const Vector& p) { return p.y() < 0.0 ? low : high; }; };
  const core::GridGeometry grid = cube(24, 0.5);
  SceneContents contents =
      boneScene(intensities<std::int16_t>(sampled<std::int16_t>(grid, step(-32767.0, 32767.0))));
  for (const double iso : {-32766.0, 0.0, 32766.0})
  {
    contents.iso = iso;
    const Agreement agreement = agreementOf(contents);
    EXPECT_GT(agreement.hits, 1000) << iso;
    expectAgreement(agreement);
  }
  for (const double iso : {32767.0, 1e6})
  {
    contents.iso = iso;
    EXPECT_TRUE(isEmpty(shoot(contents, slanting()))) << iso;
  }
  contents.iso = -1e6; // everything is bone
  expectAgreement(agreementOf(contents));
}

TEST(RendererStress, FollowsAWindowThatIsResizedBetweenEdits)
{
  const SceneContents contents = cutBall(0.35F);
  ScenePicture scene;
  scene.setContents(contents);
  scene.setCamera(slanting());
  for (const auto& [width, height] :
       {std::pair{200, 150}, {31, 77}, {1, 1}, {150, 200}, {200, 150}})
  {
    OffscreenView view(width, height);
    const Shot shot = shoot(view, scene);
    EXPECT_EQ(shot.picture.width, width);
    EXPECT_EQ(shot.depth.width, width);
    EXPECT_EQ(shot.depth.height, height);
    EXPECT_EQ(
        countDifferentPixels(shot.picture, shoot(contents, slanting(), {}, width, height).picture),
        0U);
    scene.maskChanged(contents.mask, contents.ct->geometry().fullBox());
  }
}

TEST(RendererStress, DrawsWithTheCoarsestAndTheFinestQuality)
{
  const SceneContents contents = cutBall(0.35F);
  const Picture normal = draw(contents, slanting());
  const auto meanOf = [](const Picture& picture)
  {
    double sum = 0.0;
    for (const std::uint8_t value : picture.rgb)
      sum += value;
    return sum / static_cast<double>(picture.rgb.size());
  };
  RenderQuality coarse;
  coarse.imageScale = 0.1;
  coarse.step = 10.0;
  coarse.bisections = 0;
  coarse.tableSize = 16;
  coarse.brick = 16;
  coarse.maskBits = 8;
  coarse.termination = 0.5;
  const Shot rough = shoot(contents, slanting(), coarse);
  EXPECT_EQ(rough.depth.width, kWidth / 10);
  EXPECT_NEAR(meanOf(rough.picture) / meanOf(normal), 1.0, 0.5);

  RenderQuality fine;
  fine.step = 0.05;
  fine.bisections = 24;
  fine.tableSize = 4096;
  fine.termination = 0.0;
  const Agreement best = agreementOf(contents, slanting(), fine);
  expectAgreement(best);
  EXPECT_LE(best.rms, 0.45);
  EXPECT_LE(best.others, 0.02);
}

TEST(RendererStress, DrawsReducedWhatTheCardHasNoRoomForAndSaysSo)
{
  const SceneContents contents = fullScene();
  EXPECT_TRUE(shoot(contents, slanting()).statistics.notes.empty());
  RenderQuality quality;
  quality.largestTexture = 40; // of 48
  const Shot whole = shoot(contents, slanting());
  const Shot reduced = shoot(contents, slanting(), quality);
  ASSERT_FALSE(reduced.statistics.notes.empty());
  EXPECT_EQ(reduced.statistics.notes[0].rfind("the CT is drawn reduced by 2 x 2 x 2", 0), 0U)
      << reduced.statistics.notes[0];
  for (const std::string& note : reduced.statistics.notes)
    EXPECT_EQ(note.find("second"), std::string::npos) << note; // it has only 36 voxels per edge
  EXPECT_LT(reduced.statistics.resources.at("ct.texture"),
            whole.statistics.resources.at("ct.texture") / 7);
  // Half the resolution keeps smooth surfaces accurate to a third of a voxel.
  ReferencePicture truth;
  truth.depth = whole.depth;
  truth.rgb.assign(whole.picture.rgb.begin(), whole.picture.rgb.end());
  for (float& value : truth.rgb)
    value /= 255.0F;
  const Agreement agreement = compare(reduced, truth, 0.5);
  EXPECT_LE(agreement.median, 0.15);
  EXPECT_LE(agreement.others, 4.0);
  EXPECT_LE(agreement.rms, 12.0);
  // Restored to full resolution, including edits, when the limit is lifted.
  ScenePicture scene;
  scene.setContents(contents);
  scene.setCamera(slanting());
  scene.setQuality(quality);
  OffscreenView view(kWidth, kHeight);
  EXPECT_EQ(countDifferentPixels(view.render(scene), reduced.picture), 0U);
  scene.maskChanged(std::make_shared<volume::CutMask>(*contents.mask), {{7, 7, 7}, {30, 31, 32}});
  EXPECT_EQ(countDifferentPixels(view.render(scene), reduced.picture), 0U);
  scene.setQuality({});
  EXPECT_EQ(countDifferentPixels(view.render(scene), whole.picture), 0U);
  EXPECT_TRUE(scene.statistics().notes.empty());
}

TEST(RendererStress, DrawsNothingOfAnEmptyCropBox)
{
  SceneContents contents = translucentBall();
  for (const core::IndexBox& box :
       {core::IndexBox{{10, 10, 10}, {10, 30, 30}}, core::IndexBox{{30, 10, 10}, {12, 30, 30}},
        core::IndexBox{{10, 10, 10}, {11, 30, 30}}, core::IndexBox{{60, 0, 0}, {90, 48, 48}}})
  {
    contents.crop = box;
    EXPECT_TRUE(isEmpty(shoot(contents, slanting())));
  }
}

TEST(RendererStress, DrawsNothingBehindAClippingPlaneOrBesideTheVolume)
{
  SceneContents contents = translucentBall();
  contents.clipping = {{{0.0, 0.0, 100.0}, {0.0, 0.0, 1.0}}};
  EXPECT_TRUE(isEmpty(shoot(contents, slanting())));
  core::CameraPose away = slanting();
  away.focalPoint = 2.0 * away.position;
  contents.clipping.clear();
  EXPECT_TRUE(isEmpty(shoot(contents, away)));
}

TEST(RendererStress, LooksAlongTheAxesOfTheGrid)
{
  // Axis-parallel rays, on the border between cells and in the volume's face.
  for (const Vector& direction :
       {Vector(1.0, 0.0, 0.0), Vector(0.0, -1.0, 0.0), Vector(0.0, 0.0, 1.0)})
  {
    core::CameraPose pose;
    pose.position = -40.0 * direction;
    pose.focalPoint = {0.0, 0.0, 0.0};
    pose.viewUp = Vector(direction.y(), direction.z(), direction.x());
    pose.parallelScale = 37.5; // 0.5 mm per pixel: each ray runs through voxel centres
    const SceneContents contents = boneScene(ball(cube(48, 0.5), 14.0), 0.35F);
    expectAgreement(agreementOf(contents, pose));
  }
}

TEST(RendererStress, DrawsAllOf255Labels)
{
  const LabelBlocks scene(256, 150);
  const Shot whole =
      shoot(scene.contents, scene.pose, {}, LabelBlocks::kPixels, LabelBlocks::kPixels);
  EXPECT_TRUE(whole.statistics.notes.empty());
  scene.expectAllIn(whole.picture);

  RenderQuality small;
  small.largestTexture = 128; // as on a graphics card without room for more
  const Shot reduced =
      shoot(scene.contents, scene.pose, small, LabelBlocks::kPixels, LabelBlocks::kPixels);
  EXPECT_EQ(reduced.statistics.notes.size(), 2U); // CT and label field
  scene.expectAllIn(reduced.picture);
}
