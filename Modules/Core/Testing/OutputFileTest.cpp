#include "petrous/Core/OutputFile.h"

#include <cerrno>
#include <fstream>
#include <iterator>
#include <set>
#include <string>

#include <gtest/gtest.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include "SystemCalls.h"
#include "petrous/Core/InputFile.h"
#include "petrous/Core/StandardStreams.h"

namespace
{

using namespace petrous;
using petrous::testing::SystemCalls;
namespace fs = std::filesystem;
using Reason = core::OutputFileError::Reason;

class OutputFile : public ::testing::Test
{
protected:
  OutputFile()
  {
    std::string name = (fs::temp_directory_path() / "petrous-output-XXXXXX").string();
    m_folder = ::mkdtemp(name.data());
    m_file = m_folder / "file";
    core::writeFile(m_file, "old");
  }
  ~OutputFile() override
  {
    SystemCalls::reset();
    fs::remove_all(m_folder);
  }

  std::set<std::string> names() const
  {
    std::set<std::string> result;
    for (const auto& entry : fs::directory_iterator(m_folder))
      result.insert(entry.path().filename().string());
    return result;
  }

  static Reason reasonOf(const fs::path& path)
  {
    try
    {
      core::writeFile(path, "new");
    }
    catch (const core::OutputFileError& error)
    {
      EXPECT_EQ(error.fault(), core::Fault::Refused);
      EXPECT_EQ(std::string(error.what()), core::printable(path) + ": " + error.problem);
      return error.reason;
    }
    ADD_FAILURE() << path << " was written";
    return Reason::Failed;
  }

