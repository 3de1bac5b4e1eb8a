#include <cmath>

#include "CommandRunner.h"
#include "petrous/Core/CsvTable.h"
#include "petrous/Phantom/Phantom.h"

using Json = nlohmann::json;
using Eigen::Vector3d;
using petrous::testing::CommandLine;
using petrous::testing::quoted;
using petrous::testing::textOf;

namespace
{

/// The built-in patient, whose anatomy is known analytically.
class MeasureCommand : public CommandLine
{
protected:
  void makeEar(const std::string& options) const
  {
    makePatient(options);
    ASSERT_EQ(run("new ear --ct " + quoted(m_folder / "patient/ct") + " --labels " +
                  quoted(m_folder / "patient/labels.seg.nrrd"))
                  .code,
              0);
  }
  std::string file(const std::string& name, const std::string& text) const
  {
    std::ofstream(m_folder / name, std::ios::binary) << text;
    return quoted(m_folder / name);
  }
  static Json row(const Json& answer, const std::string& name, const std::string& quantity)
  {
    for (const Json& one : answer.at("rows"))
      if (one.at("name") == name && one.at("quantity") == quantity)
        return one;
    ADD_FAILURE() << "no " << name << " " << quantity << " in " << answer.dump();
    return {{"value", 0.0}, {"uncertainty", 0.0}};
  }
};

} // namespace

TEST_F(MeasureCommand, MeasuresPointsAndKeepsThemIfAsked)
{
  makeEar("--dims 32,32,32 --spacing 1.5");
  const std::string points = file("points.csv", "name,kind,x_mm,y_mm,z_mm\n"
                                                "width,distance,-50,20,5\n"
                                                "corner,angle,-47,20,5\n"
                                                "corner,angle,-50,20,5\n"
                                                "\"plate, drawn\",area,-50,20,5\n"
                                                "width,distance,-47,24,17\n"
                                                "corner,angle,-50,23,5\n"
                                                "\"plate, drawn\",area,-46,20,5\n"
                                                "\"plate, drawn\",area,-46,23,5\n"
                                                "\"plate, drawn\",area,-50,23,5\n"
                                                "bulb,,-48,21,7\n");
  const Json answer = json("measure ear --points " + points);
  EXPECT_DOUBLE_EQ(row(answer, "width", "distance").at("value"), 13.0);
  EXPECT_EQ(row(answer, "width", "distance").at("unit"), "mm");
  EXPECT_NEAR(row(answer, "width", "distance").at("uncertainty"), std::sqrt(2.0) * 0.75, 1e-6);
  EXPECT_NEAR(row(answer, "corner", "angle").at("value"), 90.0, 1e-9);
  EXPECT_NEAR(row(answer, "plate, drawn", "area").at("value"), 12.0, 1e-9);
  EXPECT_DOUBLE_EQ(row(answer, "bulb", "y").at("value"), 21.0);
  EXPECT_TRUE(answer.at("measurements").empty()) << "nothing is kept unless asked";
  EXPECT_TRUE(json("measure ear --list").at("measurements").empty());

  EXPECT_EQ(json("measure ear --save --points " + points).at("measurements").size(), 4U);
  Json listed = json("measure ear").at("measurements");
  ASSERT_EQ(listed.size(), 4U);
  EXPECT_EQ(listed[2].at("name"), "plate, drawn");
  EXPECT_EQ(listed[3].at("kind"), "mark");
  json("measure ear --save --points " + points); // under free names
  EXPECT_EQ(json("measure ear").at("measurements")[4].at("name"), "width 2");
  EXPECT_EQ(json("measure ear --remove 'WIDTH 2' --remove corner").at("removed"),
            Json({"width 2", "corner"}));
  EXPECT_EQ(json("measure ear").at("measurements").size(), 6U);
  expectRefused("measure ear --remove nothing", 3, "no measurement 'nothing'");

  // As a table that spreadsheets read.
  EXPECT_EQ(run("measure ear --out " + quoted(m_folder / "out.csv")).code, 0);
  const auto rows = petrous::core::csvRows(textOf(m_folder / "out.csv"), "out.csv", ',');
  EXPECT_EQ(rows[0].cells[0], "name");
  EXPECT_EQ(rows[1].cells[0], "width");
  EXPECT_EQ(rows[1].cells[3], "13");
  EXPECT_NE(textOf(m_folder / "out.csv").find("facial_nerve,structure,volume"), std::string::npos);
}

