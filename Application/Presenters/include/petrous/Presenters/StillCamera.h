#pragma once

#include <istream>
#include <optional>
#include <string>
#include <vector>

#include "petrous/Core/Progress.h"
#include "petrous/Registration/StillPose.h"
#include "petrous/Rendering/Picture.h"
#include "petrous/Scene/VideoNotes.h"
#include "petrous/Video/VideoFile.h"

namespace petrous::presenters
{

/// The camera of a still, from its landmarks.
struct StillFit
{
  registration::StillPose pose; ///< without the bad ones, which have residuals, too
  /// One or two landmarks that do not fit: without them the rest does, and they stand out of it.
  std::vector<std::size_t> bad;
  /// The residuals are larger than clicks explain, and no landmark stands out.
  bool isPoor = false;
};

/// Residual (rms) up to which landmarks are taken as well set: pixels, for stills of that height.
double residualOfGoodClicks(int height) noexcept;

std::size_t landmarksNeeded(const scene::VideoNotes::Still& still) noexcept; ///< 4 or 6

/// Throws InvalidParameter as registration::poseOfStill, CancelledError. Without the angle of view
/// some tenths of a second, and as often as there are pairs of landmarks where they do not fit.
StillFit fitStill(const scene::VideoNotes::Still& still, const core::Progress& progress = {});

/// Where a camera sees a point: pixels from the upper left corner of a picture; nullopt behind it.
std::optional<Eigen::Vector2d> seenAt(const core::CameraPose& camera,
                                      const std::array<int, 2>& size,
                                      const Eigen::Vector3d& patient);

/// A table with the columns x_mm, y_mm, z_mm (patient LPS) and u_px, v_px (in the still, from its
/// upper left corner). Throws InvalidParameter naming file and line.
std::vector<scene::VideoNotes::Landmark> landmarksFromCsv(std::istream& csv,
                                                          const std::string& name);

/// A picture from the still's camera with the still over it: as high as the picture, in its middle.
rendering::Picture overlaid(rendering::Picture picture, const video::Frame& still, double opacity);

rendering::Picture pictureOf(const video::Frame& frame);

/// "01:02.480": of less than an hour; "1:01:02.480". Milliseconds are cut, not rounded.
std::string timeText(std::int64_t nanoseconds);

} // namespace petrous::presenters
