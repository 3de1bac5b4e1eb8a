#include <cmath>
#include <sstream>
#include <tuple>
#include <vector>

#include "CommandRunner.h"
#include "petrous/Session/BurrRemovalModel.h"
#include "petrous/Session/RecordingReader.h"
#include "petrous/Session/RecordingWriter.h"

using namespace petrous::testing;

namespace
{

using Row = std::map<std::string, double>;

// Bone below z = 0.13 mm, a plane between the voxels of 0.4 mm: 300 HU there, slope 400 HU/mm.
class TouchCommand : public CommandLine
{
protected:
  static constexpr double kTop = 0.13;

  void SetUp() override
  {
    CommandLine::SetUp();
    writePlane("plane.nrrd", kTop);
    json("new plane --ct " + quoted(m_folder / "plane.nrrd"));
    json("appearance plane --iso 300");
  }

  void writePlane(const std::string& name, double top) const
  {
    constexpr int edge = 48;
    constexpr double h = 0.4;
    std::ofstream file(m_folder / name, std::ios::binary);
    file << "NRRD0004\ntype: float\ndimension: 3\nspace: left-posterior-superior\n"
         << "sizes: 48 48 48\nspace directions: (0.4,0,0) (0,0.4,0) (0,0,0.4)\n"
         << "space origin: (-9.4,-9.4,-9.4)\nencoding: raw\nendian: little\n\n";
    for (int k = 0; k < edge; ++k)
    {
      const std::vector<float> slice(edge * edge,
                                     static_cast<float>(300.0 + 400.0 * (top - (h * k - 9.4))));
      file.write(reinterpret_cast<const char*>(slice.data()),
                 static_cast<std::streamsize>(slice.size() * sizeof(float)));
    }
  }

  std::filesystem::path otherPlane() const
  {
    writePlane("other.nrrd", kTop + 0.01);
    return m_folder / "other.nrrd";
  }

  // A structure "pad", ten voxels high, on the bone.
  void writePad() const
  {
    std::ofstream file(m_folder / "pad.nrrd", std::ios::binary);
    file << "NRRD0004\ntype: uchar\ndimension: 3\nspace: left-posterior-superior\n"
         << "sizes: 48 48 48\nspace directions: (0.4,0,0) (0,0.4,0) (0,0,0.4)\n"
         << "space origin: (-9.4,-9.4,-9.4)\nencoding: raw\n\n";
    for (int k = 0; k < 48; ++k)
      for (int j = 0; j < 48; ++j)
        for (int i = 0; i < 48; ++i)
        {
          const bool inside = k >= 24 && k < 34 && j > 6 && j < 42 && i > 6 && i < 42;
          file.put(inside ? '\1' : '\0');
        }
  }

  // Down from 5 mm above the surface to a device height within 0.5 s, held there for `hold`
  // seconds.
  std::filesystem::path press(double height, bool drill, double hold = 0.5)
  {
    std::ofstream file(m_folder / "press.csv");
    file << "t_s,x_mm,y_mm,z_mm,qw,qx,qy,qz,drill\n"
         << "0,0.3,0.2,7,1,0,0,0," << drill << "\n0.5,0.3,0.2," << height << ",1,0,0,0," << drill
         << '\n'
         << 0.5 + hold << ",0.3,0.2," << height << ",1,0,0,0,0\n";
    return m_folder / "press.csv";
  }

  std::vector<Row> log(const std::string& name) const
  {
    std::istringstream text(textOf(m_folder / name));
    std::string line, cell;
    std::vector<std::string> names;
    std::getline(text, line);
    for (std::istringstream cells(line); std::getline(cells, cell, ',');)
      names.push_back(cell);
    std::vector<Row> rows;
    while (std::getline(text, line))
    {
      rows.emplace_back();
      std::istringstream cells(line);
      for (const std::string& column : names)
      {
        std::getline(cells, cell, ',');
        rows.back()[column] = std::stod(cell);
      }
    }
    return rows;
  }

  std::string drill(const std::filesystem::path& path, const std::string& more)
  {
    return "drill plane --path " + quoted(path) + " --log " + quoted(m_folder / "log.csv") + more;
  }
};

} // namespace

