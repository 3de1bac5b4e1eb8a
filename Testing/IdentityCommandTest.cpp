#include <array>
#include <ctime>
#include <vector>

#include <zlib.h>
#include <zstd.h>

#include "DicomValidator.h"
#include "TestDicom.h"
#include "TestServers.h"

using petrous::imaging::test::TestSlice;
using namespace petrous::testing;

namespace
{

namespace fs = std::filesystem;

constexpr std::size_t kMostUnpacked = std::size_t{1} << 26;

/// A stream of deflate, as zlib's `windowBits` says (-15: raw, 31: gzip) that begins at `at`, as
/// far as it is one.
std::string inflated(const std::string& bytes, std::size_t at, int windowBits)
{
  z_stream stream = {};
  if (::inflateInit2(&stream, windowBits) != Z_OK)
    return {};
  stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(bytes.data() + at));
  stream.avail_in = static_cast<uInt>(bytes.size() - at);
  std::string out;
  std::vector<char> block(std::size_t{1} << 16);
  int state = Z_OK;
  while (state == Z_OK && out.size() < kMostUnpacked)
  {
    stream.next_out = reinterpret_cast<Bytef*>(block.data());
    stream.avail_out = static_cast<uInt>(block.size());
    state = ::inflate(&stream, Z_NO_FLUSH);
    out.append(block.data(), block.size() - stream.avail_out);
    if (state == Z_OK && stream.avail_in == 0 && stream.avail_out != 0)
      break;
  }
  ::inflateEnd(&stream);
  return out;
}

/// A frame of zstd that begins at `at`, as far as it is one.
std::string decompressed(const std::string& bytes, std::size_t at)
{
  ZSTD_DStream* stream = ::ZSTD_createDStream();
  ZSTD_inBuffer in{bytes.data() + at, bytes.size() - at, 0};
  std::string out;
  std::vector<char> block(::ZSTD_DStreamOutSize());
  for (std::size_t left = 1; left != 0 && out.size() < kMostUnpacked;)
  {
    ZSTD_outBuffer to{block.data(), block.size(), 0};
    left = ::ZSTD_decompressStream(stream, &to, &in);
    if (::ZSTD_isError(left) || (to.pos == 0 && in.pos == in.size))
      break;
    out.append(block.data(), to.pos);
  }
  ::ZSTD_freeDStream(stream);
  return out;
}

/// The bytes, and those of all that is packed in them, at any depth: zip entries, gzip members and
/// frames of zstd, wherever they begin. By zlib and zstd alone; shares no code with the program.
std::vector<std::string> unpacked(const std::string& whole)
{
  std::vector<std::string> all{whole};
  for (std::size_t n = 0; n < all.size(); ++n)
  {
    const std::string bytes = all[n];
    const auto each = [&bytes](const std::string& magic, const auto& unpack)
    {
      for (std::size_t at = bytes.find(magic); at != bytes.npos; at = bytes.find(magic, at + 1))
        unpack(at);
    };
    const auto keep = [&all](std::string found)
    {
      if (!found.empty())
        all.push_back(std::move(found));
    };
    each("\x1f\x8b\x08", [&](std::size_t at) { keep(inflated(bytes, at, 31)); });
    each("\x28\xb5\x2f\xfd", [&](std::size_t at) { keep(decompressed(bytes, at)); });
    each(std::string("PK\3\4", 4),
         [&](std::size_t at)
         {
           if (bytes.size() - at < 30 || bytes[at + 8] != 8) // deflated; else it stands there
             return;
           const auto number = [&](std::size_t byte)
           {
             return static_cast<std::size_t>(static_cast<unsigned char>(bytes[at + byte])) |
                    static_cast<std::size_t>(static_cast<unsigned char>(bytes[at + byte + 1])) << 8;
           };
           if (const std::size_t begin = at + 30 + number(26) + number(28); begin < bytes.size())
             keep(inflated(bytes, begin, -15));
         });
  }
  return all;
}

// A series with an identifier at each place where DICOM has one.
class IdentityCommand : public CommandLine
{
protected:
  std::string plant()
  {
    m_plants.push_back("Vqx" + std::to_string(4000 + m_plants.size()) + "Jw");
    return m_plants.back();
  }

