#include <algorithm>
#include <array>
#include <chrono>
#include <cstdint>
#include <functional>
#include <set>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "TestCase.h"
#include "petrous/Library/Archive.h"
#include "petrous/Library/FrameSalt.h"
#include "petrous/Library/ObjectStore.h"
#include "petrous/Library/OwnerLock.h"
#include "petrous/Scene/ApplyRegistration.h"
#include "petrous/Scene/Manifest.h"

using namespace petrous;
using namespace petrous::library;
using test::contentOf;
using test::drill;
using test::refusal;
using test::TemporaryFolder;

namespace
{

namespace fs = std::filesystem;
using Reason = LibraryError::Reason;

/// A zip file, read and written byte by byte according to APPNOTE 6.3.9, sharing no code with the
/// program; stored entries only.
struct TestZip
{
  struct Entry
  {
    std::string name;
    std::string bytes;
    std::string localName = {};   ///< if it differs
    std::uint32_t size = 0;       ///< stated, if it differs
    std::uint32_t mode = 0100644; ///< Unix file mode
    std::uint16_t flags = 0;
    std::uint16_t method = 0; ///< 8: `bytes` are a deflate stream
  };
  std::vector<Entry> entries;

  static std::uint32_t crc(const std::string& bytes)
  {
    std::uint32_t value = 0xffffffffU;
    for (const char c : bytes)
    {
      value ^= static_cast<unsigned char>(c);
      for (int bit = 0; bit < 8; ++bit)
        value = (value >> 1) ^ ((value & 1) != 0 ? 0xedb88320U : 0U);
    }
    return ~value;
  }
  static void put(std::string& out, std::uint64_t value, int bytes)
  {
    for (int n = 0; n < bytes; ++n)
      out += static_cast<char>(value >> (8 * n));
  }

  std::string bytes() const
  {
    std::string out;
    std::string directory;
    for (const Entry& entry : entries)
    {
      const std::string& local = entry.localName.empty() ? entry.name : entry.localName;
      const std::size_t size = entry.size == 0 ? entry.bytes.size() : entry.size;
      const auto common = [&](std::string& to)
      {
        put(to, entry.flags, 2);
        put(to, entry.method, 2);
        put(to, 0x00210000U, 4); // time and date
        put(to, crc(entry.bytes), 4);
        put(to, entry.bytes.size(), 4);
        put(to, size, 4);
      };
      directory += std::string("PK\1\2", 4);
      put(directory, 0x031e, 2); // made by Unix
      put(directory, 20, 2);
      common(directory);
      put(directory, entry.name.size(), 2);
      put(directory, 0, 8); // no extra field, comment, disk, internal attributes
      put(directory, static_cast<std::uint64_t>(entry.mode) << 16, 4);
      put(directory, out.size(), 4);
      directory += entry.name;
      out += std::string("PK\3\4", 4);
      put(out, 20, 2);
      common(out);
      put(out, local.size(), 2);
      put(out, 0, 2);
      out += local + entry.bytes;
    }
    const std::size_t start = out.size();
    out += directory + std::string("PK\5\6", 4);
    put(out, 0, 4);
    put(out, entries.size(), 2);
    put(out, entries.size(), 2);
    put(out, directory.size(), 4);
    put(out, start, 4);
    put(out, 0, 2);
    return out;
  }
};

std::string bytesOf(const fs::path& path)
{
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

/// An instrument of 60 mm along x, its tip at the origin.
std::shared_ptr<const core::TriangleMesh> pickMesh()
{
  auto mesh = std::make_shared<core::TriangleMesh>();
  mesh->vertices = {{0, 0, 0}, {60, 1.25F, 0}, {60, -1, 1}, {60, 0, -1}};
  mesh->triangles = {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}};
  return mesh;
}

class Archives : public ::testing::Test
{
protected:
  Archives()
  {
    scene::Case value = test::savedCase(m_library, "ear");
    drill(value, {8, 8, 8});
    drill(value, {12, 12, 12});
    value.dissection.undo(1);
    value.iso = 412.5;
    m_library.save(value);
  }

  void write(const std::string& bytes) const
  {
    std::ofstream(m_file, std::ios::binary).write(bytes.data(), static_cast<long>(bytes.size()));
  }

  /// The archive's entries, unpacked by Python's zipfile.
  TestZip unpacked() const
  {
    TestZip zip;
    const fs::path to = m_folder.path() / "unpacked";
    fs::remove_all(to);
    const std::string command =
        "python3 -m zipfile -e '" + m_file.string() + "' '" + to.string() + "' >/dev/null 2>&1";
    if (std::system(command.c_str()) != 0)
      return zip;
    for (const auto& entry : fs::recursive_directory_iterator(to))
      if (entry.is_regular_file())
        zip.entries.push_back({fs::relative(entry.path(), to).string(), bytesOf(entry.path())});
    return zip;
  }

  static TestZip::Entry& find(TestZip& zip, const std::string& name)
  {
    return *std::find_if(zip.entries.begin(), zip.entries.end(),
                         [&](const auto& entry) { return entry.name == name; });
  }

  /// Changes the manifest in the file, which stays whole to its hashes. False: no python3.
  bool rewriteManifest(const std::function<void(nlohmann::json&)>& change) const
  {
    TestZip zip = unpacked();
    if (zip.entries.empty())
      return false;
    std::string& text = find(zip, "case.json").bytes;
    nlohmann::json manifest = nlohmann::json::parse(text);
    change(manifest);
    text = manifest.dump();
    std::string& index = find(zip, "petrous.json").bytes;
    nlohmann::json all = nlohmann::json::parse(index);
    all["manifest_sha256"] =
        sha256Of(reinterpret_cast<const std::uint8_t*>(text.data()), text.size());
    index = all.dump();
    write(zip.bytes());
    return true;
  }

  /// Restoring the file is refused, and changes nothing.
  std::string refused(const RestoreOptions& options = {"copy", ""})
  {
    // Nothing is known there: every object is read.
    Library other(m_folder.path() / "empty");
    const auto [reason, text] = refusal([&] { restoreCase(other, m_file, options); });
    EXPECT_FALSE(other.contains("copy"));
    EXPECT_EQ(other.verify().objects, 0U);
    EXPECT_EQ(text.find('\n'), text.npos);
    return text;
  }

  /// So that the library has a salt.
  static void savedWith(Library& library)
  {
    scene::Case value = test::smallCase("own", 16);
    library.save(value);
  }

  TemporaryFolder m_folder;
  Library m_library{m_folder.path() / "library"};
  fs::path m_file = m_folder.path() / "ear.petrous";
};

} // namespace

TEST_F(Archives, AreRestoredToTheByteInAnotherLibrary)
{
  const ArchiveSummary written = archiveCase(m_library, "ear", m_file);
  EXPECT_EQ(written.parts, 5U);
  EXPECT_EQ(written.archiveBytes, fs::file_size(m_file));
  Library other(m_folder.path() / "other");
  const RestoreSummary restored = restoreCase(other, m_file);
  EXPECT_EQ(restored.name, "ear");
  EXPECT_EQ(restored.newParts, 5U);

  auto there = contentOf(other.folder());
  auto here = contentOf(m_library.folder());
  std::size_t objects = 0;
  for (const auto& [name, bytes] : here)
    if (name.rfind("objects/", 0) == 0)
    {
      ++objects;
      EXPECT_EQ(there[name], bytes) << name;
    }
  EXPECT_EQ(objects, 5U);
  scene::Case a = m_library.open("ear");
  scene::Case b = other.open("ear");
  EXPECT_NE(a.id, b.id);
  b.id = a.id;
  b.revision = a.revision;
  EXPECT_EQ(scene::toManifest(a), scene::toManifest(b));
  EXPECT_TRUE(other.verify().damaged.empty());
}