TEST_F(TouchCommand, HoldsTheToolAtTheSurfaceAndSaysTheForce)
{
  const auto answer = json(drill(press(1.13, false), "")); // 1 mm beyond contact
  EXPECT_EQ(answer["removed_mm3"], 0.0);
  EXPECT_EQ(answer["strokes"], 0);
  EXPECT_EQ(answer["max_penetration_mm"], 0.0);
  const auto rows = log("log.csv");
  ASSERT_EQ(rows.size(), 1001U);
  const Row& last = rows.back();
  // A burr of 4 mm rests 2 mm above the plane; the coupling is 1 N/mm.
  EXPECT_NEAR(last.at("pz_mm"), kTop + 2.0, 0.05 * 0.4);
  EXPECT_NEAR(last.at("px_mm"), 0.3, 0.01);
  EXPECT_NEAR(last.at("fz_n"), 1.0, 0.03);
  EXPECT_NEAR(std::hypot(last.at("fx_n"), last.at("fy_n")), 0.0, 0.02);
  EXPECT_NEAR(last.at("thrust_n"), last.at("fz_n"), 1e-6);
  EXPECT_NEAR(last.at("theta_rad"), std::acos(-1.0) / 2.0, 0.05); // the spindle is upright
  for (const Row& row : rows)
  {
    ASSERT_GE(row.at("pz_mm"), kTop + 2.0 - 0.05 * 0.4);
    ASSERT_EQ(row.at("penetration_mm"), 0.0);
  }
}

// The same path with a pick: its tip is the origin, so it goes 2 mm farther down than the burr.
TEST_F(TouchCommand, AnInstrumentFromAMeshIsFeltAtItsTipAndRemovesNothing)
{
  // 60 mm long, 2 mm wide at the hand's end.
  std::ofstream(m_folder / "pick.obj") << "v 0 0 0\nv 1 1 60\nv -1 1 60\nv -1 -1 60\nv 1 -1 60\n"
                                          "f 1 3 2\nf 1 4 3\nf 1 5 4\nf 1 2 5\nf 2 3 4\nf 2 4 5\n";
  const std::string tool = " --tool " + quoted(m_folder / "pick.obj");
  const auto answer = json(drill(press(kTop - 1.0, true), tool));
  EXPECT_EQ(answer["removed_mm3"], 0.0);
  EXPECT_EQ(answer["strokes"], 0);
  EXPECT_EQ(answer["instrument"]["file"], "pick.obj");
  EXPECT_EQ(answer["instrument"]["length_mm"], 60.0);
  EXPECT_LE(answer["instrument"]["points"], 2000);
  EXPECT_LT(answer["instrument"]["tip_sampling_error_mm"], 0.4);
  EXPECT_LT(answer["instrument"]["sampling_error_mm"], 1.0);
  EXPECT_EQ(answer.count("predicted_mm3"), 0U);
  const auto rows = log("log.csv");
  const Row& last = rows.back();
  EXPECT_NEAR(last.at("pz_mm"), kTop, 0.05 * 0.4);
  EXPECT_NEAR(last.at("px_mm"), 0.3, 0.02);
  EXPECT_NEAR(last.at("fz_n"), 1.0, 0.03);
  EXPECT_NEAR(last.at("thrust_n"), last.at("fz_n"), 0.03);
  EXPECT_TRUE(std::isnan(last.at("r_mm"))) << "the lever of a burr";
  EXPECT_EQ(answer["max_penetration_mm"], 0.0);
  std::ofstream(m_folder / "inside.csv") << "t_s,x_mm,y_mm,z_mm,qw,qx,qy,qz,drill\n"
                                            "0,0.3,0.2,-5,1,0,0,0,0\n0.05,0.3,0.2,-5,1,0,0,0,0\n";
  const auto inside = json(drill(m_folder / "inside.csv", tool));
  EXPECT_GT(inside["ticks_inside"], 0);
  EXPECT_TRUE(inside["max_penetration_mm"].is_null()) << inside["max_penetration_mm"];
  EXPECT_TRUE(std::isnan(log("log.csv").back().at("penetration_mm")));

  // Its shaft along x in the file: the same.
  std::ofstream(m_folder / "lying.obj") << "v 0 0 0\nv 60 1 1\nv 60 -1 1\nv 60 -1 -1\nv 60 1 -1\n"
                                           "f 1 3 2\nf 1 4 3\nf 1 5 4\nf 1 2 5\nf 2 3 4\nf 2 4 5\n";
  const std::string lying = " --tool " + quoted(m_folder / "lying.obj") + " --tool-axis x+";
  EXPECT_NEAR(json(drill(press(kTop - 1.0, false), lying))["instrument"]["length_mm"], 60.0, 1e-4);
  EXPECT_NEAR(log("log.csv").back().at("pz_mm"), kTop, 0.05 * 0.4);
  // Without its axis it would be 2 mm long and 60 mm wide.
  const std::string assumed = " --tool " + quoted(m_folder / "lying.obj");
  const Outcome across = run(drill(press(1.0, false), assumed));
  EXPECT_NE(across.code, 0);
  EXPECT_NE(across.err.find("--tool-axis x+ (60 mm long, the tip at x = 0.0 mm)"),
            std::string::npos)
      << across.err;
  EXPECT_NEAR(
      json(drill(press(1.0, false), assumed + " --tool-axis z+"))["instrument"]["length_mm"], 2.0,
      1e-4)
      << "as the user says";

  // Pressed with a set thrust onto the bone from above.
  json(drill(press(kTop + 0.5, true), tool + " --thrust 2"));
  EXPECT_NEAR(log("log.csv").back().at("pz_mm"), kTop, 0.05 * 0.4);
  EXPECT_NEAR(log("log.csv").back().at("thrust_n"), 2.0, 0.1);

  const Outcome both = run(drill(press(1.0, false), tool + " --burr diamond"));
  EXPECT_NE(both.code, 0);
  EXPECT_NE(both.err.find("--burr"), std::string::npos);
  EXPECT_NE(run(drill(press(1.0, false), " --tool-axis x+")).code, 0) << "of what?";
  std::ofstream(m_folder / "open.obj") << "v 0 0 0\nv 1 1 60\nv -1 1 60\nf 1 2 3\n";
  const Outcome open = run(drill(press(1.0, false), " --tool " + quoted(m_folder / "open.obj")));
  EXPECT_NE(open.code, 0);
  EXPECT_NE(open.err.find("not closed"), std::string::npos) << open.err;
}

