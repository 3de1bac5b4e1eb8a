#include <csignal>
#include <fstream>

#include <gtest/gtest.h>

#include <fcntl.h>
#include <sys/file.h>
#include <sys/wait.h>
#include <unistd.h>

#include "TestCase.h"
#include "petrous/Library/OpenMark.h"

using namespace petrous;
using namespace petrous::library;
using test::TemporaryFolder;

namespace
{

/// Another process that has a case open until it is killed.
class OtherProcess
{
public:
  OtherProcess(const std::filesystem::path& library, const std::string& id)
  {
    int ready[2];
    if (::pipe(ready) != 0)
      throw std::runtime_error("pipe");
    m_process = ::fork();
    if (m_process == 0)
    {
      const OpenMark mark(library, id);
      [[maybe_unused]] const ssize_t told = ::write(ready[1], "x", 1);
      for (;;)
        ::pause();
    }
    char byte = 0;
    [[maybe_unused]] const ssize_t got = ::read(ready[0], &byte, 1);
    ::close(ready[0]);
    ::close(ready[1]);
  }
  ~OtherProcess() { kill(); }
  OtherProcess(const OtherProcess&) = delete;
  OtherProcess& operator=(const OtherProcess&) = delete;

  pid_t process() const { return m_process; }
  void kill()
  {
    if (m_process <= 0)
      return;
    ::kill(m_process, SIGKILL);
    ::waitpid(m_process, nullptr, 0);
    m_process = 0;
  }

private:
  pid_t m_process = 0;
};

std::size_t marksIn(const std::filesystem::path& library)
{
  std::error_code error;
  std::size_t count = 0;
  for (std::filesystem::directory_iterator entry(library / "open", error), end; entry != end;
       entry.increment(error))
    ++count;
  return count;
}

} // namespace

TEST(OpenMark, TellsOfOtherProcessesUntilTheyEndHoweverTheyEnd)
{
  const TemporaryFolder folder;
  EXPECT_TRUE(openersOf(folder.path(), "abc").empty());
  {
    const OpenMark own(folder.path(), "abc");
    EXPECT_TRUE(openersOf(folder.path(), "abc").empty()) << "one's own";
    OtherProcess other(folder.path(), "abc");
    OtherProcess second(folder.path(), "abc");
    OtherProcess elsewhere(folder.path(), "abd");
    const std::vector<Opener> openers = openersOf(folder.path(), "abc");
    ASSERT_EQ(openers.size(), 2U);
    EXPECT_TRUE(openers[0].process == other.process() || openers[1].process == other.process());
    char computer[256] = {};
    ::gethostname(computer, sizeof computer - 1);
    EXPECT_EQ(openers[0].computer, computer);
    EXPECT_EQ(marksIn(folder.path()), 4U);
    second.kill();
    EXPECT_EQ(toString(openersOf(folder.path(), "abc")),
              "process " + std::to_string(other.process()) + " on '" + computer + "'");
    other.kill();
    EXPECT_TRUE(openersOf(folder.path(), "abc").empty());
    EXPECT_EQ(openersOf(folder.path(), "abd").size(), 1U);
    EXPECT_EQ(marksIn(folder.path()), 2U) << "those of killed ones are removed";
  }
  EXPECT_EQ(marksIn(folder.path()), 1U);
  removeStaleMarks(folder.path());
  EXPECT_EQ(marksIn(folder.path()), 0U);
}

// Whatever a file is that lies there, and where nothing can be written.
TEST(OpenMark, NeverStandsInTheWay)
{
  const TemporaryFolder folder;
  const OpenMark none(folder.path() / "no such folder", "abc");
  EXPECT_TRUE(openersOf(folder.path() / "no such folder", "abc").empty());
  std::filesystem::create_directory(folder.path() / "open");
  std::ofstream(folder.path() / "open/abc.broken") << "{ no JSON";
  std::filesystem::create_directory(folder.path() / "open/abc.folder");
  EXPECT_TRUE(openersOf(folder.path(), "abc").empty());
  removeStaleMarks(folder.path());
  EXPECT_TRUE(std::filesystem::exists(folder.path() / "open/abc.broken")) << "it is no mark";
  const OpenMark unsaved(folder.path(), "");
  EXPECT_TRUE(openersOf(folder.path(), "").empty());
}