  fs::path writePlanted()
  {
    const fs::path folder = m_folder / ("Gorblimey^Ethelwulf " + plant()) / plant();
    m_plants.insert(m_plants.end(), {"Gorblimey", "Ethelwulf", "1.2.77777.", "19310517"});
    std::string header; // explicit, after group 8
    TestSlice element;
    struct Place
    {
      std::uint32_t tag;
      const char* vr;
    };
    for (const Place place :
         {Place{0x00080050, "SH"}, {0x00080070, "LO"}, {0x00080080, "LO"}, {0x00080081, "ST"},
          {0x00080090, "PN"},      {0x00080092, "ST"}, {0x00080094, "SH"}, {0x00081010, "SH"},
          {0x00081030, "LO"},      {0x00081040, "LO"}, {0x00081048, "PN"}, {0x00081050, "PN"},
          {0x00081060, "PN"},      {0x00081070, "PN"}, {0x00081080, "LO"}, {0x00081090, "LO"},
          {0x00082111, "ST"},      {0x00090010, "LO"}, {0x00091001, "UN"}, {0x00091002, "LT"},
          {0x00100020, "LO"},      {0x00100021, "LO"}, {0x00101000, "LO"}, {0x00101001, "PN"},
          {0x00101005, "PN"},      {0x00101040, "LO"}, {0x00101060, "PN"}, {0x00101080, "LO"},
          {0x001021b0, "LT"},      {0x00104000, "LT"}, {0x00120010, "LO"}, {0x00120020, "LO"},
          {0x00120040, "LO"},      {0x00180015, "CS"}, {0x00180024, "SH"}, {0x00181000, "LO"},
          {0x00181020, "LO"},      {0x00181030, "LO"}, {0x00181210, "SH"}, {0x00200010, "SH"},
          {0x00204000, "LT"},      {0x00321032, "PN"}, {0x00321060, "LO"}, {0x00380010, "LO"},
          {0x00380300, "LO"},      {0x00384000, "LT"}, {0x00400254, "LO"}, {0x00400280, "ST"},
          {0x00401001, "SH"},      {0x00402016, "LO"}, {0x60000022, "LO"}, {0x60001500, "LO"},
          {0x60004000, "LT"}})
      element.element(header, place.tag, place.vr, plant());
    element.element(header, 0x00100030, "DA", "19310517");
    std::string inner, item;
    element.element(inner, 0x00400007, "LO", plant());
    element.element(inner, 0x0040a123, "PN", plant());
    element.append(item, 0xfffe, 2);
    element.append(item, 0xe000, 2);
    element.append(item, static_cast<std::uint32_t>(inner.size()), 4);
    element.element(header, 0x00400275, "SQ", item + inner);
    const std::string preamble = plant(), title = plant(), trailer = plant();
    const std::string name = plant(), series = plant();
    for (int k = 0; k < 12; ++k)
    {
      TestSlice slice;
      slice.columns = slice.rows = 16;
      slice.z = 0.5 * k;
      slice.seriesUid = "1.2.77777.1";
      slice.studyUid = "1.2.77777.2";
      slice.marker = false;
      slice.extra = header;
      slice.cell = [k](int i, int j)
      { return i > 3 && i < 13 && j > 3 && j < 13 && k > 2 && k < 10 ? 1200U : 0U; };
      std::string meta, start = preamble, end;
      slice.element(meta, 0x00020010, "UI", "1.2.840.10008.1.2.1");
      slice.element(meta, 0x00020016, "AE", title);
      start.resize(128, '\0');
      slice.element(end, 0xfffcfffc, "OB", trailer);
      std::string bytes = slice.bytes();
      const auto replace = [&bytes](const std::string& from, const std::string& to)
      { bytes.replace(bytes.find(from), from.size(), to); };
      replace("1.2.3.9", "1.2.777");                               // frame of reference
      replace("SECRET^NAME", (name + "^Gorblimey").substr(0, 11)); // of the same length
      replace("1.2.3.4.5.", "1.2.77777.");
      petrous::imaging::test::writeText(folder / (series + std::to_string(k) + ".dcm"),
                                        start + "DICM" + meta + bytes + end);
    }
    return folder;
  }

