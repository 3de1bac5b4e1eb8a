#include <string>
#include <utility>
#include <vector>

#include "CommandRunner.h"

using namespace petrous::testing;

namespace
{

// A block of bone of 20^3 voxels of 1 mm, and label maps on its grid.
class LabelsCommand : public CommandLine
{
protected:
  void SetUp() override
  {
    CommandLine::SetUp();
    put("ct.nrrd", "short", [](int i, int j, int k) { return i + j + k == 0 ? 701 : 700; });
    json("new ear --ct " + quoted(m_folder / "ct.nrrd"));
  }

  template <class Value>
  std::filesystem::path put(const std::string& name, const std::string& type,
                            const Value& value) const
  {
    std::filesystem::create_directories((m_folder / name).parent_path());
    std::ofstream file(m_folder / name, std::ios::binary);
    file << "NRRD0004\ntype: " << type << "\ndimension: 3\nspace: left-posterior-superior\n"
         << "sizes: 20 20 20\nspace directions: (1,0,0) (0,1,0) (0,0,1)\n"
         << "space origin: (0,0,0)\nspace units: \"mm\" \"mm\" \"mm\"\nencoding: raw\n"
         << "endian: little\n\n";
    for (int k = 0; k < 20; ++k)
      for (int j = 0; j < 20; ++j)
        for (int i = 0; i < 20; ++i)
        {
          const auto cell = static_cast<std::int16_t>(value(i, j, k));
          file.write(reinterpret_cast<const char*>(&cell), sizeof cell);
        }
    return m_folder / name;
  }

  static int slabs(int, int, int k) { return k < 3 ? 4 : k < 8 ? 7 : 0; }

  static std::string statusOf(const nlohmann::json& all, const std::string& name)
  {
    for (const auto& one : all["structures"])
      if (one["name"] == name)
        return one["status"].get<std::string>() + " " + std::to_string(one["voxels"].get<int>());
    return "none";
  }
};

} // namespace

TEST_F(LabelsCommand, SaysThatAnMrOfTheirGridTakesStructuresWithIt)
{
  const auto moved = [this](const std::filesystem::path& file) // half a millimetre to the left
  {
    std::string text = textOf(file);
    const std::string origin = "space origin: (0";
    text.insert(text.find(origin) + origin.size(), ".5");
    std::ofstream(file, std::ios::binary) << text;
    return file;
  };
  const auto labels =
      moved(put("nerve.nrrd", "short", [](int, int, int k) { return k < 3 ? 1 : 0; }));
  const auto mr = moved(put("mr.nrrd", "short", [](int i, int, int) { return i; }));
  json("add ear --labels " + quoted(labels));
  const Outcome outcome = run("add ear --mr t2=" + quoted(mr));
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_NE(outcome.err.find("nerve: has the grid of the MR 't2'"), std::string::npos)
      << outcome.err;
}

TEST_F(LabelsCommand, NamesTheIndicesByATableAndTellsWhatBecameOfEach)
{
  const auto labels = put("seg.nrrd", "short", slabs);
  std::ofstream(m_folder / "names.csv") << "index;name;color\n4;facial nerve;#ffff00\n"
                                           "7;sigmoid sinus;#0000ff\n9;cochlea;#00ff00\n";
  const auto added = json("add ear --labels " + quoted(labels) + " --label-names " +
                          quoted(m_folder / "names.csv"));
  EXPECT_EQ(statusOf(added, "facial nerve"), "read 1200");
  EXPECT_EQ(statusOf(added, "sigmoid sinus"), "read 2000");
  EXPECT_EQ(statusOf(added, "cochlea"), "empty 0");
  ASSERT_EQ(added["labels"].size(), 2U);
  EXPECT_EQ(added["labels"][0]["name"], "facial nerve");
  const Outcome again = run("add ear --labels " + quoted(labels) + " --label-names " +
                            quoted(m_folder / "names.csv") + " --rename-taken");
  EXPECT_NE(again.out.find("2 structures read, 1 empty\n"), std::string::npos) << again.out;

  std::ofstream(m_folder / "bad.csv") << "index,name\n4,a\n4,b\n";
  expectRefused("add ear --labels x=" + quoted(labels) + " --label-names " +
                    quoted(m_folder / "bad.csv"),
                3, "line 3");
  expectRefused("add ear --label-names " + quoted(m_folder / "names.csv"), 2, "--label-names");
  expectRefused("add ear --labels x=" + quoted(labels) + " --label-names " +
                    quoted(m_folder / "none.csv"),
                3, "none.csv");
}

TEST_F(LabelsCommand, MakesAMeshOfEachObjectOfAFileIfAsked)
{
  std::ofstream(m_folder / "ossicles.obj")
      << "v 5 5 5\nv 6 5 5\nv 5 6 5\nv 5 5 6\nv 9 5 5\nv 11 5 5\nv 9 7 5\nv 9 5 7\n"
         "o malleus\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n"
         "o incus\nf 5 7 6\nf 5 6 8\nf 5 8 7\nf 6 7 8\n";
  const std::string add = "add ear --mesh-frame lps --mesh-unit mm --mesh ";
  const std::string file = quoted(m_folder / "ossicles.obj");
  const Outcome whole = run(add + "whole=" + file);
  EXPECT_EQ(whole.code, 0) << whole.err;
  EXPECT_NE(whole.err.find("--mesh-parts"), std::string::npos) << whole.err;
  json(add + file + " --mesh-parts");
  json(add + "left=" + file + " --mesh-parts");
  const auto meshes = json("info ear")["meshes"];
  ASSERT_EQ(meshes.size(), 5U);
  const std::vector<std::pair<std::string, double>> expected{{"whole", 9.0 / 6.0},
                                                             {"malleus", 1.0 / 6.0},
                                                             {"incus", 8.0 / 6.0},
                                                             {"left malleus", 1.0 / 6.0},
                                                             {"left incus", 8.0 / 6.0}};
  for (std::size_t n = 0; n < expected.size(); ++n)
  {
    EXPECT_EQ(meshes[n]["name"], expected[n].first);
    EXPECT_NEAR(meshes[n]["volume_mm3"].get<double>(), expected[n].second, 1e-4);
  }
  expectRefused(add + file + " --mesh-parts", 4, "'malleus' and 'incus' are names");
  expectRefused("add ear --mesh-parts", 2, "--mesh-parts goes with --mesh");
}

