#include <gtest/gtest.h>

#include <filesystem>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include <unistd.h>

#include "petrous/Presenters/AppearanceEditor.h"
#include "petrous/Presenters/StructureList.h"

using namespace petrous;
using namespace petrous::presenters;

namespace
{

class StructureListTest : public ::testing::Test
{
protected:
  StructureListTest()
    : folder(std::filesystem::temp_directory_path() /
             ("petrous-list-" + std::to_string(::getpid()) + "-" +
              ::testing::UnitTest::GetInstance()->current_test_info()->name()))
    , model(library::Library(folder))
  {
  }
  ~StructureListTest() override { std::filesystem::remove_all(folder); }

  // Structures by name and preset, and a mesh.
  void open(const std::vector<std::pair<std::string, std::string>>& structures,
            const std::string& mesh = {})
  {
    scene::Case value;
    value.name = "ear";
    value.ct.name = "ct";
    value.ct.geometry =
        core::GridGeometry({8, 8, 8}, Eigen::Vector3d::Ones(), Eigen::Vector3d::Zero());
    value.ct.volume = std::make_shared<const volume::IntensityVolume>(
        std::make_shared<const volume::Volume<std::int16_t>>(value.ct.geometry));
    scene::LabelPart part;
    const auto presets = appearance::StructurePresets::builtIn();
    std::uint16_t index = 0;
    for (const auto& [name, preset] : structures)
    {
      scene::StructurePart structure;
      structure.name = name;
      structure.index = ++index;
      structure.look = presets.preset(preset);
      part.structures.push_back(structure);
    }
    volume::LabelMap map;
    map.voxels = std::make_shared<const volume::Volume<std::uint16_t>>(value.ct.geometry);
    part.labels = std::make_shared<const volume::LabelMap>(std::move(map));
    part.drawnOn = "";
    value.labels = {part};
    if (!mesh.empty())
    {
      scene::MeshPart surface;
      surface.name = mesh;
      surface.mesh = std::make_shared<const core::TriangleMesh>();
      value.meshes = {surface};
    }
    model.adopt(std::move(value));
  }
  std::map<std::string, bool> shown() const
  {
    std::map<std::string, bool> result;
    for (const StructureRow& row : structureRows(model.value()))
      result[row.part] = row.look.shown;
    return result;
  }
  void setShown(const std::string& part, bool isShown)
  {
    changeLooks(model, {part},
                [isShown](const std::string&, appearance::StructureAppearance& look)
                { look.shown = isShown; });
  }

  std::filesystem::path folder;
  WorkstationModel model;
};

} // namespace

TEST_F(StructureListTest, HasBoneAndSoftTissueFirstAndThenTheKinds)
{
  open({{"masseter", "muscle"},
        {"antrum", "air-cells"},
        {"sigmoid sinus", "vein"},
        {"facial nerve", "nerve"},
        {"carotid", "artery"},
        {"stapes", "ossicle"},
        {"dura", "dura"},
        {"cochlea", "inner-ear"}},
       "implant");
  std::vector<std::string> parts;
  std::vector<StructureKind> kinds;
  for (const StructureRow& row : structureRows(model.value()))
  {
    parts.push_back(row.part);
    kinds.push_back(row.kind);
  }
  EXPECT_EQ(parts, (std::vector<std::string>{"ct", scene::kSoftTissue, "facial nerve",
                                             "sigmoid sinus", "carotid", "stapes", "cochlea",
                                             "dura", "antrum", "masseter", "implant"}));
  using Kind = StructureKind;
  EXPECT_EQ(kinds, (std::vector<Kind>{Kind::Bone, Kind::SoftTissue, Kind::Nerve, Kind::Vessel,
                                      Kind::Vessel, Kind::Ossicle, Kind::InnerEar, Kind::Dura,
                                      Kind::Lumen, Kind::Other, Kind::Mesh}));
}

