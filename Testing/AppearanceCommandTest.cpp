#include <map>
#include <set>

#include "CommandRunner.h"
#include "petrous/Appearance/StructureProperties.h"

using petrous::testing::CommandLine;
using petrous::testing::quoted;

namespace
{

constexpr int kSize = 48;

// Writes a cube of voxels as NRRD; `valueAt` maps the squared distance from the centre to a value.
template <class T, class ValueAt>
std::filesystem::path writeCube(const std::filesystem::path& path, const char* type, double spacing,
                                const ValueAt& valueAt)
{
  std::vector<T> voxels;
  for (int k = 0; k < kSize; ++k)
    for (int j = 0; j < kSize; ++j)
      for (int i = 0; i < kSize; ++i)
        voxels.push_back(static_cast<T>(
            valueAt((i - 24) * (i - 24) + (j - 24) * (j - 24) + (k - 24) * (k - 24))));
  const std::string mm = std::to_string(spacing);
  std::ofstream file(path, std::ios::binary);
  file
      << "NRRD0004\ntype: " << type << "\ndimension: 3\nspace: left-posterior-superior\n"
      << "sizes: 48 48 48\nspace directions: (" << mm << ",0,0) (0," << mm << ",0) (0,0," << mm
      << ")\nkinds: domain domain domain\nendian: little\nencoding: raw\nspace origin: (0,0,0)\n\n";
  file.write(reinterpret_cast<const char*>(voxels.data()),
             static_cast<std::streamsize>(voxels.size() * sizeof(T)));
  return path;
}

// A head: soft tissue in a shell of bone in air, with noise, in Hounsfield units.
std::filesystem::path writeHead(const std::filesystem::path& path)
{
  std::mt19937 noise(1);
  return writeCube<std::int16_t>(
      path, "short", 1.0,
      [&noise](int r2)
      {
        const int tissue = r2 < 15 * 15 ? 40 : r2 < 18 * 18 ? 1300 : -1000;
        return tissue + static_cast<int>(noise() % 60) - 30;
      });
}

// A ball of bone in air in a micro-CT scanner's units, not in Hounsfield units.
std::filesystem::path writeMicroCt(const std::filesystem::path& path)
{
  std::mt19937 noise(1);
  return writeCube<std::uint16_t>(
      path, "ushort", 0.05,
      [&noise](int r2)
      { return (r2 < 15 * 15 ? 40000 : 12000) + static_cast<int>(noise() % 2000); });
}

/// A case "ear": CT, an MR "t2", a structure "cochlea" and a mesh "incus".
class AppearanceCommand : public CommandLine
{
protected:
  void SetUp() override
  {
    CommandLine::SetUp();
    const auto head = writeHead(m_folder / "head.nrrd");
    const auto cochlea = writeCube<std::uint8_t>(m_folder / "cochlea.nrrd", "uchar", 1.0,
                                                 [](int r2) { return r2 < 25 ? 1 : 0; });
    std::ofstream(m_folder / "incus.obj") << "v 0 0 0\nv 9 0 0\nv 0 9 0\nv 0 0 9\n"
                                             "f 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n";
    json("new ear --ct " + quoted(head) + " --mr t2=" + quoted(head) + " --labels cochlea=" +
         quoted(cochlea) + " --mesh incus=" + quoted(m_folder / "incus.obj"));
  }

  /// Writes a file with this text; returns its quoted path.
  std::string file(const std::string& name, const std::string& text) const
  {
    std::ofstream(m_folder / name) << text;
    return quoted(m_folder / name);
  }

  nlohmann::json part(const std::string& name) const
  {
    const auto list = json("appearance ear --list");
    for (const auto& entry : list["parts"])
      if (entry["name"] == name)
        return entry;
    return name == "ct"                          ? list["bone"]
           : name == list["soft_tissue"]["name"] ? list["soft_tissue"]
                                                 : nlohmann::json();
  }
};

const std::string kTransfer = R"({"points": [
  {"value": -50, "color": [0.1, 0.2, 0.3], "opacity": 0, "specular": 0.25},
  {"value": 900.5, "color": [1, 0.9, 0.8], "opacity": 0.75}]})";

} // namespace

