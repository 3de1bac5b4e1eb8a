#include <gtest/gtest.h>

#include "TestCase.h"
#include "petrous/Library/ObjectStore.h"

using namespace petrous::library;
using test::TemporaryFolder;

namespace
{

std::vector<std::uint8_t> bytesOf(const std::string& text)
{
  return {text.begin(), text.end()};
}

} // namespace

TEST(ObjectStore, NamesAnObjectByItsSha256)
{
  const TemporaryFolder folder;
  ObjectStore store(folder.path());
  // FIPS 180-2, appendix B.1.
  EXPECT_EQ(store.add("txt", bytesOf("abc")),
            "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad.txt");
}

TEST(ObjectStore, KeepsTheSameContentOnce)
{
  const TemporaryFolder folder;
  ObjectStore store(folder.path());
  EXPECT_EQ(store.add("bin", bytesOf("x")), store.add("bin", bytesOf("x")));
  EXPECT_EQ(test::contentOf(folder.path()).size(), 1u);
}

TEST(ObjectStore, LeavesNothingWhenAWriterFails)
{
  const TemporaryFolder folder;
  ObjectStore store(folder.path());
  EXPECT_THROW(store.add("bin",
                         [](const std::filesystem::path& path)
                         {
                           std::ofstream(path) << "half";
                           throw petrous::core::InvalidParameter("writer failed");
                         }),
               petrous::core::InvalidParameter);
  EXPECT_TRUE(test::contentOf(folder.path()).empty());
}

TEST(ObjectStore, DiscardsOnlyWhatIsNew)
{
  const TemporaryFolder folder;
  ObjectStore store(folder.path());
  const auto old = store.add("bin", bytesOf("old"));
  store.forget();
  store.add("bin", bytesOf("new"));
  store.add("bin", bytesOf("old"));
  store.discardNew();
  EXPECT_EQ(store.readChecked(old, {"the old one"}), bytesOf("old"));
  EXPECT_EQ(test::contentOf(folder.path()).size(), 1u);
}

TEST(ObjectStore, RefusesNamesThatAreNoHashes)
{
  const TemporaryFolder folder;
  const ObjectStore store(folder.path());
  for (const std::string& name : {std::string("../../etc/passwd"), std::string("a.nrrd"),
                                  std::string(64, 'a') + "./../x", std::string(64, 'Z') + ".bin"})
    EXPECT_THROW(store.path(name), LibraryError) << name;
}

// An instrument is stored as a mesh is, but can be taken out of the case; whatever it is called.
TEST(ObjectStore, NamesWhatHelpsAgainstTheLossOfAnInstrument)
{
  const TemporaryFolder folder;
  const ObjectStore store(folder.path());
  const std::string lost = std::string(64, 'a') + ".obj";
  const auto refusal = [&](const ObjectText& what) -> std::string
  {
    try
    {
      store.path(lost, what);
    }
    catch (const LibraryError& error)
    {
      return error.what();
    }
    return {};
  };
  const std::string mesh = refusal({"the instrument that was scanned"});
  EXPECT_NE(mesh.find("the instrument that was scanned is missing"), std::string::npos) << mesh;
  EXPECT_NE(mesh.find("import the same data again"), std::string::npos) << mesh;
  EXPECT_EQ(mesh.find("--clear instrument"), std::string::npos) << mesh;
  const std::string instrument = refusal({"a pick", true});
  EXPECT_NE(instrument.find("a pick is missing"), std::string::npos) << instrument;
  EXPECT_NE(instrument.find("--clear instrument"), std::string::npos) << instrument;
  EXPECT_EQ(instrument.find("import the same data again"), std::string::npos) << instrument;
}
