#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

#include <gtest/gtest.h>

#include <unistd.h>

#include "petrous/Core/Error.h"
#include "petrous/Presenters/CatalogueEditor.h"

using namespace petrous;
using namespace petrous::presenters;

namespace
{

class CatalogueEditorTest : public ::testing::Test
{
protected:
  void SetUp() override { std::filesystem::create_directories(folder); }
  void TearDown() override { std::filesystem::remove_all(folder); }

  bool hasFile(const char* name) const { return std::filesystem::exists(folder / name); }

  std::string text(const char* name) const
  {
    std::ifstream in(folder / name);
    return {std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
  }

  std::filesystem::path folder =
      std::filesystem::temp_directory_path() / ("petrous-catalogues-" + std::to_string(::getpid()));
};

} // namespace

TEST_F(CatalogueEditorTest, BeginsWithTheProgramsOwnInTheirUnits)
{
  const CatalogueEditor editor(folder);
  ASSERT_FALSE(editor.materials().empty());
  EXPECT_EQ(editor.materials()[0].name, "cortical-bone");
  EXPECT_DOUBLE_EQ(editor.materials()[0].specificEnergy, 3.0);
  EXPECT_DOUBLE_EQ(editor.materials()[0].hardness, 42.5);
  EXPECT_FALSE(editor.materials()[0].source.empty());
  ASSERT_EQ(editor.burrs().size(), dissection::BurrCatalogue::builtIn().all().size());
  EXPECT_DOUBLE_EQ(editor.burrs()[0].constant, -10.0);
  EXPECT_DOUBLE_EQ(editor.burrs()[1].constant, 0.1);
  EXPECT_FALSE(editor.changed());
}

TEST_F(CatalogueEditorTest, SavesWhatTheRemovalLawsThenRead)
{
  CatalogueEditor editor(folder);
  const std::size_t row = editor.addMaterial(0);
  EXPECT_EQ(editor.materials()[row].name, "cortical-bone-2");
  CatalogueEditor::Material own = editor.materials()[row];
  own.name = "sclerotic-bone";
  own.title = "Sclerotic bone";
  own.hardness = 60.0;
  editor.setMaterial(row, own);
  CatalogueEditor::Burr diamond = editor.burrs()[1];
  diamond.constant = 0.15;
  diamond.diameters = {2.3, 0.6, 2.3};
  editor.setBurr(1, diamond);
  EXPECT_TRUE(editor.changed());
  editor.save();
  EXPECT_FALSE(editor.changed());

  const auto read = dissection::Catalogues::in(folder);
  EXPECT_NEAR(read.materials.material("sclerotic-bone").hardness, 60.0 * 9.807e6, 1.0);
  const auto& model = read.burrs.model(dissection::Burr::Kind::Diamond);
  EXPECT_DOUBLE_EQ(model.wearCoefficient, 0.15);
  EXPECT_EQ(model.diameters, (std::vector<double>{0.6, 2.3}));
}

TEST_F(CatalogueEditorTest, WhatIsAddedHasTheNumbersOfARowAndNotItsSource)
{
  CatalogueEditor editor(folder);
  const std::size_t row = editor.addMaterial(0);
  EXPECT_DOUBLE_EQ(editor.materials()[row].hardness, editor.materials()[0].hardness);
  EXPECT_EQ(editor.materials()[row].source, "");
  EXPECT_EQ(editor.materials()[row].title, "cortical-bone-2") << "it is not called as the other";
  const std::size_t burr = editor.addBurr(1);
  EXPECT_DOUBLE_EQ(editor.burrs()[burr].constant, editor.burrs()[1].constant);
  EXPECT_EQ(editor.burrs()[burr].source, "");
  EXPECT_EQ(editor.materials()[row].certainty, "");
  EXPECT_EQ(editor.burrs()[burr].certainty, "");
  editor.save();
  const CatalogueEditor again(folder);
  EXPECT_EQ(again.materials()[row].source, "");
  EXPECT_EQ(again.burrs()[burr].source, "");
  EXPECT_FALSE(again.materials()[0].source.empty());
}

TEST_F(CatalogueEditorTest, ANumberThatIsTypedOverHasNotTheSourceOfTheOneBefore)
{
  CatalogueEditor editor(folder);
  const CatalogueEditor::Material bone = editor.materials()[0];
  ASSERT_FALSE(bone.source.empty());
  ASSERT_FALSE(bone.certainty.empty());
  CatalogueEditor::Material named = bone;
  named.title = "Hard bone"; // no number
  editor.setMaterial(0, named);
  EXPECT_EQ(editor.materials()[0].source, bone.source);
  EXPECT_EQ(editor.materials()[0].certainty, bone.certainty);
  for (double CatalogueEditor::Material::*number :
       {&CatalogueEditor::Material::specificEnergy, &CatalogueEditor::Material::friction,
        &CatalogueEditor::Material::hardness})
  {
    CatalogueEditor::Material other = bone;
    other.*number *= 1.01;
    CatalogueEditor again(folder);
    again.setMaterial(0, other);
    EXPECT_EQ(again.materials()[0].source, "");
    EXPECT_EQ(again.materials()[0].certainty, "");
  }
  CatalogueEditor::Material measured = bone;
  measured.hardness = 45.0;
  measured.source = "our own indenter"; // with the number: of it
  editor.setMaterial(0, measured);
  EXPECT_EQ(editor.materials()[0].source, "our own indenter");
  EXPECT_EQ(editor.materials()[0].certainty, "");

  const CatalogueEditor::Burr diamond = editor.burrs()[1];
  ASSERT_FALSE(diamond.source.empty());
  ASSERT_FALSE(diamond.certainty.empty());
  CatalogueEditor::Burr sized = diamond;
  sized.diameters = {0.6, 2.3};
  editor.setBurr(1, sized);
  EXPECT_EQ(editor.burrs()[1].source, diamond.source) << "that is of its wear";
  EXPECT_EQ(editor.burrs()[1].certainty, diamond.certainty);
  for (double CatalogueEditor::Burr::*number :
       {&CatalogueEditor::Burr::constant, &CatalogueEditor::Burr::grit})
  {
    CatalogueEditor::Burr other = diamond;
    other.*number += 0.01;
    CatalogueEditor again(folder);
    again.setBurr(1, other);
    EXPECT_EQ(again.burrs()[1].source, "");
    EXPECT_EQ(again.burrs()[1].certainty, "");
  }
}

TEST_F(CatalogueEditorTest, RefusesWhatTheLawsDoNotAllowAndStaysAsItWas)
{
  CatalogueEditor editor(folder);
  CatalogueEditor::Material bone = editor.materials()[0];
  bone.hardness = -1.0;
  EXPECT_THROW(editor.setMaterial(0, bone), core::InvalidParameter);
  bone = editor.materials()[0];
  bone.name = "other";
  EXPECT_THROW(editor.setMaterial(0, bone), core::InvalidParameter) << "presets give it";
  EXPECT_THROW(editor.removeMaterial(0), core::InvalidParameter);
  CatalogueEditor::Burr cutting = editor.burrs()[0];
  cutting.constant = 60.0; // degrees: the chip would not slide
  EXPECT_THROW(editor.setBurr(0, cutting), core::InvalidParameter);
  cutting = editor.burrs()[0];
  cutting.diameters.clear();
  EXPECT_THROW(editor.setBurr(0, cutting), core::InvalidParameter);
  const std::size_t row = editor.addMaterial(0);
  CatalogueEditor::Material own = editor.materials()[row];
  own.name = "With Capitals";
  EXPECT_THROW(editor.setMaterial(row, own), core::InvalidParameter);
  own.name = "nerve";
  EXPECT_THROW(editor.setMaterial(row, own), core::InvalidParameter) << "taken";
  editor.removeMaterial(row);
  EXPECT_FALSE(editor.changed());
}

TEST_F(CatalogueEditorTest, RefusesANumberWithItsRangeInTheUnitOfTheTable)
{
  CatalogueEditor editor(folder);
  const auto refusal = [](const auto& change)
  {
    try
    {
      change();
    }
    catch (const core::InvalidParameter& error)
    {
      return std::string(error.what());
    }
    return std::string("taken");
  };
  const auto ofMaterial = [&](double CatalogueEditor::Material::*field, double value)
  {
    auto one = editor.materials()[0];
    one.*field = value;
    return refusal([&] { editor.setMaterial(0, one); });
  };
  using Material = CatalogueEditor::Material;
  EXPECT_EQ(ofMaterial(&Material::specificEnergy, -3.0), "must lie above 0 GPa, it is -3");
  EXPECT_EQ(ofMaterial(&Material::hardness, 0.0), "must lie above 0 HV, it is 0");
  EXPECT_EQ(ofMaterial(&Material::friction, 2.5), "must lie above 0 and at most at 2, it is 2.5");
  const auto ofBurr = [&](std::size_t row, double value)
  {
    auto one = editor.burrs()[row];
    one.constant = value;
    return refusal([&] { editor.setBurr(row, one); });
  };
  EXPECT_EQ(ofBurr(0, 70.0), "must lie within -60 to 60 degrees, it is 70");
  EXPECT_EQ(ofBurr(1, 1.5), "must lie above 0 and at most at 1, it is 1.5");
  // Of no single number; no file is named, as there is none yet.
  EXPECT_EQ(ofBurr(0, 60.0).find(".json"), std::string::npos) << ofBurr(0, 60.0);
  EXPECT_NE(ofBurr(0, 60.0), "taken");
}

TEST_F(CatalogueEditorTest, HasBurrsOfTheUsersOwnBesideTheUsualOnes)
{
  CatalogueEditor editor(folder);
  const std::size_t row = editor.addBurr(1);
  EXPECT_EQ(editor.burrs()[row].name, "diamond-2");
  EXPECT_EQ(editor.burrs()[row].kind, dissection::Burr::Kind::Diamond);
  EXPECT_FALSE(editor.isUsualBurr(row));
  CatalogueEditor::Burr own = editor.burrs()[row];
  own.name = "coarse-diamond";
  own.constant = 0.2;
  own.diameters = {5.0, 3.0};
  editor.setBurr(row, own);
  const auto refused = [&](CatalogueEditor::Burr one, const char* name)
  {
    one.name = name;
    EXPECT_THROW(editor.setBurr(row, one), core::InvalidParameter) << name;
  };
  for (const char* name : {"", "Coarse", "cutting", "diamond"})
    refused(own, name);
  own.constant = 1.5;
  refused(own, "coarse-diamond");
  CatalogueEditor::Burr usual = editor.burrs()[0];
  usual.name = "other";
  EXPECT_THROW(editor.setBurr(0, usual), core::InvalidParameter) << "cases name it by its kind";
  EXPECT_THROW(editor.removeBurr(1), core::InvalidParameter);
  editor.save();

  const auto burrs = dissection::Catalogues::in(folder).burrs;
  ASSERT_EQ(burrs.all().size(), dissection::BurrCatalogue::builtIn().all().size() + 1);
  EXPECT_DOUBLE_EQ(burrs.model("coarse-diamond").wearCoefficient, 0.2);
  EXPECT_EQ(burrs.model("coarse-diamond").diameters, (std::vector<double>{3.0, 5.0}));
  EXPECT_DOUBLE_EQ(burrs.model("diamond").wearCoefficient, 0.1);
  editor.removeBurr(row);
  editor.save();
  EXPECT_FALSE(hasFile("burrs.json"));
}

TEST_F(CatalogueEditorTest, TheProgramsOwnNeedsNoFile)
{
  CatalogueEditor editor(folder);
  editor.addMaterial(0);
  editor.save();
  EXPECT_TRUE(hasFile("materials.json"));
  EXPECT_FALSE(hasFile("burrs.json"));
  editor.setBuiltIn();
  EXPECT_TRUE(editor.changed());
  editor.save();
  EXPECT_FALSE(hasFile("materials.json"));
}

TEST_F(CatalogueEditorTest, AFileWhoseTableHasNotChangedStaysAsItWasWritten)
{
  const std::string byHand = R"({"comment": "ours", "burrs": [
    {"kind": "diamond", "wear_coefficient": 0.2, "diameters_mm": [1]},
    {"kind": "cutting", "rake_deg": -5, "diameters_mm": [2, 3]}]})";
  std::ofstream(folder / "burrs.json") << byHand;
  CatalogueEditor editor(folder);
  editor.addMaterial(0);
  editor.save();
  EXPECT_TRUE(hasFile("materials.json"));
  EXPECT_EQ(text("burrs.json"), byHand);
  CatalogueEditor::Burr diamond = editor.burrs()[1];
  diamond.constant = 0.15;
  editor.setBurr(1, diamond);
  editor.save();
  EXPECT_NE(text("burrs.json"), byHand);
}

