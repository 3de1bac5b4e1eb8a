#include <csignal>
#include <thread>

#include <fcntl.h>
#include <spawn.h>
#include <sys/file.h>

#include "CommandRunner.h"

using namespace petrous::testing;

namespace
{

// A block of bone whose +x face is at x = 10 mm.
class RecoveryCommand : public CommandLine
{
protected:
  void SetUp() override
  {
    CommandLine::SetUp();
    std::ofstream file(m_folder / "bone.nrrd", std::ios::binary);
    file << "NRRD0004\ntype: short\ndimension: 3\nspace: left-posterior-superior\n"
         << "sizes: 60 60 60\nspace directions: (0.5,0,0) (0,0.5,0) (0,0,0.5)\n"
         << "space origin: (-15,-15,-15)\nencoding: raw\nendian: little\n\n";
    for (int n = 0; n < 60 * 60 * 60; ++n)
    {
      const std::int16_t value = n % 60 < 51 ? 1500 : -1000;
      file.write(reinterpret_cast<const char*>(&value), sizeof value);
    }
    file.close();
    json("new bone --ct " + quoted(m_folder / "bone.nrrd"));
  }

  // Into the bone for 8 s, off for 1 s, and again next to it, for two minutes.
  std::filesystem::path writeSession() const
  {
    std::ofstream file(m_folder / "session.csv");
    file << "t_s,x_mm,y_mm,z_mm,qw,qx,qy,qz,drill\n";
    const auto row = [&file](double time, double x, double y, int drill)
    {
      file << time << ',' << x << ',' << y << ",0,0.70710678118654757,0,0.70710678118654757,0,"
           << drill << '\n';
    };
    for (int n = 0; n < 13; ++n)
    {
      const double y = n - 6.0;
      row(9.0 * n, 14.0, y, 1);
      row(9.0 * n + 7.0, 8.0, y, 1);
      row(9.0 * n + 8.0, 14.0, y, 0);
    }
    row(9.0 * 13, 14.0, 0.0, 0);
    return m_folder / "session.csv";
  }

  // A nerve below the face, as a label, and an incus, as a mesh. The new manifest.
  nlohmann::json addStructures() const
  {
    std::ofstream labels(m_folder / "nerve.nrrd", std::ios::binary);
    labels << "NRRD0004\ntype: uint8\ndimension: 3\nspace: left-posterior-superior\n"
           << "sizes: 60 60 60\nspace directions: (0.5,0,0) (0,0.5,0) (0,0,0.5)\n"
           << "space origin: (-15,-15,-15)\nencoding: raw\nendian: little\n\n";
    for (int n = 0; n < 60 * 60 * 60; ++n)
      labels.put(n % 60 > 40 && n % 60 < 46 && n / 60 % 60 > 20 && n / 60 % 60 < 40 ? '\1' : '\0');
    labels.close();
    std::ofstream(m_folder / "incus.obj") << "v 0 0 0\nv 4 0 0\nv 0 4 0\nv 0 0 4\n"
                                             "f 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n";
    json("add bone --labels nerve=" + quoted(m_folder / "nerve.nrrd") +
         " --mesh incus=" + quoted(m_folder / "incus.obj"));
    return nlohmann::json::parse(textOf(library() / "cases/bone.json"));
  }

  void damage(const std::string& object) const
  {
    const auto file = library() / "objects" / object;
    std::string bytes = textOf(file);
    bytes[bytes.size() / 2] = static_cast<char>(bytes[bytes.size() / 2] ^ 4);
    std::ofstream(file, std::ios::binary) << bytes;
  }

  std::filesystem::path journal() const { return library() / "cases/bone.journal"; }

  // Runs a command, and `beside` once the case is being drilled.
  template <class Beside>
  Outcome besides(const std::string& arguments, const Beside& beside) const
  {
    const auto out = m_folder / "beside.out", err = m_folder / "beside.err";
    Outcome outcome;
    std::thread other(
        [&]
        {
          const int status =
              std::system(("PETROUS_LIBRARY=" + quoted(library()) + " " + quoted(PETROUS_PROGRAM) +
                           " " + arguments + " >" + quoted(out) + " 2>" + quoted(err))
                              .c_str());
          outcome.code = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
        });
    for (int n = 0; n < 6000 && !std::filesystem::exists(journal()); ++n)
      std::this_thread::sleep_for(std::chrono::milliseconds(5));
    beside();
    other.join();
    outcome.out = textOf(out);
    outcome.err = textOf(err);
    return outcome;
  }

