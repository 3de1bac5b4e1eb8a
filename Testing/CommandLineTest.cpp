#include <algorithm>
#include <array>
#include <cmath>
#include <csignal>
#include <cstring>
#include <fstream>
#include <map>
#include <regex>
#include <set>
#include <sstream>
#include <vector>

#include <fcntl.h>
#include <spawn.h>
#include <sys/stat.h>

#include "DicomValidator.h"

using namespace petrous::testing;

namespace
{

constexpr double kPi = 3.14159265358979323846;

// A cube of bone, 30 mm wide around (-35, 0, 0), in air; written as plain NRRD.
std::filesystem::path writeBone(const std::filesystem::path& folder)
{
  constexpr int n = 100;
  std::vector<std::int16_t> voxels(n * n * n, -1000);
  for (int k = 25; k < 75; ++k)
    for (int j = 25; j < 75; ++j)
      for (int i = 25; i < 75; ++i)
        voxels[static_cast<std::size_t>(i + n * (j + n * k))] = 1500;
  const auto path = folder / "bone.nrrd";
  std::ofstream file(path, std::ios::binary);
  file << "NRRD0004\ntype: short\ndimension: 3\nspace: left-posterior-superior\n"
          "sizes: 100 100 100\nspace directions: (0.6,0,0) (0,0.6,0) (0,0,0.6)\n"
          "kinds: domain domain domain\nendian: little\nencoding: raw\n"
          "space origin: (-64.7,-29.7,-29.7)\n\n";
  file.write(reinterpret_cast<const char*>(voxels.data()),
             static_cast<std::streamsize>(voxels.size() * 2));
  return path;
}

} // namespace

TEST_F(CommandLine, GoesFromThePhantomToADrilledSavedCase)
{
  makePatient();
  const auto patient = m_folder / "patient";
  const auto scan = json("scan " + quoted(patient / "ct"));
  ASSERT_EQ(scan["series"].size(), 1u);
  EXPECT_EQ(scan["series"][0]["verdict"], "ok");
  EXPECT_EQ(scan["series"][0]["dims"], (std::vector<int>{64, 64, 60}));

  json("new ear --ct " + quoted(patient / "ct") + " --mr " + quoted(patient / "mr") + " --labels " +
       quoted(patient / "labels.seg.nrrd"));
  const auto info = json("info ear");
  EXPECT_EQ(info["ct"]["dims"], (std::vector<int>{64, 64, 60}));
  EXPECT_GT(info["labels"].size(), 5u);
  EXPECT_EQ(info["mr"][0]["registered"], false);
  EXPECT_EQ(info["dissection"]["strokes"], 0);
  const auto truth = nlohmann::json::parse(textOf(patient / "truth.json"));
  for (const auto& structure : truth["structures"])
    for (const auto& label : info["labels"])
    {
      // A structure much larger than the 1 mm voxels, so that counting voxels measures its volume.
      if (label["name"] != structure["name"] || structure["volume_mm3"] < 1000.0)
        continue;
      EXPECT_NEAR(label["volume_mm3"].get<double>() / structure["volume_mm3"].get<double>(), 1.0,
                  0.1)
          << label["name"];
    }
  EXPECT_EQ(json("library list")["cases"][0]["name"], "ear");
}

TEST_F(CommandLine, DrillsASphereOfTheRightVolumeAndTakesItBack)
{
  json("new bone --ct " + quoted(writeBone(m_folder)));
  const auto path = writePath({-38, 0, 0}, {-32, 0, 0});
  const auto drilled = json("drill bone --path " + quoted(path));
  const double truth = 4.0 / 3.0 * kPi * 8.0 + kPi * 4.0 * 6.0;
  EXPECT_EQ(drilled["strokes"], 1);
  EXPECT_EQ(drilled["ticks"], 1001);
  EXPECT_NEAR(drilled["removed_mm3"].get<double>() / truth, 1.0, 0.02);
  for (const auto& [name, bytes] : drilled["resources"].items())
    for (const std::string family : {"labels.", "mr.", "devices.", "registration."})
      EXPECT_NE(name.rfind(family, 0), 0u) << name;

  EXPECT_EQ(json("undo bone")["steps"], 1);
  EXPECT_EQ(json("info bone")["dissection"]["removed_mm3"], 0.0);
  EXPECT_EQ(json("undo bone")["steps"], 0);
  EXPECT_EQ(json("redo bone 5")["steps"], 1);
  EXPECT_NEAR(json("info bone")["dissection"]["removed_mm3"].get<double>(),
              drilled["removed_mm3"].get<double>(), 1e-9);
  const auto history = json("history bone");
  ASSERT_EQ(history["strokes"].size(), 1u);
  EXPECT_EQ(history["strokes"][0]["diameter_mm"], 4.0);
}

TEST_F(CommandLine, RendersTheSamePixelsInAFreshProcess)
{
  json("new bone --ct " + quoted(writeBone(m_folder)));
  const auto render = [this](const std::string& name)
  {
    const auto result =
        json("render bone --size 160x120 --out " + quoted(m_folder / name) + " --view lateral");
    EXPECT_EQ(result["size"], (std::vector<int>{160, 120}));
    for (const auto& [resource, bytes] : result["resources"].items())
      for (const std::string family : {"labels.", "mr.", "devices.", "registration."})
        EXPECT_NE(resource.rfind(family, 0), 0u) << resource;
    return textOf(m_folder / name);
  };
  const auto whole = render("a.png");
  EXPECT_TRUE(render("b.png") == whole);
  json("drill bone --path " + quoted(writePath({-50, 0, 0}, {-45, 3, 3})) + " --diameter 6");
  const auto drilled = render("c.png");
  EXPECT_FALSE(drilled == whole);
  json("undo bone");
  EXPECT_TRUE(render("d.png") == whole);
  json("redo bone");
  EXPECT_TRUE(render("e.png") == drilled);
}

TEST_F(CommandLine, KeepsApproachesSideBySide)
{
  json("new bone --ct " + quoted(writeBone(m_folder)));
  const auto drill = [this](const std::array<double, 3>& at, const std::string& options)
  {
    const auto path = writePath(at, {at[0] + 2.0, at[1], at[2]});
    return json("drill bone --mode 3dof --path " + quoted(path) + options)["removed_mm3"]
        .get<double>();
  };
  const double first = drill({-35, 0, 0}, "");
  const double second = drill({-35, 8, 0}, "");
  json("undo bone");
  const double other = drill({-35, 0, 8}, " --diameter 5"); // keeps the second, set aside
  json("branch bone 'from above' --from 1");
  const double above = drill({-35, -8, 0}, "");

  const auto info = json("info bone")["dissection"];
  EXPECT_EQ(info["branch"], "from above");
  EXPECT_EQ(info["strokes"], 4);
  EXPECT_EQ(info["undo"], 2);
  EXPECT_EQ(info["redo"], 0);
  EXPECT_DOUBLE_EQ(info["removed_mm3"], first + above);
  const auto both = json("branch bone --compare main main~1");
  EXPECT_EQ(both["common_strokes"], 1);
  EXPECT_DOUBLE_EQ(both["compare"][0]["removed_mm3"], first + other);
  EXPECT_DOUBLE_EQ(both["compare"][1]["removed_mm3"], first + second);
  EXPECT_NEAR(both["compare"][0]["tissue_mm3"].get<double>(), first + other, 0.01 * first);
  EXPECT_NEAR(both["compare"][0]["only_mm3"].get<double>() + both["both_mm3"].get<double>(),
              both["compare"][0]["tissue_mm3"].get<double>(), 1e-6);
  EXPECT_GT(both["both_mm3"], 0.0) << "the first stroke";
  const auto picture = m_folder / "difference.png";
  EXPECT_NE(run("branch bone --compare main main~1 --out " + quoted(picture)).out.find("main~1"),
            std::string::npos);
  EXPECT_EQ(textOf(picture).substr(1, 3), "PNG");
  expectRefused("branch bone main --out x.png", 2, "--compare");

  // The voxels are those of the current branch.
  const auto mask = [this](const std::string& branch)
  {
    json("branch bone '" + branch + "'");
    json("export bone --what mask --out " + quoted(m_folder / "mask.nrrd"));
    return textOf(m_folder / "mask.nrrd");
  };
  const std::string there = mask("from above");
  EXPECT_NE(mask("main"), there);
  EXPECT_EQ(mask("from above"), there);

  const auto history = json("history bone");
  ASSERT_EQ(history["branches"].size(), 3u);
  EXPECT_EQ(history["strokes"][3]["parent"], 1);
  EXPECT_TRUE(history["strokes"][3]["done"]);
  EXPECT_FALSE(history["strokes"][1]["done"]);
  json("branch bone main~1 --rename deep");
  EXPECT_EQ(json("branch bone deep --delete")["strokes"], 3);

  const auto before = libraryContent();
  expectRefused("branch bone nowhere --from 9", 3, "has 2 strokes");
  expectRefused("branch bone main --from 1", 3, "there already");
  expectRefused("branch bone 'from above' --delete", 3, "present");
  expectRefused("branch bone --compare main deep", 3, "there are: main, from above");
  expectRefused("branch bone main --rename 'from above'", 3, "there already");
  expectRefused("branch bone", 2, "NAME");
  expectRefused("branch bone x --list", 2, "NAME");
  expectRefused("branch bone x --from 1 --delete", 2, "one of");
  EXPECT_EQ(libraryContent(), before);
}

TEST_F(CommandLine, ProbesTheFieldThatIsDrilled)
{
  json("new bone --ct " + quoted(writeBone(m_folder)));
  std::ofstream(m_folder / "points.csv") << "x_mm,y_mm,z_mm\n-35,0,0\n-35,0,20\n900,0,0\n";
  const std::string probe = "probe bone --points " + quoted(m_folder / "points.csv");
  auto points = json(probe)["points"];
  ASSERT_EQ(points.size(), 3u);
  EXPECT_GT(points[0]["f"], 0.0);
  EXPECT_EQ(points[0]["hu"], 1500.0);
  EXPECT_LT(points[1]["f"], 0.0);
  // The surface is where -1000 + 2500 w = 300, w = 0.52 of the voxel between 14.7 and 15.3.
  EXPECT_NEAR(points[1]["distance_mm"].get<double>(), 20.0 - (15.3 - 0.6 * 0.52), 0.02);
  EXPECT_NEAR(points[1]["normal"][2].get<double>(), 1.0, 1e-3);
  EXPECT_TRUE(points[2]["hu"].is_null());
  json("drill bone --path " + quoted(writePath({-35, 0, 0}, {-34, 0, 0})));
  points = json(probe)["points"];
  EXPECT_LT(points[0]["f"], 0.0);
  EXPECT_NEAR(points[0]["distance_mm"].get<double>(), 2.0, 0.03);
  EXPECT_EQ(run(probe + " --out " + quoted(m_folder / "o.csv")).code, 0);
  EXPECT_EQ(textOf(m_folder / "o.csv").rfind("x_mm,y_mm,z_mm,f,hu,structure,distance_mm", 0), 0u);
}

