#include <cmath>
#include <cstring>
#include <fstream>
#include <sstream>
#include <vector>

#include "CommandRunner.h"

using namespace petrous::testing;

namespace
{

constexpr double kPi = 3.14159265358979323846;
constexpr int kSize = 90;
constexpr double kSpacing = 0.3;       // mm
constexpr double kArc = 9.0;           // mm, radius of the canal's centre line
constexpr double kCanal = 0.8;         // mm
constexpr double kMiddle = 0.5 * 26.7; // mm, of the grid from its first voxel
constexpr double kBall = 3.0;          // mm

// Bone of 1000 HU with a canal of 50 HU along a quarter of a circle, which ends in the bone, and a
// ball of 300 HU apart from it. Partial volume across a voxel at the borders.
class SegmentCommand : public CommandLine
{
protected:
  void SetUp() override
  {
    CommandLine::SetUp();
    std::ofstream file(m_folder / "bone.nrrd", std::ios::binary);
    file << "NRRD0004\ntype: short\ndimension: 3\nspace: left-posterior-superior\n"
         << "sizes: 90 90 90\nspace directions: (0.3,0,0) (0,0.3,0) (0,0,0.3)\n"
         << "space origin: (0,0,0)\nencoding: raw\nendian: little\n\n";
    const auto share = [](double depth) // of a voxel within a surface
    { return std::min(1.0, std::max(0.0, 0.5 + depth / kSpacing)); };
    for (int k = 0; k < kSize; ++k)
      for (int j = 0; j < kSize; ++j)
        for (int i = 0; i < kSize; ++i)
        {
          const double x = i * kSpacing;
          const double y = j * kSpacing;
          const double z = k * kSpacing - kMiddle;
          const double angle = std::min(kPi / 2.0, std::max(0.0, std::atan2(y - 8.0, x - 8.0)));
          const double dx = x - 8.0 - kArc * std::cos(angle);
          const double dy = y - 8.0 - kArc * std::sin(angle);
          const double canal = share(kCanal - std::sqrt(dx * dx + dy * dy + z * z));
          const double ball =
              share(kBall - std::sqrt((x - 22) * (x - 22) + (y - 22) * (y - 22) + z * z));
          const auto value =
              static_cast<std::int16_t>(std::lround(1000.0 - 950.0 * canal - 700.0 * ball));
          file.write(reinterpret_cast<const char*>(&value), sizeof value);
        }
    file.close();
    json("new ear --ct " + quoted(m_folder / "bone.nrrd"));
  }

  static std::vector<double> onArc(double angle)
  {
    return {8.0 + kArc * std::cos(angle), 8.0 + kArc * std::sin(angle), kMiddle};
  }

  std::filesystem::path points(const std::vector<double>& angles, double off) const
  {
    std::ofstream file(m_folder / "points.csv");
    file << "x_mm,y_mm,z_mm\n";
    double side = off;
    for (const double angle : angles)
    {
      const auto p = onArc(angle);
      file << p[0] << ',' << p[1] << ',' << p[2] + side << '\n';
      side = -side;
    }
    return m_folder / "points.csv";
  }

  nlohmann::json structure(const std::string& name) const
  {
    const auto info = json("info ear");
    for (const auto& label : info["labels"])
      if (label["name"] == name)
        return label;
    return nlohmann::json::object();
  }
};

} // namespace

TEST_F(SegmentCommand, MakesAStructureOfWhatLiesBetweenTwoIntensities)
{
  const auto made = json("segment ear hole --threshold -100,525 --seed 8,17,13.35");
  const double canal =
      kPi * kCanal * kCanal * (kArc * kPi / 2.0) + 4.0 / 3.0 * kPi * std::pow(kCanal, 3);
  EXPECT_NEAR(made["volume_mm3"].get<double>(), canal, 0.03 * canal);
  EXPECT_EQ(made["label"], "hole");
  EXPECT_NEAR(made["volume_mm3"].get<double>(),
              made["voxels"].get<double>() * std::pow(kSpacing, 3), 1e-9);
  const auto kept = structure("hole");
  EXPECT_EQ(kept["voxels"], made["voxels"]);

  // Without a seed, the ball too.
  const auto both = json("segment ear both --threshold -100,525");
  const double ball = 4.0 / 3.0 * kPi * std::pow(kBall, 3);
  EXPECT_NEAR(both["volume_mm3"].get<double>(), canal + ball, 0.05 * (canal + ball));
  EXPECT_NEAR(
      json("segment ear largest --threshold -100,525 --keep-largest")["volume_mm3"].get<double>(),
      ball, 0.05 * ball);
  EXPECT_EQ(json("library verify")["damaged"].size(), 0U);
}

