#include <map>
#include <regex>
#include <set>
#include <string>

#include "CommandRunner.h"

using namespace petrous::testing;

namespace
{
using BenchCommand = CommandLine;
}

TEST_F(BenchCommand, MeasuresTheRendererBesideItsPeersAndItsError)
{
  const auto out = m_folder / "figures";
  const auto report =
      json("bench renderer --quick --edge 24 --paraview absent-pvpython --out " + quoted(out));
  // The commit the figures were measured on; "unknown" outside of a git checkout.
  const std::string commit = report.at("commit");
  EXPECT_TRUE(std::regex_match(commit, std::regex("[0-9a-f]{12}(-dirty)?|unknown"))) << commit;
  std::set<std::string> peers, varied, marked;
  int surfaces = 0;
  int interactive = 0;
  int moving = 0, resting = 0, lit = 0;
  int features = 0, roundedFilters = 0;
  for (const auto& point : report.at("points"))
  {
    const auto& setting = point.at("setting");
    const std::string scene = setting.at("scene");
    EXPECT_GT(point.at("seconds").get<double>(), 0.0) << scene;
    const bool isSoftTissue = scene.find("soft tissue alone") != std::string::npos;
    const bool isLit = scene.find("soft tissue alone, lit") != std::string::npos;
    lit += isLit;
    // The same optics in all programs: at rest their pictures agree.
    if (isSoftTissue && !isLit)
    {
      const double error = point.at("error").get<double>();
      const bool isMoving = scene.find(", moving") != std::string::npos;
      ++(isMoving ? moving : resting);
      EXPECT_TRUE(isMoving || error < (point.at("peer").is_null() ? 3.0 : 15.0)) << point;
      EXPECT_GE(error, 0.0) << point;
    }
    if (!point.at("peer").is_null())
    {
      peers.insert(point.at("peer"));
      EXPECT_EQ(point.at("error").is_null(), !isSoftTissue || isLit)
          << "other optics have no error of ours";
      EXPECT_FALSE(setting.at("default").get<bool>());
      continue;
    }
    if (setting.contains("varied"))
    {
      varied.insert(setting.at("varied"));
      if (setting.at("default").get<bool>())
        marked.insert(setting.at("varied"));
    }
    // Analytic truth: a plane and a ball, independent of the phantom's size.
    if (scene == "slanting plane" || scene == "ball of 24 mm")
    {
      ++surfaces;
      EXPECT_LE(point.at("error").get<double>(), 0.05) << scene;
    }
    // With the feature and without it; the weights' error stands beside that of none rounded.
    if (scene.find(", feature: ") != std::string::npos)
    {
      ++features;
      roundedFilters += scene.find("weights of 8 bits") != std::string::npos;
      const auto& extra = point.at("extra");
      EXPECT_GT(extra.at("without_ms").get<double>(), 0.0) << scene;
      EXPECT_LT(extra.at("share_percent").get<double>(), 100.0) << scene;
      EXPECT_GT(extra.at("fetches_per_pixel_without").get<double>(), 0.0) << scene;
      if (scene.find("feature: shadows") != std::string::npos)
      {
        EXPECT_GT(extra.at("fetches_per_pixel").get<double>(),
                  extra.at("fetches_per_pixel_without").get<double>())
            << scene;
      }
      const bool isAlone = scene.find(" alone") != std::string::npos;
      EXPECT_LE(point.at("error").get<double>(), isAlone ? 0.3 : 40.0) << scene;
    }
    // During camera motion: frame rate, worst frame, and picture scale.
    if (scene.find(", interactive ") != std::string::npos)
    {
      ++interactive;
      const auto& extra = point.at("extra");
      EXPECT_LE(extra.at("slowest_hertz").get<double>(), extra.at("hertz").get<double>()) << scene;
      EXPECT_GT(extra.at("smallest_scale").get<double>(), 0.0) << scene;
      EXPECT_LE(extra.at("smallest_scale").get<double>(), 1.0) << scene;
    }
    // A picture after an edit equals one drawn from scratch, pixel by pixel.
    if (scene.find("a 4 mm burr") != std::string::npos)
    {
      ++surfaces;
      EXPECT_EQ(point.at("error").get<double>(), 0.0) << scene;
    }
  }
  EXPECT_EQ(surfaces, 6);
  EXPECT_EQ(features, 21);
  EXPECT_EQ(roundedFilters, 4);
  const std::string paraview = report.at("machine").at("paraview");
  EXPECT_NE(paraview.find("no peer"), std::string::npos) << paraview;
  EXPECT_EQ(interactive, 4);
  EXPECT_EQ(moving, 3);
  EXPECT_EQ(resting, 3);
  EXPECT_EQ(lit, 6);
  EXPECT_EQ(peers.size(), 6U);
  EXPECT_EQ(varied, (std::set<std::string>{"bisections", "brick_voxels", "mask_bits", "step_voxels",
                                           "table_entries", "termination"}));
  EXPECT_EQ(marked, varied) << "each curve marks the setting that the product uses";
  EXPECT_TRUE(std::filesystem::exists(out / "renderer.json"));
  expectPlots(out, {"renderer.svg", "renderer-frames.svg"});
}

