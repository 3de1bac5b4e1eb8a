#include <gtest/gtest.h>

#include <map>
#include <string>
#include <vector>

#include "petrous/Presenters/CasePicture.h"
#include "petrous/Presenters/SceneAssembly.h"

using namespace petrous;
using namespace petrous::presenters;
using Eigen::Vector3d;

namespace
{

const core::GridGeometry kGrid({24, 24, 24}, Vector3d::Constant(0.5), Vector3d::Zero());

std::shared_ptr<const volume::IntensityVolume> air()
{
  return std::make_shared<const volume::IntensityVolume>(
      std::make_shared<const volume::Volume<std::int16_t>>(kGrid, std::int16_t{-1000}));
}

// Two overlapping slabs of 8 voxels, "low" and "high", in separate maps, and a third elsewhere.
scene::Case slabs()
{
  scene::Case value;
  value.name = "slabs";
  value.ct.geometry = kGrid;
  value.ct.volume = air();
  for (const auto& [name, first] :
       {std::pair{"low", 4}, std::pair{"high", 8}, std::pair{"far", 18}})
  {
    auto voxels = std::make_shared<volume::Volume<std::uint16_t>>(kGrid, std::uint16_t{0});
    for (int k = first; k < std::min(first + 8, 24); ++k)
      for (int j = 4; j < 20; ++j)
        for (int i = 4; i < 20; ++i)
          voxels->at(i, j, k) = 7;
    scene::LabelPart part;
    part.labels =
        std::make_shared<const volume::LabelMap>(volume::makeLabelMap(std::move(voxels), {}));
    scene::StructurePart s;
    s.name = name;
    s.index = 7;
    part.structures = {s};
    value.labels.push_back(std::move(part));
  }
  return value;
}

appearance::StructureAppearance& look(scene::Case& value, const char* name)
{
  return scene::findStructure(value, name)->look;
}

scene::ImagePart mr(const char* name, bool registered, bool& loaded)
{
  scene::ImagePart part;
  part.name = name;
  part.registered = registered;
  part.mrFromCt = {Eigen::Quaterniond::Identity(), {1.0, 2.0, 3.0}};
  part.volume = core::Lazy<volume::IntensityVolume>(
      [&loaded]
      {
        loaded = true;
        return air();
      });
  return part;
}

int materialAt(const rendering::SceneContents& contents, const Vector3d& patient)
{
  const auto& index = *contents.labels->index;
  const Vector3d voxel = index.geometry().voxelFromPatient(patient);
  return index.at(int(std::lround(voxel[0])), int(std::lround(voxel[1])),
                  int(std::lround(voxel[2])));
}

const Vector3d kOverlap(6.0, 6.0, 5.0);

} // namespace

TEST(SceneAssembly, KeepsTheLabelFieldWhileTheSameVoxelsAreShown)
{
  scene::Case value = slabs();
  SceneAssembly assembly;
  const auto first = assembly.contents(value).labels;
  ASSERT_NE(first, nullptr);
  look(value, "low").color = {1.0F, 0.0F, 0.0F};
  look(value, "low").opacity = 0.3F;
  look(value, "low").transfer = appearance::TransferFunction::constant({0, 1, 0}, 0.5F);
  look(value, "high").touchable = false;
  value.boneLook.shown = false;
  value.iso = 500.0;
  const auto contents = assembly.contents(value);
  EXPECT_EQ(contents.labels, first);
  EXPECT_EQ(contents.materials.at(1).surfaceOpacity, 0.3F);
  EXPECT_FALSE(contents.boneShown);
  look(value, "far").shown = false;
  EXPECT_NE(assembly.contents(value).labels, first);
  for (const char* name : {"low", "high"})
    look(value, name).shown = false;
  EXPECT_EQ(assembly.contents(value).labels, nullptr);
}

// As slices show it when the case is opened.
TEST(SceneAssembly, SectionsAreInTheBoneWindow)
{
  const auto section = SceneAssembly().contents(slabs()).section;
  ASSERT_TRUE(section);
  EXPECT_EQ(section->width, 4000.0);
  EXPECT_EQ(section->level, 700.0);
}

