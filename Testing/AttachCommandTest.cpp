#include "CommandRunner.h"

using Json = nlohmann::json;
using petrous::testing::CommandLine;
using petrous::testing::quoted;
using petrous::testing::textOf;

namespace
{

const std::string kVideo = std::string("\0\0\0\x18", 4) + "ftypmp42 of the theatre";

class AttachCommand : public CommandLine
{
protected:
  void SetUp() override
  {
    CommandLine::SetUp();
    makeSample(m_folder / "s", "--dims 32,32,32 --spacing 1.5");
    ASSERT_EQ(run("new ear --ct " + (m_folder / "s/ct").string()).code, 0);
  }

  std::string file(const std::string& name, const std::string& bytes) const
  {
    std::ofstream(m_folder / name, std::ios::binary) << bytes;
    return quoted(m_folder / name);
  }
};

} // namespace

TEST_F(AttachCommand, KeepsListsExtractsAndRemoves)
{
  const Json done = json("attach ear " + file("film.mp4", kVideo) +
                         " --name film.mp4 --note 'of the operation' --date 2026-03-31");
  EXPECT_EQ(done.at("attachment").at("kind"), "video");
  EXPECT_EQ(done.at("attachment").at("bytes"), kVideo.size());
  json("attach ear " + file("plan.pdf", "%PDF-1.7") + " --link --name 'the plan.pdf'");
  const Json listed = json("attachments ear").at("attachments");
  ASSERT_EQ(listed.size(), 2U);
  EXPECT_EQ(listed[0].at("name"), "film.mp4");
  EXPECT_EQ(listed[0].at("note"), "of the operation");
  EXPECT_EQ(listed[0].at("date"), "2026-03-31");
  EXPECT_TRUE(listed[0].at("link").is_null());
  EXPECT_TRUE(listed[0].at("stroke").is_null());
  EXPECT_EQ(listed[1].at("name"), "the plan.pdf");
  EXPECT_EQ(listed[1].at("link"), (std::filesystem::canonical(m_folder) / "plan.pdf").string());
  EXPECT_EQ(listed[1].at("state"), "ok");

  EXPECT_EQ(run("attachments ear --extract film.mp4 " + quoted(m_folder / "out")).code, 0);
  EXPECT_EQ(textOf(m_folder / "out"), kVideo);
  file("plan.pdf", "%PDF-9.9");
  expectRefused("attachments ear --extract 'THE plan.pdf' " + quoted(m_folder / "none"), 3,
                "another one than was attached");
  EXPECT_FALSE(std::filesystem::exists(m_folder / "none"));
  std::filesystem::remove(m_folder / "plan.pdf");
  EXPECT_EQ(json("attachments ear").at("attachments")[1].at("state"), "missing");
  EXPECT_EQ(run("info ear").code, 0);
  EXPECT_EQ(run("library verify").code, 0);

  EXPECT_EQ(json("attachments ear --remove film.mp4").at("removed"), "film.mp4");
  EXPECT_EQ(json("attachments ear").at("attachments").size(), 1U);
  EXPECT_EQ(json("library gc").at("removed"), 1);
}

TEST_F(AttachCommand, NamesByKindWhatHasNoNameGiven)
{
  const auto outcome = run("attach ear " + file("DOE_JOHN_19310517.pdf", "%PDF-1.7"));
  EXPECT_EQ(outcome.code, 0);
  EXPECT_NE(outcome.err.find("'document.pdf'"), std::string::npos) << outcome.err;
  EXPECT_EQ(json("attachments ear").at("attachments")[0].at("name"), "document.pdf");
  // A name that is given leaves, and is looked at before.
  json("attach ear --name DOE_19310517.png " + file("a.ticks", "PTRTICK\n"));
  const auto dry = json("archive ear --dry-run " + quoted(m_folder / "ear.petrous"));
  EXPECT_NE(dry.at("may_identify").dump().find("names and notes of attachments: 1 of"),
            std::string::npos)
      << dry;
}

TEST_F(AttachCommand, RefusesInOneLine)
{
  const std::string film = file("film.mp4", kVideo);
  expectRefused("attach ear /dev/zero", 3, "/dev/zero");
  expectRefused("attach ear /nowhere.pdf", 3, "/nowhere.pdf");
  expectRefused("attach ear " + quoted(m_folder), 3, "");
  expectRefused("attach ear " + file("text.txt", "text"), 3, "nothing that a case takes");
  expectRefused("attach ear " + film + " --name ../film.mp4", 3, "name of an attachment");
  expectRefused("attach ear " + film + " --stroke 1", 3, "0 strokes");
  expectRefused("attach nose " + film, 3, "nose");
  expectRefused("attachments ear --remove film.mp4", 3, "has no attachment 'film.mp4'");
  EXPECT_EQ(run("attach ear " + film + " --date soon").code, 2);
  EXPECT_EQ(run("attach ear").code, 2);
  EXPECT_EQ(run("attachments ear --remove a --extract a b").code, 2);
  EXPECT_EQ(run("attachments ear --extract a").code, 2);
  EXPECT_EQ(json("attachments ear").at("attachments"), Json::array());
}

TEST_F(AttachCommand, ArchivesLeaveVideosAndDocumentsUnlessAsked)
{
  json("attach ear --name film.mp4 " + file("film.mp4", kVideo));
  json("attach ear --name plan.pdf " + file("plan.pdf", "%PDF-1.7 of the plan"));
  const auto restored = [&](const std::string& options, const std::string& name)
  {
    const std::string archive = quoted(m_folder / (name + ".petrous"));
    const auto outcome = run("archive ear " + archive + " " + options);
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    const auto stays = [&](const char* attached)
    { return outcome.err.find(std::string(attached) + "' stays") != std::string::npos; };
    EXPECT_EQ(stays("film.mp4"), options.find("videos") == std::string::npos) << outcome.err;
    EXPECT_EQ(stays("plan.pdf"), options.find("documents") == std::string::npos) << outcome.err;
    EXPECT_EQ(outcome.err.find("metadata is not removed") == std::string::npos, options.empty());
    json("restore " + archive + " --as " + name);
    return json("attachments " + name).at("attachments").size();
  };
  EXPECT_EQ(restored("", "usual"), 0U);
  EXPECT_EQ(restored("--with-documents", "documents"), 1U);
  EXPECT_EQ(restored("--with-documents --with-videos", "all"), 2U);
}

TEST_F(AttachCommand, WarnsOfALinkWhosePathMayNameThePatient)
{
  std::string letters = m_folder.filename().string(); // its numbers look like a record's
  for (char& c : letters)
    c = c >= '0' && c <= '9' ? static_cast<char>(c - '0' + 'a') : c;
  const auto folder = std::filesystem::temp_directory_path() / letters;
  std::filesystem::create_directories(folder);
  const auto linked = [&](const char* name)
  {
    std::ofstream(folder / name, std::ios::binary) << kVideo;
    const auto outcome = run("attach ear --link " + quoted(folder / name));
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    return outcome.err.find("path of the file") != std::string::npos;
  };
  EXPECT_TRUE(linked("Doe_John.mp4"));
  EXPECT_TRUE(linked("4711471.mp4"));
  EXPECT_FALSE(linked("film.mp4"));
  std::filesystem::remove_all(folder);
}