TEST_F(TouchCommand, AnInstrumentIsKeptWithTheCaseAndTakenFromIt)
{
  std::ofstream(m_folder / "Doe pick.obj")
      << "v 0 0 0\nv 60 1 1\nv 60 -1 1\nv 60 -1 -1\nv 60 1 -1\n"
         "f 1 3 2\nf 1 4 3\nf 1 5 4\nf 1 2 5\nf 2 3 4\nf 2 4 5\n";
  EXPECT_NE(run(drill(press(1.0, false), " --case-tool")).err.find("keeps no instrument"),
            std::string::npos);
  EXPECT_TRUE(json("info plane")["instrument"].is_null());
  const std::string file = quoted(m_folder / "Doe pick.obj");
  EXPECT_NE(run("view plane --instrument " + file).err.find("--tool-axis x+"), std::string::npos);
  const auto kept = json("view plane --instrument " + file + " --tool-axis x+");
  EXPECT_TRUE(kept["changed"]);
  EXPECT_EQ(kept["instrument"]["axis"], "x+");
  std::filesystem::remove(m_folder / "Doe pick.obj");
  EXPECT_EQ(json("info plane")["instrument"]["name"], "Doe pick.obj");
  EXPECT_EQ(json("view plane")["instrument"], kept["instrument"]);

  const auto felt = json(drill(press(kTop - 1.0, true), " --case-tool"));
  EXPECT_NEAR(felt["instrument"]["length_mm"], 60.0, 1e-4);
  EXPECT_EQ(felt["removed_mm3"], 0.0);
  EXPECT_NEAR(log("log.csv").back().at("pz_mm"), kTop, 0.05 * 0.4);
  EXPECT_NE(run(drill(press(1.0, false), " --case-tool --burr diamond")).code, 0);

  EXPECT_TRUE(json("view plane --clear instrument")["instrument"].is_null());
  EXPECT_TRUE(json("info plane")["instrument"].is_null());
}

// The place is above the bone, the shaft parallel to it: the approach is along the bone's normal.
TEST_F(TouchCommand, PressesAndDrillsWithTheShaftAlongTheBone)
{
  const auto drilled = [this](double degrees) // angle of the shaft from the normal
  {
    const double half = degrees * std::acos(-1.0) / 360.0;
    std::ofstream file(m_folder / "flat.csv");
    file << "t_s,x_mm,y_mm,z_mm,qw,qx,qy,qz,drill\n";
    for (const auto& [time, y, on] : {std::tuple(0.0, -1.0, 1), std::tuple(0.4, 1.0, 0)})
      file << time << ",0.3," << y << ",2.6," << std::cos(half) << ",0," << std::sin(half) << ",0,"
           << on << '\n';
    file.close();
    const auto answer = json(drill(m_folder / "flat.csv", " --thrust 1"));
    EXPECT_NEAR(answer["removed_mm3"], answer["predicted_mm3"],
                0.02 * answer["predicted_mm3"].template get<double>());
    EXPECT_LE(answer["max_force_n"], 1.0 + 1e-9);
    EXPECT_EQ(answer["held_off_ticks"], 0);
    // Within 16 ticks the shaft has contact data of what the burr removed next to its root.
    EXPECT_LE(answer["held_by_shaft_ticks"], 40) << "of 400";
    json("undo plane");
    return answer["predicted_mm3"].template get<double>();
  };
  const double oblique = drilled(60.0);
  EXPECT_GT(oblique, 1.0);
  // r is the mean over the patch, here of about 1 mm radius: 2/3 mm from its centre.
  const auto arm = [](double degrees)
  {
    return petrous::session::BurrRemovalModel::armOf(
        2.0, (90.0 - degrees) * std::acos(-1.0) / 180.0, 2.0 / 3.0);
  };
  EXPECT_NEAR(drilled(75.0) / oblique, arm(75.0) / arm(60.0), 0.04);
  EXPECT_NEAR(drilled(90.0) / oblique, arm(90.0) / arm(60.0), 0.04);
}

