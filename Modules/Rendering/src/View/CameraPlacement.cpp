#include "CameraPlacement.h"

#include <vtkCamera.h>
#include <vtkMatrix4x4.h>
#include <vtkRenderer.h>

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

void shiftLens(vtkRenderer* renderer, const core::CameraPose& pose)
{
  renderer->GetActiveCamera()->SetWindowCenter(pose.lensShift / renderer->GetTiledAspectRatio(),
                                               0.0);
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
