#include "petrous/Video/VideoFile.h"

// Without GStreamer.
namespace petrous::video
{

class VideoFile::Implementation
{
public:
  VideoInfo info;
  Frame frame;
};

bool isSupported() noexcept
{
  return false;
}

VideoFile::VideoFile(const std::filesystem::path& /*file*/, const std::string& /*name*/,
                     std::function<bool()> /*isStopped*/)
{
  throw VideoError(VideoError::Reason::NotBuilt,
                   "video support was not built: this program was built without GStreamer "
                   "(Debian's libgstreamer-plugins-base1.0-dev)");
}

VideoFile::~VideoFile() = default;
VideoFile::VideoFile(VideoFile&& other) noexcept = default;
VideoFile& VideoFile::operator=(VideoFile&& other) noexcept = default;

const VideoInfo& VideoFile::info() const noexcept
{
  return m_implementation->info;
}

const Frame& VideoFile::current() const noexcept
{
  return m_implementation->frame;
}

std::optional<Time> VideoFile::nextTime() const noexcept
{
  return std::nullopt;
}

std::optional<Gap> VideoFile::gap() const noexcept
{
  return std::nullopt;
}

const Frame& VideoFile::seek(Time /*time*/)
{
  return m_implementation->frame;
}

bool VideoFile::next()
{
  return false;
}

bool VideoFile::previous()
{
  return false;
}

} // namespace petrous::video