TEST_F(SegmentCommand, ProposesTheRangeAroundTheSeed)
{
  const auto made = json("segment ear ball --threshold auto --seed 22,22,13.35");
  const double ball = 4.0 / 3.0 * kPi * std::pow(kBall, 3);
  EXPECT_LE(made["threshold"][0].get<double>(), 300.0);
  EXPECT_GE(made["threshold"][1].get<double>(), 300.0);
  EXPECT_NEAR(made["volume_mm3"].get<double>(), ball, 0.35 * ball);
}

TEST_F(SegmentCommand, SaysThatASeedLiesOnABorderAndKeepsThat)
{
  // The ball's last voxel along x, and bone behind it.
  const auto made = json("segment ear ball --threshold auto --seed 24.9,22.2,13.5");
  ASSERT_FALSE(made["warnings"].empty());
  EXPECT_NE(made["warnings"][0].get<std::string>().find("lies on a border of tissues"),
            std::string::npos);
  EXPECT_NE(json("info ear").dump().find("\"The seed at "), std::string::npos)
      << "it is kept in the case, without the name";
  EXPECT_TRUE(json("segment ear inside --threshold auto --seed 22,22,13.35")["warnings"].empty());
}

// The ball lies within the image, and grown by as much as the image is wide it does not.
TEST_F(SegmentCommand, JudgesARegionAsItIsInTheEnd)
{
  const std::string ball = "segment ear ball --replace --threshold 200,650 --seed 22,22,13.35";
  const std::string faces = "of the 6 faces of the image";
  EXPECT_EQ(json(ball)["warnings"].dump().find(faces), std::string::npos);
  EXPECT_NE(json(ball + " --margin 25")["warnings"].dump().find(faces), std::string::npos);
  EXPECT_NE(json("info ear").dump().find("reaches 6 " + faces), std::string::npos);
}

TEST_F(SegmentCommand, ProposesTheBrightestRegionOfAnMr)
{
  EXPECT_EQ(run("segment ear lesion --threshold auto --seed auto").code, 2) << "a CT";
  // The image turned: dark with a bright ball.
  std::ifstream from(m_folder / "bone.nrrd", std::ios::binary);
  std::string text((std::istreambuf_iterator<char>(from)), {});
  for (std::size_t at = text.find("\n\n") + 2; at + 1 < text.size(); at += 2)
  {
    std::int16_t value = 0;
    std::memcpy(&value, &text[at], sizeof value);
    value = static_cast<std::int16_t>(value > 200 && value < 900 ? 1000 - value : 100);
    std::memcpy(&text[at], &value, sizeof value);
  }
  std::ofstream(m_folder / "dwi.nrrd", std::ios::binary) << text;
  json("new dwi --modality MR --ct " + quoted(m_folder / "dwi.nrrd"));
  const auto made = json("segment dwi lesion --threshold auto --seed auto --keep-largest");
  EXPECT_NEAR(made["volume_mm3"].get<double>(), 4.0 / 3.0 * kPi * std::pow(kBall, 3), 12.0);
}