TEST_F(AppearanceCommand, ListsBoneBesideTheParts)
{
  const auto bone = part("ct");
  EXPECT_EQ(bone["kind"], "bone");
  EXPECT_EQ(bone["preset"], "bone");
  EXPECT_EQ(bone["opacity"], 1.0);
  EXPECT_EQ(bone["transfer"]["relative"], true);
  EXPECT_EQ(part("cochlea")["preset"], "inner-ear");
  EXPECT_EQ(part("cochlea")["source"], "ct");
}

TEST_F(AppearanceCommand, PresetsReplaceALookAndKeepItsFlags)
{
  json("appearance ear --flags cochlea=touchable --set cochlea=nerve --set ct=bone-translucent");
  EXPECT_EQ(part("cochlea")["preset"], "nerve");
  EXPECT_EQ(part("cochlea")["flags"], "touchable");
  EXPECT_LT(part("ct")["opacity"], 0.5);
  EXPECT_EQ(json("info ear")["bone"]["preset"], "bone-translucent");
  json("appearance ear --set cochlea=vessel");
  EXPECT_EQ(part("cochlea")["preset"], "artery");
  EXPECT_EQ(json("appearance --presets")["presets"].size(), 16u);
}

TEST_F(AppearanceCommand, ATransferFunctionIsKeptAsItWasGiven)
{
  json("appearance ear --tf cochlea=" + file("f.json", kTransfer) + " --iso 450");
  const auto transfer = part("cochlea")["transfer"];
  auto wanted = nlohmann::json::parse(kTransfer);
  wanted["points"][1]["specular"] = 1.0;
  EXPECT_EQ(transfer["relative"], false);
  EXPECT_EQ(transfer["points"], wanted["points"]);
  json("appearance ear --tf cochlea=none");
  EXPECT_TRUE(part("cochlea")["transfer"].is_null());
}

TEST_F(AppearanceCommand, PresetsOfTheLibraryAreSavedListedSetAndDeleted)
{
  json("appearance ear --tf cochlea=" + file("f.json", kTransfer) + " --opacity cochlea=0.5");
  json("appearance ear --save-preset 'cochlea=our cochlea'");
  const auto presets = json("appearance --presets")["presets"];
  ASSERT_EQ(presets.size(), 17u);
  EXPECT_EQ(presets[16]["name"], "our cochlea");
  EXPECT_EQ(presets[16]["own"], true);
  EXPECT_EQ(presets[0]["own"], false);
  json("appearance ear --set 'ct=our cochlea'");
  EXPECT_EQ(part("ct")["preset"], "our cochlea");
  EXPECT_EQ(part("ct")["opacity"], 0.5);
  EXPECT_EQ(part("ct")["transfer"], part("cochlea")["transfer"]);
  EXPECT_NE(run("appearance ear --save-preset cochlea=bone").code, 0);
  EXPECT_NE(run("appearance --delete-preset nerve").code, 0);
  EXPECT_NE(run("appearance --delete-preset xyzzy").code, 0);
  EXPECT_EQ(json("appearance --delete-preset 'our cochlea'")["presets"].size(), 16u);
  EXPECT_EQ(part("ct")["preset"], "our cochlea") << "a case keeps what it has";
}

TEST_F(AppearanceCommand, ATransferFunctionIsWrittenAndFitted)
{
  const auto written = m_folder / "written.json";
  json("appearance ear --tf cochlea=" + file("f.json", kTransfer));
  json("appearance ear --save-tf cochlea=" + quoted(written));
  json("appearance ear --tf ct=" + quoted(written));
  EXPECT_EQ(part("ct")["transfer"], part("cochlea")["transfer"]);
  // In the cochlea 40 HU with noise of 30.
  json("appearance ear --fit cochlea");
  const auto points = part("cochlea")["transfer"]["points"];
  EXPECT_NEAR(points.front()["value"].get<double>(), 10.0, 3.0);
  EXPECT_NEAR(points.back()["value"].get<double>(), 70.0, 3.0);
  EXPECT_NE(run("appearance ear --fit incus").code, 0) << "a mesh";
  EXPECT_NE(run("appearance ear --fit xyzzy").code, 0);
}

