#include <gtest/gtest.h>

#include "DrilledCase.h"
#include "MaskComparison.h"
#include "petrous/Appearance/StructureProperties.h"
#include "petrous/Scene/Branches.h"
#include "petrous/Scene/FreeName.h"
#include "petrous/Scene/PlainText.h"

using namespace petrous;
using scene::test::drilledCase;

namespace
{

scene::LabelPart labelsNamed(std::vector<std::string> names)
{
  scene::LabelPart part;
  std::uint16_t index = 1;
  for (auto& name : names)
  {
    scene::StructurePart s;
    s.name = std::move(name);
    s.index = index++;
    part.structures.push_back(std::move(s));
  }
  return part;
}

} // namespace

TEST(Case, NamesThatReadTheSameAreOne)
{
  // Unicode's CaseFolding.txt: 00C4; C; 00E4. 03A3; C; 03C3. 03C2; C; 03C3. 00DF; F; 0073 0073.
  EXPECT_EQ(scene::caseFolded("\u00c4RZTE"), "\u00e4rzte");
  EXPECT_EQ(scene::caseFolded("\u03a3"), scene::caseFolded("\u03c2"));
  EXPECT_EQ(scene::caseFolded("\u00df"), "ss");
  EXPECT_EQ(scene::caseFolded("a_B"), "a_b");
  EXPECT_EQ(scene::asRead(" Facial__Nerve "), "facial nerve");
  // As macOS writes the names of files, in letters and marks apart (Unicode TR15).
  EXPECT_EQ(scene::caseFolded("Mu\u0308ller"), "m\u00fcller");
  EXPECT_EQ(scene::caseFolded("\u1e9e"), "ss");
  EXPECT_EQ(scene::caseFolded("\u01c4"), scene::caseFolded("\u01c5"));
  EXPECT_EQ(scene::caseFolded("\xff\xfeX"), "\xff\xfex") << "no UTF-8";
  for (const char* blank : {"\u00a0", "\u2009", "\u202f", "\u3000", "\t", "_ ", "\u00a0 _"})
    EXPECT_EQ(scene::asRead("Facial" + std::string(blank) + "nerve\u00a0"), "facial nerve");
  EXPECT_EQ(scene::asRead("Fa\u00adcial\u200b nerve"), "facial nerve");

  scene::Case value;
  value.labels.push_back(labelsNamed({"facial_nerve", "facial nerve", "dura"}));
  EXPECT_EQ(scene::partReadAs(value, "Facial Nerve"), "facial_nerve");
  EXPECT_EQ(scene::partReadAs(value, "facial nerve"), "facial nerve");
  EXPECT_EQ(scene::partReadAs(value, "nerve"), "");
  EXPECT_THROW(scene::checkNewPartName(value, "dura", "FACIAL_nerve"), core::InvalidParameter);
  EXPECT_NO_THROW(scene::checkNewPartName(value, "dura", "Dura")); // its own
}

TEST(Case, UndoAndRedoMoveListAndVoxelsTogether)
{
  scene::Case value = drilledCase(3);
  EXPECT_DOUBLE_EQ(value.removedVolume(), 33.0);
  EXPECT_EQ(value.dissection.undo(2), 2u);
  EXPECT_EQ(value.dissection.applied(), 1u);
  EXPECT_DOUBLE_EQ(value.removedVolume(), 10.0);
  EXPECT_EQ(value.dissection.redo(9), 2u);
  EXPECT_EQ(value.dissection.applied(), 3u);
  EXPECT_EQ(value.dissection.undo(9), 3u);
  EXPECT_EQ(value.dissection.undo(), 0u);
}

TEST(Case, UndoNeedsNoVoxels)
{
  scene::Case value = drilledCase(2);
  value.dissection.unload();
  EXPECT_EQ(value.dissection.undo(), 1u);
  EXPECT_EQ(value.applied(), 1u);
}

TEST(Case, ACopyIsTheCaseAtThatMoment)
{
  scene::Case value = drilledCase(2);
  const auto shown = value.dissection.sharedMask();
  scene::Case copy = value;
  scene::test::drill(value, {12, 4, 8}, 1.0);
  value.dissection.undo(2);
  EXPECT_EQ(copy.applied(), 2u);
  EXPECT_EQ(copy.dissection.strokes().size(), 2u);
  const scene::Case before = drilledCase(2);
  EXPECT_EQ(volume::differentVoxels(copy.dissection.mask(), before.dissection.mask()), 0u);
  // A picture of the case stays one of the case.
  EXPECT_EQ(volume::differentVoxels(*shown, value.dissection.mask()), 0u);
  value = std::move(copy);
  EXPECT_EQ(volume::differentVoxels(*shown, before.dissection.mask()), 0u);
  EXPECT_EQ(value.dissection.sharedMask(), shown);
}

