#pragma once

#include <Eigen/Core>

#include "RayView.h"
#include "petrous/Core/CameraPose.h"

class vtkCamera;
class vtkMatrix4x4;
class vtkRenderer;

namespace petrous::rendering
{

struct PictureTile;

/// Sets VTK's camera from a pose, except for the lens shift.
void aimCamera(vtkCamera* camera, const core::CameraPose& pose);

/// Without the lens shift.
core::CameraPose poseOf(vtkCamera* camera);

/// Sets the lens shift of the renderer's camera; to be repeated when the aspect ratio changes.
void shiftLens(vtkRenderer* renderer, const core::CameraPose& pose);

/// Sets angle and lens shift of the renderer's camera so that it sees a tile of the pose's picture.
void aimAtTile(vtkRenderer* renderer, const core::CameraPose& pose, const PictureTile& tile);

/// The camera's rays for a picture of `aspect` (width / height), with the given pose of the patient
/// in the world.
RayView raysOf(vtkCamera* camera, double aspect, const Eigen::Matrix4d& worldFromPatient);

Eigen::Matrix4d toEigen(vtkMatrix4x4* matrix);

} // namespace petrous::rendering
