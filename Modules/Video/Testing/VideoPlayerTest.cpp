#include "petrous/Video/VideoPlayer.h"

#include <algorithm>
#include <fstream>

#include <gtest/gtest.h>
#include <unistd.h>

#include "MadeVideo.h"

namespace petrous::video
{
namespace
{

namespace fs = std::filesystem;
using made::numberOf;
using std::chrono::milliseconds;

// A video of 30 frames in 1.2 s, and what a player said of it.
class Player : public testing::Test
{
protected:
  Player()
    : m_file(fs::temp_directory_path() / ("petrous-player-" + std::to_string(getpid()) + ".mkv"))
  {
  }
  ~Player() override { fs::remove(m_file); }

  void SetUp() override
  {
    made::Options options;
    options.frames = 30;
    made::write(m_file, made::kRawMatroska, options);
  }

  VideoPlayer::Events events()
  {
    VideoPlayer::Events events;
    events.opened = [this](VideoPlayer::Opening of, const VideoInfo&)
    {
      heard(
          [&]
          {
            ++m_opened;
            m_of.push_back(of);
          });
    };
    events.shown = [this](VideoPlayer::Opening of, const Frame& frame)
    {
      heard(
          [&]
          {
            m_thread = std::this_thread::get_id();
            m_numbers.push_back(numberOf(frame));
            m_of.push_back(of);
          });
    };
    events.playing = [this](VideoPlayer::Opening, bool on)
    { heard([&] { m_playing.push_back(on); }); };
    events.gap = [this](VideoPlayer::Opening, const Gap& gap)
    { heard([&] { m_gaps.push_back(gap); }); };
    events.failed = [this](VideoPlayer::Opening of, const std::string& why)
    {
      heard(
          [&]
          {
            m_why = why;
            m_of.push_back(of);
          });
    };
    return events;
  }

  bool waitFor(const std::function<bool()>& what)
  {
    std::unique_lock<std::mutex> lock(m_mutex);
    return m_heard.wait_for(lock, std::chrono::seconds(20), what);
  }

  bool shows(int number)
  {
    return waitFor([&] { return !m_numbers.empty() && m_numbers.back() == number; });
  }

  fs::path m_file;
  std::mutex m_mutex; // of what follows
  std::condition_variable m_heard;
  int m_opened = 0;
  std::vector<int> m_numbers;
  std::vector<bool> m_playing;
  std::vector<Gap> m_gaps;
  std::vector<VideoPlayer::Opening> m_of; // of what was opened, shown, or failed
  std::string m_why;
  std::thread::id m_thread;

private:
  void heard(const std::function<void()>& what)
  {
    const std::lock_guard<std::mutex> lock(m_mutex);
    what();
    m_heard.notify_all();
  }
};

TEST_F(Player, GoesWhereItIsAskedInAThreadOfItsOwn)
{
  VideoPlayer player(events());
  player.open(m_file);
  ASSERT_TRUE(shows(0));
  EXPECT_EQ(m_opened, 1);
  EXPECT_NE(m_thread, std::this_thread::get_id());
  player.seek(milliseconds(410));
  ASSERT_TRUE(shows(10));
  player.step(1);
  ASSERT_TRUE(shows(11));
  player.step(-3);
  ASSERT_TRUE(shows(8));
  for (int n = 0; n < 1000; ++n) // a slider that is dragged: the last place counts
    player.seek(milliseconds(n));
  player.seek(milliseconds(1000));
  ASSERT_TRUE(shows(25));
  EXPECT_TRUE(m_playing.empty());
  EXPECT_TRUE(m_why.empty());
}

TEST_F(Player, PlaysToTheEndAndThenFromTheBeginning)
{
  VideoPlayer player(events());
  player.open(m_file);
  player.seek(milliseconds(800));
  player.play(true);
  ASSERT_TRUE(waitFor([this] { return m_playing.size() == 2; }));
  EXPECT_EQ(m_playing, (std::vector<bool>{true, false}));
  EXPECT_EQ(m_numbers.back(), 29);
  EXPECT_TRUE(std::is_sorted(m_numbers.begin(), m_numbers.end()));
  m_numbers.clear();
  player.play(true);
  ASSERT_TRUE(waitFor([this] { return !m_numbers.empty(); }));
  EXPECT_EQ(m_numbers.front(), 0);
  player.play(false);
  ASSERT_TRUE(waitFor([this] { return m_playing.size() == 4; }));
}

TEST_F(Player, RepeatsAPartOfIt)
{
  VideoPlayer player(events());
  player.open(m_file);
  player.setLoop(VideoPlayer::Loop{milliseconds(200), milliseconds(360)}); // frames 5 to 8
  player.seek(milliseconds(200));
  ASSERT_TRUE(shows(5));
  player.play(true);
  ASSERT_TRUE(waitFor([this] { return std::count(m_numbers.begin(), m_numbers.end(), 5) >= 4; }));
  for (const int number : m_numbers)
    EXPECT_TRUE(number == 0 || (number >= 5 && number <= 8)) << number;
  player.setLoop(std::nullopt);
  ASSERT_TRUE(shows(29));
}

TEST_F(Player, SaysWhyItCannot)
{
  VideoPlayer player(events());
  std::ofstream(m_file) << "a text";
  player.open(m_file, "theatre");
  ASSERT_TRUE(waitFor([this] { return !m_why.empty(); }));
  EXPECT_EQ(m_why.find("theatre: "), 0U) << m_why;
  player.play(true); // of nothing
  player.step(1);
  SetUp();
  player.open(m_file);
  ASSERT_TRUE(shows(0));
  player.close();
}

TEST_F(Player, SaysOfWhichVideoItTells)
{
  const fs::path text = m_file.string() + ".txt";
  std::ofstream(text) << "a text";
  VideoPlayer player(events());
  EXPECT_EQ(player.open(m_file), 1U);
  ASSERT_TRUE(shows(0));
  EXPECT_EQ(player.open(text), 2U);
  ASSERT_TRUE(waitFor([this] { return !m_why.empty(); }));
  EXPECT_EQ(m_of.back(), 2U);
  for (int n = 3; n < 20; ++n) // all but the last are given up
    EXPECT_EQ(player.open(n % 2 == 0 ? text : m_file), static_cast<VideoPlayer::Opening>(n));
  EXPECT_EQ(player.open(m_file), 20U);
  player.seek(milliseconds(410));
  ASSERT_TRUE(shows(10));
  fs::remove(text);
  EXPECT_EQ(m_of.back(), 20U);
  EXPECT_TRUE(std::is_sorted(m_of.begin(), m_of.end()));
}

TEST_F(Player, SaysWhereAFileBreaksOff)
{
  made::Options options;
  options.frames = 100;
  made::write(m_file, made::kRawMatroska, options);
  fs::resize_file(m_file, fs::file_size(m_file) / 2);
  VideoPlayer player(events());
  player.open(m_file);
  player.seek(milliseconds(1600));
  player.play(true);
  ASSERT_TRUE(waitFor([this] { return m_playing.size() == 2; }));
  ASSERT_EQ(m_gaps.size(), 1U);
  EXPECT_FALSE(m_gaps[0].end);
  EXPECT_NEAR(static_cast<double>(m_gaps[0].begin.count()), 2e9, 0.2e9);
}

} // namespace
} // namespace petrous::video