TEST_F(Archives, HoldNoTimesAndNotWhoSigned)
{
  scene::Case value = test::smallCase("signed");
  scene::ImagePart mr = test::smallCase("other", 20).ct;
  mr.name = "T2";
  mr.registered = true;
  mr.registration.emplace();
  mr.registration->signOff = scene::SignOff{"Dr. Quincy", "2026-03-30T09:07:05Z", mr.mrFromCt};
  value.mr.push_back(std::move(mr));
  m_library.save(value);
  m_library.loadDissection(value);
  for (const double at : {8.0, 12.0})
  {
    const Eigen::Vector3d p = value.ct.geometry.patientFromVoxel({at, at, at});
    dissection::StrokeInfo info;
    info.startedAt = at < 10 ? "2026-03-30T08:15:01Z" : "2026-03-30T08:16:02Z";
    info.duration = at;
    value.dissection.beginStroke(std::move(info));
    value.dissection.cut({p, p + Eigen::Vector3d(0.5, 0, 0), 1.0});
    value.dissection.endStroke();
  }
  m_library.save(value);
  const scene::Case here = m_library.open("signed");
  ASSERT_EQ(here.dissection.strokes().front()->info.startedAt, "2026-03-30T08:15:01Z");

  for (const bool planOnly : {false, true})
  {
    ArchiveOptions options;
    options.planOnly = planOnly;
    const auto notes = archiveCase(m_library, "signed", m_file, options).notes;
    EXPECT_TRUE(std::any_of(notes.begin(), notes.end(),
                            [](const std::string& note)
                            { return note.find("who signed") != note.npos; }));
    TestZip zip = unpacked();
    for (const TestZip::Entry& entry : zip.entries)
      for (const char* text : {"2026-03-30", "Quincy"})
        EXPECT_EQ(entry.bytes.find(text), std::string::npos) << entry.name;
    EXPECT_NE(find(zip, "case.json").bytes.find("signed_off"), std::string::npos);
    restoreCase(m_library, m_file, {planOnly ? "plan" : "whole", ""});
  }
  // What is restored is the case but for these.
  const auto withoutThem = [](const scene::Case& of)
  {
    auto manifest = nlohmann::json::parse(scene::toManifest(of));
    for (const char* own : {"id", "name", "revision"})
      manifest.erase(own);
    for (auto& stroke : manifest["dissection"]["strokes"])
      stroke["started_at"] = "";
    manifest["mr"][0]["registration"]["signed_off"]["who"] = "";
    manifest["mr"][0]["registration"]["signed_off"]["when"] = "";
    return manifest;
  };
  for (const char* name : {"plan", "whole"})
  {
    const scene::Case there = m_library.open(name);
    EXPECT_EQ(withoutThem(there), withoutThem(here));
    EXPECT_EQ(there.dissection.strokes().front()->info.startedAt, "");
    ASSERT_NE(scene::validSignOff(there.mr.front()), nullptr) << "marked as signed";
    EXPECT_EQ(scene::validSignOff(there.mr.front())->who, "");
    EXPECT_EQ(scene::registrationToString(there.mr.front()).find("not signed"), std::string::npos);
  }

  ArchiveOptions all;
  all.keepIdentity = true;
  archiveCase(m_library, "signed", m_file, all);
  restoreCase(m_library, m_file, {"all", ""});
  const scene::Case kept = m_library.open("all");
  EXPECT_EQ(kept.dissection.strokes().back()->info.startedAt, "2026-03-30T08:16:02Z");
  EXPECT_EQ(scene::validSignOff(kept.mr.front())->who, "Dr. Quincy");
  EXPECT_EQ(scene::validSignOff(kept.mr.front())->when, "2026-03-30T09:07:05Z");
}

TEST_F(Archives, HoldNamesAndVoxelsOnlyOfStructuresThatTheCaseHas)
{
  scene::Case value = test::smallCase("two");
  auto voxels =
      std::make_shared<volume::Volume<std::uint16_t>>(*value.labels.front().labels.get()->voxels);
  for (int i = 4; i < 10; ++i)
    voxels->at(i, 12, 12) = 7;
  volume::Segment nerve;
  nerve.name = "first name of the nerve";
  nerve.index = 3;
  volume::Segment taken;
  taken.name = "taken away";
  taken.index = 7;
  value.labels.front().labels = std::make_shared<const volume::LabelMap>(
      volume::makeLabelMap(std::move(voxels), {nerve, taken}));
  value.labels.front().structures.push_back({"taken away", 7, 6, 0.384, {}});
  m_library.save(value);
  value = m_library.open("two");
  scene::removePart(value, "taken away");
  m_library.save(value);
  const std::string stored = value.labels.front().object;

  archiveCase(m_library, "two", m_file);
  EXPECT_EQ(bytesOf(m_file).find("taken away"), std::string::npos);
  EXPECT_EQ(bytesOf(m_file).find("first name"), std::string::npos);
  for (const auto& entry : fs::directory_iterator(m_folder.path()))
    EXPECT_TRUE(entry.path() == m_file || entry.path() == m_library.folder()) << entry.path();
  EXPECT_EQ(m_library.open("two").labels.front().object, stored) << "the case is as it was";

  Library other(m_folder.path() / "other");
  restoreCase(other, m_file);
  const auto map = other.open("two").labels.front().labels.get();
  ASSERT_EQ(map->segments.size(), 1U);
  EXPECT_EQ(map->segments[0].name, "nerve");
  EXPECT_EQ(map->segments[0].voxels, 6U);
  EXPECT_EQ(map->voxels->at(5, 8, 8), 3);
  EXPECT_EQ(map->voxels->at(5, 12, 12), 0);
  EXPECT_TRUE(other.verify().damaged.empty());

  // The plan refers to the map as the segmentation's import stores it, there as here.
  const fs::path plan = m_folder.path() / "plan.petrous";
  archiveCase(m_library, "two", plan, {true});
  restoreCase(m_library, plan, {"three", ""});
  EXPECT_EQ(m_library.open("three").labels.front().object, stored);
}

TEST_F(Archives, OfEqualCasesAreEqual)
{
  archiveCase(m_library, "ear", m_file);
  const std::string first = bytesOf(m_file);
  archiveCase(m_library, "ear", m_file);
  EXPECT_EQ(bytesOf(m_file), first);
}

TEST_F(Archives, ArePackedInSeveralMembers)
{
  // 160^3 voxels of 2 bytes are more than one member of 4 MiB.
  scene::Case value = test::smallCase("large", 160);
  m_library.save(value);
  const ArchiveSummary written = archiveCase(m_library, "large", m_file);
  EXPECT_LT(written.archiveBytes, written.inputBytes / 2);
  Library other(m_folder.path() / "other");
  restoreCase(other, m_file, {"large too", ""});
  EXPECT_TRUE(other.verify().damaged.empty());
  EXPECT_EQ(other.open("large too").ct.object, m_library.open("large").ct.object);
}