TEST_F(MeasureCommand, StatesDistancesAndAnglesOfPlainPoints)
{
  makeEar("--dims 32,32,32 --spacing 1.5");
  const Json answer =
      json("measure ear --points " + file("p.csv", "x_mm,y_mm,z_mm\n"
                                                   "-50,20,5\n-47,20,5\n-47,24,5\n"));
  EXPECT_DOUBLE_EQ(row(answer, "points", "length").at("value"), 7.0);
  EXPECT_DOUBLE_EQ(row(answer, "points", "distance 1 to 2").at("value"), 3.0);
  EXPECT_DOUBLE_EQ(row(answer, "points", "distance 2 to 3").at("value"), 4.0);
  EXPECT_NEAR(row(answer, "points", "angle at 2").at("value"), 90.0, 1e-9);
}

TEST_F(MeasureCommand, RefusesTablesThatAreNone)
{
  makeEar("--dims 32,32,32 --spacing 1.5");
  const auto refused = [this](const std::string& text, const std::string& why)
  { expectRefused("measure ear --save --points " + file("bad.csv", text), 3, why); };
  refused("", "is empty");
  refused("name,x_mm,y_mm\n", "no column z_mm");
  refused("x_mm,y_mm,z_mm\n", "no row after the header");
  refused("x_mm,y_mm,z_mm\n1,2\n", "line 2: z_mm must be a number");
  refused("x_mm,y_mm,z_mm\n1,2,nan\n", "must be a number");
  refused("x_mm,y_mm,z_mm\n1,2,3,4\n", "more cells");
  refused("name,kind,x_mm,y_mm,z_mm\na,volume,1,2,3\n", "line 2: kind must be");
  refused("name,kind,x_mm,y_mm,z_mm\na,angle,1,2,3\n", "3 points");
  refused("name,kind,x_mm,y_mm,z_mm\na,mark,1,2,3\na,area,1,2,3\n", "one kind");
  refused("name,x_mm,y_mm,z_mm\n\"a,1,2,3\n", "a quote is opened");
  refused("name,x_mm,y_mm,z_mm\na,1,2,1e300\n", "within 100 m");
  refused("name,x_mm,y_mm,z_mm\na\x01,1,2,3\n", "control characters");
  refused("name,x_mm,y_mm,z_mm\na\xff,1,2,3\n", "UTF-8");
  expectRefused("measure ear --points " + quoted(m_folder / "none.csv"), 3, "none.csv");
  expectRefused("measure ear --image T9 --points " + file("p.csv", "x_mm,y_mm,z_mm\n1,2,3\n"), 3,
                "no MR 'T9'");
  EXPECT_TRUE(json("measure ear").at("measurements").empty());
}

// Against the phantom's analytic surfaces and its nerve's axis.
TEST_F(MeasureCommand, AgreesWithThePhantomsAnatomy)
{
  makeEar("--dims 110,110,100 --spacing 0.5");
  const petrous::phantom::Phantom phantom;
  const Json info = json("info ear");
  const auto has = [&info](const char* name)
  {
    for (const Json& label : info.at("labels"))
      if (label.at("name") == name)
        return true;
    return false;
  };
  ASSERT_TRUE(has("facial_nerve") && has("sigmoid_sinus"));
  // The nearest of all points of one surface to the other, by the signed distances.
  const auto box = petrous::core::PatientBox(phantom.center() - Vector3d(27, 27, 24.5),
                                             phantom.center() + Vector3d(27, 27, 24.5));
  const std::size_t sinus = phantom.indexOf("sigmoid_sinus");
  double gap = 1e9;
  for (const auto& vertex : phantom.surface(phantom.indexOf("facial_nerve"), box, 0.25).vertices)
    gap = std::min(gap, phantom.signedDistance(sinus, vertex.cast<double>()));
  const Json between = json("measure ear --between facial_nerve sigmoid_sinus");
  EXPECT_NEAR(between.at("between").at("distance_mm"), gap, 0.5);
  EXPECT_NEAR(between.at("between").at("uncertainty_mm"), std::sqrt(2.0) * 0.25, 1e-6);

  double length = 0.0;
  const auto axis = petrous::phantom::Phantom::facialCanalAxis();
  for (std::size_t n = 1; n < axis.size(); ++n)
    if (box.contains(axis[n].position) && box.contains(axis[n - 1].position))
      length += (axis[n].position - axis[n - 1].position).norm();
  const Json along = json("measure ear --along facial_nerve --save");
  // The nerve goes on beyond both ends of its canal.
  const double whole = row(along, "length of facial nerve", "length").at("value");
  EXPECT_GT(whole, 0.9 * length);
  EXPECT_LT(whole, 2.5 * length);
  EXPECT_EQ(json("measure ear").at("measurements")[0].at("structure"), "facial_nerve");

  const Json canal = json("measure ear --dimensions internal_auditory_canal");
  const double volume = phantom.volume(phantom.indexOf("internal_auditory_canal"), box);
  EXPECT_NEAR(row(canal, "internal_auditory_canal", "volume").at("value"), volume, 0.05 * volume);
  EXPECT_GT(double(row(canal, "internal_auditory_canal", "longest extent").at("value")),
            double(row(canal, "internal_auditory_canal", "second extent").at("value")));
  expectRefused("measure ear --dimensions nothing", 3, "it has ");
  expectRefused("measure ear --along facial_nerve 1,2,3", 2, "two points");
  expectRefused("measure ear --wall 1,2", 2, "x,y,z");
}