  // Names and bytes of all files below these folders, whatever packs them; `more`: also must not be
  // in them.
  void expectNoPlantIn(const std::vector<fs::path>& roots,
                       const std::vector<std::string>& more = {}) const
  {
    std::size_t files = 0;
    const auto look = [&](const fs::path& path)
    {
      ++files;
      for (const std::string& text : unpacked(path.filename().string() + "\n" + textOf(path)))
        for (const auto* list : {&m_plants, &more})
          for (const std::string& identifier : *list)
          {
            EXPECT_EQ(text.find(identifier), std::string::npos) << identifier << " in " << path;
            std::string wide; // UTF-16
            for (const char c : identifier)
              wide += {c, '\0'};
            EXPECT_EQ(text.find(wide), std::string::npos) << identifier << " in " << path;
          }
    };
    for (const fs::path& root : roots)
      if (fs::is_directory(root))
      {
        for (const auto& entry : fs::recursive_directory_iterator(root))
          if (entry.is_regular_file())
            look(entry.path());
      }
      else
        look(root);
    EXPECT_GT(files, roots.size());
  }

  /// Whether some file below the folder has the text, packed or not.
  static bool has(const fs::path& root, const std::string& text)
  {
    for (const auto& entry : fs::recursive_directory_iterator(root))
      if (entry.is_regular_file())
        for (const std::string& one : unpacked(textOf(entry.path())))
          if (one.find(text) != one.npos)
            return true;
    return false;
  }

  std::vector<std::string> m_plants;
};

/// Of a PNG, with what authors are named in.
std::string pngNaming(const std::string& author)
{
  const auto big = [](std::size_t value)
  {
    std::string text;
    for (int shift = 24; shift >= 0; shift -= 8)
      text += static_cast<char>(value >> shift);
    return text;
  };
  const auto chunk = [&](const std::string& type, const std::string& body)
  {
    const std::string all = type + body;
    return big(body.size()) + all +
           big(::crc32(0, reinterpret_cast<const Bytef*>(all.data()),
                       static_cast<uInt>(all.size())));
  };
  std::array<Bytef, 64> packed{};
  uLongf count = packed.size();
  const std::string pixels("\0ab\0cd", 6);
  ::compress(packed.data(), &count, reinterpret_cast<const Bytef*>(pixels.data()), pixels.size());
  return "\x89PNG\r\n\x1a\n" + chunk("IHDR", big(2) + big(2) + std::string("\x08\0\0\0\0", 5)) +
         chunk("tEXt", "Author" + std::string(1, '\0') + author) +
         chunk("IDAT", std::string(reinterpret_cast<const char*>(packed.data()), count)) +
         chunk("IEND", "") + author;
}

} // namespace

// The reader of what is packed finds what it looks for; else the tests below say nothing.
TEST_F(IdentityCommand, LooksIntoWhatIsPacked)
{
  const std::string text(5000, 'x');
  const std::string needle = text + "Gorblimey" + text;
  std::string zstd(::ZSTD_compressBound(needle.size()), '\0');
  zstd.resize(::ZSTD_compress(zstd.data(), zstd.size(), needle.data(), needle.size(), 3));
  const auto finds = [](const std::string& bytes)
  {
    const auto all = unpacked(bytes);
    return std::any_of(all.begin(), all.end(),
                       [](const auto& one) { return one.find("Gorblimey") != one.npos; });
  };
  EXPECT_TRUE(finds("in front of it " + zstd + " behind it"));
  fs::create_directories(m_folder / "inner");
  std::ofstream(m_folder / "inner/a.txt") << needle;
  const std::string at = "cd " + quoted(m_folder) + " && ";
  ASSERT_EQ(std::system((at + "gzip -k inner/a.txt").c_str()), 0);
  EXPECT_TRUE(finds("\x1f\x8b" + textOf(m_folder / "inner/a.txt.gz")));
  std::ofstream(m_folder / "zip.py") << "import zipfile\n"
                                        "with zipfile.ZipFile('inner.zip', 'w') as z:\n"
                                        "  z.write('inner/a.txt.gz')\n"
                                        "with zipfile.ZipFile('outer.zip', 'w', 8) as z:\n"
                                        "  z.write('inner.zip')\n";
  if (std::system((at + "/usr/bin/python3 zip.py 2>/dev/null").c_str()) == 0)
  {
    EXPECT_EQ(textOf(m_folder / "outer.zip").find("Gorblimey"), std::string::npos);
    EXPECT_TRUE(finds(textOf(m_folder / "outer.zip"))) << "gzip in zip in zip";
  }
}