// Tables as they were written before burrs had a grit and numbers a certainty of their own.
TEST_F(CatalogueEditorTest, ReadsTablesOfAnEarlierVersion)
{
  std::ofstream(folder / "burrs.json") << R"({"burrs": [
    {"name": "cutting", "kind": "cutting", "rake_deg": -12, "diameters_mm": [2], "status": "ours"},
    {"name": "diamond", "kind": "diamond", "wear_coefficient": 0.15, "diameters_mm": [1],
     "status": "ours"}]})";
  std::ofstream(folder / "materials.json") << R"({"materials": [
    {"name": "cortical-bone", "title": "Bone", "specific_cutting_energy_gpa": 2.5, "friction": 0.5,
     "vickers_hardness_hv": 40, "status": "ours"}],
    "bone": {"cellular": "cortical-bone", "cortical": "cortical-bone", "from_hu": 300,
             "to_hu": 1800}})";
  CatalogueEditor editor(folder);
  ASSERT_EQ(editor.burrs().size(), 2u) << "that table has no others";
  EXPECT_DOUBLE_EQ(editor.burrs()[1].constant, 0.15);
  EXPECT_DOUBLE_EQ(editor.burrs()[1].grit, 0.0);
  EXPECT_EQ(editor.burrs()[1].certainty, "");
  EXPECT_EQ(editor.burrs()[1].source, "ours");
  EXPECT_EQ(editor.materials()[0].certainty, "");
  EXPECT_EQ(editor.materials()[0].source, "ours");
  CatalogueEditor::Burr diamond = editor.burrs()[1];
  diamond.grit = 91.0;
  diamond.certainty = "assumption";
  editor.setBurr(1, diamond);
  editor.save();
  const CatalogueEditor again(folder);
  EXPECT_DOUBLE_EQ(again.burrs()[1].grit, 91.0);
  EXPECT_EQ(again.burrs()[1].certainty, "assumption");
  EXPECT_EQ(again.burrs()[0].source, "ours");
}