TEST(Case, RemovesPartsByNameAndEmptyMapsWithThem)
{
  scene::Case value;
  value.labels = {labelsNamed({"nerve", "sinus"}), labelsNamed({"incus"})};
  scene::removePart(value, "incus");
  EXPECT_EQ(value.labels.size(), 1u);
  scene::removePart(value, "nerve");
  EXPECT_EQ(value.labels.front().structures.size(), 1u);
  EXPECT_EQ(scene::partNames(value), (std::vector<std::string>{"ct", "sinus"}));
}

TEST(Case, RefusesToRemoveWhatIsNotThereOrTheCt)
{
  scene::Case value;
  value.labels = {labelsNamed({"sinus"})};
  try
  {
    scene::removePart(value, "zebra");
    FAIL();
  }
  catch (const core::InvalidParameter& error)
  {
    EXPECT_NE(std::string(error.what()).find("sinus"), std::string::npos);
  }
  EXPECT_THROW(scene::removePart(value, "ct"), core::InvalidParameter);
}

TEST(Case, BoneIsTheCtUnlessAStructureIsCalledBone)
{
  scene::Case value;
  EXPECT_TRUE(scene::meansBone(value, "ct"));
  EXPECT_TRUE(scene::meansBone(value, "bone"));
  EXPECT_FALSE(scene::meansBone(value, "sinus"));
  value.labels = {labelsNamed({"bone"})};
  EXPECT_TRUE(scene::meansBone(value, "ct"));
  EXPECT_FALSE(scene::meansBone(value, "bone"));
}

TEST(Case, SoftTissueIsMeantWhereNoPartIsCalledSo)
{
  scene::Case value;
  EXPECT_TRUE(scene::meansSoftTissue(value, scene::kSoftTissue));
  EXPECT_TRUE(scene::meansSoftTissue(value, "soft-tissue"));
  EXPECT_FALSE(scene::meansSoftTissue(value, "ct") || scene::meansBone(value, "soft-tissue"));
  value.labels = {labelsNamed({"soft-tissue"})};
  EXPECT_TRUE(scene::meansSoftTissue(value, scene::kSoftTissue));
  EXPECT_FALSE(scene::meansSoftTissue(value, "soft-tissue"));
  EXPECT_THROW(scene::checkPartName(scene::kSoftTissue), core::InvalidParameter);
  EXPECT_NO_THROW(scene::checkPartName("soft-tissue"));
  EXPECT_FALSE(value.softTissue.shown) << "at first";
}

TEST(Case, BoneIsDrawnOpaqueToBeginWith)
{
  const scene::Case value;
  EXPECT_TRUE(value.boneLook.shown);
  EXPECT_EQ(value.boneLook.opacity, 1.0F);
  EXPECT_EQ(value.boneLook.preset, "bone");
}

TEST(Case, LooksReadTheCtAgainWhenTheirMrIsRemoved)
{
  scene::Case value;
  value.labels = {labelsNamed({"nerve", "sinus"})};
  for (const char* name : {"t1", "t2"})
  {
    scene::ImagePart mr;
    mr.name = name;
    value.mr.push_back(mr);
  }
  scene::findStructure(value, "nerve")->look.sourceImage = "t1";
  scene::findStructure(value, "sinus")->look.sourceImage = "t2";
  value.softTissue.sourceImage = "t1";
  value.softTissue.relative = false;
  value.softTissue.transfer = appearance::TransferFunction::constant({1.0F, 1.0F, 1.0F}, 0.1F);
  scene::removePart(value, "t1");
  EXPECT_TRUE(value.softTissue == appearance::softTissueLook()) << "no values of the MR in the CT";
  EXPECT_EQ(scene::findMr(value, "t1"), nullptr);
  EXPECT_EQ(scene::findStructure(value, "nerve")->look.sourceImage, "");
  EXPECT_EQ(scene::findStructure(value, "sinus")->look.sourceImage, "t2");
}

TEST(Case, NamesMustFitAFile)
{
  for (const std::string good : {"ear", "Ohr links 2", "ohr_1", "ünïcode", "a.b"})
    EXPECT_NO_THROW(scene::checkCaseName(good)) << good;
  for (const std::string& bad :
       {std::string(), std::string("../x"), std::string(".hidden"), std::string("a/b"),
        std::string("tab\t"), std::string("-x"), std::string("end "), std::string(101, 'a'),
        std::string("a\0b", 3), std::string("\xff\xfe"), std::string("\xc0\xaf"),
        std::string("\xed\xa0\x80")})
    EXPECT_THROW(scene::checkCaseName(bad), core::InvalidParameter) << bad;
}