TEST_F(BenchCommand, MeasuresAPartOfTheRenderer)
{
  const auto out = m_folder / "figures";
  const auto report = json("bench renderer --quick --edge 24 --part shapes --out " + quoted(out));
  EXPECT_EQ(report.at("points").size(), 2U);
  expectPlots(out, {"renderer-frames.svg"});
  const auto outcome = run("bench renderer --part nothing --out " + quoted(out));
  EXPECT_EQ(outcome.code, 2);
  EXPECT_NE(outcome.err.find("'nothing'"), std::string::npos) << outcome.err;
  // Of all benchmarks it would be those without any part, each of them whole.
  const auto none = m_folder / "none";
  expectRefused("bench all --quick --part shapes --part captur --out " + quoted(none), 2,
                "no benchmark has a part 'captur'");
  EXPECT_FALSE(std::filesystem::exists(none));
}

// The law and the removed balls are the truth; whole-voxel deletion follows neither thrust nor law.
TEST_F(BenchCommand, MeasuresRemovalBesideTheLawAndWholeVoxels)
{
  const auto out = m_folder / "figures";
  const auto report = json("bench removal --quick --out " + quoted(out));
  std::set<std::string> scenes;
  int peers = 0;
  std::map<std::string, double> peerRates; // tick -> mm^3/s
  for (const auto& point : report.at("points"))
  {
    const auto& setting = point.at("setting");
    const std::string scene = setting.at("scene");
    const auto& extra = point.at("extra");
    const double error = point.at("error").get<double>();
    scenes.insert(scene);
    EXPECT_TRUE(setting.contains("varied")) << scene;
    EXPECT_GT(extra.at("ticks").get<double>(), 0.0) << scene;
    EXPECT_LE(point.at("seconds").get<double>(), 1e-6 * extra.at("processor_us_max").get<double>());
    if (!point.at("peer").is_null())
    {
      ++peers;
      if (setting.at("varied") == "tick_ms, 4 mm burr")
        peerRates[setting.at("tick_ms")] = extra.at("rate_mm3_per_s").get<double>();
      EXPECT_GT(error, 50.0) << setting;
    }
    else if (extra.contains("max_voxels"))
    {
      EXPECT_LE(error, 0.05) << setting;
      EXPECT_LE(extra.at("max_voxels").get<double>(), 0.25) << setting;
      EXPECT_GT(extra.at("points").get<double>(), 100.0) << setting;
    }
    else
    {
      EXPECT_LE(error, 2.0) << setting;
    }
  }
  EXPECT_EQ(scenes.size(), 5U);
  EXPECT_EQ(peers, 5);
  // Six voxels of 0.2 mm per tick.
  EXPECT_NEAR(peerRates["1.0"], 6.0 * 0.008 / 1e-3, 0.5);
  EXPECT_NEAR(peerRates["2.0"], 6.0 * 0.008 / 2e-3, 0.5);
  EXPECT_TRUE(std::filesystem::exists(out / "removal.json"));
  expectPlots(out, {"removal.svg", "removal-5.svg"});
}

