#pragma once

#include <Eigen/Core>

#include "RayView.h"
#include "petrous/Core/CameraPose.h"

class vtkCamera;
class vtkMatrix4x4;
class vtkRenderer;

namespace petrous::rendering
{

/// Puts VTK's camera where a pose says, all but the shift of the lens.
void aimCamera(vtkCamera* camera, const core::CameraPose& pose);

/// Shifts the lens of the renderer's camera; to be done again where the shape of the picture
/// changes.
void shiftLens(vtkRenderer* renderer, const core::CameraPose& pose);

/// The camera's rays through a picture of `aspect` (width / height) of a patient who stands in the
/// world so.
RayView raysOf(vtkCamera* camera, double aspect, const Eigen::Matrix4d& worldFromPatient);

Eigen::Matrix4d toEigen(vtkMatrix4x4* matrix);

} // namespace petrous::rendering
