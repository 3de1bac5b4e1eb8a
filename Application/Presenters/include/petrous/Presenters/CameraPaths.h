#pragma once

#include <string>
#include <vector>

#include "petrous/Core/CameraPose.h"
#include "petrous/Core/Progress.h"
#include "petrous/Scene/Case.h"

namespace petrous::presenters
{

/// `frames` cameras once around the patient: about the axis of the view's up through its focal
/// point, evenly, the first as given; the patient seems to turn to the right. Throws
/// InvalidParameter unless frames is 2 to kMaxFrames and the view has an up.
std::vector<core::CameraPose> turntable(const core::CameraPose& camera, int frames);

/// A flight along a line, as of an endoscope: `frames` cameras from its first point to its last,
/// evenly along its length, each looking ahead along the line. The picture's up is the patient's
/// superior at first and turns no more than the line does. Throws InvalidParameter for less than
/// two different points, or frames as above.
std::vector<core::CameraPose> flight(const std::vector<Eigen::Vector3d>& line, int frames);

/// Along the centre line of a structure (alongStructure), which is hidden in `value`: a canal or
/// nerve is seen from where it was.
std::vector<core::CameraPose> flightAlong(scene::Case& value, const std::string& structure,
                                          int frames, const core::Progress& progress = {});

constexpr int kMaxFrames = 3600;

} // namespace petrous::presenters
