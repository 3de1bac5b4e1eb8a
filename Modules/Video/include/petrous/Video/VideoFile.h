#pragma once

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "petrous/Core/Error.h"

namespace petrous::video
{

using Time = std::chrono::nanoseconds; ///< from the beginning of the video

struct VideoError : core::Error
{
  enum class Reason
  {
    NotBuilt,     ///< this program has no video support
    NotReadable,  ///< there is no such file, or it cannot be read
    NotAVideo,    ///< no container that is known
    NoPicture,    ///< sound only
    MissingCodec, ///< a decoder is not installed; the message names it
    NotExact,     ///< its frames have no times that hold for playing and seeking alike
    Damaged,      ///< no frame of it can be decoded
    Stalled,      ///< the decoder does not answer
    Interrupted   ///< as the caller asked
  };
  VideoError(Reason r, const std::string& message);
  Reason reason;
};

/// Whether GStreamer was there when the program was built. Loads and starts nothing.
bool isSupported() noexcept;

/// RGB, 8 bits each, rows from the top without padding.
struct Frame
{
  int width = 0;
  int height = 0;
  Time time{0};
  std::shared_ptr<const std::vector<std::uint8_t>> pixels;
};

struct VideoInfo
{
  /// As it is shown: pixels are square and the picture upright.
  int width = 0;
  int height = 0;
  Time duration{0};       ///< 0: the file does not say
  double frameRate = 0.0; ///< Hz, of the file's header; 0: it varies, or the file does not say
  bool hasSound = false;  ///< which is neither decoded nor played
};

/// A part without frames: damaged, or missing at the end.
struct Gap
{
  Time begin{0};           ///< of the last frame before
  std::optional<Time> end; ///< of the first frame after; none: there is none
};

/// The frames of a video, by their exact times. Decoding takes as long as it takes: use it in a
/// thread of its own (VideoPlayer). Sound is not decoded, and no tag of the file is read.
///
/// All throw VideoError. A part that cannot be decoded amid others is passed over (gap). Files that
/// refer to other places, as playlists do, are refused.
class VideoFile
{
public:
  /// Decodes the first frame. `name`: of the file in messages; empty: its own, without the folder.
  /// `isStopped`: asked while a frame is waited for; then Interrupted is thrown, after which only
  /// `seek` and destruction are left. Called in this thread.
  explicit VideoFile(const std::filesystem::path& file, const std::string& name = {},
                     std::function<bool()> isStopped = {});
  ~VideoFile();
  VideoFile(VideoFile&& other) noexcept;
  VideoFile& operator=(VideoFile&& other) noexcept;

  const VideoInfo& info() const noexcept;
  const Frame& current() const noexcept;
  std::optional<Time> nextTime() const noexcept; ///< of the frame after; none at the last one
  /// Between the present frame and the next one; at the last one, if the file breaks off there or
  /// ends before the duration that it states.
  std::optional<Gap> gap() const noexcept;

  /// The frame that is shown at a time: the last one that does not begin after it; the first frame
  /// before its time, the last one beyond the end.
  const Frame& seek(Time time);
  bool next();     ///< to the frame after; false at the last one, which stays
  bool previous(); ///< to the one before; false at the first

private:
  class Implementation;
  std::unique_ptr<Implementation> m_implementation;
};

} // namespace petrous::video
