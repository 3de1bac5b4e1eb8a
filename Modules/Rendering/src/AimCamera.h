#pragma once

#include "petrous/Core/CameraPose.h"

class vtkCamera;
class vtkRenderer;

namespace petrous::rendering
{

/// Puts VTK's camera where a pose says, all but the shift of the lens.
void aimCamera(vtkCamera* camera, const core::CameraPose& pose);

/// Shifts the lens of the renderer's camera; to be done again where the shape of the picture
/// changes.
void shiftLens(vtkRenderer* renderer, const core::CameraPose& pose);

} // namespace petrous::rendering
