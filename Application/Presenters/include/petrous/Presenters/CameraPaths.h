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

/// A flight through what is drawn of a case.
struct Flight
{
  std::vector<core::CameraPose> cameras;
  std::vector<std::string> hidden; ///< names of what the cameras would cross, without the structure
  bool softTissueHidden = false;
  double length = 0.0; ///< mm, of the centre line
  double flown = 0.0;  ///< mm of it, and of what goes on straight where it ends
};

/// Along the centre line of a structure (alongStructure), which is hidden in `value`: a canal or
/// nerve is seen from where it was.
///
/// Every camera lies in the image with nothing drawn within kFlightClearance, and so does the point
/// 3 mm ahead at which it looks: the flight is the longest such stretch, and stops before the wall
/// at its end. Structures, meshes and soft tissue in its way are hidden in `value`; one that closes
/// only the last 3 mm of either end, such as an eardrum, stays, and the flight stops before it. At
/// both ends cameras are left out that would see next to nothing. Clipping is not taken into
/// account. Throws InvalidParameter also where no such stretch is 4 mm long, and CancelledError
/// within some milliseconds, but while images are read or a mesh is sorted.
Flight flightAlong(scene::Case& value, const std::string& structure, int frames,
                   const core::Progress& progress = {});

constexpr double kFlightClearance = 0.3; ///< mm

constexpr int kMaxFrames = 3600;

} // namespace petrous::presenters
