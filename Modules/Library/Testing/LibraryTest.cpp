#include <chrono>
#include <csignal>
#include <cstdlib>
#include <optional>
#include <thread>

#include <gtest/gtest.h>

#include <sys/mount.h>
#include <sys/wait.h>

#include "TestCase.h"
#include "petrous/Imaging/NrrdFile.h"
#include "petrous/Library/DefaultFolder.h"
#include "petrous/Library/FrameSalt.h"
#include "petrous/Library/ObjectStore.h"

using namespace petrous;
using namespace petrous::library;
using test::contentOf;
using test::drill;
using test::refusal;
using test::smallCase;
using test::TemporaryFolder;

namespace
{

bool sameVoxels(const volume::CutMask& a, const volume::CutMask& b)
{
  const auto da = a.dense();
  const auto db = b.dense();
  return std::equal(da.data(), da.data() + da.size(), db.data());
}

} // namespace

TEST(Library, GivesACaseBackWithEveryVoxel)
{
  const TemporaryFolder folder;
  Library library(folder.path() / "library");
  scene::Case value = smallCase("ear");
  library.save(value);
  EXPECT_EQ(value.revision, 1u);

  const scene::Case back = Library(folder.path() / "library").open("ear");
  EXPECT_EQ(back.ct.volume.peek(), nullptr) << "nothing is read before it is asked for";
  const auto a = std::get<0>(value.ct.volume.get()->voxels());
  const auto b = std::get<0>(back.ct.volume.get()->voxels());
  EXPECT_TRUE(std::equal(a->data(), a->data() + a->size(), b->data()));
  EXPECT_EQ(b->geometry().origin(), a->geometry().origin());
  EXPECT_EQ(back.ct.volume.get()->padding(), -2000.0);
  const auto labels = back.labels.at(0).labels.get();
  EXPECT_EQ(labels->voxels->at(5, 8, 8), 3);
  EXPECT_EQ(labels->voxels->at(3, 8, 8), 0);
  EXPECT_FLOAT_EQ(back.meshes.at(0).mesh.get()->vertices[1][0], 1.25F);
}

TEST(Library, StrokesComeBackAfterReopening)
{
  const TemporaryFolder folder;
  Library library(folder.path());
  scene::Case value = smallCase("ear");
  library.save(value);
  library.loadDissection(value);
  drill(value, {8, 8, 8});
  drill(value, {14, 8, 8});
  drill(value, {14, 14, 8});
  value.dissection.undo();
  library.save(value);

  scene::Case back = library.open("ear");
  EXPECT_EQ(back.applied(), 2u);
  EXPECT_EQ(back.dissection.strokes().size(), 3u);
  library.loadDissection(back);
  EXPECT_TRUE(sameVoxels(back.dissection.mask(), value.dissection.mask()));
  back.dissection.redo();
  value.dissection.redo();
  EXPECT_TRUE(sameVoxels(back.dissection.mask(), value.dissection.mask()));
}

TEST(Library, ReadsTheVoxelsOfAppliedStrokesOnly)
{
  const TemporaryFolder folder;
  Library library(folder.path());
  scene::Case value = test::savedCase(library);
  test::drill(value, {4, 4, 4});
  test::drill(value, {12, 4, 4});
  value.dissection.undo();
  library.save(value);
  scene::Case back = library.open("ear");
  const auto resident = [&back](std::size_t n)
  { return back.dissection.strokes()[n]->packed.peek() != nullptr; };
  EXPECT_EQ(back.dissection.strokes()[1]->bytes, value.dissection.strokes()[1]->bytes);
  EXPECT_FALSE(back.dissection.loaded());
  EXPECT_FALSE(resident(0));
  library.loadDissection(back);
  EXPECT_TRUE(resident(0));
  EXPECT_FALSE(resident(1));
  EXPECT_EQ(back.dissection.redo(), 1u);
  EXPECT_TRUE(resident(1));
}