TEST_F(CatalogueEditorTest, BeginsWithTheBuiltInTableInPlaceOfABrokenFile)
{
  std::ofstream(folder / "burrs.json") << R"({"burrs": [
    {"kind": "diamond", "wear_coefficient": 0.2, "diameters_mm": [1]},
    {"kind": "cutting", "rake_deg": -5, "diameters_mm": [2, 3]}]})";
  const std::string burrs = text("burrs.json");
  std::ofstream(folder / "materials.json") << "{";
  auto editor = CatalogueEditor::repairing(folder);
  EXPECT_EQ(editor.materials()[0].name, "cortical-bone");
  EXPECT_DOUBLE_EQ(editor.burrs()[1].constant, 0.2) << "which can be understood";
  EXPECT_TRUE(editor.changed());
  editor.save();
  EXPECT_FALSE(editor.changed());
  EXPECT_FALSE(hasFile("materials.json"));
  EXPECT_EQ(text("burrs.json"), burrs);

  CatalogueEditor own(folder);
  own.addMaterial(0);
  own.save();
  const std::string materials = text("materials.json");
  std::ofstream(folder / "burrs.json") << "{";
  auto second = CatalogueEditor::repairing(folder);
  EXPECT_EQ(second.materials().size(), own.materials().size());
  second.save();
  EXPECT_FALSE(hasFile("burrs.json"));
  EXPECT_EQ(text("materials.json"), materials);

  for (const char* name : {"materials.json", "burrs.json"})
    std::ofstream(folder / name) << "{";
  auto both = CatalogueEditor::repairing(folder);
  both.save();
  EXPECT_FALSE(hasFile("materials.json") || hasFile("burrs.json"));
}

