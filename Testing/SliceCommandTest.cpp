#include <cmath>
#include <vector>

#include "CommandRunner.h"

using namespace petrous::testing;

namespace
{

class SliceCommand : public CommandLine
{
protected:
  void SetUp() override
  {
    CommandLine::SetUp();
    makePatient();
    const auto patient = m_folder / "patient";
    json("new ear --ct " + quoted(patient / "ct") + " --mr T2=" + quoted(patient / "mr") +
         " --labels " + quoted(patient / "labels.seg.nrrd"));
  }

  std::string slice(const std::string& options) const
  {
    return "slice ear --out " + quoted(m_folder / "slice.png") + " " + options;
  }
  std::string picture() const { return textOf(m_folder / "slice.png"); }
};

int bigEndian(const std::string& bytes, std::size_t at)
{
  int value = 0;
  for (std::size_t n = 0; n < 4; ++n)
    value = 256 * value + static_cast<unsigned char>(bytes[at + n]);
  return value;
}

} // namespace

TEST_F(SliceCommand, DrawsTheSizeAndPlaceThatWereAskedFor)
{
  const auto report = json(slice("--plane coronal --at -30,4,2 --size 300x200 --field-of-view 60"));
  EXPECT_EQ(report["center_mm"], (std::vector<double>{-30.0, 4.0, 2.0}));
  EXPECT_DOUBLE_EQ(report["mm_per_pixel"].get<double>(), 0.2);
  EXPECT_TRUE(report["overlay"].is_null());
  const std::string png = picture();
  ASSERT_EQ(png.substr(1, 3), "PNG");
  EXPECT_EQ(bigEndian(png, 16), 300); // IHDR
  EXPECT_EQ(bigEndian(png, 20), 200);
}

TEST_F(SliceCommand, FindsAStructuresCentre)
{
  const auto truth = nlohmann::json::parse(textOf(m_folder / "patient" / "truth.json"));
  const auto report = json(slice("--plane axial --at sigmoid_sinus --field-of-view 40"));
  const auto corner = json(slice("--plane axial --at -10,0,0 --field-of-view 40"));
  EXPECT_NE(report["center_mm"], corner["center_mm"]);
  // Inside the phantom.
  for (int a = 0; a < 3; ++a)
    EXPECT_LT(std::abs(report["center_mm"][a].get<double>() - truth["center_mm"][a].get<double>()),
              32.0);
}

TEST_F(SliceCommand, LoadsNoMrUnlessAskedAndSaysThatItIsNotRegistered)
{
  const auto alone = json(slice("--plane axial"));
  EXPECT_FALSE(alone["resources"].contains("mr.T2"));
  const std::string ct = picture();
  const auto both = run(slice("--plane axial --overlay T2 --mode blend --json"));
  EXPECT_EQ(both.code, 0);
  EXPECT_NE(both.err.find("'T2' is not registered"), std::string::npos) << both.err;
  const auto report = nlohmann::json::parse(both.out);
  EXPECT_TRUE(report["resources"].contains("mr.T2"));
  EXPECT_EQ(report["overlay"]["registered"], false);
  EXPECT_EQ(report["overlay"]["text"], "not registered");
  const std::string blend = picture();
  EXPECT_NE(blend, ct);
  json(slice("--plane axial --overlay T2 --mode edges"));
  const std::string edges = picture();
  json(slice("--plane axial --overlay T2 --mode checker"));
  EXPECT_NE(edges, blend);
  EXPECT_NE(edges, picture());
}

TEST_F(SliceCommand, RefusesWhatCannotBeInOneLine)
{
  expectRefused(slice("--plane diagonal"), 2, "axial, coronal, sagittal");
  expectRefused(slice("--plane oblique"), 2, "needs its --normal x,y,z");
  expectRefused(slice("--plane axial --normal 0,0,1"), 2, "goes with --plane oblique");
  expectRefused(slice("--plane axial --overlay T7"), 2, "it has 'T2'");
  expectRefused(slice("--plane axial --at nowhere"), 2, "name of a structure");
  expectRefused(slice("--plane axial --opacity 1.5"), 2, "--opacity");
  expectRefused(slice("--plane axial --mode glow"), 2, "blend, edges, checker");
  expectRefused(slice("--plane axial --field-of-view 0"), 2, "--field-of-view");
  expectRefused(slice("--plane axial --window 0,40"), 2, "--window");
  expectRefused(slice("--plane axial --window 4000,1e39"), 2, "the level must lie within");
  expectRefused(slice("--plane axial --window 1e39,40"), 2, "the width must be above 0, up to");
  expectRefused(slice("--plane axial --size 3x3"), 2, "--size");
  expectRefused("slice ear --plane axial --out /nowhere/slice.png", 4, "cannot be written");
}

TEST_F(SliceCommand, OutsideOfTheCtIsAnError)
{
  // The phantom's CT is 64 mm wide; the slice does not intersect it.
  expectRefused(slice("--plane axial --at -1000,0,0 --field-of-view 40"), 2,
                "does not meet the CT");
  expectRefused(slice("--plane axial --at -30,0,1e6"), 2, "patient LPS");
  EXPECT_FALSE(std::filesystem::exists(m_folder / "slice.png"));
}