// LIBRARY/open may be a folder of the user's: any folder can be named as library.
TEST(OpenMark, OnlyWhatHasAMarksNameAndTextIsOne)
{
  const TemporaryFolder folder;
  std::filesystem::create_directory(folder.path() / "open");
  const auto write = [&folder](const std::string& name, const std::string& text)
  { std::ofstream(folder.path() / "open" / name) << text; };
  const std::string mark = R"({"computer":"no such computer","process":4711})";
  const std::string end = ".petrous-0123456789abcdef";
  const std::vector<std::pair<std::string, std::string>> others{
      {"notes.json", "{}"},
      {"scan.json", mark},
      {"empty", ""},
      {"abc.petrous-0123", ""},
      {"abc" + end + "0", mark},
      {"abc.petrous-0123456789abcdeF", mark},
      {end, mark},
      {"abc" + end + ".txt", mark},
      {"abc" + end, "{}"},
      {"abd" + end, R"({"process":"4711"})"},
      {"abe" + end, "[4711]"},
  };
  for (const auto& [name, text] : others)
    write(name, text);
  write("left" + end, mark);
  write("unwritten" + end, "");
  for (const char* id : {"abc", "abd", "abe", "notes", "scan", "empty"})
    EXPECT_TRUE(openersOf(folder.path(), id).empty()) << id;
  removeStaleMarks(folder.path());
  for (const auto& [name, text] : others)
    EXPECT_TRUE(std::filesystem::exists(folder.path() / "open" / name)) << name;
  EXPECT_FALSE(std::filesystem::exists(folder.path() / ("open/left" + end)));
  EXPECT_FALSE(std::filesystem::exists(folder.path() / ("open/unwritten" + end)));
}

// As on a network drive whose locks keep others from reading: nobody can be named.
TEST(OpenMark, AMarkThatCannotBeReadNamesNobody)
{
  const TemporaryFolder folder;
  std::filesystem::create_directory(folder.path() / "open");
  const std::filesystem::path path = folder.path() / "open/abc.petrous-0123456789abcdef";
  const int descriptor = ::open(path.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666);
  ASSERT_GE(descriptor, 0);
  ASSERT_EQ(::flock(descriptor, LOCK_EX | LOCK_NB), 0);
  EXPECT_EQ(toString(openersOf(folder.path(), "abc")), "");
  removeStaleMarks(folder.path());
  EXPECT_TRUE(std::filesystem::exists(path)) << "somebody has it";
  ::close(descriptor);
  removeStaleMarks(folder.path());
  EXPECT_FALSE(std::filesystem::exists(path));
}

TEST(OpenMark, WhoSavesRenamesOrDeletesIsToldOnceHeAsks)
{
  const TemporaryFolder folder;
  Library library(folder.path());
  std::vector<std::string> notices;
  library.onNotice([&notices](const std::string& words) { notices.push_back(words); });
  scene::Case value = test::savedCase(library);
  const OtherProcess window(folder.path(), value.id);
  library.save(value);
  EXPECT_TRUE(notices.empty());
  library.noticeOpeners();
  const auto expectTold = [&](const std::string& name, const std::string& advice)
  {
    ASSERT_EQ(notices.size(), 1U);
    EXPECT_EQ(notices[0].rfind("case '" + name + "' is open in Petrous elsewhere (process " +
                                   std::to_string(window.process()),
                               0),
              0U)
        << notices[0];
    EXPECT_NE(notices[0].find(advice), std::string::npos) << notices[0];
    notices.clear();
  };
  library.save(value);
  expectTold("ear", "open it there again");
  library.rename("ear", "left");
  expectTold("left", "is saved under this name");
  library.copy("left", "another");
  EXPECT_TRUE(notices.empty());
  library.remove("left");
  expectTold("left", "cannot be saved unless the case is brought back");
}

// An object that the library needs no longer can be put back by who has the case open.
TEST(OpenMark, NothingIsCleanedUpWhileACaseIsOpenElsewhere)
{
  const TemporaryFolder folder;
  Library library(folder.path());
  const scene::Case value = test::savedCase(library);
  library.remove("ear");
  OtherProcess window(folder.path(), value.id);
  try
  {
    library.collectGarbage();
    FAIL();
  }
  catch (const LibraryError& error)
  {
    EXPECT_EQ(error.reason, LibraryError::Reason::Conflict);
    EXPECT_NE(std::string(error.what()).find("process " + std::to_string(window.process())),
              std::string::npos)
        << error.what();
  }
  library.undelete("ear");
  EXPECT_TRUE(library.lost(library.open("ear")).empty());
  library.remove("ear");
  window.kill();
  const OpenMark own(folder.path(), value.id);
  EXPECT_EQ(library.collectGarbage().cases, 1U);
}