TEST_F(CatalogueEditorTest, KnowsWhichMaterialsCasesWouldMiss)
{
  CatalogueEditor editor(folder);
  const std::size_t row = editor.addMaterial(0);
  CatalogueEditor::Material own = editor.materials()[row];
  own.name = "first";
  editor.setMaterial(row, own);
  EXPECT_TRUE(editor.lostMaterials().empty()) << "no case has had it";
  editor.save();
  own.name = "second";
  editor.setMaterial(row, own);
  EXPECT_EQ(editor.lostMaterials(), std::vector<std::string>{"first"});
  own.name = "first";
  editor.setMaterial(row, own);
  EXPECT_TRUE(editor.lostMaterials().empty());
  editor.removeMaterial(row);
  EXPECT_EQ(editor.lostMaterials(), std::vector<std::string>{"first"});
  editor.save();
  EXPECT_TRUE(editor.lostMaterials().empty());
}

TEST_F(CatalogueEditorTest, KnowsWhichBurrsCasesWouldMiss)
{
  CatalogueEditor editor(folder);
  const std::size_t row = editor.addBurr(1);
  const std::string name = editor.burrs()[row].name;
  editor.removeBurr(row);
  EXPECT_TRUE(editor.lostBurrs().empty()) << "no case has had it";
  editor.addBurr(1);
  editor.save();
  EXPECT_TRUE(editor.lostBurrs().empty());
  editor.removeBurr(row);
  EXPECT_EQ(editor.lostBurrs(), std::vector<std::string>{name});
  editor.save();
  EXPECT_TRUE(editor.lostBurrs().empty());
}

