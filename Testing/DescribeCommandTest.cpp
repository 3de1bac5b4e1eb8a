#include "CommandRunner.h"

using Json = nlohmann::json;
using petrous::testing::CommandLine;
using petrous::testing::textOf;

namespace
{

class DescribeCommand : public CommandLine
{
protected:
  void SetUp() override
  {
    CommandLine::SetUp();
    makeSample(m_folder / "s", "--dims 32,32,32 --spacing 1.5");
    ASSERT_EQ(run("new ear --ct " + (m_folder / "s/ct").string()).code, 0);
  }

  std::vector<std::string> found(const std::string& arguments) const
  {
    std::vector<std::string> names;
    const Json answer = json(arguments);
    for (const Json& one : answer.at("cases"))
      names.push_back(one.at("name"));
    return names;
  }
};

} // namespace

TEST_F(DescribeCommand, KeepsWhatIsSaidOfACase)
{
  std::ofstream(m_folder / "note.txt") << "\xef\xbb\xbfline one\r\nline \"two\" ü\n";
  const Json done = json("describe ear --note-file " + (m_folder / "note.txt").string() +
                         " --tag teaching --tag 'second ear' --tag TEACHING --diagnosis "
                         "'Cholesteatoma, attic' --procedure mastoidectomy --side left --date "
                         "2026-03-31");
  const Json expected = {{"note", "line one\nline \"two\" ü\n"},
                         {"tags", {"teaching", "second ear"}},
                         {"diagnosis", "Cholesteatoma, attic"},
                         {"procedure", "mastoidectomy"},
                         {"side", "left"},
                         {"date", "2026-03-31"}};
  EXPECT_EQ(done.at("description"), expected);
  EXPECT_TRUE(done.at("changed"));
  EXPECT_FALSE(done.at("thumbnail"));
  EXPECT_EQ(json("info ear").at("description"), expected);
  EXPECT_FALSE(json("describe ear").at("changed"));

  const Json cleared = json("describe ear --clear note,date --remove-tag teaching --side unknown");
  EXPECT_EQ(cleared.at("description").at("note"), "");
  EXPECT_TRUE(cleared.at("description").at("date").is_null());
  EXPECT_EQ(cleared.at("description").at("tags"), Json({"second ear"}));
  EXPECT_EQ(cleared.at("description").at("side"), "unknown");
  EXPECT_EQ(cleared.at("description").at("procedure"), "mastoidectomy");
}

// All of the image lies left of the scanner's middle, x = 0.
TEST_F(DescribeCommand, DoubtsASideThatTheImageContradicts)
{
  std::ofstream image(m_folder / "left.nrrd", std::ios::binary);
  image << "NRRD0004\ntype: short\ndimension: 3\nspace: left-posterior-superior\nsizes: 8 8 8\n"
           "space directions: (1,0,0) (0,1,0) (0,0,1)\nspace origin: (20,0,0)\nencoding: raw\n"
           "endian: little\n\n"
        << std::string(512, '\x04') << std::string(512, '\x05');
  image.close();
  ASSERT_EQ(run("new left --modality CT --ct " + (m_folder / "left.nrrd").string()).code, 0);
  const auto doubts = [this](const std::string& arguments)
  {
    const auto outcome = run(arguments);
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    return outcome.err.find("lies on the patient's left, 20.0 to 27.0 mm") != std::string::npos;
  };
  EXPECT_TRUE(doubts("describe left --side right"));
  EXPECT_FALSE(doubts("describe left --tag a")) << "nothing was said of the side";
  EXPECT_FALSE(doubts("describe left --side left"));
  EXPECT_FALSE(doubts("view left --view surgical-left"));
  EXPECT_FALSE(doubts("describe left --side unknown"));
  EXPECT_TRUE(doubts("view left --view surgical-right"));
  EXPECT_FALSE(doubts("view left --view lateral"));
}

TEST_F(DescribeCommand, FindsCasesByIt)
{
  ASSERT_EQ(run("library copy ear other").code, 0);
  ASSERT_EQ(run("describe ear --tag teaching --side left --date 2026-03-31 --note 'high bulb' "
                "--diagnosis Cholesteatoma")
                .code,
            0);
  using Names = std::vector<std::string>;
  EXPECT_EQ(found("library list"), (Names{"ear", "other"}));
  EXPECT_EQ(found("library list --tag Teaching"), Names{"ear"});
  EXPECT_EQ(found("library list --side unknown"), Names{"other"});
  EXPECT_EQ(found("library search --from 2026-03-01 --to 2026-03-31"), Names{"ear"});
  EXPECT_EQ(found("library search --from 2026-04-01"), Names{});
  EXPECT_EQ(found("library search cholest --side left"), Names{"ear"});
  EXPECT_EQ(found("library search bulb"), Names{});
  EXPECT_EQ(found("library search bulb --notes"), Names{"ear"});
}

