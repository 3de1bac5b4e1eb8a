#include <regex>
#include <set>

#include "CommandRunner.h"
#include "TestDicom.h"

using petrous::testing::CommandLine;
using petrous::testing::quoted;
using petrous::testing::textOf;

namespace
{

namespace fs = std::filesystem;

// Of a patient that does not exist: what files say, and what they are called.
constexpr const char* kHeaderWords[] = {"Quorndike", "Ulfhild", "QX7731904", "19410923"};
constexpr const char* kNameWords[] = {"Wrexelby", "Theodric", "WZ5520117", "19380612"};

class LogCommand : public CommandLine
{
protected:
  void TearDown() override
  {
    ::unsetenv("PETROUS_LOG_LEVEL");
    CommandLine::TearDown();
  }

  // A series of 24 slices that carries the words in its headers, each file the others in its name.
  fs::path writePatient(const std::string& folder) const
  {
    const fs::path path = m_folder / (std::string("Wrexelby Theodric ") + folder) / "WZ5520117";
    fs::create_directories(path);
    for (int k = 0; k < 24; ++k)
    {
      petrous::imaging::test::TestSlice slice;
      slice.columns = slice.rows = 24;
      slice.z = 0.5 * k;
      slice.cell = [k](int i, int j)
      { return i > 6 && i < 18 && j > 6 && j < 18 && k > 6 && k < 18 ? 1200U : 0U; };
      std::string bytes = slice.bytes();
      const std::string name = "SECRET^NAME ";
      std::string patient;
      slice.element(patient, 0x00100010, "PN", "Quorndike^Ulfhild");
      slice.element(patient, 0x00100020, "LO", "QX7731904");
      slice.element(patient, 0x00100030, "DA", "19410923");
      const std::size_t at = bytes.find(name) - 8; // tag, VR, length
      bytes.replace(at, name.size() + 8, patient);
      petrous::imaging::test::writeText(path / ("Wrexelby_19380612_" + std::to_string(k) + ".dcm"),
                                        bytes);
    }
    return path;
  }

  fs::path named(const std::string& suffix) const
  {
    return m_folder / ("Wrexelby^Theodric 19380612" + suffix);
  }

  std::string writeNrrd(const std::string& body) const
  {
    const fs::path path = named(".nrrd");
    std::ofstream(path, std::ios::binary)
        << "NRRD0004\n# Quorndike Ulfhild QX7731904\ntype: uchar\ndimension: 3\n"
        << "space: left-posterior-superior\nsizes: 24 24 24\n"
        << "space directions: (0.4,0,0) (0,0.5,0) (0,0,0.5)\nspace origin: (-10,20.5,0)\n"
        << "encoding: raw\n\n"
        << body;
    return quoted(path);
  }

  // Runs with the most talkative log; nothing of the files' content may be on stderr.
  int logged(const std::string& arguments) const
  {
    const auto outcome = run(arguments + " --log-level trace");
    for (const char* word : kHeaderWords)
      EXPECT_EQ(outcome.err.find(word), std::string::npos) << arguments << ": " << outcome.err;
    return outcome.code;
  }
};

} // namespace

