#include <algorithm>
#include <cstdlib>

#include <gtest/gtest.h>
#include <libdeflate.h>

#include "TestCase.h"
#include "petrous/Library/Archive.h"
#include "petrous/Library/CaseSearch.h"
#include "petrous/Library/Journal.h"
#include "petrous/Library/ThumbnailAge.h"
#include "petrous/Scene/Manifest.h"

using namespace petrous;
using namespace petrous::library;
using test::contentOf;
using test::refusal;
using test::smallCase;
using test::TemporaryFolder;

namespace fs = std::filesystem;

namespace
{

Description fullDescription()
{
  Description description;
  description.note = "Zeile eins\nhoher Bulbus jugularis\n";
  description.tags = {"Lehre", "Öhrchen"};
  description.diagnosis = "Cholesteatoma, attic";
  description.procedure = "Canal-wall-up mastoidectomy";
  description.side = scene::Side::Left;
  description.date = "2026-03-31";
  return description;
}

std::vector<std::string> namesOf(const std::vector<CaseSummary>& cases)
{
  std::vector<std::string> names;
  for (const CaseSummary& one : cases)
    names.push_back(one.name);
  return names;
}

using Names = std::vector<std::string>;

// A PNG as the standard has it, written here without the code under test.
struct TestPng
{
  std::vector<std::pair<std::string, std::string>> chunks;

  static std::string number(std::uint32_t value)
  {
    std::string text;
    for (int shift = 24; shift >= 0; shift -= 8)
      text += static_cast<char>(value >> static_cast<unsigned>(shift));
    return text;
  }

  static std::string packed(const std::string& bytes)
  {
    libdeflate_compressor* const packer = libdeflate_alloc_compressor(6);
    std::string out(libdeflate_zlib_compress_bound(packer, bytes.size()), '\0');
    out.resize(
        libdeflate_zlib_compress(packer, bytes.data(), bytes.size(), out.data(), out.size()));
    libdeflate_free_compressor(packer);
    return out;
  }

  explicit TestPng(int width = kThumbnailWidth, int height = kThumbnailHeight)
  {
    std::string rows;
    for (int row = 0; row < height; ++row)
    {
      rows += '\0';
      for (int n = 0; n < 3 * width; ++n)
        rows += static_cast<char>(row * n);
    }
    chunks = {{"IHDR", number(static_cast<std::uint32_t>(width)) +
                           number(static_cast<std::uint32_t>(height)) +
                           std::string("\x08\x02\0\0\0", 5)},
              {"IDAT", packed(rows)},
              {"IEND", ""}};
  }

  std::vector<std::uint8_t> bytes() const
  {
    std::string text = "\x89PNG\r\n\x1a\n";
    for (const auto& [type, body] : chunks)
    {
      const std::string summed = type + body;
      text += number(static_cast<std::uint32_t>(body.size())) + summed +
              number(libdeflate_crc32(0, summed.data(), summed.size()));
    }
    return {text.begin(), text.end()};
  }
};

fs::path onlyFileIn(const fs::path& folder)
{
  std::vector<fs::path> files;
  for (const auto& entry : fs::directory_iterator(folder))
    files.push_back(entry.path());
  EXPECT_EQ(files.size(), 1U);
  return files.empty() ? fs::path() : files.front();
}

class Descriptions : public ::testing::Test
{
protected:
  void save(const std::string& name, const Description& description = {})
  {
    scene::Case value = smallCase(name, 12);
    value.description = description;
    m_library.save(value);
  }

  fs::path folder() const { return m_folder.path() / "library"; }
  /// Every byte of the index.
  std::string raw() const
  {
    std::string all;
    for (const auto& entry : fs::directory_iterator(folder()))
      if (entry.path().filename().string().rfind("library.sqlite", 0) == 0)
      {
        std::ifstream file(entry.path(), std::ios::binary);
        all.append(std::istreambuf_iterator<char>(file), {});
      }
    return all;
  }

  TemporaryFolder m_folder;
  Library m_library{m_folder.path() / "library"};
};

} // namespace

