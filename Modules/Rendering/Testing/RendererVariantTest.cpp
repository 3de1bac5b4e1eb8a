#include <algorithm>
#include <memory>
#include <utility>

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

template <class Change>
SceneContents changed(SceneContents contents, const Change& change)
{
  change(contents);
  return contents;
}

void shadowed(SceneContents& contents)
{
  contents.light.setShadows(true);
}

appearance::Material flesh()
{
  return {appearance::TransferFunction({{-900.0, {0.9F, 0.7F, 0.6F}, 0.0F},
                                        {-500.0, {0.9F, 0.7F, 0.6F}, 0.1F},
                                        {300.0, {0.6F, 0.2F, 0.15F}, 0.05F},
                                        {900.0, {0.5F, 0.15F, 0.1F}, 0.1F}})};
}

ToolPose toolAt(std::shared_ptr<const core::TriangleMesh> instrument)
{
  ToolPose tool;
  tool.center = {2.0, -7.0, 3.0}; // in the cavity
  tool.axisToHand = Vector(0.3, -1.0, 0.2).normalized();
  tool.instrument = std::move(instrument);
  tool.rotation = Eigen::Quaterniond::FromTwoVectors(Vector::UnitZ(), tool.axisToHand);
  return tool;
}

// Through the cavity.
MeshContents plate()
{
  MeshContents mesh;
  mesh.name = "plate";
  mesh.mesh = boxMesh({-8.0, -8.0, -6.0}, {8.0, -7.0, 6.0});
  mesh.drilled = true;
  return mesh;
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
      // Each feature of the picture, alone.
      {"edges", changed(translucentBall(), [](SceneContents& c) { c.light.edges = 1.0; }),
       slanting(), 34.8, 15.1},
      {"soft tissue", changed(cutBall(), [](SceneContents& c) { c.softTissue = flesh(); }), near,
       377.6, 83.3},
      {"soft tissue by an MR",
       changed(cutBall(),
               [](SceneContents& c)
               {
                 c.second = movedWaves();
                 c.softTissue = flesh();
                 c.softTissue->source = appearance::IntensitySource::Second;
               }),
       near, 451.4, 86.9},
      {"structure by an MR",
       changed(hollowBall(oblique()),
               [](SceneContents& c)
               {
                 c.second = movedWaves();
                 c.materials = {waveMaterial(0.3F)};
               }),
       slanting(), 27.7, 10.6},
      {"shadows", changed(cutBall(), shadowed), near, 65.3, 18.1},
      {"shadows of translucent bone", changed(translucentBall(), shadowed), slanting(), 38.6, 15.2},
      {"shadows with a burr",
       changed(cutBall(),
               [](SceneContents& c)
               {
                 shadowed(c);
                 c.tool = toolAt(nullptr);
               }),
       near, 51.1, 14.0},
      {"shadows with an instrument",
       changed(cutBall(),
               [](SceneContents& c)
               {
                 shadowed(c);
                 c.tool = toolAt(boxMesh({-1.0, -1.5, 0.0}, {1.0, 1.5, 30.0}));
               }),
       near, 58.8, 13.1},
      {"drilled mesh", changed(cutBall(), [](SceneContents& c) { c.meshes = {plate()}; }), near,
       43.0, 14.8},
      {"drilled mesh in shadows",
       changed(cutBall(),
               [](SceneContents& c)
               {
                 shadowed(c);
                 c.meshes = {plate()};
               }),
       near, 51.7, 14.8},
      {"section",
       changed(translucentBall(),
               [](SceneContents& c)
               {
                 c.clipping = {{{0.0, 0.0, 2.0}, {0.0, 0.0, -1.0}}};
                 c.section = SectionWindow{};
               }),
       slanting(), 22.3, 9.3},
  };
  for (const Limit& limit : limits)
  {
    const RenderStatistics statistics = counted(limit.contents, limit.pose);
    EXPECT_LE(statistics.fetchesPerPixel, limit.fetches) << limit.name;
    EXPECT_GE(statistics.fetchesPerPixel, 0.5 * limit.fetches) << limit.name; // counting works
    EXPECT_LE(statistics.samplesPerPixel, limit.samples) << limit.name;
  }
}

// Light that is not looked up on the way is free: the tone curve, the water film, the falloff,
// the grain.
TEST(RendererVariant, LightThatIsReckonedAtTheSurfaceTakesNoFetch)
{
  const RenderStatistics plain = counted(cutBall(), slanting());
  const SceneContents lit = changed(cutBall(),
                                    [](SceneContents& c)
                                    {
                                      c.light.toneCurve = true;
                                      c.light.exposure = 0.7;
                                      c.light.wetness = 1.0;
                                      c.light.falloff = 30.0;
                                      c.light.grain = 1.0;
                                    });
  EXPECT_GT(
      countDifferentPixels(shoot(cutBall(), slanting()).picture, shoot(lit, slanting()).picture),
      500U);
  EXPECT_EQ(counted(lit, slanting()).fetchesPerPixel, plain.fetchesPerPixel);
  EXPECT_EQ(counted(lit, slanting()).samplesPerPixel, plain.samplesPerPixel);
}