// A slice that is missing from the files is interpolated with consent, and every picture says so.
TEST_F(SliceCommand, SaysWhichSlicesWereInterpolated)
{
  for (const char* image : {"ct", "mr"})
  {
    std::vector<std::filesystem::path> files(
        std::filesystem::directory_iterator(m_folder / "patient" / image), {});
    std::sort(files.begin(), files.end());
    std::filesystem::remove(files.at(files.size() / 2));
  }
  const auto patient = m_folder / "patient";
  json("new guessed --repair --ct " + quoted(patient / "ct") +
       " --mr T2=" + quoted(patient / "mr"));
  const std::string out = " --out " + quoted(m_folder / "guessed.png");
  const Outcome slice = run("slice guessed --plane axial --overlay T2" + out);
  EXPECT_EQ(slice.code, 0) << slice.err;
  const Outcome render = run("render guessed --view lateral --size 160x120" + out);
  EXPECT_EQ(render.code, 0) << render.err;
  for (const Outcome& outcome : {slice, render})
    for (const char* line : {"CT: slice ", "T2: slice "})
    {
      const auto at = outcome.err.find(line);
      ASSERT_NE(at, std::string::npos) << outcome.err;
      EXPECT_NE(outcome.err.find("interpolated", at), std::string::npos) << outcome.err;
    }
  // The slice itself says so, and those beside it do not.
  const nlohmann::json ct = json("info guessed").at("ct");
  const nlohmann::json slices = ct.at("provenance").at("interpolated_slices");
  ASSERT_EQ(slices.size(), 1U);
  EXPECT_EQ(slices[0][0], slices[0][1]);
  const double spacing = ct.at("spacing_mm")[2];
  const auto isMarked = [&](int number)
  {
    const double z = ct.at("origin_mm")[2].get<double>() + (number - 1) * spacing;
    return json("slice guessed --plane axial --at 0,0," + std::to_string(z) + out)
        .at("interpolated")
        .get<bool>();
  };
  const int gone = slices[0][0];
  EXPECT_TRUE(isMarked(gone));
  EXPECT_FALSE(isMarked(gone - 1));
  EXPECT_FALSE(isMarked(gone + 1));
  EXPECT_NE(run("info guessed").out.find("slice " + std::to_string(gone) + " of "),
            std::string::npos);
}

// Left ear: Stenvers along the pyramid, (-1, -1, 0); Poeschl across it.
TEST_F(SliceCommand, DrawsPetrousAndObliquePlanes)
{
  const auto normal = [this](const std::string& options)
  { return json(slice(options + " --at -30,4,2 --size 120x100")).at("normal"); };
  const auto expect = [](const nlohmann::json& is, double x, double y, double z)
  {
    EXPECT_NEAR(is[0].get<double>(), x, 1e-12);
    EXPECT_NEAR(is[1].get<double>(), y, 1e-12);
    EXPECT_NEAR(is[2].get<double>(), z, 1e-12);
  };
  const double half = std::sqrt(0.5);
  expect(normal("--plane stenver --side left"), -half, half, 0.0);
  expect(normal("--plane poeschl --side left"), half, half, 0.0);
  expect(normal("--plane stenver --side right"), half, half, 0.0);
  expect(normal("--plane poeschl --side right"), half, -half, 0.0);
  expect(normal("--plane stenver"), half, half, 0.0); // the sample is a right ear
  expect(normal("--plane oblique --normal 0,0.6,0.8"), 0.0, 0.6, 0.8);
  expect(normal("--plane oblique --normal=-2,0,0"), 1.0, 0.0, 0.0); // the same plane
  json(slice("--plane sagittal --at -30,4,2"));
  const std::string sagittal = picture();
  json(slice("--plane axial --at -30,4,2"));
  EXPECT_NE(picture(), sagittal);
  for (const char* bad : {"--plane oblique", "--plane axial --normal 1,0,0",
                          "--plane oblique --normal 0,0,0", "--plane axial --side left"})
    EXPECT_EQ(run(slice(bad)).code, 2) << bad;
}

TEST_F(SliceCommand, ProjectsASlab)
{
  const std::string at = "--plane axial --at -30,4,2 --size 120x100 --no-structures";
  EXPECT_TRUE(json(slice(at)).at("slab").is_null());
  const std::string thin = picture();
  const auto report = json(slice(at + " --slab 6"));
  EXPECT_EQ(report.at("slab"), (nlohmann::json{{"thickness_mm", 6.0}, {"projection", "mip"}}));
  const std::string brightest = picture();
  EXPECT_NE(brightest, thin);
  json(slice(at + " --slab 6 --projection minip"));
  EXPECT_NE(picture(), brightest);
  EXPECT_EQ(run(slice(at + " --projection mean")).code, 2);
  EXPECT_EQ(run(slice(at + " --slab -1")).code, 2);
}
