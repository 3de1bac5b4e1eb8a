#pragma once

#include <optional>

#include <Eigen/Core>

namespace petrous::core
{

/// From where a picture is taken, in patient LPS mm.
struct CameraPose
{
  Eigen::Vector3d position{0.0, 0.0, 0.0};
  Eigen::Vector3d focalPoint{0.0, 1.0, 0.0};
  Eigen::Vector3d viewUp{0.0, 0.0, 1.0};
  double viewAngle = 30.0;             ///< vertical, degrees; perspective
  std::optional<double> parallelScale; ///< half the picture's height, mm: parallel when set
};

} // namespace petrous::core
