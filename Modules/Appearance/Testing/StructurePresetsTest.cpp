#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "petrous/Appearance/StructurePresets.h"
#include "petrous/Appearance/StructureProperties.h"
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

TEST(StructurePresets, KnowsTheNamesThatSegmentationProgramsGive)
{
  const auto presets = StructurePresets::builtIn();
  const std::vector<std::pair<const char*, const char*>> names{
      // TotalSegmentator
      {"internal_carotid_artery_left", "artery"},
      {"internal_jugular_vein_right", "vein"},
      {"auditory_canal_right", "ear-canal"},
      {"sinus_maxillary", "air-cells"},
      {"venous_sinuses", "vein"},
      {"brainstem", "dura"},
      {"styloid_process_left", "bone"},
      {"teeth_lower", "bone"},
      {"sternocleidomastoid_right", "muscle"},
      {"optic_nerve_left", "nerve"},
      // head and neck atlas of 3D Slicer
      {"right_internal_carotid", "artery"},
      {"left_internal_jugular_vein", "vein"},
      {"left_zygomatic_muscle", "muscle"},
      {"superior_vena_cava", "vein"},
      {"skull", "bone"},
      {"thyroid_gland", "other"},
      // temporal-bone atlases
      {"ICA", "artery"},
      {"EAC", "ear-canal"},
      {"IAC", "inner-ear"},
      {"Internal Auditory Canal", "inner-ear"},
      {"Bony_Labyrinth", "inner-ear"},
      {"Superior_Vestibular_Nerve", "nerve"},
      {"Chorda_Tympani", "nerve"},
      {"facial artery", "artery"},
      {"facial recess", "air-cells"},
      {"Sinus_&_Dura", "vein"},
      {"stapedius muscle", "muscle"},
      {"Stapes", "ossicle"},
      {"vestibular schwannoma", "tumour"},
      {"Segment_1", "other"}};
  for (const auto& [name, preset] : names)
    EXPECT_EQ(presets.lookFor(name).preset, preset) << name;
}