TEST_F(AppearanceCommand, SetsColourOpacityAndSource)
{
  json("appearance ear --color 'cochlea=#ff8000' --opacity cochlea=0.25 --opacity bone=0.5");
  EXPECT_NEAR(part("cochlea")["color"][1].get<double>(), 128.0 / 255.0, 1e-6);
  EXPECT_EQ(part("cochlea")["opacity"], 0.25);
  EXPECT_EQ(part("ct")["opacity"], 0.5);
  json("appearance ear --color cochlea=0.5,0.25,0");
  EXPECT_EQ(part("cochlea")["color"], (std::vector<double>{0.5, 0.25, 0.0}));
  const auto outcome =
      run("appearance ear --source cochlea=t2 --tf cochlea=" + file("f.json", kTransfer));
  EXPECT_EQ(outcome.code, 0);
  EXPECT_NE(outcome.err.find("not registered"), std::string::npos) << outcome.err;
  EXPECT_EQ(part("cochlea")["source"], "t2");
  json("remove ear --part t2");
  EXPECT_EQ(part("cochlea")["source"], "ct");
}

// Each option of the table, from the command line to the case to JSON.
TEST_F(AppearanceCommand, SetsAndRefusesEachProperty)
{
  using petrous::appearance::StructureProperty;
  const std::map<std::string, std::pair<std::string, nlohmann::json>> others{
      {"--tissue", {"implant", "implant"}},
      {"--source", {"t2", "t2"}},
      {"--color", {"0.25,0.5,1", {0.25, 0.5, 1.0}}},
      {"--tf", {file("f.json", kTransfer), 2}}};
  const auto before = libraryContent();
  for (const StructureProperty& property : petrous::appearance::kStructureProperties)
    if (property.option.name && property.isNumber())
    {
      const std::string set = std::string("appearance ear ") + property.option.name + " cochlea=";
      const std::string range = property.range.text();
      for (const double wrong : {property.range.lower - 1.0, property.range.upper + 0.1})
        expectRefused(set + petrous::core::exactText(wrong), 2, range);
      for (const char* wrong : {"nan", "inf", "0x1", "1,5", "one"})
        expectRefused(set + wrong, 2, property.option.name);
    }
    else if (property.option.name)
    {
      ASSERT_EQ(others.count(property.option.name), 1u) << property.option.name;
    }
  for (const char* wrong : {"nan,0,0", "0,1.5,0", "0,0,-0.5", "0,0"})
    expectRefused(std::string("appearance ear --color cochlea=") + wrong, 2, "--color");
  EXPECT_EQ(libraryContent(), before);

  for (const StructureProperty& property : petrous::appearance::kStructureProperties)
    if (property.option.name)
    {
      const std::string set = std::string("appearance ear ") + property.option.name + " cochlea=";
      const std::string key = property.jsonKey ? property.jsonKey : property.key;
      const auto value = [&] { return part("cochlea")[key]; };
      if (property.isNumber())
      {
        json(set + petrous::core::exactText(property.range.upper));
        EXPECT_EQ(value(), property.range.upper) << key;
        const double halfway = 0.5 * property.range.upper;
        json(set + petrous::core::exactText(halfway));
        EXPECT_EQ(value(), halfway) << key;
      }
      else
      {
        const auto& [text, wanted] = others.at(property.option.name);
        json(set + text);
        const auto found = value();
        EXPECT_EQ(found.is_object() ? nlohmann::json(found["points"].size()) : found, wanted)
            << key;
      }
      if (property.off)
      {
        json(set + property.off);
        const auto off = value();
        EXPECT_TRUE(off.is_null() || off == 0.0 || off == property.off) << key << ": " << off;
      }
    }
}

