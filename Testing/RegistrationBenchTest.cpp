#include <array>
#include <cmath>
#include <functional>
#include <map>
#include <set>
#include <string>

#include "CommandRunner.h"

using namespace petrous::testing;

namespace
{

namespace fs = std::filesystem;
using Point = std::array<double, 3>;

class RegistrationBench : public CommandLine
{
protected:
  // A RIRE folder: header and big-endian voxels.
  void writeImage(const fs::path& folder, const std::array<int, 3>& dims, const Point& spacing,
                  const std::function<double(const Point&)>& value) const
  {
    fs::create_directories(folder);
    std::ofstream(folder / "header.ascii")
        << "Slice thickness := " << spacing[2]
        << "\nPatient Orientation := L : P : H\n\nRows := " << dims[1] << "\nColumns := " << dims[0]
        << "\nSlices := " << dims[2] << "\nPixel size := " << spacing[1] << " : " << spacing[0]
        << "\n";
    std::ofstream file(folder / "image.bin", std::ios::binary);
    for (int k = 0; k < dims[2]; ++k)
      for (int j = 0; j < dims[1]; ++j)
        for (int i = 0; i < dims[0]; ++i)
        {
          const int v = static_cast<int>(
              std::lround(value({i * spacing[0], j * spacing[1], k * spacing[2]})));
          file << static_cast<char>(v >> 8 & 0xFF) << static_cast<char>(v & 0xFF);
        }
  }
};

// A motion as in RIRE: a rotation about z, then a translation, all in mm from the first voxels.
constexpr double kTurn = 0.07;
constexpr Point kShift{4.0, -3.0, 2.5};

Point moved(const Point& p)
{
  const double c = std::cos(kTurn), s = std::sin(kTurn);
  return {c * p[0] - s * p[1] + kShift[0], s * p[0] + c * p[1] + kShift[1], p[2] + kShift[2]};
}

Point movedBack(const Point& q)
{
  const double c = std::cos(kTurn), s = std::sin(kTurn);
  const double x = q[0] - kShift[0], y = q[1] - kShift[1];
  return {c * x + s * y, -s * x + c * y, q[2] - kShift[2]};
}

// An asymmetric skull with a brain, ventricles and a sinus. Tissue: 0 air to 4.
int tissue(const Point& p)
{
  const auto within = [&p](double x, double y, double z, double a, double b, double c)
  { return std::hypot((p[0] - x) / a, (p[1] - y) / b, (p[2] - z) / c) < 1.0; };
  if (!within(70, 70, 50, 55, 62, 46))
    return 0;
  if (within(45, 30, 35, 9, 8, 12))
    return 0;
  if (!within(70, 70, 50, 47, 54, 38))
    return 3;
  if (within(60, 72, 55, 6, 20, 9) || within(82, 66, 52, 5, 16, 8) || within(95, 95, 40, 8, 7, 9))
    return 1;
  return within(60, 40, 60, 12, 9, 10) ? 4 : 2;
}

double ct(const Point& p)
{
  return std::array<double, 5>{-1000.0, 5.0, 38.0, 1100.0,
                               60.0}[static_cast<std::size_t>(tissue(p))];
}

double mr(const Point& q)
{
  return std::array<double, 5>{5.0, 150.0, 600.0, 20.0,
                               420.0}[static_cast<std::size_t>(tissue(movedBack(q)))];
}

std::string standard(const std::array<int, 3>& dims, const Point& spacing)
{
  std::string text = "Transformation Parameters\n\nFrom: CT\nTo: MR-T1\n\nPoint x y z new_x\n\n";
  for (int n = 0; n < 8; ++n)
  {
    const Point p{(n & 1) ? (dims[0] - 1) * spacing[0] : 0.0,
                  (n & 2) ? (dims[1] - 1) * spacing[1] : 0.0,
                  (n & 4) ? (dims[2] - 1) * spacing[2] : 0.0};
    const Point q = moved(p);
    char line[160];
    std::snprintf(line, sizeof line, "%3d %10.4f %10.4f %10.4f %10.4f %10.4f %10.4f\n", n + 1, p[0],
                  p[1], p[2], q[0], q[1], q[2]);
    text += line;
  }
  return text + "\n(All distances are in millimeters.)\n";
}

} // namespace

