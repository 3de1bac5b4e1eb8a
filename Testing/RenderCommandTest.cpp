#include <cmath>
#include <cstring>
#include <vector>

#include "CommandRunner.h"

using namespace petrous::testing;

namespace
{

// A ball of bone of 15 mm around (10, -20, 30), 32 voxels of 1.5 mm.
constexpr double kCenter[3] = {10.0, -20.0, 30.0};
constexpr double kRadius = 15.0;

class RenderCommand : public CommandLine
{
protected:
  void SetUp() override
  {
    CommandLine::SetUp();
    std::vector<float> voxels;
    for (int k = 0; k < edge; ++k)
      for (int j = 0; j < edge; ++j)
        for (int i = 0; i < edge; ++i)
        {
          const double depth = kRadius - fromCenter(i, j, k);
          voxels.push_back(static_cast<float>(std::clamp(300.0 + 200.0 * depth, -1000.0, 2000.0)));
        }
    write("ball.nrrd", "float", voxels);
    json("new ball --ct " + quoted(m_folder / "ball.nrrd"));
    json("appearance ball --iso 300"); // overrides the value suggested from its few grey values
  }

  static constexpr int edge = 32;
  static constexpr double spacing = 1.5;
  static constexpr double half = 0.5 * spacing * (edge - 1);

  static double fromCenter(int i, int j, int k) // mm
  {
    const auto square = [](int n) { return std::pow(n * spacing - half, 2); };
    return std::sqrt(square(i) + square(j) + square(k));
  }

  template <class T>
  void write(const std::string& name, const std::string& type, const std::vector<T>& voxels)
  {
    std::ofstream file(m_folder / name, std::ios::binary);
    file << "NRRD0004\ntype: " << type << "\ndimension: 3\nspace: left-posterior-superior\n"
         << "sizes: 32 32 32\nspace directions: (1.5,0,0) (0,1.5,0) (0,0,1.5)\n"
         << "space origin: (" << kCenter[0] - half << ',' << kCenter[1] - half << ','
         << kCenter[2] - half << ")\nencoding: raw\nendian: little\n\n";
    file.write(reinterpret_cast<const char*>(voxels.data()),
               static_cast<std::streamsize>(voxels.size() * sizeof(T)));
  }

  // A ball of 12 mm inside the ball, as a structure.
  void addNerve()
  {
    std::vector<unsigned char> inside;
    for (int k = 0; k < edge; ++k)
      for (int j = 0; j < edge; ++j)
        for (int i = 0; i < edge; ++i)
          inside.push_back(fromCenter(i, j, k) < 12.0 ? 1 : 0);
    write("nerve.nrrd", "uint8", inside);
    json("add ball --labels nerve=" + quoted(m_folder / "nerve.nrrd"));
  }

  std::filesystem::path camera(const std::string& text)
  {
    std::ofstream(m_folder / "camera.json") << text;
    return m_folder / "camera.json";
  }

  // 100 mm from the ball's centre, from the patient's right.
  std::filesystem::path fromTheRight()
  {
    return camera(R"({"position_mm":[-90,-20,30],"focal_point_mm":[10,-20,30],)"
                  R"("view_up":[0,0,1],"view_angle_deg":40})");
  }

  std::string render(const std::string& options)
  {
    return "render ball --size 64x48 --out " + quoted(m_folder / "p.png") + " " + options;
  }

  // At the picture's pixel, mm.
  float depthAt(int column, int row)
  {
    const std::string npy = textOf(m_folder / "d.npy");
    const std::size_t data = npy.size() - 64 * 48 * 4;
    float value = 0;
    std::memcpy(&value, npy.data() + data + 4 * static_cast<std::size_t>(64 * row + column), 4);
    return value;
  }
};

} // namespace

