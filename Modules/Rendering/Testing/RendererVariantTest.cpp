#include <algorithm>

#include "PictureComparison.h"
#include "PictureScenes.h"
#include "petrous/Rendering/RenderingError.h"
#include "petrous/Rendering/ScenePicture.h"

using namespace petrous;
using namespace petrous::rendering;
using namespace petrous::rendering::synthetic;

namespace
{

using Names = std::vector<std::string>;

Names variantOf(const SceneContents& contents)
{
  return shoot(contents, slanting(), {}, 32, 24).statistics.variant;
}

Names namesOf(const std::map<std::string, std::size_t>& resources)
{
  Names names;
  for (const auto& [name, bytes] : resources)
  {
    EXPECT_GT(bytes, 0U) << name;
    names.push_back(name);
  }
  return names;
}

RenderStatistics counted(const SceneContents& contents, const core::CameraPose& pose)
{
  RenderQuality exact;
  exact.filterBits = RenderQuality::kExactFilterBits;
  ScenePicture scene;
  scene.setContents(contents);
  scene.setCamera(pose);
  scene.setQuality(exact);
  scene.setCounting(true);
  OffscreenView view(kWidth, kHeight);
  view.render(scene);
  return scene.statistics();
}

} // namespace

TEST(RendererVariant, UsesNothingButTheCtWhereThereIsNothingElse)
{
  const Shot shot = shoot(hollowBall(), slanting());
  EXPECT_EQ(shot.statistics.variant, (Names{"ct", "bone"}));
  EXPECT_EQ(namesOf(shot.statistics.resources), (Names{"ct.bricks", "ct.texture"}));
  EXPECT_EQ(shot.statistics.resources.at("ct.texture"), 2U * 48U * 48U * 48U);
}

TEST(RendererVariant, EdgesOfTranslucentSurfacesCostNoFetchAndNothingWhereThereAreNone)
{
  const auto hasEdges = [](const SceneContents& contents)
  {
    const Names names = variantOf(contents);
    return std::count(names.begin(), names.end(), "edges") > 0;
  };
  SceneContents contents = translucentBall();
  const Picture plain = shoot(contents, slanting()).picture;
  const RenderStatistics before = counted(contents, slanting());
  EXPECT_FALSE(hasEdges(contents));
  contents.light.edges = 1.0;
  EXPECT_TRUE(hasEdges(contents));
  EXPECT_GT(countDifferentPixels(plain, shoot(contents, slanting()).picture), 500U);
  const RenderStatistics after = counted(contents, slanting());
  EXPECT_LE(after.fetchesPerPixel, before.fetchesPerPixel); // rays may end earlier
  EXPECT_LE(after.samplesPerPixel, before.samplesPerPixel);
  contents.light.edges = 0.0;
  EXPECT_EQ(countDifferentPixels(plain, shoot(contents, slanting()).picture), 0U);
  SceneContents opaque = hollowBall();
  const Picture solid = shoot(opaque, slanting()).picture;
  opaque.light.edges = 1.0;
  EXPECT_FALSE(hasEdges(opaque));
  EXPECT_EQ(countDifferentPixels(solid, shoot(opaque, slanting()).picture), 0U);
}

TEST(RendererVariant, ASurfaceThatIsNotSeenTakesNoLookUpForItsShadows)
{
  const auto fetches = [](float opacity, bool shadows)
  {
    SceneContents contents = translucentBall();
    contents.materials = {boneMaterial(opacity)};
    contents.light.shadows = shadows;
    return counted(contents, slanting()).fetchesPerPixel;
  };
  EXPECT_EQ(fetches(0.0F, true), fetches(0.0F, false));
  EXPECT_GT(fetches(0.35F, true), 1.05 * fetches(0.35F, false));
}