TEST(SceneAssembly, GivesAnOverlapToTheLowerPriority)
{
  scene::Case value = slabs();
  SceneAssembly assembly;
  const auto shininessThere = [&]
  {
    const auto contents = assembly.contents(value);
    return contents.materials.at(std::size_t(materialAt(contents, kOverlap))).shininess;
  };
  look(value, "low").shininess = 11.0F;
  look(value, "high").shininess = 22.0F;
  look(value, "low").priority = 80;
  look(value, "high").priority = 10;
  EXPECT_EQ(shininessThere(), 22.0F);
  look(value, "low").priority = 5;
  EXPECT_EQ(shininessThere(), 11.0F);
}

TEST(SceneAssembly, NumbersMaterialsByTheShownStructuresAfterBone)
{
  scene::Case value = slabs();
  look(value, "low").shown = false;
  look(value, "high").shininess = 31.0F;
  look(value, "far").shininess = 77.0F;
  const auto contents = sceneContents(value);
  ASSERT_EQ(contents.materials.size(), 3u);
  EXPECT_EQ(contents.materials[1].shininess, 31.0F);
  EXPECT_EQ(contents.materials[2].shininess, 77.0F);
  EXPECT_EQ(materialAt(contents, {6.0, 6.0, 10.0}), 2);
  EXPECT_EQ(materialAt(contents, kOverlap), 1) << "of what is shown";
}

TEST(SceneAssembly, LoadsNoLabelsWhereNothingOfThemIsShown)
{
  scene::Case value = slabs();
  look(value, "far").shown = false;
  bool loaded = false;
  value.labels[2].labels = core::Lazy<volume::LabelMap>(
      [&loaded]
      {
        loaded = true;
        return std::make_shared<const volume::LabelMap>();
      });
  sceneContents(value);
  EXPECT_FALSE(loaded);
}

TEST(SceneAssembly, PresetsFollowWhereBoneLies)
{
  scene::Case value = slabs();
  value.iso = 9000.0;
  value.denseBone = 21000.0;
  const auto points = sceneContents(value).materials.at(0).transfer.points();
  EXPECT_DOUBLE_EQ(points.front().value, 9000.0) << "bone begins at 300 HU";
  value.boneLook.relative = false;
  const auto absolute = sceneContents(value).materials.at(0).transfer.points();
  EXPECT_DOUBLE_EQ(absolute.front().value, 300.0);
}

TEST(SceneAssembly, DrawsTheFirstRegisteredMrThatALookAsksFor)
{
  scene::Case value = slabs();
  bool t1 = false;
  bool t2 = false;
  bool t3 = false;
  value.mr = {mr("t1", false, t1), mr("t2", true, t2), mr("t3", true, t3)};
  for (const char* name : {"low", "high", "far"})
    look(value, name).transfer = appearance::TransferFunction::constant({1, 1, 1}, 0.1F);
  EXPECT_EQ(sceneContents(value).second.volume, nullptr);
  look(value, "low").sourceImage = "t1";  // not registered
  look(value, "high").sourceImage = "t3"; // and t2 is not referred to
  const auto contents = sceneContents(value);
  EXPECT_NE(contents.second.volume, nullptr);
  EXPECT_EQ(contents.second.secondFromCt.translation(), Vector3d(1.0, 2.0, 3.0));
  EXPECT_EQ(contents.materials.at(1).source, appearance::IntensitySource::Ct);
  EXPECT_FALSE(contents.materials.at(1).transfer == *look(value, "low").transfer)
      << "values of an MR are not read from the CT";
  EXPECT_EQ(contents.materials.at(2).source, appearance::IntensitySource::Second);
  EXPECT_TRUE(t3);
  EXPECT_FALSE(t1 || t2);
}

TEST(SceneAssembly, AHiddenStructureAsksForNoMr)
{
  scene::Case value = slabs();
  bool loaded = false;
  value.mr = {mr("t1", true, loaded)};
  look(value, "low").transfer = appearance::TransferFunction::constant({1, 1, 1}, 0.1F);
  look(value, "low").sourceImage = "t1";
  look(value, "low").shown = false;
  sceneContents(value);
  EXPECT_FALSE(loaded);
}