TEST_F(AppearanceCommand, SaysHowAStructureYieldsUnderTheHand)
{
  EXPECT_TRUE(part("cochlea")["stiffness_n_per_mm"].is_null()) << "all is rigid to begin with";
  json("appearance ear --stiffness cochlea=0.4 --stiffness incus=2");
  EXPECT_EQ(part("cochlea")["stiffness_n_per_mm"], 0.4);
  EXPECT_EQ(part("incus")["stiffness_n_per_mm"], 2.0);
  EXPECT_NE(run("appearance ear --list").out.find(", 0.4 N/mm,"), std::string::npos);
  const auto outcome = run("appearance ear --stiffness cochlea=1 --flags cochlea=shown");
  EXPECT_EQ(outcome.code, 0);
  EXPECT_NE(outcome.err.find("'cochlea' is not felt"), std::string::npos) << outcome.err;
  // By the name of a soft tissue, with what that value is worth.
  const auto named = run("appearance ear --stiffness incus=nerve");
  EXPECT_EQ(named.code, 0) << named.err;
  EXPECT_NE(named.err.find("derived, within a factor of 8"), std::string::npos) << named.err;
  const nlohmann::json tables = json("materials");
  const auto& tissues = tables["soft_tissues"];
  ASSERT_EQ(tissues[0]["name"], "nerve");
  EXPECT_EQ(part("incus")["stiffness_n_per_mm"], tissues[0]["stiffness_n_per_mm"]);
  expectRefused("appearance ear --stiffness incus=cartilage", 2,
                "'cartilage' is neither a number nor a soft tissue; there are nerve, ");
  json("appearance ear --stiffness cochlea=rigid --set incus=ossicle");
  EXPECT_TRUE(part("cochlea")["stiffness_n_per_mm"].is_null());
  EXPECT_TRUE(part("incus")["stiffness_n_per_mm"].is_null()) << "the preset is rigid";
}

TEST_F(AppearanceCommand, SaysThatALumenIsNotFeltWhateverItsFlags)
{
  json("appearance ear --set cochlea=ear-canal");
  EXPECT_NE(run("appearance ear --list").out.find(", a lumen, not felt,"), std::string::npos);
  const auto outcome = run("appearance ear --flags cochlea=shown,touchable");
  EXPECT_EQ(outcome.code, 0);
  EXPECT_NE(outcome.err.find("'cochlea' is not felt: it is a lumen"), std::string::npos)
      << outcome.err;
  EXPECT_EQ(part("cochlea")["flags"], "shown,touchable") << "as it will be with a preset of tissue";
  EXPECT_TRUE(run("appearance ear --flags cochlea=shown,drillable").err.empty());
}

TEST_F(AppearanceCommand, SaysWhichFlagsAListDropsAndChangesThoseWithASign)
{
  json("appearance ear --flags cochlea=shown,touchable,drillable");
  const auto outcome = run("appearance ear --flags cochlea=touchable");
  EXPECT_EQ(outcome.code, 0);
  EXPECT_NE(outcome.out.find("'cochlea' is no longer shown, drillable"), std::string::npos)
      << outcome.out;
  EXPECT_EQ(part("cochlea")["flags"], "touchable");
  json("appearance ear --flags cochlea=+drillable");
  EXPECT_EQ(part("cochlea")["flags"], "touchable,drillable");
  const auto answer = json("appearance ear --flags cochlea=shown --flags ct=-shown");
  EXPECT_EQ(answer["flags_dropped"], nlohmann::json({{"cochlea", {"touchable", "drillable"}}}))
      << answer["flags_dropped"];
  EXPECT_EQ(part("ct")["flags"], "touchable,drillable");
  EXPECT_EQ(json("appearance ear --flags cochlea=-shown,+touchable")["flags_dropped"],
            nlohmann::json::object())
      << "as asked for";
  EXPECT_EQ(part("cochlea")["flags"], "touchable");
  EXPECT_EQ(json("appearance ear --flags cochlea=none")["flags_dropped"], nlohmann::json::object());
  expectRefused("appearance ear --flags cochlea=+shown,touchable", 3, "sign");
}

