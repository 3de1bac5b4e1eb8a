#include "CommandRunner.h"

using Json = nlohmann::json;
using petrous::testing::CommandLine;
using petrous::testing::quoted;
using petrous::testing::textOf;

namespace
{

class ViewCommand : public CommandLine
{
protected:
  void SetUp() override
  {
    CommandLine::SetUp();
    makePatient("--dims 48,48,45 --spacing 1.3");
    ASSERT_EQ(run("new ear --ct " + quoted(m_folder / "patient/ct") +
                  " --mr T2=" + quoted(m_folder / "patient/mr"))
                  .code,
              0);
  }

  /// The picture that a command draws.
  std::string drawn(const std::string& command) const
  {
    const auto out = m_folder / "out.png";
    const auto outcome = run(command + " --size 160x120 --out " + quoted(out));
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    return textOf(out);
  }
};

} // namespace

TEST_F(ViewCommand, HoldsTheHandpieceForAnApproachAsTheCaseIsLookedAt)
{
  json("describe ear --side right");
  const Json kept = json("view ear --view surgical-right --handpiece transmastoid");
  EXPECT_NEAR(kept["handpiece"]["turn_deg"], -40.0, 1e-6);
  EXPECT_NEAR(kept["handpiece"]["tilt_deg"], 20.0, 1e-6);
  EXPECT_EQ(kept["handpiece"]["hand"], "right");
  EXPECT_TRUE(kept["tool"].is_null()) << "the burr is that of who opens it";
  EXPECT_EQ(json("view ear")["handpiece"], kept["handpiece"]);
  const Json left = json("view ear --handpiece transmastoid --left-hand");
  EXPECT_NEAR(left["handpiece"]["turn_deg"], -140.0, 1e-6);
  EXPECT_EQ(left["handpiece"]["hand"], "left");
  const auto behind = run("view ear --view left --handpiece retrosigmoid");
  EXPECT_EQ(behind.code, 2);
  EXPECT_NE(behind.err.find("--view surgical-right"), std::string::npos) << behind.err;
  EXPECT_EQ(json("view ear")["handpiece"], left["handpiece"]);
  const auto noHand = run("view ear --handpiece usual --left-hand");
  EXPECT_EQ(noHand.code, 2);
  EXPECT_NE(noHand.err.find("--left-hand"), std::string::npos) << noHand.err;
  EXPECT_EQ(json("view ear")["handpiece"], left["handpiece"]);
  const Json usual = json("view ear --handpiece usual");
  EXPECT_TRUE(usual["handpiece"].is_null());
  EXPECT_TRUE(usual["tool"].is_null());
}

// A block in the middle of the scanner opens to no side.
TEST_F(ViewCommand, GuessesNoEarThatNothingTells)
{
  std::ofstream file(m_folder / "block.nrrd");
  file << "NRRD0004\ntype: short\ndimension: 3\nsizes: 8 8 8\n"
          "space: left-posterior-superior\nspace directions: (1,0,0) (0,1,0) (0,0,1)\n"
          "space origin: (0,0,0)\nencoding: ascii\n\n";
  for (int n = 0; n < 8 * 8 * 8; ++n)
    file << 900 + n / 8 << '\n'; // alike from left to right
  file.close();
  json("new block --modality CT --ct " + quoted(m_folder / "block.nrrd"));
  const std::string slice =
      "slice block --plane poeschl --at 4,4,4 --out " + quoted(m_folder / "slice.png");
  expectRefused("view block --view left --handpiece transmastoid", 2, "--side");
  expectRefused(slice, 2, "--side left or right");
  const auto lateral = run("view block --view lateral");
  EXPECT_EQ(lateral.code, 0) << lateral.err;
  EXPECT_NE(lateral.err.find("does not tell which ear it is"), std::string::npos) << lateral.err;
  // Also where no view is asked for: the case has none yet.
  const auto expectDoubt = [this](const std::string& command, bool isDoubtful)
  {
    const auto answer = run(command);
    EXPECT_EQ(answer.code, 0) << answer.err;
    // The middle of 8 voxels of 1 mm from 0 on is at x = 3.5 mm: left.
    EXPECT_EQ(answer.err.find("the lateral view is from the patient's left") != std::string::npos,
              isDoubtful)
        << command << '\n'
        << answer.err;
  };
  const std::string render = "render block --size 40x30 --out " + quoted(m_folder / "block.png");
  json("view block --clear camera");
  expectDoubt("view block --save-as first", true);
  expectDoubt(render, true);
  expectDoubt(render + " --view superior", false);
  json("view block --view superior");
  expectDoubt(render, false);
  expectDoubt("view block --save-as second", false);
  EXPECT_EQ(run(slice + " --side right").code, 0);
  json("describe block --side right");
  EXPECT_EQ(run("view block --view right --handpiece transmastoid").code, 0);
  EXPECT_EQ(run(slice).code, 0);
  EXPECT_EQ(run("view block --view lateral").err.find("which ear"), std::string::npos);
}

