#include <chrono>
#include <fstream>
#include <iterator>

#include "TestCase.h"
#include "petrous/Library/LibraryFiles.h"

using namespace petrous;
using namespace petrous::library;

namespace
{

namespace fs = std::filesystem;

class Sources : public ::testing::Test
{
protected:
  fs::path write(const std::string& name) const
  {
    fs::create_directories((m_folder.path() / name).parent_path());
    std::ofstream(m_folder.path() / name) << name;
    return m_folder.path() / name;
  }

  void import(const std::string& name, const fs::path& from)
  {
    scene::Case value = test::smallCase(name);
    value.origins.push_back({from, fs::file_time_type::clock::now() + std::chrono::minutes(1)});
    m_library.save(value);
    EXPECT_TRUE(value.origins.empty());
  }

  bool isRefused(const fs::path& file) const
  {
    try
    {
      refuseOverwriting(file, m_library.folder());
      return false;
    }
    catch (const core::Error& error)
    {
      EXPECT_EQ(error.fault(), core::Fault::Refused);
      EXPECT_NE(std::string(error.what()).find(file.string()), std::string::npos) << error.what();
      return true;
    }
  }

  test::TemporaryFolder m_folder;
  Library m_library{m_folder.path() / "library"};
};

} // namespace

TEST_F(Sources, AFileThatWasImportedIsNotReplacedByAnyName)
{
  const fs::path source = write("ct.nrrd");
  const fs::path other = write("other.nrrd");
  EXPECT_FALSE(isRefused(source));
  import("ear", source);
  EXPECT_TRUE(isRefused(source));
  EXPECT_TRUE(isRefused(m_folder.path() / "library/../ct.nrrd"));
  fs::create_symlink(source, m_folder.path() / "link.nrrd");
  EXPECT_TRUE(isRefused(m_folder.path() / "link.nrrd"));
  EXPECT_FALSE(isRefused(other));
  EXPECT_FALSE(isRefused(m_folder.path() / "new.nrrd"));
  import("twin", other);
  EXPECT_TRUE(isRefused(source)) << "still";
  EXPECT_TRUE(isRefused(other));
  fs::remove(source);
  EXPECT_FALSE(isRefused(source)) << "there is nothing to lose";
}

TEST_F(Sources, OfAFolderWhatWasThereIsKeptAndWhatIsWrittenLaterIsNot)
{
  const fs::path slice = write("scan/series/slice-1.dcm");
  import("ear", m_folder.path() / "scan");
  EXPECT_TRUE(isRefused(slice));
  const fs::path picture = write("scan/picture.png");
  fs::last_write_time(picture, fs::file_time_type::clock::now() + std::chrono::hours(1));
  EXPECT_FALSE(isRefused(picture));
  import("again", m_folder.path() / "scan");
  EXPECT_FALSE(isRefused(picture)) << "written after that, too";
  EXPECT_TRUE(isRefused(slice));
}

TEST_F(Sources, FilesChosenOneByOneAreKnownByTheirLinks)
{
  const fs::path slice = write("scan/slice-1.dcm");
  fs::create_directories(m_folder.path() / "chosen");
  fs::create_symlink(slice, m_folder.path() / "chosen/1");
  import("ear", m_folder.path() / "chosen");
  fs::remove_all(m_folder.path() / "chosen");
  EXPECT_TRUE(isRefused(slice));
}

TEST_F(Sources, ALinkedAttachmentIsNotReplaced)
{
  const fs::path film = write("film.mp4");
  scene::Case value = test::smallCase("ear");
  scene::Attachment link;
  link.kind = scene::Attachment::Kind::Video;
  link.name = "film.mp4";
  link.link = film.string();
  link.sha256 = std::string(64, 'a');
  link.bytes = fs::file_size(film);
  value.attachments.push_back(link);
  m_library.save(value);
  EXPECT_TRUE(isRefused(film));
}

// A path often names the patient.
TEST_F(Sources, NoPathStandsInTheLibrary)
{
  import("ear", write("Doe Jane/ct.nrrd"));
  for (const auto& [name, content] : test::contentOf(m_library.folder()))
    EXPECT_EQ(content.find("Doe Jane"), std::string::npos) << name;
  std::ifstream file(m_library.folder() / "sources");
  EXPECT_NE(std::string(std::istreambuf_iterator<char>(file), {}), "") << "it is kept there";
}

TEST(LibraryFolder, ThatTheUserNamesIsThereOrCanBeMade)
{
  const test::TemporaryFolder folder;
  const fs::path file = folder.path() / "file";
  std::ofstream(file) << "x";
  EXPECT_NO_THROW(checkLibraryFolder(folder.path()));
  EXPECT_NO_THROW(checkLibraryFolder(folder.path() / "new"));
  EXPECT_NO_THROW(checkLibraryFolder((folder.path() / "new").string() + "/"));
  const auto refused = [](const fs::path& path, const std::string& words)
  {
    const auto [reason, text] = test::refusal([&] { checkLibraryFolder(path); });
    EXPECT_EQ(reason, LibraryError::Reason::NotFound);
    EXPECT_NE(text.find(path.string()), std::string::npos) << text;
    EXPECT_NE(text.find(words), std::string::npos) << text;
  };
  refused(file, "is a file; a library is a folder");
  refused(file / "below", "is a file; give a folder");
  refused(folder.path() / "none/new", (folder.path() / "none").string() + " is not there");
  EXPECT_FALSE(fs::exists(folder.path() / "none"));
}