TEST_F(Descriptions, AreKeptWithTheCaseAndListed)
{
  save("ear");
  EXPECT_TRUE(m_library.description("ear").empty());
  m_library.describe("ear", fullDescription());
  const Library again(folder());
  EXPECT_EQ(again.description("ear"), fullDescription());
  EXPECT_EQ(again.open("ear").description, fullDescription());
  const auto listed = again.list();
  ASSERT_EQ(listed.size(), 1U);
  Description withoutNote = fullDescription();
  withoutNote.note.clear();
  EXPECT_EQ(listed[0].description, withoutNote);
  EXPECT_TRUE(listed[0].hasNote);
  EXPECT_FALSE(listed[0].hasThumbnail);
  EXPECT_EQ(listed[0].id, again.open("ear").id);

  // Read from the manifests, the list is the same.
  fs::remove(folder() / "library.sqlite");
  const auto read = again.list();
  EXPECT_EQ(read[0].description, withoutNote);
  EXPECT_TRUE(read[0].hasNote);
  EXPECT_EQ(read[0].id, listed[0].id);
  Library(folder()).repair();
  EXPECT_EQ(again.list()[0].description, withoutNote);
}

TEST_F(Descriptions, OfTheSameContentAreNotSavedAgain)
{
  save("ear", fullDescription());
  const auto before = contentOf(folder());
  m_library.describe("ear", fullDescription());
  EXPECT_EQ(contentOf(folder()), before);
}

TEST_F(Descriptions, ThatAreInvalidLeaveTheCaseAsItWas)
{
  save("ear", fullDescription());
  const auto before = contentOf(folder());
  Description wrong = fullDescription();
  wrong.diagnosis = "two\nlines";
  EXPECT_THROW(m_library.describe("ear", wrong), core::InvalidParameter);
  EXPECT_EQ(contentOf(folder()), before);
  EXPECT_EQ(refusal([&] { m_library.describe("nose", {}); }).first, LibraryError::Reason::NotFound);
}

TEST_F(Descriptions, AreNotLostBySavesOfOthers)
{
  save("ear");
  scene::Case open = m_library.open("ear");
  m_library.loadDissection(open);
  const SavedState base(open);
  m_library.describe("ear", fullDescription());
  open.iso = 17.0;
  EXPECT_EQ(refusal([&] { m_library.save(open); }).first, LibraryError::Reason::Conflict);
  test::drill(open, {4, 4, 4});
  m_library.saveDrilled(open, base);
  EXPECT_EQ(m_library.open("ear").description, fullDescription());
  EXPECT_EQ(m_library.open("ear").applied(), 1U);
}

TEST_F(Descriptions, AreFound)
{
  save("a", fullDescription());
  Description other;
  other.tags = {"research"};
  other.diagnosis = "Vestibular schwannoma";
  other.side = scene::Side::Right;
  other.date = "2026-04-01";
  save("b", other);
  other = {};
  other.tags = {"Research", "lehre"};
  other.side = scene::Side::Both;
  other.note = "von B gelernt";
  save("c", other);
  save("d");

  const auto found = [this](const auto& set)
  {
    CaseFilter filter;
    set(filter);
    return namesOf(m_library.search(filter));
  };
  EXPECT_EQ(found([](CaseFilter&) {}), (Names{"a", "b", "c", "d"}));
  EXPECT_EQ(found([](auto& f) { f.text = "CHOLESTEATOMA attic"; }), (Names{"a"}));
  EXPECT_EQ(found([](auto& f) { f.text = "lehre"; }), (Names{"a", "c"}));
  EXPECT_EQ(found([](auto& f) { f.text = "öhrchen"; }), (Names{"a"}));
  EXPECT_EQ(found([](auto& f) { f.text = "nerve"; }), (Names{"a", "b", "c", "d"})) << "a part";
  EXPECT_EQ(found([](auto& f) { f.tags = {"RESEARCH"}; }), (Names{"b", "c"}));
  EXPECT_EQ(found([](auto& f) { f.tags = {"research", "lehre"}; }), (Names{"c"}));
  EXPECT_EQ(found([](auto& f) { f.tags = {"resear"}; }), Names{}) << "tags are whole";
  EXPECT_EQ(found([](auto& f) { f.diagnosis = "schwannoma vestib"; }), (Names{"b"}));
  EXPECT_EQ(found([](auto& f) { f.procedure = "mastoidectomy"; }), (Names{"a"}));
  EXPECT_EQ(found([](auto& f) { f.side = scene::Side::Left; }), (Names{"a"}));
  EXPECT_EQ(found([](auto& f) { f.side = scene::Side::Both; }), (Names{"c"}));
  EXPECT_EQ(found([](auto& f) { f.side = scene::Side::Unknown; }), (Names{"d"}));
  EXPECT_EQ(found([](auto& f) { f.from = "2026-04-01"; }), (Names{"b"}));
  EXPECT_EQ(found([](auto& f) { f.to = "2026-03-31"; }), (Names{"a"}));
  EXPECT_EQ(found([](auto& f) { f.from = "2026-03-31", f.to = "2026-04-01"; }), (Names{"a", "b"}));
  EXPECT_EQ(found([](auto& f) { f.text = "research", f.side = scene::Side::Right; }), (Names{"b"}));
  EXPECT_EQ(found([](auto& f) { f.text = "bulbus"; }), Names{}) << "notes are not in the index";
  EXPECT_EQ(found([](auto& f) { f.text = "bulbus", f.inNotes = true; }), (Names{"a"}));
  EXPECT_EQ(found([](auto& f) { f.text = "lehre BULBUS", f.inNotes = true; }), (Names{"a"}));
  EXPECT_EQ(namesOf(m_library.search("cholesteatoma")), (Names{"a"}));
  for (const auto& [from, to] :
       {std::pair{"2026-4-1", ""}, {"", "soon"}, {"2026-04-02", "2026-04-01"}})
  {
    CaseFilter filter;
    filter.from = from;
    filter.to = to;
    EXPECT_THROW(m_library.search(filter), core::InvalidParameter) << from << " " << to;
  }
}

