#include <cmath>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <limits>
#include <random>

#include <gtest/gtest.h>

#include <unistd.h>

#include "../../Core/Testing/SystemCalls.h"
#include "petrous/Dissection/BurrName.h"
#include "petrous/Session/RecordingReader.h"
#include "petrous/Session/RecordingWriter.h"

using namespace petrous;
using namespace petrous::session;

namespace
{

namespace fs = std::filesystem;

class Recording : public ::testing::Test
{
protected:
  void SetUp() override
  {
    const auto* info = ::testing::UnitTest::GetInstance()->current_test_info();
    m_folder = fs::temp_directory_path() /
               ("petrous-recording-" + std::string(info->name()) + std::to_string(::getpid()));
    fs::create_directories(m_folder);
  }
  void TearDown() override { fs::remove_all(m_folder); }
  fs::path file() const { return m_folder / "hand.ticks"; }

  void write(const std::vector<TickRecord>& ticks, const RecordingSetup& setup = {})
  {
    RecordingWriter writer(file(), setup);
    for (const TickRecord& tick : ticks)
      writer.add(tick);
    writer.close();
  }

  std::vector<TickRecord> readAll(RecordingReader& reader)
  {
    std::vector<TickRecord> all;
    RecordingBlock block;
    while (reader.next(block))
    {
      all.insert(all.end(), block.ticks.begin(), block.ticks.end());
      m_edits.insert(m_edits.end(), block.edits.begin(), block.edits.end());
    }
    return all;
  }

  std::string bytes() const
  {
    std::ifstream in(file(), std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
  }
  void setBytes(const std::string& text) const { std::ofstream(file(), std::ios::binary) << text; }

  std::vector<MaskEdit> m_edits; // all read so far

private:
  fs::path m_folder;
};

// Cuts as in a session, between ticks.
MaskEdit cutAt(std::uint64_t n)
{
  MaskEdit edit{MaskEdit::Kind::Cut};
  edit.state = n;
  for (int axis = 0; axis < 3; ++axis)
  {
    edit.from[axis] = 20.0 * std::sin(0.01 * static_cast<double>(n) + axis);
    edit.to[axis] = edit.from[axis] - 0.02;
  }
  edit.radius = 2.0;
  return edit;
}

// Every bit pattern may occur: random words, and every kind of special double.
std::vector<TickRecord> anything(std::size_t count)
{
  std::mt19937_64 random(3);
  const double special[] = {0.0,
                            -0.0,
                            std::numeric_limits<double>::infinity(),
                            -std::numeric_limits<double>::infinity(),
                            std::numeric_limits<double>::denorm_min(),
                            -std::numeric_limits<double>::denorm_min(),
                            std::numeric_limits<double>::max(),
                            std::numeric_limits<double>::lowest(),
                            1.0};
  std::vector<TickRecord> ticks(count);
  for (TickRecord& tick : ticks)
    for (std::size_t word = 0; word < sizeof(TickRecord) / 8; ++word)
    {
      std::uint64_t value = random();
      switch (random() % 4)
      {
      case 0:
        std::memcpy(&value, &special[random() % 9], 8);
        break;
      case 1: // a NaN with payload, quiet or signalling, of either sign
        value = (value & 0x800FFFFFFFFFFFFFULL) | 0x7FF0000000000001ULL;
        break;
      default:
        break;
      }
      std::memcpy(reinterpret_cast<char*>(&tick) + 8 * word, &value, 8);
    }
  return ticks;
}

std::vector<TickRecord> numbered(std::size_t count)
{
  std::vector<TickRecord> ticks(count);
  for (std::size_t n = 0; n < count; ++n)
  {
    ticks[n].number = n;
    ticks[n].input.now = 50.0 + 0.001 * static_cast<double>(n);
    ticks[n].proxy.position[0] = std::sin(0.003 * static_cast<double>(n));
  }
  return ticks;
}

void expectSame(const std::vector<TickRecord>& a, const std::vector<TickRecord>& b)
{
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t n = 0; n < a.size(); ++n)
    ASSERT_TRUE(identical(a[n], b[n])) << n;
}

} // namespace

