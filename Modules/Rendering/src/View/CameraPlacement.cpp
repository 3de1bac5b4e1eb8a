#include "CameraPlacement.h"

#include <cmath>

#include <vtkCamera.h>
#include <vtkMatrix4x4.h>
#include <vtkRenderer.h>

#include "petrous/Rendering/ScenePicture.h"

namespace petrous::rendering
{

void aimCamera(vtkCamera* camera, const core::CameraPose& pose)
{
  camera->SetFocalPoint(pose.focalPoint.data());
  camera->SetPosition(pose.position.data());
  camera->SetViewUp(pose.viewUp.data());
  camera->SetUseHorizontalViewAngle(0);
  camera->SetViewAngle(pose.viewAngle);
  camera->SetParallelProjection(pose.parallelScale ? 1 : 0);
  if (pose.parallelScale)
    camera->SetParallelScale(*pose.parallelScale);
}

core::CameraPose poseOf(vtkCamera* camera)
{
  core::CameraPose pose;
  camera->GetPosition(pose.position.data());
  camera->GetFocalPoint(pose.focalPoint.data());
  camera->GetViewUp(pose.viewUp.data());
  pose.viewAngle = camera->GetViewAngle();
  if (camera->GetParallelProjection())
    pose.parallelScale = camera->GetParallelScale();
  return pose;
}

void shiftLens(vtkRenderer* renderer, const core::CameraPose& pose)
{
  renderer->GetActiveCamera()->SetWindowCenter(pose.lensShift / renderer->GetTiledAspectRatio(),
                                               0.0);
}

// The lens is shifted in half sizes of the window, whose image plane is that of the whole picture.
void aimAtTile(vtkRenderer* renderer, const core::CameraPose& pose, const PictureTile& tile)
{
  constexpr double kHalfDegree = 3.14159265358979323846 / 360.0;
  const int* size = renderer->GetSize();
  const double share = static_cast<double>(size[1]) / tile.height;
  vtkCamera* camera = renderer->GetActiveCamera();
  if (pose.parallelScale)
    camera->SetParallelScale(share * *pose.parallelScale);
  else
    camera->SetViewAngle(std::atan(share * std::tan(pose.viewAngle * kHalfDegree)) / kHalfDegree);
  const double right =
      tile.left + tile.right + 0.5 * (size[0] - tile.width) + 0.5 * pose.lensShift * tile.height;
  const double down = tile.top + tile.down + 0.5 * (size[1] - tile.height);
  camera->SetWindowCenter(2.0 * right / size[0], -2.0 * down / size[1]);
}

RayView raysOf(vtkCamera* camera, double aspect, const Eigen::Matrix4d& worldFromPatient)
{
  return rayView(toEigen(camera->GetModelViewTransformMatrix()),
                 toEigen(camera->GetProjectionTransformMatrix(aspect, -1.0, 1.0)),
                 worldFromPatient);
}

Eigen::Matrix4d toEigen(vtkMatrix4x4* matrix)
{
  return Eigen::Map<const Eigen::Matrix<double, 4, 4, Eigen::RowMajor>>(&matrix->Element[0][0]);
}

} // namespace petrous::rendering