// Each row: the preset, and names that get it.
TEST(StructurePresets, KnowsNamesInEnglishGermanAndLatin)
{
  const std::pair<const char*, std::vector<const char*>> table[] = {
      {"nerve",
       {"Nervus facialis",
        "N. facialis",
        "N.facialis li",
        "nervus_facialis_sinister",
        "Facialis",
        "facial",
        "Facial L",
        "facial_left_1",
        "FacialNerveLeft",
        "facialnerve",
        "FACIAL_NERVE_R",
        "Gesichtsnerv",
        "Gesichtsnerv links",
        "Fazialis",
        "Fazialis mastoid",
        "Fazialis mastoid segment",
        "Fazialis tympanal",
        "Fazialis vertikal",
        "linker Fazialis",
        "Fazialisknie",
        "facialis mastoid",
        "facial mastoid",
        "N. fazialis",
        "Fazialisnerv rechts",
        "Fazialiskanal",
        "fallopian canal",
        "Chorda tympani",
        "CHORDA_TYMPANI",
        "chorda",
        "Paukensaite",
        "Nerv",
        "Nerven",
        "Nervus vestibulocochlearis",
        "vestibular_nerve",
        "cochlear nerve",
        "H\xc3\xb6rnerv",
        "Hoernerv",
        "CN VII",
        "CN7",
        "cranial_nerve_VII",
        "Ganglion geniculi",
        "optic_nerve_left",
        "left_inferior_alveolar_canal"}},
      {"vein",
       {"Sinus sigmoideus", "sigmoid_sinus_left", "SigmoidSinus", "sigmoidsinus",
        "Sinus transversus", "Vena jugularis interna", "V. jugularis int.",
        "bulbus venae jugularis", "jugular_bulb", "internal_jugular_vein_right", "iliac_vena_left",
        "superior_vena_cava", "Venen", "venous_sinuses", "pulmonary_vein", "IJV"}},
      {"artery",
       {"internal_carotid_artery_left", "Arteria carotis interna", "A. carotis interna re",
        "Carotis", "A. meningea media", "ICA", "common_carotid_artery_right",
        "subclavian_artery_left", "carotid sinus", "Halsschlagader links Schlagader", "aorta",
        "brachiocephalic_trunk",
        "Gef\xc3\xa4\xc3\x9f"
        "e",
        "arteries"}},
      {"ossicle",
       {"Hammer", "Amboss", "Steigb\xc3\xbcgel", "Steigbuegel", "STEIGB\xc3\x9cGEL",
        "Steigbu\xcc\x88gel", "Malleus", "incus_left", "Stapes", "ossicles",
        "Geh\xc3\xb6rkn\xc3\xb6"
        "chelchen",
        "Ossicula auditus"}},
      {"inner-ear",
       {"Cochlea", "Schnecke", "Bogengang", "Bogeng\xc3\xa4nge", "lateraler Bogengang",
        "Canalis semicircularis lateralis", "superior_semicircular_canal", "lateral canal",
        "canals", "Labyrinth", "Labyrinthus", "Vestibulum", "vestibule", "Innenohr", "IAC",
        "Innerer Geh\xc3\xb6rgang", "Meatus acusticus internus", "SCC", "scala tympani"}},
      {"ear-canal",
       {"\xc3\x84u\xc3\x9f"
        "erer Geh\xc3\xb6rgang",
        "Meatus acusticus externus", "auditory_canal_right", "EAC"}},
      {"dura",
       {"Dura", "dura mater", "DURA_MATER", "dural", "Durae", "Hirnhaut", "Hirnh\xc3\xa4ute",
        "tegmen", "cerebellum", "Kleinhirn", "brain", "brainstem", "frontal_lobe", "temporal_lobe",
        "meninges", "cerebrum"}},
      {"bone",
       {"skull",
        "Sch\xc3\xa4"
        "del",
        "mandible",
        "Unterkiefer",
        "lower_jawbone",
        "facial_bone",
        "Facial Bones",
        "vertebrae_C1",
        "clavicula_left",
        "zygomatic_arch_right",
        "styloid_process_left",
        "hyoid",
        "rib_left_7",
        "humerus_left",
        "hip_right",
        "sternum",
        "Felsenbein",
        "Os temporale",
        "temporal bone",
        "Processus mastoideus",
        "mastoid",
        "Knochen",
        "teeth_upper"}},
      {"muscle",
       {"masseter_right",
        "temporalis_left",
        "lateral_pterygoid_left",
        "digastric_left",
        "tongue",
        "sternocleidomastoid_right",
        "middle_pharyngeal_constrictor",
        "anterior_scalene_left",
        "levator_scapulae_right",
        "thyrohyoid_left",
        "prevertebral_right",
        "gluteus_maximus_left",
        "iliopsoas_right",
        "autochthon_left",
        "superior_rectus_muscle_left",
        "skeletal_muscle",
        "M. stapedius",
        "Musculus tensor tympani",
        "facial muscles",
        "Muskeln"}},
      {"air-cells",
       {"Cellulae mastoideae", "mastoid air cells", "Mastoidzellen", "Paukenh\xc3\xb6hle",
        "Cavum tympani", "Mittelohr", "sinus_frontal", "paranasal sinuses", "larynx_air",
        "nasal_cavity_left", "Sinus tympani", "antrum"}},
      {"tumour", {"Akustikus Neurinom", "vestibular schwannoma", "Meningeom", "acoustic neuroma"}},
      {"cholesteatoma", {"Cholesteatom", "Cholesteatoma"}}};
  const auto presets = StructurePresets::builtIn();
  for (const auto& [preset, names] : table)
    for (const char* name : names)
      EXPECT_EQ(presets.lookFor(name).preset, preset) << name;
}

TEST(StructurePresets, LeavesNeutralWhatItDoesNotKnow)
{
  const auto presets = StructurePresets::builtIn();
  for (const char* name : {"durable",
                           "duration",
                           "Durango",
                           "facial_fat",
                           "facial skin",
                           "face",
                           "facialist",
                           "nervous system",
                           "spinal canal",
                           "spinal_cord",
                           "thyroid_gland",
                           "parotid_gland_left",
                           "eyeball_left",
                           "soft_palate",
                           "thyroid_cartilage",
                           "costal_cartilages",
                           "lymph_node",
                           "lymphatic vessel",
                           "cochlear_implant",
                           "hip_implant",
                           "electrode",
                           "cerebro-spinal fluid",
                           "boneless",

                           "veinte",
                           "incumbent",
                           "hammerhead",
                           "tribe",
                           "ribbon",
                           "chip",
                           "icarus",
                           "skin",
                           "fat",
                           "tissue",
                           "mass",
                           "blood",
                           "liver",
                           "subcutaneous_fat",
                           "Segment_1",
                           "label 3",
                           "intracerebral_hemorrhage",
                           "structure",
                           "left",
                           "x",
                           "",
                           "_"})
    EXPECT_EQ(presets.lookFor(name).preset, "other") << name;
}

