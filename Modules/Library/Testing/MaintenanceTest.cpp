#include <gtest/gtest.h>

#include <chrono>
#include <map>
#include <set>
#include <thread>
#include <utility>

#include <fcntl.h>
#include <nlohmann/json.hpp>
#include <sqlite3.h>
#include <sys/file.h>
#include <sys/stat.h>

#include "TestCase.h"
#include "petrous/Library/Journal.h"
#include "petrous/Library/ObjectStore.h"
#include "petrous/Scene/Manifest.h"

using namespace petrous;
using namespace petrous::library;
using test::contentOf;
using test::drill;
using test::refusal;
using test::smallCase;
using test::TemporaryFolder;

namespace
{

namespace fs = std::filesystem;

class Maintenance : public ::testing::Test
{
protected:
  scene::Case make(const std::string& name, int n = 16)
  {
    return test::savedCase(m_library, name, n);
  }

  void flipBit(const fs::path& file, std::uintmax_t at) const
  {
    std::fstream stream(file, std::ios::binary | std::ios::in | std::ios::out);
    stream.seekg(static_cast<std::streamoff>(at));
    const char byte = static_cast<char>(stream.get() ^ 4);
    stream.seekp(static_cast<std::streamoff>(at));
    stream.put(byte);
  }

  fs::path object(const std::string& name) const { return m_folder.path() / "objects" / name; }
  fs::path manifest(const std::string& name) const
  {
    return m_folder.path() / "cases" / (name + ".json");
  }

  TemporaryFolder m_folder;
  Library m_library{m_folder.path()};
};

} // namespace

TEST_F(Maintenance, ACaseGoesByTheNameOfItsFile)
{
  make("a");
  fs::copy(manifest("a"), manifest("b"));
  scene::Case copy = m_library.open("b");
  EXPECT_EQ(copy.name, "b");
  copy.iso = 500;
  m_library.save(copy);
  EXPECT_EQ(m_library.open("a").iso, 300);
  EXPECT_EQ(m_library.open("b").iso, 500);
  ASSERT_EQ(m_library.list().size(), 2u);
  EXPECT_EQ(m_library.list()[1].name, "b");
}

TEST_F(Maintenance, RenamesWithoutTouchingAnotherCase)
{
  scene::Case value = make("a");
  drill(value, {8, 8, 8});
  m_library.save(value);
  make("b");
  const auto before = contentOf(m_folder.path());
  EXPECT_EQ(refusal([&] { m_library.rename("a", "b"); }).first, LibraryError::Reason::NameTaken);
  EXPECT_EQ(refusal([&] { m_library.rename("x", "y"); }).first, LibraryError::Reason::NotFound);
  EXPECT_THROW(m_library.rename("a", "../x"), core::InvalidParameter);
  EXPECT_EQ(contentOf(m_folder.path()), before);
  m_library.rename("a", "c");
  EXPECT_FALSE(m_library.contains("a"));
  EXPECT_EQ(m_library.open("c").dissection.strokes().size(), 1u);
  EXPECT_EQ(m_library.list().at(1).name, "c");
}

// A program that opened it under its old name writes no second case, whatever became of that name.
TEST_F(Maintenance, ARenamedCaseIsSavedUnderItsNewName)
{
  std::string told;
  m_library.onNotice([&told](const std::string& notice) { told = notice; });
  scene::Case value = make("a");
  const std::string id = value.id;
  m_library.rename("a", "b");
  make("a", 20);
  m_library.remove("a");
  // Under its own name, that of another case and that of none.
  for (const char* name : {"", "b", "a", "z"})
    EXPECT_EQ(m_library.deletedName(id, name), "") << "another case was deleted; " << name;
  value.iso = 250;
  m_library.save(value);
  EXPECT_EQ(value.name, "b");
  EXPECT_NE(told.find("its new name, 'b'"), std::string::npos) << told;
  ASSERT_EQ(m_library.list().size(), 1u);
  EXPECT_EQ(m_library.open("b").iso, 250);

  // Where another case has the old name.
  m_library.rename("b", "c");
  make("b", 20);
  value.iso = 260;
  m_library.save(value);
  EXPECT_EQ(value.name, "c");
  EXPECT_EQ(m_library.open("c").iso, 260);
  EXPECT_EQ(m_library.open("b").ct.geometry.dims()[0], 20);

  // A copy is another case.
  m_library.copy("c", "copy");
  m_library.remove("c");
  EXPECT_EQ(refusal([&] { m_library.save(value); }).first, LibraryError::Reason::Conflict);
  for (const char* name : {"", "c", "b"}) // of the deleted one, and that of another case
    EXPECT_EQ(m_library.deletedName(id, name), "c") << name;
}

// Of hundreds of cases whose manifests are known, none is read to find one by its ID.
TEST_F(Maintenance, CasesAreFoundByTheirIdInTheCatalogue)
{
  const std::string id = make("a").id;
  const std::string other = make("b").id;
  m_library.remove("a");
  ASSERT_EQ(m_library.deletedName(id), "a");
  const fs::path path = manifest("b");
  std::string text;
  {
    std::ifstream file(path, std::ios::binary);
    text.assign(std::istreambuf_iterator<char>(file), {});
  }
  EXPECT_EQ(m_library.deletedName(other, "b"), "") << "asked itself";
  const std::size_t at = text.find(other);
  ASSERT_NE(at, std::string::npos);
  ASSERT_EQ(id.size(), other.size());
  text.replace(at, other.size(), id);
  const auto written = fs::last_write_time(path);
  std::ofstream(path, std::ios::binary) << text;
  fs::last_write_time(path, written);
  EXPECT_EQ(m_library.deletedName(id), "a") << "the catalogue knows the manifest";
  fs::last_write_time(path, written + std::chrono::seconds(1));
  EXPECT_EQ(m_library.deletedName(id), "") << "it changed since, and was read";
}

TEST_F(Maintenance, ACaseThatWasRenamedAndChangedIsNotOverwritten)
{
  scene::Case value = make("a");
  m_library.rename("a", "b");
  scene::Case theirs = m_library.open("b");
  theirs.iso = 250;
  m_library.save(theirs);
  value.iso = 260;
  const auto [reason, text] = refusal([&] { m_library.save(value); });
  EXPECT_EQ(reason, LibraryError::Reason::Conflict);
  EXPECT_NE(text.find("renamed 'b' and changed"), std::string::npos) << text;
  EXPECT_EQ(value.name, "a");
  EXPECT_EQ(m_library.open("b").iso, 250);
}