// The shaft points down: it rests on the bone, and the burr is in the air.
TEST_F(TouchCommand, SaysThatTheShaftHoldsTheBurrOff)
{
  const double half = std::acos(-1.0) / 3.0; // 120 degrees from the normal
  std::ofstream file(m_folder / "held.csv");
  file << "t_s,x_mm,y_mm,z_mm,qw,qx,qy,qz,drill\n";
  for (const double time : {0.0, 0.5})
    file << time << ",0.3,0.2,7," << std::cos(half) << ",0," << std::sin(half) << ",0,"
         << (time < 0.5) << '\n';
  file.close();
  const auto outcome = run(drill(m_folder / "held.csv", " --thrust 1"));
  EXPECT_EQ(outcome.code, 0);
  EXPECT_NE(outcome.err.find("the shaft lay on tissue and held the burr off"), std::string::npos)
      << outcome.err;
  const auto answer = json(drill(m_folder / "held.csv", " --thrust 1"));
  EXPECT_EQ(answer["removed_mm3"], 0.0);
  EXPECT_GT(answer["held_off_ticks"], 100);
  EXPECT_GE(answer["held_by_shaft_ticks"], answer["held_off_ticks"]);
  EXPECT_EQ(answer["held_by_handpiece_ticks"], 0);
  EXPECT_LE(answer["max_force_n"], 1.0 + 1e-9);
}

TEST_F(TouchCommand, KeepsTheCentreOutInThreeDegreesOfFreedom)
{
  const auto answer = json(drill(press(-3.0, false), " --mode 3dof"));
  EXPECT_EQ(answer["max_torque_nmm"], 0.0);
  EXPECT_GT(answer["max_penetration_mm"], 1.5) << "the burr sinks in by up to its radius";
  for (const Row& row : log("log.csv"))
    ASSERT_GE(row.at("pz_mm"), kTop - 0.01 * 0.4);
}

// A pad of 0.5 N/mm on the bone, up to z = 4 mm: the coupling of 1 N/mm and the pad are two springs
// in series.
TEST_F(TouchCommand, PressesASoftStructureInAsItsStiffnessSays)
{
  writePad();
  json("add plane --labels pad=" + quoted(m_folder / "pad.nrrd"));
  const double depth = 1.0; // of the device below contact, which is at z = 6
  json(drill(press(6.0 - depth, false), ""));
  EXPECT_NEAR(log("log.csv").back().at("fz_n"), depth, 0.03) << "rigid until it is told";
  json("appearance plane --stiffness pad=0.5");
  for (const char* mode : {"6dof", "3dof"})
  {
    SCOPED_TRACE(mode);
    const auto answer = json(drill(press(6.0 - depth, false), std::string(" --mode ") + mode));
    EXPECT_EQ(answer["removed_mm3"], 0.0);
    EXPECT_EQ(answer["max_penetration_mm"], 0.0) << "of what is rigid";
    const auto rows = log("log.csv");
    EXPECT_NEAR(rows.back().at("fz_n"), depth / 3.0, 0.01);
    EXPECT_NEAR(rows.back().at("thrust_n"), depth / 3.0, 0.01);
    EXPECT_NEAR(rows.back().at("pz_mm"), 6.0 - depth * 2.0 / 3.0, 0.02);
    EXPECT_NEAR(std::hypot(rows.back().at("fx_n"), rows.back().at("fy_n")), 0.0, 0.01);
    for (std::size_t n = 1; n < rows.size(); ++n)
      ASSERT_LT(std::abs(rows[n].at("fz_n") - rows[n - 1].at("fz_n")), 0.01);
  }
  // All the way through to the bone, which stops it as usual.
  json(drill(press(0.13, false), ""));
  for (const Row& row : log("log.csv"))
    ASSERT_GE(row.at("pz_mm"), kTop + 2.0 - 0.05 * 0.4);
}

TEST_F(TouchCommand, DrillsASoftStructure)
{
  writePad();
  json("add plane --labels pad=" + quoted(m_folder / "pad.nrrd"));
  json("appearance plane --stiffness pad=0.5");
  const auto first = json(drill(press(5.0, true, 4.0), ""));
  EXPECT_EQ(first["strokes"], 1);
  EXPECT_GT(first["removed_mm3"], 0.5);
  EXPECT_EQ(first["structures_touched"][0]["label"], "pad");
  const auto rows = log("log.csv");
  EXPECT_NEAR(rows.back().at("fz_n"), 0.0, 0.05) << "what was in the way is gone";
  json("appearance plane --flags pad=shown,touchable");
  json("undo plane");
  EXPECT_EQ(json(drill(press(5.0, true), ""))["removed_mm3"], 0.0);
}

