#pragma once

#include <optional>
#include <string>
#include <utility>

#include "petrous/Core/CameraPose.h"
#include "petrous/Rendering/Picture.h"

namespace petrous::rendering
{

/// How two pictures become one on a screen.
enum class StereoMode
{
  None,
  SideBySide,  ///< left eye's picture on the left half, each with square pixels
  Interleaved, ///< rows counted from the top: even ones left, odd ones right
  Anaglyph,    ///< for red-cyan glasses: red left, cyan right
  QuadBuffer   ///< to two buffers of the driver; windows only
};

/// "none", "side-by-side", "interleaved", "anaglyph"; nothing for another word.
std::optional<StereoMode> parseStereoMode(const std::string& name);

/// The two objectives of a stereo microscope.
struct StereoRig
{
  static constexpr double kLargestSeparation = 200.0;   ///< mm
  static constexpr double kNearestConvergence = 1.0;    ///< mm
  static constexpr double kFarthestConvergence = 1.0e4; ///< mm
  static constexpr double kWidestAngle = 30.0;          ///< between the lines of sight, degrees

  /// Between the lines of sight where no separation is given, degrees: an operating microscope has
  /// a stereo base of 22 to 26 mm at working distances of 200 to 400 mm; 24 mm at 250 mm is taken.
  static constexpr double kUsualAngle = 5.5;

  std::optional<double> eyeSeparation; ///< mm, >= 0; absent: by kUsualAngle
  std::optional<double> convergence;   ///< mm before the camera; absent: the focal point's distance
};

/// What a rig comes to for one camera, mm.
struct StereoGeometry
{
  double eyeSeparation = 0.0;
  double convergence = 0.0;
};

/// Throws InvalidParameter naming value and limits: a number out of its range, or a separation too
/// wide for the convergence (kWidestAngle).
StereoGeometry stereoGeometry(const core::CameraPose& camera, const StereoRig& rig);

/// The same with every number brought into its range: for a window, whose camera comes and goes.
StereoGeometry fittedStereoGeometry(const core::CameraPose& camera, const StereoRig& rig);

struct EyePair
{
  core::CameraPose left, right;
};

/// The cameras of the eyes, at -separation/2 and +separation/2 along the camera's right. What lies
/// in the plane across the view at the distance of convergence has no parallax; what is nearer
/// comes out of the screen. There is no vertical parallax.
///
/// Perspective: the axes stay parallel and the frusta are sheared (CameraPose::lensShift). At the
/// distance d a point's parallax (right minus left, positive behind the plane) is
///   separation (1/convergence - 1/d) / (2 tan(angle/2))  of the picture's height.
/// Parallel: the camera is turned about the point of convergence by half the angle between the
/// lines of sight, which differs from a shear by its cosine only (0.1 % across the picture).
EyePair eyesOf(const core::CameraPose& camera, const StereoGeometry& geometry);

/// Width and height of one eye's picture in a picture of width x height. Throws RenderingError
/// BadSize where a side-by-side picture has an odd width.
std::pair<int, int> eyeSize(StereoMode mode, int width, int height);

/// Both eyes' pictures, of the same size, in one. Anaglyph ("half colour"): red is the left
/// picture's luma (ITU-R BT.601: 0.299 R + 0.587 G + 0.114 B), green and blue are the right one's,
/// so that a red vessel does not flicker between the eyes. None: the left one.
/// Throws RenderingError BadSize where their sizes differ.
Picture composeStereo(const Picture& left, const Picture& right, StereoMode mode);

} // namespace petrous::rendering
