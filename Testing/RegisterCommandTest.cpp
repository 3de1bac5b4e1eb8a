#include <cmath>
#include <csignal>

#include <Eigen/Geometry>

#include "CommandRunner.h"

using petrous::testing::CommandLine;
using petrous::testing::quoted;
using petrous::testing::textOf;

namespace
{

Eigen::Matrix4d matrixOf(const nlohmann::json& numbers)
{
  Eigen::Matrix4d matrix;
  for (int n = 0; n < 16; ++n)
    matrix(n / 4, n % 4) = numbers.at(static_cast<std::size_t>(n)).get<double>();
  return matrix;
}

class RegisterCommand : public CommandLine
{
protected:
  void makeCase()
  {
    makePatient("--dims 96,96,90 --spacing 0.6");
    m_patient = m_folder / "patient";
    m_truth = nlohmann::json::parse(textOf(m_patient / "truth.json"));
    json("new ear --ct " + quoted(m_patient / "ct") + " --mr T2=" + quoted(m_patient / "mr"));
  }

  // The true motion as point pairs.
  std::filesystem::path writeLandmarks(const std::string& lastRow = {}) const
  {
    const auto path = m_folder / "pairs.csv";
    std::ofstream file(path);
    file << "ct_x,ct_y,ct_z,mr_x,mr_y,mr_z\n";
    const auto& c = m_truth["center_mm"];
    const Eigen::Vector3d center(c[0], c[1], c[2]);
    for (const Eigen::Vector3d& step : {Eigen::Vector3d(10, 0, 0), Eigen::Vector3d(0, 12, 0),
                                        Eigen::Vector3d(0, 0, -9), Eigen::Vector3d(-8, 5, 3)})
    {
      const Eigen::Vector3d ct = center + step;
      const Eigen::Vector4d mr = matrixOf(m_truth["transform"]) * ct.homogeneous();
      file.precision(12);
      file << ct[0] << ',' << ct[1] << ',' << ct[2] << ',' << mr[0] << ',' << mr[1] << ',' << mr[2]
           << '\n';
    }
    file << lastRow;
    return path;
  }

  // A block at the centre of the MR's grid.
  std::filesystem::path writeLabelOnMr() const
  {
    const auto& mr = m_truth["mr"];
    const auto n = mr["dims"].get<std::array<int, 3>>();
    const auto h = mr["spacing_mm"].get<std::array<double, 3>>();
    const auto o = mr["origin_mm"].get<std::array<double, 3>>();
    std::string voxels(static_cast<std::size_t>(n[0]) * n[1] * n[2], '\0');
    for (int k = n[2] / 2 - 4; k < n[2] / 2 + 4; ++k)
      for (int j = n[1] / 2 - 4; j < n[1] / 2 + 4; ++j)
        for (int i = n[0] / 2 - 4; i < n[0] / 2 + 4; ++i)
          voxels[static_cast<std::size_t>(i) + n[0] * (j + static_cast<std::size_t>(n[1]) * k)] = 1;
    const auto path = m_folder / "tumour.nrrd";
    std::ofstream file(path, std::ios::binary);
    file.precision(17);
    file << "NRRD0004\ntype: uchar\ndimension: 3\nspace: left-posterior-superior\nsizes: " << n[0]
         << ' ' << n[1] << ' ' << n[2] << "\nspace directions: (" << h[0] << ",0,0) (0," << h[1]
         << ",0) (0,0," << h[2] << ")\nkinds: domain domain domain\nencoding: raw\nspace origin: ("
         << o[0] << ',' << o[1] << ',' << o[2] << ")\n\n";
    file << voxels;
    return path;
  }

  // A tetrahedron of 10 mm at the centre of the MR's grid.
  std::filesystem::path writeMeshOnMr() const
  {
    const auto& mr = m_truth["mr"];
    Eigen::Vector3d center;
    for (int axis = 0; axis < 3; ++axis)
      center[axis] = mr["origin_mm"][axis].get<double>() +
                     0.5 * (mr["dims"][axis].get<int>() - 1) * mr["spacing_mm"][axis].get<double>();
    const auto path = m_folder / "tumour.obj";
    std::ofstream file(path);
    file.precision(9);
    for (const Eigen::Vector3d& step : {Eigen::Vector3d(0, 0, 0), Eigen::Vector3d(10, 0, 0),
                                        Eigen::Vector3d(0, 10, 0), Eigen::Vector3d(0, 0, 10)})
      file << "v " << (center + step)[0] << ' ' << (center + step)[1] << ' ' << (center + step)[2]
           << '\n';
    file << "f 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n";
    return path;
  }

  // Distance of the transformed ear centre from its true position, mm.
  double offAt(const nlohmann::json& transform) const
  {
    const auto& c = m_truth["center_mm"];
    const Eigen::Vector4d center(c[0], c[1], c[2], 1.0);
    return ((matrixOf(transform) - matrixOf(m_truth["transform"])) * center).norm();
  }

  std::filesystem::path m_patient;
  nlohmann::json m_truth;
};

} // namespace