TEST_F(ViewCommand, RenderAndSliceShowWhatIsSaved)
{
  const Json info = json("info ear").at("ct");
  const auto center = [&](int axis)
  {
    return info["origin_mm"][axis].get<double>() +
           0.5 * info["dims"][axis].get<double>() * info["spacing_mm"][axis].get<double>();
  };
  const std::string at = std::to_string(center(0)) + "," + std::to_string(center(1) + 5.0) + "," +
                         std::to_string(center(2));
  const std::string render =
      "--view superior --light-falloff 150 --wetness 0.5 --shadows --exposure 0.5 "
      "--tone-curve --edges 0.25 --grain 0.5 --exit-surfaces --stereo anaglyph --eye-separation 20 "
      "--clip " +
      at + ",0,0,-1 --crop 0,47,0,40,0,44";
  const std::string plain = drawn("render ear");
  const std::string wanted = drawn("render ear " + render);
  ASSERT_NE(plain, wanted);
  const Json set = json("view ear " + render + " --at " + at +
                        " --window 1500,300.25 --zoom axial=2.5 --overlay T2 --mode checker "
                        "--burr diamond --diameter 3 --thrust 2");
  EXPECT_TRUE(set.at("changed"));
  EXPECT_EQ(drawn("render ear"), wanted);
  EXPECT_EQ(drawn("render ear --plain --view lateral"), plain);
  EXPECT_EQ(json("render ear --stereo none --size 80x60 --out " + quoted(m_folder / "o.png"))
                .at("stereo"),
            nullptr);

  EXPECT_EQ(set.at("light").at("exposure_ev"), 0.5);
  EXPECT_EQ(set.at("light").at("tone_curve"), true);
  EXPECT_EQ(set.at("light").at("edges"), 0.25);
  EXPECT_EQ(set.at("light").at("grain"), 0.5);
  EXPECT_EQ(set.at("light").at("exit_surfaces"), true);
  EXPECT_EQ(json("view ear --exposure 0 --no-tone-curve").at("light").at("exposure_ev"), 0.0);
  EXPECT_NE(drawn("render ear"), wanted);
  EXPECT_EQ(drawn("render ear --exposure 0.5 --tone-curve"), wanted);
  EXPECT_EQ(json("view ear --exposure 0.5 --tone-curve").at("light").at("tone_curve"), true);
  EXPECT_EQ(set.at("light").at("shadows"), true);
  EXPECT_EQ(json("view ear --no-shadows").at("light").at("shadows"), false);
  EXPECT_NE(drawn("render ear"), wanted);
  EXPECT_EQ(drawn("render ear --shadows"), wanted);
  EXPECT_EQ(set.at("tool").at("burr"), "diamond");
  EXPECT_EQ(set.at("clipping").at("crop"), Json({0, 47, 0, 40, 0, 44}));
  const Json slice =
      json("slice ear --plane axial --size 160x120 --out " + quoted(m_folder / "a.png"));
  EXPECT_EQ(slice.at("window"), Json({{"width", 1500.0}, {"level", 300.25}}));
  EXPECT_EQ(slice.at("overlay").at("mr"), "T2");
  EXPECT_EQ(slice.at("overlay").at("mode"), "checker");
  const Json whole =
      json("slice ear --plane axial --size 160x120 --plain --out " + quoted(m_folder / "b.png"));
  EXPECT_NEAR(slice.at("mm_per_pixel").get<double>(), whole.at("mm_per_pixel").get<double>() / 2.5,
              1e-12);
  EXPECT_TRUE(whole.at("overlay").is_null());

  EXPECT_FALSE(json("view ear").at("changed"));
  const Json cleared = json("view ear --clear camera,slices,light,stereo,clipping,tool");
  EXPECT_TRUE(cleared.at("slices").is_null());
  EXPECT_EQ(drawn("render ear"), plain);
}

TEST_F(ViewCommand, ComesBackToTheBitFromAnArchive)
{
  std::ofstream(m_folder / "camera.json")
      << R"({"position_mm":[0.1,0.30000000000000004,500],"focal_point_mm":[0.2,0,0],)"
      << R"("view_up":[0,1,0.1],"view_angle_deg":33.333333333333336})";
  const Json set = json("view ear --camera " + quoted(m_folder / "camera.json") +
                        " --wetness 0.1 --light-falloff 333.3333333333333 --convergence 77.7 "
                        "--window 0.30000000000000004,-0.1");
  EXPECT_EQ(set.at("camera").at("view_angle_deg").get<double>(), 33.333333333333336);
  const std::string archive = quoted(m_folder / "ear.petrous");
  ASSERT_EQ(run("archive ear " + archive).code, 0);
  ASSERT_EQ(run("restore " + archive + " --as back").code, 0);
  Json back = json("view back");
  Json here = json("view ear");
  back.erase("case");
  here.erase("case");
  EXPECT_EQ(back, here);
}

