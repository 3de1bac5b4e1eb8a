#include <cmath>

#include "CommandRunner.h"
#include "petrous/Core/NumberText.h"
#include "petrous/Imaging/DicomWriter.h"

using Json = nlohmann::json;
using petrous::testing::CommandLine;
using petrous::testing::quoted;
using petrous::testing::textOf;

namespace
{

constexpr int kEdge = 28;        // voxels
constexpr double kSpacing = 1.0; // mm
constexpr double kMiddle = 0.5 * kSpacing * (kEdge - 1);

/// A ball of bone with a nerve in it, drilled and measured.
class ReportCommand : public CommandLine
{
protected:
  template <class T, class Value>
  std::string write(const std::string& name, const std::string& type, const Value& valueAt) const
  {
    std::ofstream file(m_folder / name, std::ios::binary);
    file << "NRRD0004\ntype: " << type << "\ndimension: 3\nspace: left-posterior-superior\n"
         << "sizes: 28 28 28\nspace directions: (1,0,0) (0,1,0) (0,0,1)\n"
         << "space origin: (0,0,0)\nencoding: raw\nendian: little\n\n";
    for (int k = 0; k < kEdge; ++k)
      for (int j = 0; j < kEdge; ++j)
        for (int i = 0; i < kEdge; ++i)
        {
          const T value = valueAt(i * kSpacing, j * kSpacing, k * kSpacing);
          file.write(reinterpret_cast<const char*>(&value), sizeof value);
        }
    return quoted(m_folder / name);
  }

  void makeEar(const std::string& name = "ear") const
  {
    const auto depth = [](double x, double y, double z, double middle, double radius)
    {
      return radius - std::sqrt(std::pow(x - middle, 2) + std::pow(y - kMiddle, 2) +
                                std::pow(z - kMiddle, 2));
    };
    const std::string bone =
        write<float>("bone.nrrd", "float",
                     [&](double x, double y, double z)
                     {
                       return static_cast<float>(std::clamp(
                           300.0 + 400.0 * depth(x, y, z, kMiddle, 11.0), -1000.0, 1800.0));
                     });
    const std::string nerve = write<unsigned char>(
        "nerve.nrrd", "uchar",
        [&](double x, double y, double z)
        { return static_cast<unsigned char>(depth(x, y, z, 18.0, 3.0) > 0.0 ? 1 : 0); });
    json("new " + word(name) + " --ct " + bone + " --labels nerve=" + nerve);
    json("drill " + word(name) + " --path " +
         quoted(writePath({-3.0, kMiddle, kMiddle}, {8.0, kMiddle, kMiddle})) + " --diameter 4");
    std::ofstream(m_folder / "points.csv") << "name,kind,x_mm,y_mm,z_mm\n"
                                              "width,distance,5,6,7\nwidth,distance,8,10,7\n"
                                              "bulb,,12,13,14\n";
    json("measure " + word(name) + " --save --points " + quoted(m_folder / "points.csv"));
  }
  static Json section(const Json& report, const std::string& id)
  {
    for (const Json& one : report.at("sections"))
      if (one.at("id") == id)
        return one;
    ADD_FAILURE() << "no section " << id;
    return {{"rows", Json::array()}};
  }
  static std::string word(const std::string& text) { return "'" + text + "'"; }
  static bool has(const std::string& program)
  {
    return std::system(("command -v " + program + " >/dev/null 2>&1").c_str()) == 0;
  }
  std::string outputOf(const std::string& command) const
  {
    const auto out = m_folder / "said.txt";
    EXPECT_EQ(std::system((command + " >" + quoted(out) + " 2>&1").c_str()), 0) << command;
    return textOf(out);
  }
};

std::string cellOf(double value, const Json& uncertainty)
{
  std::string text = " data-value=\"" + petrous::core::exactText(value) + "\"";
  if (!uncertainty.is_null())
    text += " data-uncertainty=\"" + petrous::core::exactText(uncertainty.get<double>()) + "\"";
  return text + ">";
}

} // namespace