TEST_F(Maintenance, OfTwoDeletedCasesOfOneNameTheOneOfTheIdComesBack)
{
  scene::Case value = make("a");
  m_library.remove("a");
  make("a", 20);
  const auto [taken, why] = refusal([&] { m_library.save(value); });
  EXPECT_EQ(taken, LibraryError::Reason::Conflict);
  EXPECT_NE(why.find("deleted by another program since it was opened, and another case"),
            std::string::npos)
      << why;
  m_library.remove("a");
  const auto [reason, text] = refusal([&] { m_library.save(value); });
  EXPECT_EQ(reason, LibraryError::Reason::Conflict);
  EXPECT_NE(text.find("bring it back"), std::string::npos) << text;
  EXPECT_EQ(m_library.deletedName(value.id), "a");
  m_library.undelete("a", value.id);
  EXPECT_EQ(m_library.deletedName(value.id), "");
  EXPECT_EQ(m_library.open("a").ct.geometry.dims()[0], 16) << "and not the one deleted last";
  m_library.save(value);
  EXPECT_EQ(m_library.open("a").revision, value.revision);
}

TEST_F(Maintenance, ACopyIsACaseOfItsOwnAndSharesTheObjects)
{
  scene::Case value = make("a");
  drill(value, {8, 8, 8});
  m_library.save(value);
  const std::size_t objects = m_library.verify().objects;
  m_library.copy("a", "b");
  EXPECT_EQ(m_library.verify().objects, objects);
  scene::Case copy = m_library.open("b");
  EXPECT_EQ(copy.dissection.strokes().size(), 1u);
  EXPECT_EQ(copy.revision, 1u);
  copy.dissection.undo();
  m_library.save(copy);
  EXPECT_EQ(m_library.open("a").applied(), 1u);
  EXPECT_EQ(refusal([&] { m_library.copy("a", "b"); }).first, LibraryError::Reason::NameTaken);
}

TEST_F(Maintenance, ADamagedCaseCanBeRenamedAndRemovedAndMadeAgain)
{
  make("a");
  std::ofstream(manifest("a")) << "{";
  EXPECT_TRUE(m_library.list().at(0).damaged);
  m_library.rename("a", "b");
  EXPECT_EQ(m_library.list().at(0).name, "b");
  m_library.remove("b");
  EXPECT_TRUE(m_library.list().empty());
  EXPECT_NO_THROW(make("b"));
  EXPECT_EQ(m_library.open("b").iso, 300);
}

// The revision alone would match that of the opened case.
TEST_F(Maintenance, DoesNotOverwriteACaseThatTookTheNameOfADeletedOne)
{
  scene::Case value = make("a");
  m_library.remove("a");
  make("a", 20);
  ASSERT_EQ(m_library.open("a").revision, value.revision);
  EXPECT_EQ(refusal([&] { m_library.save(value); }).first, LibraryError::Reason::Conflict);
  EXPECT_EQ(m_library.open("a").ct.geometry.dims()[0], 20);
}

TEST_F(Maintenance, ACaseThatIsBeingDrilledIsNeitherRenamedNorRemoved)
{
  scene::Case value = make("a");
  Journal journal(m_library, value);
  journal.claim();
  Library other(m_folder.path());
  for (const auto& words :
       {refusal([&] { other.rename("a", "b"); }), refusal([&] { other.remove("a"); }),
        refusal([&] { Journal second(other, value); })})
  {
    EXPECT_EQ(words.first, LibraryError::Reason::Conflict);
    EXPECT_NE(words.second.find("is being drilled by another process"), std::string::npos);
  }
}

// Under another name the content of the journal would never be recovered.
TEST_F(Maintenance, ACaseIsNotRenamedAwayFromAJournalThatCannotBeBroughtBack)
{
  scene::Case value = make("a");
  drill(value, {8, 8, 8});
  m_library.save(value);
  {
    Journal journal(m_library, value);
    drill(value, {4, 8, 8});
    journal.follow(value.dissection);
    journal.leave();
  }
  const fs::path stroke = object(value.dissection.strokes()[0]->object);
  fs::rename(stroke, m_folder.path() / "gone");
  const auto before = contentOf(m_folder.path());
  const auto [reason, words] = refusal([&] { m_library.rename("a", "b"); });
  EXPECT_EQ(reason, LibraryError::Reason::Conflict);
  EXPECT_NE(words.find("open the case first"), std::string::npos) << words;
  EXPECT_EQ(contentOf(m_folder.path()), before);
  fs::rename(m_folder.path() / "gone", stroke);
  m_library.rename("a", "b");
  EXPECT_EQ(m_library.open("b").dissection.strokes().size(), 2u);
}

// A process that only inspects the journal, as on opening the case, does not count as drilling.
TEST_F(Maintenance, WhoLooksAtAJournalIsNotTakenForOneWhoDrills)
{
  make("a");
  const fs::path journal = m_folder.path() / "cases/a.journal";
  std::ofstream(journal) << "";
  bool refused = true;
  for (int n = 0; n < 50 && refused; ++n) // on a loaded machine the other may wait for long
  {
    const int other = ::open(journal.c_str(), O_RDWR);
    ASSERT_EQ(::flock(other, LOCK_EX), 0);
    std::thread looking(
        [other]
        {
          ::usleep(10000);
          ::close(other);
        });
    try
    {
      m_library.refuseWhereDrilled("a");
      refused = false;
    }
    catch (const LibraryError&)
    {
    }
    looking.join();
  }
  EXPECT_FALSE(refused);
}

TEST_F(Maintenance, DeletionTakesJournalsAlong)
{
  scene::Case value = make("a");
  Journal journal(m_library, value);
  drill(value, {8, 8, 8});
  journal.follow(value.dissection);
  journal.leave();
  std::ofstream(m_folder.path() / "cases/a.journal.aside-1") << "x";
  m_library.remove("a");
  EXPECT_NO_THROW(make("a")) << "no journal is in its way";
  EXPECT_EQ(m_library.open("a").dissection.strokes().size(), 0u);
  m_library.remove("a");
  m_library.collectGarbage();
  EXPECT_TRUE(fs::is_empty(m_folder.path() / "cases"));
}

TEST_F(Maintenance, ADeletedCaseComesBackWithWhatWasNotSaved)
{
  scene::Case value = make("a");
  Journal journal(m_library, value);
  drill(value, {8, 8, 8});
  journal.follow(value.dissection);
  journal.leave();
  std::ofstream(m_folder.path() / "cases/a.journal.aside-1") << "x";
  const auto before = contentOf(m_folder.path());
  m_library.remove("a");
  EXPECT_TRUE(m_library.list().empty());
  EXPECT_TRUE(m_library.search("a").empty());
  EXPECT_EQ(refusal([&] { m_library.open("a"); }).first, LibraryError::Reason::NotFound);
  EXPECT_TRUE(m_library.verify().damaged.empty());
  const auto deleted = m_library.deleted();
  ASSERT_EQ(deleted.size(), 1u);
  EXPECT_EQ(deleted[0].name, "a");
  EXPECT_EQ(deleted[0].deleted.size(), 20u) << deleted[0].deleted;

  m_library.undelete("a");
  EXPECT_EQ(contentOf(m_folder.path()), before);
  EXPECT_TRUE(m_library.deleted().empty());
  EXPECT_EQ(m_library.open("a").dissection.strokes().size(), 1u);
  EXPECT_EQ(refusal([&] { m_library.undelete("a"); }).first, LibraryError::Reason::NotFound);
}

