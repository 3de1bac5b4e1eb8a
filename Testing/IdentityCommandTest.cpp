#include <vector>

#include "CommandRunner.h"
#include "TestDicom.h"

using petrous::imaging::test::TestSlice;
using petrous::testing::CommandLine;
using petrous::testing::quoted;
using petrous::testing::textOf;

namespace
{

namespace fs = std::filesystem;

// A series with an identifier at each place where DICOM has one.
class IdentityCommand : public CommandLine
{
protected:
  std::string plant()
  {
    m_plants.push_back("Vqx" + std::to_string(4000 + m_plants.size()) + "Jw");
    return m_plants.back();
  }

  fs::path writePlanted()
  {
    const fs::path folder = m_folder / ("Gorblimey^Ethelwulf " + plant()) / plant();
    m_plants.insert(m_plants.end(), {"Gorblimey", "Ethelwulf", "1.2.77777.", "19310517"});
    std::string header; // explicit, after group 8
    TestSlice element;
    struct Place
    {
      std::uint32_t tag;
      const char* vr;
    };
    for (const Place place :
         {Place{0x00080050, "SH"}, {0x00080070, "LO"}, {0x00080080, "LO"}, {0x00080081, "ST"},
          {0x00080090, "PN"},      {0x00080092, "ST"}, {0x00080094, "SH"}, {0x00081010, "SH"},
          {0x00081030, "LO"},      {0x00081040, "LO"}, {0x00081048, "PN"}, {0x00081050, "PN"},
          {0x00081060, "PN"},      {0x00081070, "PN"}, {0x00081080, "LO"}, {0x00081090, "LO"},
          {0x00082111, "ST"},      {0x00090010, "LO"}, {0x00091001, "UN"}, {0x00091002, "LT"},
          {0x00100020, "LO"},      {0x00100021, "LO"}, {0x00101000, "LO"}, {0x00101001, "PN"},
          {0x00101005, "PN"},      {0x00101040, "LO"}, {0x00101060, "PN"}, {0x00101080, "LO"},
          {0x001021b0, "LT"},      {0x00104000, "LT"}, {0x00120010, "LO"}, {0x00120020, "LO"},
          {0x00120040, "LO"},      {0x00180015, "CS"}, {0x00180024, "SH"}, {0x00181000, "LO"},
          {0x00181020, "LO"},      {0x00181030, "LO"}, {0x00181210, "SH"}, {0x00200010, "SH"},
          {0x00204000, "LT"},      {0x00321032, "PN"}, {0x00321060, "LO"}, {0x00380010, "LO"},
          {0x00380300, "LO"},      {0x00384000, "LT"}, {0x00400254, "LO"}, {0x00400280, "ST"},
          {0x00401001, "SH"},      {0x00402016, "LO"}, {0x60000022, "LO"}, {0x60001500, "LO"},
          {0x60004000, "LT"}})
      element.element(header, place.tag, place.vr, plant());
    element.element(header, 0x00100030, "DA", "19310517");
    std::string inner, item;
    element.element(inner, 0x00400007, "LO", plant());
    element.element(inner, 0x0040a123, "PN", plant());
    element.append(item, 0xfffe, 2);
    element.append(item, 0xe000, 2);
    element.append(item, static_cast<std::uint32_t>(inner.size()), 4);
    element.element(header, 0x00400275, "SQ", item + inner);
    const std::string preamble = plant(), title = plant(), trailer = plant();
    const std::string name = plant(), series = plant();
    for (int k = 0; k < 12; ++k)
    {
      TestSlice slice;
      slice.columns = slice.rows = 16;
      slice.z = 0.5 * k;
      slice.seriesUid = "1.2.77777.1";
      slice.studyUid = "1.2.77777.2";
      slice.marker = false;
      slice.extra = header;
      slice.cell = [k](int i, int j)
      { return i > 3 && i < 13 && j > 3 && j < 13 && k > 2 && k < 10 ? 1200U : 0U; };
      std::string meta, start = preamble, end;
      slice.element(meta, 0x00020010, "UI", "1.2.840.10008.1.2.1");
      slice.element(meta, 0x00020016, "AE", title);
      start.resize(128, '\0');
      slice.element(end, 0xfffcfffc, "OB", trailer);
      std::string bytes = slice.bytes();
      const auto replace = [&bytes](const std::string& from, const std::string& to)
      { bytes.replace(bytes.find(from), from.size(), to); };
      replace("1.2.3.9", "1.2.777");                               // frame of reference
      replace("SECRET^NAME", (name + "^Gorblimey").substr(0, 11)); // of the same length
      replace("1.2.3.4.5.", "1.2.77777.");
      petrous::imaging::test::writeText(folder / (series + std::to_string(k) + ".dcm"),
                                        start + "DICM" + meta + bytes + end);
    }
    return folder;
  }