// Against the phantom's formula, beside a curve through the same points.
TEST_F(BenchCommand, TracesTheFacialNerveWithinTheErrorAllowed)
{
  const auto out = m_folder / "figures";
  const auto report = json("bench nerve --quick --out " + quoted(out));
  int nerves = 0;
  int curves = 0;
  for (const auto& point : report.at("points"))
  {
    const std::string scene = point.at("setting").at("scene");
    if (scene.find("facial nerve") == std::string::npos)
      continue;
    const double mean = point.at("error");
    const double largest = point.at("extra").at("max_mm");
    EXPECT_LE(mean, largest);
    if (!point.at("peer").is_null())
    {
      ++curves;
      EXPECT_GT(mean, 0.15) << "the points lie up to 1 mm off";
      continue;
    }
    ++nerves;
    EXPECT_LE(mean, 0.15) << scene;
    EXPECT_LE(largest, 0.44) << scene;
    EXPECT_GT(point.at("extra").at("resolved").get<double>(), 0.9) << scene;
  }
  EXPECT_EQ(nerves, 2);
  EXPECT_EQ(curves, 2);
  EXPECT_TRUE(std::filesystem::exists(out / "nerve.json"));
  expectPlots(out, {"nerve.svg"});
}

// Against balls, beside ITK's filters.
TEST_F(BenchCommand, MakesStructuresWithinTheErrorAllowed)
{
  const auto out = m_folder / "figures";
  const auto report = json("bench segment --quick --out " + quoted(out));
  int operations = 0;
  int strokes = 0;
  std::set<std::string> filters;
  for (const auto& point : report.at("points"))
  {
    const std::string scene = point.at("setting").at("scene");
    const double error = point.at("error");
    const auto& extra = point.at("extra");
    if (!point.at("peer").is_null())
      filters.insert(point.at("setting").value("filter", "copy"));
    else if (scene.find("paint") == 0)
    {
      ++strokes;
      EXPECT_LE(error, 5.0) << scene;
      EXPECT_LE(extra.at("undo_percent").get<double>(), 5.0) << scene;
      EXPECT_EQ(extra.at("differing_voxels").get<double>(), 0.0) << scene;
    }
    else
    {
      ++operations;
      EXPECT_LE(error, scene.find("0.9 mm") == std::string::npos ? 0.13 : 0.25) << scene;
      EXPECT_LE(extra.at("volume_percent").get<double>(), 5.0) << scene;
    }
  }
  EXPECT_EQ(operations, 10);
  EXPECT_EQ(strokes, 4);
  EXPECT_EQ(filters.size(), 8U);
  expectPlots(out, {"segment.svg"});
}

TEST_F(BenchCommand, ReadsStructuresOfTheVolumeThatTheirFilesEnclose)
{
  const auto out = m_folder / "figures";
  const auto report = json("bench structures --quick --out " + quoted(out));
  int sets = 0;
  int segmentations = 0;
  for (const auto& point : report.at("points"))
  {
    if (!point.at("peer").is_null())
      continue;
    const std::string scene = point.at("setting").at("scene");
    EXPECT_LE(point.at("error").get<double>(), 1.0) << point;
    (scene.find("DICOM SEG") == 0 ? segmentations : sets) += 1;
  }
  EXPECT_EQ(sets, 6);
  EXPECT_EQ(segmentations, 1);
  expectPlots(out, {"structures.svg"});
}

// gzip, zip and tar are peers where they are installed.
TEST_F(BenchCommand, ArchivesRestoresListsAndOpensALibraryToTheBit)
{
  const auto out = m_folder / "figures";
  const auto report = json("bench library --quick --out " + quoted(out));
  std::set<std::string> operations;
  for (const auto& point : report.at("points"))
  {
    if (!point.at("peer").is_null())
      continue;
    const std::string scene = point.at("setting").at("scene");
    operations.insert(scene.substr(0, scene.find_first_of(", ")));
    // Of opening: what the system reads ahead, MB.
    if (scene.find("open") != 0)
    {
      EXPECT_EQ(point.at("error").get<double>(), 0.0) << point;
    }
  }
  operations.erase("open"); // needs OpenGL
  EXPECT_EQ(operations, (std::set<std::string>{"archive", "list", "restore", "search", "verify"}));
  expectPlots(out, {"library.svg"});
}

TEST_F(BenchCommand, FindsLandmarksOfATiltedScanWhereTheyAre)
{
  const auto out = m_folder / "figures";
  const auto report = json("bench tilt --quick --out " + quoted(out));
  std::set<std::string> angles;
  double ignored = 0.0;
  for (const auto& point : report.at("points"))
  {
    if (point.at("peer").is_null())
    {
      angles.insert(point.at("setting").at("tilt_degrees"));
      EXPECT_LE(point.at("error").get<double>(), 0.1) << point;
    }
    else if (point.at("peer") == "itk::ImageSeriesReader")
      ignored = std::max(ignored, point.at("error").get<double>());
  }
  EXPECT_EQ(angles, (std::set<std::string>{"-30", "-15", "0", "15", "30"}));
  EXPECT_GT(ignored, 10.0) << "the slices are tilted";
  expectPlots(out, {"tilt.svg"});
}

