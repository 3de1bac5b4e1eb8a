#include <fstream>

#include <gtest/gtest.h>
#include <sys/stat.h>

#include "../../Imaging/Testing/TestDicom.h"
#include "petrous/Core/InputFile.h"
#include "petrous/Core/OutputFile.h"
#include "petrous/Library/PseudonymMap.h"

namespace petrous::library
{

namespace
{

using imaging::test::TemporaryFolder;

constexpr PseudonymMap::Cost kCheap{1, 1 << 16};
constexpr const char* kPassphrase = "correct horse";

PseudonymMapError::Reason reasonOf(const std::filesystem::path& path, const std::string& passphrase)
{
  try
  {
    PseudonymMap(path, passphrase, kCheap);
  }
  catch (const PseudonymMapError& error)
  {
    EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos);
    return error.reason;
  }
  ADD_FAILURE() << "it was opened";
  return {};
}

class PseudonymMapFile : public ::testing::Test
{
protected:
  void SetUp() override
  {
    PseudonymMap map(path, kPassphrase, kCheap);
    map.add({{"patient", "P-1", "4711 Doe^Jane"}, {"study", "2.25.1", "1.2.3"}});
    map.add({{"patient", "P-1", "4711 Doe^Jane"}});
    map.save();
    uid = map.key().uid("1.2.3.4");
  }

  TemporaryFolder folder;
  std::filesystem::path path = folder.path() / "map";
  std::string uid;
};

} // namespace

TEST_F(PseudonymMapFile, ComesBackWithKeyAndEntries)
{
  const PseudonymMap map(path, kPassphrase, kCheap);
  ASSERT_EQ(map.entries().size(), 2U);
  EXPECT_EQ(map.entries()[0].identity, "4711 Doe^Jane");
  EXPECT_EQ(map.key().uid("1.2.3.4"), uid);
  EXPECT_NE(PseudonymKey().uid("1.2.3.4"), uid);
}

TEST_F(PseudonymMapFile, ShowsNoIdentityInItsBytesNorToOthers)
{
  const std::string bytes = core::readFile(path);
  for (const char* plain : {"4711", "Doe", "Jane", "P-1", "1.2.3", "correct"})
    EXPECT_EQ(bytes.find(plain), std::string::npos) << plain;
  struct stat status = {};
  ASSERT_EQ(::stat(path.c_str(), &status), 0);
  EXPECT_EQ(status.st_mode & 0777U, 0600U);
}

TEST_F(PseudonymMapFile, TellsAWrongPassphraseFromDamage)
{
  EXPECT_EQ(reasonOf(path, "wrong horse"), PseudonymMapError::Reason::WrongPassphrase);
  const std::string bytes = core::readFile(path);
  for (std::size_t n = 0; n < bytes.size(); ++n)
  {
    std::string damaged = bytes;
    damaged[n] = static_cast<char>(damaged[n] ^ 0x10);
    core::writeFile(path, damaged);
    const auto reason = reasonOf(path, kPassphrase);
    EXPECT_TRUE(reason == PseudonymMapError::Reason::Damaged ||
                reason == PseudonymMapError::Reason::NewerVersion)
        << n;
    core::writeFile(path, bytes.substr(0, n));
    EXPECT_EQ(reasonOf(path, kPassphrase), PseudonymMapError::Reason::Damaged) << n;
  }
}

TEST_F(PseudonymMapFile, IsLockedAgainstASecondWriter)
{
  {
    const PseudonymMap first(path, kPassphrase, kCheap);
    EXPECT_EQ(reasonOf(path, kPassphrase), PseudonymMapError::Reason::InUse);
  }
  EXPECT_EQ(PseudonymMap(path, kPassphrase, kCheap).entries().size(), 2U);
}

TEST_F(PseudonymMapFile, OpensByANewPassphraseUnlessThatCannotBeWritten)
{
  {
    PseudonymMap map(path, kPassphrase, kCheap);
    EXPECT_THROW(map.changePassphrase("short"), core::InvalidParameter);
    // The folder is in the way of the new file; the map goes on under the old passphrase.
    const std::filesystem::path away = folder.path() / "away";
    std::filesystem::rename(path, away);
    std::filesystem::create_directory(path);
    EXPECT_THROW(map.changePassphrase("battery staple"), core::Error);
    std::filesystem::remove(path);
    std::filesystem::rename(away, path);
    map.save();
  }
  EXPECT_EQ(PseudonymMap(path, kPassphrase, kCheap).entries().size(), 2U);
  {
    PseudonymMap map(path, kPassphrase, kCheap);
    map.changePassphrase("battery staple");
  }
  EXPECT_EQ(reasonOf(path, kPassphrase), PseudonymMapError::Reason::WrongPassphrase);
  const PseudonymMap map(path, "battery staple", kCheap);
  EXPECT_EQ(map.entries().size(), 2U);
  EXPECT_EQ(map.key().uid("1.2.3.4"), uid) << "pseudonyms stay the same";
}

TEST_F(PseudonymMapFile, IsCopiedUnderAPassphraseOfItsOwn)
{
  const std::filesystem::path copy = folder.path() / "copy";
  const std::string before = core::readFile(path);
  {
    const PseudonymMap map(path, kPassphrase, kCheap);
    EXPECT_TRUE(map.saveCopy(copy, "battery staple"));
    EXPECT_THROW(map.saveCopy(copy, "battery staple"), core::Error) << "is there already";
  }
  EXPECT_EQ(core::readFile(path), before);
  EXPECT_EQ(reasonOf(copy, kPassphrase), PseudonymMapError::Reason::WrongPassphrase);
  const PseudonymMap other(copy, "battery staple", kCheap);
  EXPECT_EQ(other.key().uid("1.2.3.4"), uid);
  ASSERT_EQ(other.entries().size(), 2U);

  // And taken in by another map: what that has already counts once.
  PseudonymMap third(folder.path() / "third", kPassphrase, kCheap);
  third.add({{"study", "2.25.1", "1.2.3"}});
  EXPECT_EQ(third.add(other.entries()), 1U);
  EXPECT_EQ(third.add(other.entries()), 0U);
  EXPECT_EQ(third.entries().size(), 2U);
}

TEST(PseudonymMap, RefusesAShortPassphrase)
{
  const TemporaryFolder folder;
  EXPECT_THROW(PseudonymMap(folder.path() / "map", "short", kCheap), core::InvalidParameter);
}

TEST(PseudonymKey, GivesValidUidsThatDependOnTheKey)
{
  const PseudonymKey key;
  const std::string uid = key.uid("1.2.840.1");
  EXPECT_EQ(uid.rfind("2.25.", 0), 0U);
  EXPECT_LE(uid.size(), 44U);
  EXPECT_NE(uid[5], '0');
  EXPECT_EQ(uid, key.uid("1.2.840.1"));
  EXPECT_NE(uid, key.uid("1.2.840.2"));
  EXPECT_GE(key.daysEarlier("1"), 1);
  EXPECT_LE(key.daysEarlier("1"), 3650);
}

} // namespace petrous::library