  // Names and bytes of all files below these folders.
  void expectNoPlantIn(const std::vector<fs::path>& roots) const
  {
    std::size_t files = 0;
    const auto look = [&](const fs::path& path)
    {
      ++files;
      const std::string text = path.filename().string() + "\n" + textOf(path);
      for (const std::string& identifier : m_plants)
      {
        EXPECT_EQ(text.find(identifier), std::string::npos) << identifier << " in " << path;
        std::string wide; // UTF-16
        for (const char c : identifier)
          wide += {c, '\0'};
        EXPECT_EQ(text.find(wide), std::string::npos) << identifier << " in " << path;
      }
    };
    for (const fs::path& root : roots)
      if (fs::is_directory(root))
      {
        for (const auto& entry : fs::recursive_directory_iterator(root))
          if (entry.is_regular_file())
            look(entry.path());
      }
      else
        look(root);
    EXPECT_GT(files, roots.size());
  }

  std::vector<std::string> m_plants;
};

} // namespace

TEST_F(IdentityCommand, ACaseAndAllThatIsMadeOfItHoldNoIdentifier)
{
  const std::string ct = quoted(writePlanted());
  ASSERT_GE(m_plants.size(), 50U);
  json("new ear --ct " + ct + " --mr T2=" + ct);
  std::ofstream(m_folder / "path.csv") << "t_s,x_mm,y_mm,z_mm,qw,qx,qy,qz,drill\n"
                                       << "0,-6,23.5,5.6,1,0,0,0,1\n0.2,-6,23.5,3,1,0,0,0,0\n";
  json("drill ear --path " + quoted(m_folder / "path.csv") + " --record " +
       quoted(m_folder / "out.recording"));
  const auto out = [this](const std::string& name) { return quoted(m_folder / "made" / name); };
  fs::create_directories(m_folder / "made");
  json("archive ear " + out("ear.petrous"));
  json("archive ear --plan-only " + out("plan.petrous"));
  json("restore " + out("ear.petrous") + " --library " + quoted(m_folder / "other"));
  json("render ear --size 64x48 --out " + out("ear.png"));
  json("slice ear --plane axial --size 64x48 --out " + out("slice.png"));
  json("export ear --what ct --out " + out("ct.nrrd"));
  json("export ear --what ct --out " + out("ct.nii.gz"));
  json("export ear --what ct --out " + out("dicom/"));
  json("export ear --what mr --out " + out("mr/"));
  json("export ear --what surface --out " + out("ear.obj"));
  json("export ear --what mask --out " + out("mask.nrrd"));
  const auto info = run("info ear --json");
  EXPECT_EQ(info.code, 0);
  std::ofstream(m_folder / "made" / "info.json") << info.out << info.err;
  expectNoPlantIn({library(), m_folder / "other", m_folder / "made", m_folder / "state",
                   m_folder / "out.recording"});
}

