#include <cerrno>
#include <csignal>
#include <fstream>

#include <gtest/gtest.h>

#include <sys/wait.h>

#include "../../Core/Testing/SystemCalls.h"
#include "TestCase.h"
#include "petrous/Core/OutputFile.h"
#include "petrous/Library/Journal.h"
#include "petrous/Library/ObjectStore.h"

using namespace petrous;
using namespace petrous::library;
using petrous::testing::SystemCalls;
using test::contentOf;
using test::drill;
using test::smallCase;
using test::TemporaryFolder;

namespace
{

namespace fs = std::filesystem;

// Runs `work` in a child process that is killed at the n-th system call that modifies files, for
// all n, each on a fresh copy of `from`; `check` sees what is left.
template <class Work, class Check>
void killedAtEachStep(const fs::path& from, const Work& work, const Check& check)
{
  const TemporaryFolder place;
  for (int step = 1, ended = 0; ended == 0; ++step)
  {
    ASSERT_LT(step, 400);
    const fs::path copy = place.path() / std::to_string(step);
    fs::copy(from, copy, fs::copy_options::recursive);
    const pid_t child = ::fork();
    if (child == 0)
    {
      try
      {
        Library library(copy);
        SystemCalls::killAt(step);
        work(library);
        SystemCalls::reset();
        ::_exit(0);
      }
      catch (...)
      {
        ::_exit(1);
      }
    }
    int status = 0;
    ::waitpid(child, &status, 0);
    if (WIFEXITED(status))
    {
      ASSERT_EQ(WEXITSTATUS(status), 0);
      ended = 1;
    }
    Library library(copy);
    check(library, ended != 0, step);
    fs::remove_all(copy);
  }
}

} // namespace

TEST(Crash, KilledAtEachStepOfASaveIsTheOldCaseOrTheNew)
{
  const TemporaryFolder folder;
  {
    Library library(folder.path());
    scene::Case value = smallCase("ear", 16);
    library.save(value);
  }
  int olds = 0;
  killedAtEachStep(
      folder.path(),
      [](Library& library)
      {
        scene::Case own = library.open("ear");
        library.loadDissection(own);
        drill(own, {8, 8, 8});
        library.save(own);
      },
      [&olds](Library& library, bool ended, int step)
      {
        scene::Case after = library.open("ear");
        ASSERT_NO_THROW(library.loadDissection(after)) << step;
        EXPECT_TRUE(library.verify().damaged.empty()) << step;
        olds += after.dissection.strokes().empty();
        EXPECT_TRUE(!ended || after.dissection.strokes().size() == 1);
        after.iso = 111;
        library.save(after); // removes leftovers
        for (const auto& [name, content] : contentOf(library.folder()))
          EXPECT_FALSE(core::isLeftover(name)) << name;
      });
  EXPECT_GT(olds, 3);
}

TEST(Crash, KilledAtEachStepOfARenameHasTheCaseUnderOneName)
{
  const TemporaryFolder folder;
  {
    Library library(folder.path());
    scene::Case value = smallCase("ear", 16);
    library.save(value);
  }
  killedAtEachStep(
      folder.path(), [](Library& library) { library.rename("ear", "left ear"); },
      [](Library& library, bool ended, int)
      {
        const auto cases = library.list();
        ASSERT_EQ(cases.size(), 1u);
        EXPECT_TRUE(cases[0].name == "left ear" || (cases[0].name == "ear" && !ended));
        EXPECT_EQ(library.open(cases[0].name).name, cases[0].name);
      });
}

// A journal that outlives its case must not be applied to the next case of that name.
TEST(Crash, KilledAtEachStepOfADeletionLeavesNoStrokesToTheNextCase)
{
  const TemporaryFolder folder;
  {
    Library library(folder.path());
    scene::Case value = test::savedCase(library, "ear", 16);
    Journal journal(library, value);
    drill(value, {8, 8, 8});
    journal.follow(value.dissection);
    journal.leave();
  }
  killedAtEachStep(
      folder.path(), [](Library& library) { library.remove("ear"); },
      [](Library& library, bool ended, int step)
      {
        if (library.contains("ear"))
        {
          EXPECT_FALSE(ended);
          library.open("ear");
          library.remove("ear");
        }
        scene::Case next = smallCase("ear", 16);
        library.save(next);
        EXPECT_EQ(library.open("ear").dissection.strokes().size(), 0u) << step;
      });
}