TEST_F(ViewCommand, IsThatOfEachBranchAsItWasLeft)
{
  const Json main = json("view ear --view superior --crop 0,47,0,40,0,44 --window 1500,300.25");
  const auto seen = drawn("render ear");
  ASSERT_EQ(run("branch ear other").code, 0);
  EXPECT_EQ(drawn("render ear"), seen) << "a new one goes on from what is seen";
  json("view ear --clear clipping --view lateral --window 400,40");
  const auto other = drawn("render ear");
  EXPECT_NE(other, seen);
  ASSERT_EQ(run("branch ear main").code, 0);
  const Json back = json("view ear");
  for (const char* part : {"camera", "slices", "clipping"})
    EXPECT_EQ(back.at(part), main.at(part)) << part;
  EXPECT_EQ(drawn("render ear"), seen);
  const Json& left = back.at("branches").at("other");
  EXPECT_EQ(left.at("slices").at("window").at("width"), 400.0);
  EXPECT_EQ(left.at("clipping"), (Json{{"planes", Json::array()}, {"crop", nullptr}}))
      << "nothing is known to be cut away";

  const std::string archive = quoted(m_folder / "ear.petrous");
  ASSERT_EQ(run("archive ear " + archive).code, 0);
  ASSERT_EQ(run("restore " + archive + " --as back").code, 0);
  ASSERT_EQ(run("branch back other").code, 0);
  EXPECT_EQ(drawn("render back"), other);
}

TEST_F(ViewCommand, RefusesWhatIsWrong)
{
  for (const char* bad :
       {"--wetness 1.1", "--window 0,40", "--zoom axial=0.5", "--zoom oblique=2", "--zoom axial",
        "--clip 0,0,0,0,0,0", "--crop 5,1,0,1,0,1", "--overlay T9", "--mode blend", "--at 1,2",
        "--at 1e6,0,0", "--stereo quad", "--view up", "--burr drill", "--diameter 0",
        "--clear nothing", "--crop 0,1,0,1,0,1 --roi 0,1,0,1,0,1"})
    EXPECT_EQ(run("view ear " + std::string(bad)).code, 2) << bad;
  expectRefused("view nose", 3, "nose");
  expectRefused("view ear --camera /nowhere", 3, "/nowhere");
  EXPECT_FALSE(json("view ear").at("changed"));
  EXPECT_TRUE(json("view ear").at("slices").is_null());
}

TEST_F(ViewCommand, KeepsShowsAndRemovesViewsByName)
{
  json("view ear --view surgical-right --save-as 'Right ear'");
  const Json first = json("view ear");
  ASSERT_EQ(first.at("saved").size(), 1u);
  const Json camera = first.at("saved").at("Right ear").at("camera");
  EXPECT_EQ(camera.at("view_up"), (std::vector<double>{0.0, -1.0, 0.0}));
  json("view ear --view superior");
  EXPECT_NE(json("view ear").at("camera"), camera);
  EXPECT_EQ(json("view ear --show 'Right ear'").at("camera"), camera);
  EXPECT_EQ(run("view ear --show other").code, 2);
  EXPECT_EQ(run("view ear --save-as ' x'").code, 2);
  json("view ear --remove 'Right ear'");
  EXPECT_TRUE(json("view ear").at("saved").empty());
}

// Nothing is saved where nothing changes: another program may have the case open.
TEST_F(ViewCommand, ChangesNothingWhereTheSameInstrumentIsTakenUpAgain)
{
  const auto file = m_folder / "pick.obj";
  const auto write = [&file](const char* length)
  {
    std::ofstream(file) << "v 0 0 0\nv 1.25 0 " << length << "\nv -1 1 60\nv 0 -1 60\n"
                        << "f 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n";
  };
  write("60");
  const std::string take = "view ear --instrument " + quoted(file) + " --tool-axis z+";
  EXPECT_TRUE(json(take).at("changed"));
  EXPECT_FALSE(json(take).at("changed"));
  write("60.5");
  EXPECT_TRUE(json(take).at("changed"));
  // A lost one is put back by its file.
  const std::string object = json("view ear").at("instrument").at("object");
  std::filesystem::remove(m_folder / "library/objects" / object);
  const auto path = m_folder / "path.csv";
  std::ofstream(path) << "t_s,x_mm,y_mm,z_mm,qw,qx,qy,qz,drill\n0,0,0,0,1,0,0,0,1\n"
                      << "0.1,1,0,0,1,0,0,0,1\n";
  const auto lost = run("drill ear --case-tool --path " + quoted(path));
  EXPECT_EQ(lost.code, 3);
  EXPECT_NE(lost.err.find("the instrument of case 'ear'"), std::string::npos) << lost.err;
  EXPECT_NE(lost.err.find("--clear instrument"), std::string::npos) << lost.err;
  EXPECT_EQ(lost.err.find("--without-damaged"), std::string::npos) << lost.err;
  EXPECT_EQ(run(take).code, 0);
}