// Also where the library has all of it already: the archive may be the copy for another one.
TEST_F(Archives, ThatAreDamagedAreRefusedWhereEverythingIsThere)
{
  archiveCase(m_library, "ear", m_file);
  const std::string whole = bytesOf(m_file);
  std::size_t refusals = 0;
  constexpr std::size_t kPlaces = 40;
  for (std::size_t n = 0; n < kPlaces; ++n)
  {
    std::string spoilt = whole;
    spoilt[(2 * n + 1) * spoilt.size() / (2 * kPlaces)] ^= 0x10;
    write(spoilt);
    const std::string name = "copy" + std::to_string(n);
    try
    {
      restoreCase(m_library, m_file, {name, ""});
    }
    catch (const core::Error&)
    {
      ++refusals;
      EXPECT_FALSE(m_library.contains(name));
    }
  }
  EXPECT_GE(refusals, kPlaces * 2 / 3) << "of headers some bits mean nothing";
  write(whole);
  EXPECT_EQ(restoreCase(m_library, m_file, {"sound", ""}).newParts, 0U);

  // By a program that computes each entry's checksum anew, so that the hash alone can tell.
  const TestZip sound = unpacked();
  if (sound.entries.empty())
    GTEST_SKIP() << "no python3 to unpack the archive with";
  write(sound.bytes());
  EXPECT_EQ(restoreCase(m_library, m_file, {"packed again", ""}).newParts, 0U);
  const auto isRefused = [&](const std::string& entry, std::size_t byte)
  {
    TestZip zip = sound;
    find(zip, entry).bytes.at(byte) ^= 1;
    write(zip.bytes());
    const auto [reason, text] = refusal([&] { restoreCase(m_library, m_file, {"spoilt", ""}); });
    return reason == Reason::Damaged && text.find("'" + entry + "'") != text.npos &&
           !m_library.contains("spoilt");
  };
  for (const TestZip::Entry& entry : sound.entries)
  {
    if (entry.name == "petrous.json" || entry.name == "case.json")
      continue;
    for (const std::size_t byte : {std::size_t{7}, entry.bytes.size() / 2, entry.bytes.size() - 1})
      EXPECT_TRUE(isRefused(entry.name, byte)) << entry.name << ", byte " << byte;
  }
  EXPECT_TRUE(m_library.verify().damaged.empty());
}

TEST_F(Archives, OfAPlanUseNoDamagedPartOfTheLibrary)
{
  archiveCase(m_library, "ear", m_file, {true});
  RestoreOptions options;
  options.ct = "ear";
  options.name = "plan";
  const fs::path object =
      m_library.folder() / "objects" / m_library.open("ear").meshes.front().object;
  const std::string whole = bytesOf(object);
  std::string spoilt = whole;
  const std::size_t digit = spoilt.find_first_of("0123456789");
  ASSERT_NE(digit, spoilt.npos);
  spoilt[digit] = spoilt[digit] == '1' ? '2' : '1'; // still a mesh
  fs::permissions(object, fs::perms::owner_write, fs::perm_options::add);
  std::ofstream(object, std::ios::binary) << spoilt;
  const auto [reason, text] = refusal([&] { restoreCase(m_library, m_file, options); });
  EXPECT_EQ(reason, Reason::Damaged);
  EXPECT_NE(text.find("mesh"), text.npos) << text;
  EXPECT_FALSE(m_library.contains("plan"));
  std::ofstream(object, std::ios::binary) << whole;
  EXPECT_EQ(restoreCase(m_library, m_file, options).name, "plan");
}

TEST_F(Archives, ATakenNameIsRefused)
{
  archiveCase(m_library, "ear", m_file);
  const auto [reason, text] = refusal([&] { restoreCase(m_library, m_file); });
  EXPECT_EQ(reason, Reason::NameTaken);
  const RestoreSummary copy = restoreCase(m_library, m_file, {"copy", ""});
  EXPECT_EQ(copy.newParts, 0U);
  EXPECT_TRUE(m_library.contains("copy"));
}

TEST_F(Archives, ADamagedObjectIsNotArchived)
{
  write("what was there before");
  const fs::path object =
      m_library.folder() / "objects" / m_library.open("ear").labels.front().object;
  std::fstream(object, std::ios::in | std::ios::out | std::ios::binary).seekp(100).put('!');
  const auto [reason, text] = refusal([&] { archiveCase(m_library, "ear", m_file); });
  EXPECT_EQ(reason, Reason::Damaged);
  EXPECT_NE(text.find("structures of case 'ear'"), text.npos) << text;
  EXPECT_EQ(bytesOf(m_file), "what was there before");
  std::size_t files = 0;
  for (const auto& entry : fs::directory_iterator(m_folder.path()))
    files += entry.is_regular_file() ? 1 : 0;
  EXPECT_EQ(files, 1U) << "nothing is left behind";
}

TEST_F(Archives, ADamagedImageIsNotArchived)
{
  const fs::path object = m_library.folder() / "objects" / m_library.open("ear").ct.object;
  std::fstream(object, std::ios::in | std::ios::out | std::ios::binary)
      .seekp(-5, std::ios::end)
      .put('!');
  const auto [reason, text] = refusal([&] { archiveCase(m_library, "ear", m_file); });
  EXPECT_EQ(reason, Reason::Damaged);
  EXPECT_FALSE(fs::exists(m_file));
}

// Voxels of a patient, or copies of linked files, are in it.
TEST_F(Archives, RemoveWhatAKilledProcessLeft)
{
  const fs::path here = m_folder.path();
  const auto make = [&](const char* name, const char* content)
  {
    fs::create_directories((here / name / content).parent_path());
    std::ofstream(here / name / content) << "a patient's";
  };
  make(".petrous-0011223344556677", "objects/ab/abcdef.nrrd");
  make(".petrous-0011223344556678", "archive.Ab12Cd");
  make(".petrous-0011223344556679", "archive");  // of a process that is at work
  make(".petrous-001122334455667a", "1/ct.dcm"); // something else grows there
  make("petrous-mine", "archive");
  // Killed before anything was made in it; and about to be filled by another program.
  fs::create_directory(here / ".petrous-001122334455667b");
  fs::last_write_time(here / ".petrous-001122334455667b",
                      fs::file_time_type::clock::now() - std::chrono::hours(2));
  fs::create_directory(here / ".petrous-001122334455667c");
  const OwnerLock alive(here / ".petrous-0011223344556679");
  archiveCase(m_library, "ear", m_file);
  std::set<std::string> left;
  for (const auto& entry : fs::directory_iterator(here))
    left.insert(entry.path().filename().string());
  EXPECT_EQ(left, (std::set<std::string>{".petrous-0011223344556679", ".petrous-001122334455667a",
                                         ".petrous-001122334455667c", "petrous-mine", "library",
                                         "ear.petrous"}));
}

TEST_F(Archives, CanBeCancelled)
{
  auto token = std::make_shared<core::CancelToken>();
  token->cancel();
  const core::Progress cancelled([](double, const std::string&) {}, token);
  EXPECT_THROW(archiveCase(m_library, "ear", m_file, {}, cancelled), core::CancelledError);
  EXPECT_FALSE(fs::exists(m_file));
  archiveCase(m_library, "ear", m_file);
  Library other(m_folder.path() / "other");
  EXPECT_THROW(restoreCase(other, m_file, {}, cancelled), core::CancelledError);
  EXPECT_FALSE(other.contains("ear"));
  EXPECT_EQ(other.verify().objects, 0U);
}