// Every voxel, also of compressed slices.
TEST_F(BenchCommand, ImportsWhatWasWritten)
{
  const auto out = m_folder / "figures";
  const auto report = json("bench import --quick --out " + quoted(out));
  int series = 0;
  for (const auto& point : report.at("points"))
    if (point.at("peer").is_null())
    {
      ++series;
      EXPECT_LE(point.at("error").get<double>(), 1e-9) << point;
    }
  EXPECT_EQ(series, 1 + 4 + 2) << "uncompressed, four codecs, and two scans";
  expectPlots(out, {"import.svg"});
}

// How long a tick takes is the machine's; what is said of it must hold together.
TEST_F(BenchCommand, RunsTheServoLiveAndGivesTheDistributionOfItsTicks)
{
  const auto out = m_folder / "figures";
  const auto report = json("bench servo --quick --seconds 1 --out " + quoted(out));
  std::map<std::string, double> last; // points and kind -> s of the quantile before
  std::map<std::string, int> quantiles;
  std::vector<int> tools;
  for (const auto& point : report.at("points"))
  {
    const auto& setting = point.at("setting");
    if (std::string(setting.at("scene")).rfind("live: phantom 96^3", 0) != 0)
      continue;
    const std::string of = setting.at("of");
    const std::string name = std::string(setting.at("points")) + " " + of;
    if (of != "session")
    {
      EXPECT_GE(point.at("seconds").get<double>(), last[name]) << point;
      last[name] = point.at("seconds");
      ++quantiles[name];
      continue;
    }
    const auto& extra = point.at("extra");
    tools.push_back(std::stoi(std::string(setting.at("points"))));
    EXPECT_GT(extra.at("ticks").get<double>(), 0.0);
    EXPECT_GE(extra.at("ran_s").get<double>(), 1.0);
    EXPECT_LE(extra.at("ticks").get<double>(), 1000.0 * extra.at("ran_s").get<double>() + 1.0);
    EXPECT_LE(extra.at("ticks_late"), extra.at("ticks"));
    for (const char* kind : {"wall_us_", "lateness_us_"})
      EXPECT_LE(extra.at(std::string(kind) + "p99.99"), extra.at(std::string(kind) + "max"));
    EXPECT_NEAR(1e-6 * extra.at("wall_us_p50").get<double>(), point.at("seconds"), 1e-12);
  }
  ASSERT_EQ(tools.size(), 2u);
  EXPECT_GT(tools[0], 1000);
  EXPECT_LE(tools[0], 2000);
  EXPECT_GT(tools[1], 5000);
  EXPECT_LE(tools[1], 10000);
  ASSERT_EQ(quantiles.size(), 4u);
  for (const auto& [name, count] : quantiles)
  {
    EXPECT_EQ(count, 10) << name;
    EXPECT_GT(last[name], 0.0) << name;
  }
  expectPlots(out, {"servo.svg", "servo-live.svg"});
}