TEST(SceneAssembly, DrawsSoftTissueWhereItIsShown)
{
  scene::Case value = slabs();
  EXPECT_FALSE(sceneContents(value).softTissue) << "at first";
  EXPECT_EQ(softTissueMissing(value), "");
  value.softTissue.shown = true;
  value.iso = 500.0; // of bone; Hounsfield units stay what they are
  const auto material = sceneContents(value).softTissue;
  ASSERT_TRUE(material);
  EXPECT_EQ(material->source, appearance::IntensitySource::Ct);
  EXPECT_DOUBLE_EQ(material->transfer.points().front().value, -700.0);
  EXPECT_EQ(softTissueMissing(value), "");
  value.denseBone = 2000.0; // not in Hounsfield units
  EXPECT_NE(sceneContents(value).softTissue->transfer.points().front().value, -700.0);
  value.softTissueValues = {-650.0, 60.0}; // its function begins where air ends
  const auto begun = sceneContents(value).softTissue;
  ASSERT_TRUE(begun);
  EXPECT_NEAR(begun->transfer.points().front().value, -650.0, 1e-6);
  EXPECT_FALSE(sceneContents(thumbnailCase(value)).softTissue) << "a face is recognised";
}

// As for each move of the mouse.
TEST(SceneAssembly, AFaceThroughSoftTissueReadsNoImage)
{
  scene::Case value = slabs();
  value.softTissue.shown = true;
  value.softTissue.relative = false;
  value.softTissue.transfer = appearance::TransferFunction(
      std::vector<appearance::ControlPoint>{{-500.0, {1, 1, 1}, 0.0F}, {0.0, {1, 1, 1}, 0.5F}});
  int reads = 0;
  value.ct.volume = core::Lazy<volume::IntensityVolume>(
      [&reads]
      {
        ++reads;
        return std::make_shared<const volume::IntensityVolume>(
            std::make_shared<const volume::Volume<std::int16_t>>(kGrid, std::int16_t{50}));
      });
  const Vector3d at = kGrid.center();
  EXPECT_FALSE(drawsSoftFace(value, at));
  EXPECT_EQ(reads, 0);
  const auto held = value.ct.volume.get();
  ASSERT_EQ(reads, 1);
  EXPECT_TRUE(drawsSoftFace(value, at));
  EXPECT_EQ(reads, 1);
}

TEST(SceneAssembly, SaysWhySoftTissueIsNotDrawn)
{
  scene::Case value = slabs();
  value.softTissue.shown = true;
  const auto expectMissing = [&value](const char* why)
  {
    EXPECT_FALSE(sceneContents(value).softTissue) << why;
    EXPECT_NE(softTissueMissing(value).find(why), std::string::npos) << softTissueMissing(value);
  };
  const auto usual = value.softTissue;
  value.softTissue.transfer.reset();
  expectMissing("fill air");
  value.softTissue.transfer = appearance::TransferFunction::constant({1, 1, 1}, 0.1F);
  expectMissing("fill air");
  value.softTissue = usual;
  value.softTissue.opacity = 0.0F;
  expectMissing("transparent");
  value.softTissue = usual;
  value.ct.modality = scene::Modality::Mr;
  expectMissing("values of the MR");
  value.ct.modality = scene::Modality::Ct;
  value.softTissue.sourceImage = "t1";
  expectMissing("values of 't1'");
  value.softTissue.relative = false;
  expectMissing("not registered");
}

TEST(SceneAssembly, DrawsTheMrOfSoftTissueUnlessTwoOthersAreDrawn)
{
  scene::Case value = slabs();
  bool t1 = false;
  bool t2 = false;
  bool t3 = false;
  value.mr = {mr("t1", true, t1), mr("t2", true, t2), mr("t3", true, t3)};
  value.softTissue.sourceImage = "t2";
  value.softTissue.relative = false;
  EXPECT_EQ(sceneContents(value).second.volume, nullptr) << "not shown";
  value.softTissue.shown = true;
  auto contents = sceneContents(value);
  EXPECT_TRUE(t2);
  EXPECT_FALSE(t1 || t3);
  EXPECT_NE(contents.second.volume, nullptr);
  EXPECT_EQ(contents.third.volume, nullptr);
  ASSERT_TRUE(contents.softTissue);
  EXPECT_EQ(contents.softTissue->source, appearance::IntensitySource::Second);

  for (const char* name : {"low", "high"})
    look(value, name).transfer = appearance::TransferFunction::constant({1, 1, 1}, 0.1F);
  look(value, "low").sourceImage = "t2"; // the same
  contents = sceneContents(value);
  ASSERT_TRUE(contents.softTissue);
  EXPECT_EQ(contents.softTissue->source, appearance::IntensitySource::Second);
  EXPECT_EQ(contents.third.volume, nullptr);
  look(value, "low").sourceImage = "t1"; // before it
  contents = sceneContents(value);
  ASSERT_TRUE(contents.softTissue);
  EXPECT_EQ(contents.softTissue->source, appearance::IntensitySource::Third);
  EXPECT_EQ(contents.second.volume, value.mr[0].volume.peek());
  EXPECT_EQ(contents.third.volume, value.mr[1].volume.peek());
  EXPECT_EQ(softTissueMissing(value), "");
  EXPECT_EQ(drawnMrs(value), (std::vector<std::string>{"t1", "t2"}));
  EXPECT_FALSE(t3);

  look(value, "high").sourceImage = "t3";
  EXPECT_FALSE(sceneContents(value).softTissue);
  EXPECT_NE(softTissueMissing(value).find("read 't1' and 't3'"), std::string::npos);
  EXPECT_EQ(drawnMrs(value), (std::vector<std::string>{"t1", "t3"}));
  look(value, "low").shown = false;
  EXPECT_TRUE(sceneContents(value).softTissue);
  EXPECT_EQ(softTissueMissing(value), "");
}