TEST_F(RegistrationBench, RegistersAFolderOfRireAndComparesWithItsTruth)
{
  const fs::path patient = m_folder / "rire" / "training_001";
  const std::array<int, 3> dims{90, 90, 34};
  const Point spacing{1.6, 1.6, 3.0};
  writeImage(patient / "ct", dims, spacing, ct);
  writeImage(patient / "mr_T1", {75, 75, 28}, {2.0, 2.0, 4.0}, mr);
  writeImage(patient / "mr_PD", {75, 75, 28}, {2.0, 2.0, 4.0}, mr);
  fs::create_directories(patient / "transformations");
  std::ofstream(patient / "transformations" / "ct_T1.standard") << standard(dims, spacing);

  const auto report = json("bench registration --quick --rire " + quoted(m_folder / "rire") +
                           " --out " + quoted(m_folder / "figures"));
  std::map<std::string, nlohmann::json> ours;
  for (const auto& point : report.at("points"))
    if (point.at("peer").is_null() && point.at("setting").at("what") == "fit")
      ours[point.at("setting").at("scene")] = point;
  ASSERT_EQ(ours.size(), 2U);
  const auto& known = ours.at("RIRE training_001 CT, MR T1");
  EXPECT_LT(known.at("error").get<double>(), 0.6) << "a third of the MR's voxel";
  EXPECT_LT(known.at("extra").at("corner_max_mm").get<double>(), 1.5);
  EXPECT_TRUE(ours.at("RIRE training_001 CT, MR PD").at("error").is_null());

  expectRefused("bench registration --rire " + quoted(m_folder / "nowhere") + " --out " +
                    quoted(m_folder / "figures"),
                3, "nowhere");
}

// Each part with few pairs of a small phantom: checks that it runs and that its invariants hold.
TEST_F(RegistrationBench, FindsNoConfidentWrongAnswer)
{
  const auto out = m_folder / "figures";
  const auto report = json(
      "bench registration --quick --part pairs,conditions,calibration,stress --out " + quoted(out));
  std::set<std::string> kinds;
  int fits = 0, processes = 0, calibrated = 0, apart = 0, refused = 0;
  for (const auto& point : report.at("points"))
  {
    const auto& setting = point.at("setting");
    const std::string scene = setting.at("scene");
    if (scene.rfind("stress: ", 0) == 0)
    {
      kinds.insert(scene);
      EXPECT_EQ(point.at("extra").at("wrong").get<double>(), 0.0) << setting.dump();
      EXPECT_FALSE(setting.at("text").get<std::string>().empty()) << scene;
      refused += setting.at("verdict") == "refused" ? 1 : 0;
    }
    else if (scene == "calibration")
    {
      ++calibrated;
      if (point.at("extra").contains("covered_at_30_mm"))
        ++apart;
      else
        continue; // stated at the target alone
      for (const char* share : {"covered_at_30_mm", "covered_at_60_mm", "covered_at_90_mm"})
      {
        const double sixths = 6.0 * point.at("extra").at(share).get<double>();
        EXPECT_GE(sixths, 0.0);
        EXPECT_LT(sixths, 6.5);
        EXPECT_NEAR(sixths, std::round(sixths), 1e-6) << "of six points";
      }
    }
    else if (setting.contains("what") && point.at("peer").is_null())
    {
      ++fits;
      if (setting.at("what") == "process")
      {
        ++processes;
        EXPECT_GT(point.at("extra").at("processor_s").get<double>(), 0.0);
      }
      // The true motion of a phantom patient is known: within 0.2 voxel of the MR.
      EXPECT_LT(point.at("extra").at("mr_voxels").get<double>(), 0.2) << setting.dump();
    }
  }
  EXPECT_EQ(fits, 3) << "the fit, the fit with its error, and that as a process of its own";
  EXPECT_EQ(processes, 1);
  EXPECT_EQ(calibrated, 3);
  EXPECT_GT(apart, 0);
  EXPECT_EQ(refused, 3) << "images of four dimensions";
  EXPECT_GE(kinds.size(), 30U);
  EXPECT_TRUE(fs::exists(out / "registration.json"));
  expectPlots(out, {"registration.svg", "registration-conditions.svg",
                    "registration-calibration.svg", "registration-stress.md"});
}

TEST_F(RegistrationBench, NamesAnUnknownPart)
{
  const auto outcome = run("bench registration --part speed --out " + quoted(m_folder));
  EXPECT_EQ(outcome.code, 2);
  EXPECT_NE(outcome.err.find("speed"), std::string::npos) << outcome.err;
}