TEST_F(RenderCommand, TellsWhatRanAndWhatItCost)
{
  const auto answer = json(render(""));
  EXPECT_EQ(answer["size"], (std::vector<int>{64, 48}));
  EXPECT_EQ(answer["engine"], "gpu");
  EXPECT_EQ(answer["variant"], (std::vector<std::string>{"ct", "bone"}));
  EXPECT_GT(answer["fetches_per_pixel"].get<double>(), 0.0);
  EXPECT_GT(answer["samples_per_pixel"].get<double>(), 0.0);
  EXPECT_GT(answer["milliseconds"].get<double>(), 0.0);
  EXPECT_GT(answer["first_frame_milliseconds"].get<double>(), 0.0);
  EXPECT_TRUE(answer["gl_renderer"].is_string());
  EXPECT_TRUE(answer["notes"].empty());

  // The reported camera is accepted as input and gives the same picture.
  const std::string picture = textOf(m_folder / "p.png");
  json(render("--camera " + quoted(camera(answer["camera"].dump()))));
  EXPECT_EQ(textOf(m_folder / "p.png"), picture);
  EXPECT_TRUE(answer["resources"].contains("ct.texture"));
}

TEST_F(RenderCommand, BothEnginesMeasureTheSameDepth)
{
  const std::string options = "--camera " + quoted(fromTheRight()) + " --depth " +
                              quoted(m_folder / "d.npy") + " --engine ";
  for (const std::string engine : {"gpu", "reference"})
  {
    json(render(options + engine));
    EXPECT_NEAR(depthAt(32, 24), 100.0 - kRadius, 0.1) << engine; // the ray nearest to the axis
    EXPECT_TRUE(std::isnan(depthAt(0, 0))) << engine;
  }
  // In stereo it is the camera's own depth, between the eyes.
  json(render(options + "gpu --stereo side-by-side"));
  EXPECT_NEAR(depthAt(32, 24), 100.0 - kRadius, 0.1);
}

TEST_F(RenderCommand, StereoIsTheSameFromBothEngines)
{
  const std::string eyes = " --eye-separation 12 --convergence 90";
  const auto answer = json(render("--stereo anaglyph --camera " + quoted(fromTheRight()) + eyes));
  EXPECT_EQ(answer["stereo"]["eye_separation_mm"], 12.0);
  EXPECT_EQ(answer["stereo"]["convergence_mm"], 90.0);
  EXPECT_EQ(json(render("--engine reference --stereo interleaved" + eyes))["stereo"]["mode"],
            "interleaved");
  // From a microscope's angle between the eyes, 5.5 degrees, at the focal point, 100 mm away.
  const auto usual = json(render("--stereo side-by-side --camera " + quoted(fromTheRight())));
  EXPECT_NEAR(usual["stereo"]["eye_separation_mm"].get<double>(), 9.6, 0.05);
  EXPECT_EQ(usual["size"], (std::vector<int>{64, 48}));
}

TEST_F(RenderCommand, RefusesStereoThatCannotBe)
{
  expectRefused(render("--stereo cross-eyed"), 2, "side-by-side");
  expectRefused(render("--eye-separation 20"), 2, "--stereo");
  expectRefused(render("--stereo anaglyph --eye-separation -3"), 2, "0 to 200 mm, not -3");
  expectRefused(render("--stereo anaglyph --convergence 20000"), 2, "1 to 10000 mm, not 20000");
  expectRefused("render ball --out x.png --size 65x48 --stereo side-by-side", 2, "even width");
}

TEST_F(RenderCommand, NamesACameraFileThatIsNoCamera)
{
  const std::string head = R"({"focal_point_mm":[10,-20,30],"view_up":[0,0,1],)";
  const std::string angle = R"("view_angle_deg":40})";
  for (const std::string& text :
       {head + R"("position_mm":[NaN,-20,30],)" + angle,
        head + R"("position_mm":[Infinity,-20,30],)" + angle,
        head + R"("position_mm":[1e999,-20,30],)" + angle,
        head + R"("position_mm":[1e300,-20,30],)" + angle,
        head + R"("position_mm":[null,-20,30],)" + angle,
        head + R"("position_mm":[10,-20,30],)" + angle,           // no viewing direction
        head + R"("position_mm":[10,-20,300],)" + angle,          // parallel to view_up
        head + R"("position_mm":[0,-20,30],"view_angle_deg":0})", // zero view angle
        head + R"("position_mm":[0,-20,30],"parallel_scale_mm":-1})", std::string("[]"),
        std::string()})
    expectRefused(render("--camera " + quoted(camera(text))), 3, "camera.json");
}

