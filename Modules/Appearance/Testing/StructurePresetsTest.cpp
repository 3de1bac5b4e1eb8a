#include <gtest/gtest.h>

#include "petrous/Appearance/StructurePresets.h"
#include "petrous/Core/Error.h"

using namespace petrous::appearance;

TEST(StructurePresets, KnowsTheStructuresOfTheTemporalBone)
{
  const auto presets = StructurePresets::builtIn();
  EXPECT_EQ(presets.lookFor("facial_nerve").preset, "nerve");
  EXPECT_EQ(presets.lookFor("Sigmoid Sinus").preset, "vein");
  EXPECT_EQ(presets.lookFor("lateral-semicircular-canal").preset, "inner-ear");
  EXPECT_EQ(presets.lookFor("Cholesteatoma").preset, "cholesteatoma");
  EXPECT_EQ(presets.lookFor("zebra").preset, "other");
  EXPECT_EQ(presets.lookFor("left sternocleidomastoideus muscle").preset, "muscle");
  EXPECT_EQ(presets.lookFor("maxillary_sinus").preset, "air-cells");
}

TEST(StructurePresets, TakesALumenForNoTissue)
{
  const auto presets = StructurePresets::builtIn();
  EXPECT_FALSE(presets.lookFor("external_auditory_canal").solid);
  EXPECT_FALSE(presets.lookFor("mastoid air cells").solid);
  EXPECT_TRUE(presets.lookFor("cochlea").solid);
}

TEST(StructurePresets, RefusesAColourOutOfRangeByName)
{
  try
  {
    StructurePresets(R"({"other":{"name":"odd","color":[2,0,0],"opacity":1,"solid":true},
                         "presets":[]})");
    FAIL() << "accepted";
  }
  catch (const petrous::core::InvalidParameter& error)
  {
    EXPECT_NE(std::string(error.what()).find("odd"), std::string::npos);
  }
}

TEST(StructureLook, FlagsGoThereAndBack)
{
  StructureLook look;
  for (const std::string flags : {"shown", "shown,drillable", "touchable", "none"})
  {
    setFlags(look, flags);
    EXPECT_EQ(flagsOf(look), flags);
  }
  EXPECT_THROW(setFlags(look, "shown,loud"), petrous::core::InvalidParameter);
  EXPECT_EQ(flagsOf(look), "none");
}
