#include <atomic>
#include <cerrno>
#include <csignal>
#include <thread>

#include <gtest/gtest.h>

#include <sys/mman.h>
#include <sys/resource.h>
#include <sys/wait.h>

#include "../../Core/Testing/SystemCalls.h"
#include "../src/Journal/JournalFile.h"
#include "TestCase.h"
#include "petrous/Library/Journal.h"
#include "petrous/Library/ObjectStore.h"
#include "petrous/Scene/Branches.h"

using namespace petrous;
using namespace petrous::library;
using test::contentOf;
using test::savedCase;
using test::smallCase;
using test::TemporaryFolder;

namespace
{

namespace fs = std::filesystem;

std::vector<std::uint16_t> voxelsOf(const scene::Case& value)
{
  const auto dense = value.dissection.mask().dense();
  return {dense.data(), dense.data() + dense.size()};
}

// One step of 0.5 s of a stroke along a line of voxels.
void drillStep(scene::Case& value, int step, int line)
{
  const auto at = [&](double i) {
    return value.ct.geometry.patientFromVoxel({2.0 + i, 3.0 + line, 4.0 + line});
  };
  value.dissection.cut({at(step), at(step + 1), 0.7});
  value.dissection.openInfo().duration += 0.5;
}

void drillLine(scene::Case& value, Journal& journal, int line, int steps)
{
  value.dissection.beginStroke({});
  for (int step = 0; step < steps; ++step)
  {
    drillStep(value, step, line);
    journal.follow(value.dissection);
  }
  value.dissection.endStroke();
  journal.follow(value.dissection);
}

// The result of a kill: the files as they are now, in a separate library.
struct Killed
{
  TemporaryFolder folder;
  std::vector<std::string> notices;
  Library library{folder.path()};

  explicit Killed(const Library& other)
  {
    fs::copy(other.folder(), folder.path(), fs::copy_options::recursive);
    library.onNotice([this](const std::string& words) { notices.push_back(words); });
  }
  fs::path journal() const { return folder.path() / "cases/ear.journal"; }
  scene::Case open()
  {
    scene::Case value = library.open("ear");
    library.loadDissection(value);
    return value;
  }
};

/// A case with a stroke that is in its journal and not saved.
struct JournalOfAStroke : ::testing::Test
{
  TemporaryFolder folder;
  Library library{folder.path()};
  scene::Case value = savedCase(library);
  Journal journal{library, value};

  JournalOfAStroke() { drillLine(value, journal, 0, 4); }
};

} // namespace

TEST_F(JournalOfAStroke, BringsBackStrokesThatWereNotSaved)
{
  drillLine(value, journal, 3, 4);
  value.dissection.undo();
  journal.follow(value.dissection);
  drillLine(value, journal, 6, 4);

  Killed killed(library);
  EXPECT_EQ(killed.library.unrecovered(), std::vector<std::string>{"ear"});
  const scene::Case back = killed.open();
  EXPECT_EQ(voxelsOf(back), voxelsOf(value));
  EXPECT_EQ(library.unrecovered(), std::vector<std::string>()) << "its program runs";
  EXPECT_EQ(killed.library.unrecovered(), std::vector<std::string>()) << "it is recovered";
  EXPECT_EQ(back.dissection.strokes().size(), 3u);
  EXPECT_EQ(back.applied(), 2u);
  EXPECT_TRUE(back.dissection.history().find("main~1"));
  EXPECT_FALSE(back.dissection.strokes()[2]->info.recovered) << "it had ended";
  EXPECT_FALSE(fs::exists(killed.journal()));
  ASSERT_EQ(killed.notices.size(), 1u);
  EXPECT_NE(killed.notices[0].find("3 strokes came back"), std::string::npos) << killed.notices[0];
  // From now on it is an ordinary case.
  const auto content = contentOf(killed.folder.path());
  EXPECT_EQ(voxelsOf(killed.open()), voxelsOf(value));
  EXPECT_EQ(contentOf(killed.folder.path()), content);
  EXPECT_EQ(killed.notices.size(), 1u);
}