TEST_F(IdentityCommand, ACaseAndAllThatIsMadeOfItHoldNoIdentifier)
{
  const fs::path in = writePlanted();
  const std::string ct = quoted(in);
  ASSERT_GE(m_plants.size(), 50U);
  fs::create_directories(m_folder / "made");
  const auto out = [this](const std::string& name) { return quoted(m_folder / "made" / name); };
  const auto told = [this](const std::string& line, const char* name)
  {
    const auto outcome = run(line);
    EXPECT_EQ(outcome.code, 0) << line << outcome.err;
    std::ofstream(m_folder / "made" / name) << outcome.out << outcome.err;
  };
  told("new ear --ct " + ct + " --mr T2=" + ct, "new.txt");
  std::ofstream(m_folder / "path.csv") << "t_s,x_mm,y_mm,z_mm,qw,qx,qy,qz,drill\n"
                                       << "0,-6,23.5,5.6,1,0,0,0,1\n0.2,-6,23.5,3,1,0,0,0,0\n";
  json("drill ear --path " + quoted(m_folder / "path.csv") + " --record " +
       quoted(m_folder / "out.recording"));
  EXPECT_TRUE(has(m_folder, "live session") || has(m_folder, "tool path"))
      << "recordings are looked into";
  json("describe ear --thumbnail");

  // What the user has at home, and what must not leave: who signed, when, files by their names and
  // with what they say, and where they are.
  const auto secret = [](const char* of) { return std::string("Zyx") + of + "Wvu"; };
  const fs::path mine = m_folder / secret("folder");
  fs::create_directories(mine);
  const auto file = [&](const std::string& ending, const std::string& bytes)
  {
    const fs::path path = mine / (plant() + "_Gorblimey_19310517" + ending);
    std::ofstream(path, std::ios::binary) << bytes;
    return quoted(path);
  };
  json("register ear --mr T2 --as-is");
  json("register ear --mr T2 --sign-off 'Dr " + secret("signer") + "'");
  told("attach ear --date 2001-02-03 " + file(".png", pngNaming(plant())), "attach.txt");
  json("attach ear " + file(".pdf", "%PDF-1.7 /Author (" + secret("author") + ")"));
  json("attach ear " + file(".mp4", std::string("\0\0\0\x18", 4) + "ftypmp42" + secret("film")));
  json("attach ear " + quoted(m_folder / "out.recording"));
  const fs::path linked = mine / "linked.png";
  std::ofstream(linked, std::ios::binary) << pngNaming(secret("linked"));
  json("attach ear --link " + quoted(linked));
  char today[16];
  const std::time_t now = std::time(nullptr);
  std::tm utc{};
  ::gmtime_r(&now, &utc);
  std::strftime(today, sizeof today, "%Y-%m-%d", &utc);
  json(std::string("describe ear --date ") + today);
  // A structure that no voxel carries is named in a note alone, an MR that was taken out nowhere.
  json("segment ear block --threshold 1000,1300");
  json("export ear --what labels --out " + quoted(m_folder / "labels.seg.nrrd"));
  std::string labels = textOf(m_folder / "labels.seg.nrrd");
  const std::string header = "Segment0_Name:=block";
  ASSERT_NE(labels.find(header), std::string::npos);
  labels.replace(labels.find(header), header.size(),
                 "Segment0_Name:=block 2\nSegment1_ID:=Segment_9\nSegment1_Name:=" +
                     secret("empty") + "\nSegment1_LabelValue:=9\nSegment1_Layer:=0");
  std::ofstream(m_folder / "labels.seg.nrrd", std::ios::binary) << labels;
  json("add ear --labels " + quoted(m_folder / "labels.seg.nrrd"));
  const std::vector<std::string> atHome{secret("folder"),
                                        secret("signer"),
                                        secret("author"),
                                        secret("film"),
                                        secret("linked"),
                                        secret("empty"),
                                        today,
                                        m_folder.filename().string()};
  for (const std::string& one : atHome)
    EXPECT_TRUE(has(library(), one) || has(mine, one)) << one << ": looked for at the right place";

  json("archive ear " + out("ear.petrous"));
  json("archive ear --plan-only " + out("plan.petrous"));
  told("archive ear --dry-run " + out("none.petrous"), "report.txt");
  json("render ear --size 64x48 --out " + out("ear.png"));
  json("slice ear --plane axial --size 64x48 --out " + out("slice.png"));
  json("export ear --what ct --out " + out("ct.nrrd"));
  json("export ear --what ct --out " + out("ct.nii.gz"));
  json("export ear --what ct --out " + out("dicom/"));
  json("export ear --what mr --out " + out("mr/"));
  json("export ear --what surface --out " + out("ear.obj"));
  json("export ear --what mask --out " + out("mask.nrrd"));
  const std::vector<fs::path> leaving{m_folder / "made/ear.petrous", m_folder / "made/plan.petrous",
                                      m_folder / "made"};
  expectNoPlantIn(leaving, atHome);
  std::ofstream(m_folder / "made" / "info.json") << run("info ear --json").out;

  json("restore " + out("ear.petrous") + " --library " + quoted(m_folder / "other"));
  EXPECT_TRUE(has(m_folder / "other/cases", "signed_off")) << "it was signed, and stays so";
  EXPECT_EQ(json("attachments ear --library " + quoted(m_folder / "other"))["attachments"].size(),
            3U)
      << "screenshots and the recording";
  expectNoPlantIn({m_folder / "other/cases", m_folder / "other/objects"}, atHome);

  fs::create_directories(m_folder / "batch");
  for (const std::string ending : {"csv", "json"})
  {
    const std::string name = "of " + ending;
    std::ofstream(m_folder / "table.csv")
        << "name,folder,archive\n"
        << name << ",\"" << in.string() << "\",batch/" << name << ".petrous\n";
    told("batch " + quoted(m_folder / "table.csv") + " --report " +
             quoted(m_folder / ("batch/report." + ending)),
         "batch.txt");
  }
  // One that fails says why in words: of two series either may be meant.
  fs::create_directories(in / plant());
  for (const auto& entry : fs::directory_iterator(in))
    if (entry.is_regular_file())
    {
      std::string bytes = textOf(entry.path());
      bytes.replace(bytes.rfind("1.2.77777.1"), 11, "1.2.77777.3"); // of the series
      std::ofstream(in / m_plants.back() / entry.path().filename(), std::ios::binary) << bytes;
    }
  for (const std::string ending : {"csv", "json"})
  {
    std::ofstream(m_folder / "table.csv")
        << "name,folder,mr\nunclear,\"" << in.string() << "\",\"" << in.string() << "\"\n"
        << "torn,\"" << (in / (m_plants.back() + "x")).string() << "\",\n";
    const auto outcome = run("batch " + quoted(m_folder / "table.csv") + " --progress --report " +
                             quoted(m_folder / ("batch/failed." + ending)));
    EXPECT_EQ(outcome.code, 3);
    std::ofstream(m_folder / "batch" / ("failed in words." + ending)) << outcome.out << outcome.err;
    EXPECT_NE(textOf(m_folder / ("batch/failed." + ending)).find("2 series"), std::string::npos);
    EXPECT_NE(textOf(m_folder / ("batch/failed." + ending)).find("UID 2 (CT, 12 slices)"),
              std::string::npos)
        << textOf(m_folder / ("batch/failed." + ending));
  }
  expectNoPlantIn({library(), m_folder / "other", m_folder / "made", m_folder / "state",
                   m_folder / "batch", m_folder / "out.recording"});
}