// As network drives answer that have no locks, or cannot replace a file.
TEST(Crash, ADriveWithoutLocksOrRenameIsNamed)
{
  const TemporaryFolder folder;
  Library library(folder.path());
  scene::Case value = test::savedCase(library, "ear", 16);
  const auto before = contentOf(folder.path());
  for (const auto& [call, error, words] :
       {std::tuple("flock", ENOLCK, "locks"), std::tuple("flock", EOPNOTSUPP, "locks"),
        std::tuple("rename", ENOSYS, "replace a file"),
        std::tuple("rename", EOPNOTSUPP, "replace a file")})
  {
    drill(value, {8, 8, 8});
    SystemCalls::fail(call, 1, error);
    try
    {
      library.save(value);
      ADD_FAILURE() << call << " " << error;
    }
    catch (const LibraryError& refusal)
    {
      EXPECT_NE(std::string(refusal.what()).find(words), std::string::npos) << refusal.what();
      EXPECT_NE(std::string(refusal.what()).find("local disk"), std::string::npos)
          << refusal.what();
    }
    SystemCalls::reset();
    EXPECT_EQ(contentOf(folder.path()), before);
  }
}

// After the rename of the manifest nothing may be rolled back.
TEST(Crash, ASyncThatFailsNeverCostsAnObjectOfAPublishedManifest)
{
  const TemporaryFolder folder;
  Library library(folder.path());
  scene::Case value = test::savedCase(library, "ear", 16);
  int refused = 0, saved = 0;
  for (const char* call : {"fsync", "rename", "open", "write"})
    for (int n = 1; n < 12; ++n)
    {
      const auto before = contentOf(folder.path());
      scene::Case next = value;
      drill(next, {3.0 + n, 8.0, 4.0 + static_cast<double>(call[0] % 7)});
      std::string told;
      library.onNotice([&told](const std::string& words) { told = words; });
      bool thrown = false;
      SystemCalls::fail(call, n, EIO);
      try
      {
        library.save(next);
      }
      catch (const core::Error& error)
      {
        thrown = true;
        EXPECT_EQ(error.fault(), core::Fault::Refused) << error.what();
      }
      SystemCalls::reset();
      EXPECT_TRUE(library.verify().damaged.empty()) << call << n;
      const scene::Case after = library.open("ear");
      if (thrown)
      {
        ++refused;
        EXPECT_EQ(contentOf(folder.path()), before) << call << n << ": it said so";
      }
      else
      {
        ++saved;
        EXPECT_EQ(after.dissection.strokes().size(), next.dissection.strokes().size()) << call << n;
        value = next;
      }
    }
  EXPECT_GT(refused, 4);
  EXPECT_GT(saved, 4);
}

// The manifest is written with its new name, then moved, which decides; a fault after it is told,
// not thrown.
TEST(Crash, ACaseThatIsRenamedStaysSoThoughAJournalDoesNotFollow)
{
  const TemporaryFolder folder;
  Library library(folder.path());
  scene::Case value = smallCase("ear", 16);
  library.save(value);
  for (const char* name : {"ear.journal.aside-1", "ear.journal.aside-2"})
    std::ofstream(folder.path() / "cases" / name) << "old";
  std::string told;
  library.onNotice([&told](const std::string& words) { told = words; });
  SystemCalls::fail("rename", 3, EIO);
  EXPECT_NO_THROW(library.rename("ear", "left ear"));
  SystemCalls::reset();
  EXPECT_NE(told.find("is renamed"), std::string::npos) << told;
  EXPECT_FALSE(library.contains("ear"));
  EXPECT_EQ(library.open("left ear").id, value.id);
  for (const int call : {1, 2})
  {
    SystemCalls::fail("rename", call, EIO);
    EXPECT_THROW(library.rename("left ear", "ear"), LibraryError);
    SystemCalls::reset();
    EXPECT_TRUE(library.contains("left ear"));
    EXPECT_FALSE(library.contains("ear"));
    EXPECT_EQ(library.open("left ear").name, "left ear") << "whatever its manifest says";
    EXPECT_EQ(library.open("left ear").id, value.id);
  }
}

TEST(Crash, TellsThatTheDiskDidNotConfirmWhatIsSaved)
{
  const TemporaryFolder folder;
  Library library(folder.path());
  scene::Case value = smallCase("ear", 16);
  library.save(value);
  std::string told;
  library.onNotice([&told](const std::string& words) { told = words; });
  value.iso = 222;
  SystemCalls::fail("fsync", 2, EIO); // of the folder, after the rename
  EXPECT_NO_THROW(library.save(value));
  SystemCalls::reset();
  EXPECT_NE(told.find("disk reported an error"), std::string::npos) << told;
  EXPECT_EQ(library.open("ear").iso, 222);
}