TEST_F(TouchCommand, PressesWithTheThrustThatIsAsked)
{
  // The path stays above the surface: position and orientation only.
  json(drill(press(2.5, false), " --thrust 1.5"));
  const auto rows = log("log.csv");
  EXPECT_NEAR(rows.back().at("thrust_n"), 1.5, 0.015);
  EXPECT_NEAR(rows.back().at("fz_n"), 1.5, 0.015);
}

TEST_F(TouchCommand, DrillsWhatItIsPressedOnAndTheSameEveryTime)
{
  const auto first = json(drill(press(1.13, true, 4.0), ""));
  EXPECT_EQ(first["strokes"], 1);
  const std::string text = textOf(m_folder / "log.csv");
  const auto rows = log("log.csv");
  EXPECT_NEAR(rows.back().at("removed_mm3"), first["removed_mm3"].get<double>(),
              0.02 * first["removed_mm3"].get<double>());
  // The hole is at most as deep as the device: a cap of 1 mm of a ball of 2 mm radius.
  const double cap = std::acos(-1.0) * (2.0 - 1.0 / 3.0);
  EXPECT_LT(first["removed_mm3"], 1.02 * cap);
  EXPECT_GT(first["removed_mm3"], 0.8 * cap);
  json("undo plane");
  EXPECT_NEAR(first["predicted_mm3"].get<double>(),
              first["removed_mm3"].get<double>() + first["owed_mm3"].get<double>() +
                  first["forfeited_mm3"].get<double>(),
              0.02 * first["predicted_mm3"].get<double>());
  EXPECT_EQ(first["swept_mm3"], 0.0);
  EXPECT_NEAR(rows.back().at("predicted_mm3"), first["predicted_mm3"].get<double>(), 1e-9);
  const auto again = json(drill(press(1.13, true, 4.0), ""));
  EXPECT_EQ(again["removed_mm3"], first["removed_mm3"]);
  EXPECT_TRUE(textOf(m_folder / "log.csv") == text);
}

TEST_F(TouchCommand, DrillsWithABurrOfTheLibrarysCatalogueByItsName)
{
  const auto path = press(1.13, true);
  const double usual = json(drill(path, " --burr diamond"))["removed_mm3"];
  json("undo plane");
  std::ofstream(m_folder / "coarse.json") << R"({"burrs": [
    {"kind": "cutting", "rake_deg": -10, "diameters_mm": [4]},
    {"kind": "diamond", "wear_coefficient": 0.1, "diameters_mm": [4]},
    {"name": "coarse", "kind": "diamond", "wear_coefficient": 0.2, "diameters_mm": [4]}]})";
  const std::string own = " --burr coarse --burrs " + quoted(m_folder / "coarse.json");
  const auto file = m_folder / "coarse.ticks";
  const double coarse = json(drill(path, own + " --record " + quoted(file)))["removed_mm3"];
  EXPECT_GT(coarse, 1.1 * usual) << "half the energy per volume";
  const auto stroke = json("history plane")["strokes"].back();
  EXPECT_EQ(stroke["burr"], "diamond");
  EXPECT_EQ(stroke["burr_name"], "coarse");
  EXPECT_NE(run("history plane").out.find("4.0 mm coarse"), std::string::npos);

  json("undo plane");
  const std::string again = "drill plane --replay " + quoted(file);
  expectRefused(again + " --burr diamond", 3, "coarse burr 4 mm");
  EXPECT_EQ(json(again + " --burr coarse")["replay"]["equal"], true);
  EXPECT_EQ(json("history plane")["strokes"].back()["burr_name"], "coarse");
  expectRefused(drill(path, " --burr coarse"), 2, "there are cutting, diamond");
}

TEST_F(TouchCommand, RemovesNothingThatItDoesNotTouch)
{
  const auto answer = json(drill(press(2.2, true), "")); // 0.07 mm above the surface
  EXPECT_EQ(answer["removed_mm3"], 0.0);
  EXPECT_EQ(answer["max_force_n"], 0.0);
}

TEST_F(TouchCommand, ABurrThatStandsStillRemovesNothing)
{
  for (const double height : {1.13, -1.0}) // pressed on bone, and dragged through it
    EXPECT_EQ(json(drill(press(height, true), " --rpm 0"))["removed_mm3"], 0.0);
  std::ofstream inside(m_folder / "inside.csv");
  inside
      << "t_s,x_mm,y_mm,z_mm,qw,qx,qy,qz,drill\n0,0.3,0.2,-2,1,0,0,0,1\n0.2,0.5,0.2,-2,1,0,0,0,1\n";
  inside.close();
  const auto still = json(drill(m_folder / "inside.csv", " --rpm 0"));
  EXPECT_GT(still["ticks_inside"], 100);
  EXPECT_EQ(still["removed_mm3"], 0.0);
  EXPECT_EQ(still["swept_mm3"], 0.0);
  const auto turning = json(drill(m_folder / "inside.csv", ""));
  EXPECT_GT(turning["removed_mm3"], 1.0);
  EXPECT_NEAR(turning["swept_mm3"].get<double>(), turning["removed_mm3"].get<double>(), 0.05);
  EXPECT_EQ(turning["predicted_mm3"], 0.0);
}

