#pragma once

#include <string>

#include "petrous/Core/CameraPose.h"

namespace petrous::interaction
{

/// Rotates the patient in front of the camera, about the focal point, so that what is under the
/// pointer follows the pointer. Angles in degrees: `right` rotates the near side to the right of
/// the screen, `down` to the bottom. No gimbal limit: the head can be turned all the way over.
core::CameraPose turned(const core::CameraPose& camera, double right, double down);

/// Turns the picture about its centre, clockwise; degrees.
core::CameraPose rolled(const core::CameraPose& camera, double degrees);

/// Pans by a fraction of the picture's height.
core::CameraPose shifted(const core::CameraPose& camera, double right, double down);

/// Dollies towards (factor > 1) or away from the focal point; distance limited to 1 mm to 10 m.
core::CameraPose zoomed(const core::CameraPose& camera, double factor);

/// The patient directions that a vector (LPS) points to, strongest first: "L", "AS".
std::string directionLetters(const Eigen::Vector3d& direction);

/// Patient directions at the picture's edges.
struct EdgeDirections
{
  std::string left, right, top, bottom;
};
EdgeDirections edgeDirections(const core::CameraPose& camera);

} // namespace petrous::interaction
