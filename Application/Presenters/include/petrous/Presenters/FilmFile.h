#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "petrous/Core/CameraPose.h"
#include "petrous/Core/Progress.h"
#include "petrous/Rendering/SceneContents.h"

namespace petrous::presenters
{

/// How a film is written.
struct FilmOptions
{
  int width = 1280; ///< pixels
  int height = 720;
  double framesPerSecond = 25.0;       ///< of a video
  std::vector<std::string> lines = {}; ///< upper left of each frame
  std::string thickness = {}; ///< structure over which bone is coloured: with the colour scale
  /// The user was asked: all framesBeyond are removed, else only those that are known to be of a
  /// film of this program, and none behind one that is not.
  bool removesAnyBeyond = false;
};

/// Whether a film of this name is a video (.mp4), else one PNG a frame (.png).
bool isVideo(const std::filesystem::path& file);

/// Empty, or why no video can be written here: which program is missing and where it comes from.
std::string videoRefusal();

/// The files of a film: of "turn.png" with 12 frames "turn-0001.png" to "turn-0012.png".
std::vector<std::filesystem::path> filmFiles(const std::filesystem::path& file, std::size_t frames);

/// The frames of an earlier, longer film of this name: those that follow the last one without a
/// gap. A player would take them for this film's.
std::vector<std::filesystem::path> framesBeyond(const std::filesystem::path& file,
                                                std::size_t frames);

/// Draws a scene from one camera after the other, off-screen, on any thread: complete, in place of
/// an earlier film and of its framesBeyond (FilmOptions::removesAnyBeyond), or not at all. A video
/// is encoded by ffmpeg (H.264). Throws InvalidParameter for a name that is neither or without
/// ffmpeg, core::Error (Refused) where that fails, RenderingError, core::OutputFileError,
/// CancelledError. Returns how many framesBeyond were removed.
std::size_t writeFilm(const std::filesystem::path& file, const rendering::SceneContents& contents,
                      const std::vector<core::CameraPose>& cameras, const FilmOptions& options,
                      const core::Progress& progress = {});

} // namespace petrous::presenters