// What is between an image and another one is saved as that, not as the CT's alone.
TEST_F(MeasureCommand, ASavedDistanceKeepsTheImageOfEachEnd)
{
  makePatient("--dims 32,32,32 --spacing 1.5");
  json("new ear --ct " + quoted(m_folder / "patient/ct") +
       " --mr T2=" + quoted(m_folder / "patient/mr") + " --labels " +
       quoted(m_folder / "patient/labels.seg.nrrd"));
  const Json ct = json("measure ear --between -50,20,5 -47,24,5 --save");
  EXPECT_NEAR(ct.at("between").at("uncertainty_mm"), std::sqrt(2.0) * 0.75, 1e-6);
  json("measure ear --between facial_nerve -47,24,5 --image T2 --save");
  json("measure ear --save --points " +
       file("p.csv", "name,x_mm,y_mm,z_mm,image\nmixed,-50,20,5,\nmixed,-47,24,5,T2\n"));
  const Json kept = json("measure ear").at("measurements");
  ASSERT_EQ(kept.size(), 3U);
  EXPECT_EQ(kept[0].at("images"), Json({nullptr, nullptr}));
  EXPECT_NEAR(kept[0].at("quantities")[0].at("uncertainty"), std::sqrt(2.0) * 0.75, 1e-6);
  for (const Json& one : {kept[1], kept[2]})
  {
    EXPECT_EQ(one.at("images"), Json({nullptr, "T2"})) << one;
    // Its registration is in error by nobody knows what.
    EXPECT_TRUE(one.at("quantities")[0].at("uncertainty").is_null()) << one;
    EXPECT_NE(one.at("quantities")[0].at("remark").get<std::string>().find("MR 'T2'"),
              std::string::npos);
  }
  expectRefused("measure ear --points " +
                    file("bad.csv", "name,x_mm,y_mm,z_mm,image\na,-50,20,5,T9\n"),
                3, "no MR 'T9'");
}

TEST_F(MeasureCommand, TravelWithCopiesArchivesAndPlans)
{
  makeEar("--dims 32,32,32 --spacing 1.5");
  json("measure ear --save --points " +
       file("p.csv", "name,x_mm,y_mm,z_mm\nSmith John 1970,-50,20,5\nb,-50,20,5\nb,-47,24,5\n"));
  const Json there = json("measure ear").at("measurements");
  ASSERT_EQ(there.size(), 2U);
  EXPECT_EQ(run("library copy ear again").code, 0);
  EXPECT_EQ(json("measure again").at("measurements"), there);
  EXPECT_EQ(run("archive ear " + quoted(m_folder / "e.petrous")).code, 0);
  EXPECT_EQ(run("restore " + quoted(m_folder / "e.petrous") + " --as back").code, 0);
  EXPECT_EQ(json("measure back").at("measurements"), there);
  EXPECT_EQ(run("archive ear --plan-only " + quoted(m_folder / "p.petrous")).code, 0);
  EXPECT_EQ(run("restore " + quoted(m_folder / "p.petrous") + " --as plan").code, 0);
  EXPECT_EQ(json("measure plan").at("measurements"), there);
  // Their names are told before they leave.
  const std::string report = run("archive ear --dry-run " + quoted(m_folder / "n.petrous")).out;
  EXPECT_NE(report.find("marks and measurements"), std::string::npos) << report;
  EXPECT_NE(report.find("names of measurements: 1 of 2"), std::string::npos) << report;
}