// "x.journal" is a name too, and not the journal of case "x".
TEST_F(Maintenance, ADeletedCaseThatIsNamedAsAJournalComesBack)
{
  for (const std::string name : {"x.journal", "x.journal.aside-1", "x.json"})
  {
    make("x");
    make(name);
    m_library.remove(name);
    ASSERT_EQ(m_library.deleted().size(), 1u) << name;
    EXPECT_EQ(m_library.deleted()[0].name, name);
    m_library.remove("x");
    m_library.undelete("x");
    EXPECT_NO_THROW(m_library.open("x")) << name;
    m_library.undelete(name);
    EXPECT_NO_THROW(m_library.open(name)) << name;
    EXPECT_TRUE(m_library.deleted().empty()) << name;
    m_library.remove(name);
    m_library.collectGarbage();
    EXPECT_TRUE(m_library.deleted().empty()) << name;
    m_library.remove("x");
    m_library.collectGarbage();
  }
}

// Nor is its manifest a journal that was set aside.
TEST_F(Maintenance, ACaseThatIsNamedAsAJournalStaysWhereAnotherIsDeleted)
{
  for (const std::string name : {"x.journal.aside-1", "x.journal", "x.journal.new"})
  {
    make("x");
    make(name);
    m_library.rename("x", "y");
    m_library.remove("y");
    make("x");
    m_library.remove("x");
    m_library.collectGarbage();
    ASSERT_EQ(m_library.list().size(), 1u) << name;
    EXPECT_NO_THROW(m_library.open(name));
    m_library.remove(name);
    m_library.collectGarbage();
  }
}

// A kill between the removal of a manifest and that of its journals.
TEST_F(Maintenance, WhatWasDrilledInADeletedCaseIsCollectedAfterAKill)
{
  const fs::path cases = m_folder.path() / "cases";
  const auto drilled = [this](const std::string& name)
  {
    scene::Case value = make(name);
    Journal journal(m_library, value);
    drill(value, {8, 8, 8});
    journal.follow(value.dissection);
    journal.leave();
  };
  drilled("a");
  m_library.remove("a");
  fs::remove(cases / "a.json.deleted-1");
  std::ofstream(cases / "a.journal.aside-2.deleted-1") << "x";
  std::ofstream(cases / "a.journal.new.deleted-1") << "x";
  ASSERT_TRUE(fs::exists(cases / "a.journal.deleted-1"));
  // Another case of that name does not take it for its own.
  make("a", 20);
  m_library.remove("a");
  m_library.undelete("a");
  EXPECT_FALSE(fs::exists(cases / "a.journal"));
  m_library.remove("a");
  m_library.collectGarbage();
  EXPECT_TRUE(fs::is_empty(cases));

  // The same where the deletion was killed.
  drilled("b");
  m_library.remove("b");
  fs::rename(cases / "b.journal.deleted-1", cases / "b.journal");
  drilled("c");
  m_library.collectGarbage();
  EXPECT_FALSE(fs::exists(cases / "b.journal"));
  EXPECT_EQ(m_library.open("c").dissection.strokes().size(), 1u);

  // Alone.
  m_library.remove("c");
  m_library.collectGarbage();
  std::ofstream(cases / "c.journal.deleted-1") << "x";
  m_library.collectGarbage();
  EXPECT_TRUE(fs::is_empty(cases));
}

TEST_F(Maintenance, TheCaseOfANameThatWasDeletedLastComesBackFirst)
{
  for (const int n : {16, 20, 24})
  {
    make("ear.1", n);
    m_library.remove("ear.1");
  }
  make("ear.1", 28);
  EXPECT_EQ(refusal([&] { m_library.undelete("ear.1"); }).first, LibraryError::Reason::NameTaken);
  m_library.rename("ear.1", "ear");
  for (const int n : {24, 20, 16})
  {
    m_library.undelete("ear.1");
    EXPECT_EQ(m_library.open("ear.1").ct.geometry.dims()[0], n);
    m_library.rename("ear.1", "ear " + std::to_string(n));
  }
  EXPECT_EQ(m_library.list().size(), 4u);
  EXPECT_EQ(m_library.collectGarbage().objects, 0u);
  EXPECT_TRUE(m_library.verify().damaged.empty());
}

TEST_F(Maintenance, WhatIsCollectedCannotComeBack)
{
  make("a");
  const auto objects = ObjectStore(m_folder.path() / "objects").list();
  m_library.remove("a");
  EXPECT_EQ(ObjectStore(m_folder.path() / "objects").list(), objects);
  const Collected removed = m_library.collectGarbage();
  EXPECT_EQ(removed.cases, 1u);
  EXPECT_EQ(removed.objects, objects.size());
  EXPECT_EQ(refusal([&] { m_library.undelete("a"); }).first, LibraryError::Reason::NotFound);
}

// Killed between the two renames of a deletion: the journal is still in its place.
TEST_F(Maintenance, AJournalThatADeletionLeftBehindBelongsToTheCaseThatComesBack)
{
  scene::Case value = make("a");
  Journal journal(m_library, value);
  drill(value, {8, 8, 8});
  journal.follow(value.dissection);
  journal.leave();
  m_library.remove("a");
  fs::rename(m_folder.path() / "cases/a.journal.deleted-1", m_folder.path() / "cases/a.journal");
  m_library.undelete("a");
  EXPECT_EQ(m_library.open("a").dissection.strokes().size(), 1u);
}

TEST_F(Maintenance, OneFlippedBitOfAnyObjectIsFound)
{
  scene::Case value = make("a");
  drill(value, {8, 8, 8});
  m_library.save(value);
  EXPECT_TRUE(m_library.verify().damaged.empty());
  struct Part
  {
    std::string object, words;
    std::function<void(scene::Case&)> read;
  };
  const Part parts[] = {{value.ct.object, "the CT of case 'a'",
                         [this](scene::Case& c)
                         {
                           c.ct.volume.get();
                           m_library.checkVoxels(c);
                         }},
                        {value.labels[0].object, "'nerve' of case 'a'",
                         [](scene::Case& c) { c.labels[0].labels.get(); }},
                        {value.meshes[0].object, "mesh 'incus' of case 'a'",
                         [](scene::Case& c) { c.meshes[0].mesh.get(); }},
                        {value.dissection.strokes()[0]->object, "stroke 1 of case 'a'",
                         [this](scene::Case& c) { m_library.loadDissection(c); }}};
  for (const Part& part : parts)
  {
    const fs::path file = object(part.object);
    const std::uintmax_t at = fs::file_size(file) * 2 / 3;
    flipBit(file, at);
    Library fresh(m_folder.path());
    scene::Case damaged = fresh.open("a");
    m_library = fresh;
    const auto [reason, words] = refusal([&] { part.read(damaged); });
    EXPECT_EQ(reason, LibraryError::Reason::Damaged);
    EXPECT_NE(words.find(part.words), std::string::npos) << words;
    const Inspection found = fresh.verify();
    ASSERT_EQ(found.damaged.size(), 1u) << part.words;
    EXPECT_EQ(found.damaged[0].object, part.object);
    EXPECT_EQ(found.damaged[0].cases, std::vector<std::string>{"a"});
    flipBit(file, at);
    EXPECT_TRUE(Library(m_folder.path()).verify().damaged.empty());
  }
}