// The disk is full in the middle of a frame, and the file cannot be cut back at once.
TEST(Journal, WhatFollowsAFailedAppendIsNotLost)
{
  const TemporaryFolder folder;
  const fs::path path = folder.path() / "a.journal";
  const auto frame = [](const std::string& text) {
    return encoded(JournalFrame{JournalFrame::Kind::History, text, {}});
  };
  JournalHead head;
  head.caseName = "a";
  JournalFile journal(path, head);
  journal.append(frame("first"));
  const std::size_t size = journal.size();

  rlimit limit = {};
  ASSERT_EQ(::getrlimit(RLIMIT_FSIZE, &limit), 0);
  const rlimit full = {size + 20, limit.rlim_max};
  const auto before = std::signal(SIGXFSZ, SIG_IGN);
  ASSERT_EQ(::setrlimit(RLIMIT_FSIZE, &full), 0);
  petrous::testing::SystemCalls::fail("ftruncate", 1, EIO);
  EXPECT_THROW(journal.append(frame("lost")), LibraryError);
  ASSERT_EQ(::setrlimit(RLIMIT_FSIZE, &limit), 0);
  std::signal(SIGXFSZ, before);
  EXPECT_EQ(fs::file_size(path), size + 20) << "else this tests nothing";

  petrous::testing::SystemCalls::fail("ftruncate", 1, EIO);
  EXPECT_THROW(journal.append(frame("refused")), LibraryError);
  petrous::testing::SystemCalls::reset();
  journal.append(frame("second"));
  const JournalContent content = journalFrom(journal.read());
  ASSERT_EQ(content.frames.size(), 2U);
  EXPECT_EQ(content.frames[1].text, "second");
  EXPECT_EQ(content.leftOver, 0U);
  EXPECT_EQ(fs::file_size(path), journal.size());
}

TEST(Journal, LosesAtMostFiveSecondsOfALongStroke)
{
  const TemporaryFolder folder;
  Library library(folder.path());
  scene::Case value = savedCase(library);
  Journal journal(library, value,
                  [](const dissection::Dissection& work)
                  {
                    auto info = work.openInfo();
                    info.removed = info.duration; // 1 mm^3 per s
                    return info;
                  });
  value.dissection.beginStroke({});
  std::vector<std::vector<std::uint16_t>> states;
  for (int step = 0; step < 34; ++step)
  {
    drillStep(value, step % 17, step / 17 * 6);
    states.push_back(voxelsOf(value));
    journal.follow(value.dissection);
  }
  Killed killed(library); // after 17 s
  const scene::Case back = killed.open();
  EXPECT_TRUE(voxelsOf(back) == states[26]) << "of 13.5 s: written every 4.5 s";
  ASSERT_EQ(back.dissection.strokes().size(), 1u);
  EXPECT_TRUE(back.dissection.strokes()[0]->info.recovered);
  EXPECT_DOUBLE_EQ(back.dissection.strokes()[0]->info.duration, 13.5);
  EXPECT_DOUBLE_EQ(back.dissection.strokes()[0]->info.removed, 13.5);
  EXPECT_NE(killed.notices.at(0).find(" s of a stroke"), std::string::npos);
}

TEST(Journal, IsThereOnlyWhileSomethingIsNotSaved)
{
  const TemporaryFolder folder;
  Library library(folder.path());
  scene::Case value = savedCase(library);
  const auto before = contentOf(folder.path());
  const fs::path path = folder.path() / "cases/ear.journal";
  {
    Journal journal(library, value);
    journal.follow(value.dissection);
    EXPECT_EQ(contentOf(folder.path()), before);
    drillLine(value, journal, 0, 3);
    EXPECT_TRUE(fs::exists(path));
    EXPECT_EQ(journal.bytes(), fs::file_size(path));
    library.save(value);
    journal.saved(value);
    EXPECT_FALSE(fs::exists(path));
    drillLine(value, journal, 3, 3);
    EXPECT_TRUE(fs::exists(path));
  }
  EXPECT_FALSE(fs::exists(path)) << "the session ended in order";
}