TEST_F(Recording, ReturnsEveryBitOfWhateverTicksHold)
{
  const auto ticks = anything(2500);
  write(ticks);
  RecordingReader reader(file());
  expectSame(readAll(reader), ticks);
  EXPECT_TRUE(reader.complete());
  EXPECT_EQ(reader.warning(), "");
  EXPECT_EQ(reader.ticks(), 2500u);
}

TEST_F(Recording, ReturnsTicksOfAnyCount)
{
  for (const std::size_t count : {0u, 1u, 2u, 3u, 999u, 1000u, 1001u, 2000u})
  {
    const auto ticks = numbered(count);
    write(ticks);
    RecordingReader reader(file());
    expectSame(readAll(reader), ticks);
    EXPECT_TRUE(reader.complete()) << count;
  }
}

TEST_F(Recording, ReturnsWhatWasDoneToTheMaskInTheBlockOfTheTickThatFeltIt)
{
  auto ticks = numbered(2500);
  std::vector<MaskEdit> edits;
  {
    RecordingWriter writer(file(), {});
    for (TickRecord& tick : ticks)
    {
      if (tick.number % 3 == 0)
      {
        edits.push_back(cutAt(edits.size() + 1));
        writer.add(edits.back());
      }
      tick.maskState = edits.size();
      writer.add(tick);
    }
    edits.push_back({MaskEdit::Kind::End});
    edits.back().duration = -0.0;
    writer.add(edits.back());
    edits.push_back({MaskEdit::Kind::Undo, ~std::uint64_t{0}});
    writer.add(edits.back());
    writer.close();
  }
  RecordingReader reader(file());
  RecordingBlock block;
  std::size_t seen = 0;
  std::vector<TickRecord> all;
  while (reader.next(block))
  {
    for (const MaskEdit& edit : block.edits)
      ASSERT_EQ(std::memcmp(&edit, &edits[seen++], sizeof edit), 0) << seen;
    for (const TickRecord& tick : block.ticks)
      ASSERT_LE(tick.maskState, seen);
    all.insert(all.end(), block.ticks.begin(), block.ticks.end());
  }
  expectSame(all, ticks);
  EXPECT_EQ(seen, edits.size());
  EXPECT_TRUE(reader.complete());
}

TEST_F(Recording, HoldsManyCutsBetweenTwoTicks)
{
  {
    RecordingWriter writer(file(), {});
    for (std::uint64_t n = 0; n < 25000; ++n)
      writer.add(cutAt(n));
    writer.close();
    EXPECT_LT(writer.bytes(), 25000u * 64);
  }
  RecordingReader reader(file());
  EXPECT_TRUE(readAll(reader).empty());
  ASSERT_EQ(m_edits.size(), 25000u);
  EXPECT_EQ(m_edits.back().burr().from, cutAt(24999).burr().from);
  EXPECT_TRUE(reader.complete());
}