TEST_F(RegisterCommand, LaysTheMrOnTheCtAndSaysHowWell)
{
  makeCase();
  json("add ear --labels " + quoted(m_patient / "labels.seg.nrrd"));
  json("add ear --labels tumour=" + quoted(writeLabelOnMr()));
  const std::string mesh = quoted(writeMeshOnMr());
  json("add ear --mesh onMr=" + mesh + "@T2 --mesh onCt=" + mesh);
  const auto answer = json("register ear --mr T2");
  EXPECT_NE(answer["verdict"], "failed") << answer["text"];
  EXPECT_LT(offAt(answer["transform"]), 0.25) << "MR voxels are larger";
  EXPECT_GT(answer["metric"], 0.0);
  EXPECT_GT(answer["iterations"], 0);
  EXPECT_GT(answer["seconds"], 0.0);
  EXPECT_GT(answer["estimate_seconds"], 0.0);
  EXPECT_GT(answer["curve"].size(), 3u);
  EXPECT_GE(answer["error_mm"]["p95"], answer["error_mm"]["median"]);
  const std::string place = answer["error_mm"]["place"];
  EXPECT_TRUE(place.find("malleus") != std::string::npos ||
              place.find("incus") != std::string::npos || place.find("stapes") != std::string::npos)
      << place;

  const auto info = json("info ear");
  EXPECT_EQ(info["mr"][0]["registered"], true);
  EXPECT_EQ(matrixOf(info["mr"][0]["transform"]), matrixOf(answer["transform"]));
  const auto& how = info["mr"][0]["registration"];
  EXPECT_EQ(how["method"], "mutual information");
  EXPECT_EQ(how["verdict"], answer["verdict"]);
  EXPECT_EQ(how["error_mm"]["p95"], answer["error_mm"]["p95"]);
  EXPECT_TRUE(how["signed_off"].is_null()) << "never assumed";
  const auto& spread = how["error_mm"]["spread"];
  EXPECT_TRUE(spread.is_null() || spread["rotation_deg"][0] > 0.0) << spread;
  const auto& onMr = info["labels"].back();
  EXPECT_EQ(onMr["name"], "tumour");
  EXPECT_GT(onMr["registration_error_mm"]["p95"], 0.0);
  EXPECT_NE(onMr["registration_error_mm"]["place"].is_null(), spread.is_null());
  EXPECT_FALSE(info["labels"][0].contains("registration_error_mm")) << "drawn on the CT";
  const auto& meshes = info["meshes"];
  ASSERT_EQ(meshes.size(), 2u);
  EXPECT_EQ(meshes[0]["name"], "onMr");
  ASSERT_TRUE(meshes[0].contains("registration_error_mm"));
  EXPECT_GT(meshes[0]["registration_error_mm"]["p95"], 0.0);
  EXPECT_NE(meshes[0]["registration_error_mm"]["place"].is_null(), spread.is_null());
  EXPECT_FALSE(meshes[1].contains("registration_error_mm")) << "drawn on the CT";
  const std::string text = run("info ear").out;
  EXPECT_NE(text.find("drawn on the MR 'T2', registered to "), std::string::npos);
  const std::size_t line = text.find("mesh 'onMr'");
  ASSERT_NE(line, std::string::npos) << text;
  EXPECT_NE(text.substr(line, text.find('\n', line) - line).find("registered to "),
            std::string::npos)
      << text;
  for (const auto& [name, bytes] : info["resources"].items())
  {
    EXPECT_NE(name.rfind("registration.", 0), 0u) << name;
    EXPECT_NE(name.rfind("mr.", 0), 0u) << name;
  }
}

TEST_F(RegisterCommand, ASignOffStandsAloneAndEndsWithTheTransform)
{
  makeCase();
  expectRefused("register ear --mr T2 --sign-off 'A. Surgeon'", 3, "nothing to sign");
  const auto pairs = quoted(writeLandmarks());
  const auto laid = json("register ear --mr T2 --as-is --init landmarks " + pairs);
  EXPECT_LT(offAt(laid["transform"]), 1e-6);
  EXPECT_EQ(laid["method"], "landmarks");
  EXPECT_EQ(laid["verdict"], "doubtful") << "nothing is known of its error";
  EXPECT_TRUE(laid["error_mm"]["p95"].is_null());
  expectRefused("register ear --mr T2 --sign-off 'A. Surgeon' --init header", 2, "stands alone");
  expectRefused("register ear --mr T2 --sign-off ' '", 2, "value is");
  const auto answer = json("register ear --mr T2 --sign-off 'A. Surgeon'");
  for (const char* nobody : {" ''", "= --quiet", " --quiet"})
    expectRefused(std::string("register ear --mr T2 --sign-off") + nobody, 2, "value is");
  EXPECT_EQ(json("info ear")["mr"][0]["registration"]["signed_off"], answer["signed_off"]);
  EXPECT_EQ(answer["signed_off"]["who"], "A. Surgeon");
  auto how = json("info ear")["mr"][0]["registration"];
  EXPECT_EQ(how["signed_off"]["who"], "A. Surgeon");
  EXPECT_EQ(how["signed_off"]["when"].get<std::string>().size(), 20u);
  EXPECT_NE(run("info ear").out.find("signed off by A. Surgeon"), std::string::npos);

  json("register ear --mr T2 --as-is --transform " + quoted(m_patient / "truth.json"));
  how = json("info ear")["mr"][0]["registration"];
  EXPECT_TRUE(how["signed_off"].is_null());
  EXPECT_EQ(how["method"], "by hand");
}