TEST_F(DescribeCommand, RefusesWhatIsWrong)
{
  EXPECT_EQ(run("describe ear --side up").code, 2);
  EXPECT_EQ(run("describe ear --date 2026-02-29").code, 2);
  EXPECT_EQ(run("describe ear --note a --note-file b").code, 2);
  EXPECT_EQ(run("describe ear --diagnosis ''").code, 2);
  EXPECT_EQ(run("describe ear --clear name").code, 2);
  EXPECT_EQ(run("library list --from 2026-04-01 --to 2026-03-31").code, 2);
  EXPECT_EQ(run("library list --to soon").code, 2);
  EXPECT_EQ(run("library verify --tag a").code, 2);
  EXPECT_EQ(run("library list --notes").code, 2);
  EXPECT_EQ(run("library search").code, 2);
  EXPECT_EQ(run("describe nose --tag a").code, 3);
  EXPECT_EQ(run("describe ear --remove-tag a").code, 3);
  EXPECT_EQ(run("describe ear --note-file /nowhere").code, 3);
  EXPECT_EQ(run("describe ear --tag " + std::string(65, 't')).code, 3);
  EXPECT_EQ(run("describe ear --note $(printf 'a\\033[2Jb')").code, 3);
  EXPECT_EQ(json("describe ear").at("description").at("tags"), Json::array());
}

TEST_F(DescribeCommand, ArchivesTakeItAlongButForTheDate)
{
  ASSERT_EQ(run("describe ear --tag a --note 'of the ear' --date 2026-03-31").code, 0);
  const auto restored = [&](const std::string& options, const std::string& name)
  {
    const std::string file = (m_folder / (name + ".petrous")).string();
    EXPECT_EQ(run("archive ear " + file + " " + options).code, 0);
    EXPECT_EQ(run("restore " + file + " --as " + name).code, 0);
    return json("describe " + name).at("description");
  };
  const Json usual = restored("", "usual");
  EXPECT_EQ(usual.at("note"), "of the ear");
  EXPECT_TRUE(usual.at("date").is_null());
  EXPECT_EQ(restored("--keep-identity", "dated").at("date"), "2026-03-31");
  EXPECT_EQ(restored("--without-notes", "quiet").at("note"), "");
  EXPECT_EQ(restored("--plan-only", "plan").at("note"), "of the ear");
}

TEST_F(DescribeCommand, DrawsAThumbnail)
{
  const auto manifest = [this] { return textOf(library() / "cases" / "ear.json"); };
  const std::string before = manifest();
  EXPECT_TRUE(json("describe ear --thumbnail").at("thumbnail"));
  EXPECT_EQ(manifest(), before);
  EXPECT_TRUE(json("library list").at("cases").at(0).at("thumbnail"));
  EXPECT_EQ(run("library verify").code, 0);
  const std::string file = (m_folder / "ear.petrous").string();
  ASSERT_EQ(run("archive ear " + file).code, 0);
  ASSERT_EQ(run("restore " + file + " --as again").code, 0);
  EXPECT_TRUE(json("describe again").at("thumbnail"));
}

// What is done is done: the exit code and a line tell that only its answer is lost.
TEST_F(DescribeCommand, SaysThatItIsDoneWhereTheAnswerCannotBeWritten)
{
  for (const std::string lost : {">/dev/full", ">&-"})
  {
    const std::string tag = lost == ">&-" ? "closed" : "full";
    const auto lines = m_folder / "lines.txt";
    const auto outcome =
        run("describe ear --tag " + tag + " --json " + lost + " 2>" + lines.string() + "; echo $?");
    EXPECT_EQ(outcome.out, "1\n") << lost;
    EXPECT_NE(textOf(lines).find("it is done"), std::string::npos) << textOf(lines);
    const Json tags = json("describe ear").at("description").at("tags");
    EXPECT_NE(std::find(tags.begin(), tags.end(), tag), tags.end()) << lost;
  }
  EXPECT_EQ(run("library verify").code, 0);
}