TEST_F(Archives, BringTheInstrumentWithoutTheNameOfItsFile)
{
  scene::Case value = m_library.open("ear");
  const auto pick = pickMesh();
  value.view.instrument.emplace();
  value.view.instrument->name = "Quincy pick.stl";
  value.view.instrument->axis = "x+";
  value.view.instrument->mesh = pick;
  m_library.save(value);
  const std::string object = value.view.instrument->object;
  EXPECT_EQ(m_library.open("ear").view.instrument->name, "Quincy pick.stl");
  m_library.collectGarbage();
  EXPECT_TRUE(fs::exists(m_library.folder() / "objects" / object)) << "the case needs it";
  for (const bool planOnly : {false, true})
  {
    SCOPED_TRACE(planOnly);
    ArchiveOptions options;
    options.planOnly = planOnly;
    options.keepIdentity = true; // of the patient, not of a file
    archiveCase(m_library, "ear", m_file, options);
    const TestZip zip = unpacked();
    for (const TestZip::Entry& entry : zip.entries)
    {
      EXPECT_EQ(entry.bytes.find("Quincy"), std::string::npos) << entry.name;
      EXPECT_EQ(entry.name.find("Quincy"), std::string::npos) << entry.name;
    }
    const TemporaryFolder folder;
    Library other(folder.path() / "library");
    RestoreOptions to;
    if (planOnly) // on the very same image
    {
      scene::Case same = test::smallCase("same");
      other.save(same);
      to.ct = "same";
      to.name = "plan";
    }
    restoreCase(other, m_file, to);
    const auto restored = other.open(planOnly ? "plan" : "ear").view.instrument;
    ASSERT_TRUE(restored);
    EXPECT_EQ(restored->name, "");
    EXPECT_EQ(restored->axis, "x+");
    EXPECT_EQ(restored->object, object);
    const auto mesh = restored->mesh.get();
    EXPECT_TRUE(mesh->vertices == pick->vertices);
    EXPECT_TRUE(mesh->triangles == pick->triangles);
    EXPECT_TRUE(other.verify().damaged.empty());
  }
  fs::remove(m_library.folder() / "objects" / object);
  EXPECT_EQ(m_library.verify().damaged.size(), 1U);
  EXPECT_EQ(m_library.lost(m_library.open("ear")).size(), 1U);
  for (const bool planOnly : {false, true}) // a lost tool keeps no case back
  {
    ArchiveOptions options;
    options.planOnly = planOnly;
    const auto notes = archiveCase(m_library, "ear", m_file, options).notes;
    EXPECT_TRUE(std::any_of(notes.begin(), notes.end(),
                            [](const std::string& note)
                            { return note.find("the instrument is not in") == 0; }));
    for (const TestZip::Entry& entry : unpacked().entries)
      EXPECT_EQ(entry.name.find("tools/"), std::string::npos) << entry.name;
  }
  EXPECT_TRUE(m_library.open("ear").view.instrument) << "it stays in the case";
  value = m_library.open("ear");
  value.view.instrument.reset();
  m_library.save(value);
  EXPECT_TRUE(m_library.verify().damaged.empty()) << "nobody needs it";
}

// One object, and both are told of.
TEST_F(Archives, HaveAMeshThatIsTheInstrumentTooAmongTheMeshes)
{
  scene::Case value = m_library.open("ear");
  const auto probe = pickMesh();
  value.view.instrument.emplace();
  value.view.instrument->mesh = probe;
  scene::MeshPart part;
  part.name = "probe";
  part.triangles = probe->triangles.size();
  part.mesh = probe;
  value.meshes.push_back(part);
  m_library.save(value);
  const std::string object = value.view.instrument->object;
  ASSERT_EQ(value.meshes.back().object, object);
  const auto hasEntry = [this](const std::string& name)
  {
    const TestZip zip = unpacked();
    return std::any_of(zip.entries.begin(), zip.entries.end(),
                       [&name](const TestZip::Entry& entry) { return entry.name == name; });
  };
  archiveCase(m_library, "ear", m_file);
  EXPECT_TRUE(hasEntry("meshes/probe.obj"));
  archiveCase(m_library, "ear", m_file, {true});
  EXPECT_TRUE(hasEntry("tools/instrument.obj")) << "a plan has no meshes";
  EXPECT_FALSE(hasEntry("meshes/probe.obj"));
  const TemporaryFolder folder;
  Library other(folder.path() / "library");
  scene::Case same = test::smallCase("same");
  other.save(same);
  RestoreOptions to;
  to.ct = "same";
  to.name = "plan";
  restoreCase(other, m_file, to);
  EXPECT_TRUE(other.open("plan").view.instrument);

  fs::remove(m_library.folder() / "objects" / object);
  const auto damaged = m_library.verify().damaged;
  ASSERT_EQ(damaged.size(), 1U);
  EXPECT_NE(damaged[0].text.find("mesh 'probe', which is the instrument, too"), std::string::npos)
      << damaged[0].text;
}

TEST_F(Archives, OfAPlanBringNoVoxels)
{
  const ArchiveSummary written = archiveCase(m_library, "ear", m_file, {true});
  EXPECT_TRUE(written.planOnly);
  EXPECT_EQ(written.parts, 2U) << "the strokes";

  Library other(m_folder.path() / "other");
  const auto [reason, text] = refusal([&] { restoreCase(other, m_file); });
  EXPECT_EQ(reason, Reason::NotFound);
  EXPECT_NE(text.find("CT is not in this library"), text.npos) << text;

  scene::Case another = test::smallCase("another", 20);
  other.save(another);
  EXPECT_NE(refusal(
                [&] {
                  restoreCase(other, m_file, {"", "another"});
                })
                .second.find("another CT"),
            std::string::npos);

  scene::Case same = test::smallCase("same");
  same.labels.clear();
  other.save(same);
  const RestoreSummary restored = restoreCase(other, m_file, {"", "same"});
  ASSERT_EQ(restored.notes.size(), 1U) << "the mesh is there, the structure is not";
  EXPECT_NE(restored.notes[0].find("'nerve'"), std::string::npos);
  scene::Case value = other.open("ear");
  other.loadDissection(value);
  EXPECT_EQ(value.dissection.strokes().size(), 2U);
  EXPECT_EQ(value.applied(), 1U);
  EXPECT_EQ(value.iso, 412.5);
  EXPECT_TRUE(value.labels.empty());
  EXPECT_EQ(value.meshes.size(), 1U);
}

TEST_F(Archives, OfAPlanLeaveOutWhatIsDrawnOnAMissingMr)
{
  scene::Case value = m_library.open("ear");
  scene::ImagePart mr = test::smallCase("mr", 20).ct;
  mr.name = "t2";
  value.mr.push_back(mr);
  scene::LabelPart drawn = test::smallCase("drawn").labels.front();
  drawn.structures.front().name = "tumour";
  drawn.drawnOn = "t2";
  value.labels.push_back(std::move(drawn));
  m_library.save(value);
  archiveCase(m_library, "ear", m_file, {true});

  Library other(m_folder.path() / "other");
  scene::Case same = test::smallCase("same");
  other.save(same); // whose map of labels is that of the tumour as well
  const RestoreSummary restored = restoreCase(other, m_file, {"", "same"});
  ASSERT_EQ(restored.notes.size(), 2U);
  EXPECT_NE(restored.notes[0].find("MR 't2'"), std::string::npos) << restored.notes[0];
  EXPECT_NE(restored.notes[1].find("'tumour'"), std::string::npos) << restored.notes[1];
  const scene::Case there = other.open("ear");
  EXPECT_TRUE(there.mr.empty());
  ASSERT_EQ(there.labels.size(), 1U);
  EXPECT_EQ(there.labels[0].structures[0].name, "nerve");
}

// Of an older case: a structure of the CT has the MR's name, and that the tumour was drawn on the
// MR is known by its grid alone.
TEST_F(Archives, OfAPlanLeaveOutAMissingMrItselfAndWhatHasItsGrid)
{
  scene::Case value = m_library.open("ear");
  scene::ImagePart mr = test::smallCase("mr", 20).ct;
  mr.name = "nerve";
  value.mr.push_back(mr);
  scene::LabelPart drawn = test::smallCase("drawn", 20).labels.front();
  drawn.structures.front().name = "tumour";
  ASSERT_FALSE(drawn.drawnOn);
  value.labels.push_back(drawn);
  m_library.save(value);
  archiveCase(m_library, "ear", m_file, {true});

  Library other(m_folder.path() / "other");
  scene::Case same = test::smallCase("same");
  same.labels.push_back(drawn);
  other.save(same);
  const RestoreSummary restored = restoreCase(other, m_file, {"", "same"});
  ASSERT_EQ(restored.notes.size(), 2U);
  EXPECT_NE(restored.notes[0].find("MR 'nerve'"), std::string::npos) << restored.notes[0];
  EXPECT_NE(restored.notes[1].find("'tumour': left out with MR 'nerve'"), std::string::npos)
      << restored.notes[1];
  const scene::Case there = other.open("ear");
  EXPECT_TRUE(there.mr.empty());
  ASSERT_EQ(there.labels.size(), 1U);
  EXPECT_EQ(there.labels[0].structures[0].name, "nerve");
}