TEST(SceneAssembly, DrawsTwoMrsAndSaysWhichItDoesNot)
{
  scene::Case value = slabs();
  bool t1 = false;
  bool t2 = false;
  bool t3 = false;
  bool t4 = false;
  value.mr = {mr("t1", true, t1), mr("t2", true, t2), mr("t3", true, t3), mr("t4", true, t4)};
  value.mr[2].mrFromCt = {Eigen::Quaterniond::Identity(), {4.0, 5.0, 6.0}};
  const std::map<const char*, const char*> images{{"low", "t3"}, {"high", "t1"}, {"far", "t4"}};
  for (const auto& [name, image] : images)
  {
    look(value, name).transfer = appearance::TransferFunction::constant({1, 1, 1}, 0.1F);
    look(value, name).sourceImage = image;
  }
  const auto contents = sceneContents(value);
  EXPECT_EQ(contents.second.volume, value.mr[0].volume.peek());
  EXPECT_EQ(contents.third.volume, value.mr[2].volume.peek());
  EXPECT_EQ(contents.second.secondFromCt.translation(), Vector3d(1.0, 2.0, 3.0));
  EXPECT_EQ(contents.third.secondFromCt.translation(), Vector3d(4.0, 5.0, 6.0));
  EXPECT_EQ(contents.materials.at(1).source, appearance::IntensitySource::Third) << "low";
  EXPECT_EQ(contents.materials.at(2).source, appearance::IntensitySource::Second) << "high";
  EXPECT_EQ(contents.materials.at(3).source, appearance::IntensitySource::Ct) << "far";
  EXPECT_FALSE(contents.materials.at(3).transfer == *look(value, "far").transfer);
  EXPECT_TRUE(t1 && t3);
  EXPECT_FALSE(t2) << "nothing reads it";
  EXPECT_FALSE(t4) << "nothing shows it";
  EXPECT_EQ(drawnMrs(value), (std::vector<std::string>{"t1", "t3"}));
  EXPECT_NE(mrMissing(value, "t4").find("'t1' and 't3'"), std::string::npos);
  for (const char* drawn : {"t1", "t2", "t3", "none"})
    EXPECT_EQ(mrMissing(value, drawn), "") << drawn;
  // The user chooses by what is shown.
  look(value, "high").shown = false;
  EXPECT_EQ(mrMissing(value, "t4"), "");
  EXPECT_EQ(drawnMrs(value), (std::vector<std::string>{"t3", "t4"}));
}

TEST(SceneAssembly, ALumenTintsBone)
{
  scene::Case value = slabs();
  look(value, "low").solid = false;
  look(value, "low").opacity = 0.35F;
  value.boneLook.opacity = 0.7F;
  const auto contents = sceneContents(value);
  EXPECT_TRUE(contents.materials.back().lumen);
  EXPECT_EQ(contents.materials.back().surfaceOpacity, 0.7F);
}

TEST(SceneAssembly, RefusesMoreStructuresThanAnIndexHolds)
{
  scene::Case value = slabs();
  value.labels.resize(1);
  auto& structures = value.labels[0].structures;
  structures.resize(256, structures.front());
  EXPECT_THROW(sceneContents(value), core::InvalidParameter);
  structures.back().look.shown = false;
  EXPECT_EQ(sceneContents(value).materials.size(), 256u);
}