// Another thread continues drilling while the case is being saved.
TEST_F(JournalOfAStroke, KeepsWhatWasDrilledSinceTheSavedState)
{
  scene::Case snapshot = value;
  snapshot.dissection.unload();
  drillLine(value, journal, 3, 4);
  value.dissection.beginStroke({});
  for (int step = 0; step < 11; ++step)
  {
    drillStep(value, step, 6);
    journal.follow(value.dissection);
  }
  const std::size_t all = journal.bytes();
  library.save(snapshot);
  Killed between(library); // both manifest and journal have the first stroke
  journal.saved(snapshot);
  EXPECT_LT(journal.bytes(), all);
  Killed after(library);
  const auto expected = voxelsOf(between.open());
  EXPECT_EQ(voxelsOf(after.open()), expected);
  const scene::Case back = after.open();
  EXPECT_EQ(back.dissection.strokes().size(), 3u);
  EXPECT_TRUE(back.dissection.strokes()[2]->info.recovered);
  for (auto* killed : {&between, &after})
    for (const auto& [name, content] : contentOf(killed->folder.path()))
      EXPECT_EQ(name.find("journal"), std::string::npos) << name;
}

TEST_F(JournalOfAStroke, IsLeftAloneWhileItsProgramRuns)
{
  const auto before = contentOf(folder.path());
  scene::Case other = library.open("ear");
  EXPECT_EQ(other.dissection.strokes().size(), 0u);
  EXPECT_EQ(contentOf(folder.path()), before);
  library.loadDissection(other);
  try
  {
    Journal second(library, other);
    FAIL();
  }
  catch (const LibraryError& error)
  {
    EXPECT_EQ(error.reason, LibraryError::Reason::Conflict);
  }
}

TEST_F(JournalOfAStroke, OfAnotherStateOfTheCaseIsSetAsideAndNamed)
{
  Killed killed(library);
  {
    // Another program, unaware of journals, puts another case there.
    const TemporaryFolder elsewhere;
    Library other(elsewhere.path());
    scene::Case another = smallCase("ear", 20);
    other.save(another);
    for (const auto* part : {"cases", "objects"})
      fs::copy(elsewhere.path() / part, killed.folder.path() / part,
               fs::copy_options::recursive | fs::copy_options::overwrite_existing);
  }
  EXPECT_EQ(killed.open().dissection.strokes().size(), 0u);
  ASSERT_EQ(killed.notices.size(), 1u);
  EXPECT_NE(killed.notices[0].find("ear.journal.aside-1"), std::string::npos) << killed.notices[0];
  EXPECT_TRUE(fs::exists(killed.folder.path() / "cases/ear.journal.aside-1"));
  EXPECT_EQ(killed.library.list().size(), 1u);
}

// The case is open and nothing is drilled yet when another program renames it.
TEST(Journal, IsMadeUnderTheNameThatItsCaseHasByNow)
{
  const TemporaryFolder folder;
  Library library(folder.path());
  scene::Case value = savedCase(library);
  Journal journal(library, value);
  Library other(folder.path());
  other.rename("ear", "left ear");
  drillLine(value, journal, 0, 4);
  EXPECT_TRUE(fs::exists(folder.path() / "cases/left ear.journal"));
  EXPECT_FALSE(fs::exists(folder.path() / "cases/ear.journal"));
  EXPECT_EQ(test::refusal([&] { other.rename("left ear", "ear"); }).first,
            LibraryError::Reason::Conflict)
      << "it is drilled";
  {
    const Killed killed(library);
    EXPECT_EQ(killed.library.unrecovered(), std::vector<std::string>{"left ear"});
    scene::Case back = killed.library.open("left ear");
    killed.library.loadDissection(back);
    EXPECT_EQ(voxelsOf(back), voxelsOf(value));
  }
  // A save goes on with the new name, and takes the journal's place.
  scene::Case snapshot = value;
  snapshot.dissection.unload();
  drillLine(value, journal, 3, 4);
  library.save(snapshot);
  ASSERT_EQ(snapshot.name, "left ear");
  journal.saved(snapshot);
  const Killed after(library);
  scene::Case back = after.library.open("left ear");
  after.library.loadDissection(back);
  EXPECT_EQ(voxelsOf(back), voxelsOf(value));
  EXPECT_EQ(back.dissection.strokes().size(), 2u);
}