TEST_F(LogCommand, HoldsNothingOfThePatient)
{
  const std::string ct = quoted(writePatient("ct"));
  EXPECT_EQ(logged("scan " + ct), 0);
  EXPECT_EQ(logged("new Wrexelby --ct " + ct), 0);
  EXPECT_EQ(logged("new Wrexelby --ct " + ct), 4) << "the name is taken";
  std::string body(24 * 24 * 24, '\0');
  std::fill(body.begin() + 6000, body.begin() + 6900, '\1');
  EXPECT_EQ(logged("add Wrexelby --labels " + writeNrrd(body)), 0);
  std::ofstream(named(".obj")) << "# Quorndike\nv -8 22 2\nv -4 22 2\nv -8 26 2\nv -8 22 6\n"
                               << "f 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n";
  EXPECT_EQ(logged("add Wrexelby --mesh Theodric=" + quoted(named(".obj"))), 0);
  EXPECT_EQ(logged("add Wrexelby --mr 19380612=" + quoted(writePatient("mr"))), 0);
  std::ofstream(named(".csv")) << "t_s,x_mm,y_mm,z_mm,qw,qx,qy,qz,drill\n"
                               << "0,-5,26,20,1,0,0,0,1\n0.2,-5,26,9,1,0,0,0,0\n";
  EXPECT_EQ(logged("drill Wrexelby --path " + quoted(named(".csv"))), 0);
  EXPECT_EQ(logged("render Wrexelby --size 48x48 --out " + quoted(named(".png"))), 0);
  EXPECT_EQ(logged("export Wrexelby --what ct --out " + quoted(named(" ct.nrrd"))), 0);
  EXPECT_EQ(logged("export Wrexelby --what surface --out " + quoted(named(".stl"))), 0);
  EXPECT_EQ(logged("library rename Wrexelby Theodric"), 0);
  EXPECT_EQ(logged("library search WZ5520117"), 0);
  EXPECT_EQ(logged("undo Theodric"), 0);

  // Damaged and missing files, and a journal that was left.
  EXPECT_EQ(logged("info Wrexelby"), 3);
  EXPECT_EQ(logged("add Theodric --labels " + writeNrrd("short")), 3);
  std::ofstream(named(".obj")) << "Quorndike Ulfhild\nf 1 2 99\n";
  EXPECT_EQ(logged("add Theodric --mesh " + quoted(named(".obj"))), 3);
  EXPECT_EQ(logged("add Theodric --labels " + quoted(named(".nii.gz"))), 3);
  std::ofstream(named(".nii.gz")) << "Quorndike";
  EXPECT_EQ(logged("add Theodric --labels " + quoted(named(".nii.gz"))), 3);
  EXPECT_EQ(logged("export Theodric --what ct --out " + quoted(named("/no folder/ct.nrrd"))), 4);
  const fs::path damaged = writePatient("damaged");
  fs::resize_file(damaged / "Wrexelby_19380612_7.dcm", 700);
  std::ofstream(damaged / "Wrexelby_19380612_9.dcm") << "Quorndike^Ulfhild";
  EXPECT_EQ(logged("scan " + quoted(damaged)), 0);
  EXPECT_EQ(logged("new damaged --ct " + quoted(damaged)), 3);
  for (const auto& entry : fs::directory_iterator(library() / "objects"))
    fs::resize_file(entry.path(), 100);
  EXPECT_EQ(logged("render Theodric --size 48x48 --out " + quoted(named(".png"))), 3);
  EXPECT_EQ(logged("library verify"), 3);
  std::ofstream(library() / "cases/Theodric.json") << "{\"name\": \"Quorndike\"";
  EXPECT_EQ(logged("info Theodric"), 3);

  const std::string log = logText();
  for (const auto& words : {kHeaderWords, kNameWords})
    for (int n = 0; n < 4; ++n)
      EXPECT_EQ(log.find(words[n]), std::string::npos) << words[n] << " in\n" << log;
  for (const char* line :
       {"scan: start, petrous ", "scan: 24 files, 1 series", "series: 24 files, 24 slices, ok",
        "scan: exit 0 after 0.", "import: image of 24 x 24 x 24 voxels of 0.4 x 0.5 x 0.5 mm",
        "import: 1 structures", "import: mesh of 4 triangles", "library: case saved in 0.",
        "OpenGL: ", "drill: exit 0", ", unreadable", "new: exit 3 after 0.",
        "bad-input, petrous::imaging::FileError", "refused, petrous::imaging::FileError"})
    EXPECT_NE(log.find(line), std::string::npos) << line << " is not in\n" << log;
}

TEST_F(LogCommand, TakesItsLevelBeforeAndAfterTheSubcommandAndFromTheEnvironment)
{
  const auto log = m_folder / "state/petrous/petrous.log";
  const auto lines = [&](const std::string& arguments)
  {
    fs::remove(log);
    const auto outcome = run(arguments);
    EXPECT_EQ(outcome.code, 0);
    EXPECT_EQ(outcome.err, "");
    EXPECT_EQ(outcome.out.rfind("no case in " + library().string() + ": there is no", 0), 0U);
    EXPECT_EQ(std::count(outcome.out.begin(), outcome.out.end(), '\n'), 1)
        << "the log leaves stdout alone";
    const std::string text = textOf(log);
    return std::count(text.begin(), text.end(), '\n');
  };
  EXPECT_EQ(lines("library list"), 2);
  EXPECT_EQ(lines("--log-level off library list"), 0);
  EXPECT_EQ(lines("library list --log-level=warning"), 0);
  ::setenv("PETROUS_LOG_LEVEL", "error", 1);
  EXPECT_EQ(lines("library list"), 0);
  EXPECT_EQ(lines("library --log-level trace list"), 2);
  EXPECT_FALSE(fs::exists(m_folder / "state/petrous/petrous.1.log"));
  ::unsetenv("PETROUS_LOG_LEVEL");
  expectRefused("library list --log-level loud", 2, "trace, debug, info, warning, error or off");
  expectRefused("library list --log-level ''", 2, "--log-level");
  ::setenv("PETROUS_LOG_LEVEL", "loud", 1);
  expectRefused("library list", 2, "PETROUS_LOG_LEVEL");
}

TEST_F(LogCommand, AnUnwritableFolderWarnsOnceAndHindersNothing)
{
  std::ofstream(m_folder / "state") << "a file in place of the folder";
  const auto outcome = run("library list");
  EXPECT_EQ(outcome.code, 0);
  EXPECT_EQ(outcome.out.rfind("no case in " + library().string(), 0), 0U) << outcome.out;
  EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
  EXPECT_NE(outcome.err.find("petrous: no log: "), std::string::npos) << outcome.err;
  EXPECT_EQ(run("library list --quiet").err, "");
  EXPECT_EQ(run("library list --log-level off").err, "");
}

TEST_F(LogCommand, TheDoctorNamesTheFile)
{
  EXPECT_EQ(json("doctor")["log_file"], (m_folder / "state/petrous/petrous.log").string());
  EXPECT_TRUE(fs::exists(m_folder / "state/petrous/petrous.log"));
}