TEST_F(CommandLine, ExportsWhatOtherProgramsOpen)
{
  makePatient();
  const auto patient = m_folder / "patient";
  json("new ear --ct " + quoted(patient / "ct") + " --mr " + quoted(patient / "mr") + " --labels " +
       quoted(patient / "labels.seg.nrrd"));
  for (const std::string file : {"ct.nrrd", "mr.nii.gz", "labels.seg.nrrd", "mask.nrrd",
                                 "dissected.nii.gz", "surface.stl", "surface.obj"})
  {
    const std::string what = file.substr(0, file.find('.'));
    EXPECT_EQ(json("export ear --what " + what + " --out " + quoted(m_folder / file))["what"],
              what);
    EXPECT_GT(std::filesystem::file_size(m_folder / file), 500u) << file;
  }
  // Exported files can be imported again, voxel by voxel.
  json("new again --ct " + quoted(m_folder / "ct.nrrd") + " --labels " +
       quoted(m_folder / "labels.seg.nrrd"));
  const auto a = json("info ear");
  const auto b = json("info again");
  EXPECT_EQ(a["ct"]["min"], b["ct"]["min"]);
  EXPECT_EQ(a["ct"]["max"], b["ct"]["max"]);
  EXPECT_EQ(a["labels"].size(), b["labels"].size());
}

TEST_F(CommandLine, ExportsSeriesThatComeBackToTheBit)
{
  makePatient();
  const auto patient = m_folder / "patient";
  json("new ear --ct " + quoted(patient / "ct") + " --mr " + quoted(patient / "mr"));
  const auto ct = json("info ear")["ct"];
  std::array<double, 3> from{};
  std::array<double, 3> to{};
  for (std::size_t a = 0; a < 3; ++a)
  {
    from[a] = ct["origin_mm"][a].get<double>() + 30.0;
    to[a] = from[a] + (a == 0 ? 4.0 : 0.0);
  }
  ASSERT_EQ(run("drill ear --path " + quoted(writePath(from, to))).code, 0);
  std::map<std::string, nlohmann::json> series;
  for (const std::string what : {"ct", "mr", "dissected"})
  {
    const auto folder = m_folder / (what + "-series");
    const auto told = json("export ear --what " + what + " --out " + quoted(folder / ""));
    json("export ear --what " + what + " --out " + quoted(m_folder / (what + ".nii")));
    json("new again-" + what + " --ct " + quoted(folder));
    json("export again-" + what + " --what ct --out " + quoted(m_folder / "again.nii"));
    const auto again = m_folder / ("again-" + what);
    json("export again-" + what + " --what ct --out " + quoted(again / ""));
    EXPECT_EQ(json("scan " + quoted(again))["series"][0]["modality"], what == "mr" ? "MR" : "CT");
    const std::string sent = textOf(m_folder / (what + ".nii"));
    const std::string back = textOf(m_folder / "again.nii");
    ASSERT_EQ(sent.size(), back.size()) << what;
    EXPECT_TRUE(sent.compare(352, sent.npos, back, 352, back.npos) == 0) << what;
    const auto scan = json("scan " + quoted(folder))["series"];
    ASSERT_EQ(scan.size(), 1U) << what;
    EXPECT_EQ(scan[0]["verdict"], "ok") << scan[0]["findings"];
    EXPECT_EQ(scan[0]["modality"], what == "mr" ? "MR" : "CT");
    EXPECT_EQ(told["instances"], scan[0]["slices"]);
    series[what] = scan[0];
    const auto info = json("info again-" + what)["ct"];
    const auto was = what == "mr" ? nlohmann::json() : ct;
    for (const char* key : {"origin_mm", "spacing_mm", "direction"})
      for (std::size_t n = 0; !was.is_null() && n < was[key].size(); ++n)
        EXPECT_NEAR(info[key][n].get<double>(), was[key][n].get<double>(), 1e-6) << what << key;
    for (const auto& file : std::filesystem::directory_iterator(folder))
    {
      const std::string bytes = textOf(file.path());
      EXPECT_EQ(bytes.find("Phantom"), bytes.npos) << "nothing of the source's patient";
      EXPECT_EQ(bytes.find("20200101"), bytes.npos) << "no date";
      EXPECT_NE(bytes.find("DERIVED\\SECONDARY"), bytes.npos);
    }
  }
  EXPECT_NE(series["ct"]["uid"], series["dissected"]["uid"]);
  EXPECT_NE(textOf(m_folder / "ct.nii"), textOf(m_folder / "dissected.nii"));
  // Once more: the same files; a folder that holds something is left alone.
  json("export ear --what ct --out " + quoted(m_folder / "twice/deep/"));
  EXPECT_EQ(json("scan " + quoted(m_folder / "twice"))["series"][0]["uid"], series["ct"]["uid"]);
  expectRefused("export ear --what ct --out " + quoted(m_folder / "twice/deep"), 4, "not empty");
  expectRefused("export ear --what labels --out " + quoted(m_folder / "x/"), 3, ".nrrd");
  expectRefused("export ear --what ct --on-ct --out " + quoted(m_folder / "x.nrrd"), 2, "--on-ct");
}

// An image that is linear in space is sampled without error.
TEST_F(CommandLine, ExportsAnMrOnTheGridOfTheCt)
{
  const int n = 40;
  std::ofstream(m_folder / "mr.nrrd", std::ios::binary)
      << "NRRD0004\ntype: float\ndimension: 3\nspace: left-posterior-superior\nsizes: 40 40 40\n"
         "space directions: (1.5,0,0) (0,2,0) (0,0,1)\nkinds: domain domain domain\n"
         "endian: little\nencoding: raw\nspace origin: (-60,-40,-20)\n\n";
  std::ofstream voxels(m_folder / "mr.nrrd", std::ios::binary | std::ios::app);
  const auto value = [](double x, double y, double z) { return 1000.5 + 3.0 * x - 2.0 * y + z; };
  for (int k = 0; k < n; ++k)
    for (int j = 0; j < n; ++j)
      for (int i = 0; i < n; ++i)
      {
        const auto v = static_cast<float>(value(-60.0 + 1.5 * i, -40.0 + 2.0 * j, -20.0 + k));
        voxels.write(reinterpret_cast<const char*>(&v), sizeof v);
      }
  voxels.close();
  json("new bone --ct " + quoted(writeBone(m_folder)) + " --mr " + quoted(m_folder / "mr.nrrd"));
  const std::string name = json("info bone")["mr"][0]["name"];
  const std::string command = "export bone --what mr --on-ct --out " + quoted(m_folder / "on.nii");
  expectRefused(command, 3, "register");
  // x_mr = -y_ct + 2, y_mr = x_ct + 3, z_mr = z_ct - 1
  std::ofstream(m_folder / "turn.json")
      << R"({"transform":[0,-1,0,2, 1,0,0,3, 0,0,1,-1, 0,0,0,1]})";
  json("register bone --mr " + name + " --as-is --transform " + quoted(m_folder / "turn.json"));
  json(command);
  const std::string bytes = textOf(m_folder / "on.nii");
  const auto ct = json("info bone")["ct"];
  const auto at = [&ct](const char* key, int a) { return ct[key][a].get<double>(); };
  std::size_t offset = 352;
  int inside = 0;
  for (int k = 0; k < ct["dims"][2]; ++k)
    for (int j = 0; j < ct["dims"][1]; ++j)
      for (int i = 0; i < ct["dims"][0]; ++i, offset += sizeof(float))
      {
        const double x = -(at("origin_mm", 1) + j * at("spacing_mm", 1)) + 2.0;
        const double y = at("origin_mm", 0) + i * at("spacing_mm", 0) + 3.0;
        const double z = at("origin_mm", 2) + k * at("spacing_mm", 2) - 1.0;
        if (x < -60.0 || x > -1.5 || y < -40.0 || y > 38.0 || z < -20.0 || z > 19.0)
          continue;
        ++inside;
        float v = 0.0F;
        std::memcpy(&v, bytes.data() + offset, sizeof v);
        ASSERT_NEAR(v, value(x, y, z), 1e-3) << i << ' ' << j << ' ' << k;
      }
  EXPECT_GT(inside, 1000);
  EXPECT_EQ(offset, bytes.size());
  // As a series it has a rescale slope, and what that costs is told.
  const auto series = run("export bone --what mr --on-ct --out " + quoted(m_folder / "s/"));
  EXPECT_EQ(series.code, 0) << series.err;
  EXPECT_NE(series.err.find("rescale slope; they are off by up to"), std::string::npos);
}

TEST_F(CommandLine, ExportsAStructureAsAClosedSurface)
{
  makePatient();
  const auto patient = m_folder / "patient";
  json("new ear --ct " + quoted(patient / "ct") + " --labels " +
       quoted(patient / "labels.seg.nrrd"));
  const nlohmann::json info = json("info ear");
  for (const nlohmann::json& label : info["labels"])
    for (const char* ending : {".stl", ".obj", ".ply"})
    {
      const nlohmann::json told =
          json("export ear --what structure --part '" + label["name"].get<std::string>() +
               "' --out " + quoted(m_folder / (std::string("part") + ending)));
      EXPECT_EQ(told["closed"], true) << label["name"];
      EXPECT_EQ(told["decimation"], "none");
      const double wanted = label["volume_mm3"];
      EXPECT_NEAR(told["volume_mm3"].get<double>(), wanted, 0.01 * wanted) << label["name"];
      EXPECT_EQ(told["voxels_mm3"], label["volume_mm3"]);
      const std::string named = textOf(m_folder / (std::string("part") + ending));
      json("export ear --what structure '" + label["name"].get<std::string>() + "' --out " +
           quoted(m_folder / (std::string("named") + ending)));
      EXPECT_TRUE(textOf(m_folder / (std::string("named") + ending)) == named);
    }
  EXPECT_EQ(json("export ear --what surface --out " + quoted(m_folder / "all.stl"))["closed"],
            true);
  expectRefused("export ear --what structure --out " + quoted(m_folder / "x.stl"), 2, "--part");
  expectRefused("export ear --what structure --part nobody --out " + quoted(m_folder / "x.stl"), 3,
                "no structure");
}

