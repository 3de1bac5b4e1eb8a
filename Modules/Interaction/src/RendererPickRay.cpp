#include "petrous/Interaction/RendererPickRay.h"

#include <algorithm>
#include <cmath>

#include <vtkCamera.h>
#include <vtkRenderer.h>

#include "petrous/Rendering/PixelRays.h"

namespace petrous::interaction
{

namespace
{
constexpr double kDegree = 3.14159265358979323846 / 180.0;
}

core::CameraPose cameraOf(vtkRenderer& renderer)
{
  vtkCamera* camera = renderer.GetActiveCamera();
  const double aspect = renderer.GetTiledAspectRatio();
  core::CameraPose pose;
  camera->GetPosition(pose.position.data());
  camera->GetFocalPoint(pose.focalPoint.data());
  camera->GetViewUp(pose.viewUp.data());
  pose.viewAngle = camera->GetViewAngle();
  if (camera->GetUseHorizontalViewAngle())
    pose.viewAngle = 2.0 / kDegree * std::atan(std::tan(0.5 * pose.viewAngle * kDegree) / aspect);
  if (camera->GetParallelProjection())
    pose.parallelScale = camera->GetParallelScale();
  pose.lensShift = camera->GetWindowCenter()[0] * aspect;
  return pose;
}

PickRay pickRayThrough(vtkRenderer& renderer, double x, double y)
{
  const int* size = renderer.GetSize();
  const int* corner = renderer.GetOrigin();
  const int height = std::max(size[1], 1);
  const rendering::PixelRay ray =
      rendering::PixelRays(cameraOf(renderer), std::max(size[0], 1), height)
          .through(x - corner[0], height - 1.0 - (y - corner[1]));
  return {ray.origin, ray.direction};
}

} // namespace petrous::interaction