TEST_F(TouchCommand, SaysThatThePathBeginsInTissueAndMeasuresWhatIsSweptWithAndWithoutALog)
{
  std::ofstream inside(m_folder / "inside.csv");
  inside
      << "t_s,x_mm,y_mm,z_mm,qw,qx,qy,qz,drill\n0,0.3,0.2,-2,1,0,0,0,1\n0.2,0.5,0.2,-2,1,0,0,0,1\n";
  inside.close();
  const auto outcome = run(drill(m_folder / "inside.csv", ""));
  EXPECT_NE(outcome.err.find("the path begins in tissue"), std::string::npos) << outcome.err;
  EXPECT_LT(outcome.err.find("the path begins in tissue"), outcome.err.find("the tool stood in"));
  EXPECT_EQ(run(drill(press(2.2, true), "")).err.find("begins in tissue"), std::string::npos);
  json("undo plane");
  const auto plain = json("drill plane --path " + quoted(m_folder / "inside.csv"));
  json("undo plane");
  const auto logged = json(drill(m_folder / "inside.csv", ""));
  EXPECT_GT(plain["swept_mm3"], 1.0);
  EXPECT_NE(run("info plane").out.find("1 stroke done"), std::string::npos);
  EXPECT_NEAR(plain["swept_mm3"].get<double>(), logged["swept_mm3"].get<double>(), 1e-3);
}

TEST_F(TouchCommand, RefusesMaterialsThatNoLawHoldsFor)
{
  const auto materials = [this](const std::string& energy, const std::string& friction)
  {
    std::ofstream(m_folder / "materials.json")
        << R"({"materials":[{"name":"odd","specific_cutting_energy_gpa":)" << energy
        << R"(,"friction":)" << friction << R"(,"vickers_hardness_hv":40}],)"
        << R"("bone":{"cellular":"odd","cortical":"odd","from_hu":300,"to_hu":1800}})";
    return "drill plane --path " + quoted(press(1.13, true)) + " --materials " +
           quoted(m_folder / "materials.json");
  };
  EXPECT_EQ(run(materials("3", "0.5")).code, 0);
  expectRefused(materials("0", "0.5"), 3, "'specific_cutting_energy_gpa' must be above 0, it is 0");
  std::ofstream(m_folder / "burrs.json")
      << R"({"burrs":[{"kind":"cutting","rake_deg":25,"diameters_mm":[4]},)"
      << R"({"kind":"diamond","wear_coefficient":0.1,"diameters_mm":[4]}]})";
  expectRefused(materials("3", "0.5") + " --burrs " + quoted(m_folder / "burrs.json"), 3,
                "material 'odd' with the cutting burr");
}

// Two presses one after the other, each a recording of its own.
TEST_F(TouchCommand, ReviewsTheRecordingsOfAnOperationTogether)
{
  nlohmann::json made[2];
  std::string files;
  for (int n = 0; n < 2; ++n)
  {
    const auto file = m_folder / (n == 0 ? "operation.ticks" : "operation (2).ticks");
    made[n] = json("drill plane --mode 3dof --path " + quoted(press(1.13, true)) + " --record " +
                   quoted(file) + (n == 0 ? "" : " --diameter 6"));
    ASSERT_GT(made[n]["removed_mm3"], 0.0);
    files += " " + quoted(file);
  }
  const auto table = m_folder / "operation.csv";
  const auto answer = json("review plane" + files + " --out " + quoted(table) + " --course " +
                           quoted(m_folder / "course.csv"));
  const auto& total = answer["total"];
  ASSERT_EQ(answer["parts"].size(), 2U);
  for (std::size_t n = 0; n < 2; ++n)
  {
    const auto& part = answer["parts"][n];
    EXPECT_NEAR(part["removed_mm3"], made[n]["removed_mm3"], 1e-6);
    EXPECT_EQ(part["strokes"], made[n]["strokes"]);
    EXPECT_NEAR(part["max_force_n"], made[n]["max_force_n"], 1e-9);
  }
  EXPECT_NEAR(total["removed_mm3"],
              made[0]["removed_mm3"].get<double>() + made[1]["removed_mm3"].get<double>(), 1e-6);
  EXPECT_NEAR(total["duration_s"],
              answer["parts"][0]["duration_s"].get<double>() +
                  answer["parts"][1]["duration_s"].get<double>(),
              1e-9);
  EXPECT_EQ(answer["parts"][1]["begin_s"], answer["parts"][0]["duration_s"]);
  std::ifstream in(table);
  std::vector<std::string> lines;
  for (std::string line; std::getline(in, line);)
    lines.push_back(line);
  ASSERT_EQ(lines.size(), 4U);
  EXPECT_EQ(lines[2].rfind("2,operation (2).ticks,cutting,6.00,", 0), 0U) << lines[2];
  EXPECT_EQ(lines[3].rfind("total,", 0), 0U) << lines[3];
  EXPECT_EQ(json("info plane")["dissection"]["strokes"],
            made[0]["strokes"].get<int>() + made[1]["strokes"].get<int>())
      << "nothing is drilled";
  expectRefused("review plane", 3, "the library has no recording of case 'plane'");
  expectRefused("review plane " + quoted(m_folder / "missing.ticks"), 3, "missing.ticks");
}