TEST(RendererVariant, TakesWhatTheSceneUsesAndNothingElse)
{
  SceneContents contents = hollowBall();
  contents.mask = std::make_shared<volume::CutMask>(contents.ct->geometry()); // nothing is cut
  contents.second = movedWaves(); // no material reads it
  EXPECT_EQ(variantOf(contents), (Names{"ct", "bone"}));
  EXPECT_EQ(variantOf(cutBall()), (Names{"ct", "bone", "mask"}));
  EXPECT_EQ(variantOf(translucentBall()), (Names{"ct", "bone", "interior"}));
  EXPECT_EQ(variantOf(labelledBall(cube(48, 0.5), 1.0F)),
            (Names{"ct", "bone", "labels", "borders", "nested", "interior"}));
  contents.materials = {waveMaterial(1.0F)};
  EXPECT_EQ(variantOf(contents), (Names{"ct", "bone", "second"}));
  contents.materials = {boneMaterial()};
  contents.clipping.push_back({});
  EXPECT_EQ(variantOf(contents), (Names{"ct", "bone", "clipping"}));
  EXPECT_EQ(variantOf(fullScene()),
            (Names{"ct", "bone", "labels", "borders", "nested", "mask", "second", "interior"}));
  EXPECT_EQ(variantOf(fullSceneOfThree()), (Names{"ct", "bone", "labels", "borders", "nested",
                                                  "mask", "second", "third", "interior"}));
  contents = hollowBall();
  contents.light.shadows = true;
  EXPECT_EQ(variantOf(contents), (Names{"ct", "bone", "shadows"}));
  contents.tool = ToolPose();
  EXPECT_EQ(variantOf(contents), (Names{"ct", "bone", "shadows", "tool"}));
  contents.light.shadows = false;
  EXPECT_EQ(variantOf(contents), (Names{"ct", "bone"}));
  contents = labelledBall(cube(48, 0.5), 1.0F);
  contents.boneShown = false;
  for (appearance::Material& material : contents.materials)
    material.surfaceOpacity = 1.0F;
  EXPECT_EQ(variantOf(contents), (Names{"ct", "labels", "borders"}));
  // Structures that end rays, seen through bone; one that touches no other.
  contents.boneShown = true;
  contents.materials[0].surfaceOpacity = 0.3F;
  EXPECT_EQ(variantOf(contents), (Names{"ct", "bone", "labels", "borders", "interior"}));
  contents.labels = oneStructure(contents.labels->occupancy);
  EXPECT_EQ(variantOf(contents), (Names{"ct", "bone", "labels", "interior"}));
}

TEST(RendererVariant, LetsGoOfWhatTheSceneNoLongerUses)
{
  ScenePicture scene;
  scene.setContents(fullScene());
  scene.setCamera(slanting());
  OffscreenView view(64, 48);
  view.render(scene);
  EXPECT_EQ(namesOf(scene.resources()),
            (Names{"ct.bricks", "ct.texture", "labels.texture", "mask.texture", "mr.texture"}));
  SceneContents less = fullScene();
  less.labels = nullptr;
  less.materials = {boneMaterial()};
  less.mask = nullptr;
  scene.setContents(less);
  view.render(scene);
  EXPECT_EQ(scene.statistics().variant, (Names{"ct", "bone"}));
  EXPECT_EQ(namesOf(scene.resources()), (Names{"ct.bricks", "ct.texture"}));
}

TEST(RendererVariant, KeepsOnlyTheImagesThatAreRead)
{
  const auto bytesOf = [](const SecondImage& image)
  { return image.volume->geometry().voxelCount() * sizeof(float); };
  const SceneContents three = fullSceneOfThree();
  ScenePicture scene;
  scene.setCamera(slanting());
  OffscreenView view(kWidth, kHeight);
  const auto bytes = [&](const SceneContents& contents)
  {
    scene.setContents(contents);
    EXPECT_EQ(countDifferentPixels(view.render(scene), draw(contents, slanting())), 0U);
    const auto resources = scene.resources();
    const auto found = resources.find("mr.texture");
    return found == resources.end() ? std::size_t{0} : found->second;
  };
  const std::size_t second = bytesOf(three.second);
  const std::size_t third = bytesOf(three.third);
  ASSERT_NE(second, third);
  EXPECT_EQ(bytes(three), second + third);
  SceneContents one = three;
  one.materials[1] = blue(); // nobody reads the second
  EXPECT_EQ(bytes(one), third);
  EXPECT_EQ(bytes(three), second + third);
  one = three;
  one.materials[2] = red();
  EXPECT_EQ(bytes(one), second);
  one.third = {};
  EXPECT_EQ(bytes(one), second);
  one.materials[1] = blue();
  EXPECT_EQ(bytes(one), 0U);
  one.materials[2].source = appearance::IntensitySource::Third;
  EXPECT_THROW(scene.setContents(one), RenderingError) << "there is none";
}

TEST(RendererVariant, DrawsAnotherSecondImageThatCameWhileNobodyReadIt)
{
  ScenePicture scene;
  SceneContents contents = translucentBall();
  contents.second = movedWaves();
  contents.materials = {waveMaterial(0.3F)};
  scene.setContents(contents);
  scene.setCamera(slanting());
  OffscreenView view(kWidth, kHeight);
  view.render(scene);
  contents.materials = {boneMaterial()};
  contents.second.volume =
      image(cube(36, 0.9), [](const Vector& p) { return 500.0 + 40.0 * p.z(); });
  scene.setContents(contents);
  view.render(scene);
  contents.materials = {waveMaterial(0.3F)};
  scene.setContents(contents);
  EXPECT_EQ(countDifferentPixels(view.render(scene), draw(contents, slanting())), 0U);
}