TEST_F(ReportCommand, HasTheNumbersOfTheOtherCommands)
{
  makeEar();
  const auto file = m_folder / "plan.html";
  const Json report = json("report ear --out " + quoted(file));
  const std::string html = textOf(file);
  EXPECT_EQ(report.at("bytes"), html.size());

  const Json measured = json("measure ear --dissection");
  const Json distances = section(report, "distances").at("rows");
  ASSERT_EQ(distances.size(), measured.at("dissection").size());
  ASSERT_FALSE(distances.empty());
  for (std::size_t n = 0; n < distances.size(); ++n)
  {
    const Json& one = measured.at("dissection")[n];
    EXPECT_EQ(distances[n][0], one.at("structure"));
    EXPECT_EQ(distances[n][1].at("value"), one.at("distance_mm"));
    EXPECT_EQ(distances[n][1].at("uncertainty"), one.at("uncertainty_mm"));
    EXPECT_NE(html.find(cellOf(one.at("distance_mm"), one.at("uncertainty_mm"))),
              std::string::npos);
  }
  const Json listed = json("measure ear");
  for (const Json& one : listed.at("measurements"))
    for (const Json& quantity : one.at("quantities"))
      EXPECT_NE(html.find(cellOf(quantity.at("value"), quantity.at("uncertainty"))),
                std::string::npos)
          << quantity.dump();
  const std::string structure = section(report, "structures").at("rows")[0][0];
  const Json dimensions = json("measure ear --dimensions " + word(structure)).at("rows");
  EXPECT_EQ(section(report, "structures").at("rows")[0][1].at("value"), dimensions[0].at("value"));
  EXPECT_EQ(section(report, "structures").at("rows")[0][1].at("uncertainty"),
            dimensions[0].at("uncertainty"));
  const Json history = json("history ear");
  const Json strokes = section(report, "strokes").at("rows");
  ASSERT_EQ(strokes.size(), history.at("strokes").size() + 1);
  EXPECT_EQ(strokes[0][4].at("value"), history.at("strokes")[0].at("removed_mm3"));
  EXPECT_EQ(strokes[0][3].at("value"), history.at("strokes")[0].at("duration_s"));
}

TEST_F(ReportCommand, WritesAPdfThatOtherProgramsRead)
{
  makeEar();
  json("describe ear --side left --date 2026-12-24");
  const auto file = m_folder / "plan.pdf";
  const Json report = json("report ear --language de --out " + quoted(file));
  EXPECT_EQ(textOf(file).substr(0, 5), "%PDF-");
  if (!has("pdftotext") || !has("qpdf"))
    GTEST_SKIP() << "pdftotext and qpdf are not installed";
  outputOf("qpdf --check " + quoted(file));
  const std::string text = outputOf("pdftotext -layout " + quoted(file) + " -");
  EXPECT_NE(text.find("Operationsplan"), std::string::npos);
  EXPECT_NE(text.find("24.12.2026"), std::string::npos);
  EXPECT_NE(text.find("Linke Seite"), std::string::npos);
  for (const Json& row : section(report, "distances").at("rows"))
  {
    std::string number = row[1].at("text");
    EXPECT_NE(text.find(number.substr(0, number.find(' '))), std::string::npos) << number;
  }
}

// The pictures are compressed: the text of every page and every stream is looked at.
TEST_F(ReportCommand, HoldsNobodysNameAndNoPath)
{
  const std::string name = "Mustermann Erika";
  makeEar(name);
  const std::string pdf = quoted(m_folder / "plan.pdf");
  const Json report = json("report " + word(name) + " --out " + pdf);
  EXPECT_EQ(report.at("name").get<std::string>().substr(0, 5), "Case ");
  json("report " + word(name) + " --out " + quoted(m_folder / "plan.html"));
  std::vector<std::string> all{textOf(m_folder / "plan.pdf"), textOf(m_folder / "plan.html")};
  if (has("qpdf"))
  {
    outputOf("qpdf --stream-data=uncompress --object-streams=disable " + pdf + " " +
             quoted(m_folder / "open.pdf"));
    all.push_back(textOf(m_folder / "open.pdf"));
  }
  if (has("pdftotext"))
    all.push_back(outputOf("pdftotext " + pdf + " -"));
  if (has("pdfinfo"))
    all.push_back(outputOf("pdfinfo " + pdf));
  std::string wide; // as PDF writes its metadata
  for (const char c : std::string("Mustermann"))
    wide += std::string(1, '\0') + c;
  for (const std::string& bytes : all)
    for (const std::string& secret : {std::string("Mustermann"), std::string("Erika"), wide,
                                      m_folder.filename().string(), std::string("CreationDate")})
      EXPECT_EQ(bytes.find(secret), std::string::npos) << secret;

  json("report " + word(name) + " --keep-identity --out " + quoted(m_folder / "home.html"));
  EXPECT_NE(textOf(m_folder / "home.html").find("Mustermann"), std::string::npos);
}