TEST_F(Archives, CutShortAnywhereAreRefused)
{
  archiveCase(m_library, "ear", m_file);
  const std::string whole = bytesOf(m_file);
  for (int hundredths = 0; hundredths < 100; ++hundredths)
  {
    write(whole.substr(0, whole.size() * static_cast<std::size_t>(hundredths) / 100));
    refused();
    ASSERT_FALSE(HasFailure()) << hundredths << " %";
  }
}

TEST_F(Archives, WithAnyBitFlippedAreRefusedOrWhole)
{
  archiveCase(m_library, "ear", m_file);
  const std::string whole = bytesOf(m_file);
  std::uint32_t random = 7;
  std::size_t sound = 0;
  for (int n = 0; n < 100; ++n)
  {
    Library other(m_folder.path() / ("other" + std::to_string(n)));
    std::string spoilt = whole;
    random = random * 1664525U + 1013904223U;
    spoilt[(random >> 4) % spoilt.size()] ^= static_cast<char>(1 << (random >> 29));
    write(spoilt);
    try
    {
      restoreCase(other, m_file);
      ++sound; // e.g. a time in a header
    }
    catch (const core::Error&)
    {
      EXPECT_FALSE(other.contains("ear"));
    }
    const Inspection state = other.verify();
    EXPECT_TRUE(state.damaged.empty());
    EXPECT_EQ(state.objects, other.contains("ear") ? 5U : 0U);
  }
  EXPECT_LT(sound, 30U);
}

TEST_F(Archives, ThatAreHostileAreRefused)
{
  archiveCase(m_library, "ear", m_file);
  const TestZip whole = unpacked();
  if (whole.entries.empty())
    GTEST_SKIP() << "no python3 to unpack the archive with";

  write(whole.bytes());
  EXPECT_EQ(restoreCase(m_library, m_file, {"packed again", ""}).parts, 5U)
      << "an archive that another program packed is as good";

  const auto with = [&](const auto& change)
  {
    TestZip zip = whole;
    change(zip);
    write(zip.bytes());
    const std::string text = refused();
    return text;
  };
  const auto contains = [](const std::string& text, const char* words)
  { return text.find(words) != text.npos; };
  const std::string escape = with([](TestZip& zip) { zip.entries.push_back({"../x", "x"}); });
  EXPECT_TRUE(contains(escape, "leads out of its folder")) << escape;
  EXPECT_FALSE(fs::exists(m_folder.path() / "x"));
  EXPECT_TRUE(contains(with(
                           [](TestZip& zip) {
                             zip.entries.push_back({"/tmp/x", "x"});
                           }),
                       "no relative path"));
  EXPECT_TRUE(contains(with(
                           [](TestZip& zip) {
                             zip.entries.push_back({"a\\b", "x"});
                           }),
                       "no relative path"));
  EXPECT_TRUE(contains(with(
                           [](TestZip& zip) {
                             zip.entries.push_back({"extra", "x"});
                           }),
                       "not listed"));
  EXPECT_TRUE(contains(with([](TestZip& zip) { find(zip, "ct.nrrd").mode = 0120777; }),
                       "link or a device"));
  EXPECT_TRUE(contains(with([](TestZip& zip) { zip.entries.push_back(zip.entries.front()); }),
                       "two entries of one name"));
  with([](TestZip& zip) { find(zip, "ct.nrrd").localName = "ct.nrrx"; });
  with([](TestZip& zip) { find(zip, "ct.nrrd").size = 4000000000U; });
  with([](TestZip& zip) { find(zip, "ct.nrrd").flags = 1; }); // encrypted
  // More than is stated, in stored blocks of a deflate stream (RFC 1951, 3.2.4).
  const std::string more = with(
      [](TestZip& zip)
      {
        constexpr std::size_t kStated = 64;
        TestZip::Entry& entry = find(zip, "strokes/0001.stroke");
        std::string stream;
        for (int n = 0; n < 40; ++n)
        {
          constexpr std::uint16_t kLength = 60000;
          stream += static_cast<char>(n == 39);
          TestZip::put(stream, kLength, 2);
          TestZip::put(stream, static_cast<std::uint16_t>(~kLength), 2);
          stream += std::string(kLength, 'x');
        }
        entry.bytes = stream;
        entry.method = 8;
        entry.size = kStated;
        std::string& text = find(zip, "petrous.json").bytes;
        nlohmann::json all = nlohmann::json::parse(text);
        for (auto& one : all["objects"])
          if (one["file"] == "strokes/0001.stroke")
            one["bytes"] = kStated;
        text = all.dump();
      });
  EXPECT_TRUE(contains(more, "larger than stated")) << more;
  with([](TestZip& zip) { find(zip, "ct.nrrd").bytes.back() ^= 1; });
  with([](TestZip& zip) { find(zip, "ct.nrrd").bytes.resize(3000); });
  with([](TestZip& zip) { find(zip, "strokes/0001.stroke").bytes[9] ^= 1; });
  with([](TestZip& zip) { zip.entries.erase(zip.entries.begin()); });
  EXPECT_TRUE(contains(with([](TestZip& zip) { find(zip, "case.json").bytes += " "; }), "hash"));

  const auto index = [&](const auto& change)
  {
    return with(
        [&](TestZip& zip)
        {
          std::string& text = find(zip, "petrous.json").bytes;
          nlohmann::json all = nlohmann::json::parse(text);
          change(all);
          text = all.dump();
        });
  };
  EXPECT_TRUE(contains(index([](auto& all) { all["petrous_archive"] = 2; }), "newer version"));
  index([](auto& all) { all["objects"][0]["bytes"] = std::uint64_t{1} << 60; });
  index([](auto& all) { all["objects"][0]["bytes"] = 5; });
  index([](auto& all) { all["objects"][0]["file"] = "../../etc/passwd"; });
  index([](auto& all) { all["objects"].erase(1); });
  index([](auto& all) { all["objects"].push_back(all["objects"][0]); });
  index([](auto& all) { all["objects"][0]["object"] = "../" + std::string(64, 'a') + ".nrrd"; });
  index([](auto& all) { all["case"] = "../../x"; });
  index([](auto& all) { all.erase("case"); });
  // JSON of a few megabytes that would take hundreds of them.
  for (const char* entry : {"petrous.json", "case.json"})
  {
    const std::string bloated = with(
        [entry](TestZip& zip)
        {
          std::string text = "{\"x\":[[]";
          for (int n = 0; n < 5'000'000; ++n)
            text += ",[]";
          text += "]}";
          if (entry == std::string("case.json"))
          {
            nlohmann::json all = nlohmann::json::parse(find(zip, "petrous.json").bytes);
            all["manifest_sha256"] =
                sha256Of(reinterpret_cast<const std::uint8_t*>(text.data()), text.size());
            find(zip, "petrous.json").bytes = all.dump();
          }
          find(zip, entry).bytes = text;
        });
    EXPECT_TRUE(contains(bloated, "values")) << bloated;
  }

  // A case that lies where its MR says, and no other may be called as the CT is.
  scene::Case value = m_library.open("ear");
  scene::ImagePart mr = test::smallCase("mr", 20).ct;
  for (const char* name : {"t1", "t2"})
  {
    mr.name = name;
    value.mr.push_back(mr);
  }
  value.name = "mrs";
  value.revision = 0;
  m_library.save(value);
  archiveCase(m_library, "mrs", m_file);
  const TestZip mrs = unpacked();
  for (const char* name : {"ct", "t1"})
  {
    TestZip zip = mrs;
    std::string& manifest = find(zip, "case.json").bytes;
    for (std::size_t at = manifest.find("\"t2\""); at != manifest.npos;
         at = manifest.find("\"t2\""))
      manifest.replace(at, 4, "\"" + std::string(name) + "\"");
    std::string& text = find(zip, "petrous.json").bytes;
    nlohmann::json all = nlohmann::json::parse(text);
    all["manifest_sha256"] =
        sha256Of(reinterpret_cast<const std::uint8_t*>(manifest.data()), manifest.size());
    text = all.dump();
    write(zip.bytes());
    const std::string words = refused();
    EXPECT_TRUE(contains(words, name == std::string("ct") ? "not a valid one" : "one name"))
        << words;
  }
}

