#pragma once

#include <condition_variable>
#include <filesystem>
#include <functional>
#include <mutex>
#include <optional>
#include <string>
#include <thread>

#include "petrous/Video/VideoFile.h"

namespace petrous::video
{

/// Plays a video in a thread of its own, which is started with the first `open`. What is asked
/// returns at once; of several places to go to, the last counts. Frames that come too late are left
/// out, so that playing keeps its time.
class VideoPlayer
{
public:
  using Opening = std::uint64_t; ///< the number that `open` gave to it

  /// Called in the player's thread, in order, with the number of the video; each may be empty.
  struct Events
  {
    std::function<void(Opening, const VideoInfo&)> opened;   ///< before its first frame
    std::function<void(Opening, const Frame&)> shown;        ///< another frame, or one asked for
    std::function<void(Opening, bool)> playing;              ///< it begins or ends, also of itself
    std::function<void(Opening, const Gap&)> gap;            ///< after the frame that is shown
    std::function<void(Opening, const std::string&)> failed; ///< the video is closed then
  };

  /// A part that is repeated: from the frame at `begin` to the last one before `end`.
  struct Loop
  {
    Time begin{0};
    Time end{0};
  };

  explicit VideoPlayer(Events events);
  ~VideoPlayer(); ///< a frame that is waited for is given up
  VideoPlayer(const VideoPlayer&) = delete;
  VideoPlayer& operator=(const VideoPlayer&) = delete;

  /// A video that is still being opened is given up, and so it is by `close`.
  Opening open(const std::filesystem::path& file, const std::string& name = {});
  void close();
  void play(bool on); ///< from the beginning, if it is at the end
  void seek(Time time);
  /// Forth, or back below 0; pauses. A place that is asked for meanwhile ends it.
  void step(int frames);
  void setLoop(std::optional<Loop> loop); ///< empty or backwards: none

private:
  struct Wanted
  {
    bool isClosed = false;
    Opening opening = 0; // of the file
    std::optional<std::pair<std::filesystem::path, std::string>> file;
    std::optional<Time> place;
    int steps = 0; ///< after that
    std::optional<bool> playing;

    bool any() const { return isClosed || file || place || steps != 0 || playing; }
  };

  void want(const std::function<void(Wanted&)>& what);
  void run();
  bool isLeft();      // the video that is open
  bool isElsewhere(); // or another place is wanted

  class Session;
  const Events m_events;
  std::mutex m_mutex; // of what follows
  std::condition_variable m_changed;
  Wanted m_wanted;
  std::optional<Loop> m_loop;
  Opening m_opening = 0; // the latest
  bool m_ends = false;
  std::thread m_thread;
};

} // namespace petrous::video