TEST_F(JournalOfAStroke, StaysWithTheOriginalOfAManifestThatWasCopiedByHand)
{
  Killed killed(library);
  const fs::path cases = killed.folder.path() / "cases";
  fs::copy_file(cases / "ear.json", cases / "ear backup.json");
  EXPECT_EQ(killed.library.open("ear backup").dissection.strokes().size(), 0u);
  EXPECT_TRUE(fs::exists(killed.journal()));
  killed.library.remove("ear backup");
  EXPECT_TRUE(fs::exists(killed.journal()));
  EXPECT_EQ(voxelsOf(killed.open()), voxelsOf(value));
}

// As if the case was renamed just when the journal was made, or moved there by hand.
TEST_F(JournalOfAStroke, IsFoundByTheIdOfItsCase)
{
  const fs::path misplaced = "cases/old name.journal";
  const auto killedAt = [&](const std::string& name)
  {
    auto killed = std::make_unique<Killed>(library);
    fs::rename(killed->journal(), killed->folder.path() / misplaced);
    fs::rename(killed->folder.path() / "cases/ear.json",
               killed->folder.path() / "cases" / (name + ".json"));
    return killed;
  };
  const auto strokes = [](const Library& where, const std::string& name)
  { return where.open(name).dissection.strokes().size(); };

  const auto opened = killedAt("ear");
  EXPECT_EQ(opened->library.unrecovered(), std::vector<std::string>{"ear"});
  EXPECT_EQ(voxelsOf(opened->open()), voxelsOf(value));
  EXPECT_FALSE(fs::exists(opened->folder.path() / misplaced));
  ASSERT_EQ(opened->notices.size(), 1u);
  EXPECT_NE(opened->notices[0].find("1 stroke came back"), std::string::npos);

  const auto copied = killedAt("left ear");
  copied->library.copy("left ear", "copy");
  EXPECT_EQ(strokes(copied->library, "copy"), 1u);
  EXPECT_EQ(strokes(copied->library, "left ear"), 1u);

  const auto renamed = killedAt("left ear");
  renamed->library.rename("left ear", "right ear");
  EXPECT_EQ(strokes(renamed->library, "right ear"), 1u);

  // A new case gets the old name; what was drilled stays with the other.
  const auto taken = killedAt("left ear");
  savedCase(taken->library, "old name");
  EXPECT_EQ(strokes(taken->library, "old name"), 0u);
  EXPECT_EQ(strokes(taken->library, "left ear"), 1u);
  EXPECT_EQ(strokes(taken->library, "old name"), 0u);

  const auto deleted = killedAt("left ear");
  deleted->library.remove("left ear");
  savedCase(deleted->library, "old name");
  savedCase(deleted->library, "left ear");
  EXPECT_EQ(strokes(deleted->library, "old name"), 0u);
  EXPECT_EQ(strokes(deleted->library, "left ear"), 0u);
  deleted->library.remove("left ear");
  deleted->library.undelete("left ear", value.id);
  EXPECT_EQ(strokes(deleted->library, "left ear"), 1u);

  const auto collected = killedAt("left ear");
  collected->library.remove("left ear");
  fs::rename(collected->folder.path() / "cases/old name.journal.deleted-1",
             collected->folder.path() / misplaced); // killed in between
  savedCase(collected->library, "left ear");
  collected->library.collectGarbage();
  EXPECT_FALSE(fs::exists(collected->folder.path() / misplaced));
  const auto kept = killedAt("left ear");
  savedCase(kept->library, "old name");
  kept->library.remove("old name");
  kept->library.collectGarbage();
  EXPECT_EQ(strokes(kept->library, "left ear"), 1u);
}