TEST(StructurePresets, ANervesOwnWordDecidesBeforeThatOfItsPlace)
{
  const auto presets = StructurePresets::builtIn();
  const std::pair<NerveKind, std::vector<const char*>> nerves[] = {
      {NerveKind::Facial,
       {"Fazialis mastoid",
        "Fazialis mastoid segment",
        "VII mastoid",
        "VII_labyrinthine_left",
        "Fazialis tympanal",
        "Fazialis vertikal",
        "linker Fazialis",
        "Fazialisknie",
        "facial_mastoid",
        "facial_labyrinthine",
        "facial_genu",
        "facial_meatal",
        "facial nerve IAC",
        "facial nerve, internal auditory canal",
        "N. VII meatus",
        "CN VII mastoid",
        "cn_7",
        "Facialisverlauf",
        "facial nerve to stapedius",
        "facial nerve in the middle ear",
        "facial nerve, temporal bone",
        "Nervus facialis Knochen",
        "facial nerve (facial recess)",
        "facial nerve, sinus tympani",
        "facial nerve at the sigmoid sinus"}},
      {NerveKind::ChordaTympani,
       {"chorda in the middle ear", "chorda tympani, mastoid", "chorda, facial recess"}},
      {NerveKind::Other,
       {"nerve IAC", "CN VIII", "cochlear nerve", "Nervenverlauf", "abducens nerve cavernous sinus",
        "optic nerve (sphenoid sinus)", "vagus nerve, jugular foramen"}}};
  for (const auto& [kind, names] : nerves)
    for (const char* name : names)
    {
      EXPECT_EQ(presets.lookFor(name).preset, "nerve") << name;
      EXPECT_EQ(presets.lookFor(name).warning, 2.0) << name;
      EXPECT_TRUE(presets.nerveOf(name) == kind) << name;
    }
  const std::pair<const char*, std::vector<const char*>> others[] = {
      {"artery",
       {"Karotis", "Karotis links", "Carotis mastoid", "carotid tympanic cavity",
        "Karotis Paukenh\xc3\xb6hle", "A. carotis interna", "Karotiskanal", "A. facialis",
        "facial artery", "carotid sinus"}},
      {"tumour", {"facial schwannoma", "facial nerve tumour", "carotid paraganglioma"}},
      {"vein",
       {"V. facialis", "facial vein", "cavernous sinus carotid", "vein of the facial nerve",
        "sigmoid sinus", "jugular foramen"}},
      {"muscle", {"facial muscle"}},
      {"bone", {"facial bones", "facial left bones", "mastoid", "facial skeleton"}},
      {"air-cells", {"facial recess", "Fazialisrezessus", "sinus tympani", "antrum", "middle ear"}},
      {"inner-ear", {"IAC", "labyrinth"}},
      {"other",
       {"facial nerve implant", "facial fat", "facial skin", "Facial_Ridge", "facialist",
        "Segment VII", "VII", "nervous system", "innervation", "midfacial"}}};
  for (const auto& [preset, names] : others)
    for (const char* name : names)
    {
      EXPECT_EQ(presets.lookFor(name).preset, preset) << name;
      EXPECT_TRUE(presets.nerveOf(name) == NerveKind::None) << name;
    }
}