TEST_F(RenderCommand, CutsByPlanesAndBoxes)
{
  const std::string options =
      "--camera " + quoted(fromTheRight()) + " --depth " + quoted(m_folder / "d.npy") + " ";
  // The far half remains.
  json(render(options + "--clip 10,-20,30,2,0,0"));
  EXPECT_NEAR(depthAt(32, 24), 100.0, 0.1);
  json(render(options + "--roi 13,40,-60,60,-60,90"));
  EXPECT_GT(depthAt(32, 24), 100.0);
  EXPECT_LT(depthAt(32, 24), 100.0 + 3.0 + 1.6);
  json(render(options + "--crop 20,31,0,31,0,31"));
  EXPECT_NEAR(depthAt(32, 24), 100.0 + 20.0 * 1.5 - 0.5 * 1.5 * 31, 0.1);

  const std::string plane = " --clip 0,0,0,1,0,0";
  expectRefused(render(plane + plane + plane + plane + plane + plane + plane), 2, "at most 6");
  expectRefused(render("--clip 0,0,0,0,0,0"), 2, "normal");
  expectRefused(render("--crop 9,3,0,31,0,31"), 2, "--crop");
  expectRefused(render("--roi 500,600,0,1,0,1"), 2, "does not overlap the CT");
  expectRefused(render("--roi 0,1,0,1,0,1 --crop 0,31,0,31,0,31"), 2, "not both");
}

// Also where the plane lies beside all bone.
TEST_F(RenderCommand, SaysInThePictureThatItIsCut)
{
  const auto drawn = [this](const std::string& options)
  {
    json("render ball --view anterior --size 400x300 --out " + quoted(m_folder / "p.png") + " " +
         options);
    return textOf(m_folder / "p.png");
  };
  const auto filmed = [this](const std::string& options)
  {
    json("render ball --view anterior --size 400x300 --turntable 2 --out " +
         quoted(m_folder / "f.png") + " " + options);
    return textOf(m_folder / "f-0001.png");
  };
  const std::string print = " --width-mm 100 --dpi 100";
  const std::string whole = drawn(""), printed = drawn(print), film = filmed("");
  json("view ball --clip 0,-1000,0,0,1,0"); // far beside the ball
  const std::string said = drawn("");
  EXPECT_NE(said, whole);
  EXPECT_NE(drawn(print), printed);
  EXPECT_NE(filmed(""), film);
  EXPECT_EQ(drawn("--plain"), whole);
  EXPECT_EQ(drawn("--plain" + print), printed);
  EXPECT_EQ(filmed("--plain"), film);
  EXPECT_EQ(drawn("--clip 0,-1000,0,0,1,0 --plain"), said);
}

TEST_F(RenderCommand, TheBackgroundIsANameOrAColour)
{
  const auto drawn = [this](const std::string& options)
  {
    json(render("--camera " + quoted(fromTheRight()) + " " + options));
    return textOf(m_folder / "p.png");
  };
  const std::string plain = drawn("");
  EXPECT_EQ(drawn("--background dark-grey"), plain);
  const std::string white = drawn("--background white");
  EXPECT_NE(white, plain);
  EXPECT_EQ(drawn("--background '#ffffff'"), white);
  EXPECT_NE(drawn("--background black"), plain);
  EXPECT_EQ(json(render("--background '#123456'")).at("background"), "#123456");
  for (const char* other : {"grey", "'#fff'", "'#12345g'"})
    expectRefused(render(std::string("--background ") + other), 2, "#rrggbb");
}