TEST(Library, StoresOneCtForManyCases)
{
  const TemporaryFolder folder;
  Library library(folder.path());
  for (const std::string name : {"one", "two", "three"})
  {
    scene::Case value = smallCase(name);
    library.save(value);
  }
  std::size_t images = 0;
  for (const auto& [name, content] : contentOf(folder.path()))
    images += name.find(".nrrd") != std::string::npos && name.find(".seg.") == std::string::npos;
  EXPECT_EQ(images, 1u);
  EXPECT_EQ(library.list().size(), 3u);
}

TEST(Library, ListsFromTheManifestsWhereTheIndexIsGoneOrSpoilt)
{
  const TemporaryFolder folder;
  Library library(folder.path());
  scene::Case value = smallCase("ear");
  library.save(value);
  const auto first = library.list();
  std::filesystem::remove(folder.path() / "library.sqlite");
  EXPECT_EQ(library.list().at(0).modified, first.at(0).modified);
  std::ofstream(folder.path() / "library.sqlite") << "no database";
  ASSERT_EQ(library.list().size(), 1u);
  EXPECT_EQ(library.list().at(0).dims, first.at(0).dims);
  EXPECT_EQ(library.list().at(0).structures, 1u);
}

TEST(Library, RefusesATakenNameAndStaysAsItWas)
{
  const TemporaryFolder folder;
  Library library(folder.path());
  scene::Case value = smallCase("ear");
  library.save(value);
  const auto before = contentOf(folder.path());
  scene::Case other = smallCase("ear", 20);
  EXPECT_EQ(refusal([&] { library.save(other); }).first, LibraryError::Reason::NameTaken);
  EXPECT_EQ(contentOf(folder.path()), before);
  EXPECT_EQ(other.revision, 0u);
}

TEST(Library, RefusesANewNameThatReadsAsAnother)
{
  const TemporaryFolder folder;
  Library library(folder.path());
  scene::Case value = smallCase("ear");
  library.save(value);
  scene::Case letters = smallCase("M\u00fcller left", 20);
  library.save(letters);
  for (const char* name : {"EAR", "Mu\u0308ller left", "m\u00fcller_left", "M\u00fcller\u00a0left"})
  {
    scene::Case other = smallCase(name, 20);
    EXPECT_EQ(refusal([&] { library.save(other); }).first, LibraryError::Reason::NameTaken) << name;
    EXPECT_FALSE(library.contains(name));
  }
  library.rename("ear", "Ear"); // its own
  EXPECT_TRUE(library.contains("Ear"));
}

TEST(Library, RefusesToOverwriteWhatAnotherProgramSaved)
{
  const TemporaryFolder folder;
  Library library(folder.path());
  scene::Case value = smallCase("ear");
  library.save(value);
  scene::Case mine = library.open("ear");
  scene::Case theirs = library.open("ear");
  theirs.iso = 250;
  library.save(theirs);
  const auto before = contentOf(folder.path());
  library.loadDissection(mine);
  drill(mine, {8, 8, 8});
  EXPECT_EQ(refusal([&] { library.save(mine); }).first, LibraryError::Reason::Conflict);
  EXPECT_EQ(contentOf(folder.path()), before);
  EXPECT_EQ(mine.dissection.strokes().size(), 1u) << "the work is still in memory";
}

TEST(Library, NamesTheCasesThereAreWhenOneIsMissing)
{
  const TemporaryFolder folder;
  Library library(folder.path());
  scene::Case value = smallCase("left ear");
  library.save(value);
  try
  {
    library.open("right ear");
    FAIL();
  }
  catch (const LibraryError& error)
  {
    EXPECT_EQ(error.reason, LibraryError::Reason::NotFound);
    EXPECT_NE(std::string(error.what()).find("left ear"), std::string::npos);
  }
}

TEST(Library, SaysWhichObjectIsMissingAndWhichManifestIsDamaged)
{
  const TemporaryFolder folder;
  Library library(folder.path());
  scene::Case value = smallCase("ear");
  library.save(value);
  std::filesystem::remove(folder.path() / "objects" / value.ct.object);
  EXPECT_EQ(refusal([&] { library.open("ear").ct.volume.get(); }).first,
            LibraryError::Reason::NotFound);
  std::ofstream(folder.path() / "cases/ear.json") << "{";
  EXPECT_THROW(library.open("ear"), core::Error);
  EXPECT_TRUE(library.list().at(0).damaged);
}