TEST_F(LabelsCommand, LeavesOutStructuresWhoseNamesAreTakenIfAsked)
{
  put("masks/cochlea.nrrd", "short", [](int i, int, int) { return i < 5; });
  put("masks/incus.nrrd", "short", [](int i, int, int) { return i == 7; });
  const std::string add = "add ear --labels " + quoted(m_folder / "masks");
  json(add);
  put("masks/cochlea.nrrd", "short", [](int i, int, int) { return i < 6; });
  put("masks/stapes.nrrd", "short", [](int i, int, int) { return i == 9; });
  expectRefused(add, 4, "'cochlea' and 'incus' are names");
  expectRefused(add, 4, "--skip-taken");
  const auto added = json(add + " --skip-taken");
  EXPECT_EQ(statusOf(added, "cochlea"), "skipped 2400");
  EXPECT_EQ(statusOf(added, "stapes"), "read 400");
  const auto info = json("info ear")["labels"];
  ASSERT_EQ(info.size(), 3U);
  for (const auto& one : info)
    EXPECT_EQ(one["voxels"], one["name"] == "cochlea" ? 2000 : 400) << "as they were";
  expectRefused("add ear --skip-taken --mesh x.obj", 2, "--labels");
}

TEST_F(LabelsCommand, GivesStructuresWhoseNamesAreTakenOtherOnes)
{
  put("masks/cochlea.nrrd", "short", [](int i, int, int) { return i < 5; });
  put("masks/incus.nrrd", "short", [](int i, int, int) { return i == 7; });
  const std::string add = "add ear --labels " + quoted(m_folder / "masks");
  json(add);
  put("masks/stapes.nrrd", "short", [](int i, int, int) { return i == 9; });
  expectRefused(add, 4, "--rename-taken");
  expectRefused(add + " --skip-taken --rename-taken", 2, "exclude");
  expectRefused(add + " --rename cochlea", 2, "OLD=NEW");
  const auto added = json(add + " --rename-taken --rename 'incus=anvil'");
  EXPECT_EQ(statusOf(added, "cochlea 2"), "read 2000");
  EXPECT_EQ(statusOf(added, "anvil"), "read 400");
  EXPECT_EQ(statusOf(added, "stapes"), "read 400");
  EXPECT_EQ(json("info ear")["labels"].size(), 5U);
  // A file of one structure.
  const std::string one = "add ear --labels incus=" + quoted(m_folder / "masks/incus.nrrd");
  expectRefused(one, 4, "give it another name");
  EXPECT_EQ(statusOf(json(one + " --rename-taken"), "incus 2"), "read 400");
}

TEST_F(LabelsCommand, TakesARegionOfAnMr)
{
  const auto mr =
      put("mr.nrrd", "short", [](int i, int j, int k) { return i + 20 * (j + 20 * k); });
  const auto added =
      json("add ear --mr t2=" + quoted(mr) + " --mr-roi 3,8,4,9,5,9"); // voxels of 1 mm from 0
  EXPECT_EQ(added["mr"][0]["dims"], nlohmann::json({6, 6, 5}));
  EXPECT_EQ(added["mr"][0]["origin_mm"], nlohmann::json({3.0, 4.0, 5.0}));
  expectRefused("add ear --mr x=" + quoted(mr) + " --mr-roi 100,110,0,5,0,5", 3, "mr.nrrd");
  expectRefused("add ear --mr x=" + quoted(mr) + " --mr-roi 3,8", 2, "--mr-roi");
  expectRefused("add ear --labels x=" + quoted(mr) + " --mr-roi 3,8,4,9,5,9", 2, "--mr");
}

TEST_F(LabelsCommand, TakesAFolderOfMasksAndNoPatientsNameFromIt)
{
  put("masks/MUELLER_cochlea.nrrd", "short", [](int i, int, int) { return i < 5; });
  put("masks/MUELLER_facial_nerve_left.nrrd", "short", [](int i, int, int) { return i > 12; });
  put("masks/MUELLER_frobnicle.nrrd", "short", [](int i, int, int) { return i == 7; });
  put("masks/MUELLER_incus.nrrd", "short", [](int, int, int) { return 0; });
  std::ofstream(m_folder / "masks" / "notes.txt") << "not a mask";
  const auto added = json("add ear --labels " + quoted(m_folder / "masks"));
  EXPECT_EQ(statusOf(added, "cochlea"), "read 2000");
  EXPECT_EQ(statusOf(added, "facial_nerve_left"), "read 2800");
  EXPECT_EQ(statusOf(added, "frobnicle"), "read 400");
  EXPECT_EQ(json("info ear")["labels"].size(), 3U);
  for (const auto& [name, content] : libraryContent())
    EXPECT_EQ(content.find("MUELLER"), std::string::npos) << name;
}