TEST_F(SegmentCommand, GrowsShrinksAndSmooths)
{
  const auto at = [&](const std::string& more)
  {
    return json("segment ear ball --replace --threshold 200,650 --seed 22,22,13.35 " +
                more)["volume_mm3"]
        .get<double>();
  };
  json("segment ear ball --threshold 200,650 --seed 22,22,13.35");
  const double plain = at("");
  EXPECT_NEAR(at("--smooth 0.5"), plain, 0.005 * plain);
  const auto ball = [](double radius) { return 4.0 / 3.0 * kPi * std::pow(radius, 3); };
  const double radius = std::cbrt(plain / ball(1.0));
  EXPECT_NEAR(at("--margin 1"), ball(radius + 1.0), 0.06 * ball(radius + 1.0));
  EXPECT_NEAR(at("--margin -1"), ball(radius - 1.0), 0.12 * ball(radius - 1.0));
}

TEST_F(SegmentCommand, TracesANerveThroughAFewPoints)
{
  const auto made =
      json("segment ear facial_nerve --tube " + quoted(points({0.1, 0.5, 1.0, 1.45}, 0.3)));
  EXPECT_NEAR(made["length_mm"].get<double>(), 1.35 * kArc, 0.5);
  EXPECT_NEAR(made["radius_mm"]["median"].get<double>(), kCanal, 0.12);
  EXPECT_LE(made["radius_mm"]["min"], made["radius_mm"]["median"]);
  EXPECT_LE(made["radius_mm"]["median"], made["radius_mm"]["max"]);
  EXPECT_NEAR(made["points_to_path_mm"]["max"].get<double>(), 0.3, 0.2);
  for (const auto& p : made["path_mm"])
  {
    const double x = p[0].get<double>() - 8.0;
    const double y = p[1].get<double>() - 8.0;
    const double z = p[2].get<double>() - kMiddle;
    const double across = std::sqrt(x * x + y * y) - kArc;
    EXPECT_LT(std::sqrt(across * across + z * z), 0.3);
  }
  EXPECT_EQ(structure("facial_nerve")["voxels"], made["voxels"]);

  const auto given =
      json("segment ear thin --radius 0.5 --tube " + quoted(m_folder / "points.csv"));
  EXPECT_DOUBLE_EQ(given["radius_mm"]["max"].get<double>(), 0.5);
  const double tube = kPi * 0.25 * given["length_mm"].get<double>();
  EXPECT_NEAR(given["volume_mm3"].get<double>(), tube, 0.15 * tube);

  // How much of it is a guess stays with the case.
  for (const auto& [name, told] : {std::pair("facial_nerve", made), std::pair("thin", given)})
  {
    const auto kept = structure(name)["traced_tubes"];
    EXPECT_EQ(kept["length_mm"], told["length_mm"]);
    EXPECT_EQ(kept["bridging_voxels"], told["bridging_voxels"]);
    EXPECT_NEAR(kept["unresolved_mm"].get<double>(),
                told["length_mm"].get<double>() - told["resolved_mm"].get<double>(), 1e-9);
  }
  json("segment ear ball --threshold 200,650 --seed 22,22,13.35");
  EXPECT_FALSE(structure("ball").contains("traced_tubes"));
}

// Through the bone beside the canal, where there is no nerve.
TEST_F(SegmentCommand, SaysWhereNoNerveIsSeenAndKeepsIt)
{
  const std::filesystem::path file = m_folder / "nowhere.csv";
  std::ofstream(file) << "x_mm,y_mm,z_mm\n14,4,6\n17,7,7\n19,12,7\n21,16,6\n";
  const Outcome outcome =
      run("--json segment ear \"facial nerve elsewhere\" --tube " + quoted(file));
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  const auto made = nlohmann::json::parse(outcome.out);
  double unresolved = 0.0;
  for (const auto& stretch : made["unresolved"])
  {
    EXPECT_LT(stretch["from_mm"], stretch["to_mm"]);
    EXPECT_NE(stretch["why"], "none");
    unresolved += stretch["to_mm"].get<double>() - stretch["from_mm"].get<double>();
  }
  EXPECT_NEAR(unresolved, made["length_mm"].get<double>() - made["resolved_mm"].get<double>(),
              1e-6);
  EXPECT_GT(unresolved, 0.8 * made["length_mm"].get<double>());
  EXPECT_NE(made["warnings"].dump().find("not resolved from "), std::string::npos);
  EXPECT_NE(json("info ear").dump().find("\"Not resolved from "), std::string::npos)
      << "it is kept in the case";
}