TEST_F(Maintenance, AMappedImageIsCheckedBehindTheReadersBack)
{
  const scene::Case value = make("a");
  flipBit(object(value.ct.object), fs::file_size(object(value.ct.object)) - 100);
  const Library fresh(m_folder.path());
  const scene::Case damaged = fresh.open("a");
  damaged.ct.volume.get();
  for (int n = 0; n < 1000 && fresh.damageFound(damaged).empty(); ++n)
    ::usleep(10000);
  ASSERT_EQ(fresh.damageFound(damaged).size(), 1u);
  EXPECT_EQ(refusal([&] { fresh.checkAllRead(); }).first, LibraryError::Reason::Damaged);
  const scene::Case other = make("another", 18);
  EXPECT_TRUE(fresh.damageFound(other).empty()) << "that is of its own";
}

TEST_F(Maintenance, OnlyWhatIsReadIsHeldAgainstItsHash)
{
  const scene::Case value = make("a");
  flipBit(object(value.ct.object), fs::file_size(object(value.ct.object)) - 100);
  const Library fresh(m_folder.path());
  const scene::Case damaged = fresh.open("a");
  EXPECT_NO_THROW(fresh.checkVoxels(damaged));
  EXPECT_NO_THROW(fresh.checkAllRead());
}

TEST_F(Maintenance, AnObjectThatIsRestoredIsReadAgain)
{
  const scene::Case value = make("a");
  const fs::path file = object(value.ct.object);
  flipBit(file, fs::file_size(file) - 100);
  const Library fresh(m_folder.path());
  const scene::Case damaged = fresh.open("a");
  damaged.ct.volume.get();
  EXPECT_EQ(refusal([&] { fresh.checkVoxels(damaged); }).first, LibraryError::Reason::Damaged);
  flipBit(file, fs::file_size(file) - 100);
  const scene::Case restored = fresh.open("a");
  restored.ct.volume.get();
  EXPECT_NO_THROW(fresh.checkVoxels(restored));
  EXPECT_TRUE(fresh.damageFound(restored).empty());
}

// Importing the same CT again repairs the library, whichever cases use it.
TEST_F(Maintenance, AnImportReplacesADamagedObject)
{
  const scene::Case value = make("a");
  flipBit(object(value.ct.object), fs::file_size(object(value.ct.object)) - 100);
  EXPECT_FALSE(m_library.verify().damaged.empty());
  make("b");
  EXPECT_TRUE(m_library.verify().damaged.empty());
}

TEST_F(Maintenance, VerifyNamesMissingObjectsAndDamagedManifests)
{
  const scene::Case value = make("a");
  make("b", 20);
  fs::remove(object(value.meshes[0].object));
  std::ofstream(manifest("b")) << "{";
  const Inspection found = m_library.verify();
  EXPECT_EQ(found.cases, 2u);
  ASSERT_EQ(found.damaged.size(), 2u);
  EXPECT_EQ(found.damaged[0].object, "cases/b.json");
  EXPECT_EQ(found.damaged[1].object, value.meshes[0].object);
}

TEST_F(Maintenance, RemovesWhatNoCaseNeedsAndNothingElse)
{
  const scene::Case a = make("a");
  const scene::Case b = make("b", 20);
  EXPECT_EQ(m_library.collectGarbage().objects, 0u);
  m_library.remove("b");
  std::ofstream(m_folder.path() / "objects/.petrous-0123") << "left";
  const Collected removed = m_library.collectGarbage();
  EXPECT_GT(removed.objects, 0u);
  EXPECT_FALSE(fs::exists(object(b.ct.object)));
  EXPECT_FALSE(fs::exists(m_folder.path() / "objects/.petrous-0123"));
  EXPECT_TRUE(m_library.verify().damaged.empty());
  EXPECT_NO_THROW(m_library.open("a").ct.volume.get());
}

TEST_F(Maintenance, CollectsNothingWhileACaseCannotBeRead)
{
  make("a");
  make("b", 20);
  const auto objects = ObjectStore(m_folder.path() / "objects").list();
  std::ofstream(manifest("b")) << "{";
  EXPECT_EQ(refusal([&] { m_library.collectGarbage(); }).first, LibraryError::Reason::Damaged);
  EXPECT_EQ(ObjectStore(m_folder.path() / "objects").list(), objects);
}

// A window still has the deleted case open.
TEST_F(Maintenance, WhatWasCollectedIsStoredAgainFromMemory)
{
  make("a");
  Library window(m_folder.path());
  scene::Case open = window.open("a");
  open.ct.volume.get();
  open.labels[0].labels.get();
  open.meshes[0].mesh.get();
  m_library.remove("a");
  m_library.collectGarbage();
  open.name = "a again";
  open.revision = 0;
  window.save(open);
  EXPECT_TRUE(window.verify().damaged.empty());
}

TEST_F(Maintenance, SearchesCaseAndPartNames)
{
  make("Left ear");
  make("right");
  EXPECT_EQ(m_library.search("EAR").size(), 1u);
  EXPECT_EQ(m_library.search("incus").size(), 2u);
  EXPECT_TRUE(m_library.search("cochlea").empty());
  EXPECT_EQ(m_library.search("incus ear").size(), 1u) << "both words";
  make("\u00dcbung \u00d7 2");
  EXPECT_EQ(m_library.search("\u00fcBUNG").size(), 1u);
  EXPECT_EQ(m_library.search("\u00d7").size(), 1u);
  // The index of an older or newer program is made anew.
  for (const char* version : {"0", "99"})
  {
    sqlite3* database = nullptr;
    ASSERT_EQ(sqlite3_open((m_folder.path() / "library.sqlite").c_str(), &database), SQLITE_OK);
    const std::string change = "DROP TABLE cases; CREATE TABLE cases (name TEXT PRIMARY KEY); "
                               "INSERT INTO cases VALUES ('x'); PRAGMA user_version = " +
                               std::string(version);
    ASSERT_EQ(sqlite3_exec(database, change.c_str(), nullptr, nullptr, nullptr), SQLITE_OK);
    sqlite3_close(database);
    EXPECT_EQ(m_library.search("incus").size(), 3u);
    make("more " + std::string(version));
    m_library.remove("more " + std::string(version));
    EXPECT_EQ(m_library.search("incus").size(), 3u);
  }
}