TEST_F(RegisterCommand, BadInputNamesFileAndRowAndChangesNothing)
{
  makeCase();
  const auto before = libraryContent();
  const auto broken = writeLandmarks("1,2,x,4,5,6\n");
  expectRefused("register ear --mr T2 --init landmarks " + quoted(broken), 3, "pairs.csv, line 6");
  std::ofstream(broken) << "ct_x,ct_y,ct_z,mr_x,mr_y,mr_z\n0,0,0,0,0,0\n1,0,0,1,0,0\n2,0,0,2,0,0\n";
  expectRefused("register ear --mr T2 --init landmarks " + quoted(broken), 3, "pairs.csv");
  expectRefused("register ear --mr T2 --init landmarks", 2, "file is missing");
  expectRefused("register ear --mr T2 --init sideways", 2, "sideways");
  expectRefused("register ear --mr T1", 3, "it has T2");
  expectRefused("register ear --mr T2 --to T2", 3, "itself");
  expectRefused("register ear --mr T2 --at zebra", 3, "no structure 'zebra'");
  expectRefused("register ear --mr T2 --at 0,0,900", 3, "outside the CT");
  expectRefused("register ear --mr T2 --as-is", 3, "frame of reference");
  std::ofstream(m_folder / "sheared.txt") << "1 0.5 0 0 0 1 0 0 0 0 1 0 0 0 0 1";
  expectRefused("register ear --mr T2 --transform " + quoted(m_folder / "sheared.txt"), 3,
                "sheared.txt");
  std::ofstream(m_folder / "words.txt") << "1 0 0 0 0 1 0 0 0 0 1 0 0 0 0 one";
  expectRefused("register ear --mr T2 --transform " + quoted(m_folder / "words.txt"), 3,
                "16 numbers");
  EXPECT_EQ(libraryContent(), before);
}

TEST_F(RegisterCommand, AFailureIsNoErrorAndChangesNothing)
{
  makePatient("--dims 48,48,40 --spacing 1.2");
  m_patient = m_folder / "patient";
  const auto flat = m_folder / "flat.nrrd";
  {
    std::ofstream file(flat, std::ios::binary);
    file << "NRRD0004\ntype: short\ndimension: 3\nspace: left-posterior-superior\n"
            "sizes: 30 30 30\nspace directions: (1,0,0) (0,1,0) (0,0,1)\n"
            "kinds: domain domain domain\nendian: little\nencoding: raw\nspace origin: (0,0,0)\n\n";
    const std::vector<std::int16_t> voxels(30 * 30 * 30, 77);
    file.write(reinterpret_cast<const char*>(voxels.data()),
               static_cast<std::streamsize>(voxels.size() * 2));
  }
  json("new ear --ct " + quoted(m_patient / "ct") + " --mr T2=" + quoted(flat));
  const auto before = libraryContent();
  const auto answer = json("register ear --mr T2");
  EXPECT_EQ(answer["verdict"], "failed");
  EXPECT_NE(answer["text"], "");
  EXPECT_EQ(answer["registered"], false);
  EXPECT_EQ(libraryContent(), before);
  EXPECT_NE(run("register ear --mr T2").out.find("the case is as it was"), std::string::npos);
}

TEST_F(RegisterCommand, AnMrOnWhichSomethingWasDrawnIsKept)
{
  makeCase();
  json("add ear --labels tumour=" + quoted(writeLabelOnMr()));
  auto info = json("info ear");
  EXPECT_EQ(info["labels"][0]["drawn_on"], "T2");
  EXPECT_EQ(info["labels"][0]["placed"], false);
  EXPECT_NE(run("info ear")
                .out.find("nowhere on the CT: it was drawn on the MR 'T2', which is not "
                          "registered"),
            std::string::npos);
  expectRefused("remove ear --part T2", 4, "tumour");
  json("register ear --mr T2 --as-is --transform " + quoted(m_patient / "truth.json"));
  info = json("info ear");
  EXPECT_EQ(info["labels"][0]["placed"], true);
  // The centre of the MR's grid is the moved centre of the ear.
  const auto points = m_folder / "points.csv";
  const auto& c = m_truth["center_mm"];
  std::ofstream(points) << "x_mm,y_mm,z_mm\n" << c[0] << ',' << c[1] << ',' << c[2] << '\n';
  EXPECT_NE(run("probe ear --points " + quoted(points)).out.find("tumour"), std::string::npos);
  json("remove ear --part tumour");
  json("remove ear --part T2");
  EXPECT_EQ(json("info ear")["mr"].size(), 0u);
}
