#include "petrous/Network/SceneObjects.h"

#include <csignal>

#include <gtest/gtest.h>
#include <sys/resource.h>

#include "TestServers.h"
#include "petrous/Core/OutputFile.h"
#include "petrous/Imaging/DicomWriter.h"
#include "petrous/Network/NodeList.h"

namespace petrous::network
{
namespace
{

using test::TemporaryFolder;
namespace fs = std::filesystem;

std::string contentOf(const fs::path& path)
{
  std::ifstream stream(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

class SceneObjects : public ::testing::Test
{
protected:
  std::vector<fs::path> write(const std::string& content, std::uintmax_t partBytes,
                              const std::string& folder = "parts")
  {
    const fs::path archive = m_folder.path() / "a.petrous";
    std::ofstream(archive, std::ios::binary) << content;
    fs::create_directories(m_folder.path() / folder);
    SceneDescription description;
    description.studyUid = imaging::deterministicUid(1, "study");
    return writeSceneObjects(archive, m_folder.path() / folder, description, {}, partBytes);
  }
  std::string read(const std::vector<fs::path>& files)
  {
    const fs::path archive = m_folder.path() / "b.petrous";
    fs::remove(archive);
    readSceneObjects(files, archive);
    return contentOf(archive);
  }
  void expectRefused(const std::vector<fs::path>& files)
  {
    EXPECT_THROW(read(files), core::InvalidParameter);
    EXPECT_FALSE(fs::exists(m_folder.path() / "b.petrous"));
  }

  TemporaryFolder m_folder;
};

} // namespace

TEST_F(SceneObjects, GiveTheArchiveBackInAnyOrder)
{
  for (const std::size_t size : {1U, 999U, 1000U, 1001U, 4321U})
  {
    std::string content;
    for (std::size_t n = 0; n < size; ++n)
      content += static_cast<char>(n * n % 251);
    auto files = write(content, 1000, "of " + std::to_string(size));
    EXPECT_EQ(files.size(), (size + 999) / 1000);
    std::reverse(files.begin(), files.end());
    EXPECT_EQ(read(files), content);
  }
}

// Read as the bytes that PS3.5 7.1 has: tag, VR, length and value, little endian.
TEST_F(SceneObjects, SayNothingOfThePatientThatIsNotKnown)
{
  const std::string bytes = contentOf(write("x", 5).front());
  EXPECT_NE(bytes.find(std::string("\x10\0\x40\0CS\0\0", 8)), std::string::npos) << "sex: empty";
  EXPECT_NE(bytes.find(std::string("\x12\0\x62\0CS\4\0YES ", 12)), std::string::npos);
  const std::size_t codes = bytes.find(std::string("\x12\0\x64\0SQ", 6));
  ASSERT_NE(codes, std::string::npos) << "(0012,0064)";
  EXPECT_NE(bytes.find(std::string("\x08\0\0\1SH\6\000113100", 14), codes), std::string::npos);
}

TEST_F(SceneObjects, TheLatestIsThatOfTheHighestNumber)
{
  std::vector<Series> series(4);
  for (int n = 0; n < 4; ++n)
  {
    series[static_cast<std::size_t>(n)].description = "Petrous scene";
    series[static_cast<std::size_t>(n)].modality = "OT";
  }
  series[0].number = 1003;
  series[1].number = 1012;
  series[2].number = 1007;
  series[3].number = 2000;
  series[3].modality = "CT";
  EXPECT_FALSE(isScene(series[3]));
  EXPECT_EQ(latestScene(series), series.begin() + 1);
  const std::vector<Series> scenes = scenesAmong(series);
  ASSERT_EQ(scenes.size(), 3U);
  EXPECT_EQ(scenes[0].number, 1012);
  EXPECT_EQ(scenes[1].number, 1007);
  EXPECT_EQ(scenes[2].number, 1003);
  series[1].description.clear(); // an optional key of a query
  EXPECT_EQ(latestScene(series), series.begin() + 2) << "where others are described it is none";
  EXPECT_EQ(scenesAmong(series).size(), 2U);
  series[0].description.clear();
  series[2].description.clear();
  EXPECT_EQ(latestScene(series), series.begin() + 1);
  EXPECT_EQ(scenesAmong(series).size(), 3U);
  series[1].number = 3; // anybody's
  EXPECT_FALSE(isScene(series[1]));
  series.erase(series.begin(), series.begin() + 3);
  EXPECT_EQ(latestScene(series), series.end());
}

TEST_F(SceneObjects, AreEqualForEqualArchives)
{
  const auto first = write("the same", 5), second = write("the same", 5, "again");
  ASSERT_EQ(first.size(), 2U);
  for (std::size_t n = 0; n < 2; ++n)
    EXPECT_EQ(contentOf(first[n]), contentOf(second[n]));
}

TEST_F(SceneObjects, OfAnotherSceneMissingTwiceOrDamagedAreRefused)
{
  const std::string content(5000, 'x');
  const auto files = write(content, 1000);
  EXPECT_EQ(read(files), content);
  const auto other = write(std::string(5000, 'y'), 1000, "other");
  expectRefused({});
  expectRefused({files.begin(), files.end() - 1});
  auto mixed = files;
  mixed[2] = other[2];
  expectRefused(mixed);
  mixed[2] = files[1];
  expectRefused(mixed);
  std::string bytes = contentOf(files[3]);
  bytes[bytes.size() - 100] = 'z'; // of the content
  std::ofstream(files[3], std::ios::binary) << bytes;
  expectRefused(files);
  std::ofstream(files[3], std::ios::binary) << bytes.substr(0, bytes.size() - 500);
  expectRefused(files);
  const std::size_t head = bytes.find("petrous-scene 1 ");
  ASSERT_NE(head, std::string::npos);
  bytes.replace(head, 16, "petrous-scene 2 ");
  std::ofstream(files[3], std::ios::binary) << bytes;
  expectRefused(files);
  std::ofstream(files[3], std::ios::binary) << "no DICOM file";
  expectRefused(files);
}

TEST_F(SceneObjects, AFullDiskIsSaid)
{
  rlimit before{};
  ::getrlimit(RLIMIT_FSIZE, &before);
  const auto former = std::signal(SIGXFSZ, SIG_IGN);
  const auto size = static_cast<rlim_t>(fs::file_size(write("abc", 1000).front()));
  for (const rlim_t most : {rlim_t{0}, rlim_t{1}, size / 2, size - 1})
  {
    rlimit limit = before;
    limit.rlim_cur = most;
    ::setrlimit(RLIMIT_FSIZE, &limit);
    try
    {
      write("abc", 1000);
      ADD_FAILURE() << most << ": the disk took it";
    }
    catch (const core::OutputFileError& error)
    {
      EXPECT_EQ(error.reason, core::OutputFileError::Reason::DiskFull) << error.what();
    }
    ::setrlimit(RLIMIT_FSIZE, &before);
  }
  std::signal(SIGXFSZ, former);
}

TEST(NodeList, IsKeptAndHoldsNoKey)
{
  const TemporaryFolder folder;
  Node node;
  node.name = "b";
  node.host = "pacs";
  node.port = 2762;
  node.aeTitle = "ARCHIVE";
  node.movePort = 11113;
  node.moveHost = "pacs-2";
  node.tls = TlsFiles{"/ca.pem", "/own.pem", "/own.key", "pacs.hospital.example"};
  {
    NodeList list(folder.path());
    list.add(node);
    node.name = "a";
    node.tls.reset();
    NodeList(folder.path()).add(node); // by another program meanwhile
    EXPECT_THROW(list.add(node), core::InvalidParameter);
  }
  const NodeList list(folder.path());
  ASSERT_EQ(list.nodes().size(), 2U);
  EXPECT_EQ(list.nodes()[0].name, "a");
  EXPECT_FALSE(list.nodes()[0].tls);
  EXPECT_EQ(list.at("b").port, 2762);
  EXPECT_EQ(list.at("b").movePort, 11113);
  EXPECT_EQ(list.at("b").moveHost, "pacs-2");
  ASSERT_TRUE(list.at("b").tls);
  EXPECT_EQ(list.at("b").tls->key, "/own.key");
  EXPECT_EQ(list.at("b").tls->name, "pacs.hospital.example");
  EXPECT_THROW(list.at("c"), core::InvalidParameter);
}

TEST(NodeList, OfAnotherVersionIsRefused)
{
  const TemporaryFolder folder;
  for (const char* format : {"2", "0", "-1", "4294967297"})
  {
    std::ofstream(folder.path() / "nodes.json") << R"({"format":)" << format << R"(,"nodes":[]})";
    EXPECT_THROW(NodeList(folder.path()), core::InvalidParameter) << format;
  }
}

// 4294967400 is 104 in the bits of an int.
TEST(NodeList, APortThatIsNoneIsRefused)
{
  const TemporaryFolder folder;
  const auto write = [&folder](const char* port)
  {
    std::ofstream(folder.path() / "nodes.json")
        << R"({"format":1,"nodes":[{"name":"a","host":"pacs","ae_title":"ARCHIVE",)"
        << R"("calling_ae_title":"PETROUS","port":)" << port << "}]}";
  };
  write("104");
  EXPECT_NO_THROW(NodeList(folder.path()));
  for (const char* port : {"4294967400", "-4294967192", "65536", "0"})
  {
    write(port);
    EXPECT_THROW(NodeList(folder.path()), core::InvalidParameter) << port;
  }
}

TEST(NodeList, ReplacesTheNodeOfThatNameOnly)
{
  const TemporaryFolder folder;
  Node node;
  node.name = "a";
  node.host = "pacs";
  node.aeTitle = "ARCHIVE";
  NodeList list(folder.path());
  EXPECT_THROW(list.replace(node), core::InvalidParameter) << "there is none";
  list.add(node);
  node.host = "other";
  NodeList(folder.path()).replace(node);
  EXPECT_EQ(NodeList(folder.path()).at("a").host, "other");
  node.port = 0;
  EXPECT_THROW(list.replace(node), core::InvalidParameter);
  EXPECT_EQ(NodeList(folder.path()).at("a").port, 104) << "as it was";
  list.remove("a");
  node.port = 104;
  EXPECT_THROW(list.replace(node), core::InvalidParameter) << "removed meanwhile";
}

TEST(NodeList, RefusesNamesThatCannotBeShownOrKept)
{
  const TemporaryFolder folder;
  Node good;
  good.name = "Zürich";
  good.host = "pacs";
  good.aeTitle = "ARCHIVE";
  good.tls = TlsFiles{"/ca.pem", "", ""};
  NodeList(folder.path()).add(good);
  good.name = "b";
  const auto expectRefused = [&](const std::function<void(Node&)>& change)
  {
    Node node = good;
    change(node);
    try
    {
      NodeList(folder.path()).add(node);
      ADD_FAILURE() << "taken: " << node.name;
    }
    catch (const core::InvalidParameter& error)
    {
      const std::string text = error.what();
      EXPECT_TRUE(std::all_of(text.begin(), text.end(), [](char c) { return c >= 32 && c < 127; }))
          << text;
    }
  };
  expectRefused([](Node& node) { node.name = "\xff\xfe"; });
  expectRefused([](Node& node) { node.name = "a\x1b[2Jb"; });
  expectRefused([](Node& node) { node.host = "p\xff"; });
  expectRefused([](Node& node) { node.host = "p\ac"; });
  expectRefused([](Node& node) { node.moveHost = "p:104"; });
  expectRefused([](Node& node) { node.tls->authority = "/\xff.pem"; });
  expectRefused([](Node& node) { node.tls->name = "a b"; });
  expectRefused(
      [](Node& node)
      {
        node.tls->authority.clear();
        node.tls->name = kAnyName;
      });
  EXPECT_EQ(NodeList(folder.path()).nodes().size(), 1U);
}

} // namespace petrous::network