TEST_F(Maintenance, ASearchTellsTheTagsOfAllCases)
{
  for (const char* name : {"a", "b"})
  {
    make(name);
    Description description;
    description.tags = {std::string("tag ") + name};
    m_library.describe(name, description);
  }
  CaseFilter filter;
  filter.text = "b";
  std::set<std::string> tags;
  ASSERT_EQ(m_library.search(filter, tags).size(), 1u);
  EXPECT_EQ(tags, (std::set<std::string>{"tag a", "tag b"}));
}

TEST_F(Maintenance, WhatAListReadsOfManifestsGoesIntoTheIndex)
{
  make("a");
  make("b");
  const fs::path index = m_folder.path() / "library.sqlite";
  const auto isIndexed = [&index](const std::string& name)
  {
    sqlite3* database = nullptr;
    EXPECT_EQ(sqlite3_open(index.c_str(), &database), SQLITE_OK);
    int rows = 0;
    const auto count = [](void* rows_, int, char** values, char**)
    {
      *static_cast<int*>(rows_) = std::atoi(values[0]);
      return 0;
    };
    EXPECT_EQ(sqlite3_exec(database,
                           ("SELECT count(*) FROM cases WHERE name = '" + name + "'").c_str(),
                           count, &rows, nullptr),
              SQLITE_OK);
    sqlite3_close(database);
    return rows == 1;
  };
  sqlite3* database = nullptr;
  ASSERT_EQ(sqlite3_open(index.c_str(), &database), SQLITE_OK);
  ASSERT_EQ(sqlite3_exec(database, "DELETE FROM cases WHERE name = 'b'", nullptr, nullptr, nullptr),
            SQLITE_OK);
  sqlite3_close(database);
  ASSERT_FALSE(isIndexed("b"));
  EXPECT_EQ(m_library.list().size(), 2U);
  EXPECT_TRUE(isIndexed("b"));
  // A list makes no file.
  fs::remove(index);
  EXPECT_EQ(m_library.list().size(), 2U);
  EXPECT_FALSE(fs::exists(index));
}

TEST_F(Maintenance, RepairBringsStrokesBackAndMakesTheIndexAgain)
{
  scene::Case value = make("a");
  Journal journal(m_library, value);
  drill(value, {8, 8, 8});
  journal.follow(value.dissection);
  journal.leave();
  std::ofstream(m_folder.path() / "library.sqlite") << "no database";
  const Repaired repaired = m_library.repair();
  EXPECT_EQ(repaired.done.size(), 2u);
  EXPECT_TRUE(repaired.lost.empty());
  EXPECT_EQ(m_library.open("a").dissection.strokes().size(), 1u);
  std::ifstream index(m_folder.path() / "library.sqlite", std::ios::binary);
  std::string magic(6, ' ');
  index.read(magic.data(), 6);
  EXPECT_EQ(magic, "SQLite");
}

// Each of these would block on opening.
TEST_F(Maintenance, PipesAmongTheFilesAreNotWaitedFor)
{
  const scene::Case value = make("a");
  ASSERT_EQ(::mkfifo(manifest("pipe").c_str(), 0600), 0);
  EXPECT_TRUE(m_library.list().at(1).damaged);
  EXPECT_THROW(m_library.open("pipe"), LibraryError);
  m_library.remove("pipe");
  ASSERT_EQ(::mkfifo((m_folder.path() / "cases/a.journal").c_str(), 0600), 0);
  std::string told;
  m_library.onNotice([&told](const std::string& words) { told = words; });
  EXPECT_EQ(m_library.open("a").name, "a");
  EXPECT_NE(told.find("not a regular file"), std::string::npos) << told;
  fs::remove(m_folder.path() / "cases/a.journal");
  fs::remove(object(value.ct.object));
  ASSERT_EQ(::mkfifo(object(value.ct.object).c_str(), 0600), 0);
  EXPECT_THROW(m_library.open("a").ct.volume.get(), core::Error);
  fs::remove(m_folder.path() / "library.sqlite");
  ASSERT_EQ(::mkfifo((m_folder.path() / "library.sqlite").c_str(), 0600), 0);
  EXPECT_EQ(m_library.list().size(), 1u);
}

// `immutable` ignores locks, and so reads half-written data.
TEST_F(Maintenance, TheIndexIsNotReadWhileSomebodyWritesIt)
{
  make("a");
  sqlite3* database = nullptr;
  const std::string file = (m_folder.path() / "library.sqlite").string();
  ASSERT_EQ(sqlite3_open(file.c_str(), &database), SQLITE_OK);
  ASSERT_EQ(sqlite3_exec(database,
                         "BEGIN EXCLUSIVE; UPDATE cases SET strokes = 77, structures = 77", nullptr,
                         nullptr, nullptr),
            SQLITE_OK);
  ASSERT_EQ(sqlite3_db_cacheflush(database), SQLITE_OK); // written to the file, but not committed
  EXPECT_EQ(m_library.list().at(0).strokes, 0u) << "from the manifest";
  sqlite3_exec(database, "ROLLBACK", nullptr, nullptr, nullptr);
  sqlite3_close(database);
  EXPECT_EQ(m_library.list().at(0).structures, 1u);
}

// The former name may be a patient's; the index deletes its rows with what they held.
TEST_F(Maintenance, ARenamedCaseHasItsFormerNameNowhere)
{
  scene::Case value = make("Zyx4711Wvu");
  drill(value, {8, 8, 8});
  m_library.save(value);
  m_library.list();
  const auto hasName = [this]
  {
    for (const auto& entry : fs::recursive_directory_iterator(m_folder.path()))
    {
      if (entry.path().filename().string().find("Zyx4711Wvu") != std::string::npos)
        return true;
      if (!entry.is_regular_file())
        continue;
      std::ifstream file(entry.path(), std::ios::binary);
      const std::string bytes{std::istreambuf_iterator<char>(file), {}};
      if (bytes.find("Zyx4711Wvu") != std::string::npos)
        return true;
    }
    return false;
  };
  ASSERT_TRUE(hasName()) << "looked for at the right place";
  m_library.rename("Zyx4711Wvu", "ear");
  EXPECT_FALSE(hasName());
  EXPECT_EQ(m_library.open("ear").dissection.strokes().size(), 1u);
  EXPECT_EQ(m_library.open("ear").revision, value.revision);
  EXPECT_TRUE(m_library.verify().damaged.empty());
}