/// What another program prints; empty if it fails or is not there.
std::string answerOf(const std::string& command)
{
  std::string answer;
  if (FILE* pipe = ::popen((command + " 2>&1").c_str(), "r"))
  {
    std::array<char, 4096> buffer{};
    while (const std::size_t got = std::fread(buffer.data(), 1, buffer.size(), pipe))
      answer.append(buffer.data(), got);
    ::pclose(pipe);
  }
  return answer;
}

TEST_F(CommandLine, ExportsASegmentationThatBelongsToTheSeries)
{
  makePatient();
  const auto patient = m_folder / "patient";
  json("new ear --ct " + quoted(patient / "ct") + " --mr " + quoted(patient / "mr") + " --labels " +
       quoted(patient / "labels.seg.nrrd"));
  const auto seg = m_folder / "seg.dcm";
  const auto told = json("export ear --what labels --out " + quoted(seg));
  json("export ear --what ct --out " + quoted(m_folder / "ct/"));
  const auto labels = json("info ear")["labels"];
  EXPECT_EQ(told["segments"], labels.size());

  // each instance that it refers to is a file of the series, in the same study and frame
  const std::string bytes = textOf(seg);
  std::size_t instances = 0;
  for (const auto& file : std::filesystem::directory_iterator(m_folder / "ct"))
  {
    const std::string slice = textOf(file.path());
    const auto uid = [&slice](const std::string& tag) // explicit VR: tag, "UI", length, value
    {
      const std::size_t at = slice.find(tag + "UI", 132);
      EXPECT_NE(at, slice.npos);
      const auto size = static_cast<unsigned char>(slice[at + 6]);
      return slice.substr(at + 8, size);
    };
    for (const std::string& tag : {std::string("\x08\0\x18\0", 4), std::string("\x20\0\x0d\0", 4),
                                   std::string("\x20\0\x0e\0", 4), std::string("\x20\0\x52\0", 4)})
      EXPECT_NE(bytes.find(uid(tag)), bytes.npos) << file.path();
    ++instances;
  }
  EXPECT_EQ(instances, json("info ear")["ct"]["dims"][2]);
  EXPECT_EQ(bytes.find("Phantom"), bytes.npos) << "nothing of the source's patient";

  // It comes back to the bit: written once more from what was read, on the CT's grid.
  json("new again --ct " + quoted(m_folder / "ct") + " --labels " + quoted(seg));
  const auto back = json("info again")["labels"];
  ASSERT_EQ(back.size(), labels.size());
  for (std::size_t n = 0; n < labels.size(); ++n)
  {
    EXPECT_EQ(back[n]["name"], labels[n]["name"]);
    EXPECT_NEAR(back[n]["volume_mm3"].get<double>(), labels[n]["volume_mm3"].get<double>(),
                1e-6 * labels[n]["volume_mm3"].get<double>());
  }
  json("export ear --what labels --out " + quoted(m_folder / "a.nii"));
  json("export again --what labels --on-ct --out " + quoted(m_folder / "b.nii"));
  const std::string a = textOf(m_folder / "a.nii");
  const std::string b = textOf(m_folder / "b.nii");
  ASSERT_EQ(a.size(), b.size());
  EXPECT_TRUE(a.compare(352, a.npos, b, 352, b.npos) == 0);

  // the same file at another time; one structure alone is another file
  json("export ear --what labels --out " + quoted(m_folder / "twice.dcm"));
  EXPECT_TRUE(textOf(m_folder / "twice.dcm") == bytes);
  json("export ear --what labels --part '" + labels[0]["name"].get<std::string>() + "' --out " +
       quoted(m_folder / "one.dcm"));
  EXPECT_FALSE(textOf(m_folder / "one.dcm") == bytes);
  expectRefused("export ear --what ct --out " + quoted(m_folder / "ct.dcm"), 3, ".nrrd");
  expectRefused("export ear --what mask --on-ct --out " + quoted(m_folder / "x.nrrd"), 2,
                "--on-ct");

  // It belongs to the case that wrote it, without @ct.
  expectRefused("add ear --labels " + quoted(seg), 4, "in the case already");
  EXPECT_EQ(json("add ear --labels back=" + quoted(seg))["labels"].size(), 2 * labels.size());

  if (!answerOf("/usr/bin/python3 -c 'import pydicom, numpy'").empty())
    GTEST_SKIP() << "pydicom is not there to count the voxels";
  std::ofstream(m_folder / "count.py") << R"(
import sys, numpy, pydicom
data = pydicom.dcmread(sys.argv[1])
bits = numpy.unpackbits(numpy.frombuffer(data.PixelData, numpy.uint8), bitorder='little')
size = data.Rows * data.Columns
counts = {s.SegmentLabel: 0 for s in data.SegmentSequence}
names = {s.SegmentNumber: s.SegmentLabel for s in data.SegmentSequence}
for n, frame in enumerate(data.PerFrameFunctionalGroupsSequence):
    number = frame.SegmentIdentificationSequence[0].ReferencedSegmentNumber
    counts[names[number]] += int(bits[n * size:(n + 1) * size].sum())
for name, count in counts.items():
    print(name, count, sep=':', end=';')
)";
  std::string wanted;
  for (const auto& label : labels) // voxels of 1 mm
    wanted += label["name"].get<std::string>() + ":" +
              std::to_string(std::lround(label["volume_mm3"].get<double>())) + ";";
  EXPECT_EQ(answerOf("/usr/bin/python3 " + quoted(m_folder / "count.py") + " " + quoted(seg)),
            wanted);

  if (!hasDicomValidator())
    GTEST_SKIP() << kNoDicomValidator;
  json("export ear --what mr --out " + quoted(m_folder / "mr/"));
  json("export ear --what dissected --out " + quoted(m_folder / "dissected/"));
  for (const char* file :
       {"seg.dcm", "one.dcm", "ct/slice-0001.dcm", "mr/slice-0001.dcm", "dissected/slice-0001.dcm"})
    EXPECT_EQ(expectValidDicom(m_folder / file, m_folder / "dciodvfy.txt"), 1U);
  const std::string together =
      answerOf("dcentvfy " + quoted(seg) + " " + quoted(m_folder / "ct") + "/*.dcm");
  EXPECT_EQ(together.find("Error"), together.npos) << together;
}

// Label maps on two grids go into one file only on the CT's.
TEST_F(CommandLine, ExportsLabelsOfSeveralGridsOnTheGridOfTheCt)
{
  json("new bone --ct " + quoted(writeBone(m_folder)));
  const auto ct = json("info bone")["ct"];
  const auto map = [&](const std::string& name, const std::string& grid, std::size_t voxels)
  {
    std::ofstream(m_folder / name, std::ios::binary)
        << "NRRD0004\ntype: uchar\ndimension: 3\nspace: left-posterior-superior\n"
        << grid << "kinds: domain domain domain\nencoding: raw\n\n"
        << std::string(voxels, '\1');
    return quoted(m_folder / name);
  };
  const std::string at = std::to_string(ct["origin_mm"][0].get<double>() + 3.0) + "," +
                         std::to_string(ct["origin_mm"][1].get<double>() + 3.0) + "," +
                         std::to_string(ct["origin_mm"][2].get<double>() + 3.0);
  json("new ear --ct " + quoted(m_folder / "bone.nrrd") + " --labels " +
       map("nerve.nrrd",
           "sizes: 8 8 8\nspace directions: (1,0,0) (0,1,0) (0,0,1)\nspace origin: (" + at + ")\n",
           512) +
       " --labels " +
       map("vein.nrrd",
           "sizes: 9 12 5\nspace directions: (0.8,0,0) (0,0.8,0) (0,0,1.2)\nspace origin: (" + at +
               ")\n",
           540));
  expectRefused("export ear --what labels --out " + quoted(m_folder / "x.dcm"), 2, "--on-ct");
  const auto told = json("export ear --what labels --on-ct --out " + quoted(m_folder / "x.dcm"));
  EXPECT_EQ(told["segments"], 2);
  json("new again --ct " + quoted(m_folder / "bone.nrrd") + " --labels " +
       quoted(m_folder / "x.dcm"));
  const auto back = json("info again")["labels"];
  ASSERT_EQ(back.size(), 2U) << "both, though they overlap";
  // The same in two layers, which come back alike; a format of one layer says what it leaves out.
  EXPECT_EQ(
      json("export ear --what labels --on-ct --out " + quoted(m_folder / "x.seg.nrrd"))["layers"],
      2);
  json("new layered --ct " + quoted(m_folder / "bone.nrrd") + " --labels " +
       quoted(m_folder / "x.seg.nrrd"));
  const auto layered = json("info layered")["labels"];
  ASSERT_EQ(layered.size(), 2U);
  for (std::size_t n = 0; n < 2; ++n)
    for (const char* key : {"name", "volume_mm3"})
      EXPECT_EQ(layered[n][key], back[n][key]);
  const petrous::testing::Outcome flat =
      run("export ear --what labels --on-ct --out " + quoted(m_folder / "x.nii.gz"));
  EXPECT_EQ(flat.code, 0);
  EXPECT_NE(flat.err.find("voxels are not written"), std::string::npos) << flat.err;
  // NIfTI has no names: they lie beside it, and are found there.
  json("new named --ct " + quoted(m_folder / "bone.nrrd") + " --labels " +
       quoted(m_folder / "x.nii.gz"));
  const auto named = json("info named")["labels"];
  ASSERT_EQ(named.size(), 2U);
  for (std::size_t n = 0; n < 2; ++n)
    EXPECT_EQ(named[n]["name"], back[n]["name"]);
  EXPECT_NEAR(back[0]["volume_mm3"].get<double>(), 512.0, 0.1 * 512.0);
  EXPECT_NEAR(back[1]["volume_mm3"].get<double>(), 540 * 0.768, 0.15 * 540 * 0.768);
}

