#include <algorithm>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <sys/stat.h>

#include "TestCase.h"
#include "petrous/Core/InputFile.h"
#include "petrous/Library/Archive.h"
#include "petrous/Library/Attachments.h"
#include "petrous/Library/ObjectStore.h"
#include "petrous/Scene/Manifest.h"

using namespace petrous;
using namespace petrous::library;
using scene::Attachment;
using test::refusal;
using test::savedCase;
using test::TemporaryFolder;

namespace
{

namespace fs = std::filesystem;
using Reason = LibraryError::Reason;
using Bytes = std::vector<std::uint8_t>;

std::string big(std::uint32_t value)
{
  std::string text;
  for (int shift = 24; shift >= 0; shift -= 8)
    text += static_cast<char>(value >> shift);
  return text;
}

/// A PNG chunk with its checksum [PNG, 2nd edition, 5.3 and annex D].
std::string chunk(const std::string& type, const std::string& body)
{
  const std::string all = type + body;
  std::uint32_t crc = 0xffffffffU;
  for (const char c : all)
  {
    crc ^= static_cast<unsigned char>(c);
    for (int bit = 0; bit < 8; ++bit)
      crc = (crc >> 1) ^ ((crc & 1) != 0 ? 0xedb88320U : 0U);
  }
  return big(static_cast<std::uint32_t>(body.size())) + all + big(~crc);
}

/// A zlib stream of one stored block [RFC 1950, 1951].
std::string packed(const std::string& raw)
{
  std::uint32_t a = 1;
  std::uint32_t b = 0;
  for (const char c : raw)
  {
    a = (a + static_cast<unsigned char>(c)) % 65521;
    b = (b + a) % 65521;
  }
  const auto count = static_cast<char>(raw.size());
  return std::string("\x78\x01\x01", 3) + count + '\0' + static_cast<char>(~count) + '\xff' + raw +
         big(b << 16 | a);
}

const std::string kSignature = "\x89PNG\r\n\x1a\n";

/// 2 x 2 grey pixels, with what else a PNG may hold.
std::string pngWith(const std::string& more)
{
  return kSignature + chunk("IHDR", big(2) + big(2) + std::string("\x08\0\0\0\0", 5)) + more +
         chunk("IDAT", packed(std::string("\0ab\0cd", 6))) + chunk("IEND", "");
}

fs::path write(const fs::path& path, const std::string& bytes)
{
  std::ofstream(path, std::ios::binary) << bytes;
  return path;
}

std::string read(const fs::path& path)
{
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

const std::string kVideo = std::string("\0\0\0\x18", 4) + "ftypmp42 of the theatre";
const std::string kDocument = "%PDF-1.7\nof the operation";
const std::string kRecording = "PTRTICK\n of the tool";

class Attachments : public ::testing::Test
{
protected:
  Attachments()
    : m_library(m_folder.path() / "library")
    , m_value(savedCase(m_library))
  {
  }

  std::string add(const std::string& name, const std::string& bytes, bool isLink = false,
                  const std::string& note = {})
  {
    AttachOptions options;
    options.name = name;
    options.link = isLink;
    options.note = note;
    options.date = "2026-03-31";
    const std::string there =
        attach(m_value, attachmentOf(write(m_folder.path() / name, bytes), options));
    m_library.save(m_value);
    return there;
  }

  /// The content, as it is extracted.
  std::string extracted(const Library& library, const std::string& caseName,
                        const std::string& name)
  {
    const scene::Case value = library.open(caseName);
    const fs::path out = m_folder.path() / "extracted";
    extractAttachment(library, value, scene::findAttachment(value, name), out);
    return read(out);
  }

  std::vector<std::string> namesOf(const scene::Case& value)
  {
    std::vector<std::string> names;
    for (const Attachment& one : value.attachments)
      names.push_back(one.name);
    return names;
  }

  TemporaryFolder m_folder;
  Library m_library;
  scene::Case m_value;
};

using Names = std::vector<std::string>;

} // namespace

TEST_F(Attachments, AreKeptToTheByteWhateverHoldsThem)
{
  add("film.mp4", kVideo, false, "two\nlines");
  add("linked.mkv", "\x1a\x45\xdf\xa3 far away", true);
  add("plan.pdf", kDocument);
  add("tool.ticks", kRecording);
  add("view.png", pngWith(""));
  const scene::Case back = m_library.open("ear");
  using Kind = Attachment::Kind;
  const Kind kinds[] = {Kind::Video, Kind::Video, Kind::Document, Kind::Recording,
                        Kind::Screenshot};
  ASSERT_EQ(back.attachments.size(), 5U);
  for (std::size_t n = 0; n < 5; ++n)
  {
    EXPECT_EQ(back.attachments[n].kind, kinds[n]) << n;
    EXPECT_EQ(back.attachments[n].date, "2026-03-31");
    EXPECT_EQ(extracted(m_library, "ear", back.attachments[n].name),
              read(m_folder.path() / back.attachments[n].name));
  }
  EXPECT_EQ(back.attachments[0].note, "two\nlines");
  EXPECT_TRUE(back.attachments[1].object.empty());
  EXPECT_EQ(back.attachments[1].link, fs::canonical(m_folder.path() / "linked.mkv"));
  EXPECT_EQ(nlohmann::json::parse(read(m_library.folder() / "cases/ear.json"))
                .at("petrous_case")
                .get<int>(),
            6);
  EXPECT_TRUE(m_library.verify().damaged.empty());
  EXPECT_EQ(m_library.collectGarbage().objects, 0U);
  m_library.copy("ear", "copy");
  EXPECT_EQ(extracted(m_library, "copy", "FILM.mp4"), kVideo);

  // Those of a deleted case are garbage like all of it.
  m_library.remove("ear");
  m_library.remove("copy");
  m_library.collectGarbage();
  EXPECT_TRUE(ObjectStore(m_library.folder() / "objects").list().empty());
}

// A file is often named after the patient.
TEST_F(Attachments, AreNamedByTheirKindUnlessANameIsGiven)
{
  const std::pair<std::string, std::string> files[] = {{"DOE_JOHN_19310517.pdf", kDocument},
                                                       {"DOE_JOHN_19310517.MP4", kVideo},
                                                       {"DOE_JOHN.19310517", kVideo},
                                                       {"DOE_JOHN_19310517.png", pngWith("")},
                                                       {"DOE_JOHN_2026-03-31.ticks", kRecording},
                                                       {"DOE_JANE.pdf", kDocument + "2"}};
  for (const auto& [name, bytes] : files)
    attach(m_value, attachmentOf(write(m_folder.path() / name, bytes), {}));
  AttachOptions named;
  named.name = "audiogram.pdf";
  attach(m_value, attachmentOf(m_folder.path() / "DOE_JANE.pdf", named));
  m_library.save(m_value);
  EXPECT_EQ(namesOf(m_library.open("ear")),
            (Names{"document.pdf", "video.mp4", "video", "screenshot.png", "recording.ticks",
                   "document (2).pdf", "audiogram.pdf"}));
  for (const auto& [name, bytes] : test::contentOf(m_library.folder()))
  {
    EXPECT_EQ((name + bytes).find("DOE"), std::string::npos) << name;
    EXPECT_EQ((name + bytes).find("19310517"), std::string::npos) << name;
  }
}

TEST_F(Attachments, LoseTheMetadataOfAPng)
{
  const std::string dirty =
      pngWith(chunk("tEXt", std::string("Author\0Meier", 12)) + chunk("eXIf", "GPS of a house") +
              chunk("tIME", "1234567") + chunk("gAMA", big(45455)) + chunk("prVt", "Meier")) +
      "Meier, behind the end";
  add("view.png", dirty);
  const std::string clean = extracted(m_library, "ear", "view.png");
  EXPECT_EQ(clean, pngWith(chunk("gAMA", big(45455))));
  EXPECT_EQ(m_value.attachments.front().bytes, clean.size());
  for (const auto& [name, bytes] : test::contentOf(m_library.folder()))
    EXPECT_EQ(bytes.find("Meier"), std::string::npos) << name;

  const auto refused = [](std::string png)
  {
    EXPECT_THROW(cleanedPng(Bytes(png.begin(), png.end())), core::InvalidParameter)
        << png.size() << png;
  };
  const std::string whole = pngWith("");
  for (std::size_t n = 0; n < whole.size(); ++n)
    refused(whole.substr(0, n));
  for (std::size_t n = 0; n < whole.size(); ++n)
  {
    std::string other = whole;
    other[n] = static_cast<char>(other[n] ^ 1);
    refused(other);
  }
  refused(kSignature + chunk("IEND", ""));
  refused(kSignature + big(0xffffffffU) + "IHDR");
}

TEST_F(Attachments, RefuseWhatIsHostile)
{
  const auto refused = [&](const fs::path& file, const std::string& words, AttachOptions options)
  {
    try
    {
      attachmentOf(file, options);
      ADD_FAILURE() << file << " was taken";
    }
    catch (const core::InvalidParameter& error)
    {
      EXPECT_NE(std::string(error.what()).find(words), std::string::npos) << error.what();
    }
  };
  const fs::path here = m_folder.path();
  AttachOptions linked;
  linked.link = true;
  fs::create_symlink("/dev/zero", here / "zero.mp4");
  fs::create_symlink("/dev/full", here / "full.png");
  ASSERT_EQ(::mkfifo((here / "pipe.mp4").c_str(), 0600), 0);
  for (const char* name : {"zero.mp4", "full.png", "pipe.mp4"})
    for (const AttachOptions& options : {AttachOptions(), linked})
      refused(here / name, "", options);
  refused(here, "", {});
  refused(here / "missing.pdf", "", {});
  refused(write(here / "series.dcm", std::string(128, '\0') + "DICM"), "nothing that a case takes",
          {});
  refused(write(here / "empty.pdf", ""), "nothing that a case takes", {});

  // A file of many gigabytes, none of which is on the disk: refused without being read.
  write(here / "huge.mp4", kVideo);
  fs::resize_file(here / "huge.mp4", kLargestEmbedded + 1);
  refused(here / "huge.mp4", "link it", {});
  write(here / "huge.png", kSignature);
  fs::resize_file(here / "huge.png", kLargestPng + 1);
  refused(here / "huge.png", "larger", {});

  const fs::path film = write(here / "film.mp4", kVideo);
  for (const char* name : {"../film.mp4", "/etc/passwd", "a/b", "a\\b", "..", ".", "", " a", "-rf",
                           "a\nb", "a\x1b[2J", "con:", "\xff"})
  {
    AttachOptions options;
    options.name = name;
    if (*name != '\0')
      refused(film, "", options);
  }
  AttachOptions note;
  note.note = "a\x1b[2J";
  refused(film, "note", note);
  AttachOptions date;
  date.date = "tomorrow";
  refused(film, "date", date);
}

TEST_F(Attachments, GetFreeNames)
{
  EXPECT_EQ(add("film.mp4", kVideo), "film.mp4");
  EXPECT_EQ(add("film.mp4", kVideo + "2"), "film (2).mp4");
  EXPECT_EQ(add("FILM.mp4", kVideo + "3"), "FILM (3).mp4");
  const std::string longest = std::string(95, 'a') + ".mp4";
  add(longest, kVideo + "4");
  EXPECT_LE(add(longest, kVideo + "5").size(), 100U);
  EXPECT_EQ(extracted(m_library, "ear", "film (2).mp4"), kVideo + "2");
}

// A lost file costs itself: the case opens, and is saved.
TEST_F(Attachments, AreLostAlone)
{
  add("film.mp4", kVideo);
  add("plan.pdf", kDocument);
  add("far.mp4", kVideo + "far", true);
  const auto objectOf = [&](const char* name)
  { return m_library.folder() / "objects" / scene::findAttachment(m_value, name).object; };
  fs::remove(objectOf("film.mp4"));
  write(objectOf("plan.pdf"), "%PDF-damaged");
  fs::remove(m_folder.path() / "far.mp4");

  scene::Case value = m_library.open("ear");
  EXPECT_EQ(namesOf(value), (Names{"film.mp4", "plan.pdf", "far.mp4"}));
  value.iso = 333.0;
  m_library.save(value);
  EXPECT_EQ(namesOf(m_library.open("ear")), namesOf(value));
  const auto problem = [&](const char* name)
  { return attachmentProblem(m_library, scene::findAttachment(value, name)); };
  EXPECT_EQ(problem("film.mp4"), "missing");
  EXPECT_EQ(problem("plan.pdf"), "changed");
  EXPECT_EQ(problem("far.mp4"), "missing");
  EXPECT_EQ(refusal([&] { extracted(m_library, "ear", "film.mp4"); }).first, Reason::NotFound);
  EXPECT_EQ(refusal([&] { extracted(m_library, "ear", "plan.pdf"); }).first, Reason::Damaged);
  EXPECT_EQ(refusal([&] { extracted(m_library, "ear", "far.mp4"); }).first, Reason::NotFound);
  EXPECT_FALSE(fs::exists(m_folder.path() / "extracted"));

  std::vector<std::string> damaged;
  for (const auto& one : m_library.verify().damaged)
    damaged.push_back(one.text);
  ASSERT_EQ(damaged.size(), 2U);
  for (const char* name : {"film.mp4", "plan.pdf"})
    EXPECT_TRUE(std::any_of(damaged.begin(), damaged.end(),
                            [name](const std::string& text)
                            { return text.find(name) != text.npos; }))
        << name;
  const auto said = m_library.repair().lost;
  EXPECT_EQ(std::count_if(said.begin(), said.end(),
                          [](const std::string& text)
                          { return text.find("is lost") != text.npos; }),
            2);

  // An archive says what it lacks, and brings the rest.
  ArchiveOptions options;
  options.withVideos = options.withDocuments = true;
  const auto done = archiveCase(m_library, "ear", m_folder.path() / "ear.petrous", options);
  EXPECT_EQ(std::count_if(done.notes.begin(), done.notes.end(),
                          [](const std::string& text)
                          { return text.find("not in the archive") != text.npos; }),
            3);
  Library second(m_folder.path() / "second");
  restoreCase(second, m_folder.path() / "ear.petrous");
  EXPECT_TRUE(second.open("ear").attachments.empty());

  // The same file again puts it back.
  attach(value, attachmentOf(write(m_folder.path() / "again.mp4", kVideo), {}));
  m_library.save(value);
  EXPECT_EQ(extracted(m_library, "ear", "film.mp4"), kVideo);
}

TEST_F(Attachments, OfALinkAreCheckedAgainstItsHash)
{
  add("far.mp4", kVideo, true);
  EXPECT_EQ(extracted(m_library, "ear", "far.mp4"), kVideo);
  EXPECT_EQ(attachmentChange(m_library, m_value.attachments.front()), "");
  EXPECT_TRUE(m_library.verify().damaged.empty());
  std::string other = kVideo;
  other.back() = '!';
  write(m_folder.path() / "far.mp4", other); // as long
  EXPECT_EQ(attachmentProblem(m_library, m_value.attachments.front()), "") << "unread";
  EXPECT_EQ(attachmentChange(m_library, m_value.attachments.front()), "changed");
  const auto damaged = m_library.verify().damaged;
  ASSERT_EQ(damaged.size(), 1U);
  EXPECT_NE(damaged[0].text.find("far.mp4"), std::string::npos);
  EXPECT_EQ(damaged[0].cases, std::vector<std::string>{"ear"});
  ArchiveOptions options;
  options.withVideos = true;
  const auto archived = archiveCase(m_library, "ear", m_folder.path() / "ear.petrous", options);
  EXPECT_TRUE(std::any_of(archived.notes.begin(), archived.notes.end(),
                          [](const std::string& note)
                          { return note.find("its file is changed") != note.npos; }));
  EXPECT_EQ(refusal([&] { extracted(m_library, "ear", "far.mp4"); }).first, Reason::Damaged);
  fs::remove(m_folder.path() / "far.mp4");
  fs::create_symlink("/dev/zero", m_folder.path() / "far.mp4");
  EXPECT_EQ(attachmentProblem(m_library, m_value.attachments.front()), "unreadable");
  EXPECT_EQ(refusal([&] { extracted(m_library, "ear", "far.mp4"); }).first, Reason::Damaged);
}

TEST_F(Attachments, TravelButForVideosAndDocuments)
{
  add("film.mp4", kVideo, false, "of the theatre");
  add("far.mp4", kVideo + "far", true);
  add("plan.pdf", kDocument, false, "note");
  add("tool.ticks", kRecording);
  add("view.png", pngWith(""));
  add("large.ticks", kRecording + std::string(kLargestOfPlan, '.'));
  const auto taken = [&](const char* name, const ArchiveOptions& options)
  {
    const fs::path file = m_folder.path() / (std::string(name) + ".petrous");
    const auto notes = archiveCase(m_library, "ear", file, options).notes;
    EXPECT_FALSE(notes.empty());
    RestoreOptions as;
    as.name = name;
    // A plan goes where the CT is.
    Library second(options.planOnly ? m_library.folder() : m_folder.path() / "second");
    restoreCase(second, file, as);
    EXPECT_TRUE(second.verify().damaged.empty());
    const scene::Case value = second.open(name);
    for (const Attachment& one : value.attachments)
    {
      EXPECT_TRUE(one.link.empty());
      EXPECT_EQ(one.date, options.keepIdentity ? "2026-03-31" : "");
      EXPECT_EQ(extracted(second, name, one.name), read(m_folder.path() / one.name)) << one.name;
    }
    return namesOf(value);
  };
  EXPECT_EQ(taken("usual", {}), (Names{"tool.ticks", "view.png", "large.ticks"}));
  ArchiveOptions documents;
  documents.withDocuments = true;
  EXPECT_EQ(taken("documents", documents),
            (Names{"plan.pdf", "tool.ticks", "view.png", "large.ticks"}));
  ArchiveOptions all;
  all.withVideos = all.withDocuments = all.keepIdentity = true;
  EXPECT_EQ(taken("all", all), namesOf(m_value));
  ArchiveOptions plan;
  plan.planOnly = plan.withVideos = plan.withDocuments = true;
  EXPECT_EQ(taken("plan", plan), (Names{"tool.ticks", "view.png"}));
  // What stays is in no byte of the archive: entries are stored as they are.
  for (const char* text : {"theatre", "of the operation"})
    EXPECT_EQ(read(m_folder.path() / "usual.petrous").find(text), std::string::npos);
  EXPECT_NE(read(m_folder.path() / "all.petrous").find(kVideo + "far"), std::string::npos);
}

TEST_F(Attachments, BelongToAStrokeByItsObject)
{
  test::drill(m_value, {8, 8, 8});
  m_library.save(m_value);
  add("view.png", pngWith(""));
  m_value.attachments.front().stroke = m_value.dissection.strokes().front()->object;
  m_library.save(m_value);
  const scene::Case back = m_library.open("ear");
  EXPECT_EQ(scene::strokeOf(back, back.attachments.front()), 1U);
  scene::Case without = back;
  without.dissection = dissection::Dissection();
  EXPECT_EQ(scene::strokeOf(without, back.attachments.front()), 0U);
}

// What leaves is the picture, also where the case has a link, which it keeps as it is.
TEST_F(Attachments, LoseTheMetadataOfALinkedPngWhereTheyLeave)
{
  const std::string png = pngWith(chunk("tEXt", std::string("Author\0Doe^John", 15)));
  add("far.png", png, true);
  const std::string spoilt = pngWith(chunk("tEXt", "Doe^John").replace(12, 1, "!"));
  add("spoilt.png", spoilt, true);
  const fs::path file = m_folder.path() / "ear.petrous";
  const auto notes = archiveCase(m_library, "ear", file).notes;
  EXPECT_TRUE(std::any_of(notes.begin(), notes.end(),
                          [](const std::string& note)
                          {
                            return note.find("'spoilt.png'") != note.npos &&
                                   note.find("not in the archive") != note.npos;
                          }));
  EXPECT_EQ(read(file).find("Doe^John"), std::string::npos);
  Library second(m_folder.path() / "second");
  restoreCase(second, file);
  EXPECT_EQ(namesOf(second.open("ear")), Names{"far.png"});
  EXPECT_EQ(extracted(second, "ear", "far.png"), pngWith(""));
  EXPECT_TRUE(second.verify().damaged.empty());
  EXPECT_EQ(read(m_folder.path() / "far.png"), png);
  EXPECT_EQ(extracted(m_library, "ear", "far.png"), png);
}

// One bit of the same size: only its hash tells.
TEST_F(Attachments, ADamagedOneKeepsNothingElseFromLeaving)
{
  add("tool.ticks", kRecording);
  add("view.png", pngWith(""));
  std::string other = kRecording;
  other.back() = '!';
  write(m_library.folder() / "objects" / scene::findAttachment(m_value, "tool.ticks").object,
        other);
  const fs::path file = m_folder.path() / "ear.petrous";
  const auto notes = archiveCase(m_library, "ear", file).notes;
  EXPECT_TRUE(std::any_of(notes.begin(), notes.end(),
                          [](const std::string& note)
                          {
                            return note.find("'tool.ticks' is not in the archive") != note.npos &&
                                   note.find("damaged") != note.npos;
                          }));
  Library second(m_folder.path() / "second");
  restoreCase(second, file);
  EXPECT_EQ(namesOf(second.open("ear")), Names{"view.png"});
}

TEST_F(Attachments, AreNotExtractedOverWhatALibraryKeeps)
{
  add("plan.pdf", kDocument);
  savedCase(m_library, "other");
  Library second(m_folder.path() / "second");
  savedCase(second, "there");
  const auto before = test::contentOf(m_folder.path());
  const scene::Case value = m_library.open("ear");
  const fs::path link = m_folder.path() / "link";
  fs::create_directory_symlink(m_library.folder() / "objects", link);
  for (const fs::path& out :
       {m_library.folder() / "cases/other.json", m_library.folder() / "library.sqlite",
        m_library.folder() / "objects" / value.ct.object, link / value.ct.object,
        second.folder() / "cases/there.json"})
  {
    try
    {
      extractAttachment(m_library, value, value.attachments.front(), out);
      ADD_FAILURE() << out;
    }
    catch (const core::Error& error)
    {
      EXPECT_EQ(error.fault(), core::Fault::Refused) << error.what();
    }
    EXPECT_THROW(archiveCase(m_library, "ear", out), core::Error) << out;
  }
  fs::remove(link);
  EXPECT_EQ(test::contentOf(m_folder.path()), before);
  extractAttachment(m_library, value, value.attachments.front(), m_library.folder() / "my.pdf");
  EXPECT_EQ(read(m_library.folder() / "my.pdf"), kDocument);
}