// A window gives up a search that another one follows.
TEST_F(Descriptions, OfManyCasesAreSearchedUntilThatIsCancelled)
{
  scene::Case value = smallCase("a");
  value.description.note = "bulbus";
  m_library.save(value);
  CaseFilter filter;
  filter.text = "bulbus";
  const auto token = std::make_shared<core::CancelToken>();
  const core::Progress progress(nullptr, token);
  std::set<std::string> tags;
  filter.inNotes = true;
  EXPECT_EQ(namesOf(searchCases(m_library, filter, tags, progress)), (Names{"a"}));
  token->cancel();
  EXPECT_THROW(searchCases(m_library, filter, tags, progress), core::CancelledError);
}

TEST_F(Descriptions, LeaveNoNoteInTheIndexAndNothingThatWasTakenOut)
{
  Description description = fullDescription();
  description.note = "Zaphod Beeblebrox, born 1952";
  description.diagnosis = "Trillianosis";
  description.tags = {"Slartibartfast"};
  save("ear", description);
  EXPECT_NE(raw().find("Trillianosis"), std::string::npos);
  EXPECT_EQ(raw().find("Beeblebrox"), std::string::npos);
  EXPECT_EQ(raw().find("beeblebrox"), std::string::npos);
  m_library.describe("ear", {});
  for (const char* word : {"Trillianosis", "trillianosis", "Slartibartfast", "slartibartfast"})
    EXPECT_EQ(raw().find(word), std::string::npos) << word;
}

TEST_F(Descriptions, GoThroughRenameCopyAndDelete)
{
  save("ear", fullDescription());
  m_library.setThumbnail("ear", TestPng().bytes());
  m_library.rename("ear", "left");
  m_library.copy("left", "other");
  for (const char* name : {"left", "other"})
  {
    EXPECT_EQ(m_library.description(name), fullDescription()) << name;
    EXPECT_EQ(m_library.thumbnail(name), TestPng().bytes()) << name;
  }
  m_library.remove("left");
  m_library.undelete("left");
  EXPECT_EQ(m_library.description("left"), fullDescription());
  EXPECT_EQ(m_library.thumbnail("left"), TestPng().bytes());
}