// NVIDIA's cards have 8 bits, llvmpipe takes the weights as they are.
TEST(RendererVariant, MeasuresToHowManyBitsTheCardRoundsItsFilter)
{
  const int bits = shoot(hollowBall(), slanting(), {}, 32, 24).statistics.filterBits;
  EXPECT_TRUE(bits == RenderQuality::kExactFilterBits || (bits >= 6 && bits <= 9)) << bits;
  RenderQuality rounded;
  rounded.filterBits = 6;
  EXPECT_EQ(shoot(hollowBall(), slanting(), rounded, 32, 24).statistics.filterBits, 6);
}

// As on a card whose filter rounds: surfaces lie, and look, as where it does not; while the picture
// moves, too, but for what rays graze.
TEST(RendererVariant, FindsSurfacesExactlyWhereTheCardRoundsItsFilter)
{
  SceneContents structures = labelledBall(cube(64, 0.35, obliqueMirrored()), 1.0F);
  structures.mask = cut(structures.ct->geometry(), cavity);
  RenderQuality exact, rounded;
  exact.filterBits = RenderQuality::kExactFilterBits;
  rounded.filterBits = 8;
  RenderQuality quick = rounded;
  quick.exactSamples = false;
  for (const SceneContents& contents :
       {hollowBall(oblique()), cutBall(), cutBall(0.35F), structures, fullScene()})
  {
    const ReferencePicture truth = truthOf(contents, slanting());
    const double voxel = contents.ct->geometry().minSpacing();
    const Agreement wanted = compare(shoot(contents, slanting(), exact), truth, voxel);
    const Agreement got = compare(shoot(contents, slanting(), rounded), truth, voxel);
    EXPECT_LE(got.rms, wanted.rms + 0.01);
    EXPECT_LE(got.others, wanted.others);
    EXPECT_LE(got.median, wanted.median + 1e-5);
    EXPECT_LE(got.farthest, wanted.farthest + 1e-3);
    EXPECT_LE(got.background, 1);
    const Agreement moving = compare(shoot(contents, slanting(), quick), truth, voxel);
    expectAgreement(moving);
    EXPECT_LE(moving.median, wanted.median + 1e-4);
  }
}

TEST(RendererVariant, CountsWithoutChangingThePicture)
{
  ScenePicture scene;
  scene.setContents(fullScene());
  scene.setCamera(slanting());
  OffscreenView view(kWidth, kHeight);
  const Picture before = view.render(scene);
  scene.setCounting(true);
  EXPECT_EQ(countDifferentPixels(view.render(scene), before), 0U);
  EXPECT_GT(scene.statistics().samplesPerPixel, 0.0);
  EXPECT_GT(scene.statistics().fetchesPerPixel, scene.statistics().samplesPerPixel);
}

// The limits are 15 % above the counts when they were set, so that no regression in ray cost goes
// unnoticed. Unlike time, fetches do not depend on the machine.
TEST(RendererVariant, FetchesNoMoreThanItDid)
{
  core::CameraPose near = slanting(18.0);
  near.viewAngle = 60.0;
  struct Limit
  {
    const char* name;
    SceneContents contents;
    core::CameraPose pose;
    double fetches;
    double samples;
  };
  const std::vector<Limit> limits{
      {"opaque", hollowBall(oblique()), slanting(), 14.8, 5.4},
      {"opaque, near", hollowBall(oblique()), near, 39.6, 16.8},
      {"translucent", translucentBall(), slanting(), 35.0, 15.2},
      {"cut", cutBall(), near, 53.9, 18.1},
      {"labels", labelledBall(cube(64, 0.35, obliqueMirrored())), slanting(), 39.2, 14.4},
      {"everything", fullScene(), near, 165.2, 46.6},
  };
  for (const Limit& limit : limits)
  {
    const RenderStatistics statistics = counted(limit.contents, limit.pose);
    EXPECT_LE(statistics.fetchesPerPixel, limit.fetches) << limit.name;
    EXPECT_GE(statistics.fetchesPerPixel, 0.5 * limit.fetches) << limit.name; // counting works
    EXPECT_LE(statistics.samplesPerPixel, limit.samples) << limit.name;
  }
}
