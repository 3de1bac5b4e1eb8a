#pragma once

#include <map>
#include <optional>
#include <string>

#include <Eigen/Core>

#include "petrous/Core/CameraPose.h"

namespace petrous::scene
{

/// How a case was looked at when it was saved, besides its camera. Programs that know none of it
/// read the case as well.
struct ViewState
{
  struct Slices
  {
    Eigen::Vector3d crosshair{0.0, 0.0, 0.0}; ///< patient LPS mm
    double width = 0.0;                       ///< of the grey window, in the CT's unit; above 0
    double level = 0.0;
  };

  /// Of the branches other than the current one, by name, as they were left. Names of no branch are
  /// not saved.
  std::map<std::string, core::CameraPose> branchCameras;
  std::optional<Slices> slices;
};

} // namespace petrous::scene
