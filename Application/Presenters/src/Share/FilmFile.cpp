#include "petrous/Presenters/FilmFile.h"

#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <memory>
#include <sstream>
#include <string_view>
#include <utility>

#include <fcntl.h>
#include <spawn.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include "petrous/Core/Error.h"
#include "petrous/Core/InputFile.h"
#include "petrous/Core/NumberText.h"
#include "petrous/Core/OutputFile.h"
#include "petrous/Presenters/BoneThickness.h"
#include "petrous/Presenters/LabelledPicture.h"
#include "petrous/Rendering/OffscreenView.h"
#include "petrous/Rendering/Picture.h"
#include "petrous/Rendering/ThicknessLegend.h"
#include "petrous/Scene/Description.h"

namespace petrous::presenters
{

namespace
{

namespace fs = std::filesystem;
constexpr const char* kEncoder = "ffmpeg";

/// ffmpeg, which reads frames from a socket: unlike a pipe that says when it has ended, without a
/// signal.
class Encoder
{
public:
  Encoder(const fs::path& file, const FilmOptions& options)
  {
    int ends[2];
    if (::socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends) != 0)
      throw core::Error(core::Fault::Refused,
                        std::string("ffmpeg cannot be started: ") + std::strerror(errno));
    m_socket = ends[0];
    std::vector<std::string> words{kEncoder,
                                   "-loglevel",
                                   "quiet",
                                   "-y",
                                   "-f",
                                   "rawvideo",
                                   "-pix_fmt",
                                   "rgb24",
                                   "-s",
                                   std::to_string(options.width) + "x" +
                                       std::to_string(options.height),
                                   "-r",
                                   core::generalText(options.framesPerSecond),
                                   "-i",
                                   "pipe:0",
                                   "-map_metadata",
                                   "-1",
                                   "-fflags",
                                   "+bitexact",
                                   "-vf",
                                   "pad=ceil(iw/2)*2:ceil(ih/2)*2",
                                   "-c:v",
                                   "libx264",
                                   "-crf",
                                   "18",
                                   "-pix_fmt",
                                   "yuv420p",
                                   "-movflags",
                                   "+faststart",
                                   "-f",
                                   "mp4",
                                   file.string()};
    std::vector<char*> arguments;
    for (std::string& word : words)
      arguments.push_back(word.data());
    arguments.push_back(nullptr);
    posix_spawn_file_actions_t files;
    ::posix_spawn_file_actions_init(&files);
    ::posix_spawn_file_actions_adddup2(&files, ends[1], STDIN_FILENO);
    ::posix_spawn_file_actions_addopen(&files, STDOUT_FILENO, "/dev/null", O_WRONLY, 0);
    ::posix_spawn_file_actions_addopen(&files, STDERR_FILENO, "/dev/null", O_WRONLY, 0);
    const int error = ::posix_spawnp(&m_pid, kEncoder, &files, nullptr, arguments.data(), environ);
    ::posix_spawn_file_actions_destroy(&files);
    ::close(ends[1]);
    if (error != 0)
    {
      ::close(m_socket);
      throw core::Error(core::Fault::Refused,
                        std::string("ffmpeg cannot be started: ") + std::strerror(error));
    }
  }

  ~Encoder()
  {
    close();
    if (m_pid > 0)
    {
      ::kill(m_pid, SIGKILL);
      ::waitpid(m_pid, nullptr, 0);
    }
  }
  Encoder(const Encoder&) = delete;
  Encoder& operator=(const Encoder&) = delete;

  void add(const std::vector<std::uint8_t>& frame)
  {
    for (std::size_t sent = 0; sent < frame.size();)
    {
      const ssize_t count =
          ::send(m_socket, frame.data() + sent, frame.size() - sent, MSG_NOSIGNAL);
      if (count > 0)
        sent += static_cast<std::size_t>(count);
      else if (errno != EINTR)
        fail();
    }
  }

  void finish()
  {
    close();
    int status = 0;
    while (::waitpid(m_pid, &status, 0) < 0 && errno == EINTR)
    {
    }
    m_pid = 0;
    if (!WIFEXITED(status) || WEXITSTATUS(status) != 0)
      fail();
  }

private:
  [[noreturn]] static void fail()
  {
    throw core::Error(core::Fault::Refused,
                      "ffmpeg could not encode the film; perhaps it has no H.264 (libx264), or the "
                      "disk is full. A name that ends in .png writes the frames");
  }

  void close()
  {
    if (m_socket >= 0)
      ::close(std::exchange(m_socket, -1));
  }