// Both cases have the same CT, revision and no strokes: by its content, it would fit either.
TEST(Journal, OfADeletedCaseIsNotThatOfTheNextOneOfItsName)
{
  const TemporaryFolder folder;
  Library library(folder.path());
  scene::Case value = savedCase(library);
  Journal journal(library, value);
  Library other(folder.path());
  other.remove("ear");
  scene::Case next = savedCase(other);
  ASSERT_EQ(next.ct.object, value.ct.object);
  ASSERT_EQ(next.revision, value.revision);
  drillLine(value, journal, 0, 4);
  EXPECT_EQ(other.open("ear").dissection.strokes().size(), 0u);
  EXPECT_NO_THROW(other.refuseWhereDrilled("ear")) << "it is the other that is drilled";
  Journal nextJournal(other, next);
  drillLine(next, nextJournal, 3, 4);
  drillLine(next, nextJournal, 6, 4);

  Killed killed(library);
  EXPECT_EQ(voxelsOf(killed.open()), voxelsOf(next));
  killed.library.rename("ear", "next");
  killed.library.undelete("ear");
  EXPECT_EQ(voxelsOf(killed.open()), voxelsOf(value));
  EXPECT_EQ(killed.library.open("next").dissection.strokes().size(), 2u);
}

// What cannot be saved where it lies is told, and stays for the time when it can.
TEST_F(JournalOfAStroke, UnderAnotherNameStaysInALibraryThatCannotBeWritten)
{
  Killed killed(library);
  const fs::path misplaced = killed.folder.path() / "cases/old name.journal";
  fs::rename(killed.journal(), misplaced);
  fs::rename(killed.folder.path() / "objects", killed.folder.path() / "gone");
  std::ofstream(killed.folder.path() / "objects") << "a file stands here";
  EXPECT_EQ(killed.library.open("ear").dissection.strokes().size(), 0u);
  EXPECT_NE(killed.notices.at(0).find("old name.journal"), std::string::npos) << killed.notices[0];
  EXPECT_TRUE(fs::exists(misplaced));
  fs::remove(killed.folder.path() / "objects");
  fs::rename(killed.folder.path() / "gone", killed.folder.path() / "objects");
  EXPECT_EQ(voxelsOf(killed.open()), voxelsOf(value));
}

TEST_F(JournalOfAStroke, ADamagedEndCostsOnlyTheEnd)
{
  const auto first = voxelsOf(value);
  const std::size_t good = journal.bytes();
  drillLine(value, journal, 3, 4);
  for (const std::size_t size : {good, good + 1, good + 50, good + 300, journal.bytes() - 1})
  {
    Killed killed(library);
    fs::resize_file(killed.journal(), size);
    const scene::Case back = killed.open();
    EXPECT_EQ(back.dissection.strokes().size() == 2 ? voxelsOf(value) : first, voxelsOf(back))
        << size;
    EXPECT_EQ(killed.notices.at(0).find("not whole") == std::string::npos, size == good);
  }
}

TEST_F(JournalOfAStroke, OneThatFitsNothingIsSetAside)
{
  const std::string bytes = contentOf(folder.path()).at("cases/ear.journal");
  const auto content = journalFrom(bytes);
  const auto expectAside = [&](const std::string& journalBytes)
  {
    Killed killed(library);
    std::ofstream(killed.journal(), std::ios::binary) << journalBytes;
    EXPECT_EQ(killed.open().dissection.strokes().size(), 0u);
    EXPECT_EQ(contentOf(killed.folder.path()).at("cases/ear.journal.aside-1"), journalBytes);
    EXPECT_EQ(killed.notices.size(), 1u);
  };
  JournalFrame stroke = content.frames.at(0);
  const std::string head = encoded(content.head);
  expectAside(head + encoded(stroke) + encoded(stroke)); // removes the same voxels twice
  stroke.text = "{}";
  expectAside(head + encoded(stroke));
  stroke = content.frames[0];
  stroke.bytes.resize(7);
  expectAside(head + encoded(stroke));
  JournalHead other = content.head;
  other.caseId = std::string(32, '0');
  expectAside(encoded(other) + bytes.substr(head.size()));
  other.caseId.clear(); // as an older program wrote it
  other.caseName = "eye";
  expectAside(encoded(other) + bytes.substr(head.size()));
  expectAside(std::string(1000, 'x'));
  JournalFrame history = content.frames.at(1);
  history.text.replace(history.text.find("\"parents\":[0]"), 13, "\"parents\":[7]");
  expectAside(head + encoded(content.frames[0]) + encoded(history));
}