TEST_F(RenderCommand, TheLampHasAMicroscopesLook)
{
  const auto drawn = [this](const std::string& options)
  {
    json(render("--camera " + quoted(fromTheRight()) + " " + options));
    return textOf(m_folder / "p.png");
  };
  const std::string plain = drawn("");
  EXPECT_EQ(drawn("--light-falloff 0 --wetness 0"), plain);
  EXPECT_NE(drawn("--light-falloff 60"), plain);
  EXPECT_NE(drawn("--wetness 1"), plain);
  EXPECT_NE(drawn("--shadows"), plain);
  EXPECT_EQ(drawn("--no-shadows"), plain);
  EXPECT_EQ(drawn("--edges 0"), plain);
  EXPECT_EQ(drawn("--grain 1"), plain) << "nothing was cut";
  EXPECT_EQ(drawn("--no-exit-surfaces"), plain);
  EXPECT_EQ(drawn("--exposure 0 --no-tone-curve"), plain);
  EXPECT_NE(drawn("--exposure -1"), plain);
  EXPECT_NE(drawn("--exposure 1"), plain);
  EXPECT_NE(drawn("--exposure 1 --tone-curve"), drawn("--exposure 1"));
  expectRefused(render("--exposure 5"), 2, "EV");
  expectRefused(render("--exposure nan"), 2, "--exposure");
  expectRefused(render("--wetness 1.5"), 2, "--wetness");
  EXPECT_EQ(drawn("--shadows=false"), plain);
  expectRefused(render("--shadows=some"), 2, "--shadows");
  for (const char* flag : {"--no-shadows", "--no-tone-curve"})
    for (const char* value : {"false", "true", "3", "some"})
      expectRefused(render(std::string(flag) + "=" + value), 2, "takes no value");
  expectRefused(render("--edges 1.5"), 2, "--edges");
  expectRefused(render("--grain 1.5"), 2, "--grain");
  for (const char* both : {"--shadows --no-shadows", "--no-tone-curve --tone-curve=true",
                           "--soft-tissue=skin --no-soft-tissue"})
    expectRefused(render(both), 2, "contradict");
  const std::string help = run("render --help").out;
  EXPECT_NE(help.find("--no-shadows"), std::string::npos);
  EXPECT_EQ(help.find('{'), std::string::npos);
  EXPECT_EQ(help.find("FLOAT"), std::string::npos);
  expectRefused(render("--light-falloff -1"), 2, "mm");
  expectRefused(render("--light-falloff nan"), 2, "--light-falloff");
}

TEST_F(RenderCommand, SoftTissueOfOnePictureLeavesTheCase)
{
  const auto drawn = [this](const std::string& options)
  {
    json(render("--camera " + quoted(fromTheRight()) + " " + options));
    return textOf(m_folder / "p.png");
  };
  const std::string plain = drawn("");
  EXPECT_EQ(drawn("--no-soft-tissue"), plain);
  EXPECT_NE(drawn("--soft-tissue=skin"), plain);
  EXPECT_NE(drawn("--soft-tissue"), drawn("--soft-tissue=skin"));
  for (const char* good : {"--soft-tissue", "--soft-tissue=skin"})
  {
    const auto outcome = run(render(good));
    EXPECT_EQ(outcome.code, 0) << good;
    EXPECT_EQ(outcome.err.find("soft tissue is not drawn"), std::string::npos) << outcome.err;
  }
  // One colour would fill air too.
  const auto outcome = run(render("--soft-tissue=other"));
  EXPECT_EQ(outcome.code, 0);
  EXPECT_NE(outcome.err.find("soft tissue is not drawn"), std::string::npos) << outcome.err;
  EXPECT_EQ(drawn("--soft-tissue=other"), plain);
  EXPECT_NE(run(render("--soft-tissue=bone")).err.find("where soft tissue ends"),
            std::string::npos);
  EXPECT_EQ(json("info ball")["soft_tissue"]["flags"], "none");
  json("appearance ball --flags soft-tissue=shown --tf soft-tissue=none");
  EXPECT_NE(run(render("")).err.find("soft tissue is not drawn"), std::string::npos);
  EXPECT_EQ(run(render("--no-soft-tissue")).err.find("soft tissue"), std::string::npos);
  EXPECT_EQ(json(render("--soft-tissue"))["mr"], nlohmann::json::array()) << "it reads the CT";
  expectRefused(render("--soft-tissue=zebra"), 3, "zebra");
  for (const char* value : {"skin", "true", "false", "zebra"})
    expectRefused(render(std::string("--no-soft-tissue=") + value), 2, "takes no value");
  expectRefused(render("--soft-tissue=air-cells"), 3, "lumen");
}

TEST_F(RenderCommand, ColorsBoneByItsThicknessOverAStructure)
{
  addNerve();
  json(render(""));
  const std::string plain = textOf(m_folder / "p.png");
  const auto answer = json(render("--thickness nerve"));
  EXPECT_NE(textOf(m_folder / "p.png"), plain);
  const auto& variant = answer["variant"];
  EXPECT_EQ(std::count(variant.begin(), variant.end(), "thickness"), 1);
  EXPECT_GT(answer["resources"]["labels.thickness"].get<double>(), 1000.0);
  EXPECT_EQ(answer["thickness"]["structure"], "nerve");
  EXPECT_EQ(answer["thickness"]["farthest_mm"], 5.0);
  EXPECT_EQ(answer["thickness"]["colors"].size(), 9U);
  json(render("--thickness nerve --engine reference"));
  EXPECT_NE(textOf(m_folder / "p.png"), plain);
  EXPECT_TRUE(json(render(""))["thickness"].is_null());
  EXPECT_EQ(textOf(m_folder / "p.png"), plain);
  expectRefused(render("--thickness sinus"), 3, "it has nerve");
}