TEST_F(CommandLine, DecimatesASurfaceAndSaysHowFarItLies)
{
  json("new ear --ct " + quoted(writeBone(m_folder)));
  const auto whole = json("export ear --what surface --out " + quoted(m_folder / "a.ply"));
  const auto fewer =
      json("export ear --what surface --triangles 400 --out " + quoted(m_folder / "b.ply"));
  EXPECT_EQ(fewer["closed"], true);
  EXPECT_LE(fewer["triangles"], 400);
  EXPECT_GE(fewer["triangles"], 12);
  EXPECT_EQ(fewer["decimation"]["triangles_before"], whole["triangles"]);
  const double error = fewer["decimation"]["hausdorff_mm"];
  EXPECT_GT(error, 0.0);
  EXPECT_LT(error, 0.6) << "a voxel";
  EXPECT_NEAR(fewer["volume_mm3"].get<double>(), whole["volume_mm3"].get<double>(),
              0.01 * whole["volume_mm3"].get<double>());
  EXPECT_NE(textOf(m_folder / "b.ply").find("property uchar red"), std::string::npos);
  EXPECT_EQ(json("export ear --what surface --triangles 9999999 --out " +
                 quoted(m_folder / "c.ply"))["decimation"],
            "none");
  expectRefused("export ear --what ct --triangles 9 --out " + quoted(m_folder / "x.nrrd"), 2,
                "--triangles");
}

TEST_F(CommandLine, CropsToARegionOnLoad)
{
  json("new part --ct " + quoted(writeBone(m_folder)) + " --roi -40,-30,-5,5,-5,5");
  const auto info = json("info part");
  EXPECT_LE(info["ct"]["dims"][0], 19);
  EXPECT_EQ(info["ct"]["min"], 1500.0);
  expectRefused("new far --ct " + quoted(m_folder / "bone.nrrd") + " --roi 500,510,0,9,0,9", 3,
                "bone.nrrd");
  expectRefused("new far --ct " + quoted(m_folder / "bone.nrrd") + " --roi 5,1,0,9,0,9", 2,
                "--roi");
}

TEST_F(CommandLine, RefusesATiltedScanInWordsAndRepairsItOnRequest)
{
  makePatient("--dims 32,32,40 --spacing 2 --tilt 18.5");
  const auto scan = json("scan " + quoted(m_folder / "patient/ct"));
  EXPECT_EQ(scan["series"][0]["verdict"], "repairable");
  EXPECT_EQ(scan["series"][0]["findings"][0]["kind"], "gantry-tilt");
  EXPECT_GT(scan["series"][0]["findings"][0]["error_mm"], 5.0);
  expectRefused("new ear --ct " + quoted(m_folder / "patient/ct"), 3, "tilt");
  EXPECT_TRUE(libraryContent().empty());
  const auto info = json("new ear --repair --ct " + quoted(m_folder / "patient/ct"));
  EXPECT_NE(info["ct"]["notes"].dump().find("18.5 degrees"), std::string::npos) << info["ct"];
  EXPECT_EQ(json("info ear")["ct"]["notes"], info["ct"]["notes"]);
  // Labels of another program on the stack as it lies in the files.
  std::ofstream labels(m_folder / "vein.nrrd", std::ios::binary);
  labels << "NRRD0004\ntype: uchar\ndimension: 3\nspace: left-posterior-superior\n"
         << "sizes: 4 4 4\nspace directions: (3,0,0) (0,3,0) (0,0,3)\n"
         << "space origin: (-40.3,0,0)\nencoding: raw\nendian: little\n\n"
         << std::string(64, '\1');
  labels.close();
  const std::string add = "add ear --labels " + quoted(m_folder / "vein.nrrd");
  expectRefused(add, 3, "--labels-as-they-lie");
  EXPECT_TRUE(json("info ear")["labels"].empty());
  json(add + " --labels-as-they-lie");
  EXPECT_EQ(json("info ear")["labels"].size(), 1U);
  EXPECT_NE(json("info ear")["labels"].dump().find("which was repaired"), std::string::npos);
  expectRefused("new none --labels-as-they-lie --repair --ct " + quoted(m_folder / "patient/ct"), 2,
                "--labels-as-they-lie goes with --labels");
}

TEST_F(CommandLine, RefusesBadInputInOneLineAndLeavesTheLibrary)
{
  json("new bone --ct " + quoted(writeBone(m_folder)));
  const auto before = libraryContent();
  const auto folder = [this](const std::string& name)
  {
    std::filesystem::create_directories(m_folder / name);
    return m_folder / name;
  };
  const auto empty = folder("empty");
  const auto photos = folder("photos");
  for (const char* name : {"a.jpg", "b.jpg"})
    std::ofstream(photos / name) << "\xFF\xD8\xFF\xE0 no picture of a patient";
  expectRefused("scan " + quoted(empty), 3, "empty");
  expectRefused("new a --ct " + quoted(empty), 3, "empty");
  expectRefused("new a --ct " + quoted(photos), 3, "photos");
  expectRefused("new a --ct " + quoted(m_folder / "missing"), 3, "missing");
  expectRefused("new bone --ct " + quoted(m_folder / "bone.nrrd"), 4, "bone");
  expectRefused("new a/b --ct " + quoted(m_folder / "bone.nrrd"), 3, "case name");
  std::filesystem::copy_file(m_folder / "bone.nrrd", m_folder / "short.nrrd");
  std::filesystem::resize_file(m_folder / "short.nrrd", 100000);
  expectRefused("new a --ct " + quoted(m_folder / "short.nrrd"), 3, "short.nrrd");
  expectRefused("info zebra", 3, "zebra");
  expectRefused("add bone --labels " + quoted(m_folder / "missing.nrrd"), 3, "missing.nrrd");
  expectRefused("remove bone --part nerve", 3, "nerve");
  std::ofstream(m_folder / "bad.csv") << "t_s,x_mm\n0,0\n";
  expectRefused("drill bone --path " + quoted(m_folder / "bad.csv"), 3, "bad.csv");
  expectRefused("render bone --out " + quoted(m_folder / "no/such/folder.png") + " --size 64x48", 4,
                "folder.png");
  EXPECT_EQ(libraryContent(), before);
}

TEST_F(CommandLine, WrongUsageExitsWithTwo)
{
  expectRefused("zebra", 2, "zebra");
  expectRefused("new", 2, "CASE");
  expectRefused("render x --out a.png --size big", 2, "--size");
  expectRefused("send x", 2, "--to");
  expectRefused("library zebra", 2, "rename A B");
  expectRefused("library rename a", 2, "library rename A B");
  const auto help = run("--help");
  EXPECT_EQ(help.code, 0);
  EXPECT_NE(help.out.find("receive"), std::string::npos);
  EXPECT_NE(help.out.find("render"), std::string::npos);
}

// The parser would read 010 as 8, 0x10 as 16, and the largest number for a larger one.
TEST_F(CommandLine, NumbersArePlainDecimal)
{
  makePatient("--dims 24,24,24 --spacing 2.5");
  json("new ear --ct " + quoted(m_folder / "patient/ct"));
  expectRefused("branch ear other --from 010", 3, "has 0 strokes, not 10");
  const std::string out = quoted(m_folder / "none");
  const std::string picture = "render ear --out " + quoted(m_folder / "a.png");
  for (const std::string bad :
       {"0x10", "1e1", "-1", "1.5", "nan", "inf", "' 1'", "1,5", "99999999999999999999"})
  {
    const std::string words = "must be a whole number within ";
    expectRefused("undo ear " + (bad == "-1" ? "-- -1" : bad), 2, words + "1 to 2147483647");
    expectRefused("branch ear other --from=" + bad, 2, words + "0 to 2147483647");
    expectRefused("sample " + out + " --seed=" + bad, 2, words + "0 to 18446744073709551615");
    expectRefused("register ear --mr T2 --seed=" + bad, 2, words + "0 to 4294967295");
    expectRefused(picture + " --size=" + bad + "x64", 2, "8 to 8192 pixels");
  }
  expectRefused("redo ear 0", 2, "1 to 2147483647");
  EXPECT_EQ(json(picture + " --engine reference --size 010x0016")["size"],
            nlohmann::json({10, 16}));
  for (const char* bad : {"0x1", "1,5", "' 1'"})
  {
    for (const char* option : {" --spacing=", " --noise=", " --tilt="})
      expectRefused("sample " + out + option + bad, 2, "is not a number");
    for (const char* option : {" --convergence=", " --eye-separation="})
      expectRefused(picture + " --stereo anaglyph" + option + bad, 2, "is not a number");
  }
  for (const char* bad : {"nan", "inf", "-inf", "1e39", "-1e39"})
  {
    for (const char* option : {" --spacing=", " --noise=", " --tilt="})
      expectRefused("sample " + out + option + bad, 2, "must lie within");
    for (const char* option : {" --convergence=", " --eye-separation="})
      expectRefused(picture + " --stereo anaglyph" + option + bad, 2, "must lie within");
  }
  expectRefused("sample " + out + " --dims 24,24,1025", 2, "16 to 1024, not 1025");
  expectRefused(picture + " --stereo anaglyph --eye-separation 100 --convergence 10", 2,
                "eyes converge at 10 mm");
  EXPECT_FALSE(std::filesystem::exists(m_folder / "none"));
}

TEST_F(CommandLine, AppearanceSetsThresholdAndFlags)
{
  makePatient();
  json("new ear --ct " + quoted(m_folder / "patient/ct") + " --labels " +
       quoted(m_folder / "patient/labels.seg.nrrd"));
  const std::string name = json("info ear")["labels"][0]["name"];
  json("appearance ear --iso 450 --flags '" + name + "=shown'");
  const auto list = json("appearance ear --list");
  EXPECT_EQ(list["iso_hu"], 450.0);
  EXPECT_EQ(list["parts"][0]["flags"], "shown");
  expectRefused("appearance ear --flags zebra=shown", 3, "zebra");
  expectRefused("appearance ear --flags '" + name + "=loud'", 3, "loud");
}