TEST_F(JournalOfAStroke, SurvivesTenThousandDamagedFiles)
{
  drillLine(value, journal, 3, 12);
  const std::string bytes = contentOf(folder.path()).at("cases/ear.journal");
  const std::size_t frames = journalFrom(bytes).frames.size();
  std::mt19937 random(7);
  for (int n = 0; n < 10000; ++n)
  {
    std::string damaged = bytes;
    if (random() % 2)
      damaged.resize(random() % damaged.size());
    for (std::size_t flips = random() % 3; flips > 0 && !damaged.empty(); --flips)
      damaged[random() % damaged.size()] ^= static_cast<char>(1U << random() % 8);
    const auto content = journalFrom(damaged);
    EXPECT_LE(content.frames.size(), frames);
    EXPECT_EQ(content.frames.size() == frames, damaged == bytes);
    if (n % 100 != 0)
      continue;
    Killed killed(library);
    std::ofstream(killed.journal(), std::ios::binary) << damaged;
    ASSERT_NO_THROW(killed.open());
  }
}

// A file size limit simulates a full disk.
TEST_F(JournalOfAStroke, AFullDiskIsToldAndARetryWorks)
{
  const std::string before = contentOf(folder.path()).at("cases/ear.journal");
  rlimit unlimited{};
  ::getrlimit(RLIMIT_FSIZE, &unlimited);
  const auto handler = std::signal(SIGXFSZ, SIG_IGN);
  rlimit full = unlimited;
  full.rlim_cur = before.size() + 100;
  ::setrlimit(RLIMIT_FSIZE, &full);
  std::string words;
  try
  {
    drillLine(value, journal, 3, 4);
  }
  catch (const LibraryError& error)
  {
    EXPECT_EQ(error.reason, LibraryError::Reason::DiskFull);
    words = error.what();
  }
  const std::string then = contentOf(folder.path()).at("cases/ear.journal");
  ::setrlimit(RLIMIT_FSIZE, &unlimited);
  std::signal(SIGXFSZ, handler);
  EXPECT_NE(words.find("disk is full"), std::string::npos) << words;
  EXPECT_EQ(then, before);
  EXPECT_EQ(value.dissection.strokes().size(), 2u) << "the stroke is still there";
  journal.follow(value.dissection);
  Killed killed(library);
  EXPECT_EQ(voxelsOf(killed.open()), voxelsOf(value));
}

TEST_F(JournalOfAStroke, WhatCannotBeBroughtBackNowStays)
{
  Killed killed(library);
  fs::rename(killed.folder.path() / "objects", killed.folder.path() / "gone");
  std::ofstream(killed.folder.path() / "objects") << "a file stands here";
  EXPECT_EQ(killed.library.open("ear").dissection.strokes().size(), 0u);
  EXPECT_NE(killed.notices.at(0).find("stays there"), std::string::npos);
  fs::remove(killed.folder.path() / "objects");
  fs::rename(killed.folder.path() / "gone", killed.folder.path() / "objects");
  EXPECT_EQ(voxelsOf(killed.open()), voxelsOf(value));
}

