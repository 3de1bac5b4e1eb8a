#pragma once

#include <array>
#include <optional>
#include <vector>

#include "petrous/Core/CameraPose.h"

namespace petrous::registration
{

/// A point of the patient, LPS mm, and where it is seen in a still: pixels from the still's upper
/// left corner, x to the right, y down (the centre of the first pixel is 0.5, 0.5).
struct StillLandmark
{
  Eigen::Vector3d patient;
  Eigen::Vector2d still;
};

struct StillPose
{
  core::CameraPose camera;       ///< perspective; the focal point at the depth of the landmarks
  std::vector<double> residuals; ///< pixels, per landmark
  double rms = 0.0;              ///< pixels, of the residuals
  double rmsAtLandmarks = 0.0;   ///< mm, the same at each landmark's depth

  /// Standard deviations to first order, for landmarks that are set with the error that the
  /// residuals show, but of no less than kSetting pixels in x and y each.
  double rotationSigma = 0.0;  ///< degrees
  double positionSigma = 0.0;  ///< mm, of the camera
  double viewAngleSigma = 0.0; ///< degrees; 0 if the angle was given

  /// Another pose, more than 5 degrees away, explains the landmarks nearly as well: they lie in a
  /// plane or nearly so, or there are few. Then the pose must be looked at, or a landmark added.
  bool ambiguous = false;

  static constexpr double kSetting = 0.5; ///< pixels
};

/// The pose of a pinhole camera with square pixels and its axis through the still's centre, from
/// landmarks (perspective-n-point): the least sum of squared residuals in the still. Starts are
/// orthogonal iterations (Lu, Hager, Mjolsness 2000) from 24 rotations, the minimum
/// Levenberg-Marquardt's.
///
/// `size`: pixels, width and height. `viewAngle`: vertical, degrees; without it the angle is found
/// too, which needs six landmarks of different depth.
///
/// Throws InvalidParameter for fewer than four landmarks (six without the angle), for a coordinate
/// that is not finite, a size below one pixel, an angle outside 0.5 to 120 degrees, and where the
/// landmarks leave the pose open: on one line within 1 mm, or, without the angle, of so little
/// depth that its standard deviation exceeds a fifth of it.
StillPose poseOfStill(const std::vector<StillLandmark>& landmarks, const std::array<int, 2>& size,
                      std::optional<double> viewAngle = std::nullopt);

} // namespace petrous::registration