TEST_F(Recording, KeepsTheSetupToTheLastDigit)
{
  RecordingSetup setup;
  setup.tool = "cutting burr 4 mm";
  setup.note = "phantom, \"left\" side; \xC3\xA4";
  setup.burr.kind = dissection::Burr::Kind::Diamond;
  setup.burr.diameter = 0.1 + 0.2;
  setup.burr.name = "coarse-diamond";
  setup.proxy.stiffness = 1.0 / 3.0;
  setup.proxy.bisections = 9;
  setup.servo.center = {1e-300, -7.0 / 3.0, 1e17};
  setup.servo.burrPoints = 801;
  setup.servo.guard.goodTicks = 3;
  setup.servo.limits.fadeOut = 0.015;
  setup.servo.passivity.emplace();
  setup.servo.passivity->lever = 31.25;
  setup.degrees = 3;
  setup.scene = {~std::uint64_t{0}, 0.1, 1u, 0x8000000000000001u, 7u, 12345678901234567890u};
  write({}, setup);
  const RecordingSetup got = RecordingReader(file()).setup();
  EXPECT_EQ(got.tool, setup.tool);
  EXPECT_EQ(got.note, setup.note);
  EXPECT_EQ(got.burr.kind, setup.burr.kind);
  EXPECT_EQ(got.burr.diameter, setup.burr.diameter);
  EXPECT_EQ(got.burr.name, "coarse-diamond");
  EXPECT_EQ(toString(got).rfind("coarse-diamond burr ", 0), 0u) << toString(got);
  EXPECT_EQ(got.proxy.stiffness, setup.proxy.stiffness);
  EXPECT_EQ(got.proxy.bisections, 9);
  EXPECT_EQ(got.servo.center, setup.servo.center);
  EXPECT_EQ(got.servo.burrPoints, 801u);
  EXPECT_EQ(got.servo.guard.goodTicks, 3);
  EXPECT_EQ(got.servo.limits.fadeOut, 0.015);
  ASSERT_TRUE(got.servo.passivity);
  EXPECT_EQ(got.servo.passivity->lever, 31.25);
  EXPECT_EQ(got.degrees, 3);
  EXPECT_EQ(got.scene.ct, setup.scene.ct);
  EXPECT_EQ(got.scene.iso, 0.1);
  EXPECT_EQ(got.scene.tissue, setup.scene.tissue);
  EXPECT_EQ(got.scene.mask, setup.scene.mask);
  EXPECT_EQ(got.scene.applied, setup.scene.applied);
  EXPECT_EQ(got.scene.firstState, setup.scene.firstState);
  write({}, RecordingSetup());
  EXPECT_FALSE(RecordingReader(file()).setup().servo.passivity);
}

// Of programs that knew one burr of each kind.
TEST_F(Recording, ASetupWithoutABurrsNameIsOfTheUsualOneOfItsKind)
{
  RecordingSetup setup;
  setup.burr.kind = dissection::Burr::Kind::Diamond;
  const std::string text = toJson(setup);
  EXPECT_EQ(text.find("burr_name"), std::string::npos);
  EXPECT_EQ(dissection::nameOf(setupFromJson(text).burr), "diamond");
  setup.burr.name = "coarse-diamond";
  EXPECT_NE(toJson(setup).find(R"("burr":"diamond")"), std::string::npos) << "for such programs";
  setup.burr.name = "Doe, John";
  EXPECT_THROW(setupFromJson(toJson(setup)), core::InvalidParameter);
}

TEST_F(Recording, RefusesASetupThatCannotBeWritten)
{
  RecordingSetup setup;
  setup.servo.stallAfter = std::numeric_limits<double>::infinity();
  EXPECT_THROW(RecordingWriter(file(), setup), core::InvalidParameter);
  setup = {};
  setup.note = "\xFF\xFE";
  EXPECT_THROW(RecordingWriter(file(), setup), core::InvalidParameter);
}

TEST_F(Recording, ReadsUpToTheLastWholeBlockOfAFileThatWasCutShort)
{
  const auto ticks = numbered(2500);
  write(ticks);
  const std::string whole = bytes();
  write({});
  const std::size_t head = bytes().size() - 20; // without the end mark
  int lengths[3] = {0, 0, 0};
  for (std::size_t size = head; size < whole.size(); size += 37)
  {
    setBytes(whole.substr(0, size));
    RecordingReader reader(file());
    const auto got = readAll(reader);
    ASSERT_FALSE(reader.complete());
    ASSERT_NE(reader.warning().find(std::to_string(got.size()) + " ticks"), std::string::npos);
    ASSERT_TRUE(got.size() % 1000 == 0 || got.size() == 2500u);
    lengths[std::min<std::size_t>(got.size() / 1000, 2)]++;
    for (std::size_t n = 0; n < got.size(); ++n)
      ASSERT_TRUE(identical(got[n], ticks[n]));
  }
  for (const int count : lengths)
    EXPECT_GT(count, 0);
}

