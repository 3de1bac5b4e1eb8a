#pragma once

#include "petrous/Core/CameraPose.h"
#include "petrous/Interaction/PickRay.h"

class vtkRenderer;

namespace petrous::interaction
{

/// Pose of a renderer's camera, with the lens shift as set by rendering::ScenePicture.
core::CameraPose cameraOf(vtkRenderer& renderer);

/// Ray through the centre of a pixel of the window, in VTK display coordinates (origin at the lower
/// left). Perspective: from the camera position; parallel: from the camera plane. A prop matrix
/// that moves the patient in the world is not taken into account. Throws InvalidParameter if the
/// camera has no viewing direction.
PickRay pickRayThrough(vtkRenderer& renderer, double x, double y);

} // namespace petrous::interaction