TEST(Library, CancelLeavesNothing)
{
  const TemporaryFolder folder;
  Library library(folder.path());
  auto token = std::make_shared<core::CancelToken>();
  token->cancel();
  scene::Case value = smallCase("ear");
  EXPECT_THROW(library.save(value, core::Progress(nullptr, token)), core::CancelledError);
  EXPECT_TRUE(contentOf(folder.path()).empty());
  EXPECT_TRUE(library.list().empty());
}

TEST(Library, AFullDiskLeavesTheCaseAsItWas)
{
  const TemporaryFolder folder;
  const auto disk = folder.path() / "disk";
  std::filesystem::create_directory(disk);
  if (::mount("tmpfs", disk.c_str(), "tmpfs", 0, "size=512k") != 0)
    GTEST_SKIP() << "mounting a small disk needs root";
  {
    Library library(disk);
    scene::Case value = smallCase("ear");
    library.save(value);
    const auto before = contentOf(disk);
    scene::Case large = smallCase("large", 80); // 1 MB
    try
    {
      library.save(large);
      ADD_FAILURE() << "1 MB fitted on a disk of 512 KB";
    }
    catch (const core::Error& error)
    {
      EXPECT_NE(error.fault(), core::Fault::Internal);
      EXPECT_NE(std::string(error.what()).find(disk.string()), std::string::npos) << error.what();
    }
    EXPECT_EQ(contentOf(disk), before);

    // Full to the last byte: saving a stroke fails, keeps it in memory, and succeeds once there is
    // space.
    library.loadDissection(value);
    drill(value, {8, 8, 8});
    {
      std::ofstream filler(disk / "filler");
      while (filler << std::string(4096, 'x') << std::flush)
      {
      }
    }
    EXPECT_EQ(refusal([&] { library.save(value); }).first, LibraryError::Reason::DiskFull);
    EXPECT_EQ(library.open("ear").dissection.strokes().size(), 0u);
    std::filesystem::remove(disk / "filler");
    library.save(value);
    EXPECT_EQ(library.open("ear").dissection.strokes().size(), 1u);
  }
  ::umount2(disk.c_str(), MNT_DETACH);
}

TEST(Library, AReadOnlyLibraryCanBeReadAndRefusesInWords)
{
  const TemporaryFolder folder;
  const auto disk = folder.path() / "disk";
  std::filesystem::create_directory(disk);
  if (::mount("tmpfs", disk.c_str(), "tmpfs", 0, "size=4m") != 0)
    GTEST_SKIP() << "mounting a disk needs root";
  {
    Library library(disk);
    scene::Case value = smallCase("ear");
    library.save(value);
    ASSERT_EQ(::mount("tmpfs", disk.c_str(), "tmpfs", MS_REMOUNT | MS_RDONLY, nullptr), 0);
    EXPECT_EQ(library.list().size(), 1u);
    EXPECT_EQ(library.open("ear").ct.volume.get()->at(1, 0, 0), 401.0);
    EXPECT_EQ(refusal([&] { library.save(value); }).first, LibraryError::Reason::Unwritable);
    scene::Case other = smallCase("other");
    EXPECT_EQ(refusal([&] { library.save(other); }).first, LibraryError::Reason::Unwritable);
  }
  ::umount2(disk.c_str(), MNT_DETACH);
}

