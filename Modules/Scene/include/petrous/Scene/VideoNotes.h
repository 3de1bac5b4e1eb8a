#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "petrous/Core/CameraPose.h"

namespace petrous::scene
{

struct Case;

/// What was set in a video of the operation. Times are nanoseconds from its beginning, as of the
/// frames themselves.
struct VideoNotes
{
  static constexpr std::size_t kMaxBookmarks = 1000;
  static constexpr std::size_t kMaxStills = 100;
  static constexpr std::size_t kMaxLandmarks = 200; ///< of a still
  static constexpr std::size_t kLongestName = 100;  ///< bytes
  static constexpr int kLargestSide = 32768;        ///< pixels

  struct Bookmark
  {
    std::string name;      ///< unique among the video's, whatever the case of its letters
    std::int64_t time = 0; ///< ns
    std::string stroke; ///< object of the stroke after which the bone is as in the video; or empty
  };

  /// A point of the patient and where it is seen in a still.
  struct Landmark
  {
    Eigen::Vector3d patient{0.0, 0.0, 0.0}; ///< LPS mm
    Eigen::Vector2d still{0.0, 0.0}; ///< pixels from the upper left corner; the first's centre: 0.5
  };

  /// A frame with landmarks, and the camera that they give.
  struct Still
  {
    std::int64_t time = 0;                  ///< of the frame, ns; one still a frame
    std::array<int, 2> size{0, 0};          ///< pixels, width and height
    std::vector<Landmark> landmarks;        ///< pairs that are complete
    std::optional<double> viewAngle;        ///< vertical, degrees, if it is known
    std::optional<core::CameraPose> camera; ///< perspective; none before there are enough
    double opacity = 0.5;                   ///< of the still over the 3D view, 0 to 1
  };

  std::vector<Bookmark> bookmarks; ///< by time
  std::vector<Still> stills;       ///< by time

  bool empty() const { return bookmarks.empty() && stills.empty(); }
};

bool operator==(const VideoNotes& a, const VideoNotes& b);
inline bool operator!=(const VideoNotes& a, const VideoNotes& b)
{
  return !(a == b);
}

/// Throws InvalidParameter naming the first value that is invalid, and the limit.
void checkVideoNotes(const VideoNotes& notes);

/// Sorts both lists by time.
void sortVideoNotes(VideoNotes& notes);

/// Throws InvalidParameter listing those that there are.
std::size_t findBookmark(const VideoNotes& notes, const std::string& name);
/// The name, or if it is taken "name 2", ...
std::string freeBookmarkName(const VideoNotes& notes, const std::string& name);
/// The still of the frame, or nullptr.
const VideoNotes::Still* findStill(const VideoNotes& notes, std::int64_t time);

/// The number of the stroke, from 0, of that object; nullopt: none, or one that is gone.
std::optional<std::size_t> strokeWith(const Case& value, const std::string& object);

} // namespace petrous::scene