TEST_F(IdentityCommand, DeidentifiesAFolderWithMapAndReport)
{
  const fs::path in = writePlanted();
  std::ofstream(m_folder / "passphrase") << "nine lives of a cat\n";
  const std::string secret = " --passphrase-file " + quoted(m_folder / "passphrase");
  const std::string map = quoted(m_folder / "map");
  const auto done =
      json("deidentify " + quoted(in) + " " + quoted(m_folder / "out") + " --map " + map + secret +
           " --dates shift --clean-descriptors --report " + quoted(m_folder / "report.txt"));
  EXPECT_EQ(done["files"], 12);
  EXPECT_EQ(done["patients"], 1);
  EXPECT_GT(done["stays"].size(), 10U);
  EXPECT_GT(done["removed_or_replaced"].size(), 40U);
  expectNoPlantIn(
      {m_folder / "out", m_folder / "report.txt", m_folder / "map", m_folder / "state"});
  const std::string again = quoted(m_folder / "again");
  json("deidentify " + quoted(in) + " " + again + " --map " + map + secret +
       " --dates shift --clean-descriptors");
  for (const auto& entry : fs::recursive_directory_iterator(m_folder / "out"))
    if (entry.is_regular_file())
    {
      EXPECT_EQ(textOf(entry.path()),
                textOf(m_folder / "again" / fs::relative(entry.path(), m_folder / "out")));
    }
  EXPECT_NE(run("pseudonyms " + map + secret).out.find("1.2.77777.2"), std::string::npos);
  // Found, copied under another passphrase, taken in elsewhere, and opened by a new one.
  const auto count = [this](const std::string& line) { return json(line)["pseudonyms"].size(); };
  EXPECT_EQ(count("pseudonyms " + map + secret + " --find 1.2.77777.2"), 1U);
  EXPECT_EQ(count("pseudonyms " + map + secret + " --find PATIENT"), 1U);
  EXPECT_EQ(count("pseudonyms " + map + secret + " --find nobody"), 0U);
  std::ofstream(m_folder / "second") << "ten lives of a dog\n";
  const std::string other = " --other-passphrase-file " + quoted(m_folder / "second");
  const std::string copy = quoted(m_folder / "copy");
  json("pseudonyms " + map + secret + " --export " + copy + other);
  expectRefused("pseudonyms " + map + secret + " --export " + copy + other, 4, "there already");
  expectNoPlantIn({m_folder / "out", m_folder / "copy", m_folder / "state"});
  EXPECT_EQ(json("pseudonyms " + map + secret + " --import " + copy + other)["added"], 0);
  json("pseudonyms " + copy + " --passphrase-file " + quoted(m_folder / "second") +
       " --new-passphrase-file " + quoted(m_folder / "passphrase"));
  EXPECT_EQ(run("pseudonyms " + copy + secret).out, run("pseudonyms " + map + secret).out);
  expectRefused("pseudonyms " + map + secret + " --find x --export " + copy, 2, "one of");
  EXPECT_EQ(json("scan " + quoted(m_folder / "out"))["series"][0]["verdict"], "ok");
  std::ofstream(m_folder / "wrong") << "eight lives of a cat\n";
  const std::string list = "pseudonyms " + map + " --passphrase-file ";
  expectRefused(list + quoted(m_folder / "wrong"), 3, "passphrase");
  expectRefused("deidentify " + quoted(in) + " " + quoted(in / "out"), 4, "within the input");
  expectRefused("deidentify " + quoted(in) + " " + quoted(m_folder / "y") + " --report " +
                    quoted(in / "report.txt"),
                4, "never changed");
  EXPECT_FALSE(fs::exists(in / "report.txt"));
  EXPECT_FALSE(fs::exists(m_folder / "y"));
  expectRefused("deidentify " + quoted(in) + " " + quoted(m_folder / "out"), 4, "empty");
  expectRefused("deidentify " + quoted(in) + " " + quoted(m_folder / "x") + " --map " + map, 2,
                "--passphrase-file");
}

TEST_F(IdentityCommand, ReplacesAFileOnRequestOnly)
{
  const std::string in = quoted(fs::directory_iterator(writePlanted())->path());
  const fs::path out = m_folder / "one.dcm";
  json("deidentify " + in + " " + quoted(out));
  const std::string first = textOf(out);
  expectRefused("deidentify " + in + " " + quoted(out), 4, "--replace");
  EXPECT_EQ(textOf(out), first);
  json("deidentify " + in + " " + quoted(out) + " --replace");
  EXPECT_NE(textOf(out), first) << "other UIDs";
}

// An independent reader has its own view of the table.
TEST_F(IdentityCommand, SatisfiesAnIndependentReader)
{
  if (std::system("/usr/bin/python3 -c 'import pydicom' 2>/dev/null") != 0)
    GTEST_SKIP() << "pydicom is not there to check what was written";
  const std::string check = "/usr/bin/python3 " + quoted(PETROUS_SOURCE "/Testing/deidentify.py") +
                            " " + quoted(PETROUS_PROGRAM) + " " +
                            quoted(PETROUS_SOURCE "/Resources/confidentiality-profile.tsv") + " " +
                            quoted(m_folder) + " >" + quoted(m_folder / "told") + " 2>&1";
  EXPECT_EQ(std::system(check.c_str()), 0) << textOf(m_folder / "told");
}