TEST_F(Descriptions, TravelWithArchivesButForTheDate)
{
  save("ear", fullDescription());
  m_library.setThumbnail("ear", TestPng().bytes());
  const fs::path file = m_folder.path() / "ear.petrous";
  const auto restored = [&](const ArchiveOptions& options, const std::string& name)
  {
    archiveCase(m_library, "ear", file, options);
    Library other(options.planOnly ? folder() : m_folder.path() / "other");
    restoreCase(other, file, {name, ""});
    return std::pair(other.description(name), other.thumbnail(name));
  };
  Description expected = fullDescription();
  expected.date.clear();
  EXPECT_EQ(restored({}, "a"), std::pair(expected, TestPng().bytes()));
  EXPECT_EQ(m_library.description("ear"), fullDescription());

  ArchiveOptions options;
  options.keepIdentity = true;
  EXPECT_EQ(restored(options, "b").first, fullDescription());
  options = {};
  options.withoutNotes = true;
  expected.note.clear();
  EXPECT_EQ(restored(options, "c").first, expected);
  EXPECT_FALSE(contentOf(m_folder.path() / "other").empty());

  options = {};
  options.planOnly = true;
  expected.note = fullDescription().note;
  EXPECT_EQ(restored(options, "d"), std::pair(expected, std::vector<std::uint8_t>()))
      << "a plan brings no picture";
}

TEST_F(Descriptions, OfAnArchiveSayWhatStaysAndWhatGoesAlong)
{
  save("ear", fullDescription());
  const fs::path file = m_folder.path() / "ear.petrous";
  ArchiveOptions options;
  EXPECT_EQ(archiveCase(m_library, "ear", file, options).notes.size(), 2U);
  options.keepIdentity = options.withoutNotes = true;
  EXPECT_EQ(archiveCase(m_library, "ear", file, options).notes.size(), 1U);
  m_library.describe("ear", {});
  EXPECT_TRUE(archiveCase(m_library, "ear", file).notes.empty());
}

TEST(Thumbnail, IsAPngOfItsSizeThatHoldsNothingElse)
{
  EXPECT_TRUE(isThumbnail(TestPng().bytes()));
  EXPECT_FALSE(isThumbnail({}));
  EXPECT_FALSE(isThumbnail(TestPng(kThumbnailWidth + 1).bytes()));
  EXPECT_FALSE(isThumbnail(TestPng(kThumbnailWidth, kThumbnailHeight - 1).bytes()));

  const auto refused = [](const auto& change)
  {
    TestPng png;
    change(png.chunks);
    return !isThumbnail(png.bytes());
  };
  for (const char* type : {"tEXt", "iTXt", "zTXt", "tIME", "eXIf", "pHYs", "iCCP", "prVt"})
  {
    EXPECT_TRUE(refused([&](auto& c) { c.insert(c.begin() + 1, {type, "Patient Zero"}); })) << type;
    EXPECT_TRUE(refused([&](auto& c) { c.insert(c.begin() + 2, {type, ""}); })) << type;
  }
  EXPECT_TRUE(refused([](auto& c) { c.push_back({"IEND", ""}); }));
  EXPECT_TRUE(refused([](auto& c) { c.back().second = "more"; }));
  EXPECT_TRUE(refused([](auto& c) { c.pop_back(); }));
  EXPECT_TRUE(refused([](auto& c) { c.erase(c.begin() + 1); }));
  EXPECT_TRUE(refused([](auto& c) { c.erase(c.begin()); }));
  EXPECT_TRUE(refused([](auto& c) { c[0].second[9] = 6; })) << "RGBA";
  EXPECT_TRUE(refused([](auto& c) { c[1].second += "hidden"; }));
  const auto withRows = [&](const std::string& rows)
  { return refused([&](auto& c) { c[1].second = TestPng::packed(rows); }); };
  constexpr std::size_t kBytes = (1 + 3 * kThumbnailWidth) * kThumbnailHeight;
  EXPECT_FALSE(withRows(std::string(kBytes, '\0')));
  EXPECT_TRUE(withRows(std::string(kBytes - 1, '\0')));
  EXPECT_TRUE(withRows(std::string(kBytes + 1, '\0')));
  EXPECT_TRUE(withRows(std::string(64U << 20, '\0'))) << "a bomb";
  EXPECT_TRUE(withRows(std::string(kBytes, '\7'))) << "an unknown filter";
  TestPng split;
  split.chunks.insert(split.chunks.begin() + 2, {"IDAT", split.chunks[1].second.substr(100)});
  split.chunks[1].second.resize(100);
  EXPECT_TRUE(isThumbnail(split.bytes()));

  const auto png = TestPng().bytes();
  for (std::size_t n = 0; n < png.size(); n += n < 64 ? 1 : 131)
  {
    auto damaged = png;
    damaged[n] ^= 0x10;
    EXPECT_FALSE(isThumbnail(damaged)) << "byte " << n;
    damaged = png;
    damaged.resize(n);
    EXPECT_FALSE(isThumbnail(damaged)) << "cut at " << n;
  }
}