// As the window names them; others are the user's own.
TEST_F(Maintenance, RecordingsLoseTheFormerNameToo)
{
  const fs::path folder = m_folder.path() / "recordings";
  fs::create_directory(folder);
  make("Doe");
  make("Doe 2");
  for (const char* file :
       {"Doe 2026-03-01 09-30-00.ticks", "Doe 2026-03-01 09-30-00 (2).ticks",
        "Doe 2 2026-03-01 09-30-00.ticks", "Doe and others.ticks", "ear 2026-03-01 09-30-00.ticks"})
    std::ofstream(folder / file) << file;
  const auto files = [&folder]
  {
    std::map<std::string, std::string> all;
    for (const auto& entry : fs::directory_iterator(folder))
    {
      std::ifstream stream(entry.path());
      std::getline(stream, all[entry.path().filename().string()]);
    }
    return all;
  };
  m_library.rename("Doe", "ear");
  std::set<std::string> contents;
  for (const auto& [name, content] : files())
  {
    EXPECT_TRUE(name.rfind("ear ", 0) == 0 || content == name) << name;
    contents.insert(content);
  }
  EXPECT_EQ(contents.size(), 5u) << "none replaced another";
  m_library.remove("Doe 2");
  EXPECT_TRUE(fs::exists(folder / "Doe 2 2026-03-01 09-30-00.ticks")) << "it may come back";
  m_library.collectGarbage();
  EXPECT_TRUE(fs::exists(folder / "2026-03-01 09-30-00.ticks"));
  EXPECT_EQ(files().size(), 5u);
}

TEST_F(Maintenance, ADeletedCaseThatCannotComeBackIsFoundAndStaysDeleted)
{
  make("a");
  make("b", 20);
  m_library.remove("a");
  const fs::path deleted = m_folder.path() / "cases/a.json.deleted-1";
  ASSERT_TRUE(fs::exists(deleted));
  std::ofstream(deleted) << "{";
  const Inspection found = m_library.verify();
  ASSERT_EQ(found.damaged.size(), 1u);
  EXPECT_EQ(found.cases, 1u);
  EXPECT_EQ(found.damaged[0].object, "cases/a.json.deleted-1");
  EXPECT_EQ(found.damaged[0].deletedCases, std::vector<std::string>{"a"});
  EXPECT_TRUE(found.damaged[0].cases.empty());
  const auto before = contentOf(m_folder.path());
  EXPECT_EQ(refusal([&] { m_library.undelete("a"); }).first, LibraryError::Reason::Damaged);
  EXPECT_EQ(contentOf(m_folder.path()), before);
  EXPECT_NO_THROW(m_library.collectGarbage());
  EXPECT_TRUE(m_library.verify().damaged.empty());
}

TEST_F(Maintenance, DamageNamesAllCasesThatNeedTheFileDeletedOnesToo)
{
  const scene::Case value = make("a");
  m_library.copy("a", "b");
  m_library.copy("a", "c");
  m_library.remove("c");
  flipBit(object(value.ct.object), fs::file_size(object(value.ct.object)) - 100);
  const Inspection found = m_library.verify();
  ASSERT_EQ(found.damaged.size(), 1u);
  EXPECT_EQ(found.damaged[0].cases, (std::vector<std::string>{"a", "b"}));
  EXPECT_EQ(found.damaged[0].deletedCases, std::vector<std::string>{"c"});
  EXPECT_NE(found.damaged[0].text.find("needed by: 'a', 'b', 'c' (deleted)"), std::string::npos)
      << found.damaged[0].text;
  m_library.remove("a");
  m_library.remove("b");
  const Inspection deleted = m_library.verify();
  ASSERT_EQ(deleted.damaged.size(), 1u) << "it could come back";
  EXPECT_TRUE(deleted.damaged[0].cases.empty());
  EXPECT_NE(deleted.damaged[0].text.find("deleted case"), std::string::npos)
      << deleted.damaged[0].text;
}

// Another program deletes a case while its files are read.
TEST_F(Maintenance, WhatIsDeletedMeanwhileIsNotDamage)
{
  make("a");
  make("b", 20);
  bool done = false;
  const core::Progress progress(
      [this, &done](double, const std::string&)
      {
        if (std::exchange(done, true))
          return;
        Library other(m_folder.path());
        other.remove("a");
        other.remove("b");
        other.collectGarbage();
      });
  const Inspection found = m_library.verify(progress);
  EXPECT_TRUE(done);
  EXPECT_TRUE(found.damaged.empty()) << found.damaged[0].text;
}

// A manifest that was copied by hand: what may be in its name is no text for a terminal.
TEST_F(Maintenance, AFileWhoseNameNoCaseCanHaveIsTold)
{
  make("a");
  fs::copy(manifest("a"), manifest("b\nc"));
  const Inspection found = m_library.verify();
  ASSERT_EQ(found.damaged.size(), 1U);
  EXPECT_NE(found.damaged[0].text.find("b?c.json: "), std::string::npos) << found.damaged[0].text;
  EXPECT_EQ(found.damaged[0].text.find('\n'), std::string::npos);
  const Repaired repaired = m_library.repair();
  EXPECT_TRUE(repaired.lost.empty());
  ASSERT_EQ(repaired.done.size(), 2U);
  EXPECT_EQ(repaired.done[0], found.damaged[0].text);
  EXPECT_EQ(repaired.done[1], "the index holds 1 of 2 cases");
}

TEST_F(Maintenance, AManifestThatIsNoneCannotBeRepaired)
{
  make("a");
  make("b");
  std::ofstream(manifest("b")).close(); // empty
  const Repaired repaired = m_library.repair();
  ASSERT_EQ(repaired.lost.size(), 1U);
  EXPECT_NE(repaired.lost[0].find("b.json"), std::string::npos) << repaired.lost[0];
  EXPECT_EQ(repaired.done, std::vector<std::string>{"the index holds 1 of 2 cases"});
}

TEST_F(Maintenance, AManifestThatLeadsToNoFileCannotBeRepaired)
{
  make("a");
  fs::create_symlink(m_folder.path() / "nowhere.json", manifest("b"));
  fs::create_directory(manifest("c"));
  fs::create_symlink(manifest("a"), manifest("d")); // to a case
  const Repaired repaired = m_library.repair();
  ASSERT_EQ(repaired.lost.size(), 2U);
  EXPECT_NE(repaired.lost[0].find("b.json"), std::string::npos) << repaired.lost[0];
  EXPECT_NE(repaired.lost[1].find("c.json"), std::string::npos) << repaired.lost[1];
  EXPECT_EQ(repaired.done, std::vector<std::string>{"the index holds 2 of 4 cases"});
}

// Without permission to look, nothing is known to be lost.
TEST_F(Maintenance, WhereTheObjectsCannotBeReadNothingIsCalledLost)
{
  make("a");
  const fs::path objects = m_folder.path() / "objects";
  fs::rename(objects, m_folder.path() / "kept");
  std::ofstream(objects) << "no folder";
  const auto [reason, text] = refusal([this] { m_library.repair(); });
  EXPECT_EQ(reason, LibraryError::Reason::Damaged);
  EXPECT_NE(text.find("cannot be read"), std::string::npos) << text;
  EXPECT_EQ(text.find("missing"), std::string::npos) << text;
}