// By whatever command distances are asked for.
TEST_F(ReportCommand, AStructureThatCannotBeMeasuredIsNamed)
{
  makeEar();
  json("new mrear --ct " + quoted(m_folder / "bone.nrrd") +
       " --mr T2=" + quoted(m_folder / "bone.nrrd") +
       " --labels facial=" + quoted(m_folder / "nerve.nrrd") + "@T2");
  json("drill mrear --path " +
       quoted(writePath({-3.0, kMiddle, kMiddle}, {8.0, kMiddle, kMiddle})) + " --diameter 4");
  const std::string out = " --out " + quoted(m_folder / "plan.html");
  for (const std::string& command :
       {std::string("measure mrear --dissection"), std::string("branch mrear --compare main main")})
  {
    const auto outcome = run(command + " --json");
    ASSERT_EQ(outcome.code, 0) << outcome.err;
    EXPECT_NE(outcome.err.find("'facial' is left out"), std::string::npos) << outcome.err;
    const Json missing = Json::parse(outcome.out).at("without_place");
    ASSERT_EQ(missing.size(), 1U) << command;
    EXPECT_EQ(missing[0].at("structure"), "facial");
  }
  for (const char* id : {"distances", "structures"})
  {
    const Json part = section(json("report mrear" + out), id);
    ASSERT_EQ(part.at("rows").size(), 1U);
    EXPECT_EQ(part.at("rows")[0][1], "left out");
    EXPECT_NE(part.at("paragraphs").dump().find("not registered"), std::string::npos);
  }

  // Its error is not known, and no command gives one.
  std::ofstream(m_folder / "identity.txt") << "1 0 0 0\n0 1 0 0\n0 0 1 0\n0 0 0 1\n";
  json("register mrear --mr T2 --as-is --transform " + quoted(m_folder / "identity.txt"));
  const Json measured = json("measure mrear --dissection");
  EXPECT_TRUE(measured.at("without_place").empty());
  EXPECT_TRUE(measured.at("dissection")[0].at("uncertainty_mm").is_null());
  const Json compared = json("branch mrear --compare main main");
  EXPECT_TRUE(compared.at("uncertainty_mm").at("facial").is_null()) << compared;
  EXPECT_NE(run("branch mrear --compare main main").out.find("+- unknown"), std::string::npos);
  // Of the other ear all say the same.
  EXPECT_EQ(json("branch ear --compare main main").at("uncertainty_mm").at("nerve"),
            json("measure ear --dissection").at("dissection")[0].at("uncertainty_mm"));
}

// By the hashes of the import: no form tells that a word is this patient's surname.
TEST_F(ReportCommand, ThePatientsSurnameAloneIsWithheld)
{
  const petrous::core::GridGeometry grid({16, 16, 16}, Eigen::Vector3d::Ones(),
                                         Eigen::Vector3d::Zero());
  auto voxels = std::make_shared<petrous::volume::Volume<std::int16_t>>(grid, std::int16_t{-1000});
  for (int k = 4; k < 12; ++k)
    for (int j = 4; j < 12; ++j)
      for (int i = 4; i < 12; ++i)
        voxels->at(i, j, k) = 1200;
  petrous::imaging::SeriesDescription description;
  description.studyUid = "2.25.1";
  description.seriesUid = "2.25.2";
  description.frameOfReferenceUid = "2.25.3";
  description.patientName = "Quorndike^Jane";
  petrous::imaging::writeDicomSeries(
      m_folder / "ct",
      petrous::volume::IntensityVolume(
          std::shared_ptr<const petrous::volume::Volume<std::int16_t>>(std::move(voxels))),
      description);
  json("new 'quorndike links' --ct " + quoted(m_folder / "ct"));
  json("describe 'quorndike links' --diagnosis 'geb. 12. April 1961, Station 3' "
       "--procedure 'implant of Smith'");
  const auto outcome =
      run("report 'quorndike links' --json --out " + quoted(m_folder / "plan.html"));
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  const std::string html = textOf(m_folder / "plan.html");
  for (const char* secret : {"uorndike", "1961"})
    EXPECT_EQ(html.find(secret), std::string::npos) << secret;
  EXPECT_NE(html.find("implant of Smith"), std::string::npos) << "nobody can know";
  EXPECT_NE(outcome.err.find("'implant of Smith'"), std::string::npos) << outcome.err;
  EXPECT_NE(Json::parse(outcome.out).at("may_identify").dump().find("implant of Smith"),
            std::string::npos);
  const std::string leaving =
      run("archive 'quorndike links' --dry-run " + quoted(m_folder / "a.petrous")).out;
  EXPECT_NE(leaving.find("name of the case, diagnosis and procedure: 2 of 3"), std::string::npos)
      << leaving;
}

TEST_F(ReportCommand, RefusesWhatItCannotDo)
{
  makeEar();
  const std::string file = quoted(m_folder / "plan.html");
  expectRefused("report ear --out " + quoted(m_folder / "plan.doc"), 2, "ends in .pdf or .html");
  expectRefused("report ear --approach nothing --out " + file, 3, "nothing");
  expectRefused("report ear --language fr --out " + file, 2, "de");
  EXPECT_FALSE(std::filesystem::exists(m_folder / "plan.html"));
}