TEST_F(CommandLine, TakesOptionsBeforeAndAfterTheCase)
{
  makePatient("--dims 40,40,40 --spacing 1.5");
  const auto labels = m_folder / "patient/labels";
  json("new --ct " + quoted(m_folder / "patient/ct") + " --labels " +
       quoted(labels / "cochlea.nii.gz") +
       " --labels inner=" + quoted(labels / "vestibule.nii.gz") + " ear");
  EXPECT_EQ(json("info ear")["labels"].size(), 2u);
  json("remove --part inner ear");
  EXPECT_EQ(json("info ear")["labels"][0]["name"], "cochlea");
}

TEST_F(CommandLine, SampleIsTheSameForTheSameSeed)
{
  for (const std::string name : {"a", "b"})
    ASSERT_EQ(run("sample " + quoted(m_folder / name) + " --dims 24,24,24 --spacing 2.5").code, 0);
  for (const auto& entry : std::filesystem::recursive_directory_iterator(m_folder / "a"))
    if (entry.is_regular_file())
    {
      const auto other = m_folder / "b" / std::filesystem::relative(entry.path(), m_folder / "a");
      EXPECT_EQ(textOf(entry.path()), textOf(other)) << other;
    }
  expectRefused("sample " + quoted(m_folder / "a"), 4, "a");
}

TEST_F(CommandLine, ReferenceEngineWritesDepthAlongEachRay)
{
  json("new bone --ct " + quoted(writeBone(m_folder)));
  std::ofstream(m_folder / "camera.json")
      << R"({"position_mm":[-135,0,0],"focal_point_mm":[-35,0,0],"view_up":[0,0,1],"view_angle_deg":30})";
  json("render bone --engine reference --size 33x33 --camera " + quoted(m_folder / "camera.json") +
       " --out " + quoted(m_folder / "r.png") + " --depth " + quoted(m_folder / "d.npy"));
  const std::string npy = textOf(m_folder / "d.npy");
  ASSERT_EQ(npy.substr(1, 5), "NUMPY");
  const std::size_t data = npy.size() - 33 * 33 * 4;
  float middle = 0;
  std::memcpy(&middle, npy.data() + data + 4 * (33 * 16 + 16), 4);
  EXPECT_NEAR(middle, 100.0 - (15.3 - 0.6 * 0.52), 0.01);
  float corner = 0;
  std::memcpy(&corner, npy.data() + data, 4);
  EXPECT_TRUE(std::isnan(corner));
}

// From --help: each subcommand, and each of its options with a value.
TEST_F(CommandLine, AnEmptyValueIsNeverAnAbsentOption)
{
  const auto matches = [](const std::string& text, const char* pattern)
  {
    std::vector<std::string> found;
    const std::regex expression(pattern);
    std::istringstream lines(text);
    std::smatch match;
    for (std::string line; std::getline(lines, line);)
      if (std::regex_search(line, match, expression))
        found.push_back(match[1]);
    return found;
  };
  const std::string help = run("--help").out;
  int tried = 0;
  for (const std::string& command :
       matches(help.substr(help.find("Subcommands:")), "^  ([a-z][a-z-]*) "))
    for (const std::string& option :
         matches(run(command + " --help").out, "^  (--[a-z-]+) (?!Excludes:|Needs:)[^ ]"))
    {
      expectRefused(command + " " + option + " ''", 2, option + ": the value is empty");
      expectRefused(command + " " + option + "= x", 2, option + ": the value is empty");
      ++tried;
    }
  EXPECT_GT(tried, 70);
  expectRefused("info ''", 2, "CASE: the value is empty");
  expectRefused("info '  '", 2, "CASE: the value is empty");
  expectRefused("library search ''", 2, "library search: the value is empty");
  // All but this one, which goes back to the usual folder.
  ::setenv("XDG_CONFIG_HOME", (m_folder / "settings").c_str(), 1);
  ::setenv("XDG_DATA_HOME", (m_folder / "data").c_str(), 1);
  EXPECT_EQ(run("library folder " + quoted(m_folder / "chosen")).code, 0);
  EXPECT_TRUE(std::filesystem::exists(m_folder / "settings/petrous/library"));
  EXPECT_EQ(json("library folder ''")["library"], (m_folder / "data/petrous").string());
  EXPECT_FALSE(std::filesystem::exists(m_folder / "settings/petrous/library"));
  ::unsetenv("XDG_CONFIG_HOME");
  ::unsetenv("XDG_DATA_HOME");
  for (const std::string list :
       {"--part ,", "--part=,", "--part 'pairs,'", "--edge ,", "--edge '24, ,32'", "--edge=,24"})
    expectRefused("bench renderer --quick --out x " + list, 2, "a value of its list is empty");
  expectRefused("register ear --mr T2 --init landmarks ''", 2, "--init: the value is empty");
  expectRefused("register ear --mr T2 --sign-off --quiet", 2, "missing before '--quiet'");
  expectRefused("appearance ear --set ct=", 2, "'ct=' is empty on one side");
  expectRefused("new ear --ct x --mr =y", 2, "'=y' is empty on one side");
}

// Another program may have named its file so.
TEST_F(CommandLine, AListedNameDoesNotTurnItsLineAround)
{
  makePatient();
  json("new ear --ct " + quoted(m_folder / "patient/ct"));
  std::ofstream(library() / "cases/ear\u202eknab.json") << "{";
  const auto outcome = run("library list");
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_EQ(outcome.out.find("\u202e"), std::string::npos);
  EXPECT_NE(outcome.out.find("ear\ufffdknab"), std::string::npos) << outcome.out;
}

// Nor does a terminal obey it, whatever malformed character stands before.
TEST_F(CommandLine, ATerminalObeysNothingThatIsPrinted)
{
  makePatient();
  json("new ear --ct " + quoted(m_folder / "patient/ct"));
  const std::string name = "ear\xe2"
                           "A\x1b[2J\xc2\x9b"
                           "31m";
  std::ofstream(library() / "cases" / (name + ".json")) << "{";
  for (const std::string& arguments :
       {std::string("library list"), std::string("library verify"), "info '" + name + "'",
        "library delete '" + name + "'", "scan '/nowhere/" + name + "'"})
  {
    const auto outcome = run(arguments);
    const std::string all = outcome.out + outcome.err;
    EXPECT_FALSE(all.empty()) << arguments;
    EXPECT_EQ(all.find('\x1b'), std::string::npos) << arguments << ": " << all;
    EXPECT_EQ(all.find("\xc2\x9b"), std::string::npos) << arguments << ": " << all;
  }
  // JSON escapes controls below a blank alone by itself.
  const std::string cell = "/nowhere/\xc2\x9b"
                           "31m\u202e\x7f";
  std::ofstream(m_folder / "table.csv") << "name,folder\n" << cell << "," << cell << "\n";
  for (const std::string& arguments :
       {std::string("library list"), "info '" + name + "'", "new other --ct '" + cell + "'",
        "batch --progress " + quoted(m_folder / "table.csv")})
  {
    const auto outcome = run(arguments + " --json");
    EXPECT_FALSE(outcome.out.empty()) << arguments;
    for (const char* const hidden : {"\xc2\x9b", "\u202e", "\x7f", "\x1b"})
      EXPECT_EQ((outcome.out + outcome.err).find(hidden), std::string::npos)
          << arguments << ": " << outcome.out << outcome.err;
  }
  // What is read is the same.
  const auto answer = nlohmann::json::parse(run("new other --ct '" + cell + "' --json").out);
  EXPECT_NE(answer["error"]["text"].get<std::string>().find("\xc2\x9b"
                                                            "31m\u202e\x7f"),
            std::string::npos);
}

TEST_F(CommandLine, HelpAndGuideSayTheSameOfExitCodes)
{
  std::string help = run("--help").out; // as one line
  std::replace(help.begin(), help.end(), '\n', ' ');
  std::istringstream guide(
      textOf(std::filesystem::path(PETROUS_SOURCE) / "Documentation/user-guide.md"));
  std::string line;
  while (std::getline(guide, line) && line != "| exit code | meaning |")
    ;
  std::getline(guide, line);
  std::set<int> codes;
  while (std::getline(guide, line) && line.rfind("| ", 0) == 0)
  {
    const std::size_t bar = line.find(" | ");
    ASSERT_NE(bar, line.npos) << line;
    const std::string code = line.substr(2, bar - 2);
    codes.insert(std::stoi(code));
    std::string meaning = line.substr(bar + 3, line.rfind(" |") - bar - 3);
    meaning.resize(std::min(meaning.find_first_of(":;"), meaning.size())); // what the table adds
    EXPECT_NE(help.find(" " + code + " " + meaning), help.npos) << meaning << "\n" << help;
  }
  EXPECT_EQ(codes, (std::set<int>{0, 1, 2, 3, 4, 130}));
}

TEST_F(CommandLine, PipesAndDevicesAreRefusedAtOnce)
{
  makePatient();
  json("new ear --ct " + quoted(m_folder / "patient/ct"));
  const auto pipe = m_folder / "pipe";
  ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
  ASSERT_EQ(::mkfifo((library() / "cases/pipe.json").c_str(), 0600), 0);
  const auto before = std::filesystem::file_size(library() / "cases/ear.json");
  const std::string out = " --out " + quoted(m_folder / "a.png");
  for (const std::string& file : {quoted(pipe), std::string("/dev/zero"), quoted(m_folder)})
    for (const std::string& arguments :
         {"drill ear --path " + file, "drill ear --replay " + file, "probe ear --points " + file,
          "render ear --size 32x32 --camera " + file + out, "appearance ear --tf ct=" + file})
    {
      const auto outcome = run(arguments);
      EXPECT_EQ(outcome.code, 3) << arguments << ": " << outcome.err;
      EXPECT_NE(outcome.err.find(file == quoted(m_folder) ? "is a folder" : "regular file"),
                std::string::npos)
          << outcome.err;
    }
  EXPECT_TRUE(json("library list")["cases"][1]["damaged"]);
  expectRefused("info pipe", 3, "named pipe");
  json("library delete pipe");
  EXPECT_EQ(json("library list")["cases"].size(), 1u);
  EXPECT_EQ(std::filesystem::file_size(library() / "cases/ear.json"), before);
  // Nor does output replace one.
  expectRefused("probe ear --points " + quoted(writePath({0, 0, 0}, {1, 0, 0})) + " --out " +
                    quoted(pipe),
                4, "regular file");
  for (const std::string option : {"--log ", "--record "})
    EXPECT_NE(run("drill ear --path " + quoted(m_folder / "path.csv") + " " + option + quoted(pipe))
                  .err.find("regular file"),
              std::string::npos)
        << option;
  EXPECT_TRUE(std::filesystem::is_fifo(pipe));
}