TEST_F(Maintenance, ALostImageIsSaidAndComesBackWithTheSameImport)
{
  const scene::Case value = make("a");
  m_library.copy("a", "b");
  EXPECT_TRUE(m_library.lost(value).empty());
  fs::remove(object(value.ct.object));
  const auto lost = m_library.lost(m_library.open("a"));
  ASSERT_EQ(lost.size(), 1u);
  EXPECT_NE(lost[0].find("the CT of case 'a' is missing"), std::string::npos) << lost[0];
  const Repaired repaired = m_library.repair();
  EXPECT_EQ(repaired.lost.size(), 2u) << "of each case that needs it";
  make("c");
  EXPECT_TRUE(m_library.repair().lost.empty());
  EXPECT_NO_THROW(m_library.open("a").ct.volume.get());
}

TEST_F(Maintenance, CleaningUpAndRepairingCanBeCancelledAtAnyStep)
{
  for (const char* name : {"a", "b", "c"})
    make(name, 16 + name[0] % 8);
  m_library.remove("a");
  const auto cancelledAfter = [](int reports)
  {
    auto token = std::make_shared<core::CancelToken>();
    return core::Progress(
        [token, left = std::make_shared<int>(reports)](double, const std::string&)
        {
          if (--*left <= 0)
            token->cancel();
        },
        token);
  };
  const auto before = contentOf(m_folder.path());
  EXPECT_THROW(m_library.repair(cancelledAfter(1)), core::CancelledError);
  EXPECT_THROW(m_library.collectGarbage(cancelledAfter(1)), core::CancelledError);
  EXPECT_THROW(m_library.collectGarbage(cancelledAfter(2)), core::CancelledError);
  EXPECT_EQ(contentOf(m_folder.path()), before) << "while cases are read, nothing is removed";
  // Then it goes on where it was.
  int runs = 0;
  for (bool isDone = false; !isDone; ++runs)
  {
    ASSERT_LT(runs, 20);
    try
    {
      m_library.collectGarbage(cancelledAfter(3 + runs));
      isDone = true;
    }
    catch (const core::CancelledError&)
    {
      EXPECT_TRUE(m_library.verify().damaged.empty());
    }
  }
  EXPECT_GT(runs, 1);
  EXPECT_EQ(m_library.collectGarbage().objects, 0u);
  EXPECT_TRUE(m_library.deleted().empty());
  EXPECT_EQ(m_library.repair().done.back(), "the index holds 2 of 2 cases");
}

// Another program holds the lock: it ends only when the user wants.
TEST_F(Maintenance, WaitingForTheLibraryCanBeCancelledAndChangesNothing)
{
  scene::Case value = make("a");
  const auto before = contentOf(m_folder.path());
  const int other = ::open((m_folder.path() / ".lock").c_str(), O_RDWR);
  ASSERT_EQ(::flock(other, LOCK_EX), 0);
  auto token = std::make_shared<core::CancelToken>();
  std::string said;
  const core::Progress progress(
      [&](double, const std::string& text)
      {
        said = text;
        token->cancel();
      },
      token);
  value.iso = 500;
  EXPECT_THROW(m_library.save(value, progress), core::CancelledError);
  EXPECT_EQ(said, "another program is using the library");
  EXPECT_THROW(m_library.collectGarbage(progress), core::CancelledError);
  Library told(m_folder.path());
  int calls = 0;
  told.onWait(
      [&calls](double)
      {
        if (++calls >= 2)
          throw core::CancelledError("waiting");
      });
  EXPECT_THROW(told.rename("a", "b"), core::CancelledError);
  EXPECT_THROW(told.remove("a"), core::CancelledError);
  EXPECT_EQ(contentOf(m_folder.path()), before);
  ::close(other);
  EXPECT_NO_THROW(m_library.save(value));
}

// A copy is made to be kept when the original goes.
TEST_F(Maintenance, ACopyThatWaitedIsRefusedWhereTheOriginalIsGone)
{
  make("a");
  make("b", 20);
  int other = ::open((m_folder.path() / ".lock").c_str(), O_RDWR);
  ASSERT_EQ(::flock(other, LOCK_EX), 0);
  Library waiting(m_folder.path());
  waiting.onWait(
      [&](double)
      {
        ::close(std::exchange(other, -1));
        m_library.remove("a");
        m_library.collectGarbage();
      });
  const auto [reason, words] = refusal([&] { waiting.copy("a", "twin"); });
  EXPECT_EQ(reason, LibraryError::Reason::NotFound) << words;
  EXPECT_FALSE(m_library.contains("twin"));
  EXPECT_TRUE(m_library.verify().damaged.empty());
}

TEST_F(Maintenance, ACopyThatWaitedIsOfTheCaseAsItIsThen)
{
  scene::Case value = make("a");
  int other = ::open((m_folder.path() / ".lock").c_str(), O_RDWR);
  ASSERT_EQ(::flock(other, LOCK_EX), 0);
  Library waiting(m_folder.path());
  waiting.onWait(
      [&](double)
      {
        ::close(std::exchange(other, -1));
        value.iso = 512;
        m_library.save(value);
      });
  waiting.copy("a", "twin");
  EXPECT_EQ(m_library.open("twin").iso, 512);
}

// A window has a case open that another program removed for good; its CT was never read there.
TEST_F(Maintenance, ANewCaseIsNotSavedWithoutWhatItNeeds)
{
  make("a");
  scene::Case value = m_library.open("a");
  value.labels[0].labels.get();
  value.meshes[0].mesh.get();
  m_library.remove("a");
  m_library.collectGarbage();
  value.name = "b";
  value.revision = 0;
  const auto before = contentOf(m_folder.path());
  const auto [reason, words] = refusal([&] { m_library.save(value); });
  EXPECT_EQ(reason, LibraryError::Reason::NotFound);
  EXPECT_NE(words.find("the CT"), std::string::npos) << words;
  EXPECT_EQ(words.find("incus"), std::string::npos) << "in memory: " << words;
  EXPECT_FALSE(m_library.contains("b"));
  EXPECT_EQ(contentOf(m_folder.path()), before);
}

// As undo of a removal does, after the objects were collected or deleted by hand.
TEST_F(Maintenance, APartThatComesBackIsStoredFromMemoryOrRefused)
{
  make("a");
  scene::Case value = m_library.open("a");
  const scene::MeshPart unread = value.meshes[0];
  scene::Case other = m_library.open("a");
  scene::MeshPart read = other.meshes[0];
  read.mesh.get();
  value.meshes.clear();
  m_library.save(value);
  fs::remove(object(unread.object));
  const auto before = contentOf(m_folder.path());

  scene::Case with = value;
  with.meshes.push_back(unread);
  const auto [reason, words] = refusal([&] { m_library.save(with); });
  EXPECT_EQ(reason, LibraryError::Reason::NotFound);
  EXPECT_NE(words.find("mesh 'incus'"), std::string::npos) << words;
  EXPECT_EQ(contentOf(m_folder.path()), before);
  EXPECT_EQ(with.revision, value.revision);

  with = value;
  with.meshes.push_back(read);
  m_library.save(with);
  EXPECT_TRUE(m_library.verify().damaged.empty());
  EXPECT_EQ(m_library.open("a").meshes[0].mesh.get()->triangles.size(), 4U);
}