TEST_F(Recording, NamesWhatIsWrongWithAFile)
{
  const auto reasonOf = [this](const std::string& text)
  {
    setBytes(text);
    try
    {
      RecordingReader reader(file());
      readAll(reader);
    }
    catch (const RecordingError& error)
    {
      EXPECT_EQ(std::string(error.what()).find("hand.ticks: "), 0u) << error.what();
      return error.reason;
    }
    ADD_FAILURE() << "was read";
    return RecordingError::Reason::NotFound;
  };
  write(numbered(1500));
  const std::string good = bytes();
  EXPECT_EQ(reasonOf(""), RecordingError::Reason::NotRecording);
  EXPECT_EQ(reasonOf("t_s,x_mm,y_mm\n1,2,3\n"), RecordingError::Reason::NotRecording);
  std::string newer = good;
  newer[8] = 9;
  EXPECT_EQ(reasonOf(newer), RecordingError::Reason::NewerVersion);
  std::string older = good;
  older[8] = 1;
  EXPECT_EQ(reasonOf(older), RecordingError::Reason::OlderVersion);
  EXPECT_EQ(reasonOf(good.substr(0, 15)), RecordingError::Reason::Corrupt);
  EXPECT_EQ(reasonOf(good + "more"), RecordingError::Reason::Corrupt);
  fs::remove(file());
  EXPECT_THROW(RecordingReader{file()}, RecordingError);
  EXPECT_THROW(RecordingWriter(file() / "below" / "a file", {}), RecordingError);
}

TEST_F(Recording, NeverGivesATickThatWasNotWrittenWhateverByteIsChanged)
{
  const auto ticks = numbered(1200);
  {
    RecordingWriter writer(file(), {});
    for (const TickRecord& tick : ticks)
    {
      if (tick.number % 5 == 0)
        writer.add(cutAt(tick.number / 5));
      writer.add(tick);
    }
  }
  const std::string good = bytes();
  std::mt19937 random(5);
  for (int n = 0; n < 400; ++n)
  {
    std::string bad = good;
    const std::size_t at = n < 60 ? static_cast<std::size_t>(n) : random() % good.size();
    bad[at] = static_cast<char>(bad[at] ^ (1 << random() % 8));
    setBytes(bad);
    try
    {
      RecordingReader reader(file());
      m_edits.clear();
      const auto got = readAll(reader);
      for (std::size_t e = 0; e < m_edits.size(); ++e)
      {
        const MaskEdit written = cutAt(e);
        ASSERT_EQ(std::memcmp(&m_edits[e], &written, sizeof written), 0) << at;
      }
      // A changed length can look like a truncated file, and zstd's frames have unused bits; what
      // was read must be correct.
      EXPECT_TRUE(!reader.complete() || got.size() == ticks.size()) << at;
      for (std::size_t t = 0; t < got.size(); ++t)
        ASSERT_TRUE(identical(got[t], ticks[t])) << at;
    }
    catch (const RecordingError&)
    {
    }
  }
}

// After close() a power failure must not cost it.
TEST_F(Recording, SaysThatTheDiskDoesNotConfirmItsEnd)
{
  RecordingWriter writer(file(), {});
  writer.add(TickRecord{});
  petrous::testing::SystemCalls::fail("fsync", 1, EIO);
  EXPECT_THROW(writer.close(), RecordingError);
  petrous::testing::SystemCalls::reset();
}

TEST_F(Recording, ReplacesAFileThatIsThereOnlyWhenItHasBegun)
{
  std::ofstream(file()) << "the one before";
  const auto text = [this]
  {
    std::ifstream in(file(), std::ios::binary);
    return std::string(std::istreambuf_iterator<char>(in), {});
  };
  fs::create_directory(file().parent_path() / "folder");
  EXPECT_THROW(RecordingWriter(file().parent_path() / "folder", {}), RecordingError);
  petrous::testing::SystemCalls::fail("rename", 1, EIO);
  EXPECT_THROW(RecordingWriter(file(), {}), RecordingError);
  petrous::testing::SystemCalls::reset();
  EXPECT_EQ(text(), "the one before");
  EXPECT_EQ(std::distance(fs::directory_iterator(file().parent_path()), fs::directory_iterator()),
            2)
      << "nothing is left beside it";
  RecordingWriter(file(), {}).close();
  EXPECT_NE(text(), "the one before");
  EXPECT_NO_THROW(RecordingReader(file()).setup());
}

TEST_F(Recording, SaysThatTheDiskIsFull)
{
  if (!fs::exists("/dev/full"))
    GTEST_SKIP() << "no /dev/full here";
  EXPECT_THROW(RecordingWriter("/dev/full", {}), RecordingError);
}