TEST_F(CommandLine, OutputsReplaceNeitherInputsNorTheLibrary)
{
  makePatient("--dims 24,24,24 --spacing 2.5");
  json("new ear --ct " + quoted(m_folder / "patient/ct"));
  std::ofstream(m_folder / "points.csv") << "x_mm,y_mm,z_mm\n0,0,0\n";
  const auto path = writePath({-50, 0, 0}, {-48, 0, 0});
  std::filesystem::create_symlink(path, m_folder / "link.csv");
  const std::string written = textOf(path);
  const auto manifest = library() / "cases/ear.json";
  std::filesystem::path object;
  for (const auto& entry : std::filesystem::directory_iterator(library() / "objects"))
    object = entry.path();
  const auto before = libraryContent();
  const std::string drill = "drill ear --path " + quoted(path);
  for (const std::string option : {" --log ", " --record "})
  {
    expectRefused(drill + option + quoted(manifest), 4, "keeps its own data there");
    expectRefused(drill + option + quoted(path), 4, "is also read by this command");
    expectRefused(drill + option + quoted(m_folder / "link.csv"), 4, "is also read");
    expectRefused(drill + option + quoted(m_folder / "patient/../path.csv"), 4, "is also read");
  }
  const std::string twice = quoted(m_folder / "a.csv");
  expectRefused(drill + " --log " + twice + " --record " + twice, 4, "named for two outputs");
  expectRefused("probe ear --points " + quoted(m_folder / "points.csv") + " --out " +
                    quoted(m_folder / "points.csv"),
                4, "is also read");
  expectRefused("export ear --what ct --out " + quoted(object), 4, "keeps its own data there");
  EXPECT_EQ(textOf(path), written);
  EXPECT_EQ(libraryContent(), before);
  EXPECT_FALSE(std::filesystem::exists(m_folder / "a.csv"));

  // Whatever lies in a library once all that it keeps is there.
  json("nodes add pacs --host localhost --port 4242 --aet PACS");
  json("appearance ear --save-preset bone=mine");
  json("describe ear --thumbnail");
  std::filesystem::create_directory(library() / "recordings");
  json(drill + " --record " + quoted(library() / "recordings/a.ticks"));
  std::vector<std::filesystem::path> own;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(library()))
    if (entry.is_regular_file())
      own.push_back(entry.path());
  for (const char* name : {"nodes.json", ".nodes.lock", "presets.json", ".presets.lock", "salt",
                           "recordings/a.ticks", "library.sqlite"})
    EXPECT_EQ(std::count(own.begin(), own.end(), library() / name), 1) << name;
  for (const auto& file : own)
  {
    const std::string content = textOf(file);
    expectRefused("archive ear " + quoted(file), 4, "keeps its own data there");
    EXPECT_EQ(textOf(file), content) << file;
  }
  json("export ear --what ct --out " + quoted(library() / "mine.nrrd"));
}

TEST_F(CommandLine, OutputsReplaceNoFileThatACaseWasMadeFrom)
{
  makePatient("--dims 24,24,24 --spacing 2.5");
  json("new ear --ct " + quoted(m_folder / "patient/ct") + " --labels " +
       quoted(m_folder / "patient/labels.seg.nrrd"));
  const auto labels = m_folder / "patient/labels.seg.nrrd";
  const std::string content = textOf(labels);
  expectRefused("export ear --what labels --out " + quoted(labels), 4, "a case was made from");
  EXPECT_EQ(textOf(labels), content);
  for (const auto& entry : std::filesystem::directory_iterator(m_folder / "patient/ct"))
  {
    const std::string slice = textOf(entry.path());
    expectRefused("archive ear " + quoted(entry.path()), 4, "a case was made from");
    EXPECT_EQ(textOf(entry.path()), slice);
  }
  // What a command wrote itself is replaced.
  for (int n = 0; n < 2; ++n)
    json("export ear --what ct --out " + quoted(m_folder / "patient/ct/mine.nrrd"));
  json("new copy --ct " + quoted(m_folder / "patient/ct/mine.nrrd"));
  expectRefused("export ear --what ct --out " + quoted(m_folder / "patient/ct/mine.nrrd"), 4,
                "a case was made from");
  // A DICOM series does not come among other files.
  expectRefused("export ear --what ct --out " + quoted(m_folder / "patient/ct/"), 4, "not empty");
}

TEST_F(CommandLine, ALibraryIsAFolderThatCanBeThere)
{
  std::ofstream(m_folder / "file") << "x";
  const std::string file = quoted(m_folder / "file");
  const std::string nowhere = quoted(m_folder / "none/library");
  for (const std::string command : {"library list", "info ear", "nodes list", "library verify"})
  {
    expectRefused(command + " --library " + file, 3, "file: is a file; a library is a folder");
    expectRefused(command + " --library " + nowhere, 3, "none is not there");
  }
  EXPECT_FALSE(std::filesystem::exists(m_folder / "none"));
}

TEST_F(CommandLine, AddTellsOnlyWhatIsNew)
{
  makePatient();
  json("new ear --ct " + quoted(m_folder / "patient/ct"));
  // Named after the file: which is noted, as it may be a patient's.
  const auto labels = m_folder / "patient/labels";
  std::filesystem::copy(labels / "incus.nii.gz", m_folder / "Doe Jane.nii.gz");
  std::filesystem::copy(labels / "stapes.nii.gz", m_folder / "Roe Rick.nii.gz");
  const auto notices = [this](const std::string& file)
  {
    const std::string told = run("add ear --labels " + quoted(m_folder / file)).err;
    return std::count(told.begin(), told.end(), '\n');
  };
  const auto first = notices("Doe Jane.nii.gz");
  EXPECT_GT(first, 0);
  EXPECT_EQ(notices("Roe Rick.nii.gz"), first);
}

TEST_F(CommandLine, ACaseWhoseFileWasChangedOutsideOpensAndSaysSo)
{
  makePatient("--dims 24,24,24 --spacing 2.5");
  json("new ear --ct " + quoted(m_folder / "patient/ct"));
  EXPECT_EQ(json("info ear").count("notices"), 0U);
  const auto manifest = library() / "cases/ear.json";
  std::string text = textOf(manifest);
  const std::size_t at = text.find("\"iso_hu\": ");
  ASSERT_NE(at, text.npos);
  char& digit = text[at + 10];
  digit = digit == '1' ? '2' : '1';
  std::ofstream(manifest, std::ios::binary) << text;
  const auto info = run("info ear --json");
  EXPECT_EQ(info.code, 0);
  EXPECT_NE(info.err.find("does not have the checksum that it states"), std::string::npos);
  EXPECT_EQ(nlohmann::json::parse(info.out)["notices"].size(), 1U);
  EXPECT_EQ(run("library verify").code, 3);
  EXPECT_EQ(run("library list --accept-changed").code, 2);
  json("library repair");
  EXPECT_EQ(run("library verify").code, 3) << "it is kept only where that is wanted";
  json("library repair --accept-changed");
  EXPECT_EQ(run("library verify").code, 0);
  EXPECT_EQ(json("info ear").count("notices"), 0U);
}

TEST_F(CommandLine, CasesAreRenamedCopiedAndDeleted)
{
  makePatient();
  json("new ear --ct " + quoted(m_folder / "patient/ct"));
  json("library copy ear 'left ear'");
  EXPECT_EQ(run("library copy ear -- spare").code, 0);
  EXPECT_EQ(run("library delete -- spare").code, 0);
  json("library undelete spare");
  json("library delete spare");
  expectRefused("library copy ear 'ear\u202e'", 3, "not seen");
  json("library rename ear 'right ear'");
  EXPECT_EQ(json("info 'right ear'")["case"], "right ear");
  json("appearance 'left ear' --iso 500");
  EXPECT_NE(json("appearance 'right ear' --list")["iso_hu"], 500.0);
  expectRefused("library rename 'left ear' 'right ear'", 4, "is there already");
  expectRefused("library delete ear", 3, "no case 'ear'");
  // Manually, as a technician would.
  std::filesystem::copy(library() / "cases/left ear.json", library() / "cases/by hand.json");
  json("appearance 'by hand' --iso 600");
  EXPECT_EQ(json("appearance 'left ear' --list")["iso_hu"], 500.0);
  EXPECT_EQ(json("library search EAR")["cases"].size(), 2u);
  EXPECT_EQ(json("library gc")["removed"], 0);
  for (const std::string name : {"by hand", "left ear", "right ear"})
    json("library delete '" + name + "'");
  EXPECT_EQ(json("library deleted")["cases"][0]["name"], "right ear");
  json("library undelete 'right ear'");
  EXPECT_EQ(json("info 'right ear'")["case"], "right ear");
  expectRefused("library undelete 'right ear'", 3, "no deleted case");
  json("library delete 'right ear'");
  const auto collected = json("library gc");
  EXPECT_EQ(collected["cases"], 3);
  EXPECT_GT(collected["removed"], 0);
  EXPECT_TRUE(json("library deleted")["cases"].empty());
  EXPECT_TRUE(json("library verify")["damaged"].empty());
  EXPECT_TRUE(json("library list")["cases"].empty());
  EXPECT_TRUE(std::filesystem::is_empty(library() / "objects"));
}

TEST_F(CommandLine, FailuresAreJsonToo)
{
  json("new bone --ct " + quoted(writeBone(m_folder)));
  const auto failure = [this](const std::string& arguments, int code)
  {
    const auto outcome = run(arguments);
    EXPECT_EQ(outcome.code, code) << arguments << ": " << outcome.err;
    const auto object = nlohmann::json::parse(outcome.out, nullptr, false);
    EXPECT_TRUE(object.is_object()) << arguments << ": " << outcome.out;
    if (!object.is_object())
      return nlohmann::json{};
    EXPECT_EQ(object["schema_version"], 1);
    EXPECT_EQ(object["error"]["exit_code"], code);
    EXPECT_EQ(outcome.err, "petrous: " + object["error"]["text"].get<std::string>() + "\n");
    return object["error"]["kind"];
  };
  EXPECT_EQ(failure("info zebra --json", 3), "bad-input");
  EXPECT_EQ(failure("--json info zebra", 3), "bad-input");
  EXPECT_EQ(failure("new bone --json --ct " + quoted(m_folder / "bone.nrrd"), 4), "refused");
  EXPECT_EQ(failure("zebra --json", 2), "usage");
  EXPECT_EQ(failure("info --json", 2), "usage");
  EXPECT_EQ(failure("info bone --loud --json", 2), "usage");
  EXPECT_EQ(json("info bone")["schema_version"], 1);
}

