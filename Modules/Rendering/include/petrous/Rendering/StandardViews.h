#pragma once

#include <optional>
#include <string>

#include "petrous/Core/CameraPose.h"
#include "petrous/Core/GridGeometry.h"

namespace petrous::rendering
{

/// Direction from which the patient is viewed; left and right are the patient's.
enum class StandardView
{
  Lateral, ///< from the side of the volume's centre
  Left,
  Right,
  Superior,
  Inferior,
  Anterior,
  Posterior,
  SurgicalLeft, ///< of the left ear, as the surgeon at it sees the patient; see below
  SurgicalRight
};

/// "lateral", "left", ..., "surgical-left", "surgical-right"; nullopt for any other name.
std::optional<StandardView> parseView(const std::string& name);
std::string nameOf(StandardView view);

/// A camera that frames the bounding sphere of the hull of the voxel centres in any picture that is
/// at least as wide as high; vertical view angle 30 degrees.
///
/// View-up is superior; for superior and inferior views it is anterior, the orientation used by
/// surgeons and radiologists. Surgical is the patient on the back with the head turned to the other
/// side and the surgeon at the ear: along the left-right axis from the ear's side, view-up anterior
/// (the face lies away from the surgeon), so that the vertex is on the picture's left at a right
/// ear and on its right at a left one. Lateral is left if the hull's centre has LPS x > 10 mm,
/// otherwise right.
core::CameraPose standardCamera(StandardView view, const core::GridGeometry& grid);

/// As above, framing the given sphere, patient LPS mm; the grid determines the lateral side.
core::CameraPose standardCamera(StandardView view, const core::GridGeometry& grid,
                                const Eigen::Vector3d& center, double radius);

} // namespace petrous::rendering
