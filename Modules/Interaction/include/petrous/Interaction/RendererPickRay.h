#pragma once

#include "petrous/Core/CameraPose.h"
#include "petrous/Interaction/PickRay.h"

class vtkRenderer;
namespace petrous::rendering
{
class StereoPicture;
}

namespace petrous::interaction
{

/// Pose of a renderer's camera, with the lens shift as set by rendering::ScenePicture.
core::CameraPose cameraOf(vtkRenderer& renderer);

/// Ray through the centre of a pixel of the window, in VTK display coordinates (origin at the lower
/// left). Perspective: from the camera position; parallel: from the camera plane. A prop matrix
/// that moves the patient in the world is not taken into account. `stereo`: of the renderer's
/// scene; side by side, the ray is that of the eye whose half contains the pixel. Throws
/// InvalidParameter if the camera has no viewing direction.
PickRay pickRayThrough(vtkRenderer& renderer, double x, double y,
                       const rendering::StereoPicture* stereo = nullptr);

/// Ray through the centre of the renderer, of the camera between the eyes.
PickRay centralRay(vtkRenderer& renderer);

} // namespace petrous::interaction