TEST_F(CommandLine, SharedOptionsMayStandBeforeTheSubcommand)
{
  json("new bone --ct " + quoted(writeBone(m_folder)));
  const auto elsewhere = m_folder / "elsewhere";
  EXPECT_EQ(
      run("--library " + quoted(elsewhere) + " new bone --ct " + quoted(m_folder / "bone.nrrd"))
          .code,
      0);
  EXPECT_TRUE(std::filesystem::exists(elsewhere / "cases" / "bone.json"));
  const auto before = run("--json --library " + quoted(elsewhere) + " info bone");
  EXPECT_EQ(before.code, 0) << before.err;
  EXPECT_EQ(before.out, run("info bone --json --library " + quoted(elsewhere)).out);
  expectRefused("--library " + quoted(elsewhere) + " zebra", 2, "unknown subcommand 'zebra'");
}

TEST_F(CommandLine, HelpIsAWordToo)
{
  EXPECT_EQ(run("help").out, run("--help").out);
  EXPECT_EQ(run("help drill").out, run("drill --help").out);
  EXPECT_EQ(run("help drill").code, 0);
  EXPECT_NE(run("help").out.find("130 interrupted"), std::string::npos);
  EXPECT_NE(run("help drill").out.find("4 refused"), std::string::npos);
  expectRefused("help zebra", 2, "zebra");
}

TEST_F(CommandLine, StrictScanWantsEverySeriesSound)
{
  makePatient("--dims 32,32,40 --spacing 2");
  EXPECT_EQ(run("scan --strict " + quoted(m_folder / "patient/ct")).code, 0);
  makeSample(m_folder / "tilted", "--dims 32,32,40 --spacing 2 --tilt 18.5");
  const std::string tilted = quoted(m_folder / "tilted/ct");
  EXPECT_EQ(run("scan " + tilted).code, 0);
  const auto strict = run("scan --json --strict " + tilted);
  EXPECT_EQ(strict.code, 3);
  EXPECT_NE(strict.err.find("1 of 1 series not ok"), std::string::npos) << strict.err;
  // stdout contains exactly one object, the answer.
  EXPECT_EQ(nlohmann::json::parse(strict.out)["series"][0]["verdict"], "repairable");
}

// The voxels are written here: 100 times the volume and their number in it.
TEST_F(CommandLine, TakesAVolumeOfAFourDimensionalFile)
{
  std::string voxels;
  for (int volume = 1; volume <= 3; ++volume)
    for (int v = 0; v < 4 * 3 * 5; ++v)
    {
      const auto value = static_cast<std::int16_t>(100 * volume + v);
      voxels.append(reinterpret_cast<const char*>(&value), sizeof value);
    }
  const auto file = m_folder / "run.nrrd";
  std::ofstream(file, std::ios::binary)
      << "NRRD0004\ntype: short\ndimension: 4\nspace: left-posterior-superior\nsizes: 4 3 5 3\n"
         "space directions: (1,0,0) (0,2,0) (0,0,3) none\nkinds: domain domain domain time\n"
         "endian: little\nencoding: raw\nspace origin: (7,8,9)\n\n"
      << voxels;
  for (const auto& path : {file, m_folder})
  {
    const auto scan = json("scan " + quoted(path));
    ASSERT_EQ(scan["images"].size(), 1U);
    EXPECT_EQ(scan["images"][0]["volumes"], 3);
    EXPECT_EQ(scan["images"][0]["dims"], (std::vector<int>{4, 3, 5}));
    EXPECT_NE(run("scan " + quoted(path)).out.find("volumes '1' to '3'"), std::string::npos);
  }
  expectRefused("new none --ct " + quoted(file), 3, "--volume N");
  expectRefused("new none --ct " + quoted(file) + " --volume 4", 3, "volumes 1 to 3");
  expectRefused("new none --ct " + quoted(file) + " --volume first", 3, "one of 1 to 3");
  const auto info = json("new two --modality CT --ct " + quoted(file) + " --volume 2 --mr late=" +
                         quoted(std::filesystem::path(file.string() + "##3")));
  EXPECT_EQ(info["ct"]["min"], 200.0) << info;
  EXPECT_EQ(info["ct"]["max"], 259.0) << info;
  EXPECT_NE(info["mr"][0]["notes"].dump().find("of which this is number 3"), std::string::npos)
      << info;
}

// Of voxels of 500, the file says nothing more: half a millimetre in micrometres.
TEST_F(CommandLine, ScanSaysInWhichUnitTheGridIsWhereNoneMakesSense)
{
  const auto write = [this](const std::string& name, const std::string& unit)
  {
    std::ofstream(m_folder / name, std::ios::binary)
        << "NRRD0004\ntype: short\ndimension: 3\nspace: left-posterior-superior\nsizes: 4 3 8\n"
           "space directions: (500,0,0) (0,500,0) (0,0,500)\nendian: little\nencoding: raw\n"
        << unit << "space origin: (0,0,0)\n\n"
        << std::string(2 * 4 * 3 * 8, '\0');
    return m_folder / name;
  };
  const auto none = json("scan " + quoted(write("none.nrrd", "")))["images"][0];
  EXPECT_EQ(none["unit_unclear"], true);
  EXPECT_EQ(none["unit_mm"], 1.0);
  EXPECT_EQ(none["unit_stated"], false);
  EXPECT_EQ(none["spacing_mm"][0], 500.0);
  EXPECT_NE(none["units_likely_mm"].dump().find("0.001"), std::string::npos) << none;
  const std::filesystem::path stated = write("m.nrrd", "space units: \"m\" \"m\" \"m\"\n");
  std::string text = run("scan " + quoted(m_folder / "none.nrrd")).out;
  EXPECT_NE(text.find("this is in mm, as it states no unit: 4000 mm long"), std::string::npos)
      << text;
  const auto metres = json("scan " + quoted(stated))["images"][0];
  EXPECT_EQ(metres["unit_unclear"], true) << "no voxel is 500 m large";
  EXPECT_EQ(metres["unit_stated"], true);
  EXPECT_NE(run("new far --ct " + quoted(stated)).code, 0);
  const auto micro =
      json("scan " + quoted(write("um.nrrd", "space units: \"um\" \"um\" \"um\"\n")));
  EXPECT_EQ(micro["images"][0]["unit_unclear"], false);
  EXPECT_FALSE(micro["images"][0].contains("unit_mm"));
}

TEST_F(CommandLine, OptionsThatDecideNothingAreWrongUsage)
{
  makePatient("--dims 32,32,30 --spacing 2.0");
  const std::string ct = " --ct " + quoted(m_folder / "patient/ct");
  const std::string labels = " --labels " + quoted(m_folder / "patient/labels.seg.nrrd");
  expectRefused("new none --ct-unit um" + ct, 2, "--ct-unit goes with a CT file of voxels");
  expectRefused("new none --mr-unit um --mr " + quoted(m_folder / "patient/mr") + ct, 2,
                "--mr-unit goes with MR files of voxels");
  json("new ear" + ct);
  expectRefused("add ear --bits stored" + labels, 2, "--bits goes with --mr");
  json("add ear" + labels);
  json("export ear --what labels --out " + quoted(m_folder / "seg.dcm"));
  expectRefused("new none --labels-unit um --labels " + quoted(m_folder / "seg.dcm") + ct, 2,
                "--labels-unit goes with label files");
}

TEST_F(CommandLine, SaysWhichStructuresLieWithTheSlices)
{
  makePatient("--dims 32,32,30 --spacing 2.0");
  const auto patient = m_folder / "patient";
  const auto of = [](const nlohmann::json& scan, const std::string& name)
  {
    for (const auto& one : scan["parts"])
      if (one["paths"].at(0).get<std::string>().find(name) != std::string::npos)
        return one;
    return nlohmann::json();
  };
  const auto all = json("scan " + quoted(patient));
  std::string ct;
  for (const auto& series : all["series"])
    if (series["modality"] == "CT")
      ct = series["uid"];
  const auto segmentation = of(all, "labels.seg.nrrd");
  EXPECT_EQ(segmentation["kind"], "labels");
  EXPECT_EQ(segmentation["grid_of"], ct);
  EXPECT_EQ(segmentation["below"], true);
  EXPECT_EQ(of(all, "meshes")["kind"], "mesh");
  const auto beside = json("scan " + quoted(patient / "ct"));
  EXPECT_EQ(of(beside, "labels.seg.nrrd")["below"], false);
  EXPECT_NE(run("scan " + quoted(patient)).out.find("on the grid of " + ct), std::string::npos);

  const Outcome without = run("new ear --ct " + quoted(patient / "ct"));
  EXPECT_EQ(without.code, 0) << without.err;
  EXPECT_NE(without.err.find("labels.seg.nrrd"), std::string::npos) << without.err;
  const Outcome same = run("new same --ct " + quoted(patient / "ct") + " --labels " +
                           quoted(patient / "labels.seg.nrrd"));
  EXPECT_EQ(same.code, 0) << same.err;
  EXPECT_EQ(same.err.find("were not taken"), std::string::npos)
      << "the masks and meshes are the same structures: " << same.err;
  std::string options = " --labels x=" + quoted(patient / "labels") +
                        " --labels y=" + quoted(patient / "labels.seg.nrrd");
  for (const auto& mesh : std::filesystem::directory_iterator(patient / "meshes"))
    options += " --mesh m_" + mesh.path().stem().string() + "=" + quoted(mesh.path());
  const Outcome with = run("new all --ct " + quoted(patient / "ct") + options);
  EXPECT_EQ(with.code, 0) << with.err;
  EXPECT_EQ(with.err.find("were not taken"), std::string::npos) << with.err;
}

