#pragma once

#include <string>

#include "petrous/Core/CameraPose.h"

namespace petrous::presenters
{

/// The patient is turned in front of the camera, about the focal point, so the thing under the
/// pointer follows the pointer. Angles in degrees: `right` turns what is in front to the right on
/// the screen, `down` to the bottom. No pole: the head can be turned all the way over.
core::CameraPose turned(const core::CameraPose& camera, double right, double down);

/// The patient is moved by a share of the picture's height.
core::CameraPose shifted(const core::CameraPose& camera, double right, double down);

/// Nearer (factor > 1) to, or farther from, the focal point; never beyond 1 mm to 10 m.
core::CameraPose zoomed(const core::CameraPose& camera, double factor);

/// The patient's directions that a vector (LPS) points to, the strongest first: "L", "AS".
std::string directionLetters(const Eigen::Vector3d& direction);

/// The same for the picture's edges.
struct EdgeDirections
{
  std::string left, right, top, bottom;
};
EdgeDirections edgeDirections(const core::CameraPose& camera);

} // namespace petrous::presenters
