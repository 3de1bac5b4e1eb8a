#pragma once

#include <optional>
#include <string>
#include <utility>

#include "petrous/Core/CameraPose.h"
#include "petrous/Rendering/Picture.h"

namespace petrous::rendering
{

/// How the two eyes' pictures are combined on a screen.
enum class StereoMode
{
  None,
  SideBySide,  ///< left eye in the left half, square pixels in each
  Interleaved, ///< rows counted from the top: even rows left, odd rows right
  Anaglyph,    ///< for red-cyan glasses: red left, cyan right
  QuadBuffer   ///< to the driver's left and right buffers; windows only
};

/// "none", "side-by-side", "interleaved", "anaglyph"; nullopt for any other name.
std::optional<StereoMode> parseStereoMode(const std::string& name);

/// The two objectives of a stereo microscope.
struct StereoRig
{
  static constexpr double kLargestSeparation = 200.0;   ///< mm
  static constexpr double kNearestConvergence = 1.0;    ///< mm
  static constexpr double kFarthestConvergence = 1.0e4; ///< mm
  static constexpr double kWidestAngle = 30.0;          ///< between the lines of sight, degrees

  /// Angle between the lines of sight if no separation is given, degrees: operating microscopes
  /// have a stereo base of 22 to 26 mm at working distances of 200 to 400 mm; this is 24 mm at 250
  /// mm.
  static constexpr double kUsualAngle = 5.5;

  std::optional<double> eyeSeparation; ///< mm, >= 0; nullopt: by kUsualAngle
  std::optional<double> convergence;   ///< mm in front of the camera; nullopt: focal distance
};

/// The rig resolved for a camera, mm.
struct StereoGeometry
{
  double eyeSeparation = 0.0;
  double convergence = 0.0;
};

/// Throws InvalidParameter naming value and limits if a value is out of range or the separation is
/// too large for the convergence (kWidestAngle).
StereoGeometry stereoGeometry(const core::CameraPose& camera, const StereoRig& rig);

/// As stereoGeometry, but clamps every value to its range; for windows, whose camera varies.
StereoGeometry fittedStereoGeometry(const core::CameraPose& camera, const StereoRig& rig);

struct EyePair
{
  core::CameraPose left, right;
};

/// The eyes' cameras, at -separation/2 and +separation/2 along the camera's right. Points in the
/// plane perpendicular to the view at the convergence distance have no parallax; nearer points
/// appear in front of the screen. There is no vertical parallax.
///
/// Perspective: the axes stay parallel and the frusta are sheared (CameraPose::lensShift). The
/// parallax of a point at distance d (right minus left, positive behind the plane) is
///   separation (1/convergence - 1/d) / (2 tan(angle/2))  of the picture's height.
/// Parallel: the camera is rotated about the convergence point by half the angle between the lines
/// of sight; this differs from a shear only by the angle's cosine (0.1 % across the picture).
EyePair eyesOf(const core::CameraPose& camera, const StereoGeometry& geometry);

/// Width and height of one eye's picture in a picture of width x height. Throws RenderingError
/// BadSize if a side-by-side picture has an odd width.
std::pair<int, int> eyeSize(StereoMode mode, int width, int height);

/// Combines the eyes' pictures, which have the same size. Anaglyph ("half colour"): red is the left
/// picture's luma (ITU-R BT.601: 0.299 R + 0.587 G + 0.114 B), green and blue are the right one's,
/// which avoids retinal rivalry on red vessels. None: the left picture. Throws RenderingError
/// BadSize if the sizes differ.
Picture composeStereo(const Picture& left, const Picture& right, StereoMode mode);

} // namespace petrous::rendering