TEST_F(TouchCommand, PlaysARecordingAgainToTheLastBit)
{
  for (const std::string mode : {"6dof", "3dof"})
  {
    const auto file = m_folder / (mode + ".ticks");
    const bool logged = mode == "6dof"; // writing takes time
    const auto log = [&](const char* name)
    { return logged ? " --log " + quoted(m_folder / name) : std::string(); };
    const auto first = json("drill plane --path " + quoted(press(1.13, true)) + " --mode " + mode +
                            " --record " + quoted(file) + log("log.csv"));
    EXPECT_EQ(first["recording"]["ticks"], first["ticks"]);
    EXPECT_EQ(first["recording"]["bytes"], std::filesystem::file_size(file));
    EXPECT_GT(first["removed_mm3"], 1.0);
    json("undo plane");
    const auto again =
        json("drill plane --replay " + quoted(file) + " --mode " + mode + log("again.csv"));
    EXPECT_EQ(again["replay"]["equal"], true);
    EXPECT_EQ(again["replay"]["complete"], true);
    EXPECT_EQ(again["replay"]["different_ticks"], 0);
    for (const char* key : {"ticks", "strokes", "removed_mm3", "max_force_n", "max_torque_nmm",
                            "max_penetration_mm", "ticks_inside", "structures_touched"})
      EXPECT_EQ(again[key], first[key]) << key;
    if (logged)
    {
      // Except for the removal law's values: a replay repeats the cuts as recorded.
      const auto rows = [&](const char* name)
      {
        std::vector<Row> result = this->log(name);
        for (Row& row : result)
          for (const char* column : {"r_mm", "removed_mm3", "predicted_mm3"})
            row.erase(column);
        return result;
      };
      EXPECT_TRUE(rows("again.csv") == rows("log.csv"));
      EXPECT_NEAR(this->log("again.csv").back().at("removed_mm3"),
                  this->log("log.csv").back().at("removed_mm3"), 0.02);
    }
    EXPECT_EQ(json("info plane")["dissection"]["undo"], 1) << "the stroke is in the case again";
    json("undo plane");
  }
}

TEST_F(TouchCommand, SaysWhereAReplayDiffersAndLeavesTheCase)
{
  const auto file = m_folder / "hand.ticks";
  json("drill plane --path " + quoted(press(1.13, true)) + " --record " + quoted(file));
  json("undo plane");
  // As computed by another program: one bit of the force of one tick.
  {
    petrous::session::RecordingReader reader(file);
    petrous::session::RecordingWriter writer(m_folder / "other.ticks", reader.setup());
    petrous::session::RecordingBlock block;
    while (reader.next(block))
    {
      for (const auto& edit : block.edits)
        writer.add(edit);
      for (auto& tick : block.ticks)
      {
        if (tick.number == 700)
          tick.wrench.force[2] = std::nextafter(tick.wrench.force[2], 1e9);
        writer.add(tick);
      }
    }
  }
  const auto before = libraryContent();
  const auto outcome = run("drill plane --json --replay " + quoted(m_folder / "other.ticks"));
  EXPECT_EQ(outcome.code, 1);
  EXPECT_NE(outcome.err.find("1 of 1001 ticks differ, first tick 700): the force"),
            std::string::npos)
      << outcome.err;
  const auto answer = nlohmann::json::parse(outcome.out)["replay"];
  EXPECT_EQ(answer["equal"], false);
  EXPECT_EQ(answer["first_different_tick"], 700);
  EXPECT_EQ(answer["different_ticks"], 1);
  EXPECT_EQ(libraryContent(), before);
}