TEST_F(Descriptions, HaveAThumbnailThatChangesNoManifest)
{
  save("ear");
  scene::Case open = m_library.open("ear");
  const auto before = contentOf(folder() / "cases");
  m_library.setThumbnail("ear", TestPng().bytes());
  EXPECT_EQ(contentOf(folder() / "cases"), before);
  open.iso = 321.0;
  m_library.save(open); // no conflict
  EXPECT_TRUE(m_library.list()[0].hasThumbnail);
  EXPECT_EQ(m_library.thumbnail(m_library.list()[0]), TestPng().bytes());
  EXPECT_TRUE(m_library.verify().damaged.empty());

  EXPECT_THROW(m_library.setThumbnail("ear", {1, 2, 3}), core::InvalidParameter);
  EXPECT_EQ(m_library.thumbnail("ear"), TestPng().bytes());
  EXPECT_EQ(refusal([&] { m_library.setThumbnail("nose", TestPng().bytes()); }).first,
            LibraryError::Reason::NotFound);
}

TEST_F(Descriptions, NeedAThumbnailWhereThereIsNoneOrTheCaseIsNewer)
{
  save("ear");
  const auto needs = [this] { return needsThumbnail(m_library, m_library.list().at(0)); };
  EXPECT_TRUE(needs());
  m_library.setThumbnail("ear", TestPng().bytes());
  EXPECT_FALSE(needs());
  const fs::path manifest = folder() / "cases" / "ear.json";
  const auto drawn = fs::last_write_time(onlyFileIn(folder() / "thumbnails"));
  fs::last_write_time(manifest, drawn + std::chrono::seconds(1)); // saved since
  EXPECT_TRUE(needs());
  // Recovering what a killed program left is for who opens the case.
  std::ofstream(folder() / "cases" / "ear.journal") << "strokes";
  EXPECT_FALSE(needs());
  fs::remove(folder() / "cases" / "ear.journal");
  EXPECT_TRUE(needs());
  CaseSummary other = m_library.list().at(0);
  other.damaged = true;
  EXPECT_FALSE(needsThumbnail(m_library, other));
  other.damaged = false;
  other.id = "../cases/ear";
  EXPECT_FALSE(needsThumbnail(m_library, other));
}

TEST_F(Descriptions, NeverShowThePictureOfAnotherCaseOfTheName)
{
  save("ear");
  m_library.setThumbnail("ear", TestPng().bytes());
  m_library.remove("ear");
  save("ear");
  EXPECT_TRUE(m_library.thumbnail("ear").empty());
  EXPECT_FALSE(m_library.list()[0].hasThumbnail);
}

TEST_F(Descriptions, OfADamagedThumbnailAreNamedByVerify)
{
  save("ear");
  m_library.setThumbnail("ear", TestPng().bytes());
  const fs::path file = onlyFileIn(folder() / "thumbnails");
  std::fstream(file, std::ios::binary | std::ios::in | std::ios::out).seekp(2000).put('x').put('y');
  const Inspection found = m_library.verify();
  ASSERT_EQ(found.damaged.size(), 1U);
  EXPECT_EQ(found.damaged[0].object, "thumbnails/" + file.filename().string());
  EXPECT_EQ(found.damaged[0].cases, Names{"ear"});
  EXPECT_TRUE(m_library.thumbnail("ear").empty());
  m_library.setThumbnail("ear", TestPng().bytes());
  EXPECT_TRUE(m_library.verify().damaged.empty());

  fs::remove(file);
  fs::create_directory(file); // no picture, no crash
  EXPECT_TRUE(m_library.thumbnail("ear").empty());
  EXPECT_EQ(m_library.verify().damaged.size(), 1U);
}