TEST_F(Archives, OfAnotherFrameOfReferenceAreNotMistaken)
{
  scene::Case value = m_library.open("ear");
  value.ct.frameOfReference = "some hash";
  value.ct.isFrameSalted = false;
  m_library.save(value);
  archiveCase(m_library, "ear", m_file);
  Library other(m_folder.path() / "other");
  restoreCase(other, m_file);
  EXPECT_TRUE(other.open("ear").ct.frameOfReference.empty())
      << "the salt of the other library is not known";
  restoreCase(m_library, m_file, {"copy", ""});
  EXPECT_EQ(m_library.open("copy").ct.frameOfReference, m_library.open("ear").ct.frameOfReference);
}

// Two cases of one patient: who gets both archives must not see that by them, and a hospital's
// archives must not be told from another's.
TEST_F(Archives, OfOnePatientHaveNothingInCommonButForTheirLibrary)
{
  const std::string frame(64, 'a'), id(64, 'b'), name(64, 'c');
  const auto archived = [&](const char* of, int n)
  {
    scene::Case value = test::smallCase(of, n);
    value.ct.frameOfReference = frame;
    value.ct.patient.id = id;
    value.ct.patient.name = name;
    value.ct.patient.nameParts = {std::string(64, 'd'), std::string(64, 'e')};
    value.mr.push_back(test::smallCase("other", n + 1).ct);
    value.mr.back().name = "T2";
    value.mr.back().frameOfReference = frame;
    m_library.save(value);
    archiveCase(m_library, of, m_file);
    TestZip zip = unpacked();
    return std::pair{nlohmann::json::parse(find(zip, "case.json").bytes),
                     nlohmann::json::parse(find(zip, "petrous.json").bytes)};
  };
  const auto [first, firstIndex] = archived("first", 18);
  const auto [second, secondIndex] = archived("second", 20);
  const scene::Case here = m_library.open("first");
  EXPECT_NE(firstIndex["library_sha256"], secondIndex["library_sha256"]);
  const auto all = [](const nlohmann::json& image)
  {
    return std::set<std::string>{
        image["frame_of_reference_salted_sha256"], image["patient_salted_sha256"]["name_parts"][0],
        image["patient_salted_sha256"]["name_parts"][1], image["patient_salted_sha256"]["id"],
        image["patient_salted_sha256"]["name"]};
  };
  std::set<std::string> seen{here.ct.frameOfReference, here.ct.patient.id, here.ct.patient.name,
                             here.ct.patient.nameParts.at(0), here.ct.patient.nameParts.at(1)};
  ASSERT_EQ(here.ct.patient.id, m_library.open("second").ct.patient.id);
  for (const std::string& hash : all(first["ct"]))
    EXPECT_TRUE(seen.insert(hash).second) << "another than at home";
  EXPECT_NE(first["ct"]["salt_id"], here.ct.saltId) << "which would tell whose library it is";
  EXPECT_NE(first["ct"]["salt_id"], second["ct"]["salt_id"]);
  for (const std::string& hash : all(second["ct"]))
    EXPECT_TRUE(seen.insert(hash).second) << "another than in the first";

  // The library that wrote it gets them back, another one nothing.
  restoreCase(m_library, m_file, {"again", ""});
  const scene::Case again = m_library.open("again");
  EXPECT_EQ(again.ct.frameOfReference, here.ct.frameOfReference);
  EXPECT_EQ(again.ct.patient.id, here.ct.patient.id);
  EXPECT_EQ(again.ct.patient.name, here.ct.patient.name);
  EXPECT_EQ(again.ct.patient.nameParts, here.ct.patient.nameParts);
  EXPECT_EQ(again.mr[0].frameOfReference, here.ct.frameOfReference);
  EXPECT_EQ(again.ct.saltId, here.ct.saltId);
  Library other(m_folder.path() / "other");
  savedWith(other);
  const auto notes = restoreCase(other, m_file).notes;
  EXPECT_TRUE(other.open("second").ct.patient.empty());
  EXPECT_EQ(other.open("second").ct.frameOfReference, "");
  EXPECT_TRUE(std::any_of(notes.begin(), notes.end(),
                          [](const std::string& note)
                          { return note.find("in the CT's position") != note.npos; }));
}

// Salted hashes are another library's; the public ones of older programs can still be compared.
TEST(ForeignIdentity, IsForgottenWhereSaltedAndNamedWhereAnMrMustBeRegistered)
{
  const auto imageOf = [](const char* name, bool isSalted, bool isRegistered, char frame)
  {
    scene::ImagePart image;
    image.name = name;
    image.frameOfReference = std::string(64, frame);
    image.patient.id = std::string(64, 'p');
    image.isFrameSalted = isSalted;
    image.registered = isRegistered;
    return image;
  };
  scene::Case value;
  value.ct = imageOf("ct", true, false, 'a');
  value.mr = {imageOf("T1", true, false, 'a'), imageOf("T2", true, true, 'a'),
              imageOf("FLAIR", true, false, 'b'), imageOf("old", false, false, 'a')};
  const auto notes = forgetForeignIdentity(value);
  ASSERT_EQ(notes.size(), 1U);
  EXPECT_NE(notes[0].find("MR 'T1'"), std::string::npos) << notes[0];
  EXPECT_TRUE(value.ct.frameOfReference.empty() && value.ct.patient.empty());
  for (int n = 0; n < 3; ++n)
    EXPECT_TRUE(value.mr[n].frameOfReference.empty() && value.mr[n].patient.empty()) << n;
  EXPECT_EQ(value.mr[3].frameOfReference, std::string(64, 'a'));
  EXPECT_FALSE(value.mr[3].patient.empty());
  EXPECT_TRUE(forgetForeignIdentity(value).empty()) << "idempotent";
}

// The mark of older programs is the same in all archives of a library, and their hashes are those
// at home.
TEST_F(Archives, OfOlderProgramsAreKnownByTheirLibrary)
{
  scene::Case value = m_library.open("ear");
  value.ct.frameOfReference = std::string(64, 'a');
  value.ct.isFrameSalted = false;
  m_library.save(value);
  archiveCase(m_library, "ear", m_file);
  TestZip zip = unpacked();
  if (zip.entries.empty())
    GTEST_SKIP() << "no python3 to unpack the archive with";
  nlohmann::json manifest = nlohmann::json::parse(find(zip, "case.json").bytes);
  manifest["ct"]["frame_of_reference_salted_sha256"] = m_library.open("ear").ct.frameOfReference;
  std::string& text = find(zip, "case.json").bytes;
  text = manifest.dump();
  const std::string salt = bytesOf(m_library.folder() / "salt") + "archive";
  nlohmann::json index = nlohmann::json::parse(find(zip, "petrous.json").bytes);
  const auto hashOf = [](const std::string& of)
  { return sha256Of(reinterpret_cast<const std::uint8_t*>(of.data()), of.size()); };
  index["manifest_sha256"] = hashOf(text);
  index["library_sha256"] = hashOf(salt);
  find(zip, "petrous.json").bytes = index.dump();
  write(zip.bytes());
  restoreCase(m_library, m_file, {"old", ""});
  EXPECT_EQ(m_library.open("old").ct.frameOfReference, m_library.open("ear").ct.frameOfReference);
}

