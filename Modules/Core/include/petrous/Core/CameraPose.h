#pragma once

#include <optional>

#include <Eigen/Core>

namespace petrous::core
{

/// Camera pose in patient LPS mm.
struct CameraPose
{
  Eigen::Vector3d position{0.0, 0.0, 0.0};
  Eigen::Vector3d focalPoint{0.0, 1.0, 0.0};
  Eigen::Vector3d viewUp{0.0, 0.0, 1.0};
  double viewAngle = 30.0;             ///< vertical, degrees; perspective
  std::optional<double> parallelScale; ///< half the view height, mm; parallel projection if set
  /// Offset of the image centre to the right of the view axis, in half image heights: the off-axis
  /// frustum of one eye of a stereo pair. Not part of a saved view.
  double lensShift = 0.0;

  /// Of one eye of a stereo pair: the camera between both, beside which the lamp is. Not part of a
  /// saved view.
  struct Head
  {
    Eigen::Vector3d position{0.0, 0.0, 0.0};
    Eigen::Vector3d focalPoint{0.0, 1.0, 0.0};
  };
  std::optional<Head> head = std::nullopt;
};

} // namespace petrous::core
