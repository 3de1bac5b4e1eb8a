#include "petrous/Video/VideoPlayer.h"

#include <algorithm>
#include <utility>

namespace petrous::video
{

namespace
{

using Clock = std::chrono::steady_clock;

constexpr Time kTooLate{500'000'000}; // then it goes on from here, slower than it should
constexpr int kMostLeftOut = 5;       // frames in a row

} // namespace

// The open video, in the player's thread.
class VideoPlayer::Session
{
public:
  explicit Session(VideoPlayer& player)
    : m_player(player)
    , m_events(player.m_events)
  {
  }

  bool isPlaying() const noexcept { return m_isPlaying; }

  /// When the next frame is to be shown.
  Clock::time_point due() const
  {
    const auto next = m_file->nextTime();
    if (m_file->gap()) // that is not waited for
      return Clock::now();
    return next ? m_origin + std::chrono::duration_cast<Clock::duration>(*next) : Clock::now();
  }

  void act(const Wanted& wanted, const std::optional<Loop>& loop)
  try
  {
    m_loop = loop && loop->end > loop->begin ? loop : std::nullopt;
    if (wanted.isClosed || wanted.file)
      leave();
    if (wanted.file)
    {
      m_opening = wanted.opening;
      m_file.emplace(wanted.file->first, wanted.file->second, [this] { return m_player.isLeft(); });
      if (m_events.opened)
        m_events.opened(m_opening, m_file->info());
      show();
    }
    if (!m_file)
      return;
    if (wanted.place)
    {
      m_file->seek(*wanted.place);
      show();
    }
    if (wanted.steps != 0)
    {
      setPlaying(false);
      bool moved = true;
      for (int n = std::abs(wanted.steps); n > 0 && moved && !m_player.isElsewhere(); --n)
        moved = wanted.steps > 0 ? m_file->next() : m_file->previous();
      show();
    }
    if (wanted.playing && *wanted.playing && !m_isPlaying)
    {
      if (!m_file->nextTime())
        m_file->seek(m_loop ? m_loop->begin : Time(0));
      show();
    }
    if (wanted.playing)
      setPlaying(*wanted.playing);
    if (m_isPlaying && Clock::now() >= due())
      goOn();
  }
  catch (const VideoError& error)
  {
    fail(error.what(), error.reason == VideoError::Reason::Interrupted);
  }
  catch (const std::exception& error)
  {
    fail(error.what(), false);
  }

private:
  void fail(const std::string& why, bool isMeant)
  {
    leave();
    if (m_events.failed && !isMeant)
      m_events.failed(m_opening, why);
  }

  void goOn()
  {
    const auto next = m_file->nextTime();
    if (m_loop && (!next || *next >= m_loop->end))
    {
      m_file->seek(m_loop->begin);
      return show();
    }
    if (!next)
      return setPlaying(false);
    const auto now = Clock::now();
    const bool isGap = m_file->gap().has_value();
    m_file->next();
    for (int n = 0; n < kMostLeftOut && now >= due() && m_file->nextTime() && !m_file->gap() &&
                    !(m_loop && *m_file->nextTime() >= m_loop->end);
         ++n)
      m_file->next();
    const bool isLate = Clock::now() - due() > kTooLate;
    show(isLate || isGap);
  }

  // `anew`: time runs from this frame on.
  void show(bool anew = true)
  {
    const Frame& frame = m_file->current();
    if (anew)
      m_origin = Clock::now() - std::chrono::duration_cast<Clock::duration>(frame.time);
    if (m_events.shown)
      m_events.shown(m_opening, frame);
    const auto gap = m_file->gap();
    if (gap && gap->begin != m_told && m_events.gap)
      m_events.gap(m_opening, *gap);
    m_told = gap ? std::optional<Time>(gap->begin) : std::nullopt;
  }

  void setPlaying(bool on)
  {
    if (std::exchange(m_isPlaying, on) != on && m_events.playing)
      m_events.playing(m_opening, on);
  }

  void leave()
  {
    m_file.reset();
    m_told.reset();
    setPlaying(false);
  }

  VideoPlayer& m_player;
  const Events& m_events;
  Opening m_opening = 0;
  std::optional<VideoFile> m_file;
  std::optional<Time> m_told; // the gap
  std::optional<Loop> m_loop;
  Clock::time_point m_origin{}; // when the video's beginning would have been shown
  bool m_isPlaying = false;
};

VideoPlayer::VideoPlayer(Events events)
  : m_events(std::move(events))
{
}

VideoPlayer::~VideoPlayer()
{
  {
    const std::lock_guard<std::mutex> lock(m_mutex);
    m_ends = true;
  }
  m_changed.notify_one();
  if (m_thread.joinable())
    m_thread.join();
}

void VideoPlayer::want(const std::function<void(Wanted&)>& what)
{
  {
    const std::lock_guard<std::mutex> lock(m_mutex);
    what(m_wanted);
  }
  m_changed.notify_one();
}

bool VideoPlayer::isLeft()
{
  const std::lock_guard<std::mutex> lock(m_mutex);
  return m_ends || m_wanted.isClosed || m_wanted.file;
}

bool VideoPlayer::isElsewhere()
{
  const std::lock_guard<std::mutex> lock(m_mutex);
  return m_ends || m_wanted.isClosed || m_wanted.file || m_wanted.place;
}

VideoPlayer::Opening VideoPlayer::open(const std::filesystem::path& file, const std::string& name)
{
  Opening opening = 0;
  want(
      [&](Wanted& wanted)
      {
        wanted = {};
        wanted.file.emplace(file, name);
        opening = wanted.opening = ++m_opening;
      });
  if (!m_thread.joinable())
    m_thread = std::thread([this] { run(); });
  return opening;
}

void VideoPlayer::close()
{
  want(
      [](Wanted& wanted)
      {
        wanted = {};
        wanted.isClosed = true;
      });
}

void VideoPlayer::play(bool on)
{
  want([on](Wanted& wanted) { wanted.playing = on; });
}

void VideoPlayer::seek(Time time)
{
  want(
      [time](Wanted& wanted)
      {
        wanted.place = time;
        wanted.steps = 0;
      });
}

void VideoPlayer::step(int frames)
{
  want(
      [frames](Wanted& wanted)
      {
        wanted.steps += frames;
        wanted.playing.reset();
      });
}

void VideoPlayer::setLoop(std::optional<Loop> loop)
{
  const std::lock_guard<std::mutex> lock(m_mutex);
  m_loop = loop;
}

void VideoPlayer::run()
{
  Session session(*this);
  std::unique_lock<std::mutex> lock(m_mutex);
  const auto isWanted = [this] { return m_ends || m_wanted.any(); };
  while (true)
  {
    if (session.isPlaying())
      m_changed.wait_until(lock, session.due(), isWanted);
    else
      m_changed.wait(lock, isWanted);
    if (m_ends)
      return;
    const Wanted wanted = std::exchange(m_wanted, {});
    const std::optional<Loop> loop = m_loop;
    lock.unlock();
    session.act(wanted, loop);
    lock.lock();
  }
}

} // namespace petrous::video