// A structure that no voxel carries, or that was renamed: its former name is a note's, and a
// place's, and nobody sees it.
TEST_F(Archives, NameNothingThatTheCaseDoesNotHave)
{
  scene::Case value = m_library.open("ear");
  value.labels[0].notes = {"'DOE^JOHN 19500101' left out, as no voxel carries it",
                           "'nerve' is thin"};
  value.ct.notes = {"is in inch; converted to mm"};
  scene::ImagePart mr = test::smallCase("mr", 20).ct;
  mr.name = "T2";
  mr.registered = true;
  mr.registration.emplace();
  mr.registration->error = scene::RegistrationError{};
  mr.registration->error->place = "the middle of 'DOE^JOHN 19500101'";
  mr.registration->through = "DOE^JOHN MR";
  value.mr.push_back(mr);
  value.view.slices.emplace();
  value.view.slices->width = 100;
  value.view.slices->overlay = scene::ViewState::Slices::Overlay{"DOE^JOHN MR", "blend", 0.5};
  m_library.save(value);
  for (const bool planOnly : {false, true})
  {
    ArchiveOptions options;
    options.planOnly = planOnly;
    const auto notes = archiveCase(m_library, "ear", m_file, options).notes;
    EXPECT_TRUE(std::any_of(notes.begin(), notes.end(),
                            [](const std::string& note)
                            { return note.rfind("1 note on the import", 0) == 0; }));
    TestZip zip = unpacked();
    for (const TestZip::Entry& entry : zip.entries)
      EXPECT_EQ(entry.bytes.find("DOE"), std::string::npos) << entry.name;
    const std::string& text = find(zip, "case.json").bytes;
    for (const char* kept : {"'nerve' is thin", "is in inch"})
      EXPECT_NE(text.find(kept), std::string::npos) << kept;
  }
  EXPECT_EQ(m_library.open("ear").labels[0].notes.size(), 2U) << "at home it stays";
}

// Each is whole to its hashes, as a program that makes archives could write it.
TEST_F(Archives, ThatContradictThemselvesAreRefused)
{
  scene::Case value = m_library.open("ear");
  scene::ImagePart mr = test::smallCase("mr", 20).ct;
  mr.name = "T2";
  value.mr.push_back(mr);
  value.attachments.emplace_back();
  value.attachments.back().name = "tool.ticks";
  value.attachments.back().kind = scene::Attachment::Kind::Recording;
  value.attachments.back().content = std::make_shared<std::vector<std::uint8_t>>(
      std::vector<std::uint8_t>{'P', 'T', 'R', 'T', 'I', 'C', 'K', '\n', 'x'});
  m_library.save(value);
  archiveCase(m_library, "ear", m_file);
  const TestZip whole = unpacked();
  if (whole.entries.empty())
    GTEST_SKIP() << "no python3 to unpack the archive with";
  const auto hashOf = [](const std::string& of)
  { return sha256Of(reinterpret_cast<const std::uint8_t*>(of.data()), of.size()); };
  using Json = nlohmann::json;
  const auto with = [&](const std::function<void(Json&)>& change, const std::string& entry = {},
                        const std::string& content = {})
  {
    TestZip zip = whole;
    Json manifest = Json::parse(find(zip, "case.json").bytes);
    Json index = Json::parse(find(zip, "petrous.json").bytes);
    if (!entry.empty())
    {
      find(zip, entry).bytes = content;
      for (auto& one : index["objects"])
        if (one["file"] == entry)
        {
          const std::string before = one["object"];
          const std::string after = hashOf(content) + before.substr(64);
          one["object"] = after;
          one["bytes"] = content.size();
          std::string text = manifest.dump();
          for (std::size_t at = text.find(before); at != text.npos; at = text.find(before))
            text.replace(at, before.size(), after);
          manifest = Json::parse(text);
        }
    }
    if (change)
      change(manifest);
    std::string& text = find(zip, "case.json").bytes;
    text = manifest.dump();
    index["manifest_sha256"] = hashOf(text);
    find(zip, "petrous.json").bytes = index.dump();
    write(zip.bytes());
  };
  with({});
  Library sound(m_folder.path() / "sound");
  EXPECT_EQ(restoreCase(sound, m_file).parts, 7U) << "the way to change it is right";

  const auto expectRefused = [&](const std::string& words)
  {
    const std::string text = refused();
    EXPECT_NE(text.find(words), text.npos) << words << ": " << text;
  };
  with({}, "labels/nerve.seg.nrrd", "garbage");
  expectRefused("a label map cannot be read");
  with({}, "meshes/incus.obj", "garbage");
  expectRefused("a mesh cannot be read");
  with({}, "strokes/0001.stroke", "garbage");
  expectRefused("a stroke");
  with({}, "strokes/0002.stroke", "garbage"); // undone
  expectRefused("a stroke");
  with([](Json& j) { j["attachments"][0]["kind"] = "screenshot"; });
  expectRefused("an attachment");
  with([](Json& j) { j["labels"].push_back(j["labels"][0]); });
  expectRefused("two structures of one name");
  with([](Json& j) { j["meshes"].push_back(j["meshes"][0]); });
  expectRefused("two meshes of one name");
  with(
      [](Json& j)
      {
        j["labels"][0]["structures"].push_back(j["labels"][0]["structures"][0]);
        j["labels"][0]["structures"][1]["name"] = "tumour";
      });
  expectRefused("one label");
  with([](Json& j) { j["labels"][0]["structures"][0]["index"] = 999; });
  expectRefused("not in its label map");
  with([](Json& j)
       { j["labels"][0]["structures"][0]["voxels"] = std::uint64_t{1000000000000000000}; });
  expectRefused("larger than its label map");
  with([](Json& j) { j["labels"][0]["structures"][0]["volume_mm3"] = 1e9; });
  expectRefused("larger than its label map");
  for (const char* part : {"labels", "meshes"})
  {
    with([part](Json& j) { j[part][0]["drawn_on"] = "nobody"; });
    expectRefused("an MR that it does not have");
  }
  with([](Json& j) { j["iso_hu"] = 1e308; });
  expectRefused("threshold of bone");
  with([](Json& j) { j["dense_bone_hu"] = -1e308; });
  expectRefused("threshold of bone");
  with([](Json& j) { std::swap(j["ct"]["min"], j["ct"]["max"]); });
  expectRefused("least intensity");
  for (const char* bound : {"min", "max"})
  {
    with([bound](Json& j)
         { j["ct"][bound] = std::string(bound) == "min" ? Json(-5e9) : Json(1400); });
    expectRefused("the intensities that are stated");
  }
  with([](Json& j) { j["mr"][0]["max"] = 1e6; });
  expectRefused("the intensities that are stated");
  with([](Json& j) { j["mr"][0]["grid"]["origin_mm"] = {0, 0, 0}; });
  expectRefused("MR 'T2' does not lie where its voxels say");
  with([](Json& j) { j["mr"][0]["grid"]["dims"] = {20, 20, 20, 20, 20, 20}; });
  expectRefused("more than three axes");
  with([](Json& j) { j["mr"][0]["mr_from_ct"]["translation_mm"] = {1e30, 0, 0}; });
  expectRefused("more than 1 km");
  with([](Json& j) { j["mr"][0]["mr_from_ct"]["quaternion_wxyz"] = {1000, 0, 0, 0}; });
  expectRefused("not a unit quaternion");
  with([](Json& j) { j["mr"][0]["mr_from_ct"]["quaternion_wxyz"] = {1, 0, 0, 0, "x"}; });
  expectRefused("not a unit quaternion");
  with([](Json& j) { j["mr"][0]["mr_from_ct"]["quaternion_wxyz"] = {0, 0, 0, 0}; });
  expectRefused("is not a sound archive of a case: case.json: rigid transform: the quaternion");
  expectRefused("nothing was restored; get the file again");
  with([](Json& j) { j["ct"]["modality"] = "\x1b[31mred\n"; });
  expectRefused("unknown modality");
  with([](Json& j) { j["ct"]["name"] = "../../x"; });
  expectRefused("not a valid one");

  // What older programs left in a case is mended.
  with(
      [](Json& j)
      {
        j["petrous_case"] = 6;
        j["view"]["slices"] = {{"crosshair_mm", {0, 0, 0}},
                               {"window_width", 100},
                               {"window_level", 50},
                               {"overlay", {{"mr", "gone"}, {"mode", "blend"}, {"opacity", 0.5}}}};
        j["mr"][0]["registration"] = {{"method", "by hand"},
                                      {"refined", false},
                                      {"verdict", "good"},
                                      {"text", ""},
                                      {"through", "gone"}};
      });
  Library mended(m_folder.path() / "mended");
  restoreCase(mended, m_file);
  EXPECT_FALSE(mended.open("ear").view.slices->overlay);
  EXPECT_EQ(mended.open("ear").mr[0].registration->through, "");
}

