#include <cstdlib>
#include <filesystem>
#include <fstream>

#include "CommandRunner.h"

namespace fs = std::filesystem;

using petrous::testing::quoted;

namespace
{

class DeviceTestCommand : public petrous::testing::CommandLine
{
protected:
  void SetUp() override
  {
    CommandLine::SetUp();
    fs::create_directories(servers());
    ::setenv("PETROUS_DEVICE_SERVERS", servers().c_str(), 1);
    ::setenv("XDG_CONFIG_HOME", (m_folder / "config").c_str(), 1);
  }
  void TearDown() override
  {
    ::unsetenv("PETROUS_DEVICE_SERVERS");
    ::unsetenv("XDG_CONFIG_HOME");
    CommandLine::TearDown();
  }

  fs::path servers() const { return m_folder / "devices"; }

  // A server whose handle goes by `compliance` mm for each newton, at once.
  void install(const std::string& name, const std::string& options) const
  {
    const fs::path program = servers() / name;
    std::ofstream(program) << "#!/bin/sh\nexec " << quoted(PETROUS_EXAMPLE_SERVER) << ' ' << options
                           << " \"$@\"\n";
    fs::permissions(program, fs::perms::owner_all);
  }
};

} // namespace

// Its handle is at x = C F: under F = -k x the loop's gain is k C, and it oscillates beyond 1.
TEST_F(DeviceTestCommand, StopsAtTheLimitCycleAndKeepsHalfOfWhatWasStable)
{
  install("spring", "--radius 0 --compliance 7.1"); // 0.141 N/mm, between two steps of the ramp
  const auto answer = json("device-test --workspace 0.5 --keep");
  EXPECT_EQ(answer["device"], "Petrous example device");
  EXPECT_TRUE(answer["problem"].is_null());
  ASSERT_EQ(answer["axes"].size(), 3U);
  for (std::size_t i = 0; i < 3; ++i)
  {
    const auto& axis = answer["axes"][i];
    EXPECT_EQ(axis["axis"], std::string(1, "xyz"[i]));
    EXPECT_TRUE(axis["follows"]);
    EXPECT_NEAR(axis["step_moved_mm"][i].get<double>(), 0.5 * 7.1, 1e-6);
    EXPECT_NEAR(axis["stable_n_per_mm"].get<double>(), 0.1 * 1.15 * 1.15, 1e-9);
    EXPECT_NEAR(axis["limit_n_per_mm"].get<double>(), 0.1 * 1.15 * 1.15 * 1.15, 1e-9);
  }
  EXPECT_NEAR(answer["proposed_stiffness_n_per_mm"].get<double>(), 0.066125, 1e-9);
  EXPECT_GT(answer["round_trip_ms"]["p50"].get<double>(), 0.0);
  EXPECT_GT(answer["rate_hz"].get<double>(), 0.0);
  EXPECT_TRUE(answer["kept"]);
  const auto kept = nlohmann::json::parse(
      petrous::testing::textOf(m_folder / "config/petrous/device-limits.json"));
  EXPECT_NEAR(kept["spring"]["Petrous example device"]["max_stiffness_n_per_mm"].get<double>(),
              0.066125, 1e-9);
}

TEST_F(DeviceTestCommand, DrivesNoSpringAgainstTheHandAndKeepsNothing)
{
  install("wrong", "--radius 0 --compliance -5");
  const auto outcome = run("device-test --workspace 0.5 --keep");
  EXPECT_EQ(outcome.code, 3);
  EXPECT_NE(outcome.err.find("against the force along x"), std::string::npos) << outcome.err;
  EXPECT_EQ(outcome.out.find("stable"), std::string::npos) << outcome.out;
  EXPECT_FALSE(fs::exists(m_folder / "config/petrous/device-limits.json"));
}

TEST_F(DeviceTestCommand, WithoutForceMeasuresTheWorkspace)
{
  install("circle", "--radius 30 --period 0.4");
  const auto answer = json("device-test circle --workspace 0.6 --no-force");
  EXPECT_NEAR(answer["workspace_mm"]["min"][0].get<double>(), -30.0, 2.0);
  EXPECT_NEAR(answer["workspace_mm"]["max"][1].get<double>(), 30.0, 2.0);
  EXPECT_TRUE(answer["axes"].empty());
  EXPECT_TRUE(answer["proposed_stiffness_n_per_mm"].is_null());
  EXPECT_FALSE(answer["kept"]);
}

TEST_F(DeviceTestCommand, NamesWhatIsInstalled)
{
  expectRefused("device-test", 3, "no device server is installed");
  install("one", "");
  install("two", "");
  expectRefused("device-test", 2, "one, two");
  expectRefused("device-test three", 3, "'three' is installed; there are: one, two");
  expectRefused("device-test one --max-stiffness 50", 2, "--max-stiffness");
  expectRefused("device-test --server /nowhere/program", 3, "/nowhere/program");
}