TEST_F(RenderCommand, InfoTellsWhatWasLaidOpenWhereItIsAskedFor)
{
  addNerve();
  EXPECT_TRUE(json("info ball --exposed")["dissection"]["exposed"].empty());
  // From the right to 11 mm from the centre with a burr of 6 mm: 4 mm into the structure.
  const auto path = m_folder / "slow.csv";
  std::ofstream(path) << "t_s,x_mm,y_mm,z_mm,qw,qx,qy,qz,drill\n0," << kCenter[0] - 25.0 << ','
                      << kCenter[1] << ',' << kCenter[2] << ",1,0,0,0,1\n8," << kCenter[0] - 11.0
                      << ',' << kCenter[1] << ',' << kCenter[2] << ",1,0,0,0,1\n";
  json("drill ball --diameter 6 --mode 3dof --rpm 200000 --tick-hz 250 --path " + quoted(path));
  EXPECT_FALSE(json("info ball")["dissection"].contains("exposed"));
  const auto exposed = json("info ball --exposed")["dissection"]["exposed"];
  ASSERT_EQ(exposed.size(), 1U);
  EXPECT_EQ(exposed[0]["label"], "nerve");
  EXPECT_GT(exposed[0]["area_mm2"].get<double>(), 1.0);
  EXPECT_LT(exposed[0]["area_mm2"].get<double>(), 80.0);
}

TEST_F(RenderCommand, DoctorNamesTheRayCastersVariants)
{
  const auto answer = json("doctor");
  EXPECT_TRUE(answer["gl_renderer"].is_string());
  EXPECT_GE(answer["largest_3d_texture"].get<int>(), 256);
  EXPECT_TRUE(answer["ray_caster"]["works"].get<bool>());
  EXPECT_EQ(answer["ray_caster"]["variants"].size(), 11u);
  EXPECT_NE(run("doctor").out.find("ray caster"), std::string::npos);
}

// No driver at all: libEGL searches in a place without drivers.
TEST_F(RenderCommand, WithoutOpenGLNamesTheReferenceEngine)
{
  const auto plain = m_folder / "empty";
  std::filesystem::create_directories(plain);
  ::setenv("__EGL_VENDOR_LIBRARY_DIRS", plain.c_str(), 1);
  expectRefused(render(""), 1, "--engine reference");
  const auto answer = json("doctor");
  EXPECT_TRUE(answer["gl_renderer"].is_null());
  EXPECT_FALSE(answer["ray_caster"]["works"].get<bool>());
  EXPECT_FALSE(answer["advice"].empty());
  json(render("--engine reference"));
  ::unsetenv("__EGL_VENDOR_LIBRARY_DIRS");
}

TEST_F(RenderCommand, DrawsForPrintWithItsResolution)
{
  json("describe ball --side right");
  const auto file = m_folder / "print.png";
  // 127 mm at 100 dots per inch
  const auto answer = json("render ball --view anterior --size 400x300 --width-mm 127 --dpi 100 "
                           "--out " +
                           quoted(file));
  EXPECT_EQ(answer["size"][0], 500);
  EXPECT_EQ(answer["size"][1], 375);
  EXPECT_DOUBLE_EQ(answer["print"]["dpi"], 100.0);
  EXPECT_NEAR(answer["print"]["width_mm"], 127.0, 1e-9);
  const std::string png = textOf(file);
  const auto number = [&png](std::size_t at) // most significant byte first
  {
    std::uint32_t value = 0;
    for (std::size_t n = 0; n < 4; ++n)
      value = (value << 8) | static_cast<unsigned char>(png[at + n]);
    return value;
  };
  EXPECT_EQ(number(16), 500u); // IHDR
  EXPECT_EQ(number(20), 375u);
  const std::size_t at = png.find("pHYs");
  ASSERT_NE(at, std::string::npos);
  EXPECT_EQ(number(at + 4), 3937u); // 100 / 0.0254 m
  // Perspective: the picture's height at the focal point over its pixels.
  const auto& camera = answer["camera"];
  double distance = 0.0;
  for (std::size_t a = 0; a < 3; ++a)
    distance += std::pow(
        camera["position_mm"][a].get<double>() - camera["focal_point_mm"][a].get<double>(), 2);
  const double height =
      2.0 * std::sqrt(distance) * std::tan(camera["view_angle_deg"].get<double>() * M_PI / 360.0);
  EXPECT_NEAR(answer["print"]["mm_per_pixel"], height / 375.0, 1e-9);
  expectRefused("render ball --width-mm 2000 --dpi 2400 --out " + quoted(m_folder / "x.png"), 3,
                "12000 are possible");
  expectRefused("render ball --width-mm 100 --engine reference --out " + quoted(m_folder / "x.png"),
                2, "for print");
}

