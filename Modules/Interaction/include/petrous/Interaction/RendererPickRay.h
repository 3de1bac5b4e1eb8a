#pragma once

#include "petrous/Core/CameraPose.h"
#include "petrous/Interaction/PickRay.h"

class vtkRenderer;

namespace petrous::interaction
{

/// Where a renderer's camera is; the lens shift as rendering::ScenePicture sets it.
core::CameraPose cameraOf(vtkRenderer& renderer);

/// Through the centre of a pixel of the window, as VTK counts them: from the lower left corner.
/// Perspective: from the eye; parallel: from the camera's plane. A patient that a prop's matrix
/// moves in the world is not accounted for.
/// Throws InvalidParameter for a camera that looks nowhere.
PickRay pickRayThrough(vtkRenderer& renderer, double x, double y);

} // namespace petrous::interaction