TEST_F(AppearanceCommand, SaysHowNearABurrMayCome)
{
  EXPECT_EQ(part("cochlea")["warn_mm"], 1.0) << "as its preset";
  json("appearance ear --warn cochlea=1.5 --warn incus=3");
  EXPECT_EQ(part("cochlea")["warn_mm"], 1.5);
  EXPECT_EQ(part("incus")["warn_mm"], 3.0);
  EXPECT_NE(run("appearance ear --list").out.find(", warned of at 1.5 mm,"), std::string::npos);
  json("appearance ear --warn cochlea=none --set incus=ossicle");
  EXPECT_EQ(part("cochlea")["warn_mm"], 0.0);
  EXPECT_EQ(part("incus")["warn_mm"], 1.0);
}

TEST_F(AppearanceCommand, SaysWhatTheDrillMeetsInAStructure)
{
  EXPECT_EQ(part("cochlea")["tissue"], "soft-tissue") << "as its preset";
  json("appearance ear --tissue cochlea=cortical-bone --tissue incus=implant");
  EXPECT_EQ(part("cochlea")["tissue"], "cortical-bone");
  EXPECT_EQ(part("incus")["tissue"], "implant");
  EXPECT_NE(run("appearance ear --list").out.find(", drilled as cortical-bone,"),
            std::string::npos);
  json("appearance ear --tissue cochlea=bone");
  EXPECT_EQ(part("cochlea")["tissue"], "bone") << "by its density";
}

TEST_F(AppearanceCommand, BoneCanBeHiddenButStaysTissue)
{
  const auto outcome = run("appearance ear --flags ct=none");
  EXPECT_EQ(outcome.code, 0);
  EXPECT_NE(outcome.err.find("bone stays touchable"), std::string::npos) << outcome.err;
  EXPECT_EQ(part("ct")["flags"], "touchable,drillable");
  EXPECT_TRUE(run("appearance ear --flags ct=shown,touchable,drillable").err.empty());
  EXPECT_EQ(part("ct")["flags"], "shown,touchable,drillable");
}

TEST_F(AppearanceCommand, SoftTissueIsAPartThatIsDrawnOnly)
{
  EXPECT_EQ(part("soft-tissue")["flags"], "none") << "not shown at first";
  EXPECT_EQ(part("soft-tissue")["preset"], "soft-tissue");
  EXPECT_TRUE(part("soft-tissue")["not_drawn"].is_null());
  EXPECT_TRUE(run("appearance ear --flags soft-tissue=shown").err.empty());
  EXPECT_EQ(json("info ear")["soft_tissue"]["flags"], "shown");
  const auto outcome = run("appearance ear --flags ct:soft-tissue=shown,touchable");
  EXPECT_NE(outcome.err.find("air to hand and drill"), std::string::npos) << outcome.err;
  EXPECT_EQ(part("soft-tissue")["flags"], "shown");
  expectRefused("appearance ear --warn soft-tissue=2", 3, "air to hand and drill");
  expectRefused("appearance ear --set soft-tissue=air-cells", 3, "lumen");
  expectRefused("appearance ear --fit soft-tissue", 3, "preset");

  json("appearance ear --set soft-tissue=skin --opacity soft-tissue=0.5");
  EXPECT_EQ(part("soft-tissue")["preset"], "skin");
  EXPECT_EQ(part("soft-tissue")["opacity"], 0.5);
  EXPECT_EQ(part("soft-tissue")["flags"], "shown");
  EXPECT_NE(run("appearance ear --tf soft-tissue=none").err.find("not drawn"), std::string::npos);
  EXPECT_NE(part("soft-tissue")["not_drawn"].get<std::string>().find("fill air"),
            std::string::npos);
  EXPECT_EQ(run("appearance ear --list").code, 0);
}