TEST_F(TouchCommand, LogsNoPoseWhereNoReadingTellsIt)
{
  const auto file = m_folder / "hand.ticks";
  json("drill plane --path " + quoted(press(1.13, false)) + " --record " + quoted(file));
  constexpr std::uint64_t kSilent = 5; // ticks
  {
    petrous::session::RecordingReader reader(file);
    petrous::session::RecordingWriter writer(m_folder / "late.ticks", reader.setup());
    petrous::session::RecordingBlock block;
    while (reader.next(block))
      for (auto& tick : block.ticks)
      {
        if (tick.number < kSilent)
          tick.input.health =
              static_cast<std::uint32_t>(petrous::haptics::DeviceHealth::Disconnected);
        writer.add(tick);
      }
  }
  run("drill plane --replay " + quoted(m_folder / "late.ticks") + " --log " +
      quoted(m_folder / "log.csv")); // differs from what was recorded
  const std::vector<Row> rows = log("log.csv");
  ASSERT_GT(rows.size(), 500u);
  for (std::size_t n = 0; n < kSilent; ++n)
    for (const char* column : {"dx_mm", "dy_mm", "dz_mm", "dqw", "px_mm", "py_mm", "pz_mm", "pqw"})
      EXPECT_TRUE(std::isnan(rows[n].at(column))) << n << ' ' << column;
  EXPECT_EQ(rows[0].at("fz_n"), 0.0);
  EXPECT_NEAR(rows.back().at("px_mm"), 0.3, 0.05);
  EXPECT_NEAR(rows.back().at("dz_mm"), 1.13, 1e-6);
}

TEST_F(TouchCommand, SaysWhatDoesNotFitARecordingAndLeavesTheCase)
{
  const auto file = m_folder / "hand.ticks";
  json(drill(press(1.13, true), " --record " + quoted(file)));
  const std::string again = "drill plane --replay " + quoted(file);
  const auto before = libraryContent();
  expectRefused(again, 3, "petrous undo 'plane' 1");
  EXPECT_EQ(libraryContent(), before);
  json("undo plane");
  expectRefused(again + " --diameter 3", 3, "cutting burr 4 mm");
  expectRefused(again + " --burr diamond", 3, "cutting burr 4 mm");
  expectRefused(again + " --mode 3dof", 3, "6 degrees of freedom");
  expectRefused(again + " --thrust 1", 2, "--replay");
  expectRefused(again + " --record " + quoted(m_folder / "other.ticks"), 2, "--replay");
  expectRefused(again + " --path " + quoted(m_folder / "press.csv"), 2, "either");
  expectRefused("drill plane", 2, "either");
  json("appearance plane --iso 320");
  expectRefused(again, 3, "--iso 300");
  json("appearance plane --iso 300");
  json("new other --ct " + quoted(otherPlane()));
  json("appearance other --iso 300");
  expectRefused("drill other --replay " + quoted(file), 3, "another CT");
  expectRefused("drill plane --replay " + quoted(m_folder / "press.csv"), 3, "not a recording");
  expectRefused("drill plane --replay " + quoted(m_folder / "missing.ticks"), 3, "missing.ticks");
  EXPECT_EQ(json(again)["replay"]["equal"], true);
}

TEST_F(TouchCommand, PlaysARecordingThatWasCutShortUpToThere)
{
  const auto file = m_folder / "hand.ticks";
  auto path = press(1.13, false);
  std::ofstream(path, std::ios::app) << "2.5,0.3,0.2,1.13,1,0,0,0,0\n";
  json(drill(path, " --record " + quoted(file)));
  const std::string whole = textOf(file);
  std::ofstream(file, std::ios::binary) << whole.substr(0, whole.size() - 100);
  const auto outcome = run("drill plane --json --replay " + quoted(file));
  EXPECT_EQ(outcome.code, 0);
  EXPECT_NE(outcome.err.find("was not closed"), std::string::npos) << outcome.err;
  const auto answer = nlohmann::json::parse(outcome.out);
  EXPECT_EQ(answer["ticks"], 2000);
  EXPECT_EQ(answer["replay"]["complete"], false);
  EXPECT_EQ(answer["replay"]["equal"], true);
  // A changed byte is not the same as a truncated file.
  std::string bad = whole;
  bad[bad.size() / 2] = static_cast<char>(bad[bad.size() / 2] ^ 1);
  std::ofstream(file, std::ios::binary) << bad;
  expectRefused("drill plane --replay " + quoted(file), 3, "damaged");
}

TEST_F(TouchCommand, RefusesWhatItCannotDo)
{
  const auto refused = [this](const std::string& more, int code, const std::string& word)
  {
    const auto outcome = run(drill(press(1.0, true), more));
    EXPECT_EQ(outcome.code, code) << more;
    EXPECT_NE(outcome.err.find(word), std::string::npos) << outcome.err;
  };
  refused(" --mode 5dof", 2, "6dof");
  refused(" --record " + quoted(m_folder / "missing" / "hand.ticks"), 3, "hand.ticks");
  refused(" --thrust -1", 2, "--thrust");
  refused(" --diameter 30", 2, "--diameter");
  const auto outcome = run("drill plane --path " + quoted(press(1.0, true)) + " --log " +
                           quoted(m_folder / "missing" / "log.csv"));
  EXPECT_EQ(outcome.code, 3);
  EXPECT_NE(outcome.err.find("log.csv"), std::string::npos) << outcome.err;
}
