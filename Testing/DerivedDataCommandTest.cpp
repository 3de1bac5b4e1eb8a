// Data cached between commands change no answer, and are rebuilt when missing or damaged.

#include "CommandRunner.h"

using namespace petrous::testing;
namespace fs = std::filesystem;

namespace
{

class DerivedDataCommand : public CommandLine
{
protected:
  void SetUp() override
  {
    CommandLine::SetUp();
    makePatient();
    const fs::path patient = m_folder / "patient";
    ASSERT_EQ(run("new ear --ct " + quoted(patient / "ct") + " --labels " +
                  quoted(patient / "labels.seg.nrrd"))
                  .code,
              0);
    std::ofstream points(m_folder / "points.csv");
    points << "x_mm,y_mm,z_mm\n";
    const auto centre = json("info ear")["ct"]["origin_mm"];
    for (int n = 0; n < 10; ++n)
      points << centre[0].get<double>() + 25.0 + n << ',' << centre[1].get<double>() + 30.0 << ','
             << centre[2].get<double>() + 22.0 + 1.7 * n << '\n';
  }

  std::string probed() const
  {
    const Outcome outcome = run("probe ear --points " + quoted(m_folder / "points.csv"));
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    return outcome.out;
  }

  std::vector<fs::path> kept() const
  {
    std::vector<fs::path> files;
    for (const auto& entry : fs::directory_iterator(library() / "derived"))
      files.push_back(entry.path());
    return files;
  }
};

} // namespace

TEST_F(DerivedDataCommand, ProbesTheSameWhetherSomethingIsKeptOrNot)
{
  const std::string regional = probed(); // only the region needed for the points
  ASSERT_NE(regional.find('\n'), std::string::npos);
  // Drilling builds all of it and stores it for the next command.
  const auto path = writePath({-50, 0, 0}, {-48, 0, 0});
  ASSERT_EQ(run("drill ear --path " + quoted(path)).code, 0);
  ASSERT_EQ(run("undo ear 9").code, 0);
  EXPECT_FALSE(kept().empty());
  EXPECT_GT(json("info ear")["resources"]["disk.derived"].get<double>(), 1000.0);
  EXPECT_EQ(probed(), regional);
  for (const fs::path& file : kept())
  {
    std::fstream stream(file, std::ios::in | std::ios::out | std::ios::binary);
    stream.seekp(static_cast<std::streamoff>(fs::file_size(file) / 2));
    stream.put('x');
    stream.put('y');
  }
  EXPECT_EQ(probed(), regional) << "what is damaged is made again";
  EXPECT_GT(json("library gc")["derived_bytes"].get<double>(), 1000.0);
  EXPECT_TRUE(kept().empty());
  EXPECT_FALSE(json("info ear")["resources"].contains("disk.derived"));
  EXPECT_EQ(probed(), regional);
}

TEST_F(DerivedDataCommand, DrillsTheSameWhetherSomethingIsKeptOrNot)
{
  std::string flags;
  const auto info = json("info ear");
  for (const auto& label : info["labels"])
    flags += " --flags " + label["name"].get<std::string>() + "=none";
  ASSERT_EQ(run("appearance ear" + flags).code, 0);
  const auto path = writePath({-50, 0, 0}, {-40, 1, 2});
  const auto drill = [&]
  {
    auto answer = json("drill ear --path " + quoted(path));
    EXPECT_EQ(json("undo ear 9")["steps"], answer["strokes"]);
    for (const char* name : {"tick_us", "tick_wall_us", "resources"})
      answer.erase(name);
    return answer.dump();
  };
  const std::string first = drill();
  EXPECT_EQ(drill(), first);
  ASSERT_EQ(run("library gc").code, 0);
  EXPECT_EQ(drill(), first);
}