TEST_F(StructureListTest, ShowsOneAloneAndAgainWhatWasShownBefore)
{
  open({{"a", "nerve"}, {"b", "vein"}, {"c", "other"}}, "implant");
  setShown("b", false);
  const auto before = shown();
  OnlyThese only(model);
  EXPECT_FALSE(only.isOn({"c"}));
  only.toggle({"c"});
  EXPECT_EQ(shown(), (std::map<std::string, bool>{{"ct", true},
                                                  {scene::kSoftTissue, false},
                                                  {"a", false},
                                                  {"b", false},
                                                  {"c", true},
                                                  {"implant", false}}));
  EXPECT_TRUE(only.isOn({"c"}));
  EXPECT_FALSE(only.isOn({"a"}));
  EXPECT_EQ(model.undoText(), "only c");
  only.toggle({"b", "a"}); // in its place
  EXPECT_TRUE(shown().at("a"));
  EXPECT_FALSE(shown().at("c"));
  only.toggle({"a", "b"});
  EXPECT_EQ(shown(), before);
}

TEST_F(StructureListTest, WhatTheUserDidSinceIsNotOverwritten)
{
  open({{"a", "nerve"}, {"b", "vein"}, {"c", "other"}});
  OnlyThese only(model);
  only.toggle({"a"});
  setShown("b", true);
  EXPECT_FALSE(only.isOn({"a"}));
  only.toggle({"c"});
  only.toggle({"c"});
  EXPECT_EQ(
      shown(),
      (std::map<std::string, bool>{
          {"ct", true}, {scene::kSoftTissue, false}, {"a", true}, {"b", true}, {"c", false}}));
}

TEST_F(StructureListTest, SoftTissueThatIsShownIsHiddenByOthersAlone)
{
  open({{"a", "nerve"}});
  setShown(scene::kSoftTissue, true);
  OnlyThese only(model);
  only.toggle({"a"});
  EXPECT_FALSE(shown().at(scene::kSoftTissue)) << "it would veil what is shown alone";
  only.toggle({"a"});
  EXPECT_TRUE(shown().at(scene::kSoftTissue));
  only.toggle({scene::kSoftTissue});
  EXPECT_EQ(model.undoText(), "only soft tissue");
  EXPECT_TRUE(shown().at("ct"));
  EXPECT_FALSE(shown().at("a"));
}

TEST_F(StructureListTest, OnlyThisIsOneStep)
{
  std::vector<std::pair<std::string, std::string>> many;
  for (int n = 0; n < 60; ++n)
    many.emplace_back("s" + std::to_string(n), "other");
  open(many);
  const auto before = shown();
  OnlyThese only(model);
  only.toggle({"s33"});
  for (const auto& [part, isShown] : shown())
    EXPECT_EQ(isShown, part == "s33" || part == "ct") << part;
  model.undo();
  EXPECT_EQ(shown(), before);
  EXPECT_FALSE(only.isOn({"s33"}));
}

TEST_F(StructureListTest, APresetKeepsFlagsAndBoneTakesNoLumen)
{
  open({{"a", "other"}, {"b", "other"}});
  const auto preset = [](const char* name)
  { return appearance::StructurePresets::builtIn().preset(name); };
  auto look = *model.lookOf("a");
  look.shown = false;
  model.setLooks({{"a", look}});
  const auto nerve = withPreset(model.value(), "a", preset("nerve"));
  EXPECT_EQ(nerve.preset, "nerve");
  EXPECT_FALSE(nerve.shown);
  EXPECT_GT(nerve.warning, 0.0);
  for (const char* single : {"ct", scene::kSoftTissue})
    EXPECT_THROW(withPreset(model.value(), single, preset("air-cells")), core::InvalidParameter);
  const auto muscle = withPreset(model.value(), scene::kSoftTissue, preset("muscle"));
  EXPECT_EQ(muscle.preset, "muscle");
  EXPECT_EQ(muscle.tissue, "") << "air to the drill";
  const auto other = withPreset(model.value(), "a", preset("other"));
  EXPECT_NE(other.color, model.lookOf("b")->color) << "no other has it";
}