TEST_F(SegmentCommand, IsUndoneByRemovingAndReplacesOnlyWhenTold)
{
  json("segment ear ball --threshold 200,650 --seed 22,22,13.35");
  json("appearance ear --set ball=nerve");
  EXPECT_EQ(run("segment ear ball --threshold 200,400").code, 4) << "the name is taken";
  json("segment ear ball --replace --threshold -100,525 --seed 8,17,13.35");
  EXPECT_EQ(json("info ear")["labels"].size(), 1U);
  const auto listed = json("appearance ear --list").dump();
  EXPECT_NE(listed.find("nerve"), std::string::npos) << "its look stays";
  json("remove ear --part ball");
  EXPECT_EQ(json("info ear")["labels"].size(), 0U);
}

TEST_F(SegmentCommand, TakesNoMeshAndNoMrForTheStructureOfItsName)
{
  json("segment ear ball --threshold 200,650 --seed 22,22,13.35");
  std::ofstream(m_folder / "ball.obj") << "v 20 20 12\nv 24 20 12\nv 20 24 12\nv 20 20 16\n"
                                       << "f 1 3 2\nf 1 2 4\nf 2 3 4\nf 1 4 3\n";
  json("add ear --mesh shell=" + quoted(m_folder / "ball.obj") +
       " --mr T2=" + quoted(m_folder / "bone.nrrd"));
  const auto before = json("info ear");
  ASSERT_EQ(before["meshes"].size(), 1U);
  EXPECT_EQ(before["meshes"][0]["closed"], true);
  EXPECT_EQ(before["meshes"][0]["open_edges"], 0);
  EXPECT_NEAR(before["meshes"][0]["volume_mm3"].get<double>(), 64.0 / 6.0, 1e-5);
  ASSERT_EQ(before["mr"].size(), 1U);
  for (const std::string name : {"shell", "T2"})
    for (const std::string more : {"", " --replace"})
    {
      const Outcome outcome = run("segment ear " + name + " --threshold -100,525" + more);
      EXPECT_EQ(outcome.code, 4) << name << more;
      EXPECT_NE(outcome.err.find("another name"), std::string::npos) << outcome.err;
    }
  EXPECT_EQ(json("info ear"), before);
}

TEST_F(SegmentCommand, RefusesWhatMakesNoStructureAndChangesNothing)
{
  const auto before = json("info ear");
  const auto refused = [&](const std::string& arguments, int code)
  {
    const Outcome outcome = run("segment ear " + arguments);
    EXPECT_EQ(outcome.code, code) << arguments << ": " << outcome.err;
    EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
  };
  refused("x", 2);
  refused("x --threshold 5,1", 2);
  refused("x --threshold 5", 2);
  refused("x --threshold nan,5", 2);
  refused("x --threshold 1,2 --tube a.csv", 2);
  refused("x --threshold 1,2 --radius 3", 2);
  refused("x --threshold 3000,4000", 3);
  refused("x --threshold 0,100 --seed 22,22,13.35", 3);
  refused("x --threshold 0,100 --seed 22,22,900", 3);
  refused("x --threshold 0,600 --min-volume 100000", 3);
  refused("ct --threshold 0,600", 3);
  refused("x --threshold 0,600 --source T2", 3);
  refused("x --tube " + quoted(m_folder / "none.csv"), 3);
  refused("x --radius 0 --tube " + quoted(points({0.1, 0.5}, 0.0)), 2);
  refused("x --tube " + quoted(points({0.1}, 0.0)), 3);
  refused("x --tube " + quoted(points({0.1, 0.1}, 0.0)), 3);
  std::ofstream(m_folder / "far.csv") << "x_mm,y_mm,z_mm\n10,10,10\n500,10,10\n";
  refused("x --tube " + quoted(m_folder / "far.csv"), 3);
  EXPECT_EQ(json("info ear"), before);
}
