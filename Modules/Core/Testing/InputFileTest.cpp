#include "petrous/Core/InputFile.h"

#include <string>

#include <gtest/gtest.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/un.h>
#include <unistd.h>

namespace
{

using namespace petrous;
namespace fs = std::filesystem;
using Reason = core::InputFileError::Reason;

class InputFile : public ::testing::Test
{
protected:
  InputFile()
  {
    std::string name = (fs::temp_directory_path() / "petrous-input-XXXXXX").string();
    m_folder = ::mkdtemp(name.data());
  }
  ~InputFile() override { fs::remove_all(m_folder); }

  fs::path file(const std::string& name, const std::string& content) const
  {
    std::ofstream(m_folder / name, std::ios::binary) << content;
    return m_folder / name;
  }

  static Reason reasonOf(const fs::path& path, std::uintmax_t limit = core::InputFile::kUnlimited)
  {
    try
    {
      core::InputFile file(path, limit);
    }
    catch (const core::InputFileError& error)
    {
      EXPECT_EQ(std::string(error.what()), core::printable(path) + ": " + error.problem);
      EXPECT_EQ(error.fault(), core::Fault::BadInput);
      return error.reason;
    }
    ADD_FAILURE() << path << " was opened";
    return Reason::Unreadable;
  }

  fs::path m_folder;
};

TEST_F(InputFile, ReadsWhatARegularFileHolds)
{
  const std::string content("a\0b\r\n\x1a", 6);
  const fs::path path = file("plain", content);
  EXPECT_EQ(core::readFile(path), content);
  EXPECT_EQ(core::InputFile(path).size(), 6U);
  EXPECT_EQ(core::InputFile(path).read(2), content.substr(0, 2));
  EXPECT_EQ(core::readFile(file("empty", "")), "");
  fs::create_symlink(path, m_folder / "link");
  EXPECT_EQ(core::readFile(m_folder / "link"), content);
  std::string line;
  std::ifstream stream = core::openInput(path);
  EXPECT_TRUE(std::getline(stream, line));
}

// Each of these would block in open() or never end.
TEST_F(InputFile, RefusesPipesDevicesAndSocketsAtOnce)
{
  const fs::path fifo = m_folder / "fifo";
  ASSERT_EQ(::mkfifo(fifo.c_str(), 0600), 0);
  EXPECT_EQ(reasonOf(fifo), Reason::NotRegular);
  fs::create_symlink(fifo, m_folder / "link");
  EXPECT_EQ(reasonOf(m_folder / "link"), Reason::NotRegular);
  EXPECT_EQ(reasonOf("/dev/zero"), Reason::NotRegular);
  EXPECT_EQ(reasonOf("/dev/tty"), Reason::NotRegular);
  EXPECT_EQ(reasonOf(m_folder), Reason::NotRegular);

  const int socket = ::socket(AF_UNIX, SOCK_STREAM, 0);
  sockaddr_un address = {};
  address.sun_family = AF_UNIX;
  (m_folder / "socket").string().copy(address.sun_path, sizeof address.sun_path - 1);
  ASSERT_EQ(::bind(socket, reinterpret_cast<const sockaddr*>(&address), sizeof address), 0);
  EXPECT_EQ(reasonOf(m_folder / "socket"), Reason::NotRegular);
  ::close(socket);
  EXPECT_THROW(core::openInput(fifo), core::InputFileError);
}

TEST_F(InputFile, RefusesMoreThanItsLimitWithoutReading)
{
  const fs::path path = file("large", "");
  fs::resize_file(path, std::uintmax_t{1} << 40); // sparse
  EXPECT_EQ(reasonOf(path, 1 << 20), Reason::TooLarge);
  EXPECT_THROW(core::readFile(path, 1 << 20), core::InputFileError);
  EXPECT_EQ(core::readFile(file("exact", "1234"), 4), "1234");
  EXPECT_EQ(reasonOf(file("more", "12345"), 4), Reason::TooLarge);
}

TEST_F(InputFile, SaysWhatIsNotThereOrMayNotBeRead)
{
  EXPECT_EQ(reasonOf(m_folder / "none"), Reason::NotFound);
  EXPECT_EQ(reasonOf(file("plain", "x") / "below"), Reason::NotFound);
  if (::geteuid() != 0)
  {
    ::chmod((m_folder / "plain").c_str(), 0);
    EXPECT_EQ(reasonOf(m_folder / "plain"), Reason::Denied);
  }
}

TEST_F(InputFile, NoticesAFileThatBecameShorter)
{
  const fs::path path = file("shrinks", std::string(100, 'x'));
  const core::InputFile input(path);
  fs::resize_file(path, 10);
  EXPECT_THROW(input.read(), core::InputFileError);
}

TEST_F(InputFile, KeepsControlCharactersOutOfMessages)
{
  EXPECT_EQ(core::printable("a\nb\x1b[2J"), "a?b?[2J");
}

} // namespace