TEST(Library, KilledWhileSavingKeepsTheOldStateOrTheNew)
{
  const TemporaryFolder folder;
  Library library(folder.path());
  scene::Case value = smallCase("ear");
  library.save(value);
  std::mt19937 random(23);
  for (int round = 0; round < 25; ++round)
  {
    const std::size_t before = library.open("ear").dissection.strokes().size();
    const pid_t child = ::fork();
    if (child == 0)
    {
      try
      {
        scene::Case own = library.open("ear");
        library.loadDissection(own);
        for (int n = 0; n < 1000; ++n)
        {
          drill(own, {4.0 + n % 15, 4.0 + n / 15 % 15, 4.0 + n / 225 % 15});
          library.save(own);
        }
      }
      catch (...)
      {
      }
      ::_exit(0);
    }
    std::this_thread::sleep_for(std::chrono::microseconds(500 + random() % 20000));
    ::kill(child, SIGKILL);
    int status = 0;
    ::waitpid(child, &status, 0);

    ASSERT_EQ(library.list().size(), 1u);
    scene::Case after = library.open("ear");
    EXPECT_GE(after.dissection.strokes().size(), before);
    ASSERT_NO_THROW(library.loadDissection(after)) << "round " << round;
    EXPECT_EQ(after.ct.volume.get()->at(3, 0, 0), 403.0);
  }
  // Leftovers of killed writers are removed by the next save.
  scene::Case last = library.open("ear");
  library.save(last);
  for (const auto& [name, content] : contentOf(folder.path()))
    EXPECT_EQ(name.find("objects/."), std::string::npos) << name;
}

// A plain hash of a UID can be tested against known UIDs.
TEST(Library, SaltsWhatTellsFramesOfReferenceApart)
{
  const TemporaryFolder folder;
  const std::string plain = sha256Of(reinterpret_cast<const std::uint8_t*>("1.2.3"), 5);
  const auto savedIn = [&](const std::string& library, const std::string& name)
  {
    Library opened(folder.path() / library);
    scene::Case value = smallCase(name);
    value.ct.frameOfReference = plain;
    opened.save(value);
    EXPECT_EQ(value.ct.frameOfReference, opened.open(name).ct.frameOfReference);
    const std::string first = value.ct.frameOfReference;
    opened.save(value);
    EXPECT_EQ(value.ct.frameOfReference, first) << "salted once";
    return first;
  };
  const std::string one = savedIn("a", "ear");
  EXPECT_EQ(one.size(), 64U);
  EXPECT_NE(one, plain);
  EXPECT_EQ(one, savedIn("a", "other ear")) << "in one library the same are known as such";
  EXPECT_NE(one, savedIn("b", "ear"));
  EXPECT_EQ(contentOf(folder.path() / "a").count("salt"), 1U);
  const auto salted = frameSalter(Library(folder.path() / "a"));
  const std::string hash = salted("frame");
  EXPECT_EQ(hash, saltedFrame(Library(folder.path() / "a"), "frame"));
  std::filesystem::rename(folder.path() / "a" / "salt", folder.path() / "salt");
  EXPECT_EQ(salted("frame"), hash) << "read once";
  std::filesystem::rename(folder.path() / "salt", folder.path() / "a" / "salt");
  EXPECT_EQ(std::filesystem::status(folder.path() / "a" / "salt").permissions(),
            std::filesystem::perms::owner_read | std::filesystem::perms::owner_write);

  const Library library(folder.path() / "a");
  EXPECT_TRUE(library.verify().damaged.empty());
  for (const bool isCut : {true, false})
  {
    std::filesystem::remove(folder.path() / "a" / "salt");
    if (isCut)
      std::ofstream(folder.path() / "a" / "salt") << std::string(63, '0');
    const auto damaged = library.verify().damaged;
    ASSERT_EQ(damaged.size(), 1U) << isCut;
    EXPECT_EQ(damaged[0].object, "salt");
    EXPECT_EQ(damaged[0].cases, (std::vector<std::string>{"ear", "other ear"}));
  }
}

