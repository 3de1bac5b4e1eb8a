#include "petrous/Core/Log.h"

#include <csignal>
#include <cstdlib>
#include <fstream>
#include <regex>
#include <set>
#include <stdexcept>
#include <vector>

#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include "petrous/Core/Error.h"

using namespace petrous;
namespace fs = std::filesystem;
namespace plog = core::log;
using plog::Level;

namespace
{

class Log : public ::testing::Test
{
protected:
  void SetUp() override
  {
    std::string name = (fs::temp_directory_path() / "petrous-log-XXXXXX").string();
    ASSERT_NE(::mkdtemp(name.data()), nullptr);
    m_folder = name;
  }
  void TearDown() override
  {
    plog::start({{}, Level::Off, 1, 1, {}});
    ::unsetenv("PETROUS_LOG_LEVEL");
    fs::remove_all(m_folder);
  }

  plog::Setup setup(Level level = Level::Info)
  {
    plog::Setup result;
    result.file = m_folder / "state/petrous.log";
    result.level = level;
    result.warn = [this](const std::string& text) { m_warnings.push_back(text); };
    return result;
  }

  static std::vector<std::string> linesOf(const fs::path& path)
  {
    std::ifstream file(path);
    std::vector<std::string> lines;
    for (std::string line; std::getline(file, line);)
      lines.push_back(line);
    return lines;
  }
  std::vector<std::string> lines() const { return linesOf(m_folder / "state/petrous.log"); }

  // Runs `work` in a process of its own. Returns how it ended, as waitpid does.
  template <class Work>
  static int inChild(const Work& work)
  {
    const pid_t child = ::fork();
    if (child == 0)
    {
      work();
      ::_exit(0);
    }
    int status = -1;
    ::waitpid(child, &status, 0);
    return status;
  }

  fs::path m_folder;
  std::vector<std::string> m_warnings;
};

} // namespace

TEST_F(Log, WritesWhatItsLevelAdmits)
{
  const Level all[] = {Level::Trace,   Level::Debug, Level::Info,
                       Level::Warning, Level::Error, Level::Off};
  for (int chosen = 0; chosen < 6; ++chosen)
  {
    fs::remove_all(m_folder / "state");
    plog::start(setup(all[chosen]));
    for (int n = 0; n < 5; ++n)
      plog::write(all[n], "level " + std::to_string(n));
    const auto found = lines();
    ASSERT_EQ(found.size(), static_cast<std::size_t>(5 - chosen));
    for (int n = chosen; n < 5; ++n)
      EXPECT_NE(found[static_cast<std::size_t>(n - chosen)].find("level " + std::to_string(n)),
                std::string::npos);
  }
}

TEST_F(Log, MakesItsFileForTheOwnerAloneWhenSomethingIsLogged)
{
  plog::start(setup());
  plog::debug("below the level");
  EXPECT_FALSE(fs::exists(m_folder / "state"));
  plog::info("one {} %s");
  struct stat status = {};
  ASSERT_EQ(::stat((m_folder / "state/petrous.log").c_str(), &status), 0);
  EXPECT_EQ(status.st_mode & 0777, 0600U);
  ASSERT_EQ(::stat((m_folder / "state").c_str(), &status), 0);
  EXPECT_EQ(status.st_mode & 0777, 0700U);
  ASSERT_EQ(lines().size(), 1U);
  // Also under a decimal comma (DecimalComma.PetrousCoreTests).
  EXPECT_TRUE(std::regex_match(
      lines()[0],
      std::regex("\\d{4}-\\d\\d-\\d\\dT\\d\\d:\\d\\d:\\d\\d\\.\\d{3}[+-]\\d\\d:\\d\\d " +
                 std::to_string(::getpid()) + " info one \\{\\} %s")))
      << lines()[0];
}

TEST_F(Log, KeepsAnEventOnOneLine)
{
  plog::start(setup());
  plog::info("first\nsecond\r\x1b[31m");
  ASSERT_EQ(lines().size(), 1U);
  EXPECT_NE(lines()[0].find("first second  [31m"), std::string::npos);
}

