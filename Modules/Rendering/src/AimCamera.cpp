#include "AimCamera.h"

#include <vtkCamera.h>
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

} // namespace petrous::rendering
