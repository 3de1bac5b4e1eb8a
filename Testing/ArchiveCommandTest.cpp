#include "CommandRunner.h"

using namespace petrous::testing;

namespace
{

// A drilled sample patient, and a second library.
class ArchiveCommand : public CommandLine
{
protected:
  void SetUp() override
  {
    CommandLine::SetUp();
    makePatient();
    const auto patient = m_folder / "patient";
    json("new ear --ct " + quoted(patient / "ct") + " --mr T2=" + quoted(patient / "mr") +
         " --labels " + quoted(patient / "labels.seg.nrrd"));
    json("appearance ear --iso 345.25");
  }

  std::string file() const { return quoted(m_folder / "ear.petrous"); }
  std::string other() const { return " --library " + quoted(m_folder / "other"); }
};

} // namespace

TEST_F(ArchiveCommand, HandsACaseToAnotherLibrary)
{
  const auto written = json("archive ear " + file());
  EXPECT_EQ(written["parts"], 3);
  EXPECT_EQ(written["bytes"], std::filesystem::file_size(m_folder / "ear.petrous"));
  EXPECT_LT(written["bytes"], written["input_bytes"]);
  EXPECT_EQ(written["plan_only"], false);
  const auto restored = json("restore " + file() + other());
  EXPECT_EQ(restored["case"], "ear");
  EXPECT_EQ(restored["new_parts"], 3);
  EXPECT_EQ(json("library verify" + other())["damaged"].size(), 0U);
  auto here = json("info ear");
  auto there = json("info ear" + other());
  EXPECT_EQ(here, there);
  const std::string view = "render ear --size 120x90 --out ";
  json(view + quoted(m_folder / "here.png"));
  json(view + quoted(m_folder / "there.png") + other());
  EXPECT_EQ(textOf(m_folder / "here.png"), textOf(m_folder / "there.png"));

  EXPECT_EQ(run("restore " + file() + other()).code, 4) << "the name is taken";
  EXPECT_EQ(json("restore " + file() + " --as again" + other())["new_parts"], 0);
}

TEST_F(ArchiveCommand, HandsOnAPlanWithoutVoxels)
{
  const auto whole = json("archive ear " + file());
  const auto plan = json("archive ear --plan-only " + quoted(m_folder / "plan.petrous"));
  EXPECT_EQ(plan["plan_only"], true);
  EXPECT_LT(plan["bytes"].get<double>(), 0.1 * whole["bytes"].get<double>());
  const std::string restore = "restore " + quoted(m_folder / "plan.petrous") + other();
  EXPECT_EQ(run(restore).code, 3) << "no such CT there";
  json("new own --ct " + quoted(m_folder / "patient" / "ct") + other());
  json("new cropped --roi -60,-40,-10,10,-10,10 --ct " + quoted(m_folder / "patient" / "ct") +
       other());
  EXPECT_EQ(run(restore + " --ct cropped").code, 3) << "another CT";
  EXPECT_EQ(run(restore + " --ct nobody").code, 3);
  const auto restored = json(restore + " --ct own");
  EXPECT_EQ(restored["notes"].size(), 3U) << "the MR and the structures stay behind";
  EXPECT_NE(restored["notes"].dump().find("cannot be told"), std::string::npos)
      << "whose plan it is: another library hashes otherwise";
  EXPECT_EQ(json("info ear" + other())["ct"], json("info ear")["ct"]);
  EXPECT_EQ(run("restore " + file() + " --as x --ct own" + other()).code, 3)
      << "a whole archive brings its own CT";
}

TEST_F(ArchiveCommand, SaysBeforeWhatOfTheCaseLeaves)
{
  json("describe ear --note 'seen on ward 7' --date 2026-03-31");
  const auto has = [](const nlohmann::json& lines, const std::string& text)
  {
    return std::any_of(lines.begin(), lines.end(),
                       [&](const nlohmann::json& line)
                       { return line.get<std::string>().find(text) != std::string::npos; });
  };
  const auto whole = json("archive ear --dry-run " + file());
  EXPECT_FALSE(std::filesystem::exists(m_folder / "ear.petrous"));
  EXPECT_TRUE(has(whole["leaves"], "voxels") && has(whole["leaves"], "note"));
  EXPECT_TRUE(has(whole["may_identify"], "note"));
  EXPECT_TRUE(has(whole["stays"], "planned date"));
  const auto plan =
      json("archive ear --dry-run --plan-only --without-notes --keep-identity " + file());
  EXPECT_FALSE(has(plan["leaves"], "voxels"));
  EXPECT_TRUE(has(plan["leaves"], "'ear'") && has(plan["leaves"], "planned date"));
  EXPECT_TRUE(has(plan["stays"], "note") && has(plan["stays"], "same CT"));
  EXPECT_TRUE(has(plan["may_identify"], "planned date"));
}

TEST_F(ArchiveCommand, WarnsOfWhatMayIdentifyBeforeItWrites)
{
  json("describe ear --tag 'mrn 4711471'");
  const auto quiet = run("archive ear " + file());
  EXPECT_EQ(quiet.code, 0) << quiet.err;
  EXPECT_NE(quiet.err.find("tags: 1 of 1 may be"), std::string::npos) << quiet.err;
  EXPECT_NE(quiet.err.find("tags, which may be a patient's: 'mrn 4711471'"), std::string::npos)
      << quiet.err;
  EXPECT_EQ(quiet.err.find("whole head"), std::string::npos) << "64 mm";

  makeSample(m_folder / "wide", "--dims 80,80,20 --spacing 2.0");
  json("new wide --ct " + quoted(m_folder / "wide/ct"));
  for (const std::string& line : {"archive wide " + quoted(m_folder / "wide.petrous"),
                                  "export wide --what ct --out " + quoted(m_folder / "wide.nrrd"),
                                  "export wide --what ct --out " + quoted(m_folder / "dicom/")})
  {
    const auto outcome = run(line);
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    EXPECT_NE(outcome.err.find("whole head"), std::string::npos) << line << outcome.err;
    EXPECT_NE(outcome.err.find("its face was left"), std::string::npos) << line << outcome.err;
    EXPECT_NE(outcome.err.find("--mask-face"), std::string::npos) << line << outcome.err;
    EXPECT_NE(outcome.err.find("--roi"), std::string::npos) << line << outcome.err;
  }
}

TEST_F(ArchiveCommand, RefusesWhatItCannotDo)
{
  EXPECT_EQ(run("archive nobody " + file()).code, 3);
  EXPECT_EQ(run("archive ear " + quoted(m_folder / "no" / "such" / "ear.petrous")).code, 4);
  EXPECT_EQ(run("archive ear").code, 2);
  EXPECT_EQ(run("archive ear " + file() + " --level 20").code, 2);
  EXPECT_EQ(run("archive ear " + quoted(library() / "cases" / "ear.json")).code, 4);
  EXPECT_EQ(run("restore " + file()).code, 3);
  std::ofstream(m_folder / "ear.petrous") << "no zip file";
  EXPECT_EQ(run("restore " + file() + " --as b").code, 3);
  EXPECT_EQ(run("restore " + quoted(m_folder) + " --as b").code, 3);
  EXPECT_EQ(json("library list")["cases"].size(), 1U);
}