// Hashes of a salt that was lost would match nothing, and so seem to be of other patients.
TEST(Library, KnowsTheHashesOfASaltThatWasLost)
{
  const TemporaryFolder folder;
  Library library(folder.path());
  const auto saved = [&library](const std::string& name)
  {
    scene::Case value = smallCase(name);
    value.ct.patient.id = std::string(64, 'a');
    library.save(value);
    return library.open(name);
  };
  const scene::Case before = saved("before");
  EXPECT_EQ(before.ct.saltId.size(), 16U);
  EXPECT_EQ(saved("beside").ct.saltId, before.ct.saltId);
  scene::Case unstated = smallCase("of nobody");
  library.save(unstated);
  EXPECT_EQ(unstated.ct.saltId, "");
  EXPECT_FALSE(hasLostSalt(library.open("before"), frameSalter(library)));
  EXPECT_TRUE(library.repair().lost.empty());

  std::filesystem::rename(folder.path() / "salt", folder.path() / "kept");
  const scene::Case after = saved("after");
  EXPECT_NE(after.ct.saltId, before.ct.saltId);
  const scene::IdentitySalt salt = frameSalter(library);
  EXPECT_TRUE(hasLostSalt(library.open("before"), salt));
  EXPECT_FALSE(hasLostSalt(library.open("of nobody"), salt));
  EXPECT_FALSE(hasLostSalt(library.open("after"), salt));
  scene::Case again = library.open("before");
  library.save(again); // salts nothing twice, and does not call it another salt's
  EXPECT_EQ(library.open("before").ct.saltId, before.ct.saltId);
  const auto damaged = library.verify().damaged;
  ASSERT_EQ(damaged.size(), 1U);
  EXPECT_EQ(damaged[0].object, "salt");
  EXPECT_EQ(damaged[0].cases, (std::vector<std::string>{"before", "beside"}));
  EXPECT_EQ(library.repair().lost.size(), 2U);

  std::filesystem::rename(folder.path() / "kept", folder.path() / "salt");
  EXPECT_FALSE(hasLostSalt(library.open("before"), frameSalter(library)));
}

namespace
{

/// An environment variable, as before when it goes.
class Variable
{
public:
  Variable(const char* name, const std::string& value)
    : m_name(name)
  {
    if (const char* before = std::getenv(name))
      m_before = before;
    ::setenv(name, value.c_str(), 1);
  }
  ~Variable()
  {
    if (m_before)
      ::setenv(m_name, m_before->c_str(), 1);
    else
      ::unsetenv(m_name);
  }
  Variable(const Variable&) = delete;
  Variable& operator=(const Variable&) = delete;

private:
  const char* m_name;
  std::optional<std::string> m_before;
};

} // namespace

// Another library never takes its place silently.
TEST(DefaultFolder, IsTheChosenOneWhichMustBeThere)
{
  namespace fs = std::filesystem;
  const test::TemporaryFolder folder;
  const Variable settings("XDG_CONFIG_HOME", folder.path() / "settings");
  const Variable data("XDG_DATA_HOME", folder.path() / "data");
  EXPECT_EQ(defaultFolder(), folder.path() / "data/petrous");
  const fs::path chosen = folder.path() / "on a disk";
  chooseDefaultFolder(chosen);
  EXPECT_TRUE(fs::is_directory(chosen));
  EXPECT_EQ(defaultFolder(), chosen);
  fs::remove(chosen);
  const auto [reason, words] = test::refusal([] { defaultFolder(); });
  EXPECT_EQ(reason, LibraryError::Reason::NotFound);
  EXPECT_NE(words.find(chosen.string()), std::string::npos) << words;
  EXPECT_NE(words.find("connect its disk"), std::string::npos) << words;
  for (const char* own : {"cases", "objects"})
    fs::create_directories(folder.path() / "library" / own);
  std::ofstream(folder.path() / "library/.lock");
  for (const char* within : {"library/objects", "library/cases/Left ear"})
    EXPECT_NE(test::refusal([&] { chooseDefaultFolder(folder.path() / within); })
                  .second.find("keeps its own data there"),
              std::string::npos)
        << within;
  EXPECT_FALSE(fs::exists(folder.path() / "library/cases/Left ear"));
  chooseDefaultFolder(folder.path() / "library");
  EXPECT_EQ(defaultFolder(), folder.path() / "library");
  chooseDefaultFolder({});
  EXPECT_EQ(defaultFolder(), usualFolder());
  std::ofstream(defaultFolderFile()) << "relative";
  EXPECT_EQ(test::refusal([] { defaultFolder(); }).first, LibraryError::Reason::Damaged);
  chooseDefaultFolder(usualFolder());
  EXPECT_FALSE(fs::exists(defaultFolderFile()));
  EXPECT_EQ(defaultFolder(), usualFolder());
}