TEST_F(CatalogueEditorTest, NamesTheFileThatCannotBeUnderstood)
{
  std::ofstream(folder / "materials.json") << "{";
  try
  {
    const CatalogueEditor editor(folder);
    ADD_FAILURE() << "was read";
  }
  catch (const core::InvalidParameter& error)
  {
    EXPECT_NE(std::string(error.what()).find("materials.json"), std::string::npos) << error.what();
  }
}

TEST(Diameters, AreWrittenAndReadAsAList)
{
  EXPECT_EQ(diametersText({1.0, 2.3, 4.0}), "1, 2.3, 4");
  EXPECT_EQ(diametersFrom("1, 2.3;4"), (std::vector<double>{1.0, 2.3, 4.0}));
  EXPECT_EQ(diametersFrom("2,3"), (std::vector<double>{2.3})) << "a decimal comma";
  EXPECT_EQ(diametersFrom("2, 3"), (std::vector<double>{2.0, 3.0}));
  EXPECT_EQ(diametersFrom("2,3, 4,5,"), (std::vector<double>{2.3, 4.5}));
  EXPECT_EQ(diametersFrom("0,6; 1"), (std::vector<double>{0.6, 1.0}));
  EXPECT_EQ(diametersFrom("0,6;1,5"), (std::vector<double>{0.6, 1.5}));
  EXPECT_EQ(diametersFrom("1 2"), (std::vector<double>{1.0, 2.0}));
  for (const char* wrong : {"", "0", "11", "1, x", "1,2,3", ",", ", "})
    EXPECT_THROW(diametersFrom(wrong), core::InvalidParameter) << wrong;
}