  int m_socket = -1;
  pid_t m_pid = 0;
};

/// Removes what it holds unless told that all is well.
struct Unfinished
{
  std::vector<fs::path> files;
  ~Unfinished()
  {
    std::error_code ignored;
    for (const fs::path& file : files)
      fs::remove(file, ignored);
  }
};

// `n` from 1.
fs::path frameFile(const fs::path& file, std::size_t n)
{
  char number[32];
  std::snprintf(number, sizeof number, "-%04zu", n);
  fs::path one = file;
  one.replace_filename(file.stem().string() + number + file.extension().string());
  return one;
}

// By which a frame is known again: a text of the PNG (tEXt), whole with its length and checksum.
constexpr std::string_view kMark("\0\0\0\x15tEXtSoftware\0Petrous film\x8e\x47\x7a\x10", 33);
constexpr std::size_t kMarkPlace = 8 + 25; // bytes: behind the signature and the header (IHDR)

void mark(const fs::path& frame)
{
  std::string png = core::readFile(frame);
  png.insert(kMarkPlace, kMark);
  core::OutputFile out(frame);
  out.write(png);
  out.commit();
}

bool isMarked(const fs::path& frame)
{
  try
  {
    const core::InputFile file(frame);
    return file.size() >= kMarkPlace + kMark.size() &&
           file.read(kMarkPlace + kMark.size()).substr(kMarkPlace) == kMark;
  }
  catch (const core::Error&)
  {
    return false;
  }
}

std::string endingOf(const fs::path& file)
{
  return scene::lowerCase(file.extension().string());
}

} // namespace

bool isVideo(const fs::path& file)
{
  return endingOf(file) == ".mp4";
}

std::string videoRefusal()
{
  const char* folders = std::getenv("PATH");
  std::istringstream all(folders ? folders : "");
  for (std::string folder; std::getline(all, folder, ':');)
    if (::access((fs::path(folder) / kEncoder).c_str(), X_OK) == 0)
      return {};
  return "a video needs the program ffmpeg, which is not installed (Debian's package ffmpeg); a "
         "name that ends in .png writes the frames instead";
}

std::vector<fs::path> filmFiles(const fs::path& file, std::size_t frames)
{
  if (isVideo(file))
    return {file};
  std::vector<fs::path> files;
  for (std::size_t n = 1; n <= frames; ++n)
    files.push_back(frameFile(file, n));
  return files;
}

std::vector<fs::path> framesBeyond(const fs::path& file, std::size_t frames)
{
  std::vector<fs::path> beyond;
  if (isVideo(file))
    return beyond;
  std::error_code ignored;
  for (std::size_t n = frames + 1;; ++n)
  {
    fs::path one = frameFile(file, n);
    if (!fs::is_regular_file(fs::symlink_status(one, ignored)))
      return beyond;
    beyond.push_back(std::move(one));
  }
}

std::size_t writeFilm(const fs::path& file, const rendering::SceneContents& contents,
                      const std::vector<core::CameraPose>& cameras, const FilmOptions& options,
                      const core::Progress& progress)
{
  const bool video = isVideo(file);
  if (!video && endingOf(file) != ".png")
    throw core::InvalidParameter(file.string() + ": a film is a video (.mp4) or pictures (.png)");
  const std::string refusal = video ? videoRefusal() : std::string();
  if (!refusal.empty())
    throw core::InvalidParameter(file.string() + ": " + refusal);
  // Beside those that they replace, which stay until all are drawn.
  Unfinished unfinished;
  std::vector<fs::path> targets;
  for (const fs::path& one : filmFiles(file, cameras.size()))
    targets.push_back(core::outputTarget(one));
  std::unique_ptr<Encoder> encoder;
  if (video)
  {
    unfinished.files.push_back(core::temporaryBeside(targets.front()));
    encoder = std::make_unique<Encoder>(unfinished.files.front(), options);
  }
  rendering::ScenePicture scene;
  scene.setContents(contents);
  rendering::OffscreenView view(options.width, options.height);
  const double magnified = std::max(options.height / 600.0, 1.0);
  for (std::size_t n = 0; n < cameras.size(); ++n)
  {
    progress.report(static_cast<double>(n) / static_cast<double>(cameras.size()),
                    "drawing frame " + std::to_string(n + 1) + " of " +
                        std::to_string(cameras.size()));
    scene.setCamera(cameras[n]);
    rendering::Picture frame = view.render(scene);
    addLines(frame, options.lines, magnified, backdropOf(contents.background));
    if (!options.thickness.empty())
      rendering::drawThicknessLegend(frame, options.thickness, kFarthestThickness);
    if (video)
      encoder->add(frame.rgb);
    else
    {
      unfinished.files.push_back(core::temporaryBeside(targets[n]));
      rendering::writePng(unfinished.files.back(), frame);
      mark(unfinished.files.back());
    }
  }
  if (video)
    encoder->finish();
  progress.check("writing the film");
  std::error_code error;
  for (std::size_t n = 0; n < targets.size(); ++n)
  {
    fs::rename(unfinished.files[n], targets[n], error);
    if (error)
      core::throwOutputError(error.value(), targets[n]);
  }
  unfinished.files.clear();
  std::size_t removed = 0;
  for (const fs::path& one : framesBeyond(file, cameras.size()))
  {
    if (!options.removesAnyBeyond && !isMarked(one))
      break;
    if (!fs::remove(one, error) && error)
      core::throwOutputError(error.value(), one);
    ++removed;
  }
  return removed;
}

} // namespace petrous::presenters