TEST(StructurePresets, ACodeChoosesTheLookInAnyLanguage)
{
  const auto presets = StructurePresets::builtIn();
  const auto preset = [&presets](const petrous::volume::SegmentCodes& codes)
  {
    const auto look = presets.lookForCodes(codes);
    return look ? look->preset : std::string();
  };
  petrous::volume::SegmentCodes codes;
  EXPECT_EQ(preset(codes), "");
  codes.type = {"86117002", "SCT", "A. c. int."};
  EXPECT_EQ(preset(codes), "artery");
  codes.type = {"56052001", "SCT", "nerf"};
  EXPECT_EQ(preset(codes), "nerve");
  codes.type = {"56052001", "99LOCAL", "nerf"};
  EXPECT_EQ(preset(codes), "") << "a number means something in its scheme only";
  codes.type = {"T-A8150", "SRT", "Facial nerve"};
  EXPECT_EQ(preset(codes), "nerve") << "by its meaning";
  codes.type = {"85756007", "SCT", "Tissue"};
  EXPECT_EQ(preset(codes), "") << "what 3D Slicer gives to all";
  codes.region = {"86117002", "SCT", "Internal carotid artery"};
  EXPECT_EQ(preset(codes), "artery");
  codes.category = {"49755003", "SCT", "Morphologically Abnormal Structure"};
  codes.type = {"4147007", "SCT", "Mass"};
  EXPECT_EQ(preset(codes), "") << "a mass at an artery is none";
  codes.type = {"0", "99", "Vestibular schwannoma"};
  EXPECT_EQ(preset(codes), "tumour");
}

TEST(StructurePresets, TakesNoInitialOfAFileNameForAStructure)
{
  const auto presets = StructurePresets::builtIn();
  EXPECT_EQ(presets.knownWords("Doe_N_facial_nerve"), "facial nerve");
  EXPECT_EQ(presets.knownWords("Steigb\xc3\xbcgel_links"), "steigb\xc3\xbcgel links");
  EXPECT_EQ(presets.knownWords("Duran_cochlea"), "cochlea");
  EXPECT_EQ(presets.knownWords("Linke_Dexter_Nervus_facialis_rechts"), "nervus facialis rechts");
  EXPECT_EQ(presets.knownWords("Sinus_sigmoideus"), "sinus sigmoideus");
}

TEST(StructurePresets, KeepsTheSideInEveryLanguage)
{
  const auto presets = StructurePresets::builtIn();
  for (const char* side :
       {"l",        "r",      "d",         "g",       "s",        "lt",     "rt",   "li",
        "re",       "sin",    "dx",        "dex",     "sn",       "os",     "od",   "sx",
        "gauche",   "droite", "links",     "rechts",  "izq",      "der",    "esq",  "dir",
        "sinister", "dexter", "izquierda", "derecha", "sinistra", "destra", "left", "right"})
  {
    const std::string name = std::string("facial nerve ") + side;
    EXPECT_EQ(presets.knownWords("Doe_facial_nerve_" + std::string(side)), name);
    EXPECT_EQ(presets.knownWords(side), "") << "names nothing alone";
    EXPECT_EQ(presets.lookFor(name).preset, "nerve") << side;
  }
}

TEST(StructurePresets, AWholeWordIsNoBeginningOfAnother)
{
  EXPECT_EQ(StructurePresets::builtIn().lookFor("icarus").preset, "other");
}

TEST(StructurePresets, FindsAPresetByItsNameOrByAWord)
{
  const auto presets = StructurePresets::builtIn();
  EXPECT_EQ(presets.preset("bone-translucent").preset, "bone-translucent");
  EXPECT_LT(presets.preset("bone-translucent").opacity, 0.5F);
  EXPECT_EQ(presets.preset("vessel").preset, "artery");
  EXPECT_EQ(presets.preset("other").preset, "other");
  try
  {
    presets.preset("zebra");
    FAIL() << "accepted";
  }
  catch (const petrous::core::InvalidParameter& error)
  {
    EXPECT_NE(std::string(error.what()).find("zebra"), std::string::npos);
    EXPECT_NE(std::string(error.what()).find("cholesteatoma"), std::string::npos);
  }
}

TEST(StructurePresets, EachTissueHasATransferFunctionThatFollowsTheCase)
{
  for (const StructureAppearance& look : StructurePresets::builtIn().all())
    if (look.preset != "other")
    {
      ASSERT_TRUE(look.transfer.has_value()) << look.preset;
      EXPECT_TRUE(look.relative) << look.preset;
      EXPECT_FALSE(look.transfer->transparent()) << look.preset;
    }
}

