#pragma once

#include <optional>
#include <string>

#include "petrous/Core/CameraPose.h"
#include "petrous/Core/GridGeometry.h"

namespace petrous::rendering
{

/// From where the patient is looked at; left and right are the patient's.
enum class StandardView
{
  Lateral, ///< from the side on which the volume's centre lies
  Left,
  Right,
  Superior,
  Inferior,
  Anterior,
  Posterior
};

/// "lateral", "left", ...; nothing for any other word.
std::optional<StandardView> parseView(const std::string& name);
std::string nameOf(StandardView view);

/// A camera that frames the bounding sphere of the hull of the voxel centres, whatever the
/// picture's shape as long as it is not higher than wide; 30 degrees vertical.
///
/// Up is superior; for superior and inferior views it is anterior, as a surgeon or a radiologist
/// holds the head. Lateral is left where the hull's centre has LPS x > 10 mm, else right.
core::CameraPose standardCamera(StandardView view, const core::GridGeometry& grid);

/// The same with a ball of its own to frame, patient LPS mm; the grid decides what is lateral.
core::CameraPose standardCamera(StandardView view, const core::GridGeometry& grid,
                                const Eigen::Vector3d& center, double radius);

} // namespace petrous::rendering
