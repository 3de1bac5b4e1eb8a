#include "petrous/Appearance/OwnPresets.h"

#include <cstdlib>
#include <fstream>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "petrous/Appearance/StructurePresets.h"
#include "petrous/Core/Error.h"

using namespace petrous;
using namespace petrous::appearance;

namespace
{

class OwnPresetsTest : public ::testing::Test
{
protected:
  void SetUp() override
  {
    std::string name = (std::filesystem::temp_directory_path() / "presets-XXXXXX").string();
    ASSERT_NE(mkdtemp(name.data()), nullptr);
    m_folder = name;
  }
  void TearDown() override { std::filesystem::remove_all(m_folder); }

  void writeFile(const std::string& text) const
  {
    std::ofstream(m_folder / "presets.json") << text;
  }
  std::string refusal() const
  {
    try
    {
      OwnPresets(m_folder).all();
    }
    catch (const core::InvalidParameter& error)
    {
      return error.what();
    }
    return {};
  }
  static StructureAppearance sinus()
  {
    StructureAppearance look;
    look.preset = "vein";
    look.color = {0.25F, 0.5F, 0.75F};
    look.opacity = 0.5F;
    look.transfer = TransferFunction(
        {{-50.0, {0.25F, 0.5F, 0.75F}, 0.125F, 0.5F}, {250.0, {0.5F, 0.75F, 1.0F}, 0.5F, 1.0F}});
    look.shininess = 40.0F;
    look.priority = 12;
    look.shown = false;
    look.sourceImage = "t2";
    return look;
  }

  std::filesystem::path m_folder;
};

} // namespace

TEST_F(OwnPresetsTest, AFolderWithoutThemHasNone)
{
  EXPECT_TRUE(OwnPresets(m_folder).all().empty());
  EXPECT_TRUE(OwnPresets(m_folder / "not there").all().empty());
  EXPECT_EQ(OwnPresets(m_folder).preset("nerve").preset, "nerve");
}

TEST_F(OwnPresetsTest, GiveBackWhatWasSavedWithoutFlagsAndImage)
{
  const OwnPresets presets(m_folder);
  presets.save(sinus(), "our sinus");
  const auto saved = OwnPresets(m_folder).preset("our sinus");
  EXPECT_EQ(saved.preset, "our sinus");
  EXPECT_EQ(saved.color, sinus().color);
  EXPECT_EQ(saved.opacity, 0.5F);
  ASSERT_TRUE(saved.transfer);
  EXPECT_TRUE(*saved.transfer == *sinus().transfer);
  EXPECT_FALSE(saved.relative);
  EXPECT_EQ(saved.shininess, 40.0F);
  EXPECT_EQ(saved.priority, 12);
  EXPECT_EQ(saved.sourceImage, OwnPresets::kOfMr) << "which one is not said";
  const auto entry =
      nlohmann::json::parse(std::ifstream(m_folder / "presets.json")).at("presets").at(0);
  EXPECT_EQ(entry.at("name"), "our sinus");
  EXPECT_EQ(entry.at("transfer").at("points").at(1).at("value"), 250.0);
  EXPECT_FALSE(entry.contains("flags"));
  EXPECT_FALSE(entry.contains("source_image"));
}

TEST_F(OwnPresetsTest, SayWhoseValuesTheyHave)
{
  const OwnPresets presets(m_folder);
  const auto valuesOf = [&](const StructureAppearance& look, bool isPrimaryMr)
  {
    presets.save(look, "one", isPrimaryMr);
    return OwnPresets(m_folder).preset("one").sourceImage;
  };
  StructureAppearance look = sinus();
  EXPECT_EQ(valuesOf(look, false), "mr");
  look.solid = false;
  EXPECT_EQ(valuesOf(look, false), "ct") << "a lumen reads the bone around it";
  look.solid = true;
  look.sourceImage.clear();
  EXPECT_EQ(valuesOf(look, false), "ct");
  EXPECT_EQ(valuesOf(look, true), "mr");
  look.relative = true;
  EXPECT_EQ(valuesOf(look, true), "") << "mapped to where bone lies";
  look.transfer.reset();
  EXPECT_EQ(valuesOf(look, true), "");
  // One that an earlier version saved.
  writeFile(R"({"presets": [{"name": "old", "color": [1, 0, 0], "opacity": 1, "solid": true}]})");
  EXPECT_EQ(OwnPresets(m_folder).preset("old").sourceImage, "") << refusal();
  writeFile(
      R"({"presets": [{"name": "x", "color": [1, 0, 0], "opacity": 1, "solid": true,
      "values_of": "pet"}]})");
  EXPECT_NE(refusal().find("values_of"), std::string::npos) << refusal();
}