  fs::path m_folder;
  fs::path m_file;
};

TEST_F(OutputFile, ReplacesAFileWhole)
{
  EXPECT_TRUE(core::writeFile(m_file, "new"));
  EXPECT_EQ(core::readFile(m_file), "new");
  EXPECT_EQ(names(), std::set<std::string>{"file"});
}

TEST_F(OutputFile, LeavesNothingWithoutACommit)
{
  {
    core::OutputFile file(m_file);
    file.write("half");
    EXPECT_TRUE(core::isLeftover(file.temporary()));
    EXPECT_EQ(names().size(), 2U);
  }
  EXPECT_EQ(core::readFile(m_file), "old");
  EXPECT_EQ(names(), std::set<std::string>{"file"});
}

TEST_F(OutputFile, AStepThatFailsLeavesTheOldFile)
{
  for (const auto& [name, n, reason] :
       {std::tuple("open", 1, Reason::NotPermitted), std::tuple("open", 2, Reason::NotPermitted),
        std::tuple("write", 1, Reason::NotPermitted), std::tuple("fsync", 1, Reason::NotPermitted),
        std::tuple("rename", 1, Reason::NotPermitted)})
  {
    SystemCalls::fail(name, n, EACCES);
    EXPECT_EQ(reasonOf(m_file), reason) << name << n;
    SystemCalls::reset();
    EXPECT_EQ(core::readFile(m_file), "old") << name << n;
    EXPECT_EQ(names(), std::set<std::string>{"file"}) << name << n;
  }
  SystemCalls::fail("write", 1, ENOSPC);
  EXPECT_EQ(reasonOf(m_file), Reason::DiskFull);
}

// The file is in place by then: an exception would be wrong.
TEST_F(OutputFile, DoesNotThrowAfterTheRename)
{
  SystemCalls::fail("fsync", 2, EIO);
  EXPECT_FALSE(core::writeFile(m_file, "new"));
  EXPECT_EQ(core::readFile(m_file), "new");
  SystemCalls::fail("fsync", 2, EINVAL); // a file system that cannot sync folders
  EXPECT_TRUE(core::writeFile(m_file, "newer"));
}

TEST_F(OutputFile, KilledAtEachStepIsTheOldFileOrTheNew)
{
  for (int step = 1, ended = 0; ended == 0; ++step)
  {
    ASSERT_LT(step, 100);
    core::writeFile(m_file, "old");
    const pid_t child = ::fork();
    if (child == 0)
    {
      SystemCalls::killAt(step);
      core::writeFile(m_file, "new");
      SystemCalls::reset();
      ::_exit(0);
    }
    int status = 0;
    ::waitpid(child, &status, 0);
    ended = WIFEXITED(status);
    const std::string content = core::readFile(m_file);
    EXPECT_TRUE(content == "old" || content == "new") << step << ": " << content;
    for (const std::string& name : names())
    {
      EXPECT_TRUE(name == "file" || core::isLeftover(m_folder / name)) << name;
      if (name != "file")
        fs::remove(m_folder / name);
    }
    EXPECT_TRUE(!ended || content == "new");
  }
}

TEST_F(OutputFile, RefusesWhatIsNoRegularFile)
{
  EXPECT_EQ(reasonOf("/dev/null"), Reason::WrongPlace);
  EXPECT_TRUE(fs::is_character_file("/dev/null"));
  const fs::path fifo = m_folder / "fifo";
  ASSERT_EQ(::mkfifo(fifo.c_str(), 0600), 0);
  EXPECT_EQ(reasonOf(fifo), Reason::WrongPlace);
  EXPECT_EQ(reasonOf(m_folder), Reason::WrongPlace);
  EXPECT_EQ(reasonOf(m_folder / "none" / "file"), Reason::WrongPlace);
  EXPECT_EQ(reasonOf(m_file / "below"), Reason::WrongPlace);
  EXPECT_EQ(reasonOf(m_folder / std::string(300, 'x')), Reason::WrongPlace);
}

TEST_F(OutputFile, KeepsALinkAndReplacesWhatItPointsTo)
{
  fs::create_directory(m_folder / "elsewhere");
  core::writeFile(m_folder / "elsewhere" / "target", "old");
  fs::create_symlink("elsewhere/target", m_folder / "link");
  core::writeFile(m_folder / "link", "new");
  EXPECT_TRUE(fs::is_symlink(m_folder / "link"));
  EXPECT_EQ(core::readFile(m_folder / "elsewhere" / "target"), "new");
}

TEST_F(OutputFile, HasTheModeThatTheUsersMaskAllows)
{
  const mode_t before = ::umask(027);
  core::writeFile(m_folder / "new", "x");
  ::umask(before);
  struct stat status = {};
  ASSERT_EQ(::stat((m_folder / "new").c_str(), &status), 0);
  EXPECT_EQ(status.st_mode & 0777U, 0640U);
}

TEST_F(OutputFile, NamesTemporaryFilesSoThatNobodyCanGuessThem)
{
  std::set<fs::path> names;
  for (int n = 0; n < 100; ++n)
    names.insert(core::temporaryBeside(m_file));
  EXPECT_EQ(names.size(), 100U);
  EXPECT_EQ(names.begin()->parent_path(), m_folder);
}

class OutputFolder : public OutputFile
{
protected:
  // "a", "b/c" and "d" below `target`; returns what commit does.
  static bool write(const fs::path& target)
  {
    core::OutputFolder folder(target);
    for (const char* name : {"a", "d"})
      std::ofstream(folder.path() / name) << "new";
    fs::create_directory(folder.path() / "b");
    std::ofstream(folder.path() / "b" / "c") << "new";
    return folder.commit();
  }
  static bool isWhole(const fs::path& target)
  {
    for (const char* name : {"a", "b/c", "d"})
      if (!fs::is_regular_file(target / name) || core::readFile(target / name) != "new")
        return false;
    return std::distance(fs::directory_iterator(target), {}) == 3;
  }
};

TEST_F(OutputFolder, AppearsWholeInANewOrAnEmptyFolder)
{
  EXPECT_TRUE(write(m_folder / "new"));
  EXPECT_TRUE(isWhole(m_folder / "new"));
  EXPECT_TRUE(write(m_folder / "x/y/z/"));
  EXPECT_TRUE(isWhole(m_folder / "x/y/z"));
  fs::create_directory(m_folder / "empty");
  EXPECT_TRUE(write(m_folder / "empty"));
  EXPECT_TRUE(isWhole(m_folder / "empty"));
  EXPECT_EQ(names(), (std::set<std::string>{"empty", "file", "new", "x"}));
}

TEST_F(OutputFolder, RefusesAFileAndAFolderWithSomethingInIt)
{
  for (const fs::path& target : {m_file, m_folder, m_file / "below"})
    EXPECT_THROW(write(target), core::OutputFileError) << target;
  EXPECT_EQ(names(), std::set<std::string>{"file"});
}

TEST_F(OutputFolder, AStepThatFailsLeavesTheTargetAsItWas)
{
  for (const bool exists : {false, true})
  {
    const fs::path target = exists ? m_folder / "empty" : m_folder / "x/y";
    if (exists)
      fs::create_directory(target);
    // Of five files and folders; each is synced before the first rename.
    for (const char* call : {"fsync", "rename"})
      for (int n = 1; n <= (call[0] == 'f' ? 5 : exists ? 3 : 1); ++n)
      {
        SystemCalls::fail(call, n, EIO);
        EXPECT_THROW(write(target), core::OutputFileError) << call << n << exists;
        SystemCalls::reset();
        if (exists)
          EXPECT_TRUE(fs::is_empty(target)) << call << n;
        else
          EXPECT_FALSE(fs::exists(m_folder / "x")) << call << n;
      }
  }
}

TEST_F(OutputFolder, DoesNotReplaceWhatAppearsInAnEmptyFolderMeanwhile)
{
  const fs::path target = m_folder / "empty";
  fs::create_directory(target);
  core::OutputFolder folder(target);
  for (const char* name : {"a", "b", "c"})
    std::ofstream(folder.path() / name) << "new";
  std::ofstream(target / "b") << "another program's";
  EXPECT_THROW(folder.commit(), core::OutputFileError);
  EXPECT_EQ(core::readFile(target / "b"), "another program's");
  EXPECT_FALSE(fs::exists(target / "a"));
  EXPECT_FALSE(fs::exists(target / "c"));
}

TEST_F(OutputFolder, DoesNotThrowAfterTheRename)
{
  fs::create_directory(m_folder / "empty");
  for (const char* name : {"new", "x/y", "empty"})
  {
    SystemCalls::fail("fsync", 6, EIO);
    EXPECT_FALSE(write(m_folder / name)) << name;
    SystemCalls::reset();
    EXPECT_TRUE(isWhole(m_folder / name)) << name;
  }
}

TEST_F(OutputFolder, KilledAtEachStepTheNewFolderIsWholeOrNotThere)
{
  for (int step = 1, ended = 0; ended == 0; ++step)
  {
    ASSERT_LT(step, 100);
    fs::remove_all(m_folder / "new");
    const pid_t child = ::fork();
    if (child == 0)
    {
      SystemCalls::killAt(step);
      write(m_folder / "new");
      SystemCalls::reset();
      ::_exit(0);
    }
    int status = 0;
    ::waitpid(child, &status, 0);
    ended = WIFEXITED(status);
    EXPECT_TRUE(!fs::exists(m_folder / "new") || isWhole(m_folder / "new")) << step;
    EXPECT_TRUE(!ended || isWhole(m_folder / "new"));
  }
}

// Else a file would be stdout or stderr, and what is printed would be in it.
TEST_F(OutputFile, NoFileBecomesAStandardStreamThatWasClosed)
{
  const std::string file = m_file.string();
  const pid_t child = ::fork();
  if (child == 0)
  {
    for (int stream = 0; stream < 3; ++stream)
      ::close(stream);
    core::holdStandardStreams();
    const bool isHeld = ::open(file.c_str(), O_WRONLY | O_CREAT, 0600) > STDERR_FILENO;
    // stdout fails, as a closed one does; stderr swallows
    ::_exit(isHeld && ::write(STDOUT_FILENO, "x", 1) < 0 && ::write(STDERR_FILENO, "x", 1) == 1
                ? 0
                : 1);
  }
  int status = 1;
  ::waitpid(child, &status, 0);
  EXPECT_EQ(status, 0);
}

} // namespace