// What a node is sent, as it keeps it.
TEST_F(IdentityCommand, ANodeGetsNoIdentifier)
{
  if (!petrous::network::test::Orthanc::installed())
    GTEST_SKIP() << "Orthanc (package orthanc) is not installed";
  const std::string ct = quoted(writePlanted());
  json("new ear --ct " + ct + " --mr T2=" + ct);
  std::ofstream(m_folder / "path.csv") << "t_s,x_mm,y_mm,z_mm,qw,qx,qy,qz,drill\n"
                                       << "0,-6,23.5,5.6,1,0,0,0,1\n0.2,-6,23.5,3,1,0,0,0,0\n";
  json("drill ear --path " + quoted(m_folder / "path.csv"));
  json("segment ear block --threshold 1000,1300");
  json("register ear --mr T2 --as-is");
  json("register ear --mr T2 --sign-off 'Dr ZyxsignerWvu'");
  const fs::path pdf = m_folder / (plant() + ".pdf");
  std::ofstream(pdf) << "%PDF-1.7 /Author (ZyxauthorWvu)";
  json("attach ear " + quoted(pdf));
  const auto started = json("history ear")["strokes"][0]["started_at"].get<std::string>();
  const petrous::network::test::Orthanc server(m_folder, {});
  json("nodes add pacs --host 127.0.0.1 --aet ORTHANC --port " +
       std::to_string(server.node().port));
  const auto sent = run("send ear --to pacs");
  EXPECT_EQ(sent.code, 0) << sent.err;
  const fs::path kept = m_folder / "kept";
  fs::create_directories(kept);
  std::ofstream(kept / "told.txt") << sent.out << sent.err;
  std::size_t objects = 0;
  for (const auto& entry : fs::recursive_directory_iterator(server.storage()))
    if (entry.is_regular_file() && textOf(entry.path()).substr(0, 132).find("DICM") == 128)
      fs::copy_file(entry.path(), kept / std::to_string(++objects));
  EXPECT_GE(objects, 12U + 12U + 1U + 1U) << "CT, MR, segmentation and scene";
  EXPECT_TRUE(has(kept, "signed_off")) << "the scene is looked into";
  expectNoPlantIn({kept, kept}, {"ZyxsignerWvu", "ZyxauthorWvu", started.substr(0, 10)});
}