TEST_F(RenderCommand, TurnsTheBallOnceAround)
{
  const std::string out = quoted(m_folder / "turn.png");
  const auto answer = json("render ball --view anterior --size 64x48 --turntable 4 --out " + out);
  EXPECT_EQ(answer["frames"], 4);
  ASSERT_EQ(answer["files"].size(), 4u);
  for (const char* name : {"turn-0001.png", "turn-0004.png"})
    EXPECT_EQ(textOf(m_folder / name).substr(1, 3), "PNG") << name;
  EXPECT_FALSE(std::filesystem::exists(m_folder / "turn-0005.png"));
  // Half way round the camera is where it was, mirrored at the focal point but for its height.
  const auto& first = answer["cameras"][0];
  const auto& third = answer["cameras"][2];
  for (std::size_t a = 0; a < 2; ++a)
    EXPECT_NEAR(first["position_mm"][a].get<double>() + third["position_mm"][a].get<double>(),
                2.0 * first["focal_point_mm"][a].get<double>(), 1e-6);
  EXPECT_EQ(answer["removed_frames"], 0);
  EXPECT_TRUE(answer["left_out"].empty());
  const auto shorter = run("render ball --view anterior --size 64x48 --turntable 2 --out " + out);
  EXPECT_NE(shorter.err.find("2 frames of an earlier"), std::string::npos) << shorter.err;
  EXPECT_FALSE(std::filesystem::exists(m_folder / "turn-0003.png"));
  for (const char* name : {"turn-0003.png", "turn-0004.png"})
    std::ofstream(m_folder / name) << "mine";
  const auto beside = run("render ball --view anterior --size 64x48 --turntable 2 --out " + out);
  EXPECT_EQ(beside.code, 0) << beside.err;
  EXPECT_NE(beside.err.find("turn-0003.png and 1 behind it: not known"), std::string::npos)
      << beside.err;
  EXPECT_EQ(textOf(m_folder / "turn-0003.png"), "mine");
  EXPECT_EQ(textOf(m_folder / "turn-0004.png"), "mine");
  expectRefused("render ball --out " + quoted(m_folder / "one.mp4"), 2, "--turntable");
  expectRefused("render ball --turntable 1 --out " + out, 2, "2");
  expectRefused("render ball --turntable 4 --dpi 100 --out " + out, 2, "film");
  expectRefused("render ball --along nothing --out " + out, 3, "has no structures");
}

TEST_F(RenderCommand, FilmsAVideoOrNamesWhatIsMissing)
{
  const std::string film =
      "render ball --size 65x48 --turntable 3 --out " + quoted(m_folder / "turn.mp4");
  if (std::system("command -v ffmpeg >/dev/null 2>&1") != 0)
  {
    expectRefused(film, 3, "needs the program ffmpeg");
    EXPECT_FALSE(std::filesystem::exists(m_folder / "turn.mp4"));
    return;
  }
  json(film);
  EXPECT_EQ(textOf(m_folder / "turn.mp4").substr(4, 4), "ftyp");
  const std::string path = std::getenv("PATH");
  ::setenv("PATH", "/nowhere", 1);
  expectRefused(film, 3, "needs the program ffmpeg");
  ::setenv("PATH", path.c_str(), 1);
}