TEST(StructurePresets, WhatMustNotBeHurtWinsOverlapsAndLumensLose)
{
  const auto presets = StructurePresets::builtIn();
  int last = -1;
  for (const char* name : {"nerve", "artery", "vein", "ossicle", "inner-ear", "tumour",
                           "cholesteatoma", "dura", "other", "muscle", "bone", "ear-canal"})
  {
    EXPECT_GT(presets.preset(name).priority, last) << name;
    last = presets.preset(name).priority;
  }
  for (const StructureAppearance& look : presets.all())
  {
    if (!look.solid)
    {
      EXPECT_GT(look.priority, presets.preset("bone").priority) << look.preset;
    }
  }
}

TEST(StructurePresets, BoneGrowsPalerAndShinierWithDensity)
{
  const TransferFunction bone = *boneLook().transfer;
  // Cellular bone at the surface's 300 HU, cortical bone 1100 HU higher.
  const auto cells = bone.at(300.0).color;
  const auto cortex = bone.at(1400.0).color;
  EXPECT_FLOAT_EQ(float(cells[2]), 0.58F);
  EXPECT_FLOAT_EQ(float(cortex[2]), 0.79F);
  for (int channel = 0; channel < 3; ++channel)
    EXPECT_GT(cortex[channel], cells[channel]);
  // Pink, not orange: of green and blue about as much, of red more.
  EXPECT_GT(cells[0] - cells[1], 0.1);
  EXPECT_LT(cells[1] - cells[2], 0.5 * (cells[0] - cells[1]));
  EXPECT_LT(bone.at(300.0).specular, bone.at(1400.0).specular);
  EXPECT_LT(bone.at(300.0).extinction, bone.at(1400.0).extinction);
  EXPECT_EQ(boneLook().opacity, 1.0F);
}