TEST_F(IdentityCommand, DeidentifiesAFolderWithMapAndReport)
{
  const fs::path in = writePlanted();
  std::ofstream(m_folder / "passphrase") << "nine lives of a cat\n";
  const std::string secret = " --passphrase-file " + quoted(m_folder / "passphrase");
  const std::string map = quoted(m_folder / "map");
  const auto done =
      json("deidentify " + quoted(in) + " " + quoted(m_folder / "out") + " --map " + map + secret +
           " --dates shift --clean-descriptors --report " + quoted(m_folder / "report.txt"));
  EXPECT_EQ(done["files"], 12);
  EXPECT_EQ(done["patients"], 1);
  EXPECT_GT(done["stays"].size(), 10U);
  EXPECT_GT(done["removed_or_replaced"].size(), 40U);
  expectNoPlantIn(
      {m_folder / "out", m_folder / "report.txt", m_folder / "map", m_folder / "state"});
  const std::string again = quoted(m_folder / "again");
  json("deidentify " + quoted(in) + " " + again + " --map " + map + secret +
       " --dates shift --clean-descriptors");
  for (const auto& entry : fs::recursive_directory_iterator(m_folder / "out"))
    if (entry.is_regular_file())
    {
      EXPECT_EQ(textOf(entry.path()),
                textOf(m_folder / "again" / fs::relative(entry.path(), m_folder / "out")));
    }
  EXPECT_NE(run("pseudonyms " + map + secret).out.find("1.2.77777.2"), std::string::npos);
  // Found, copied under another passphrase, taken in elsewhere, and opened by a new one.
  const auto count = [this](const std::string& line) { return json(line)["pseudonyms"].size(); };
  EXPECT_EQ(count("pseudonyms " + map + secret + " --find 1.2.77777.2"), 1U);
  EXPECT_EQ(count("pseudonyms " + map + secret + " --find PATIENT"), 1U);
  EXPECT_EQ(count("pseudonyms " + map + secret + " --find nobody"), 0U);
  std::ofstream(m_folder / "second") << "ten lives of a dog\n";
  const std::string other = " --other-passphrase-file " + quoted(m_folder / "second");
  const std::string copy = quoted(m_folder / "copy");
  json("pseudonyms " + map + secret + " --export " + copy + other);
  expectRefused("pseudonyms " + map + secret + " --export " + copy + other, 4, "there already");
  expectNoPlantIn({m_folder / "out", m_folder / "copy", m_folder / "state"});
  EXPECT_EQ(json("pseudonyms " + map + secret + " --import " + copy + other)["added"], 0);
  json("pseudonyms " + copy + " --passphrase-file " + quoted(m_folder / "second") +
       " --new-passphrase-file " + quoted(m_folder / "passphrase"));
  EXPECT_EQ(run("pseudonyms " + copy + secret).out, run("pseudonyms " + map + secret).out);
  expectRefused("pseudonyms " + map + secret + " --find x --export " + copy, 2, "one of");
  EXPECT_EQ(json("scan " + quoted(m_folder / "out"))["series"][0]["verdict"], "ok");
  std::ofstream(m_folder / "wrong") << "eight lives of a cat\n";
  const std::string list = "pseudonyms " + map + " --passphrase-file ";
  expectRefused(list + quoted(m_folder / "wrong"), 3, "passphrase");
  expectRefused("deidentify " + quoted(in) + " " + quoted(in / "out"), 4, "within the input");
  expectRefused("deidentify " + quoted(in) + " " + quoted(m_folder / "y") + " --report " +
                    quoted(in / "report.txt"),
                4, "never changed");
  EXPECT_FALSE(fs::exists(in / "report.txt"));
  EXPECT_FALSE(fs::exists(m_folder / "y"));
  expectRefused("deidentify " + quoted(in) + " " + quoted(m_folder / "out"), 4, "empty");
  expectRefused("deidentify " + quoted(in) + " " + quoted(m_folder / "x") + " --map " + map, 2,
                "--passphrase-file");
}