TEST_F(OwnPresetsTest, AreListedByNameReplacedAndRemoved)
{
  const OwnPresets presets(m_folder);
  presets.save(sinus(), "zygoma");
  presets.save(sinus(), "antrum");
  StructureAppearance other = sinus();
  other.opacity = 0.25F;
  presets.save(other, "zygoma");
  ASSERT_EQ(presets.all().size(), 2u);
  EXPECT_EQ(presets.all()[0].preset, "antrum");
  EXPECT_EQ(presets.all()[1].opacity, 0.25F);
  presets.remove("antrum");
  ASSERT_EQ(presets.all().size(), 1u);
  EXPECT_THROW(presets.remove("antrum"), core::InvalidParameter);
  EXPECT_THROW(presets.remove("nerve"), core::InvalidParameter);
}

TEST_F(OwnPresetsTest, RefuseNamesThatAreTakenOrCannotBeRead)
{
  const OwnPresets presets(m_folder);
  for (const char* name : {"", "bone", "other", " sinus", "sinus ", "a\nb", "\xff"})
    EXPECT_THROW(presets.save(sinus(), name), core::InvalidParameter) << name;
  EXPECT_THROW(presets.save(sinus(), std::string(61, 'a')), core::InvalidParameter);
  EXPECT_FALSE(std::filesystem::exists(m_folder / "presets.json"));
}

// An earlier version had no built-in preset of that name.
TEST_F(OwnPresetsTest, OneWhoseNameIsBuiltInByNowIsReadAndCanBeRemoved)
{
  const OwnPresets presets(m_folder);
  presets.save(sinus(), "veil");
  std::ifstream in(m_folder / "presets.json");
  std::string text((std::istreambuf_iterator<char>(in)), std::istreambuf_iterator<char>());
  in.close();
  const std::size_t at = text.find("veil");
  ASSERT_NE(at, std::string::npos);
  writeFile(text.replace(at, 4, "skin"));
  ASSERT_EQ(presets.all().size(), 1u);
  EXPECT_EQ(presets.preset("skin").color, sinus().color);
  EXPECT_NO_THROW(presets.save(sinus(), "antrum"));
  presets.remove("skin");
  EXPECT_EQ(presets.all().size(), 1u);
  EXPECT_THROW(presets.remove("skin"), core::InvalidParameter);
}

TEST_F(OwnPresetsTest, AreFoundBeforeTheWordsOfTheCatalogueAndListedWithIt)
{
  const OwnPresets presets(m_folder);
  EXPECT_EQ(presets.preset("vessel").preset, "artery");
  presets.save(sinus(), "vessel");
  EXPECT_EQ(presets.preset("vessel").preset, "vessel");
  try
  {
    presets.preset("xyzzy");
    ADD_FAILURE();
  }
  catch (const core::InvalidParameter& error)
  {
    EXPECT_NE(std::string(error.what()).find("nerve"), std::string::npos) << error.what();
    EXPECT_NE(std::string(error.what()).find("vessel"), std::string::npos) << error.what();
    EXPECT_NE(std::string(error.what()).find("ear-canal"), std::string::npos) << error.what();
  }
  try
  {
    presets.preset("xyzzy", [](const StructureAppearance& preset) { return preset.solid; });
    ADD_FAILURE();
  }
  catch (const core::InvalidParameter& error)
  {
    EXPECT_NE(std::string(error.what()).find("vessel"), std::string::npos) << error.what();
    EXPECT_EQ(std::string(error.what()).find("ear-canal"), std::string::npos) << error.what();
  }
}

TEST_F(OwnPresetsTest, ADamagedFileIsNamedAndLeftAsItIs)
{
  writeFile("{\"presets\": [{\"name\": \"mine\", \"secret\": ");
  EXPECT_NE(refusal().find("presets.json: "), std::string::npos) << refusal();
  EXPECT_EQ(refusal().find("secret"), std::string::npos) << refusal();
  EXPECT_THROW(OwnPresets(m_folder).save(sinus(), "sinus"), core::InvalidParameter);
  writeFile(R"({"presets": [{"name": "mine", "color": [2, 0, 0], "opacity": 1, "solid": true}]})");
  EXPECT_NE(refusal().find("presets.json: structure preset 'mine': color"), std::string::npos)
      << refusal();
}