// More than a sentence names.
TEST_F(CommandLine, StructuresThatNoVoxelCarriesCountAsTaken)
{
  makePatient("--dims 16,16,16 --spacing 4.5");
  const auto patient = m_folder / "patient";
  const Outcome built = run("new ear --json --ct " + quoted(patient / "ct") + " --labels " +
                            quoted(patient / "labels.seg.nrrd"));
  ASSERT_EQ(built.code, 0) << built.err;
  const auto info = nlohmann::json::parse(built.out);
  const auto empty = std::count_if(info["structures"].begin(), info["structures"].end(),
                                   [](const auto& one) { return one["status"] == "empty"; });
  ASSERT_GT(empty, 6);
  EXPECT_EQ(built.err.find("were not taken"), std::string::npos) << built.err;
}

// A label at a known voxel, of a CT with wrong axes, by the way of files.
TEST_F(CommandLine, AxesThatAreWrongAreCorrected)
{
  const auto write = [this](const std::string& name, const std::string& type, std::size_t bytes,
                            std::size_t voxel, const std::string& value)
  {
    std::string data(bytes * 10 * 8 * 6, '\0');
    data.replace(bytes * voxel, bytes, value);
    std::ofstream(m_folder / name, std::ios::binary)
        << "NRRD0004\ntype: " << type
        << "\ndimension: 3\nspace: left-posterior-superior\nsizes: 10 8 6\nspace directions: "
           "(1,0,0) (0,1,0) (0,0,1)\nendian: little\nencoding: raw\nspace origin: (20,30,40)\n\n"
        << data;
    return quoted(m_folder / name);
  };
  const std::string ct = write("ct.nrrd", "short", 2, 5, std::string("\xb0\x04", 2)); // 1200
  // Voxel 1, 2, 3: by the file at 21, 32, 43; the centre is 24.5, 33.5, 42.5.
  const std::string labels =
      write("incus.nrrd", "uchar", 1, 1 + 10 * (2 + 8 * 3), std::string(1, '\1'));
  const auto built = json("new ear --modality CT --ct " + ct +
                          " --ct-axes rph --labels incus=" + quoted(m_folder / "incus.nrrd"));
  EXPECT_EQ(built["ct"]["provenance"]["corrected_axes"], "RPS");
  EXPECT_EQ(built["labels"][0]["provenance"]["corrected_axes"], "RPS");
  EXPECT_NEAR(built["labels"][0]["volume_mm3"].get<double>(), 1.0, 1e-9);
  const std::string text = run("info ear").out;
  EXPECT_NE(text.find("axes of the file corrected (RPS): what it calls left, back and head is the "
                      "patient's right, back and head"),
            std::string::npos)
      << text;
  // Exported and read by themselves, both say where they are.
  ASSERT_EQ(run("export ear --what ct --out " + quoted(m_folder / "out.nrrd")).code, 0);
  const std::string header = textOf(m_folder / "out.nrrd");
  EXPECT_NE(header.find("space origin: (29,30,40)"), std::string::npos) << header.substr(0, 500);

  json("new plain --modality CT --ct " + ct + " --labels incus=" + labels);
  const Outcome corrected = run("correct-axes plain --axes RPS --as mirrored --json");
  ASSERT_EQ(corrected.code, 0) << corrected.err;
  const auto mirrored = nlohmann::json::parse(corrected.out);
  EXPECT_EQ(mirrored["ct"]["provenance"]["corrected_axes"], "RPS");
  EXPECT_EQ(mirrored["labels"][0]["provenance"]["corrected_axes"], "RPS");
  EXPECT_TRUE(json("info plain")["ct"]["provenance"]["corrected_axes"].is_null());

  expectRefused("new none --ct " + ct + " --ct-axes LLS", 2, "--ct-axes");
  expectRefused("new none --ct " + ct + " --labels-axes RPS", 2, "--labels");
  // A part of the case itself, as its file's --labels-axes.
  const Outcome own = run("correct-axes plain --axes RPS --part incus --json");
  ASSERT_EQ(own.code, 0) << own.err;
  EXPECT_EQ(nlohmann::json::parse(own.out)["labels"][0]["provenance"]["corrected_axes"], "RPS");
  EXPECT_EQ(json("info plain")["labels"][0]["provenance"]["corrected_axes"], "RPS");
  EXPECT_TRUE(json("info plain")["ct"]["provenance"]["corrected_axes"].is_null());
  expectRefused("correct-axes plain --axes RPS", 2, "--part");
  expectRefused("correct-axes plain --axes RPS --as both --part incus", 2, "--part");
  expectRefused("correct-axes plain --axes RPS --part nothing", 3, "nothing");

  // By the name that lists show.
  json("add plain --labels sigmoid_sinus=" + quoted(m_folder / "incus.nrrd"));
  json("correct-axes plain --axes LPI --part \"sigmoid sinus\"");
  json("appearance plain --color \"sigmoid sinus=#112233\"");
  const auto sinus = json("info plain")["labels"][1];
  EXPECT_EQ(sinus["name"], "sigmoid_sinus");
  EXPECT_EQ(sinus["provenance"]["corrected_axes"], "LPI");
  EXPECT_NEAR(sinus["color"][2].get<double>(), 0x33 / 255.0, 1e-6);
  ASSERT_EQ(run("export plain --what structure --part \"Sigmoid sinus\" --out " +
                quoted(m_folder / "sinus.stl"))
                .code,
            0);
  json("remove plain --part \"sigmoid sinus\"");
  EXPECT_EQ(json("info plain")["labels"].size(), 1U);

  // A mesh has no more of it than its notes.
  std::ofstream(m_folder / "stapes.obj") << "v 21 32 43\nv 22 32 43\nv 21 33 43\nv 21 32 44\n"
                                            "f 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n";
  json("add plain --mesh stapes=" + quoted(m_folder / "stapes.obj"));
  const std::string meshNote = "axes of the file corrected (LPI): what it calls left, back and "
                               "head is the patient's left, back and feet";
  EXPECT_EQ(run("info plain").out.find(meshNote), std::string::npos);
  json("correct-axes plain --axes LPI --part stapes");
  const auto mesh = json("info plain")["meshes"][0];
  EXPECT_EQ(mesh["name"], "stapes");
  EXPECT_EQ(mesh["notes"], nlohmann::json::array({meshNote}));
  const std::string lines = run("info plain").out;
  const std::size_t at = lines.find("  mesh 'stapes'");
  ASSERT_NE(at, std::string::npos) << lines;
  EXPECT_EQ(lines.find("\n    " + meshNote + "\n", at), lines.find('\n', at)) << lines;

  expectRefused("correct-axes plain --axes LPS --as none", 2, "--axes");
  expectRefused("correct-axes plain --axes RPS --as mirrored", 4, "mirrored");
}

TEST_F(CommandLine, StrictScanTakesASegmentationForWhatItIs)
{
  makePatient("--dims 32,32,40 --spacing 2");
  const std::string ct = quoted(m_folder / "patient/ct");
  ASSERT_EQ(
      run("new ear --ct " + ct + " --labels " + quoted(m_folder / "patient/labels.seg.nrrd")).code,
      0);
  ASSERT_EQ(run("export ear --what labels --out " + quoted(m_folder / "patient/ct/seg.dcm")).code,
            0);
  const auto strict = run("scan --json --strict " + ct);
  EXPECT_EQ(strict.code, 0) << strict.err;
  std::map<std::string, std::string> kinds;
  const auto found = nlohmann::json::parse(strict.out);
  for (const auto& series : found["series"])
  {
    kinds[series["modality"]] = series["kind"];
    if (series["kind"] == "segmentation") // of which nothing is judged
    {
      EXPECT_TRUE(series["verdict"].is_null());
      EXPECT_TRUE(series["findings"].empty());
    }
  }
  EXPECT_EQ(kinds["CT"], "image");
  EXPECT_EQ(kinds["SEG"], "segmentation");
}

TEST_F(CommandLine, RefusesAPictureWhoseNamePromisesAnotherFormat)
{
  json("new bone --ct " + quoted(writeBone(m_folder)));
  for (const std::string name : {"x.jpg", "x", "x.png.gz", ".png"})
  {
    const auto file = quoted(m_folder / name);
    expectRefused("render bone --size 64x48 --out " + file, 2, ".png");
    expectRefused("slice bone --plane axial --out " + file, 2, ".png");
    EXPECT_FALSE(std::filesystem::exists(m_folder / name));
  }
  expectRefused("render bone --size 64x48 --out " + quoted(m_folder / "x.png") + " --depth " +
                    quoted(m_folder / "x.tif"),
                2, ".npy");
  EXPECT_EQ(run("render bone --size 64x48 --out " + quoted(m_folder / "X.PNG")).code, 0);
}

TEST_F(CommandLine, CtrlCEndsItByTheSignalAndLeavesNothing)
{
  const std::string out = m_folder / "patient";
  const std::string log = m_folder / "log";
  std::string words[] = {PETROUS_PROGRAM, "sample",    out,  "--dims",
                         "400,400,400",   "--spacing", "0.2"};
  std::vector<char*> arguments;
  for (std::string& word : words)
    arguments.push_back(word.data());
  arguments.push_back(nullptr);
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_addopen(&actions, STDERR_FILENO, log.c_str(), O_WRONLY | O_CREAT, 0600);
  pid_t process = 0;
  ASSERT_EQ(::posix_spawn(&process, PETROUS_PROGRAM, &actions, nullptr, arguments.data(), environ),
            0);
  posix_spawn_file_actions_destroy(&actions);
  // Its handler is installed once SIGINT is among the process's caught signals.
  const auto handled = [process]
  {
    std::ifstream file("/proc/" + std::to_string(process) + "/status");
    for (std::string line; std::getline(file, line);)
      if (line.rfind("SigCgt:", 0) == 0)
        return (std::stoull(line.substr(7), nullptr, 16) & (1u << (SIGINT - 1))) != 0;
    return false;
  };
  while (!handled() && ::waitpid(process, nullptr, WNOHANG) == 0)
    ::usleep(1000);
  ::kill(process, SIGINT);
  int status = 0;
  ASSERT_EQ(::waitpid(process, &status, 0), process);
  ASSERT_TRUE(WIFSIGNALED(status)) << status;
  EXPECT_EQ(WTERMSIG(status), SIGINT);
  EXPECT_NE(textOf(log).find("cancelled"), std::string::npos) << textOf(log);
  EXPECT_FALSE(std::filesystem::exists(out));
}