TEST_F(Descriptions, ThumbnailsOfDeletedCasesGoWithThem)
{
  save("a");
  save("b");
  m_library.setThumbnail("a", TestPng().bytes());
  m_library.setThumbnail("b", TestPng().bytes());
  m_library.remove("a");
  EXPECT_EQ(contentOf(folder() / "thumbnails").size(), 2U) << "a may come back";
  std::ofstream(folder() / "thumbnails" / "notes.txt") << "of somebody else";
  m_library.collectGarbage();
  EXPECT_EQ(contentOf(folder() / "thumbnails").size(), 2U);
  EXPECT_EQ(m_library.thumbnail("b"), TestPng().bytes());
  EXPECT_TRUE(fs::exists(folder() / "thumbnails" / "notes.txt"));
}

// The id is a part of a path, and a manifest may be anybody's.
TEST_F(Descriptions, AnIdOfAManifestLeadsNowhere)
{
  save("ear");
  const fs::path outside = m_folder.path() / "outside.png";
  const auto png = TestPng().bytes();
  std::ofstream(outside, std::ios::binary)
      .write(reinterpret_cast<const char*>(png.data()), static_cast<std::streamsize>(png.size()));
  scene::Case value = m_library.open("ear");
  for (const std::string& id : {std::string("../../outside"), outside.stem().string(),
                                std::string("/etc/passwd"), std::string(33, 'a'), std::string()})
  {
    value.id = id;
    std::ofstream(folder() / "cases" / "ear.json") << scene::toManifest(value);
    EXPECT_TRUE(m_library.thumbnail("ear").empty()) << id;
    EXPECT_FALSE(m_library.list()[0].hasThumbnail) << id;
    EXPECT_THROW(m_library.setThumbnail("ear", png), core::InvalidParameter) << id;
    EXPECT_TRUE(m_library.verify().damaged.empty()) << id;
  }
}

TEST_F(Descriptions, OfAnArchiveWithAForeignThumbnailAreRefused)
{
  save("ear");
  TestPng png;
  m_library.setThumbnail("ear", png.bytes());
  const fs::path file = m_folder.path() / "ear.petrous";
  archiveCase(m_library, "ear", file);
  // Unpacked and packed again by Python, with another picture in the index.
  const auto restoredWith = [&](const std::string& change)
  {
    const fs::path out = m_folder.path() / "changed.petrous";
    const fs::path script = m_folder.path() / "change.py";
    std::ofstream(script) << "import zipfile, json, base64, sys\n"
                             "i = zipfile.ZipFile(sys.argv[1]); o = zipfile.ZipFile(sys.argv[2], "
                             "'w')\n"
                             "for n in i.namelist():\n"
                             "    b = i.read(n)\n"
                             "    if n == 'petrous.json':\n"
                             "        j = json.loads(b); t = j['thumbnail_png']\n"
                             "        "
                          << change
                          << "\n"
                             "        b = json.dumps(j)\n"
                             "    o.writestr(n, b)\n"
                             "o.close()\n";
    const std::string command =
        "python3 '" + script.string() + "' '" + file.string() + "' '" + out.string() + "'";
    if (std::system(command.c_str()) != 0)
      return std::string("no python");
    Library other(m_folder.path() / "other");
    try
    {
      restoreCase(other, out, {});
      EXPECT_EQ(other.thumbnail("ear"), png.bytes());
      return std::string();
    }
    catch (const LibraryError& error)
    {
      EXPECT_FALSE(other.contains("ear"));
      return std::string(error.what());
    }
  };
  if (restoredWith("j['thumbnail_png'] = t[:-8]") == "no python")
    GTEST_SKIP() << "needs python3";
  for (const char* change : {"j['thumbnail_png'] = t[:-8]", "j['thumbnail_png'] = ''",
                             "j['thumbnail_png'] = t + '!'", "j['thumbnail_png'] = 'A' * 4000000",
                             "j['thumbnail_png'] = base64.b64encode(b'<svg onload=x>').decode()"})
    EXPECT_NE(restoredWith(change).find("thumbnail"), std::string::npos) << change;
  EXPECT_FALSE(restoredWith("j['thumbnail_png'] = 7").empty());
  EXPECT_EQ(restoredWith("pass"), "");
}
