#include "petrous/Devices/ServerCatalogue.h"

#include <cstdlib>
#include <fstream>

#include <gtest/gtest.h>

#include <unistd.h>

using namespace petrous::devices;
namespace fs = std::filesystem;

namespace
{

class ServerCatalogueTest : public ::testing::Test
{
protected:
  ServerCatalogueTest()
  {
    std::string name = (fs::temp_directory_path() / "petrous-servers-XXXXXX").string();
    top = ::mkdtemp(name.data());
  }
  ~ServerCatalogueTest() override { fs::remove_all(top); }

  void put(const std::string& name, bool runs)
  {
    fs::create_directories((top / name).parent_path());
    std::ofstream(top / name) << "#!/bin/sh\n";
    const auto all = fs::perms::owner_read | fs::perms::owner_write;
    fs::permissions(top / name, runs ? all | fs::perms::owner_exec : all);
  }

  fs::path top;
};

} // namespace

TEST_F(ServerCatalogueTest, ListsProgramsByNameWithoutTheirPrefix)
{
  put("a/petrous-device-touch", true);
  put("a/omega.7", true);
  put("a/README", false);
  put("a/.hidden", true);
  put("a/two words", true);
  put("a/" + std::string(49, 'x'), true);
  fs::create_directories(top / "a/folder");
  const auto servers = findServers({top / "nowhere", top / "a"});
  ASSERT_EQ(servers.size(), 2U);
  EXPECT_EQ(servers[0].name, "omega.7");
  EXPECT_EQ(servers[1].name, "touch");
  EXPECT_EQ(servers[1].program, top / "a/petrous-device-touch");
}

TEST_F(ServerCatalogueTest, TheFirstFolderGoesBeforeTheNext)
{
  put("a/touch", true);
  put("b/petrous-device-touch", true);
  put("b/falcon", true);
  const auto servers = findServers({top / "a", top / "b"});
  ASSERT_EQ(servers.size(), 2U);
  EXPECT_EQ(servers[0].name, "falcon");
  EXPECT_EQ(servers[1].program, top / "a/touch");
}

TEST_F(ServerCatalogueTest, TheUsersFoldersComeFromTheEnvironment)
{
  ::setenv("PETROUS_DEVICE_SERVERS", "/x/one::/x/two", 1);
  EXPECT_EQ(serverFolders(), (std::vector<fs::path>{"/x/one", "/x/two"}));
  ::unsetenv("PETROUS_DEVICE_SERVERS");
  ::setenv("XDG_DATA_HOME", "/x/data", 1);
  const auto folders = serverFolders();
  ::unsetenv("XDG_DATA_HOME");
  ASSERT_EQ(folders.size(), 3U);
  EXPECT_EQ(folders.front(), "/x/data/petrous/devices");
}