namespace
{

// A scripted drilling sequence: strokes of 1 to 17 steps of half a second, saves, undo, redo,
// branches. Deterministic; `each` is called with the drilling time in s after every change.
template <class Each>
void session(Library& library, scene::Case& value, Each each)
{
  Journal journal(library, value);
  std::mt19937 random(99);
  double seconds = 0.0;
  const auto changed = [&]
  {
    journal.follow(value.dissection);
    each(seconds, value);
  };
  for (int stroke = 0; seconds < 120.0; ++stroke)
  {
    value.dissection.beginStroke({});
    const int length = 1 + static_cast<int>(random() % 17);
    for (int n = 0; n < length; ++n)
    {
      drillStep(value, n, stroke % 14);
      seconds += 0.5;
      changed();
    }
    value.dissection.endStroke();
    changed();
    switch (random() % 6)
    {
    case 0:
      library.save(value);
      journal.saved(value);
      break;
    case 1:
      value.dissection.undo(1 + random() % 2);
      break;
    case 2:
      value.dissection.redo();
      break;
    case 3:
      scene::startBranch(value, "b" + std::to_string(stroke), random() % (value.applied() + 1));
      break;
    case 4:
      scene::goToBranch(value,
                        value.dissection.history()
                            .branches()[random() % value.dissection.history().branches().size()]
                            .name);
      break;
    default:
      break;
    }
    changed();
  }
}

// Progress shared by a child process with its parent.
struct Shared
{
  std::atomic<std::size_t>* done;
  Shared()
    : done(static_cast<std::atomic<std::size_t>*>(::mmap(nullptr, sizeof(std::atomic<std::size_t>),
                                                         PROT_READ | PROT_WRITE,
                                                         MAP_SHARED | MAP_ANONYMOUS, -1, 0)))
  {
  }
  ~Shared() { ::munmap(done, sizeof(std::atomic<std::size_t>)); }
};

} // namespace

TEST(Journal, KilledAtTwoHundredMomentsLosesAtMostFiveSeconds)
{
  // In memory if possible: a kill, unlike a power cut, requires nothing of the disk.
  const fs::path memory = "/dev/shm";
  const TemporaryFolder folder(fs::exists(memory) ? memory : fs::temp_directory_path());
  // The states of the sequence, change by change.
  std::vector<std::pair<double, std::vector<std::uint16_t>>> states;
  {
    Library library(folder.path() / "truth");
    scene::Case value = savedCase(library);
    states.emplace_back(0.0, voxelsOf(value));
    session(library, value,
            [&](double seconds, const scene::Case& now)
            { states.emplace_back(seconds, voxelsOf(now)); });
  }
  const Shared shared;
  std::mt19937 random(1);
  int told = 0;
  double most = 0.0;
  for (int round = 0; round < 200; ++round)
  {
    const fs::path place = folder.path() / std::to_string(round);
    Library library(place);
    {
      scene::Case fresh = smallCase("ear");
      library.save(fresh);
    }
    new (shared.done) std::atomic<std::size_t>(0);
    const pid_t child = ::fork();
    if (child == 0)
    {
      try
      {
        scene::Case own = library.open("ear");
        library.loadDissection(own);
        session(library, own,
                [&](double, const scene::Case&)
                {
                  if (++*shared.done + 1 == states.size())
                    ::pause(); // ended only by a kill
                });
      }
      catch (...)
      {
      }
      ::_exit(0);
    }
    const std::size_t target = random() % (states.size() - 1);
    while (*shared.done < target)
      std::this_thread::yield();
    std::this_thread::sleep_for(std::chrono::microseconds(random() % 1000));
    ::kill(child, SIGKILL);
    ::waitpid(child, nullptr, 0);
    const std::size_t reached = *shared.done;

    library.onNotice([&told](const std::string&) { ++told; });
    scene::Case back = library.open("ear");
    ASSERT_NO_THROW(library.loadDissection(back)) << "round " << round;
    const auto now = voxelsOf(back);
    double lost = 1e9;
    for (std::size_t n = 0; n < std::min(reached + 2, states.size()); ++n)
      if (states[n].second == now)
        lost = std::max(0.0, states[reached].first - states[n].first);
    ASSERT_LE(lost, 5.0) << "round " << round << " after " << reached << " changes";
    most = std::max(most, lost);
    for (const auto& [name, content] : contentOf(place / "objects"))
    {
      const bool whole =
          name[0] == '.' || sha256OfFile(place / "objects" / name) == name.substr(0, 64);
      EXPECT_TRUE(whole) << name;
    }
    for (const auto& [name, content] : contentOf(place))
      EXPECT_EQ(name.find("journal"), std::string::npos) << name << ", round " << round;
    fs::remove_all(place);
  }
  EXPECT_GT(told, 100);
  EXPECT_GT(most, 0.0) << "some were killed in the middle of a stroke";
}