TEST_F(IdentityCommand, WritesDeflatedFilesToTheirEnd)
{
  const fs::path in = m_folder / "in", out = m_folder / "out";
  for (int k = 0; k < 12; ++k)
  {
    TestSlice slice;
    slice.columns = slice.rows = 64;
    slice.z = 0.5 * k;
    slice.marker = false;
    // Noise: what a compression holds at the end is many bytes.
    slice.cell = [k](int i, int j)
    { return (static_cast<unsigned>(i * 64 + j + 4096 * k) * 2654435761U >> 16) % 2000U; };
    std::string meta;
    slice.element(meta, 0x00020010, "UI", "1.2.840.10008.1.2.1.99");
    const std::string bytes = slice.bytes();
    std::string packed(2 * bytes.size(), '\0');
    z_stream stream = {};
    ASSERT_EQ(::deflateInit2(&stream, 6, Z_DEFLATED, -15, 8, Z_DEFAULT_STRATEGY), Z_OK);
    stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(bytes.data()));
    stream.avail_in = static_cast<uInt>(bytes.size());
    stream.next_out = reinterpret_cast<Bytef*>(packed.data());
    stream.avail_out = static_cast<uInt>(packed.size());
    ASSERT_EQ(::deflate(&stream, Z_FINISH), Z_STREAM_END);
    packed.resize(packed.size() - stream.avail_out);
    ::deflateEnd(&stream);
    petrous::imaging::test::writeText(in / (std::to_string(k) + ".dcm"),
                                      std::string(128, '\0') + "DICM" + meta + packed);
  }
  json("deidentify " + quoted(in) + " " + quoted(out));
  for (const fs::path& folder : {in, out})
  {
    const std::string name = folder.filename().string();
    json("new " + name + " --ct " + quoted(folder));
    json("export " + name + " --what ct --out " + quoted(m_folder / (name + ".nrrd")));
  }
  EXPECT_EQ(textOf(m_folder / "in.nrrd"), textOf(m_folder / "out.nrrd"));
}