TEST_F(Log, TakesTheLevelFromTheOptionThenTheEnvironment)
{
  EXPECT_EQ(plog::levelFrom(""), Level::Info);
  ::setenv("PETROUS_LOG_LEVEL", "error", 1);
  EXPECT_EQ(plog::levelFrom(""), Level::Error);
  EXPECT_EQ(plog::levelFrom("trace"), Level::Trace);
  EXPECT_EQ(plog::levelFrom("off"), Level::Off);
  EXPECT_THROW(plog::levelFrom("loud"), core::InvalidParameter);
  ::setenv("PETROUS_LOG_LEVEL", "loud", 1);
  EXPECT_THROW(plog::levelFrom(""), core::InvalidParameter);
}

TEST_F(Log, RotatesAndKeepsSoManyFilesOfSuchASize)
{
  auto small = setup();
  small.maxBytes = 1000;
  small.files = 3;
  plog::start(small);
  for (int n = 0; n < 200; ++n)
    plog::info("line " + std::to_string(1000 + n));
  std::set<std::string> names;
  std::vector<std::string> all;
  for (const char* name : {"petrous.2.log", "petrous.1.log", "petrous.log"})
  {
    const auto path = m_folder / "state" / name;
    EXPECT_LE(fs::file_size(path), 1000U);
    const auto some = linesOf(path);
    all.insert(all.end(), some.begin(), some.end());
  }
  for (const auto& entry : fs::directory_iterator(m_folder / "state"))
    names.insert(entry.path().filename());
  EXPECT_EQ(names, (std::set<std::string>{"petrous.2.log", "petrous.1.log", "petrous.log"}));
  ASSERT_GT(all.size(), 30U);
  for (std::size_t n = 0; n < all.size(); ++n) // the latest, in order
    EXPECT_EQ(all[n].substr(all[n].size() - 4), std::to_string(1200 - all.size() + n));
}

TEST_F(Log, SeveralProcessesNeitherTearNorLoseLinesOverRotations)
{
  constexpr int kProcesses = 4;
  constexpr int kLines = 500;
  auto shared = setup();
  shared.maxBytes = 5000; // about a hundred lines
  shared.files = 100;
  std::vector<pid_t> children;
  for (int p = 0; p < kProcesses; ++p)
  {
    children.push_back(::fork());
    if (children.back() != 0)
      continue;
    plog::start(shared);
    for (int n = 0; n < kLines; ++n)
      plog::info("process " + std::to_string(p) + " line " + std::to_string(n) + " end");
    ::_exit(0);
  }
  for (const pid_t child : children)
  {
    int status = -1;
    ::waitpid(child, &status, 0);
    EXPECT_EQ(status, 0);
  }
  std::multiset<std::pair<int, int>> found;
  std::size_t files = 0;
  for (const auto& entry : fs::directory_iterator(m_folder / "state"))
  {
    ++files;
    for (const std::string& line : linesOf(entry.path()))
    {
      std::smatch match;
      ASSERT_TRUE(
          std::regex_match(line, match, std::regex("\\S+ \\d+ info process (\\d) line (\\d+) end")))
          << line;
      found.insert({std::stoi(match[1]), std::stoi(match[2])});
    }
  }
  EXPECT_GT(files, 5U);
  EXPECT_EQ(found.size(), static_cast<std::size_t>(kProcesses * kLines));
  EXPECT_EQ(std::set(found.begin(), found.end()).size(), found.size());
}