// Truth: the bound of Colgate and Schenkel, with the delay added, for mass and damper alone.
TEST_F(BenchCommand, SweepsTheStiffnessOfDevicesOverTheirDelay)
{
  const auto out = m_folder / "figures";
  const auto report = json("bench devices --quick --out " + quoted(out));
  std::set<std::string> rows;
  int borders = 0;
  for (const auto& point : report.at("points"))
  {
    const auto& setting = point.at("setting");
    const auto& extra = point.at("extra");
    const std::string device = setting.at("scene");
    const std::string delay = setting.at("delay_ms");
    rows.insert(device + setting.at("guard").get<std::string>() + delay +
                setting.at("missed_percent").get<std::string>() + "x" +
                setting.at("missed_at_once").get<std::string>());
    const double largest = extra.at("largest_stable_n_per_mm");
    const double described = extra.at("described_n_per_mm");
    EXPECT_NEAR(described, device == "Touch" ? 0.2 : 0.25, 1e-12) << device;
    EXPECT_NEAR(extra.at("described_margin").get<double>(), largest / described, 1e-12);
    // Up to the largest stable one, all are.
    for (const char* at : {"0.25", "1", "10"})
      if (std::stod(at) <= largest)
      {
        EXPECT_LE(extra.at(std::string("energy_mj_at_") + at).get<double>(), 0.1) << point;
        EXPECT_LE(extra.at(std::string("cycle_n_pp_at_") + at).get<double>(), 0.1) << point;
      }
    if (device == "Touch")
      continue;
    EXPECT_EQ(largest, delay == "0" ? 1.0 : 0.0) << point;
    EXPECT_NEAR(extra.at("passive_n_per_mm").get<double>(), delay == "0" ? 6.0 : 0.003 / 0.0085,
                1e-9);
    if (!extra.contains("border_n_per_mm"))
      continue;
    ++borders;
    EXPECT_NEAR(extra.at("border_n_per_mm").get<double>() /
                    extra.at("passive_n_per_mm").get<double>(),
                1.0, 0.12)
        << point;
    EXPECT_GT(extra.at("energy_mj_at_10").get<double>(), 0.1);
    EXPECT_GT(extra.at("cycle_n_pp_at_10").get<double>(), 0.1);
  }
  EXPECT_EQ(rows.size(), 2u * 2u * 2u * 2u);
  EXPECT_EQ(borders, 2);
  expectPlots(out, {"devices.svg", "devices-2.svg"});
}

// How long they are is the machine's; what is said of them must hold together.
TEST_F(BenchCommand, MeasuresTheDelaysFromTheHandToForceAndSound)
{
  const auto out = m_folder / "figures";
  const auto report = json("bench delays --quick --out " + quoted(out));
  int forces = 0;
  int sounds = 0;
  for (const auto& point : report.at("points"))
  {
    const auto& extra = point.at("extra");
    const auto rises = [&extra](const std::string& what)
    {
      double last = 0.0;
      for (const char* at : {"_us_p50", "_us_p90", "_us_p99", "_us_p99.9", "_us_max"})
      {
        EXPECT_GE(extra.at(what + at).get<double>(), last) << what << at;
        last = extra.at(what + at);
      }
      EXPECT_GT(last, 0.0) << what;
    };
    if (point.at("setting").at("scene") == "server to force")
    {
      ++forces;
      for (const char* what : {"pose_to_servo", "servo_to_motors", "pose_to_motors"})
        rises(what);
      EXPECT_EQ(extra.at("ticks"), 1000.0);
      EXPECT_GT(extra.at("arrived").get<double>(), 100.0);
      EXPECT_LE(extra.at("arrived"), extra.at("ticks"));
      continue;
    }
    ++sounds;
    rises("tick_to_heard");
    EXPECT_GE(extra.at("taps").get<double>(), 1.0);
    EXPECT_NEAR(extra.at("without_card_ms").get<double>(),
                1e-3 * extra.at("tick_to_heard_us_p99.9").get<double>() +
                    extra.at("block_ms").get<double>() + extra.at("onset_ms").get<double>(),
                1e-9);
    EXPECT_LT(extra.at("onset_ms").get<double>(), 15.0);
    EXPECT_EQ(extra.at("centroid_monotone"), 1.0) << point;
    EXPECT_GT(extra.at("centroid_hz_at_0_mm").get<double>(),
              extra.at("centroid_hz_at_5_mm").get<double>());
  }
  EXPECT_EQ(forces, 2);
  EXPECT_EQ(sounds, 6);
  expectPlots(out, {"delays.svg"});
}

// A plot that cannot be drawn costs no figures.
TEST_F(BenchCommand, NamesWhatDrawsThePlotsThatCouldNotBeDrawn)
{
  const auto out = m_folder / "figures";
  std::filesystem::create_directories(out);
  std::ofstream(out / "broken.json") << "{}";
  const auto outcome = run("bench distance --quick --out " + quoted(out));
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_NE(outcome.err.find("petrous-plots"), std::string::npos) << outcome.err;
  EXPECT_NE(outcome.err.find(out.string()), std::string::npos) << outcome.err;
  EXPECT_TRUE(std::filesystem::exists(out / "distance.json"));
  expectPlots(out, {"distance.svg"});
}

TEST_F(BenchCommand, NamesTheBenchmarksThatThereAre)
{
  const auto outcome = run("bench speed --out " + quoted(m_folder));
  EXPECT_EQ(outcome.code, 2);
  EXPECT_NE(outcome.err.find("renderer"), std::string::npos) << outcome.err;
}