TEST_F(AppearanceCommand, SoftTissueOfAnMrHasAFunctionOfItsValues)
{
  const auto outcome = run("appearance ear --flags soft-tissue=shown --source soft-tissue=t2");
  EXPECT_NE(outcome.err.find("not registered"), std::string::npos) << outcome.err;
  const auto ofMr = part("soft-tissue");
  EXPECT_EQ(ofMr["source"], "t2");
  EXPECT_EQ(ofMr["transfer"]["relative"], false);
  EXPECT_EQ(ofMr["transfer"]["points"][0]["opacity"], 0.0);
  EXPECT_GT(ofMr["transfer"]["points"][0]["value"], -950.0) << "air is transparent";
  EXPECT_LT(ofMr["transfer"]["points"][0]["value"], 0.0);
  json("appearance ear --source soft-tissue=ct");
  EXPECT_EQ(part("soft-tissue")["transfer"]["relative"], true);
  json("appearance ear --source soft-tissue=t2 --tf soft-tissue=" + file("f.json", kTransfer));
  EXPECT_EQ(part("soft-tissue")["source"], "t2");
  EXPECT_EQ(part("soft-tissue")["transfer"]["points"].size(), 2u) << "what was given";
  json("appearance ear --fit soft-tissue");
  EXPECT_EQ(part("soft-tissue")["transfer"]["points"], ofMr["transfer"]["points"]);
  json("remove ear --part t2");
  EXPECT_EQ(part("soft-tissue")["source"], "ct");
  EXPECT_EQ(part("soft-tissue")["transfer"]["relative"], true);
}

TEST_F(AppearanceCommand, APresetOfMrValuesIsNotPutOnTheCt)
{
  json("appearance ear --source cochlea=t2 --source soft-tissue=t2 --tf cochlea=" +
       file("f.json", kTransfer));
  json("appearance ear --save-preset cochlea=of-mr --save-preset soft-tissue=soft-mr");
  json("appearance ear --source cochlea=ct --source soft-tissue=ct");
  json("appearance ear --save-preset cochlea=of-ct");
  std::map<std::string, nlohmann::json> valuesOf;
  const auto listed = json("appearance --presets");
  for (const auto& preset : listed["presets"])
    valuesOf[preset["name"]] = preset["values_of"];
  EXPECT_EQ(valuesOf.at("of-mr"), "mr");
  EXPECT_EQ(valuesOf.at("of-ct"), "ct");
  EXPECT_TRUE(valuesOf.at("skin").is_null());
  const auto before = libraryContent();
  expectRefused("appearance ear --set cochlea=of-mr", 3, "values of an MR");
  expectRefused("appearance ear --set ct=of-mr", 3, "values of an MR");
  expectRefused("appearance ear --set soft-tissue=soft-mr", 3, "values of an MR");
  expectRefused("appearance ear --set cochlea=of-ct --source cochlea=t2", 3, "values of a CT");
  EXPECT_EQ(libraryContent(), before);
  // What it reads may be said in the same command.
  json("appearance ear --set cochlea=of-mr --source cochlea=t2 --set soft-tissue=soft-mr "
       "--source soft-tissue=t2");
  EXPECT_EQ(part("cochlea")["preset"], "of-mr");
  EXPECT_EQ(part("cochlea")["source"], "t2");
  EXPECT_EQ(part("soft-tissue")["preset"], "soft-mr");
  EXPECT_EQ(part("soft-tissue")["source"], "t2");
  // Soft tissue goes back to the CT with a preset for it.
  json("appearance ear --set soft-tissue=of-ct");
  EXPECT_EQ(part("soft-tissue")["source"], "ct");
}

TEST_F(AppearanceCommand, AStructureMayBeCalledSoftTissue)
{
  json("new other --ct " + quoted(m_folder / "head.nrrd") +
       " --labels soft-tissue=" + quoted(m_folder / "cochlea.nrrd"));
  json("appearance other --warn soft-tissue=1.5 --flags ct:soft-tissue=shown");
  const auto list = json("appearance other --list");
  EXPECT_EQ(list["soft_tissue"]["name"], "ct:soft-tissue");
  EXPECT_EQ(list["soft_tissue"]["flags"], "shown");
  ASSERT_EQ(list["parts"][0]["name"], "soft-tissue");
  EXPECT_EQ(list["parts"][0]["warn_mm"], 1.5);
}

TEST_F(AppearanceCommand, PartsThatAreNoKnownStructureDifferInColour)
{
  json("appearance ear --set cochlea=other --set incus=other");
  std::set<nlohmann::json> colors;
  std::size_t unknown = 0;
  const auto list = json("appearance ear --list");
  for (const auto& part : list["parts"])
    if (part["preset"] == "other")
    {
      ++unknown;
      colors.insert(part["color"]);
    }
  EXPECT_EQ(unknown, 2u);
  EXPECT_EQ(colors.size(), unknown);
}