// What is drilled in a damaged case is not lost with what it lost before.
TEST_F(Maintenance, ACaseThatWasDamagedBeforeIsSavedAlsoUnderAnotherName)
{
  make("a");
  scene::Case value = m_library.open("a");
  fs::remove(object(value.meshes[0].object));
  value.iso = 512.0;
  m_library.save(value);
  EXPECT_EQ(m_library.open("a").iso, 512.0);
  value.name = "b";
  value.revision = 0;
  m_library.save(value);
  EXPECT_EQ(m_library.lost(m_library.open("b")).size(), 1U);
}

namespace
{

class ChangedManifests : public Maintenance
{
protected:
  void SetUp() override
  {
    scene::Case value = test::smallCase("a", 16);
    scene::ImagePart mr = test::smallCase("mr", 20).ct;
    mr.name = "T2";
    mr.registered = true;
    mr.mrFromCt = {Eigen::Quaterniond(0.8, 0.6, 0.0, 0.0), {12.5, -3.0, 40.0}};
    value.mr.push_back(std::move(mr));
    m_library.save(value);
    m_library.onNotice([this](const std::string& words) { m_told.push_back(words); });
  }

  std::string text() const
  {
    std::ifstream file(manifest("a"), std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
  }

  void write(const std::string& text) const
  {
    std::ofstream(manifest("a"), std::ios::binary) << text;
  }

  static std::string sumOf(const std::string& text)
  {
    return sha256Of(reinterpret_cast<const std::uint8_t*>(text.data()), text.size());
  }

  /// As another program would lay the manifest out, with a checksum that is right.
  void writeSealed(nlohmann::json all) const
  {
    all.erase("sha256");
    all["sha256"] = sumOf(all.dump(1) + "\n");
    write(all.dump());
  }

  std::vector<std::string> m_told;
};

} // namespace

TEST_F(ChangedManifests, AreToldByASumOfAllTheRest)
{
  const std::string before = text();
  const std::string member = ",\n \"sha256\": \"" + std::string(64, '0') + "\"";
  const std::size_t at = before.find(member.substr(0, 14));
  ASSERT_NE(at, before.npos);
  std::string rest = before;
  rest.erase(at, member.size());
  EXPECT_EQ(before.substr(at + member.size() - 65, 64), sumOf(rest));
  EXPECT_NO_THROW(scene::fromManifest(rest, "a")) << "as a program that does not know it";
  EXPECT_TRUE(m_library.verify().damaged.empty());

  // Only its layout; and as older programs wrote it.
  write(nlohmann::json::parse(before).dump());
  EXPECT_TRUE(m_library.verify().damaged.empty());
  write(rest);
  EXPECT_TRUE(m_library.verify().damaged.empty());
  m_library.open("a");
  EXPECT_TRUE(m_told.empty());
}

TEST_F(ChangedManifests, OfAnyBitOfANumberOrWordAreNamedAndOpenWithANotice)
{
  const std::string sound = text();
  const std::string sum = "\"sha256\": \"";
  for (const std::string& place :
       {std::string("12."), std::string("\"max\": 139"), std::string("\"name\": \"ner"),
        std::string("\"iso_hu\": "), sum})
  {
    // The last bit of the character after it.
    const std::size_t found = sound.find(place);
    ASSERT_NE(found, sound.npos) << place;
    const std::size_t at = found + place.size();
    std::string changed = sound;
    changed[at] ^= 1;
    write(changed);
    const auto damaged = m_library.verify().damaged;
    ASSERT_EQ(damaged.size(), 1U) << place;
    EXPECT_EQ(damaged[0].object, "cases/a.json");
    EXPECT_EQ(damaged[0].cases, std::vector<std::string>{"a"});
    EXPECT_NE(damaged[0].text.find("checksum"), std::string::npos) << damaged[0].text;
    m_told.clear();
    EXPECT_NO_THROW(m_library.open("a")) << place;
    ASSERT_EQ(m_told.size(), 1U) << place;
    EXPECT_NE(m_told[0].find("changed outside of Petrous, or is damaged"), std::string::npos);
  }
  m_library.remove("a");
  const Inspection found = m_library.verify();
  ASSERT_EQ(found.damaged.size(), 1U);
  EXPECT_EQ(found.damaged[0].deletedCases, std::vector<std::string>{"a"});
}

TEST_F(ChangedManifests, AreKeptAsTheyAreOnlyWhereThatIsWanted)
{
  std::string changed = text();
  changed.replace(changed.find("12.5"), 4, "13.5");
  write(changed);
  EXPECT_NE(m_library.repair().done.at(0).find("--accept-changed"), std::string::npos);
  EXPECT_EQ(text(), changed);
  EXPECT_EQ(m_library.verify().damaged.size(), 1U);
  m_library.repair({}, true);
  EXPECT_TRUE(m_library.verify().damaged.empty());
  m_told.clear();
  EXPECT_EQ(m_library.open("a").mr[0].mrFromCt.translation()[0], 13.5);
  EXPECT_TRUE(m_told.empty());
}

TEST_F(ChangedManifests, RenamedCasesHaveTheirSum)
{
  m_library.rename("a", "b");
  std::ifstream file(manifest("b"), std::ios::binary);
  const std::string renamed{std::istreambuf_iterator<char>(file), {}};
  EXPECT_NE(renamed.find("\"sha256\""), renamed.npos);
  EXPECT_TRUE(m_library.verify().damaged.empty());
}

// Whoever changed it made the sum anew.
TEST_F(ChangedManifests, AnImageThatLiesElsewhereThanItsVoxelsSayIsNamed)
{
  const auto sound = nlohmann::json::parse(text());
  for (const bool isMr : {false, true})
  {
    nlohmann::json changed = sound;
    nlohmann::json& image = isMr ? changed["mr"][0] : changed["ct"];
    image["grid"]["origin_mm"][1] = image["grid"]["origin_mm"][1].get<double>() + 10.0;
    writeSealed(changed);
    const std::string words =
        std::string(isMr ? "MR 'T2'" : "the CT") + " of case 'a' does not lie where its voxels say";
    const Inspection found = m_library.verify();
    ASSERT_EQ(found.damaged.size(), 1U);
    EXPECT_EQ(found.damaged[0].object, "cases/a.json");
    EXPECT_NE(found.damaged[0].text.find(words), std::string::npos) << found.damaged[0].text;
    m_told.clear();
    EXPECT_NO_THROW(m_library.open("a"));
    ASSERT_EQ(m_told.size(), 1U);
    EXPECT_NE(m_told[0].find(words), std::string::npos) << m_told[0];
  }
  writeSealed(sound);
  EXPECT_TRUE(m_library.verify().damaged.empty());
}