TEST_F(Log, AFolderThatCannotBeWrittenWarnsOnceAndHindersNothing)
{
  const auto expectWarning = [this](const char* place)
  {
    m_warnings.clear();
    plog::start(setup());
    plog::info("one");
    plog::info("two");
    ASSERT_EQ(m_warnings.size(), 1U) << place;
    EXPECT_NE(m_warnings[0].find("state/petrous.log cannot be written"), std::string::npos);
  };
  std::ofstream(m_folder / "state") << "a file in place of the folder";
  expectWarning("a file");
  fs::remove(m_folder / "state");
  fs::create_directories(m_folder / "state/petrous.log");
  expectWarning("a folder in place of the file");
  fs::remove(m_folder / "state/petrous.log");
  ASSERT_EQ(::mkfifo((m_folder / "state/petrous.log").c_str(), 0600), 0);
  expectWarning("a pipe that nobody reads");
  fs::remove(m_folder / "state/petrous.log");
  ASSERT_EQ(::symlink("/dev/full", (m_folder / "state/petrous.log").c_str()), 0);
  expectWarning("a device");

  m_warnings.clear();
  auto homeless = setup();
  homeless.file.clear();
  plog::start(homeless);
  plog::info("one");
  plog::info("two");
  EXPECT_EQ(m_warnings.size(), 1U);
}

TEST_F(Log, TheProcesssLimitOfAFileDoesNotEndIt)
{
  const int status = inChild(
      [this]
      {
        const struct rlimit limit = {100, 100};
        ::setrlimit(RLIMIT_FSIZE, &limit);
        plog::start(setup());
        for (int n = 0; n < 10; ++n)
          plog::info("line " + std::to_string(n));
      });
  EXPECT_EQ(status, 0);
  EXPECT_GE(lines().size(), 1U);
}

TEST_F(Log, GoesWhereTheEnvironmentSays)
{
  ::setenv("XDG_STATE_HOME", "/x/state", 1);
  EXPECT_EQ(plog::defaultFile(), "/x/state/petrous/petrous.log");
  ::setenv("XDG_STATE_HOME", "relative", 1);
  ::setenv("HOME", "/x/home", 1);
  EXPECT_EQ(plog::defaultFile(), "/x/home/.local/state/petrous/petrous.log");
  ::unsetenv("XDG_STATE_HOME");
  ::unsetenv("HOME");
  EXPECT_EQ(plog::defaultFile(), fs::path());
}

TEST_F(Log, NamesTheSignalThatEndedTheProcess)
{
  for (const int signal : {SIGSEGV, SIGABRT})
  {
    fs::remove_all(m_folder / "state");
    const int status = inChild(
        [this, signal]
        {
          struct rlimit none = {};
          ::setrlimit(RLIMIT_CORE, &none);
          ::signal(signal, SIG_DFL);
          plog::start(setup());
          plog::info("started");
          ::raise(signal);
        });
    ASSERT_TRUE(WIFSIGNALED(status));
    EXPECT_EQ(WTERMSIG(status), signal);
    ASSERT_EQ(lines().size(), 2U);
    EXPECT_TRUE(std::regex_match(lines()[1],
                                 std::regex("unexpected end: process \\d+, signal " +
                                            std::to_string(signal) + ", seconds since 1970: \\d+")))
        << lines()[1];
  }
}

TEST_F(Log, KeepsOnlyTheSourceOfAnotherLibrarysMessage)
{
  plog::start(setup());
  plog::foreign(Level::Warning, "VTK",
                "ERROR: In ./IO/vtkReader.cxx, line 96\nvtkReader (0x1): Meier^Anna, In x, line 3");
  plog::foreign(Level::Warning, "ITK", "Meier: In Anna.cxx, line 7");
  plog::foreign(Level::Warning, "ITK", "In Meier");
  ASSERT_EQ(lines().size(), 2U) << "a repeated line is skipped";
  EXPECT_NE(lines()[0].find("VTK message, vtkReader.cxx:96"), std::string::npos);
  EXPECT_EQ(lines()[1].substr(lines()[1].size() - 11), "ITK message");
}

TEST_F(Log, NamesAnExceptionByItsType)
{
  EXPECT_EQ(plog::typeOf(core::InvalidParameter("x")), "petrous::core::InvalidParameter");
  EXPECT_EQ(plog::typeOf(std::out_of_range("x")), "std::out_of_range");
}