// Six voxels of 0.4 mm, and the four faces of a tetrahedron.
TEST_F(Archives, HaveTheSizesOfTheirVoxelsAndMeshes)
{
  using Json = nlohmann::json;
  archiveCase(m_library, "ear", m_file);
  const std::string whole = bytesOf(m_file);
  const std::pair<std::function<void(Json&)>, const char*> lies[] = {
      {[](Json& j) { j["labels"][0]["structures"][0]["volume_mm3"] = 55.5; }, "'nerve'"},
      {[](Json& j) { j["labels"][0]["structures"][0]["volume_mm3"] = 0.0; }, "'nerve'"},
      {[](Json& j) { j["labels"][0]["structures"][0]["voxels"] = 7; }, "'nerve'"},
      {[](Json& j) { j["meshes"][0]["triangles"] = 1000; }, "'incus'"}};
  int n = 0;
  for (const auto& [lie, name] : lies)
  {
    write(whole);
    if (!rewriteManifest(lie))
      GTEST_SKIP() << "no python3 to unpack the archive with";
    Library other(m_folder.path() / ("other" + std::to_string(n++)));
    const std::vector<std::string> notes = restoreCase(other, m_file).notes;
    ASSERT_EQ(notes.size(), 1U);
    EXPECT_NE(notes[0].find(name), std::string::npos) << notes[0];
    const scene::Case value = other.open("ear");
    EXPECT_EQ(value.labels[0].structures[0].voxels, 6U);
    EXPECT_NEAR(value.labels[0].structures[0].volume, 6 * 0.4 * 0.4 * 0.4, 1e-9);
    EXPECT_EQ(value.meshes[0].triangles, 4U);
  }
  write(whole);
  Library sound(m_folder.path() / "sound");
  EXPECT_TRUE(restoreCase(sound, m_file).notes.empty()) << "nothing is said of what is right";
}

// A ball of 1 mm moved by 0.5 mm has removed less than 6 mm^3.
TEST_F(Archives, WhoseStrokesRemovedWhatTheirVoxelsCannotHoldAreRefused)
{
  using Json = nlohmann::json;
  archiveCase(m_library, "ear", m_file);
  const std::string whole = bytesOf(m_file);
  const std::function<void(Json&)> lies[] = {
      [](Json& j) { j["dissection"]["strokes"][0]["removed_mm3"] = 500.0; },
      [](Json& j) { j["dissection"]["strokes"][1]["removed_mm3"] = -4.0; },
      [](Json& j) {
        j["dissection"]["strokes"][0]["structures"] = {{{"name", "nerve"}, {"removed_mm3", 1e6}}};
      }};
  for (const auto& lie : lies)
  {
    write(whole);
    if (!rewriteManifest(lie))
      GTEST_SKIP() << "no python3 to unpack the archive with";
    const std::string text = refused();
    EXPECT_NE(text.find("removed more than its voxels hold"), text.npos) << text;
  }
}

// The error of a registration is measured, so what is stated is kept; but it is a distance.
TEST_F(Archives, WhoseRegistrationHasNoErrorThatCanBeAreRefused)
{
  scene::Case value = m_library.open("ear");
  scene::ImagePart mr = test::smallCase("mr", 20).ct;
  mr.name = "T2";
  mr.registered = true;
  mr.registration.emplace();
  mr.registration->error = scene::RegistrationError{};
  mr.registration->error->median = 0.75;
  value.mr.push_back(mr);
  m_library.save(value);
  archiveCase(m_library, "ear", m_file);
  const std::string whole = bytesOf(m_file);
  for (const char* field : {"median_mm", "p95_mm", "max_mm"})
    for (const nlohmann::json& number : {nlohmann::json(-0.5), nlohmann::json()})
    {
      write(whole);
      if (!rewriteManifest([&](nlohmann::json& j)
                           { j["mr"][0]["registration"]["error"][field] = number; }))
        GTEST_SKIP() << "no python3 to unpack the archive with";
      const std::string text = refused();
      EXPECT_NE(text.find("not a sound archive"), text.npos) << field << ": " << text;
    }
  write(whole);
  Library other(m_folder.path() / "other");
  restoreCase(other, m_file);
  EXPECT_EQ(other.open("ear").mr.at(0).registration->error->median, 0.75);
}

// The voxels prove that a plan fits; whose they are said to be is told.
TEST_F(Archives, OfAPlanTellOfAnotherPatient)
{
  const auto withPatient = [](Library& library, const char* name, char id)
  {
    scene::Case value = test::smallCase(name);
    value.ct.patient.id = std::string(64, id);
    value.ct.patient.name = std::string(64, 'f');
    library.save(value);
  };
  const auto restored = [this](Library& library, const char* as, const char* ct) {
    return restoreCase(library, m_file, {as, ct}).notes;
  };
  withPatient(m_library, "planned", 'a');
  withPatient(m_library, "other", 'b');
  archiveCase(m_library, "planned", m_file, {true});
  EXPECT_TRUE(restored(m_library, "one", "").empty()) << "the planned case's CT is there";
  EXPECT_TRUE(restored(m_library, "two", "planned").empty());
  const auto notes = restored(m_library, "three", "other");
  ASSERT_EQ(notes.size(), 1U);
  EXPECT_NE(notes[0].find("of another patient than that of case 'other'"), std::string::npos)
      << notes[0];
  EXPECT_TRUE(m_library.contains("three")) << "it opens";

  // Hashes of two libraries have two salts: nothing follows from their difference.
  Library elsewhere(m_folder.path() / "elsewhere");
  withPatient(elsewhere, "same", 'a');
  const auto unknown = restored(elsewhere, "four", "");
  ASSERT_EQ(unknown.size(), 1U);
  EXPECT_NE(unknown[0].find("case 'same'"), std::string::npos) << unknown[0];
  EXPECT_NE(unknown[0].find("cannot be told"), std::string::npos) << unknown[0];
}

// A case whose files state no patient has but the pseudonym of the case that it was exported from.
TEST_F(Archives, OfAPlanTellOfAnotherPseudonym)
{
  for (const auto& [name, pseudonym] : {std::pair("planned", 'a'), std::pair("other", 'b')})
  {
    scene::Case value = test::smallCase(name);
    value.ct.patient.nameParts = {std::string(64, pseudonym)};
    m_library.save(value);
  }
  archiveCase(m_library, "planned", m_file, {true});
  EXPECT_TRUE(restoreCase(m_library, m_file, {"one", "planned"}).notes.empty());
  EXPECT_EQ(restoreCase(m_library, m_file, {"two", "other"}).notes.size(), 1U);
}

TEST_F(Archives, AreRestoredInAnEmptyFolder)
{
  archiveCase(m_library, "ear", m_file);
  fs::create_directory(m_folder.path() / "empty"); // without a salt
  Library other(m_folder.path() / "empty");
  restoreCase(other, m_file);
  EXPECT_TRUE(other.verify().damaged.empty());
}