TEST_F(IdentityCommand, ReplacesAFileOnRequestOnly)
{
  const std::string in = quoted(fs::directory_iterator(writePlanted())->path());
  const fs::path out = m_folder / "one.dcm";
  json("deidentify " + in + " " + quoted(out));
  const std::string first = textOf(out);
  expectRefused("deidentify " + in + " " + quoted(out), 4, "--replace");
  EXPECT_EQ(textOf(out), first);
  json("deidentify " + in + " " + quoted(out) + " --replace");
  EXPECT_NE(textOf(out), first) << "other UIDs";
}

TEST_F(IdentityCommand, StrictWantsNoFileLeftOut)
{
  const fs::path from = fs::directory_iterator(writePlanted())->path();
  const fs::path in = m_folder / "two";
  fs::create_directories(in);
  fs::copy_file(from, in / "a.dcm");
  const auto codeOf = [&](const char* name, const char* strict)
  { return run("deidentify " + quoted(in) + " " + quoted(m_folder / name) + strict).code; };
  EXPECT_EQ(codeOf("whole", " --strict"), 0);
  const std::string bytes = textOf(from);
  std::ofstream(in / "b.dcm", std::ios::binary) << bytes.substr(0, bytes.size() - 100);
  EXPECT_EQ(codeOf("less", " --strict"), 3);
  EXPECT_TRUE(fs::exists(m_folder / "less"));
  EXPECT_EQ(codeOf("as it is", ""), 0);
}

// All that the program writes as DICOM; what a node is sent: NodeCommand.
TEST_F(IdentityCommand, WritesValidDicom)
{
  if (!hasDicomValidator())
    GTEST_SKIP() << kNoDicomValidator;
  makePatient("--dims 32,32,16 --spacing 2.0");
  const fs::path patient = m_folder / "patient";
  json("new ear --ct " + quoted(patient / "ct") + " --mr T2=" + quoted(patient / "mr") +
       " --labels " + quoted(patient / "labels.seg.nrrd"));
  json("register ear --mr T2 --as-is --transform " + quoted(patient / "truth.json"));
  json("new mr --modality MR --ct " + quoted(patient / "mr"));
  const fs::path written = m_folder / "written";
  fs::create_directories(written);
  const auto out = [&](const char* name) { return quoted(written / name); };
  json("export ear --what ct --out " + out("ct/"));
  json("export ear --what dissected --out " + out("dissected/"));
  json("export ear --what ct --roi -60,-30,-20,20,-20,20 --out " + out("part/"));
  json("export ear --what mr --out " + out("mr/"));
  json("export ear --what mr --on-ct --out " + out("on-ct/"));
  json("export mr --what ct --out " + out("primary/"));
  json("export ear --what labels --out " + out("seg.dcm"));
  fs::copy(patient / "ct", written / "sample-ct");
  fs::copy(patient / "mr", written / "sample-mr");
  EXPECT_GT(expectValidDicom(written, m_folder / "dciodvfy.txt"), 60U);

  // De-identified, by each choice.
  std::size_t count = 0;
  for (const char* choices : {"", "--dates shift --clean-descriptors --retain-safe-private",
                              "--dates keep --retain-device --retain-patient-characteristics"})
  {
    const fs::path to = m_folder / ("clean" + std::to_string(++count));
    json("deidentify " + quoted(written) + " " + quoted(to) + " " + choices);
    EXPECT_GT(expectValidDicom(to, m_folder / "dciodvfy.txt"), 60U) << choices;
  }
}

// An independent reader has its own view of the table.
TEST_F(IdentityCommand, SatisfiesAnIndependentReader)
{
  if (std::system("/usr/bin/python3 -c 'import pydicom' 2>/dev/null") != 0)
    GTEST_SKIP() << "pydicom is not there to check what was written";
  const std::string check = "/usr/bin/python3 " + quoted(PETROUS_SOURCE "/Testing/deidentify.py") +
                            " " + quoted(PETROUS_PROGRAM) + " " +
                            quoted(PETROUS_SOURCE "/Resources/confidentiality-profile.tsv") + " " +
                            quoted(m_folder) + " >" + quoted(m_folder / "told") + " 2>&1";
  EXPECT_EQ(std::system(check.c_str()), 0) << textOf(m_folder / "told");
}