TEST(PlainText, NamesHaveOnlyWhatIsSeen)
{
  // Latin-1, Greek, Arabic, Han, beyond the BMP; U+2010, U+2030 and U+00A0 are beside the ranges
  for (const std::string good : {"ohr", "\u00fc", "\u03a9", "\u0627\u0644", "\u8033", "\U0001f442",
                                 "\u2010", "\u2030", "a\u00a0b", "\u2070"})
  {
    EXPECT_FALSE(scene::hasInvisible(good)) << good;
    EXPECT_EQ(scene::withoutInvisible(good), good);
    EXPECT_EQ(scene::withVisible(good), good);
    EXPECT_NO_THROW(scene::checkCaseName(good)) << good;
  }
  for (const std::string bad :
       {"\u202a", "\u202b", "\u202c", "\u202d",   "\u202e", "\u2066", "\u2067", "\u2068",
        "\u2069", "\u200b", "\u200c", "\u200d",   "\u200e", "\u200f", "\u2060", "\ufeff",
        "\u00ad", "\u061c", "\u2028", "\xc2\x85", "\x1b",   "\x7f",   "\t",     "\U000e0041"})
  {
    const std::string name = "left" + bad + "ear";
    EXPECT_TRUE(scene::hasInvisible(name)) << bad;
    EXPECT_EQ(scene::withoutInvisible(name), "leftear");
    EXPECT_EQ(scene::withVisible(name), "left\ufffdear");
    EXPECT_THROW(scene::checkCaseName(name), core::InvalidParameter);
    EXPECT_THROW(scene::checkPartName(name), core::InvalidParameter);
    EXPECT_THROW(scene::checkBranchName(name), core::InvalidParameter);
    EXPECT_THROW(scene::checkPersonName(name), core::InvalidParameter);
    scene::Description words;
    words.tags = {name};
    EXPECT_THROW(scene::checkDescription(words), core::InvalidParameter);
    words.tags.clear();
    words.diagnosis = name;
    EXPECT_THROW(scene::checkDescription(words), core::InvalidParameter);
  }
  // A malformed character ends where the next begins: what follows it is seen.
  for (const std::string lead : {"\xe2", "\xc3", "\xf0\x9f", "\xe2\x80", "\xf8", "\xff", "\x80"})
  {
    const std::string name = "ear" + lead + "A\x1b[2J";
    std::string replaced;
    for (std::size_t n = 0; n < lead.size(); ++n)
      replaced += "\ufffd";
    EXPECT_TRUE(scene::hasInvisible(name));
    EXPECT_TRUE(scene::hasControls(name));
    EXPECT_TRUE(scene::hasControls("ear" + lead + "\x1b[2J"));
    EXPECT_EQ(scene::withVisible(name), "ear" + replaced + "A\ufffd[2J");
    EXPECT_EQ(scene::withVisible("ear" + lead + "\x1b[2J"), "ear" + replaced + "\ufffd[2J");
    EXPECT_EQ(scene::withVisible("ear" + lead), "ear" + replaced);
    EXPECT_EQ(scene::withVisibleControls(lead + "\x1b[2J").find('\x1b'), std::string::npos);
    EXPECT_EQ(scene::withoutInvisible(name).find('\x1b'), std::string::npos);
  }
  EXPECT_EQ(scene::withVisible("\xc0\x9b"), "\ufffd\ufffd") << "an overlong ESC";
  EXPECT_EQ(scene::withVisibleControls("a\tb\n\x1b[2J\u202eoh\u00adr\xfc", "\n\t"),
            "a\tb\n\ufffd[2J\ufffdoh\u00adr\xfc")
      << "a path of another character set stays as it is";
  // A note may be pasted from anywhere, but obeys nothing and reorders nothing.
  scene::Description words;
  words.note = "co\u00adchlea\u200b\n\tnext line";
  EXPECT_NO_THROW(scene::checkDescription(words));
  words.note = "left\u202e ear";
  EXPECT_THROW(scene::checkDescription(words), core::InvalidParameter);
}

TEST(Case, AnMrThatIsRemovedNoLongerLiesOverTheSlices)
{
  scene::Case value;
  for (const char* name : {"T1", "T2"})
  {
    value.mr.emplace_back();
    value.mr.back().name = name;
  }
  value.view.slices.emplace();
  value.view.slices->overlay = scene::ViewState::Slices::Overlay{"T2", "blend", 0.5};
  scene::removePart(value, "T1");
  EXPECT_TRUE(value.view.slices->overlay);
  scene::removePart(value, "T2");
  EXPECT_FALSE(value.view.slices->overlay);
}