// No known stiffness was measured on these structures: none is elastic by default.
TEST(StructurePresets, YieldOnlyWhereTheCatalogueSaysHow)
{
  for (const StructureAppearance& look : StructurePresets::builtIn().all())
    EXPECT_EQ(look.stiffness, 0.0) << look.preset;
  const auto catalogue = [](const std::string& stiffness)
  {
    return R"({"other": {"name": "other", "color": [1, 1, 1], "opacity": 1, "solid": true},
               "presets": [{"name": "jelly", "words": ["jelly"], "color": [1, 0, 0], "opacity": 1,
                            "solid": true, "stiffness_n_per_mm": )" +
           stiffness + "}]}";
  };
  const StructurePresets presets(catalogue("0.25"));
  EXPECT_EQ(presets.lookFor("jelly_left").stiffness, 0.25);
  EXPECT_EQ(presets.lookFor("bone").stiffness, 0.0);
  StructureAppearance look;
  applyPreset(look, presets.preset("jelly"));
  EXPECT_EQ(look.stiffness, 0.25);
  for (const char* wrong : {"-1", "0.0001", "1000", "\"soft\""})
    EXPECT_THROW(StructurePresets{catalogue(wrong)}, petrous::core::InvalidParameter) << wrong;
}

TEST(StructurePresets, WarnOfWhatMustNotBeTouched)
{
  const StructurePresets presets = StructurePresets::builtIn();
  EXPECT_EQ(presets.lookFor("facial_nerve").warning, 2.0);
  EXPECT_EQ(presets.lookFor("sigmoid sinus").warning, 2.0);
  EXPECT_EQ(presets.lookFor("cochlea").warning, 1.0);
  EXPECT_EQ(boneLook().warning, 0.0);
  StructureAppearance look;
  applyPreset(look, presets.preset("nerve"));
  EXPECT_EQ(look.warning, 2.0);
}

TEST(StructureProperties, RefuseANumberOutOfRangeAndKeepTheValue)
{
  const double nan = std::nan("");
  const double infinity = std::numeric_limits<double>::infinity();
  int numbers = 0;
  for (const StructureProperty& property : kStructureProperties)
    if (property.isNumber())
    {
      ++numbers;
      const auto& [lower, upper, unit, isLowerExcluded] = property.range;
      ASSERT_LT(lower, upper) << property.key;
      StructureAppearance look;
      setNumber(look, property, lower);
      EXPECT_EQ(numberOf(look, property), lower) << property.key;
      setNumber(look, property, upper);
      for (const double wrong : {lower - 1.0, upper + 0.1, nan, infinity, -infinity})
        try
        {
          setNumber(look, property, wrong);
          ADD_FAILURE() << property.key << ": accepted " << wrong;
        }
        catch (const petrous::core::InvalidParameter& error)
        {
          const std::string text = error.what();
          EXPECT_EQ(text.find(property.key), 0u) << text;
          EXPECT_NE(text.find(property.range.text()), std::string::npos) << text;
        }
      EXPECT_EQ(numberOf(look, property), upper) << property.key;
      if (property.off)
      {
        setNumber(look, property, 0.0);
        EXPECT_TRUE(isOff(look, property)) << property.key;
      }
    }
  EXPECT_EQ(numbers, 5);
}

TEST(StructureProperties, ADefaultLiesWithinItsRangeOrIsOff)
{
  for (const StructureProperty& property : kStructureProperties)
    if (property.isNumber())
    {
      EXPECT_TRUE(isOff({}, property) || property.range.contains(numberOf({}, property)))
          << property.key;
    }
}

TEST(StructureAppearance, FlagsGoThereAndBack)
{
  StructureAppearance look;
  for (const std::string flags : {"shown", "shown,drillable", "touchable", "none"})
  {
    setFlags(look, flags);
    EXPECT_EQ(flagsOf(look), flags);
  }
  EXPECT_THROW(setFlags(look, "shown,loud"), petrous::core::InvalidParameter);
  EXPECT_EQ(flagsOf(look), "none");
}

TEST(StructureAppearance, FlagsWithASignLeaveTheOthers)
{
  StructureAppearance look;
  setFlags(look, "shown,drillable");
  changeFlags(look, "+touchable");
  EXPECT_EQ(flagsOf(look), "shown,touchable,drillable");
  changeFlags(look, "-shown,-drillable");
  EXPECT_EQ(flagsOf(look), "touchable");
  changeFlags(look, "-touchable,+shown");
  EXPECT_EQ(flagsOf(look), "shown");
  changeFlags(look, "drillable");
  EXPECT_EQ(flagsOf(look), "drillable") << "without a sign it is the whole";
  for (const char* wrong : {"+touchable,shown", "+loud", "-", "+touchable,,-shown"})
    EXPECT_THROW(changeFlags(look, wrong), petrous::core::InvalidParameter) << wrong;
  EXPECT_EQ(flagsOf(look), "drillable");
}

TEST(StructurePresets, KnowsWhichWordsOfANameAreThoseOfStructures)
{
  const StructurePresets presets = StructurePresets::builtIn();
  const std::pair<const char*, const char*> names[] = {
      {"facial_nerve", "facial nerve"},
      {"Facial Nerve-LEFT 2", "facial nerve left 2"},
      {"FacialNerveLeft", "facial nerve left"},
      {"sigmoid_sinus", "sigmoid sinus"},
      {"Mueller_Hans_facial_nerve", "facial nerve"},
      {"M\xc3\xbcller-cochlea-19630412", "cochlea"},
      {"Cerebellum", "cerebellum"},
      {"semicircular_canals_superior", "semicircular canals superior"},
      {"tumour_not_resected", "tumour not resected"},
      {"Mueller-Tumor-nicht-reseziert", "tumor nicht reseziert"},
      {"Dexter_facial_nerve_s", "dexter facial nerve s"}, // S may be anything
      {"not_resected", ""},
      {"Bonetti_left", ""},
      {"left", ""},
      {"labels", ""},
      {"Doe^John", ""},
      {"", ""}};
  for (const auto& [name, words] : names)
    EXPECT_EQ(presets.knownWords(name), words) << name;
  EXPECT_EQ(presets.knownWordsOfPart("Left"), "left");
  EXPECT_EQ(presets.knownWordsOfPart("MuellerCochlea"), "cochlea");
  EXPECT_EQ(presets.knownWordsOfPart("Mueller"), "");
}

TEST(StructurePresets, AWordThatNegatesANameChangesNoLook)
{
  const StructurePresets presets = StructurePresets::builtIn();
  for (const std::string name : {"tumour", "cochlea", "facial nerve"})
    EXPECT_EQ(presets.lookFor(name + " not resected").preset, presets.lookFor(name).preset);
}
