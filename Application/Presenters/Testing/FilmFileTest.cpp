#include "petrous/Presenters/FilmFile.h"

#include <fstream>
#include <map>
#include <random>
#include <sstream>

#include <unistd.h>

#include <gtest/gtest.h>

#include "BoneCase.h"
#include "petrous/Core/Error.h"
#include "petrous/Presenters/CameraPaths.h"
#include "petrous/Presenters/CasePicture.h"

using namespace petrous;
using namespace petrous::presenters;
namespace fs = std::filesystem;

namespace
{

class FilmFile : public ::testing::Test
{
protected:
  FilmFile()
    : m_folder(fs::temp_directory_path() / ("petrous-film-" + std::to_string(::getpid()) + "-" +
                                            std::to_string(std::random_device{}())))
  {
    fs::create_directories(m_folder);
    m_contents = sceneContents(m_case);
    m_options.width = 48;
    m_options.height = 36;
  }
  ~FilmFile() override { fs::remove_all(m_folder); }

  std::vector<core::CameraPose> cameras(int frames) const
  {
    return turntable(standardCamera(m_case, rendering::StandardView::Lateral), frames);
  }

  // By name, with what is in them.
  std::map<std::string, std::string> files() const
  {
    std::map<std::string, std::string> all;
    for (const auto& entry : fs::directory_iterator(m_folder))
    {
      std::ostringstream bytes;
      bytes << std::ifstream(entry.path(), std::ios::binary).rdbuf();
      all[entry.path().filename().string()] = bytes.str();
    }
    return all;
  }

  void write(const std::string& name, const std::string& text) const
  {
    std::ofstream(m_folder / name, std::ios::binary) << text;
  }

  const scene::Case m_case = petrous::presenters::testing::block();
  fs::path m_folder;
  rendering::SceneContents m_contents;
  FilmOptions m_options;
};

} // namespace

TEST_F(FilmFile, LeavesTheEarlierFilmWhenCancelled)
{
  for (const char* name : {"F-0001.png", "F-0002.png", "F-0003.png", "F.mp4"})
    write(name, name);
  const auto before = files();
  for (const char* name : {"F.png", "F.mp4"})
  {
    if (isVideo(name) && !videoRefusal().empty())
      continue;
    const auto token = std::make_shared<core::CancelToken>();
    const core::Progress progress(
        [&token](double fraction, const std::string&)
        {
          if (fraction >= 0.5)
            token->cancel();
        },
        token);
    EXPECT_THROW(writeFilm(m_folder / name, m_contents, cameras(4), m_options, progress),
                 core::CancelledError);
    EXPECT_EQ(files(), before) << name;
  }
}

TEST_F(FilmFile, RemovesTheFramesOfALongerOne)
{
  for (const char* name :
       {"F-0001.png", "F-0002.png", "F-0003.png", "F-0004.png", "F-0006.png", "G-0003.png"})
    write(name, "another's");
  EXPECT_EQ(framesBeyond(m_folder / "F.png", 2).size(), 2U);
  m_options.removesAnyBeyond = true;
  EXPECT_EQ(writeFilm(m_folder / "F.png", m_contents, cameras(2), m_options), 2U);
  const auto after = files();
  ASSERT_EQ(after.size(), 4U);
  for (const char* name : {"F-0001.png", "F-0002.png"})
    EXPECT_EQ(after.at(name).substr(1, 3), "PNG");
  EXPECT_EQ(after.at("F-0006.png"), "another's") << "no player goes on to it";
  EXPECT_EQ(after.at("G-0003.png"), "another's");
  EXPECT_TRUE(framesBeyond(m_folder / "F.mp4", 2).empty());
}

// What follows is removed as far as it is a film's, without having asked.
TEST_F(FilmFile, LeavesWhatIsNotKnownToBeAFrame)
{
  EXPECT_EQ(writeFilm(m_folder / "F.png", m_contents, cameras(6), m_options), 0U);
  const auto film = files();
  const std::string signature("\x89PNG\r\n\x1a\n", 8);
  write("F-0004.png", signature + "another's");
  write("F-0005.png", film.at("F-0006.png"));
  EXPECT_EQ(writeFilm(m_folder / "F.png", m_contents, cameras(2), m_options), 1U);
  const auto after = files();
  EXPECT_EQ(after.count("F-0003.png"), 0U);
  EXPECT_EQ(after.at("F-0004.png"), signature + "another's");
  EXPECT_EQ(after.count("F-0005.png"), 1U) << "no player goes on to it";
}

// A chunk of text, behind the header: length, type, content, CRC-32 [PNG, 2nd edition, 11.3.4.3].
TEST_F(FilmFile, NamesTheProgramInItsFrames)
{
  writeFilm(m_folder / "F.png", m_contents, cameras(2), m_options);
  const std::string frame = files().at("F-0001.png");
  const std::string chunk("\0\0\0\x15tEXtSoftware\0Petrous film\x8e\x47\x7a\x10", 33);
  EXPECT_EQ(frame.find("IHDR"), 12U);
  EXPECT_EQ(frame.find(chunk), 33U);
}

TEST_F(FilmFile, IsNotBegunWhereAFrameCannotStand)
{
  write("F-0001.png", "first");
  fs::create_directories(m_folder / "F-0002.png");
  EXPECT_THROW(writeFilm(m_folder / "F.png", m_contents, cameras(2), m_options), core::Error);
  std::ifstream first(m_folder / "F-0001.png");
  std::string text;
  first >> text;
  EXPECT_EQ(text, "first");
}

TEST_F(FilmFile, HasTheColourScaleOfTheThickness)
{
  m_options.width = 320;
  m_options.height = 240;
  writeFilm(m_folder / "plain.png", m_contents, cameras(2), m_options);
  m_options.thickness = "sinus";
  writeFilm(m_folder / "scale.png", m_contents, cameras(2), m_options);
  const auto made = files();
  EXPECT_NE(made.at("plain-0001.png"), made.at("scale-0001.png"));
}