  // Runs the drill command and kills it once its journal has reached `bytes`. False if it ended
  // before.
  bool killDrill(const std::filesystem::path& session, std::uintmax_t bytes) const
  {
    const pid_t child = ::fork();
    if (child == 0)
    {
      const int nowhere = ::open("/dev/null", O_RDWR);
      for (const int stream : {0, 1, 2})
        ::dup2(nowhere, stream);
      ::setenv("PETROUS_LIBRARY", library().c_str(), 1);
      ::execl(PETROUS_PROGRAM, PETROUS_PROGRAM, "drill", "bone", "--path", session.c_str(),
              nullptr);
      ::_exit(127);
    }
    std::error_code error;
    int status = 0;
    while (true)
    {
      if (::waitpid(child, &status, WNOHANG) == child)
        return false;
      const auto size = std::filesystem::file_size(journal(), error);
      if (!error && size > bytes)
        break;
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    ::kill(child, SIGKILL);
    ::waitpid(child, &status, 0);
    return true;
  }
};

} // namespace

TEST_F(RecoveryCommand, WhatAKilledDrillTookIsThereAgain)
{
  const auto session = writeSession();
  json("drill bone --path " + quoted(session));
  const auto whole = json("history bone")["strokes"];
  ASSERT_GE(whole.size(), 5u);
  json("undo bone 99");
  for (const std::uintmax_t bytes : {1000U, 3000U, 30000U})
  {
    json("branch bone 'killed at " + std::to_string(bytes) + "' --from 0");
    const std::size_t before = json("info bone")["dissection"]["strokes"];
    ASSERT_TRUE(killDrill(session, bytes)) << bytes;
    ASSERT_TRUE(std::filesystem::exists(journal()));

    const Outcome outcome = run("info bone --json");
    EXPECT_EQ(outcome.code, 0);
    EXPECT_NE(outcome.err.find("ended without saving"), std::string::npos) << outcome.err;
    EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
    const auto notices = nlohmann::json::parse(outcome.out)["notices"];
    ASSERT_EQ(notices.size(), 1u) << outcome.out;
    EXPECT_EQ(notices[0].get<std::string>() + "\n", outcome.err);
    EXPECT_FALSE(std::filesystem::exists(journal()));
    EXPECT_EQ(run("info bone --json").err, "") << "it is told once";
    const auto strokes = json("history bone")["strokes"];
    ASSERT_GT(strokes.size(), before);
    for (std::size_t n = before; n < strokes.size(); ++n)
    {
      const auto& full = whole[n - before];
      if (strokes[n]["recovered"])
      {
        EXPECT_EQ(n + 1, strokes.size());
        EXPECT_LE(strokes[n]["removed_mm3"], full["removed_mm3"]);
        EXPECT_GE(strokes[n]["duration_s"], 4.5);
      }
      else
        EXPECT_EQ(strokes[n]["removed_mm3"], full["removed_mm3"]);
    }
    EXPECT_EQ(json("render bone --size 64x48 --out " + quoted(m_folder / "a.png"))["size"][0], 64);
  }
}

TEST_F(RecoveryCommand, AFailedDrillLeavesTheLibraryAsItWas)
{
  const auto session = writeSession();
  const auto before = libraryContent();
  const Outcome outcome =
      run("drill bone --path " + quoted(session) + " --log /dev/full --tick-hz 200");
  EXPECT_NE(outcome.code, 0);
  EXPECT_EQ(libraryContent(), before) << outcome.err;
}

TEST_F(RecoveryCommand, AChangeBesideADrillCostsNeither)
{
  const auto session = writeSession();
  const std::size_t whole = json("drill bone --path " + quoted(session))["strokes"];
  json("undo bone 99");
  json("branch bone again --from 0");
  const std::size_t before = json("info bone")["dissection"]["strokes"];
  const Outcome outcome =
      besides("drill bone --path " + quoted(session) + " --json",
              [this]
              {
                json("appearance bone --iso 350");
                expectRefused("drill bone --path " + quoted(m_folder / "session.csv"), 4,
                              "is being drilled by another process");
                expectRefused("library rename bone other", 4, "is being drilled");
                expectRefused("library delete bone", 4, "is being drilled");
              });
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_NE(outcome.err.find("changed by another program meanwhile"), std::string::npos)
      << outcome.err;
  EXPECT_EQ(json("info bone")["dissection"]["strokes"], before + whole);
  EXPECT_EQ(json("appearance bone --list")["iso_hu"], 350.0);
  EXPECT_FALSE(std::filesystem::exists(journal()));
}

TEST_F(RecoveryCommand, AKilledDrillComesBackAfterAChange)
{
  const auto session = writeSession();
  ASSERT_TRUE(killDrill(session, 3000));
  // As left by a program that does not know of journals: the journal is moved away temporarily.
  std::filesystem::rename(journal(), m_folder / "journal");
  json("appearance bone --iso 350");
  std::filesystem::rename(m_folder / "journal", journal());
  const Outcome outcome = run("info bone --json");
  EXPECT_NE(outcome.err.find("came back"), std::string::npos) << outcome.err;
  EXPECT_GE(json("info bone")["dissection"]["strokes"], 1);
}

TEST_F(RecoveryCommand, OneFlippedBitOfTheCtIsToldBeforeAnythingIsDrilledOrWritten)
{
  std::filesystem::path object;
  for (const auto& entry : std::filesystem::directory_iterator(library() / "objects"))
    object = entry.path();
  {
    std::fstream file(object, std::ios::binary | std::ios::in | std::ios::out);
    file.seekg(-1000, std::ios::end);
    const char byte = static_cast<char>(file.get() ^ 8);
    file.seekp(-1000, std::ios::end);
    file.put(byte);
  }
  const auto before = libraryContent();
  expectRefused("drill bone --path " + quoted(writeSession()), 3, "the CT of case 'bone'");
  for (const std::string what : {"ct --out 'D/a.nrrd'", "surface --out 'D/a.stl'"})
  {
    std::string arguments = "export bone --what " + what;
    arguments.replace(arguments.find('D'), 1, m_folder.string());
    expectRefused(arguments, 3, object.filename().string());
  }
  EXPECT_FALSE(std::filesystem::exists(m_folder / "a.nrrd"));
  EXPECT_FALSE(std::filesystem::exists(m_folder / "a.stl"));
  std::ofstream(m_folder / "camera.json")
      << R"({"position_mm":[60,0,0],"focal_point_mm":[0,0,0],"view_up":[0,0,1],)"
      << R"("view_angle_deg":30})"; // with it nothing reads the CT but the film itself
  expectRefused("render bone --turntable 2 --size 16x16 --camera " +
                    quoted(m_folder / "camera.json") + " --out " + quoted(m_folder / "film.png"),
                3, object.filename().string());
  for (const auto& entry : std::filesystem::directory_iterator(m_folder))
    EXPECT_NE(entry.path().extension(), ".png") << entry.path();
  const Outcome outcome = run("library verify --json");
  EXPECT_EQ(outcome.code, 3);
  const auto found = nlohmann::json::parse(outcome.out);
  ASSERT_EQ(found["damaged"].size(), 1u);
  EXPECT_EQ(found["damaged"][0]["object"], object.filename().string());
  EXPECT_EQ(found["damaged"][0]["cases"], nlohmann::json({"bone"}));
  EXPECT_EQ(libraryContent(), before);
}

TEST_F(RecoveryCommand, ADamagedStrokeHindersOnlyWhatNeedsIt)
{
  const auto session = writeSession();
  json("drill bone --path " + quoted(session));
  const std::size_t all = json("history bone")["strokes"].size();
  ASSERT_GE(all, 5u);
  const auto manifest = nlohmann::json::parse(textOf(library() / "cases/bone.json"));
  const std::string object = manifest["dissection"]["strokes"][2]["object"];
  const auto file = library() / "objects" / object;
  const std::string whole = textOf(file);
  std::string spoilt = whole;
  spoilt[spoilt.size() / 2] = static_cast<char>(spoilt[spoilt.size() / 2] ^ 4);
  std::ofstream(file, std::ios::binary) << spoilt;

  const auto points = m_folder / "points.csv";
  std::ofstream(points) << "x_mm,y_mm,z_mm\n0,0,0\n";
  const std::string render =
      "render bone --engine reference --size 16x16 --out " + quoted(m_folder / "a.png");
  const std::string drill = "drill bone --path " + quoted(session);
  const auto before = libraryContent();
  for (const std::string& arguments :
       {render, drill, "probe bone --points " + quoted(points),
        "export bone --what mask --out " + quoted(m_folder / "a.nrrd")})
  {
    expectRefused(arguments, 3, object);
    expectRefused(arguments, 3, "stroke 3 of case 'bone'");
    expectRefused(arguments, 3, "petrous undo 'bone' " + std::to_string(all - 2));
  }
  EXPECT_EQ(libraryContent(), before);
  json("info bone"); // it needs no voxels

  json("undo bone " + std::to_string(all - 2));
  json(render);
  const auto undone = libraryContent();
  expectRefused("redo bone", 3, "stroke 3 of case 'bone'");
  EXPECT_EQ(libraryContent(), undone);
  json("branch bone other");
  json(drill);
  json("branch bone main");
  EXPECT_EQ(json("info bone")["dissection"]["undo"], 2);
  json(drill);
  expectRefused("branch bone 'main~1'", 3, object);
  EXPECT_GT(json("history bone")["strokes"].size(), all) << "nothing is lost";

  std::ofstream(file, std::ios::binary) << whole;
  EXPECT_EQ(json("branch bone 'main~1'")["undo"], all);
  json(render);
}

TEST_F(RecoveryCommand, ADamagedStructureIsLeftOutOnlyIfThatIsChosen)
{
  const auto manifest = addStructures();
  const std::string object = manifest["labels"][0]["object"];
  const std::string mesh = manifest["meshes"][0]["object"];
  damage(object);
  damage(mesh);
  const auto points = m_folder / "points.csv";
  std::ofstream(points) << "x_mm,y_mm,z_mm\n0,0,0\n";
  const std::string commands[] = {
      "probe bone --points " + quoted(points),
      "render bone --engine reference --size 16x16 --out " + quoted(m_folder / "a.png"),
      "drill bone --tick-hz 200 --path " + quoted(writeSession()),
      "slice bone --plane axial --size 16x16 --out " + quoted(m_folder / "a.png"),
      "export bone --what surface --out " + quoted(m_folder / "a.stl"),
      "render bone --turntable 2 --size 16x16 --out " + quoted(m_folder / "film.png"),
      "branch bone --compare main main"};
  const auto before = libraryContent();
  for (const std::string& command : commands)
  {
    expectRefused(command, 3, "'nerve' of case 'bone'");
    expectRefused(command, 3, object);
    expectRefused(command, 3, "--without-damaged");
  }
  EXPECT_EQ(libraryContent(), before);
  EXPECT_FALSE(std::filesystem::exists(m_folder / "a.png"));
  EXPECT_FALSE(std::filesystem::exists(m_folder / "a.stl"));
  EXPECT_FALSE(std::filesystem::exists(m_folder / "film-0001.png"));
  json("slice bone --plane axial --no-structures --out " + quoted(m_folder / "a.png"));
  json("export bone --what mask --out " + quoted(m_folder / "a.nrrd"));
  for (const std::string& command : commands)
  {
    const Outcome outcome = run(command + " --without-damaged --json");
    ASSERT_EQ(outcome.code, 0) << outcome.err;
    EXPECT_NE(outcome.err.find("left out, neither shown nor felt nor spared"), std::string::npos)
        << outcome.err;
    EXPECT_NE(outcome.err.find("mesh 'incus' of case 'bone'"), std::string::npos) << outcome.err;
    const auto leftOut = nlohmann::json::parse(outcome.out)["left_out"];
    ASSERT_EQ(leftOut.size(), 2u) << outcome.out;
    EXPECT_EQ(leftOut[0]["structures"], nlohmann::json({"nerve"}));
    EXPECT_EQ(leftOut[0]["object"], object);
    EXPECT_EQ(leftOut[1]["structures"], nlohmann::json({"incus"}));
    EXPECT_EQ(leftOut[1]["object"], mesh);
  }
  const auto drilled = nlohmann::json::parse(textOf(library() / "cases/bone.json"));
  EXPECT_GE(drilled["dissection"]["strokes"].size(), 1u);
  EXPECT_EQ(drilled["labels"], manifest["labels"]) << "it stays as it is on the disk";
  EXPECT_EQ(drilled["meshes"], manifest["meshes"]);
  expectRefused(commands[0], 3, "'nerve' of case 'bone'");
}

TEST_F(RecoveryCommand, LabelsAreExportedWithoutADamagedOneIfThatIsChosen)
{
  addStructures();
  const auto other = m_folder / "duct.nrrd";
  std::filesystem::copy_file(m_folder / "nerve.nrrd", other);
  std::fstream(other, std::ios::binary | std::ios::in | std::ios::out).seekp(-1, std::ios::end)
      << '\1';
  json("add bone --labels duct=" + quoted(other));
  damage(nlohmann::json::parse(textOf(library() / "cases/bone.json"))["labels"][0]["object"]);
  const std::string exported = "export bone --what labels --out " + quoted(m_folder / "a.seg.nrrd");
  expectRefused(exported, 3, "structure 'nerve' of case 'bone'");
  expectRefused(exported, 3, "--without-damaged");
  expectRefused(exported + " --part nerve --without-damaged --quiet", 3, "'nerve'");
  EXPECT_FALSE(std::filesystem::exists(m_folder / "a.seg.nrrd"));
  json(exported + " --part duct");
  const auto leftOut = json(exported + " --without-damaged")["left_out"];
  ASSERT_EQ(leftOut.size(), 1u);
  EXPECT_EQ(leftOut[0]["structures"], nlohmann::json({"nerve"}));
  const std::string written = textOf(m_folder / "a.seg.nrrd");
  EXPECT_NE(written.find("duct"), std::string::npos);
  EXPECT_EQ(written.find("nerve"), std::string::npos);
}

// A structure need not be read: derived data suffice, or it is hidden.
TEST_F(RecoveryCommand, ADamagedStructureIsNamedAlsoWhereItNeedNotBeRead)
{
  const auto manifest = addStructures();
  const std::string drill = "drill bone --tick-hz 200 --path " + quoted(writeSession());
  const std::string render =
      "render bone --engine reference --size 16x16 --out " + quoted(m_folder / "a.png");
  json("appearance bone --flags nerve=touchable --flags incus=none");
  json("add bone --mesh shell=" + quoted(m_folder / "incus.obj"));
  for (const std::string& command : {drill, drill, render})
    json(command); // the second finds derived data
  const auto named = [&](const std::string& object, const std::string& words)
  {
    const auto file = library() / "objects" / object;
    const std::string whole = textOf(file);
    for (const std::string& command : {drill, render})
    {
      damage(object);
      expectRefused(command, 3, words + " of case 'bone' is damaged");
      expectRefused(command, 3, "petrous library verify");
      std::filesystem::remove(file);
      expectRefused(command, 3, words + " of case 'bone' is missing");
      std::ofstream(file, std::ios::binary) << whole;
    }
    json(render);
  };
  named(manifest["labels"][0]["object"], "structure 'nerve'");
  named(manifest["meshes"][0]["object"], "mesh 'incus'"); // both meshes
}

TEST_F(RecoveryCommand, DistancesAreGivenForMeshesToo)
{
  std::ofstream(m_folder / "incus.obj") << "v 0 0 0\nv 4 0 0\nv 0 4 0\nv 0 0 4\n"
                                           "f 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n";
  json("add bone --mesh incus=" + quoted(m_folder / "incus.obj"));
  // The burr of 4 mm stands at x = 14 mm, out of the bone; the mesh ends at x = 4 mm.
  const auto path = m_folder / "still.csv";
  std::ofstream(path) << "t_s,x_mm,y_mm,z_mm,qw,qx,qy,qz,drill\n0,14,0,0,1,0,0,0,0\n"
                         "0.1,14,0,0,1,0,0,0,0\n";
  const auto distances = json("drill bone --path " + quoted(path))["min_distance_mm"];
  ASSERT_TRUE(distances.contains("incus")) << distances;
  EXPECT_NEAR(distances["incus"].get<double>(), 8.0, 0.3);
}

// The CT is checked against its hash in parallel with the command, which must not finish before the
// check.
TEST_F(RecoveryCommand, NothingIsSavedOrSaidOfADamagedCt)
{
  std::filesystem::path object;
  for (const auto& entry : std::filesystem::directory_iterator(library() / "objects"))
    object = entry.path();
  std::string mr = textOf(m_folder / "bone.nrrd");
  mr.back() = static_cast<char>(mr.back() + 1);
  std::ofstream(m_folder / "mr.nrrd", std::ios::binary) << mr;
  json("add bone --mr other=" + quoted(m_folder / "mr.nrrd"));
  {
    std::fstream file(object, std::ios::binary | std::ios::in | std::ios::out);
    file.seekp(-1000, std::ios::end);
    file.put('\1');
  }
  const auto before = libraryContent();
  const auto points = m_folder / "points.csv";
  std::ofstream(points) << "x_mm,y_mm,z_mm\n0,0,0\n";
  const std::string picture = quoted(m_folder / "picture.png");
  for (const std::string& arguments :
       {std::string("appearance bone --iso auto"), "slice bone --plane axial --out " + picture,
        "render bone --engine reference --size 16x16 --out " + picture,
        "probe bone --points " + quoted(points),
        "probe bone --points " + quoted(points) + " --out " + quoted(m_folder / "rows.csv")})
    expectRefused(arguments, 3, "the CT of case 'bone'");
  const auto transform = m_folder / "transform.txt";
  std::ofstream(transform) << "1 0 0 0  0 1 0 0  0 0 1 0  0 0 0 1\n";
  expectRefused("register bone --mr other --as-is --transform " + quoted(transform), 3,
                "the CT of case 'bone'");
  EXPECT_FALSE(std::filesystem::exists(m_folder / "picture.png"));
  EXPECT_FALSE(std::filesystem::exists(m_folder / "rows.csv"));
  EXPECT_EQ(libraryContent(), before);

  const Outcome outcome = run("probe bone --json --points " + quoted(points));
  EXPECT_EQ(outcome.code, 3);
  EXPECT_TRUE(nlohmann::json::parse(outcome.out).contains("error")) << outcome.out;
  json("export bone --what mr --part other --out " + quoted(m_folder / "other.nrrd"));
  EXPECT_TRUE(std::filesystem::exists(m_folder / "other.nrrd")) << "it reads nothing of the CT";
}

TEST_F(RecoveryCommand, ALostImageIsSaidByWhatLooksAtItsCase)
{
  EXPECT_FALSE(json("info bone").contains("lost"));
  const auto object = library() / "objects" / addStructures()["ct"]["object"].get<std::string>();
  std::filesystem::remove(object);
  const auto lost = json("info bone")["lost"];
  ASSERT_EQ(lost.size(), 1u);
  EXPECT_NE(lost[0].get<std::string>().find("the CT of case 'bone' is missing"), std::string::npos);
  const Outcome shown = run("info bone");
  EXPECT_NE(shown.out.find("is missing"), std::string::npos) << shown.out;
  const Outcome copied = run("library copy bone twin");
  EXPECT_EQ(copied.code, 0) << copied.err;
  EXPECT_NE(copied.err.find("the CT of case 'bone' is missing"), std::string::npos) << copied.err;
  const Outcome repaired = run("library repair --json");
  EXPECT_EQ(repaired.code, 3);
  const auto said = nlohmann::json::parse(repaired.out);
  ASSERT_EQ(said["lost"].size(), 2u);
  EXPECT_NE(said["lost"][1].get<std::string>().find("case 'twin'"), std::string::npos);
  const Outcome verified = run("library verify");
  EXPECT_EQ(verified.code, 3);
  EXPECT_NE(verified.out.find("needed by: 'bone', 'twin'"), std::string::npos) << verified.out;
  json("new other --ct " + quoted(m_folder / "bone.nrrd")); // the same image again
  EXPECT_EQ(run("library repair").code, 0);
  EXPECT_FALSE(json("info bone").contains("lost"));
}

TEST_F(RecoveryCommand, CtrlCEndsTheWaitForALibraryThatAnotherProgramUses)
{
  const int lock = ::open((library() / ".lock").c_str(), O_RDWR | O_CLOEXEC);
  ASSERT_EQ(::flock(lock, LOCK_EX), 0);
  const auto before = libraryContent();
  const std::string log = m_folder / "log";
  std::string words[] = {PETROUS_PROGRAM, "library",   "copy",   "bone",
                         "twin",          "--library", library()};
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
  while (textOf(log).find("another program is using the library") == std::string::npos)
  {
    ASSERT_EQ(::waitpid(process, nullptr, WNOHANG), 0) << "it waits, and says so";
    ::usleep(10000);
  }
  ::kill(process, SIGINT);
  int status = 0;
  ASSERT_EQ(::waitpid(process, &status, 0), process);
  ASSERT_TRUE(WIFSIGNALED(status)) << status;
  EXPECT_EQ(WTERMSIG(status), SIGINT);
  ::close(lock);
  EXPECT_EQ(libraryContent(), before);
}