TEST_F(AppearanceCommand, RefusalsNameWhatIsWrongAndLeaveTheCase)
{
  const auto before = libraryContent();
  const std::string good = file("f.json", kTransfer);
  expectRefused("appearance ear --set zebra=nerve", 3, "zebra");
  expectRefused("appearance ear --set zebra=nerve", 3, "cochlea");
  expectRefused("appearance ear --set cochlea=zebra", 3, "bone-translucent");
  expectRefused("appearance ear --set ct=air-cells", 3, "lumen");
  const auto listed = [&](const std::string& part)
  { return run("appearance ear --set " + part + "=zebra").err.find("air-cells"); };
  EXPECT_NE(listed("cochlea"), std::string::npos);
  EXPECT_EQ(listed("ct"), std::string::npos) << "it would be refused";
  EXPECT_EQ(listed("soft-tissue"), std::string::npos);
  expectRefused("appearance ear --set cochlea", 2, "PART=");
  expectRefused("appearance ear --tf cochlea=" + quoted(m_folder / "no.json"), 3, "no.json");
  expectRefused("appearance ear --tf cochlea=" + file("bad.json", "{"), 3, "bad.json");
  expectRefused("appearance ear --tf cochlea=" +
                    file("odd.json", R"({"points":[{"value":1,"color":[0,0,0],"opacity":9}]})"),
                3, "odd.json: transfer function: point 1");
  expectRefused("appearance ear --tf incus=" + good, 3, "is a mesh");
  expectRefused("appearance ear --source incus=t2", 3, "is a mesh");
  expectRefused("appearance ear --source cochlea=t9", 3, "t2");
  expectRefused("appearance ear --color cochlea=255,0,0", 2, "0 to 1");
  expectRefused("appearance ear --color cochlea=#12345", 2, "#rrggbb");
  expectRefused("appearance ear --opacity cochlea=1.5", 2, "0 to 1");
  expectRefused("appearance ear --stiffness cochlea=0", 2, "rigid");
  expectRefused("appearance ear --stiffness cochlea=1000", 2, "0.001 to 100");
  expectRefused("appearance ear --stiffness cochlea=jelly", 2, "neither a number");
  expectRefused("appearance ear --stiffness ct=1", 3, "bone is rigid");
  expectRefused("appearance ear --warn cochlea=51", 2, "0 to 50 mm");
  expectRefused("appearance ear --warn cochlea=near", 2, "not a number");
  expectRefused("appearance ear --warn ct=1", 3, "bone");
  expectRefused("appearance ear --iso much", 2, "--iso");
  expectRefused("appearance ear --tissue cochlea=jelly", 3, "cortical-bone");
  expectRefused("appearance ear --tissue ct=nerve", 3, "density");
  expectRefused("appearance --list", 2, "CASE");
  expectRefused("appearance ear", 2, "nothing to do");
  EXPECT_EQ(libraryContent(), before);
}

TEST_F(AppearanceCommand, FindsBoneInAnImageWithoutHounsfieldUnits)
{
  json("new micro --ct " + quoted(writeMicroCt(m_folder / "micro.nrrd")));
  const auto outcome = run("appearance micro --iso auto --json");
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  const auto list = nlohmann::json::parse(outcome.out);
  // Halfway between air at 13000 and bone at 41000, within a quarter of the range.
  EXPECT_NEAR(list["iso_hu"].get<double>(), 27000.0, 7000.0);
  EXPECT_NEAR(list["dense_bone_hu"].get<double>(), 42000.0, 1500.0);
  EXPECT_NE(outcome.err.find("not in Hounsfield units"), std::string::npos) << outcome.err;
  // A dry bone has no soft tissue.
  EXPECT_TRUE(list["soft_tissue"]["estimate"].is_null());
  const auto text = run("appearance micro --list");
  EXPECT_NE(text.out.find("not known where the values of air end"), std::string::npos) << text.out;
  EXPECT_EQ(json("appearance ear --iso auto")["iso_hu"], 300.0) << "calibrated";
}
